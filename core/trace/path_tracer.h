#pragma once

#include "trace/ground_rays.h"
#include "trace/reference.h"
#include "trace/sample_sequence.h"
#include "trace/sky_light.h"
#include "trace/tiled_ground.h"

#include <cstdint>
#include <vector>

#include <glm/glm.hpp>

/// Private to core/trace: what Reference adds up.
namespace sward::trace {

/// Everything that stays the same while samples are traced.
struct PathScene {
  ReferenceScene scene;
  ReferenceOptions options;
  scene::Camera camera;
  TiledGround ground;
  SkyLight sky;
  SunLight sun;
  HorizonSky horizon;
};

/// A rectangle of pixels.
struct PixelTile {
  int x0 = 0, y0 = 0, x1 = 0, y1 = 0;
};

/// Traces one sample of every pixel of a tile at a time; a worker's own. A sample's value depends on its pixel and
/// number alone.
class PathTracer {
 public:
  /// Samples are dealt to so many sequences in turn, scrambled independently of each other, so that the spread of their
  /// means says how good the mean of all is.
  static constexpr int kSequences = 4;

  explicit PathTracer(const PathScene& scene);

  /// Radiance times exposure of sample `sample` of each pixel, in the order of pixels().
  const std::vector<glm::dvec3>& trace(const PixelTile& tile, int sample);
  /// Pixels of the tile of the last trace(), as y * width + x: blocks of 4 x 4, which fill a packet.
  const std::vector<std::uint32_t>& pixels() const { return m_pixels; }

  std::uint64_t rays() const { return m_rays; }
  std::uint64_t nearestSegments() const { return m_nearest.segments(); }
  std::uint64_t occlusionSegments() const { return m_sunRays.segments() + m_skyRays.segments(); }

 private:
  /// A surface point that light is gathered at.
  struct Vertex {
    std::uint32_t path = 0;    ///< index into m_pixels
    glm::dvec3 position{0.0};  ///< of the straight grid
    glm::vec3 normal{0.0f};    ///< of the side that was seen
    glm::dvec3 reflectance{0.0}, transmittance{0.0}, throughput{1.0};
    glm::ivec2 shift{0};  ///< of the piece of the patch that it was cut from
  };
  /// A ray whose nearest surface is asked for, and what it carries.
  struct Leg {
    std::uint32_t path = 0;
    glm::dvec3 origin{0.0}, direction{0.0}, throughput{1.0};
    double end = 0.0;
    glm::ivec2 shift{0};
  };
  /// What a shadow ray brings when nothing is in its way.
  struct Lit {
    std::uint32_t path = 0;
    glm::dvec3 radiance{0.0};
  };

  void listPixels(const PixelTile& tile);
  void startPaths(int sample);
  glm::dvec3 cameraDirection(std::uint32_t path) const;
  glm::dvec3 background(const glm::dvec3& direction) const;
  void findVertices(std::uint32_t use);
  void addLeaf(const Leg& leg, const GroundHit& hit);
  void addSoil(const Leg& leg);
  void gather(int bounce);
  void gatherFrom(const Vertex& vertex, const LightSample& light, GroundRays& rays, std::vector<Lit>& lit,
                  std::uint32_t use);
  void scatter(int bounce);
  GroundWalk walkFrom(const Vertex& vertex, const glm::dvec3& direction, double end) const;
  void addLit(const GroundRays& rays, const std::vector<Lit>& lit);
  void finish();
  std::uint32_t rayId(std::uint32_t path, std::uint32_t use) const;

  const PathScene& m_scene;
  const PatchScene::Impl& m_patch;
  std::vector<std::uint32_t> m_pixels;
  std::vector<SampleSequence> m_sequences;
  std::vector<std::uint64_t> m_seeds;
  std::vector<glm::dvec3> m_radiance;
  std::vector<glm::dvec2> m_azimuth;  ///< horizontal direction of the primary ray
  std::vector<double> m_clear;        ///< share of the ground's light that the haze lets through; below 0: no haze
  std::vector<Leg> m_legs;
  std::vector<Vertex> m_vertices;
  std::vector<Lit> m_sunLit, m_skyLit;
  GroundRays m_nearest, m_sunRays, m_skyRays;
  std::uint64_t m_rays = 0;
};

}  // namespace sward::trace
