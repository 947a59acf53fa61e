#pragma once

#include "image/image.h"
#include "mesh/options.h"

#include <cstdint>
#include <string>
#include <vector>

#include <glm/glm.hpp>

namespace sward::mesh {

enum class AlphaMode : std::uint8_t { Opaque, Mask, Blend };

struct Material {
  std::string name;
  glm::vec4 baseColour{1.0f};       ///< linear RGB factor and alpha, multiplied with texture and vertex colour
  int texture = -1;                 ///< index into Model::textures, RGB(A) linear, straight alpha; -1: none
  glm::mat3 uvFromMesh{1.0f};       ///< KHR_texture_transform: texture uv = uvFromMesh * (u, v, 1)
  bool wrapS = true, wrapT = true;  ///< repeat, else clamp
  AlphaMode alphaMode = AlphaMode::Opaque;
  float alphaCutoff = 0.5f;  ///< for Mask
  bool doubleSided = true;
  LeafOptics optics;
};

/// Triangles with materials, z up, metres, the foot at the origin (z = 0 is the ground).
/// All vertex arrays have the same length; uvs and colours are filled with 0 and 1 where the source has none.
struct Model {
  std::string name;
  std::vector<glm::vec3> positions;
  std::vector<glm::vec3> normals;  ///< unit length
  std::vector<glm::vec2> uvs;
  std::vector<glm::vec4> colours;  ///< linear RGB and alpha
  std::vector<glm::uvec3> triangles;
  std::vector<std::uint32_t> triangleMaterial;  ///< index into materials, one a triangle
  std::vector<Material> materials;              ///< at least one when there are triangles
  std::vector<image::Image> textures;
  std::vector<std::string> warnings;  ///< what the reader repaired or left out, for people

  bool empty() const { return triangles.empty(); }
};

struct Bounds {
  glm::vec3 low{0.0f};
  glm::vec3 high{0.0f};
};
/// Box of the vertices that triangles use; zero for an empty model.
Bounds bounds(const Model& model);

/// What one point of a surface does to light.
struct SurfaceSample {
  glm::vec3 reflectance{0.0f};
  glm::vec3 transmittance{0.0f};
  float alpha = 1.0f;  ///< 1 for Opaque; 0 or 1 for Mask; the product of factor, texture and vertex alpha for Blend
};
/// Surface of a triangle at barycentric (u, v) (Embree's: point = (1-u-v) a + u b + v c); texture filtered bilinearly.
SurfaceSample surfaceAt(const Model& model, std::uint32_t triangle, float u, float v);
/// The alpha alone, cheaper; calls no texture for opaque materials.
float alphaAt(const Model& model, std::uint32_t triangle, float u, float v);
/// True when some triangle may be less than opaque.
bool hasAlpha(const Model& model);

}  // namespace sward::mesh
