#pragma once

#include "base/random.h"
#include "mesh/model.h"

#include <functional>
#include <span>
#include <vector>

#include <glm/glm.hpp>

namespace sward::mesh {

/// The building blocks of procedural plants: a curved axis, the ribbon and the tube that follow it. Metres, radians,
/// z up. Everything is appended to a Model; vertices that would lie under the ground are lifted to z = 0.

/// One cross-section along an axis. The upper side of a ribbon faces cross(tangent, side).
struct AxisRow {
  glm::dvec3 centre{0.0};
  glm::dvec3 tangent{0.0, 0.0, 1.0};  ///< unit
  glm::dvec3 side{1.0, 0.0, 0.0};     ///< unit, across the ribbon, perpendicular to the tangent
  double s = 0.0;                     ///< 0 at the root, 1 at the tip
};

/// An axis that starts at `foot`, inclined by `lean` toward `azimuth` (counter-clockwise from x), and turns by `bend`
/// on its way: inclination(s) = lean + bend s^power. It never goes under z = 0: there it runs on along the ground.
struct Axis {
  glm::dvec3 foot{0.0};
  double azimuth = 0.0;
  double drift = 0.0;  ///< change of azimuth from root to tip
  double lean = 0.0;
  double bend = 0.0;
  double power = 1.5;
  double length = 1.0;
  double turn = 0.0;   ///< rotation of the ribbon about the axis at the root
  double twist = 0.0;  ///< and how much more from root to tip
  int segments = 4;
};
std::vector<AxisRow> axisRows(const Axis& axis);

/// Colour at s (0 root to 1 tip) and across (-1 left edge to 1 right edge, 0 the midrib), linear RGB.
using ColourAlong = std::function<glm::dvec3(double s, double across)>;

struct Ribbon {
  std::span<const AxisRow> rows;  ///< at least two
  std::function<double(double s)> halfWidth;
  double fold = 0.0;  ///< both halves rise by this angle from the midrib; above 0 the ribbon has two strips
  ColourAlong colour;
  std::uint32_t material = 0;
};
void appendRibbon(Model& model, const Ribbon& ribbon);

struct Tube {
  std::span<const AxisRow> rows;
  std::function<double(double s)> radius;
  int sides = 3;
  ColourAlong colour;  ///< across is 0
  std::uint32_t material = 0;
};
void appendTube(Model& model, const Tube& tube);

/// A flat four-cornered scale from `base` along `along` (its length), half as wide as `halfWidth` says at 45 % of its
/// length, facing `face`; two triangles. For spikelets and florets.
void appendScale(Model& model, const glm::dvec3& base, const glm::dvec3& along, const glm::dvec3& face,
                 double halfWidth, const glm::dvec3& baseColour, const glm::dvec3& tipColour, std::uint32_t material);

/// A white, double-sided material; the vertices carry the colour.
Material plantMaterial(const char* name, const LeafOptics& optics);

/// `mean` times (1 + variation x a standard normal cut at two), at least a tenth of the mean.
double variedLength(base::Random& random, double mean, double variation);
/// A standard normal cut at two.
double cutNormal(base::Random& random);
/// `colour` with its brightness and hue moved at random by about `variation` (relative), within [0, 1].
glm::dvec3 variedColour(base::Random& random, const glm::dvec3& colour, double variation);
/// The straw that leaves of this colour dry to.
glm::dvec3 dryColour(const glm::dvec3& leaf);

}  // namespace sward::mesh
