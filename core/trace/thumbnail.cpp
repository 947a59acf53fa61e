#include "trace/thumbnail.h"

#include "base/parallel.h"
#include "base/random.h"
#include "image/colour.h"
#include "trace/model_scene.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace sward::trace {
namespace {

constexpr float kPi = std::numbers::pi_v<float>;
constexpr float kInfinity = std::numeric_limits<float>::infinity();
// Bright, since leaves are dark and thin; what is white stays below white by the exponential below.
const glm::vec3 kSunIrradiance = 6.5f * glm::vec3(1.0f, 0.95f, 0.86f);
const glm::vec3 kSkyRadiance = 1.1f * glm::vec3(0.86f, 0.95f, 1.05f);
constexpr float kGroundShadow = 0.32f;  ///< alpha of a full shadow on the ground

/// Orthographic, framed on the vertices as they are seen.
struct View {
  glm::vec3 right, up, back;  ///< back: toward the viewer
  glm::vec2 middle{0.0f};     ///< along right and up
  float halfWidth = 1.0f;     ///< metres, of the whole picture
  float nearest = 0.0f;       ///< of the vertices along back
  float extent = 1.0f;        ///< metres, of the model
  float ground = 0.0f;        ///< height of the lowest vertex

  View(const mesh::Model& model, const ThumbnailOptions& options) {
    const double turn = options.turnDeg * std::numbers::pi / 180.0, above = options.aboveDeg * std::numbers::pi / 180.0;
    back = glm::vec3(glm::dvec3(std::sin(turn) * std::cos(above), -std::cos(turn) * std::cos(above), std::sin(above)));
    right = glm::vec3(glm::dvec3(std::cos(turn), std::sin(turn), 0.0));
    up = glm::cross(back, right);
    glm::vec3 low(kInfinity), high(-kInfinity);
    ground = kInfinity;
    for (const glm::uvec3& corner : model.triangles) {
      for (int k = 0; k < 3; ++k) {
        const glm::vec3& p = model.positions[corner[k]];
        const glm::vec3 seen(glm::dot(p, right), glm::dot(p, up), glm::dot(p, back));
        low = glm::min(low, seen);
        high = glm::max(high, seen);
        ground = std::min(ground, p.z);
      }
    }
    middle = 0.5f * (glm::vec2(low) + glm::vec2(high));
    const float largest = std::max({high.x - low.x, high.y - low.y, 1e-6f});
    halfWidth = 0.5f * largest / (1.0f - 2.0f * static_cast<float>(options.marginShare));
    nearest = high.z;
    extent = std::max(largest, high.z - low.z);
  }
  /// x to the right and y up, in [-1, 1].
  glm::vec3 origin(float x, float y) const {
    return (middle.x + x * halfWidth) * right + (middle.y + y * halfWidth) * up + (nearest + extent) * back;
  }
};

/// Linear colour premultiplied with alpha.
using Sample = glm::vec4;

class Painter {
 public:
  Painter(const mesh::Model& model, const ModelScene& scene, const View& view)
      : m_model(model), m_scene(scene), m_view(view) {
    // From over the viewer's left shoulder, so that most of what is seen is lit and shadows fall to the right.
    m_sun = glm::normalize(0.55f * view.back - 0.62f * view.right + glm::vec3(0.0f, 0.0f, 0.85f));
    m_offset = 1e-4f * view.extent;
  }

  Sample sample(float x, float y, std::uint64_t bits) const {
    const glm::vec3 origin = m_view.origin(x, y);
    const ModelScene::Found found = m_scene.nearest(origin, -m_view.back, 0.0f, base::unitFloat(bits));
    if (found.any) return {shade(origin - found.t * m_view.back, found, bits), 1.0f};
    if (m_view.back.z <= 0.05f) return Sample(0.0f);
    const float toGround = (origin.z - m_view.ground) / m_view.back.z;
    const glm::vec3 place = origin - toGround * m_view.back;
    return {0.0f, 0.0f, 0.0f, sunlit(place, bits) ? 0.0f : kGroundShadow};
  }

 private:
  bool sunlit(const glm::vec3& place, std::uint64_t bits) const {
    // A soft edge: the sun's direction varies by some degrees.
    const float a = 2.0f * kPi * base::unitFloat(base::mix64(bits, 1)),
                r = 0.06f * std::sqrt(base::unitFloat(base::mix64(bits, 2)));
    const glm::vec3 across = glm::normalize(glm::cross(m_sun, glm::vec3(0.0f, 0.0f, 1.0f)));
    const glm::vec3 toSun =
        glm::normalize(m_sun + r * (std::cos(a) * across + std::sin(a) * glm::cross(m_sun, across)));
    return !m_scene.nearest(place, toSun, m_offset, base::unitFloat(base::mix64(bits, 3))).any;
  }

