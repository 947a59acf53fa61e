#include "mesh/gltf_write.h"

#include "image/colour.h"
#include "image/io.h"

#include "base/file.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <limits>
#include <span>
#include <unordered_map>
#include <vector>

namespace sward::mesh {
namespace {

using Json = nlohmann::json;

constexpr int kFloat = 5126;
constexpr int kUnsignedInt = 5125;

/// The binary chunk with its buffer views.
class Binary {
 public:
  /// Appends bytes as one buffer view, 4-byte aligned, and returns its index.
  std::size_t view(std::span<const std::byte> bytes) {
    m_bytes.resize((m_bytes.size() + 3) / 4 * 4);
    m_views.push_back({{"buffer", 0}, {"byteOffset", m_bytes.size()}, {"byteLength", bytes.size()}});
    m_bytes.insert(m_bytes.end(), bytes.begin(), bytes.end());
    return m_views.size() - 1;
  }
  const std::vector<std::byte>& bytes() const { return m_bytes; }
  const Json& views() const { return m_views; }

 private:
  std::vector<std::byte> m_bytes;
  Json m_views = Json::array();
};

glm::vec3 yUp(const glm::vec3& v) {
  return {v.x, v.z, -v.y};
}

/// The vertices and indices of one material's triangles.
struct Part {
  std::vector<glm::vec3> positions, normals;
  std::vector<glm::vec2> uvs;
  std::vector<glm::vec4> colours;
  std::vector<std::uint32_t> indices;
};

Part partOf(const Model& model, std::uint32_t material) {
  Part part;
  std::unordered_map<std::uint32_t, std::uint32_t> written;
  const glm::mat3& uvFromMesh = model.materials[material].uvFromMesh;
  for (std::size_t t = 0; t < model.triangles.size(); ++t) {
    if (model.triangleMaterial[t] != material) continue;
    for (int i = 0; i < 3; ++i) {
      const std::uint32_t source = model.triangles[t][i];
      const auto [found, isNew] = written.try_emplace(source, static_cast<std::uint32_t>(part.positions.size()));
      if (isNew) {
        part.positions.push_back(yUp(model.positions[source]));
        part.normals.push_back(yUp(model.normals[source]));
        // The texture transform is baked in: every reader of glTF then agrees, also those without the extension.
        part.uvs.emplace_back(uvFromMesh * glm::vec3(model.uvs[source], 1.0f));
        part.colours.push_back(glm::clamp(model.colours[source], 0.0f, 1.0f));
      }
      part.indices.push_back(found->second);
    }
  }
  return part;
}

class Writer {
 public:
  explicit Writer(const Model& model) : m_model(model) {}

  Result<std::vector<std::byte>> run() {
    SWARD_TRY(addTextures());
    for (const Material& material : m_model.materials) addMaterial(material);
    Json primitives = Json::array();
    for (std::uint32_t i = 0; i < m_model.materials.size(); ++i) addPrimitive(partOf(m_model, i), i, primitives);
    m_document["asset"] = {{"version", "2.0"}, {"generator", "Sward"}};
    m_document["scene"] = 0;
    m_document["scenes"] = Json::array({{{"nodes", {0}}}});
    m_document["nodes"] = Json::array({{{"mesh", 0}, {"name", m_model.name}}});
    m_document["meshes"] = Json::array({{{"name", m_model.name}, {"primitives", primitives}}});
    m_document["bufferViews"] = m_binary.views();
    m_document["buffers"] = Json::array({{{"byteLength", m_binary.bytes().size()}}});
    return container();
  }

 private:
  Result<void> addTextures() {
    for (const image::Image& texture : m_model.textures) {
      image::Image encoded = texture;
      if (texture.channels == 2) encoded = greyAlphaAsRgba(texture);
      const int colours = encoded.channels == 4 ? 3 : encoded.channels;
      for (std::size_t p = 0; p < encoded.pixels.size(); p += static_cast<std::size_t>(encoded.channels)) {
        for (std::size_t c = 0; c < static_cast<std::size_t>(colours); ++c) {
          encoded.pixels[p + c] = image::srgbFromLinear(encoded.pixels[p + c]);
        }
      }
      SWARD_ASSIGN(const std::vector<std::byte> png, image::encodePng(encoded));
      m_document["images"].push_back({{"bufferView", m_binary.view(png)}, {"mimeType", "image/png"}});
    }
    return {};
  }

  static image::Image greyAlphaAsRgba(const image::Image& grey) {
    image::Image rgba(grey.width, grey.height, 4);
    for (std::size_t p = 0; 2 * p < grey.pixels.size(); ++p) {
      std::fill_n(rgba.pixels.begin() + static_cast<std::ptrdiff_t>(4 * p), 3, grey.pixels[2 * p]);
      rgba.pixels[4 * p + 3] = grey.pixels[2 * p + 1];
    }
    return rgba;
  }

