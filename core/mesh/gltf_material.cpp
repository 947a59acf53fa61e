#include "mesh/gltf_material.h"

#include "mesh/gltf_uri.h"

#include "image/io.h"

#include <algorithm>
#include <cmath>

namespace sward::mesh {
namespace {

const tinygltf::Value* transformOf(const tinygltf::TextureInfo& info) {
  const auto found = info.extensions.find("KHR_texture_transform");
  return found == info.extensions.end() ? nullptr : &found->second;
}

double numberOr(const tinygltf::Value& object, const char* key, double fallback) {
  return object.Has(key) ? object.Get(key).GetNumberAsDouble() : fallback;
}

glm::dvec2 pairOr(const tinygltf::Value& object, const char* key, const glm::dvec2& fallback) {
  if (!object.Has(key)) return fallback;
  const tinygltf::Value& pair = object.Get(key);
  return {pair.Get(0).GetNumberAsDouble(), pair.Get(1).GetNumberAsDouble()};
}

/// KHR_texture_transform: translation x rotation x scale, a positive rotation turning uv counter-clockwise as seen with
/// v pointing down.
glm::mat3 uvTransform(const tinygltf::Value& transform) {
  const glm::dvec2 offset = pairOr(transform, "offset", glm::dvec2(0.0));
  const glm::dvec2 scale = pairOr(transform, "scale", glm::dvec2(1.0));
  const double angle = numberOr(transform, "rotation", 0.0);
  const double c = std::cos(angle), s = std::sin(angle);
  return glm::mat3(glm::dmat3(glm::dvec3(c * scale.x, -s * scale.x, 0.0), glm::dvec3(s * scale.y, c * scale.y, 0.0),
                              glm::dvec3(offset, 1.0)));
}

LeafOptics opticsFrom(const tinygltf::Value& extras) {
  LeafOptics optics;
  if (!extras.IsObject() || !extras.Has("sward_optics")) return optics;
  const tinygltf::Value& written = extras.Get("sward_optics");
  optics.translucency = std::clamp(numberOr(written, "translucency", optics.translucency), 0.0, 1.0);
  const tinygltf::Value& tint = written.Get("transmissionTint");
  for (int c = 0; c < 3; ++c) optics.transmissionTint[c] = std::max(tint.Get(c).GetNumberAsDouble(), 0.0);
  return optics;
}

}  // namespace

std::uint32_t MaterialReader::use(int material, const std::string& node) {
  const std::pair key(material, material < 0 ? node : std::string());
  const auto found = m_materials.find(key);
  if (found != m_materials.end()) return found->second;
  m_model.materials.push_back(read(material, node));
  const auto index = static_cast<std::uint32_t>(m_model.materials.size() - 1);
  m_materials.emplace(key, index);
  return index;
}

int MaterialReader::texCoord(int material) const {
  if (material < 0) return 0;
  const auto& info =
      m_document.model.materials[static_cast<std::size_t>(material)].pbrMetallicRoughness.baseColorTexture;
  const tinygltf::Value* transform = transformOf(info);
  if (transform != nullptr && transform->Has("texCoord")) return transform->Get("texCoord").GetNumberAsInt();
  return info.texCoord;
}

Material MaterialReader::read(int material, const std::string& node) {
  Material result;
  result.name = node.empty() ? "default" : node;
  result.doubleSided = false;
  if (material >= 0) result = fromGltf(material);
  if (m_override) applyOverride(result);
  return result;
}

Material MaterialReader::fromGltf(int index) {
  const tinygltf::Material& source = m_document.model.materials[static_cast<std::size_t>(index)];
  Material material;
  material.name = source.name;
  material.doubleSided = source.doubleSided;
  const std::vector<double>& factor = source.pbrMetallicRoughness.baseColorFactor;
  for (int c = 0; c < 4 && factor.size() == 4; ++c) {
    material.baseColour[c] = static_cast<float>(std::clamp(factor[static_cast<std::size_t>(c)], 0.0, 1.0));
  }
  if (source.alphaMode == "MASK") material.alphaMode = AlphaMode::Mask;
  if (source.alphaMode == "BLEND") material.alphaMode = AlphaMode::Blend;
  material.alphaCutoff = static_cast<float>(std::max(source.alphaCutoff, 0.0));
  material.optics = opticsFrom(source.extras);
  material.texture = textureOf(source.pbrMetallicRoughness.baseColorTexture, material);
  return material;
}

void MaterialReader::applyOverride(Material& material) {
  material.optics = m_override->optics;
  if (m_override->alphaCutoff) {
    material.alphaMode = AlphaMode::Mask;
    material.alphaCutoff = static_cast<float>(*m_override->alphaCutoff);
  }
  const glm::vec3 colour = m_override->baseColour ? glm::vec3(*m_override->baseColour) : glm::vec3(material.baseColour);
  material.baseColour = glm::vec4(colour * static_cast<float>(m_override->brightness), material.baseColour.a);
  if (!m_override->baseColour) return;
  if (material.alphaMode == AlphaMode::Opaque || material.texture < 0) {
    material.texture = -1;
    return;
  }
  // The texture's colour goes, its alpha (the leaf's outline) stays.
  const auto [found, isNew] = m_whitened.try_emplace(material.texture, -1);
  if (isNew) {
    image::Image copy = m_model.textures[static_cast<std::size_t>(material.texture)];
    const auto channels = static_cast<std::size_t>(copy.channels);
    const std::size_t colours = channels % 2 == 0 ? channels - 1 : channels;
    for (std::size_t p = 0; p < copy.pixels.size(); p += channels) {
      std::fill_n(copy.pixels.begin() + static_cast<std::ptrdiff_t>(p), colours, 1.0f);
    }
    m_model.textures.push_back(std::move(copy));
    found->second = static_cast<int>(m_model.textures.size() - 1);
  }
  material.texture = found->second;
}

int MaterialReader::textureOf(const tinygltf::TextureInfo& info, Material& material) {
  if (info.index < 0) return -1;
  const tinygltf::Texture& texture = m_document.model.textures[static_cast<std::size_t>(info.index)];
  if (texture.source < 0) {
    m_model.warnings.push_back("textures[" + std::to_string(info.index) +
                               "] names no image that can be read; the material's plain colour is used");
    return -1;
  }
  if (texture.sampler >= 0) {
    const tinygltf::Sampler& sampler = m_document.model.samplers[static_cast<std::size_t>(texture.sampler)];
    material.wrapS = sampler.wrapS != TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE;
    material.wrapT = sampler.wrapT != TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE;
    if (sampler.wrapS == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT ||
        sampler.wrapT == TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT) {
      m_model.warnings.push_back("samplers[" + std::to_string(texture.sampler) +
                                 "]: mirrored repeat is read as repeat");
    }
  }
  if (const tinygltf::Value* transform = transformOf(info)) material.uvFromMesh = uvTransform(*transform);
  return image(texture.source).value_or(-1);
}

std::optional<int> MaterialReader::image(int index) {
  const auto [found, isNew] = m_images.try_emplace(index, std::nullopt);
  if (!isNew) return found->second;
  Result<image::Image> read = readImageOf(index);
  if (read.ok()) {
    m_model.textures.push_back(std::move(read).value());
    found->second = static_cast<int>(m_model.textures.size() - 1);
  } else {
    m_model.warnings.push_back("images[" + std::to_string(index) + "]: " + read.error().text() +
                               " The material's plain colour is used.");
  }
  return found->second;
}

Result<image::Image> MaterialReader::readImageOf(int index) const {
  const std::string& uri = m_document.imageUris[static_cast<std::size_t>(index)];
  const int view = m_document.model.images[static_cast<std::size_t>(index)].bufferView;
  const std::string name = "images[" + std::to_string(index) + "]";
  if (isDataUri(uri)) {
    SWARD_ASSIGN(const std::vector<std::byte> bytes, decodeDataUri(uri));
    return image::readImage(bytes, name);
  }
  if (!uri.empty()) {
    SWARD_ASSIGN(const std::filesystem::path path, resolveUri(m_document.folder, uri));
    return image::readImage(path);
  }
  if (view < 0) return Error::badInput("the image has neither a URI nor a buffer view", name, "Export the file again.");
  SWARD_ASSIGN(const std::span<const std::byte> bytes, bufferViewBytes(m_document, view));
  return image::readImage(bytes, name);
}

}  // namespace sward::mesh
