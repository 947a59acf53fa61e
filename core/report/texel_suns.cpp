#include "report/texel_suns.h"

#include "image/metrics.h"
#include "report/picture_row.h"
#include "report/text.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sward::report {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;

struct Side {
  const char* name;
  double turnDeg;  ///< clockwise, from where the eye looks
};
constexpr Side kSides[] = {{"behind", 180.0}, {"across", 90.0}, {"against", 0.0}};

double meanOf(const image::Image& image) {
  double sum = 0.0;
  for (const float value : image.pixels) sum += double{value};
  return sum / static_cast<double>(std::max<std::size_t>(image.pixels.size(), 1));
}

/// Unit, toward a sun at the height of `sun`.
glm::dvec3 turned(const glm::dvec3& sun, double azimuthRad) {
  const double across = std::hypot(sun.x, sun.y);
  return {across * std::sin(azimuthRad), across * std::cos(azimuthRad), sun.z};
}

}  // namespace

Result<std::vector<Row>> sunRows(const SunInput& input, const SunSubject& subject, const JobContext& job) {
  const glm::dvec3 sun = input.daylight.sunDirection();
  const glm::dvec3 forward = subject.frame.camera.forward;
  std::vector<Row> rows;
  for (const Side& side : kSides) {
    const double azimuth = std::atan2(forward.x, forward.y) + side.turnDeg / kDegrees;
    const glm::dvec3 toSun = turned(sun, azimuth);
    const scene::Daylight daylight(toSun, input.project.sun, input.project.sky);
    subject.truth.setDaylight(daylight);
    subject.renderer.setDaylight(daylight, input.project.sky.hazeKm);
    SWARD_ASSIGN(const TruthPicture truth, subject.truth.picture(subject.frame, {}, input.samples, 1, job));
    SWARD_ASSIGN(const image::Image drawn, subject.renderer.drawLinear(subject.frame));
    SWARD_ASSIGN(const image::ValueErrors errors, image::valueErrors(truth.linear, drawn, 1.0, job));
    const double mean = meanOf(truth.linear);
    Row row;
    row.method = subject.method + "_sun_" + side.name;
    row.error = {{"rmse", errors.rmse}, {"bias", errors.bias}, {"max", errors.max}};
    row.numbersAndNames = {
        {"sun_azimuth_deg", numberText(std::fmod(azimuth * kDegrees + 360.0, 360.0))},
        {"sun_elevation_deg", numberText(std::asin(std::clamp(sun.z, -1.0, 1.0)) * kDegrees)},
        {"phase_deg", numberText(std::acos(std::clamp(-glm::dot(forward, toSun), -1.0, 1.0)) * kDegrees)},
        {"reference_mean", numberText(mean)},
        {"reference_noise_rmse", numberText(truth.noiseRmse)},
        {"relative_bias", numberText(mean > 0.0 ? errors.bias / mean : 0.0)}};
    row.reference = "ray-traced tiled geometry, sun and sky, " + std::to_string(input.samples) + " samples a pixel";
    row.notes = "the project's sun at its height, moved round the eye";
    rows.push_back(std::move(row));
  }
  subject.truth.setDaylight(input.daylight);
  subject.renderer.setDaylight(input.daylight, input.project.sky.hazeKm);
  return rows;
}

}  // namespace sward::report
