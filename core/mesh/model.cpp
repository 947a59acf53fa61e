#include "mesh/model.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sward::mesh {
namespace {

int wrapIndex(int index, int size, bool repeat) {
  if (!repeat) return std::clamp(index, 0, size - 1);
  const int rest = index % size;
  return rest < 0 ? rest + size : rest;
}

/// One texel as RGBA; grey images repeat their value.
glm::vec4 texel(const image::Image& image, int x, int y) {
  const float* p = image.pixels.data() + image.offset(x, y);
  switch (image.channels) {
    case 1:
      return {p[0], p[0], p[0], 1.0f};
    case 2:
      return {p[0], p[0], p[0], p[1]};
    case 3:
      return {p[0], p[1], p[2], 1.0f};
    default:
      return {p[0], p[1], p[2], p[3]};
  }
}

/// Where a bilinear look-up falls: two columns or rows and the weight of the second.
struct Tap {
  int first = 0;
  int second = 0;
  float weight = 0.0f;
};

Tap tapAt(float coordinate, int size, bool repeat) {
  if (!std::isfinite(coordinate)) return {};
  // Repeating is done before scaling so that far coordinates keep their fraction; clamping bounds the cast.
  const float unit = repeat ? coordinate - std::floor(coordinate) : std::clamp(coordinate, 0.0f, 1.0f);
  const float at = unit * static_cast<float>(size) - 0.5f;
  const float low = std::floor(at);
  const int index = static_cast<int>(low);
  return {wrapIndex(index, size, repeat), wrapIndex(index + 1, size, repeat), at - low};
}

/// Bilinear look-up, uv (0, 0) at the upper left corner of the image. Colours are weighted by alpha, so that the colour
/// hidden in transparent texels does not bleed into a leaf's edge.
glm::vec4 sampleTexture(const image::Image& image, const Material& material, const glm::vec2& uv) {
  if (image.empty()) return glm::vec4(1.0f);
  const Tap tx = tapAt(uv.x, image.width, material.wrapS);
  const Tap ty = tapAt(uv.y, image.height, material.wrapT);
  const glm::vec4 corners[4] = {texel(image, tx.first, ty.first), texel(image, tx.second, ty.first),
                                texel(image, tx.first, ty.second), texel(image, tx.second, ty.second)};
  const float weights[4] = {(1.0f - tx.weight) * (1.0f - ty.weight), tx.weight * (1.0f - ty.weight),
                            (1.0f - tx.weight) * ty.weight, tx.weight * ty.weight};
  glm::vec3 plain(0.0f), weighted(0.0f);
  float alpha = 0.0f;
  for (int i = 0; i < 4; ++i) {
    plain += weights[i] * glm::vec3(corners[i]);
    weighted += weights[i] * corners[i].a * glm::vec3(corners[i]);
    alpha += weights[i] * corners[i].a;
  }
  const glm::vec3 colour = alpha > 0.0f ? weighted / alpha : plain;
  return {colour, alpha};
}

/// Base colour and alpha before the alpha mode: factor times texture times vertex colour.
glm::vec4 baseColourAt(const Model& model, const Material& material, std::uint32_t triangle, float u, float v) {
  const glm::uvec3 corner = model.triangles[triangle];
  const float w = 1.0f - u - v;
  glm::vec4 colour =
      material.baseColour * (w * model.colours[corner.x] + u * model.colours[corner.y] + v * model.colours[corner.z]);
  if (material.texture >= 0) {
    const glm::vec2 uv = w * model.uvs[corner.x] + u * model.uvs[corner.y] + v * model.uvs[corner.z];
    const glm::vec2 place = glm::vec2(material.uvFromMesh * glm::vec3(uv, 1.0f));
    colour *= sampleTexture(model.textures[static_cast<std::size_t>(material.texture)], material, place);
  }
  return colour;
}

float alphaFrom(const Material& material, float product) {
  switch (material.alphaMode) {
    case AlphaMode::Opaque:
      return 1.0f;
    case AlphaMode::Mask:
      return product >= material.alphaCutoff ? 1.0f : 0.0f;
    case AlphaMode::Blend:
      return std::clamp(product, 0.0f, 1.0f);
  }
  return 1.0f;
}

const Material& materialOf(const Model& model, std::uint32_t triangle) {
  return model.materials[model.triangleMaterial[triangle]];
}

}  // namespace

Bounds bounds(const Model& model) {
  if (model.triangles.empty()) return {};
  Bounds box{glm::vec3(std::numeric_limits<float>::max()), glm::vec3(std::numeric_limits<float>::lowest())};
  for (const glm::uvec3& triangle : model.triangles) {
    for (int i = 0; i < 3; ++i) {
      box.low = glm::min(box.low, model.positions[triangle[i]]);
      box.high = glm::max(box.high, model.positions[triangle[i]]);
    }
  }
  return box;
}

SurfaceSample surfaceAt(const Model& model, std::uint32_t triangle, float u, float v) {
  const Material& material = materialOf(model, triangle);
  const glm::vec4 base = baseColourAt(model, material, triangle, u, v);
  SurfaceSample sample;
  sample.alpha = alphaFrom(material, base.a);
  const glm::vec3 tint(material.optics.transmissionTint);
  const auto translucency = static_cast<float>(material.optics.translucency);
  for (int c = 0; c < 3; ++c) {
    const float r = std::clamp(base[c], 0.0f, 1.0f);
    const float t = std::max(translucency * tint[c] * r, 0.0f);
    const float scale = r + t > 1.0f ? 1.0f / (r + t) : 1.0f;
    sample.reflectance[c] = r * scale;
    sample.transmittance[c] = t * scale;
  }
  return sample;
}

float alphaAt(const Model& model, std::uint32_t triangle, float u, float v) {
  const Material& material = materialOf(model, triangle);
  if (material.alphaMode == AlphaMode::Opaque) return 1.0f;
  return alphaFrom(material, baseColourAt(model, material, triangle, u, v).a);
}

bool hasAlpha(const Model& model) {
  return std::any_of(model.triangleMaterial.begin(), model.triangleMaterial.end(),
                     [&](std::uint32_t index) { return model.materials[index].alphaMode != AlphaMode::Opaque; });
}

}  // namespace sward::mesh
