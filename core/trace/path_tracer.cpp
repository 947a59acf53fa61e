#include "trace/path_tracer.h"

#include "base/random.h"
#include "scene/ground_look.h"
#include "trace/fast_floor.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace sward::trace {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kFarM = 5.0e4;  ///< rays end here: from eye height, a thousandth of a pixel under the horizon
constexpr double kMetresPerKilometre = 1000.0;
constexpr double kLowestEyeM = 1e-3;

/// Pairs of numbers of a sample's sequence.
constexpr std::uint32_t kPixelPair = 0, kPrimaryUse = 0;
constexpr std::uint32_t pairOf(int bounce, std::uint32_t use) {
  return 1 + 4 * static_cast<std::uint32_t>(bounce) + use;
}
constexpr std::uint32_t kSunUse = 0, kSkyUse = 1, kScatterUse = 2, kLobeUse = 3;

/// A tent over [-1, 1] from a uniform number (its inverse distribution).
double tent(double u) {
  return u < 0.5 ? std::sqrt(2.0 * u) - 1.0 : 1.0 - std::sqrt(2.0 - 2.0 * u);
}

/// Cosine-distributed over the hemisphere about `normal` (Malley): density cos / pi.
glm::dvec3 cosineDirection(const glm::dvec3& normal, const glm::dvec2& u) {
  const double radius = std::sqrt(u.x), turn = 2.0 * kPi * u.y;
  const glm::dvec3 guide = std::abs(normal.z) < 0.7 ? glm::dvec3(0.0, 0.0, 1.0) : glm::dvec3(1.0, 0.0, 0.0);
  const glm::dvec3 across = glm::normalize(glm::cross(guide, normal));
  const glm::dvec3 along = glm::cross(normal, across);
  return glm::normalize(radius * (std::cos(turn) * across + std::sin(turn) * along) +
                        std::sqrt(std::max(0.0, 1.0 - u.x)) * normal);
}

double largest(const glm::dvec3& v) {
  return std::max({v.x, v.y, v.z});
}

}  // namespace

PathTracer::PathTracer(const PathScene& scene)
    : m_scene(scene),
      m_patch(scene.scene.patch->impl()),
      m_eye(scene.camera.position),
      m_topM(static_cast<double>(m_patch.height + m_patch.offset)),
      m_hazePerM(scene.scene.hazeKm > 0.0 ? 1.0 / (scene.scene.hazeKm * kMetresPerKilometre) : 0.0),
      m_rays(m_patch) {
  m_eye.z = std::max(m_eye.z, kLowestEyeM);
}

std::uint32_t PathTracer::Draw::rayId(std::uint32_t use) const {
  return static_cast<std::uint32_t>(base::mix64(seed + use) >> 32);
}

glm::dvec3 PathTracer::trace(int x, int y, int sample) {
  const auto pixel =
      static_cast<std::uint64_t>(y) * static_cast<std::uint64_t>(m_scene.options.width) + static_cast<std::uint64_t>(x);
  const std::uint64_t seed = base::mix64(m_scene.options.seed, pixel, static_cast<std::uint64_t>(sample % kSequences));
  const auto index = static_cast<std::uint32_t>(sample / kSequences);
  const Draw draw{SampleSequence(seed, index), base::mix64(seed, index)};
  const glm::dvec3 d = cameraDirection(x, y, draw);
  const double exposure = m_scene.options.exposure;
  double enter = 0.0;
  if (m_eye.z > m_topM) {
    if (d.z >= 0.0) return exposure * background(d);
    enter = (m_topM - m_eye.z) / d.z;
  }
  if (!(enter < kFarM)) return exposure * m_scene.horizon.at(glm::dvec2(d));
  Vertex vertex;
  switch (follow(firstLeg(d, enter), draw.rayId(kPrimaryUse), vertex)) {
    case End::Above:
      return exposure * background(d);
    case End::Far:
      return exposure * m_scene.horizon.at(glm::dvec2(d));
    case End::Surface:
      break;
  }
  const glm::dvec3 radiance = pathFrom(vertex, draw);
  const double clear = std::exp(-m_hazePerM * enter);
  return exposure * (clear < 1.0 ? glm::mix(m_scene.horizon.at(glm::dvec2(d)), radiance, clear) : radiance);
}

