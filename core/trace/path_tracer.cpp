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
constexpr int kBlock = 4;        ///< pixels along the side of a packet's block
constexpr double kFarM = 5.0e4;  ///< rays end here: from eye height, a thousandth of a pixel under the horizon
constexpr double kMetresPerKilometre = 1000.0;
constexpr double kLowestEyeM = 1e-3;
const glm::ivec2 kNoShift{-1};  ///< of a primary ray, which sees the ground as it is tiled, whatever shadow rays do

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

PathTracer::PathTracer(const PathScene& scene) : m_scene(scene), m_patch(scene.scene.patch->impl()) {}

std::uint32_t PathTracer::rayId(std::uint32_t path, std::uint32_t use) const {
  return static_cast<std::uint32_t>(base::mix64(m_seeds[path] + use) >> 32);
}

const std::vector<glm::dvec3>& PathTracer::trace(const PixelTile& tile, int sample) {
  listPixels(tile);
  startPaths(sample);
  findVertices(kPrimaryUse);
  for (int bounce = 0; bounce <= m_scene.options.bounces && !m_vertices.empty(); ++bounce) {
    gather(bounce);
    if (bounce == m_scene.options.bounces) break;
    scatter(bounce);
    findVertices(pairOf(bounce, kScatterUse));
  }
  finish();
  return m_radiance;
}

void PathTracer::listPixels(const PixelTile& tile) {
  m_pixels.clear();
  for (int y0 = tile.y0; y0 < tile.y1; y0 += kBlock) {
    for (int x0 = tile.x0; x0 < tile.x1; x0 += kBlock) {
      for (int y = y0; y < std::min(y0 + kBlock, tile.y1); ++y) {
        for (int x = x0; x < std::min(x0 + kBlock, tile.x1); ++x) {
          m_pixels.push_back(static_cast<std::uint32_t>(y * m_scene.options.width + x));
        }
      }
    }
  }
}

glm::dvec3 PathTracer::cameraDirection(std::uint32_t path) const {
  const auto width = static_cast<std::uint32_t>(m_scene.options.width);
  glm::dvec2 place = m_sequences[path].pair(kPixelPair);
  if (m_scene.options.filter == PixelFilter::Tent) {
    place = glm::dvec2(0.5 + tent(place.x), 0.5 + tent(place.y));
  }
  const double x = m_pixels[path] % width + place.x, y = m_pixels[path] / width + place.y;
  const double height = m_scene.options.height;
  return m_scene.camera.rayDirection(x / width, y / height, width / height);
}

glm::dvec3 PathTracer::background(const glm::dvec3& direction) const {
  const scene::Daylight& daylight = m_scene.scene.daylight;
  const glm::dvec3 sky = m_scene.scene.uniformSky ? *m_scene.scene.uniformSky : daylight.skyRadiance(direction);
  const double angle = glm::length(direction - daylight.sunDirection());  // the chord: accurate for small angles
  return sky + daylight.sunIrradiance() * (scene::kSunDiscGain * scene::sunDiscShare(angle));
}

void PathTracer::startPaths(int sample) {
  m_sequences.clear();
  m_seeds.clear();
  m_legs.clear();
  m_radiance.assign(m_pixels.size(), glm::dvec3(0.0));
  m_azimuth.assign(m_pixels.size(), glm::dvec2(0.0));
  m_clear.assign(m_pixels.size(), -1.0);
  const auto sequence = static_cast<std::uint64_t>(sample % kSequences);
  const auto index = static_cast<std::uint32_t>(sample / kSequences);
  const double hazePerM = m_scene.scene.hazeKm > 0.0 ? 1.0 / (m_scene.scene.hazeKm * kMetresPerKilometre) : 0.0;
  const double height = m_scene.scene.patch->patch().heightM;
  glm::dvec3 eye = m_scene.camera.position;
  eye.z = std::max(eye.z, kLowestEyeM);
  for (std::uint32_t path = 0; path < m_pixels.size(); ++path) {
    const std::uint64_t seed = base::mix64(m_scene.options.seed, m_pixels[path], sequence);
    m_sequences.emplace_back(seed, index);
    m_seeds.push_back(base::mix64(seed, index));
    const glm::dvec3 d = cameraDirection(path);
    const bool above = eye.z > height;
    const double enter = above ? (d.z < 0.0 ? (height - eye.z) / d.z : std::numeric_limits<double>::infinity()) : 0.0;
    if (!(enter < kFarM)) {
      const bool ground = d.z < 0.0;
      m_radiance[path] = ground ? m_scene.horizon.at(glm::dvec2(d)) : background(d);
      continue;
    }
    m_azimuth[path] = glm::dvec2(d);
    m_clear[path] = std::exp(-hazePerM * enter);
    Leg leg;
    leg.path = path;
    leg.shift = kNoShift;
    leg.direction = d;
    leg.origin = eye + enter * d;
    const glm::dvec2 bentAt = glm::dvec2(eye) + std::max(enter, scene::kNearestM) * glm::dvec2(d);
    const glm::dvec2 bend = scene::gridBend(bentAt, m_scene.options.gridBendM);
    leg.origin += glm::dvec3(bend, 0.0);
    const double rise = d.z < 0.0 ? -leg.origin.z : static_cast<double>(m_patch.height) - leg.origin.z;
    leg.end = std::min(d.z != 0.0 ? rise / d.z : kFarM, kFarM);
    m_legs.push_back(leg);
  }
}

