#include "impostor/picture_error.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace sward::impostor {
namespace {

constexpr double kNowhere = std::numeric_limits<double>::quiet_NaN();

/// Angle between two vectors, accurate for small ones too (Kahan).
double angleBetween(const glm::dvec3& a, const glm::dvec3& b) {
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

bool within(const Box& box, const glm::dvec3& point) {
  return glm::all(glm::lessThanEqual(box.low, point)) && glm::all(glm::lessThanEqual(point, box.high));
}

}  // namespace

PicturePlane pictureOf(const Box& box, const glm::dvec3& eye) {
  PicturePlane plane;
  plane.eye = eye;
  plane.point = box.centre();
  const glm::dvec3 toEye = eye - plane.point;
  const double distance = glm::length(toEye);
  if (distance > 0.0) plane.normal = toEye / distance;
  return plane;
}

glm::dvec3 shownAt(const PicturePlane& plane, const glm::dvec3& point) {
  const glm::dvec3 along = point - plane.eye;
  const double falls = -glm::dot(along, plane.normal);
  const double height = glm::dot(plane.eye - plane.point, plane.normal);
  if (!(falls > 0.0) || !(height > 0.0)) return glm::dvec3(kNowhere);
  return plane.eye + along * (height / falls);
}

double displacement(const PicturePlane& plane, const glm::dvec3& point, const glm::dvec3& eye) {
  const glm::dvec3 shown = shownAt(plane, point);
  const double angle = angleBetween(point - eye, shown - eye);
  return std::isfinite(angle) ? angle : std::numbers::pi;
}

double displacement(const PicturePlane& plane, const Box& box, const glm::dvec3& eye) {
  if (within(box, eye) || within(box, plane.eye)) return std::numbers::pi;
  double largest = 0.0;
  for (int i = 0; i < 27; ++i) {
    if (i == 13) continue;  // the centre lies on the plane
    const glm::dvec3 at(i % 3, i / 3 % 3, i / 9);
    largest = std::max(largest, displacement(plane, box.low + 0.5 * at * (box.high - box.low), eye));
  }
  return largest;
}

double sizeErrorEstimate(double halfWidthM, double halfDepthM, double movedM, double distanceM) {
  return halfWidthM * halfDepthM * std::abs(movedM) / (distanceM * distanceM * distanceM);
}

double translationErrorEstimate(double halfDepthM, double movedM, double distanceM) {
  return halfDepthM * std::abs(movedM) / (distanceM * distanceM);
}

double interAxialAngle(const glm::dvec3& centre, const glm::dvec3& madeFrom, const glm::dvec3& seenFrom) {
  return angleBetween(madeFrom - centre, seenFrom - centre);
}

double pixelAngle(double fovRad, int pixels) {
  return 2.0 * std::tan(0.5 * fovRad) / pixels;
}

int texelsFor(double sizeM, double distanceM, double pixelAngleRad, int least, int most) {
  int texels = least;
  while (texels < most && !sharpEnough(sizeM, distanceM, pixelAngleRad, texels)) texels *= 2;
  return texels;
}

bool sharpEnough(double sizeM, double distanceM, double pixelAngleRad, int texels) {
  return sizeM <= pixelAngleRad * distanceM * texels;
}

}  // namespace sward::impostor
