#pragma once

#include "base/job.h"
#include "base/result.h"
#include "image/flip.h"
#include "image/image.h"

#include <optional>

namespace sward::image {

/// Errors of values as they stand, over all pixels and channels: linear or display values, which the caller says.
struct ValueErrors {
  double rmse = 0.0;
  double bias = 0.0;             ///< mean of test - reference: above 0 the test is too bright
  double max = 0.0;              ///< greatest |test - reference|
  std::optional<double> psnrDb;  ///< 20 log10(peak / rmse); none when the images are equal: it is infinite
};

/// The errors of `test` against `reference`, with PSNR for values of up to `peak` (above 0). Summed in double precision
/// in an order that does not depend on the threads (OpenImageIO's compare() gives neither bias nor an error for values
/// that are not finite).
/// Errors: sizes or channels that differ, an empty image, a value that is not finite, a peak that is not above 0.
Result<ValueErrors> valueErrors(const Image& reference, const Image& test, double peak = 1.0,
                                const JobContext& job = {});

/// The figures of a report's row. Of display values in [0, 1]: psnrDb (peak 1), ssim, flip. Of linear values where
/// linear images were given, else of display values too: rmse, bias, max.
struct ErrorFigures {
  double rmse = 0.0;
  std::optional<double> psnrDb;  ///< none when the display values are equal: it is infinite
  double ssim = 0.0;             ///< mean, of luma
  double flip = 0.0;             ///< mean
  double bias = 0.0;
  double max = 0.0;
  std::optional<double> hdrFlip;  ///< mean, of linear values; where CompareOptions asked for it
};

struct CompareOptions {
  FlipOptions flip;
  std::optional<HdrFlipOptions> hdrFlip;  ///< needs linear images
};

/// Two images to compare; both live as long as the call.
struct ImagePair {
  const Image& reference;
  const Image& test;
};

/// All figures of two linear images and what the caller's view transform made of them: sRGB-encoded display values,
/// which are clamped to [0, 1] here. Grey or RGB.
/// Errors: those of valueErrors(), ssim(), flip() and hdrFlip(); linear and display images of different sizes.
Result<ErrorFigures> compareImages(const ImagePair& linear, const ImagePair& display,
                                   const CompareOptions& options = {}, const JobContext& job = {});
/// All figures of two display images alone.
Result<ErrorFigures> compareDisplayImages(const ImagePair& display, const CompareOptions& options = {},
                                          const JobContext& job = {});

}  // namespace sward::image
