#include "bake/memory_size.h"

namespace sward::bake {

std::uint64_t memoryBytes(const trace::LayerSurface& surface) {
  return (surface.reflectance.size() + surface.transmittance.size()) * sizeof(glm::vec3);
}
std::uint64_t memoryBytes(const trace::LayerHits& hits) {
  return hits.hits.size() * sizeof(trace::Hit) + hits.texels() * 5 + hits.columnStart.size() * 4;
}
std::uint64_t memoryBytes(const trace::LayerLuminance& luminance) {
  return luminance.reflected.size() * 2 * sizeof(float);
}
std::uint64_t memoryBytes(const trace::LayerVisibility& visibility) {
  return visibility.visibility.size() * 3 * sizeof(float);
}
std::uint64_t memoryBytes(const lpt::Fit& fit) {
  return (fit.coefficients.size() + fit.layerWeight.size()) * sizeof(float) + fit.common.bytes() +
         static_cast<std::uint64_t>(fit.columns) * 13;
}
std::uint64_t memoryBytes(const lpt::LayerStack& stack) {
  return stack.totalBytes();
}
std::uint64_t memoryBytes(const Inspection& inspection) {
  std::uint64_t bytes = 0;
  const auto add = [&](const StackInspection& stack) {
    bytes += stack.condition.size() + stack.rank.size() + stack.weight.size() * sizeof(float) + stack.visibility.size();
  };
  add(inspection.slices);
  add(inspection.soil);
  for (const StackInspection& blade : inspection.blades) add(blade);
  return bytes;
}
std::uint64_t memoryBytes(const tiles::TileSet& set) {
  return set.owner.size() + set.tiles.size() * 12;
}
std::uint64_t memoryBytes(const tiles::TileMap& map) {
  return map.tiles.size();
}
std::uint64_t memoryBytes(const mesh::Model& model) {
  return model.positions.size() * 60 + model.triangles.size() * 16;
}
std::uint64_t memoryBytes(const scene::Patch& patch) {
  std::uint64_t bytes = patch.instances.size() * sizeof(scene::Instance);
  for (const auto& model : patch.models) bytes += memoryBytes(*model);
  return bytes;
}
std::uint64_t memoryBytes(const GroundBake& ground) {
  std::uint64_t bytes = memoryBytes(ground.slices) + memoryBytes(ground.soil) + ground.map.tiles.size();
  for (const lpt::LayerStack& blade : ground.blades) bytes += memoryBytes(blade);
  if (ground.texels) {
    for (const TexelBake::Level& level : ground.texels->levels) {
      bytes += level.texel->bytes() + (level.sky.front.size() + level.sky.back.size()) * sizeof(float);
    }
  }
  return bytes;
}

std::uint64_t memoryBytes(const HeldRepresentation& representation) {
  // Coefficients are kept as floats, stored as bytes.
  return representation.value->lightingBytes() * sizeof(float);
}

}  // namespace sward::bake
