#pragma once

#include <glm/glm.hpp>

namespace sward::impostor {

/// A box about an object, metres; edges along the axes.
struct Box {
  glm::dvec3 low{0.0}, high{0.0};
  glm::dvec3 centre() const { return 0.5 * (low + high); }
  double radius() const { return 0.5 * glm::length(high - low); }  ///< of the sphere about it
};

/// A picture of an object: projected from an eye onto the plane through a point, across the line from one to the other.
struct PicturePlane {
  glm::dvec3 eye{0.0};
  glm::dvec3 point{0.0};
  glm::dvec3 normal{0.0, 0.0, 1.0};  ///< unit, toward the eye
};
/// The plane through the box's centre; normal +z for an eye in the centre.
PicturePlane pictureOf(const Box& box, const glm::dvec3& eye);

/// Where the picture shows a point: on the plane, along the line from the picture's eye. Not finite for a point at the
/// height of that eye over the plane, or beyond it.
glm::dvec3 shownAt(const PicturePlane& plane, const glm::dvec3& point);

/// Radians at `eye` between where a point is and where the picture shows it; pi if the picture does not show it.
double displacement(const PicturePlane& plane, const glm::dvec3& point, const glm::dvec3& eye);
/// The largest over a box's corners and the middles of its edges and faces: 0 at the picture's own eye. pi for an eye
/// in the box, and for a picture made from within it. The 2008 paper takes the corners alone: in 3 % of 20,000 random
/// views at 1.3 to 20 radii some point of the box was farther off, by up to 1.83 times, for at a corner what nearing
/// and what moving sideways does may cancel out. With the middles it was 1.37 times at most (a test holds it
/// under 1.5).
double displacement(const PicturePlane& plane, const Box& box, const glm::dvec3& eye);

/// The 2008 paper's estimates, radians, to first order in `movedM`: m the box's half-depth, r its half-width, d the
/// distance, all metres. Approaching: r m Delta / d^3; sideways: m Delta / d^2.
double sizeErrorEstimate(double halfWidthM, double halfDepthM, double movedM, double distanceM);
double translationErrorEstimate(double halfDepthM, double movedM, double distanceM);

/// Angle at the object's centre between where its picture was made and where it is seen from, radians in [0, pi]; 0 if
/// either eye is in the centre. (Schaufler's inter-axial angle: turning the view alone does not change it.)
double interAxialAngle(const glm::dvec3& centre, const glm::dvec3& madeFrom, const glm::dvec3& seenFrom);

/// Angle of a pixel in the middle of a picture `pixels` high (or wide) with a field of view of `fovRad` along the same
/// side, radians: beta_scr. `fovRad` in (0, pi), pixels >= 1.
double pixelAngle(double fovRad, int pixels);
/// Texels that an object `sizeM` across needs `distanceM` away so that none of them is wider than a pixel: the next
/// power of two in [least, most], both powers of two. `most` for an eye in the object.
int texelsFor(double sizeM, double distanceM, double pixelAngleRad, int least, int most);
/// Whether `texels` are enough for that: beta_tex <= beta_scr.
bool sharpEnough(double sizeM, double distanceM, double pixelAngleRad, int texels);

}  // namespace sward::impostor