glm::dvec3 PathTracer::cameraDirection(int x, int y, const Draw& draw) const {
  glm::dvec2 place = draw.sequence.pair(kPixelPair);
  if (m_scene.options.filter == PixelFilter::Tent) place = glm::dvec2(0.5 + tent(place.x), 0.5 + tent(place.y));
  const double width = m_scene.options.width, height = m_scene.options.height;
  return m_scene.camera.rayDirection((x + place.x) / width, (y + place.y) / height, width / height);
}

glm::dvec3 PathTracer::background(const glm::dvec3& direction) const {
  const scene::Daylight& daylight = m_scene.scene.daylight;
  const glm::dvec3 sky = m_scene.scene.uniformSky ? *m_scene.scene.uniformSky : daylight.skyRadiance(direction);
  const double angle = glm::length(direction - daylight.sunDirection());  // the chord: accurate for small angles
  return sky + daylight.sunIrradiance() * (scene::kSunDiscGain * scene::sunDiscShare(angle));
}

PathTracer::Leg PathTracer::firstLeg(const glm::dvec3& direction, double enterM) const {
  const glm::dvec2 bentAt = glm::dvec2(m_eye) + std::max(enterM, scene::kNearestM) * glm::dvec2(direction);
  Leg leg;
  leg.direction = direction;
  leg.origin = m_eye + enterM * direction + glm::dvec3(scene::gridBend(bentAt, m_scene.options.gridBendM), 0.0);
  leg.end = endOf(leg.origin, direction);
  return leg;
}

/// Distance to the soil or the shell's top.
double PathTracer::endOf(const glm::dvec3& origin, const glm::dvec3& direction) const {
  const double rise = direction.z < 0.0 ? -origin.z : static_cast<double>(m_patch.height) - origin.z;
  return std::min(direction.z != 0.0 ? rise / direction.z : kFarM, kFarM);
}

PathTracer::End PathTracer::follow(const Leg& leg, std::uint32_t rayId, Vertex& vertex) {
  const GroundWalk walk = leg.tiled ? GroundWalk(m_scene.ground, leg.origin, leg.direction, leg.end)
                                    : GroundWalk(m_scene.ground, leg.origin, leg.direction, leg.end, leg.shift);
  const GroundHit hit = m_rays.nearest(walk, leg.direction, leg.start, rayId);
  if (hit.any) {
    vertex = leafAt(leg, hit);
    return End::Surface;
  }
  if (hit.givenUp || leg.end >= kFarM) return End::Far;
  if (leg.direction.z >= 0.0) return End::Above;
  vertex = soilAt(leg);
  return End::Surface;
}

PathTracer::Vertex PathTracer::leafAt(const Leg& leg, const GroundHit& hit) const {
  const scene::Patch& patch = *m_patch.patch;
  const mesh::Model& model = *patch.models[patch.instances[hit.raw.surface.instance].model];
  const mesh::SurfaceSample surface = mesh::surfaceAt(model, hit.raw.surface.triangle, hit.raw.u, hit.raw.v);
  Vertex vertex;
  vertex.position = leg.origin + hit.t * leg.direction;
  vertex.position.z = std::max(vertex.position.z, 0.0);
  vertex.normal = viewerNormal(patch, hit.raw, glm::vec3(leg.direction));
  vertex.reflectance = surface.reflectance;
  vertex.transmittance = surface.transmittance;
  vertex.shift = hit.shift;
  return vertex;
}

