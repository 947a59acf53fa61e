#include "trace/layer_pattern.h"

#include <cmath>
#include <limits>
#include <string>

namespace sward::trace {
namespace {

constexpr int kMaxResolution = 16384;  ///< bounds the memory of a band of rows

glm::dvec2 viewerSide(LayerSet set) {
  switch (set) {
    case LayerSet::BladesPosX:
      return {1.0, 0.0};
    case LayerSet::BladesNegX:
      return {-1.0, 0.0};
    case LayerSet::BladesPosY:
      return {0.0, 1.0};
    case LayerSet::BladesNegY:
      return {0.0, -1.0};
    default:
      return {0.0, 0.0};
  }
}

Result<void> checkOptions(LayerSet set, const LayerShape& shape, int subSamples) {
  const std::string where = std::string("sampling of the ") + layerSetName(set);
  if (shape.width < 1 || shape.height < 1 || shape.layers < 1 || subSamples < 1) {
    return Error::badInput("a resolution, a number of layers or of sub-samples is not positive", where,
                           "Give at least 1 of each.");
  }
  // Layers are stored as bytes; columns, texels and hits are counted in 32 bits.
  const double rays = 1.0 * shape.width * shape.height * shape.layers * subSamples;
  if (shape.width > kMaxResolution || shape.height > kMaxResolution || shape.layers > 256 || subSamples > 4096 ||
      rays > 4e9) {
    return Error::badInput("there are too many texels, layers or rays", where,
                           "At most 16384 texels a side, 256 layers, 4096 sub-samples and 4 billion rays a layer set.");
  }
  return {};
}

}  // namespace

glm::vec3 viewerNormal(const scene::Patch& patch, const RawHit& raw, const glm::vec3& direction) {
  const scene::Instance& instance = patch.instances[raw.surface.instance];
  const mesh::Model& model = *patch.models[instance.model];
  const glm::uvec3 corner = model.triangles[raw.surface.triangle];
  const glm::vec3 a = model.positions[corner.x];
  const glm::vec3 face = glm::cross(model.positions[corner.y] - a, model.positions[corner.z] - a);
  glm::vec3 smooth = (1.0f - raw.u - raw.v) * model.normals[corner.x] + raw.u * model.normals[corner.y] +
                     raw.v * model.normals[corner.z];
  const float agreement = glm::dot(smooth, face);
  if (!(glm::dot(smooth, smooth) > 1e-12f) || !std::isfinite(agreement)) smooth = face;
  if (agreement < 0.0f) smooth = -smooth;
  const glm::mat3 rotation(instance.worldFromModel);
  if (glm::dot(rotation * face, direction) > 0.0f) smooth = -smooth;
  const glm::vec3 world = rotation * smooth;
  return world / glm::length(world);
}

SetRays raysOf(LayerSet set, float side, float height, int layers) {
  const glm::vec3 alongX(side, 0.0f, 0.0f), alongY(0.0f, side, 0.0f), up(0.0f, 0.0f, height);
  SetRays rays;
  switch (set) {
    case LayerSet::BladesPosX:
      rays = {alongX, alongY, up, {-1.0f, 0.0f, 0.0f}};
      break;
    case LayerSet::BladesNegX:
      rays = {{}, alongY, up, {1.0f, 0.0f, 0.0f}};
      break;
    case LayerSet::BladesPosY:
      rays = {alongY, alongX, up, {0.0f, -1.0f, 0.0f}};
      break;
    case LayerSet::BladesNegY:
      rays = {{}, alongX, up, {0.0f, 1.0f, 0.0f}};
      break;
    default:
      rays = {up, alongX, alongY, {0.0f, 0.0f, -1.0f}};
      break;
  }
  const bool slices = set == LayerSet::Slices;
  rays.depth = slices ? height : side;
  rays.lead = rays.depth / static_cast<float>(layers);
  rays.origin -= rays.lead * rays.direction;
  rays.firstBorder = slices ? 0.0f : rays.lead;
  rays.rounding = 4.0f * std::numeric_limits<float>::epsilon() * (rays.lead + rays.depth);
  return rays;
}

Strata::Strata(int count) {
  for (int k = 1; k * k <= count; ++k) {
    if (count % k == 0) down = k;
  }
  across = count / down;
}

Hit SamplePattern::finish(const scene::Patch& patch, const RawHit& raw, int x, int y, int layer, int subSample) const {
  const auto column =
      static_cast<std::size_t>(y) * static_cast<std::size_t>(m_shape.width) + static_cast<std::size_t>(x);
  const glm::vec3 origin = originOf(x, y, subSample, bitsOf(columnSeed(column), layer, subSample));
  Hit hit;
  hit.position = origin + raw.t * m_rays.direction;
  hit.position.x = std::clamp(hit.position.x, 0.0f, m_side);
  hit.position.y = std::clamp(hit.position.y, 0.0f, m_side);
  hit.normal = encodeNormal(viewerNormal(patch, raw, m_rays.direction));
  hit.instance = raw.surface.instance;
  hit.triangle = raw.surface.triangle;
  const auto unorm = [](float w) { return static_cast<int>(std::lround(std::clamp(w, 0.0f, 1.0f) * 65535.0f)); };
  const int u = unorm(raw.u);
  hit.barycentric = {static_cast<std::uint16_t>(u), static_cast<std::uint16_t>(std::min(unorm(raw.v), 65535 - u))};
  return hit;
}

std::vector<char> viewersOf(LayerSet set, std::span<const glm::dvec3> directions) {
  const glm::dvec2 viewer = viewerSide(set);
  const bool fromAbove = viewer == glm::dvec2(0.0);
  std::vector<char> seen;
  for (const glm::dvec3& d : directions) seen.push_back(fromAbove || glm::dot(viewer, glm::dvec2(d)) > 0.0 ? 1 : 0);
  // With one or two directions none may lie on the viewer's side: then all stand for it.
  if (std::count(seen.begin(), seen.end(), char{1}) == 0) std::fill(seen.begin(), seen.end(), char{1});
  return seen;
}

Result<LayerHits> startHits(LayerSet set, const SamplingOptions& options) {
  LayerHits out;
  out.set = set;
  out.shape = layerShape(set, options);
  out.subSamples =
      set == LayerSet::Slices || set == LayerSet::Ground ? options.sliceSubSamples : options.bladeSubSamples;
  SWARD_TRY(checkOptions(set, out.shape, out.subSamples));
  return out;
}

void sampleGround(double patchSide, std::uint64_t seed, LayerHits& out) {
  const Strata strata(out.subSamples);
  const std::uint64_t base = base::mix64(seed, static_cast<std::uint64_t>(LayerSet::Ground));
  const auto columns = static_cast<std::size_t>(out.shape.columns());
  const auto subSamples = static_cast<std::size_t>(out.subSamples);
  out.columnStart.resize(columns + 1);
  out.hitStart.resize(columns + 1);
  out.layer.assign(columns, 0);
  out.hits.reserve(columns * subSamples);
  for (std::size_t c = 0; c <= columns; ++c) {
    out.columnStart[c] = static_cast<std::uint32_t>(c);
    out.hitStart[c] = static_cast<std::uint32_t>(c * subSamples);
  }
  const std::array<std::int16_t, 2> up = encodeNormal({0.0f, 0.0f, 1.0f});
  const auto limit = static_cast<float>(patchSide);
  const auto side = static_cast<double>(limit);
  for (std::size_t c = 0; c < columns; ++c) {
    const auto x = static_cast<double>(c % static_cast<std::size_t>(out.shape.width));
    const auto y = static_cast<double>(c / static_cast<std::size_t>(out.shape.width));
    const std::uint64_t columnSeed = base::mix64(base ^ base::mix64(c));
    for (std::size_t s = 0; s < subSamples; ++s) {
      const std::uint64_t bits = base::mix64(columnSeed + s * kGolden);
      const auto across = static_cast<std::size_t>(strata.across);
      const double u = x + (static_cast<double>(s % across) + base::unitFloat(bits)) / strata.across;
      const double v = y + (static_cast<double>(s / across) + base::unitFloat(bits << 24)) / strata.down;
      Hit hit;
      hit.position = {std::min(static_cast<float>(side * u / out.shape.width), limit),
                      std::min(static_cast<float>(side * v / out.shape.height), limit), 0.0f};
      hit.normal = up;
      out.hits.push_back(hit);
    }
  }
}

}  // namespace sward::trace
