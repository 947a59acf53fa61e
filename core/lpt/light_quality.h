#pragma once

#include <array>
#include <span>
#include <vector>

#include <glm/glm.hpp>

namespace sward::lpt {

/// How well a set of baked lights determines what lies between them. A polynomial in the light's direction is fitted to
/// one sample a light, so two things count: whether the six functions lx^2, ly^2, lx ly, lx, ly and 1 can be told apart
/// on the set, and how far a direction is from the lights.
class LightSetQuality {
 public:
  /// `lights` are unit vectors with z >= 0; none is allowed.
  explicit LightSetQuality(std::span<const glm::dvec3> lights);

  /// Numerical rank of the six functions on the lights, 0 to 6; as the fit counts it (singular values under a millionth
  /// of the largest are none). Below 6 the light's form is not determined: the ridge decides.
  int rank() const { return m_rank; }
  /// Largest over smallest singular value of the matrix of the six functions (a row a light); infinite when the
  /// smallest is no more than rounding, or with fewer than six lights. 5 to 10 is good, 100 amplifies noise a
  /// hundredfold.
  double condition() const { return m_condition; }
  /// Variance of the least-squares prediction toward a direction, relative to that of one sample:
  /// phi^T (Phi^T Phi)^-1 phi. At most 1 at every baked light (there its sum over the set is the rank); above 1 a
  /// prediction is less certain than any sample, so it is extrapolated. Infinite where the set says nothing.
  double leverage(const glm::dvec3& direction) const;
  /// Angle to the nearest light; 180 without lights.
  double gapDeg(const glm::dvec3& direction) const;
  /// The largest gap over the upper hemisphere, within a thousandth of a degree, and where it is.
  double worstGapDeg() const { return m_worstGapDeg; }
  const glm::dvec3& worstGap() const { return m_worstGap; }
  /// Share of the upper hemisphere's solid angle, 0 to 1, where relighting is not extrapolated (leverage at most 1).
  double coverage() const { return m_coverage; }

 private:
  void decompose();
  void findWorstGap(std::span<const glm::dvec3> directions);

  std::vector<glm::dvec3> m_lights;
  /// Right singular vectors; the first m_rank of them divided by their singular values.
  std::array<std::array<double, 6>, 6> m_vectors{};
  double m_nullTolerance = 0.0;  ///< what a function vector may have outside of the determined space
  int m_rank = 0;
  double m_condition = 0.0;
  double m_worstGapDeg = 180.0;
  glm::dvec3 m_worstGap{0.0, 0.0, 1.0};
  double m_coverage = 0.0;
};

/// Leverage and gap on a grid, for painting: size x size texels over the square round the unit disc in which the upper
/// hemisphere lies by Lambert's azimuthal equal-area projection (the zenith in the middle, the horizon on the rim;
/// every texel the same solid angle). Row 0 is north, column 0 west; NaN outside of the disc.
struct HemisphereMap {
  int size = 0;
  std::vector<float> leverage;
  std::vector<float> gapDeg;
};
HemisphereMap hemisphereMap(const LightSetQuality& quality, int size);

/// The projection of that map: a place (x east, y north) of the unit disc and the direction that it stands for.
glm::dvec3 directionAt(const glm::dvec2& place);
glm::dvec2 placeOf(const glm::dvec3& direction);

}  // namespace sward::lpt
