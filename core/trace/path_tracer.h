#pragma once

#include "trace/ground_rays.h"
#include "trace/reference.h"
#include "trace/sample_sequence.h"
#include "trace/sky_light.h"
#include "trace/tiled_ground.h"

#include <cstdint>
#include <optional>

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

/// Traces samples of pixels; a worker's own. A sample's value depends on its pixel and number alone.
class PathTracer {
 public:
  /// Samples are dealt to so many sequences in turn, scrambled independently of each other, so that the spread of their
  /// means says how good the mean of all is.
  static constexpr int kSequences = 4;

  explicit PathTracer(const PathScene& scene);

  /// Radiance times exposure of sample `sample` of a pixel, x from the left and y from the top.
  glm::dvec3 trace(int x, int y, int sample);
  const GroundRays& rays() const { return m_rays; }

 private:
  /// A surface point that light is gathered at.
  struct Vertex {
    glm::dvec3 position{0.0};  ///< of the straight grid
    glm::dvec3 normal{0.0};    ///< of the side that was seen
    glm::dvec3 reflectance{0.0}, transmittance{0.0};
    glm::ivec2 shift{0};  ///< of the piece of the patch that it was cut from
  };
  /// A ray whose nearest surface is asked for.
  struct Leg {
    glm::dvec3 origin{0.0}, direction{0.0};
    double end = 0.0;
    bool tiled = true;  ///< through the tiled ground, else the periodic patch laid by `shift`
    glm::ivec2 shift{0};
    float start = 0.0f;  ///< surfaces nearer are passed over
  };
  /// What a leg ended at: a surface, the ground's end in the far, or nothing (it rose out of the shell).
  enum class End : std::uint8_t { Surface, Far, Above };
  /// One sample's numbers.
  struct Draw {
    SampleSequence sequence;
    std::uint64_t seed;
    std::uint32_t rayId(std::uint32_t use) const;
  };

  glm::dvec3 cameraDirection(int x, int y, const Draw& draw) const;
  glm::dvec3 background(const glm::dvec3& direction) const;
  /// The primary ray from where it enters the shell, `enterM` from the eye.
  Leg firstLeg(const glm::dvec3& direction, double enterM) const;
  double endOf(const glm::dvec3& origin, const glm::dvec3& direction) const;
  End follow(const Leg& leg, std::uint32_t rayId, Vertex& vertex);
  Vertex leafAt(const Leg& leg, const GroundHit& hit) const;
  Vertex soilAt(const Leg& leg) const;
  glm::dvec3 gather(const Vertex& vertex, const Draw& draw, int bounce);
  glm::dvec3 lightFrom(const Vertex& vertex, const LightSample& light, std::uint32_t rayId);
  /// The next leg and what it is multiplied with; nothing where all light is absorbed.
  std::optional<Leg> scatter(const Vertex& vertex, const Draw& draw, int bounce, glm::dvec3& throughput) const;
  glm::dvec3 pathFrom(Vertex vertex, const Draw& draw);

  const PathScene& m_scene;
  const PatchScene::Impl& m_patch;
  glm::dvec3 m_eye;
  double m_topM;  ///< where primary rays enter the shell: a hair above it, since leaves may lie in its top
  double m_hazePerM;
  GroundRays m_rays;
};

}  // namespace sward::trace