  glm::vec3 shade(const glm::vec3& place, const ModelScene::Found& found, std::uint64_t bits) const {
    const glm::uvec3 c = m_model.triangles[found.triangle];
    glm::vec3 normal = (1.0f - found.u - found.v) * m_model.normals[c.x] + found.u * m_model.normals[c.y] +
                       found.v * m_model.normals[c.z];
    const float length = glm::length(normal);
    normal = length > 1e-6f ? normal / length : m_view.back;
    if (glm::dot(normal, m_view.back) < 0.0f) normal = -normal;
    const float cosine = glm::dot(normal, m_sun);
    const glm::vec3& passed = cosine > 0.0f ? found.surface.reflectance : found.surface.transmittance;
    glm::vec3 light(0.0f);
    if (sunlit(place, bits)) light = passed * kSunIrradiance * (std::abs(cosine) / kPi);
    // The sky's half that the side sees, darker toward the ground, where neighbours would stand.
    const float sky = 0.5f + 0.5f * normal.z;
    const float height = std::clamp((place.z - m_view.ground) / m_view.extent, 0.0f, 1.0f);
    return light + (found.surface.reflectance * sky + found.surface.transmittance * (1.0f - sky)) * kSkyRadiance *
                       (0.55f + 0.45f * height);
  }

  const mesh::Model& m_model;
  const ModelScene& m_scene;
  const View& m_view;
  glm::vec3 m_sun{0.0f, 0.0f, 1.0f};
  float m_offset = 0.0f;
};

std::uint8_t byteOf(float value) {
  return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0f, 1.0f) * 255.0f));
}

void drawRow(const Painter& painter, int y, int samplesPerSide, Thumbnail& out) {
  const int across = samplesPerSide;
  const auto size = static_cast<float>(out.size);
  for (int x = 0; x < out.size; ++x) {
    Sample sum(0.0f);
    for (int s = 0; s < across * across; ++s) {
      const std::uint64_t bits =
          base::mix64(static_cast<std::uint64_t>(y), static_cast<std::uint64_t>(x), static_cast<std::uint64_t>(s));
      const float u = (static_cast<float>(s % across) + base::unitFloat(bits << 24)) / static_cast<float>(across);
      const float v = (static_cast<float>(s / across) + base::unitFloat(bits << 40)) / static_cast<float>(across);
      sum += painter.sample(2.0f * (static_cast<float>(x) + u) / size - 1.0f,
                            1.0f - 2.0f * (static_cast<float>(y) + v) / size, bits);
    }
    sum /= static_cast<float>(across * across);
    std::uint8_t* pixel = out.rgba.data() + 4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(out.size) +
                                                 static_cast<std::size_t>(x));
    const glm::vec3 straight = sum.a > 0.0f ? glm::vec3(sum) / sum.a : glm::vec3(0.0f);
    for (int k = 0; k < 3; ++k) pixel[k] = byteOf(image::srgbFromLinear(1.0f - std::exp(-straight[k])));
    pixel[3] = byteOf(sum.a);
  }
}

}  // namespace

Result<Thumbnail> drawThumbnail(const mesh::Model& model, const ThumbnailOptions& options, const JobContext& job) {
  if (options.size < 8 || options.size > 1024 || options.samplesPerSide < 1 || options.samplesPerSide > 16) {
    return Error::badInput("a thumbnail of " + std::to_string(options.size) + " pixels a side and " +
                               std::to_string(options.samplesPerSide) + " samples along a pixel",
                           "thumbnail", "Use 8 to 1024 pixels and 1 to 16 samples.");
  }
  Thumbnail out;
  out.size = options.size;
  out.rgba.assign(static_cast<std::size_t>(options.size) * static_cast<std::size_t>(options.size) * 4, 0);
  if (model.empty()) return out;
  SWARD_ASSIGN(const ModelScene scene, ModelScene::create(model));
  const View view(model, options);
  const Painter painter(model, scene, view);
  base::parallelFor(job, static_cast<std::size_t>(options.size), 4, [&](std::size_t begin, std::size_t end) {
    for (std::size_t y = begin; y < end; ++y) drawRow(painter, static_cast<int>(y), options.samplesPerSide, out);
  });
  if (job.cancelled()) return Error::cancelled();
  return out;
}

}  // namespace sward::trace