// Legs become vertices, or light of the background where they are primary.
void PathTracer::findVertices(std::uint32_t use) {
  const bool primary = use == kPrimaryUse;
  const bool tiled = primary || m_scene.options.shadows == ShadowGround::Tiled;
  m_nearest.clear();
  for (const Leg& leg : m_legs) {
    const GroundWalk walk = tiled ? GroundWalk(m_scene.ground, leg.origin, leg.direction, leg.end)
                                  : GroundWalk(m_scene.ground, leg.origin, leg.direction, leg.end, leg.shift);
    m_nearest.add(walk, leg.direction, primary ? 0.0f : m_patch.offset, rayId(leg.path, use));
  }
  m_nearest.traceNearest(m_patch, m_scene.ground,
                         primary ? RTC_INTERSECT_CONTEXT_FLAG_COHERENT : RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT);
  m_rays += m_legs.size();
  m_vertices.clear();
  for (std::size_t i = 0; i < m_legs.size(); ++i) {
    const Leg& leg = m_legs[i];
    const GroundHit& hit = m_nearest.hit(i);
    if (hit.any) {
      addLeaf(leg, hit);
    } else if (leg.direction.z < 0.0 && !hit.givenUp && leg.end < kFarM) {
      addSoil(leg);
    } else if (primary) {
      const bool up = leg.direction.z > 0.0 && !hit.givenUp && leg.end < kFarM;
      m_radiance[leg.path] = up ? background(leg.direction) : m_scene.horizon.at(glm::dvec2(leg.direction));
      m_clear[leg.path] = -1.0;
    }
  }
}

void PathTracer::addLeaf(const Leg& leg, const GroundHit& hit) {
  const scene::Patch& patch = *m_patch.patch;
  const mesh::Model& model = *patch.models[patch.instances[hit.raw.surface.instance].model];
  const mesh::SurfaceSample surface = mesh::surfaceAt(model, hit.raw.surface.triangle, hit.raw.u, hit.raw.v);
  Vertex vertex;
  vertex.path = leg.path;
  vertex.position = leg.origin + hit.t * leg.direction;
  vertex.position.z = std::max(vertex.position.z, 0.0);
  vertex.normal = viewerNormal(patch, hit.raw, glm::vec3(leg.direction));
  vertex.reflectance = surface.reflectance;
  vertex.transmittance = surface.transmittance;
  vertex.throughput = leg.throughput;
  vertex.shift = hit.shift;
  m_vertices.push_back(vertex);
}

void PathTracer::addSoil(const Leg& leg) {
  Vertex vertex;
  vertex.path = leg.path;
  vertex.position = leg.origin + leg.end * leg.direction;
  vertex.position.z = 0.0;
  vertex.normal = {0.0f, 0.0f, 1.0f};
  vertex.throughput = leg.throughput;
  const int side = m_scene.ground.patchTexels();
  const std::int64_t x = floorOf(vertex.position.x / m_scene.ground.texelM());
  const std::int64_t y = floorOf(vertex.position.y / m_scene.ground.texelM());
  const bool tiled = leg.shift == kNoShift || m_scene.options.shadows == ShadowGround::Tiled;
  vertex.shift = tiled ? m_scene.ground.shiftAt(x, y) : leg.shift;
  const auto wrap = [side](std::int64_t v) { return static_cast<std::size_t>((v % side + side) % side); };
  const std::size_t texel = wrap(y + vertex.shift.y) * static_cast<std::size_t>(side) + wrap(x + vertex.shift.x);
  vertex.reflectance = m_scene.scene.soil[texel];
  m_vertices.push_back(vertex);
}