PathTracer::Vertex PathTracer::soilAt(const Leg& leg) const {
  Vertex vertex;
  vertex.position = leg.origin + leg.end * leg.direction;
  vertex.position.z = 0.0;
  vertex.normal = {0.0, 0.0, 1.0};
  const std::int64_t side = m_scene.ground.patchTexels();
  const std::int64_t x = floorOf(vertex.position.x / m_scene.ground.texelM());
  const std::int64_t y = floorOf(vertex.position.y / m_scene.ground.texelM());
  vertex.shift = leg.tiled ? m_scene.ground.shiftAt(x, y) : leg.shift;
  const auto wrap = [side](std::int64_t v) { return static_cast<std::size_t>((v % side + side) % side); };
  const std::size_t texel = wrap(y + vertex.shift.y) * static_cast<std::size_t>(side) + wrap(x + vertex.shift.x);
  vertex.reflectance = m_scene.scene.soil[texel];
  return vertex;
}

// What is lit along its plane or passes nothing on asks for no ray.
glm::dvec3 PathTracer::lightFrom(const Vertex& vertex, const LightSample& light, std::uint32_t rayId) {
  const double cosine = glm::dot(vertex.normal, light.direction);
  const glm::dvec3& passed = cosine > 0.0 ? vertex.reflectance : vertex.transmittance;
  const glm::dvec3 radiance = passed * light.weight * (std::abs(cosine) / kPi);
  if (!(largest(radiance) > 0.0)) return glm::dvec3(0.0);
  const double end = endOf(vertex.position, light.direction);
  const GroundWalk walk = m_scene.options.shadows == ShadowGround::Tiled
                              ? GroundWalk(m_scene.ground, vertex.position, light.direction, end)
                              : GroundWalk(m_scene.ground, vertex.position, light.direction, end, vertex.shift);
  return m_rays.occluded(walk, light.direction, m_patch.offset, rayId) ? glm::dvec3(0.0) : radiance;
}

glm::dvec3 PathTracer::gather(const Vertex& vertex, const Draw& draw, int bounce) {
  glm::dvec3 radiance(0.0);
  if (!m_scene.sun.dark()) {
    const std::uint32_t use = pairOf(bounce, kSunUse);
    radiance += lightFrom(vertex, m_scene.sun.sample(draw.sequence.pair(use)), draw.rayId(use));
  }
  if (m_scene.options.sky && !m_scene.sky.dark()) {
    const std::uint32_t use = pairOf(bounce, kSkyUse);
    radiance += lightFrom(vertex, m_scene.sky.sample(draw.sequence.pair(use)), draw.rayId(use));
  }
  return radiance;
}

// Reflected or transmitted by lot, by the larger of each one's colours; then cosine-distributed, density cos / pi.
std::optional<PathTracer::Leg> PathTracer::scatter(const Vertex& vertex, const Draw& draw, int bounce,
                                                   glm::dvec3& throughput) const {
  const double reflected = largest(vertex.reflectance), transmitted = largest(vertex.transmittance);
  if (!(reflected + transmitted > 0.0)) return std::nullopt;
  const double chance = reflected / (reflected + transmitted);
  const bool reflects = draw.sequence.pair(pairOf(bounce, kLobeUse)).x < chance;
  throughput *= reflects ? vertex.reflectance / chance : vertex.transmittance / (1.0 - chance);
  Leg leg;
  leg.origin = vertex.position;
  leg.direction =
      cosineDirection(reflects ? vertex.normal : -vertex.normal, draw.sequence.pair(pairOf(bounce, kScatterUse)));
  leg.end = endOf(leg.origin, leg.direction);
  leg.tiled = m_scene.options.shadows == ShadowGround::Tiled;
  leg.shift = vertex.shift;
  leg.start = m_patch.offset;
  return leg;
}

// Light of sun and sky is gathered at each vertex, so a leg that leaves the shell brings nothing more.
glm::dvec3 PathTracer::pathFrom(Vertex vertex, const Draw& draw) {
  glm::dvec3 radiance(0.0), throughput(1.0);
  for (int bounce = 0;; ++bounce) {
    radiance += throughput * gather(vertex, draw, bounce);
    if (bounce >= m_scene.options.bounces) return radiance;
    const std::optional<Leg> leg = scatter(vertex, draw, bounce, throughput);
    if (!leg || follow(*leg, draw.rayId(pairOf(bounce, kScatterUse)), vertex) != End::Surface) return radiance;
  }
}

}  // namespace sward::trace