  /// Index of a glTF texture of this material's image and wrap modes.
  std::size_t addTexture(const Material& material) {
    const auto wrap = [](bool repeat) { return repeat ? 10497 : 33071; };
    m_document["samplers"].push_back(
        {{"magFilter", 9729}, {"minFilter", 9987}, {"wrapS", wrap(material.wrapS)}, {"wrapT", wrap(material.wrapT)}});
    m_document["textures"].push_back({{"sampler", m_document["samplers"].size() - 1}, {"source", material.texture}});
    return m_document["textures"].size() - 1;
  }

  void addMaterial(const Material& material) {
    // An override's brightness may have taken it above 1, which glTF does not allow.
    const glm::vec4 c = glm::min(material.baseColour, glm::vec4(1.0f));
    Json pbr = {{"baseColorFactor", {c.r, c.g, c.b, c.a}}, {"metallicFactor", 0.0}, {"roughnessFactor", 0.8}};
    if (material.texture >= 0) pbr["baseColorTexture"] = {{"index", addTexture(material)}};
    const glm::dvec3& tint = material.optics.transmissionTint;
    Json json = {
        {"name", material.name},
        {"pbrMetallicRoughness", pbr},
        {"doubleSided", material.doubleSided},
        {"extras",
         {{"sward_optics",
           {{"translucency", material.optics.translucency}, {"transmissionTint", {tint.r, tint.g, tint.b}}}}}}};
    if (material.alphaMode == AlphaMode::Blend) json["alphaMode"] = "BLEND";
    if (material.alphaMode == AlphaMode::Mask) {
      json["alphaMode"] = "MASK";
      json["alphaCutoff"] = material.alphaCutoff;
    }
    m_document["materials"].push_back(json);
  }

  template <typename T>
  std::size_t accessor(const std::vector<T>& values, const char* type, int componentType) {
    m_document["accessors"].push_back({{"bufferView", m_binary.view(std::as_bytes(std::span(values)))},
                                       {"componentType", componentType},
                                       {"count", values.size()},
                                       {"type", type}});
    return m_document["accessors"].size() - 1;
  }

  void addPrimitive(const Part& part, std::uint32_t material, Json& primitives) {
    if (part.indices.empty()) return;
    const std::size_t positions = accessor(part.positions, "VEC3", kFloat);
    glm::vec3 low(std::numeric_limits<float>::max()), high(std::numeric_limits<float>::lowest());
    for (const glm::vec3& p : part.positions) {
      low = glm::min(low, p);
      high = glm::max(high, p);
    }
    m_document["accessors"][positions]["min"] = {low.x, low.y, low.z};
    m_document["accessors"][positions]["max"] = {high.x, high.y, high.z};
    Json attributes = {{"POSITION", positions}};
    attributes["NORMAL"] = accessor(part.normals, "VEC3", kFloat);
    attributes["TEXCOORD_0"] = accessor(part.uvs, "VEC2", kFloat);
    attributes["COLOR_0"] = accessor(part.colours, "VEC4", kFloat);
    primitives.push_back({{"attributes", attributes},
                          {"indices", accessor(part.indices, "SCALAR", kUnsignedInt)},
                          {"material", material}});
  }

  Result<std::vector<std::byte>> container() const {
    std::string json = m_document.dump(-1, ' ', false, Json::error_handler_t::replace);
    json.resize((json.size() + 3) / 4 * 4, ' ');
    std::vector<std::byte> binary = m_binary.bytes();
    binary.resize((binary.size() + 3) / 4 * 4);
    const std::uint64_t total = 12 + 8 + json.size() + 8 + binary.size();
    if (total > std::numeric_limits<std::uint32_t>::max()) {
      return Error::badInput("the model needs " + std::to_string(total >> 20) + " MiB; a .glb holds at most 4 GiB", {},
                             "Write a simpler model.");
    }
    std::vector<std::byte> file;
    file.reserve(total);
    const auto word = [&](std::uint64_t value) {
      const auto small = static_cast<std::uint32_t>(value);
      const auto* p = reinterpret_cast<const std::byte*>(&small);
      file.insert(file.end(), p, p + sizeof small);
    };
    const auto chunk = [&](std::span<const std::byte> body, std::uint32_t type) {
      word(body.size());
      word(type);
      file.insert(file.end(), body.begin(), body.end());
    };
    word(0x46546C67);
    word(2);
    word(total);
    chunk(std::as_bytes(std::span(json)), 0x4E4F534A);
    chunk(binary, 0x004E4942);
    return file;
  }

  const Model& m_model;
  Binary m_binary;
  Json m_document = Json::object();
};

}  // namespace

Result<void> writeGlb(const std::filesystem::path& path, const Model& model) {
  if (model.empty())
    return Error::badInput("the model has no triangles", path.string(), "Write a model that has some.");
  Result<std::vector<std::byte>> file = Writer(model).run();
  if (!file.ok()) {
    Error error = std::move(file).error();
    error.where = path.string();
    return error;
  }
  return base::writeFileAtomically(path, *file);
}

}  // namespace sward::mesh
