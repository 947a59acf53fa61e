#pragma once

#include "base/job.h"
#include "base/result.h"
#include "lpt/fit.h"

#include <cstdint>
#include <string>
#include <vector>

#include <glm/glm.hpp>

namespace sward::report {

/// Input of lpt::fit that a least-squares solver may fail on. Owns what input() points at.
struct HardCase {
  std::string name;         ///< lower-case words joined by _
  std::string expectation;  ///< what a sound fit does with it, in a sentence
  int columns = 0, layers = 16, channels = 1;
  std::vector<glm::dvec3> lights;
  std::vector<std::uint32_t> columnStart{0};
  std::vector<std::uint8_t> layer;
  std::vector<float> coverage, visibility;
  std::vector<std::vector<float>> samples;  ///< [channel * lights + k][texel]

  lpt::FitInput input() const;  ///< valid while this case is neither moved nor changed
};

/// All of them, always the same: lights that are few, coincident, coplanar, on a ring or at the horizon; one layer or
/// none; weights of zero and of 1e-12 beside 1; luminance from 1e-8 to 1e6; one texel lit by one light; patches of a
/// millimetre and of a kilometre; samples that are not finite. Responses are a leaf's (clamped cosines) plus noise, so
/// that no polynomial fits them exactly. Errors: Embree's, of the patches; Error::cancelled().
Result<std::vector<HardCase>> hardCases(const JobContext& job);

/// The same small patch at another size, traced: every length times `scale`. With a power of two all arithmetic on
/// lengths scales without rounding, so that whatever differs comes from an absolute threshold somewhere.
Result<HardCase> patchCase(std::string name, double scale, const JobContext& job);

/// The same problem with its lights, and the texels of every column, in reverse order.
HardCase reordered(const HardCase& from);

/// Spherical Fibonacci points over the upper hemisphere.
std::vector<glm::dvec3> hemisphereLights(int count);

}  // namespace sward::report