GroundWalk PathTracer::walkFrom(const Vertex& vertex, const glm::dvec3& direction, double end) const {
  if (m_scene.options.shadows == ShadowGround::Tiled) {
    return GroundWalk(m_scene.ground, vertex.position, direction, end);
  }
  return GroundWalk(m_scene.ground, vertex.position, direction, end, vertex.shift);
}

// One shadow ray to each light; what is lit along its plane or passes nothing on asks for none.
void PathTracer::gatherFrom(const Vertex& vertex, const LightSample& light, GroundRays& rays, std::vector<Lit>& lit,
                            std::uint32_t use) {
  const double cosine = glm::dot(glm::dvec3(vertex.normal), light.direction);
  const glm::dvec3& passed = cosine > 0.0 ? vertex.reflectance : vertex.transmittance;
  const glm::dvec3 radiance = vertex.throughput * passed * light.weight * (std::abs(cosine) / kPi);
  if (!(largest(radiance) > 0.0)) return;
  const double rise = static_cast<double>(m_patch.height) - vertex.position.z;
  const double end = std::min(rise / std::max(light.direction.z, 1e-300), kFarM);
  rays.add(walkFrom(vertex, light.direction, end), light.direction, m_patch.offset, rayId(vertex.path, use));
  lit.push_back({vertex.path, radiance});
}

void PathTracer::gather(int bounce) {
  m_sunRays.clear();
  m_skyRays.clear();
  m_sunLit.clear();
  m_skyLit.clear();
  const bool sun = !m_scene.sun.dark(), sky = m_scene.options.sky && !m_scene.sky.dark();
  for (const Vertex& vertex : m_vertices) {
    const SampleSequence& sequence = m_sequences[vertex.path];
    if (sun) {
      const std::uint32_t use = pairOf(bounce, kSunUse);
      gatherFrom(vertex, m_scene.sun.sample(sequence.pair(use)), m_sunRays, m_sunLit, use);
    }
    if (sky) {
      const std::uint32_t use = pairOf(bounce, kSkyUse);
      gatherFrom(vertex, m_scene.sky.sample(sequence.pair(use)), m_skyRays, m_skyLit, use);
    }
  }
  m_sunRays.traceOcclusion(m_patch, m_scene.ground);
  m_skyRays.traceOcclusion(m_patch, m_scene.ground);
  m_rays += m_sunLit.size() + m_skyLit.size();
  addLit(m_sunRays, m_sunLit);
  addLit(m_skyRays, m_skyLit);
}

void PathTracer::addLit(const GroundRays& rays, const std::vector<Lit>& lit) {
  for (std::size_t i = 0; i < lit.size(); ++i) {
    if (!rays.hit(i).any) m_radiance[lit[i].path] += lit[i].radiance;
  }
}

// Vertices become legs: reflected or transmitted by lot, by the larger of each one's colours.
void PathTracer::scatter(int bounce) {
  m_legs.clear();
  for (const Vertex& vertex : m_vertices) {
    const double reflected = largest(vertex.reflectance), transmitted = largest(vertex.transmittance);
    if (!(reflected + transmitted > 0.0)) continue;
    const SampleSequence& sequence = m_sequences[vertex.path];
    const double chance = reflected / (reflected + transmitted);
    const bool reflects = sequence.pair(pairOf(bounce, kLobeUse)).x < chance;
    const glm::dvec3 normal(vertex.normal);
    Leg leg;
    leg.path = vertex.path;
    leg.origin = vertex.position;
    leg.direction = cosineDirection(reflects ? normal : -normal, sequence.pair(pairOf(bounce, kScatterUse)));
    leg.throughput =
        vertex.throughput * (reflects ? vertex.reflectance / chance : vertex.transmittance / (1.0 - chance));
    leg.shift = vertex.shift;
    const double rise = leg.direction.z < 0.0 ? -leg.origin.z : static_cast<double>(m_patch.height) - leg.origin.z;
    leg.end = std::min(leg.direction.z != 0.0 ? rise / leg.direction.z : kFarM, kFarM);
    m_legs.push_back(leg);
  }
}

void PathTracer::finish() {
  for (std::size_t path = 0; path < m_pixels.size(); ++path) {
    glm::dvec3& radiance = m_radiance[path];
    if (m_clear[path] >= 0.0 && m_clear[path] < 1.0) {
      radiance = glm::mix(m_scene.horizon.at(m_azimuth[path]), radiance, m_clear[path]);
    }
    radiance *= m_scene.options.exposure;
  }
}

}  // namespace sward::trace
