#pragma once

#include <cstdint>

namespace sward::report {

/// Which error of a picture against the ray-traced reference is bounded, all on display values (sRGB-encoded, 0 to 1).
enum class ErrorBound : std::uint8_t {
  None,
  Rmse,  ///< at most, of 1
  Psnr,  ///< at least, dB
  Ssim,  ///< at least, of 1
  Flip   ///< at most, of 1
};

/// The error that a project's pictures may have: `sward render` and `sward bake` then choose the cheapest bake that
/// keeps it (report/choice.h), in place of what the project says of light directions, sampling and fits.
struct AccuracyOptions {
  ErrorBound metric = ErrorBound::None;
  double bound = 0.1;
  bool operator==(const AccuracyOptions&) const = default;
};

}  // namespace sward::report
