#pragma once

#include "trace/triangle_field.h"

#include <span>
#include <vector>

#include <glm/glm.hpp>

namespace sward::trace {

/// Light of each direction at each hit of a set.
struct ArrivingLight {
  std::vector<std::vector<float>> share;   ///< [direction][hit]: what arrives, in [0, 1]
  std::vector<std::vector<float>> cosine;  ///< [direction][hit]: between the normal and the direction
};

/// How much light of some directions reaches any point among the plants, without a ray: the patch is cut into voxels
/// that hold how much leaf they turn to each direction, and light weakens in them as in a turbid medium (Monsi and
/// Saeki 1953; Ross 1981): by exp(-leaf area across the light / area). Shadows of single blades are lost, those of
/// tufts and the dark at the ground are kept, in a hundredth of the time of rays. For coarse samplings. VoxelDensity is
/// the finer medium, for any direction; this one knows its few directions beforehand, so that it sums what each triangle
/// turns to them without cutting it, and is ready in a tenth of the time.
class CanopyLight {
 public:
  /// Shadows longer than this times a plant's height are not followed.
  static constexpr double kLowestZ = 0.04;
  /// `cells` voxels along each side of the patch, `layers` over its height; unit directions, z at least kLowestZ. A
  /// cancelled job gives an unfinished one: ask job.cancelled().
  CanopyLight(const TriangleField& field, int cells, int layers, std::span<const glm::dvec3> directions,
              const JobContext& job);

  std::size_t directions() const { return m_directions.size(); }
  const glm::dvec3& direction(std::size_t i) const { return m_directions[i]; }
  /// Part of the direction's light that arrives at a hit of the slices or the ground (seen from above) or of blades, in
  /// [0, 1].
  float at(std::size_t direction, const glm::vec3& position, LayerSet seenBy) const;

  /// What reaches every hit of a set.
  ArrivingLight arriving(const LayerHits& hits, const JobContext& job) const;

 private:
  float bilinear(const float* plane, float x, float y) const;
  void deposit(const TriangleField& field, const JobContext& job);
  void spread(std::size_t direction);

  std::vector<glm::dvec3> m_directions;
  int m_cells, m_layers;
  float m_cellsPerMetre, m_layerM, m_heightM;
  /// [direction][layer from the top][y][x]: optical depth of crossing the layer.
  std::vector<float> m_depth;
  /// [direction][border from the top: layers + 1][y][x]: what arrives there.
  std::vector<float> m_light;
};

/// sampleLuminance of one of the directions.
LayerLuminance luminanceOf(const LayerHits& hits, const ArrivingLight& arriving, std::size_t direction);
/// sampleVisibility from directions that spread evenly over the hemisphere.
LayerVisibility visibilityOf(const LayerHits& hits, const ArrivingLight& arriving,
                             std::span<const glm::dvec3> directions);

}  // namespace sward::trace
