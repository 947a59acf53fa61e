#pragma once

#include "mesh/gltf_document.h"
#include "mesh/model.h"

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sward::mesh {

/// Turns glTF materials into ours on first use, with the images that they need; a missing or unreadable image becomes a
/// warning and the material keeps its factor.
class MaterialReader {
 public:
  MaterialReader(GltfDocument& document, Model& model, const std::optional<MaterialOverride>& override)
      : m_document(document), m_model(model), m_override(override) {}

  /// Index into Model::materials of glTF material `material`; -1 is glTF's default material, of which every node has
  /// its own, with its name: where a file has no materials, nodes tell trunk and leaves apart.
  std::uint32_t use(int material, const std::string& node);
  /// Which TEXCOORD_n set its base-colour texture reads.
  int texCoord(int material) const;

 private:
  Material read(int material, const std::string& node);
  Material fromGltf(int material);
  void applyOverride(Material& material);
  int textureOf(const tinygltf::TextureInfo& info, Material& material);
  std::optional<int> image(int index);
  Result<image::Image> readImageOf(int index) const;

  GltfDocument& m_document;
  Model& m_model;
  const std::optional<MaterialOverride>& m_override;
  std::map<std::pair<int, std::string>, std::uint32_t> m_materials;  ///< the name for the default material alone
  std::map<int, std::optional<int>> m_images;
  std::map<int, int> m_whitened;  ///< texture -> its copy with white colour
};

}  // namespace sward::mesh
