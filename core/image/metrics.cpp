#include "image/metrics.h"

#include "image/metrics_common.h"
#include "image/ssim.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace sward::image {

namespace {

struct RowSums {
  double squares = 0.0;
  double signedSum = 0.0;
  double max = 0.0;
};

// Of the differences of one row. `clamped`: of values as a display shows them.
RowSums sumsOfRow(const Image& reference, const Image& test, int y, bool clamped) {
  RowSums sums;
  for (std::size_t i = reference.offset(0, y); i < reference.offset(0, y + 1); ++i) {
    double a = static_cast<double>(reference.pixels[i]);
    double b = static_cast<double>(test.pixels[i]);
    if (clamped) {
      a = std::clamp(a, 0.0, 1.0);
      b = std::clamp(b, 0.0, 1.0);
    }
    const double difference = b - a;
    sums.squares += difference * difference;
    sums.signedSum += difference;
    sums.max = std::max(sums.max, std::abs(difference));
  }
  return sums;
}

Result<ValueErrors> errorsOf(const ImagePair& images, ChannelNeed need, bool clamped, double peak,
                             const JobContext& job) {
  SWARD_TRY(checkComparable(images.reference, images.test, need, job));
  std::vector<RowSums> rows(static_cast<std::size_t>(images.reference.height));
  forEachRow(job, images.reference.height,
             [&](int y) { rows[static_cast<std::size_t>(y)] = sumsOfRow(images.reference, images.test, y, clamped); });
  if (job.cancelled()) return Error::cancelled();
  RowSums whole;
  for (const RowSums& row : rows) {
    whole.squares += row.squares;
    whole.signedSum += row.signedSum;
    whole.max = std::max(whole.max, row.max);
  }
  const double count = static_cast<double>(images.reference.pixels.size());
  ValueErrors errors{std::sqrt(whole.squares / count), whole.signedSum / count, whole.max, std::nullopt};
  if (errors.rmse > 0.0) errors.psnrDb = 20.0 * std::log10(peak / errors.rmse);
  return errors;
}

Result<void> checkSameSize(const Image& linear, const Image& display) {
  if (linear.width == display.width && linear.height == display.height) return {};
  return Error::badInput("the linear image is " + std::to_string(linear.width) + " x " + std::to_string(linear.height) +
                             " and the display image " + std::to_string(display.width) + " x " +
                             std::to_string(display.height),
                         "reference image", "Make the display image of the linear one.");
}

}  // namespace

Result<ValueErrors> valueErrors(const Image& reference, const Image& test, double peak, const JobContext& job) {
  if (!(peak > 0.0) || !std::isfinite(peak)) {
    return Error::badInput("the peak is " + std::to_string(peak), "PSNR",
                           "Give the greatest value an image may have: 1 for display values.");
  }
  return errorsOf({reference, test}, ChannelNeed::Any, false, peak, job);
}

Result<ErrorFigures> compareDisplayImages(const ImagePair& display, const CompareOptions& options,
                                          const JobContext& job) {
  if (options.hdrFlip) {
    return Error::badInput("HDR-FLIP is asked for display images", "HDR-FLIP", "Give the linear images too.");
  }
  SWARD_ASSIGN(const ValueErrors values, errorsOf(display, ChannelNeed::Colour, true, 1.0, job));
  SWARD_ASSIGN(const Ssim structure, ssim(display.reference, display.test, job));
  SWARD_ASSIGN(const FlipError seen, flip(display.reference, display.test, options.flip, job));
  ErrorFigures figures;
  figures.rmse = values.rmse;
  figures.psnrDb = values.psnrDb;
  figures.ssim = structure.mean;
  figures.flip = seen.mean;
  figures.bias = values.bias;
  figures.max = values.max;
  return figures;
}

Result<ErrorFigures> compareImages(const ImagePair& linear, const ImagePair& display, const CompareOptions& options,
                                   const JobContext& job) {
  SWARD_ASSIGN(const ValueErrors values, errorsOf(linear, ChannelNeed::Colour, false, 1.0, job));
  SWARD_TRY(checkSameSize(linear.reference, display.reference));
  CompareOptions displayOptions = options;
  displayOptions.hdrFlip.reset();
  SWARD_ASSIGN(ErrorFigures figures, compareDisplayImages(display, displayOptions, job));
  figures.rmse = values.rmse;
  figures.bias = values.bias;
  figures.max = values.max;
  if (options.hdrFlip) {
    SWARD_ASSIGN(const HdrFlipError hdr, hdrFlip(linear.reference, linear.test, *options.hdrFlip, job));
    figures.hdrFlip = hdr.mean;
  }
  return figures;
}

}  // namespace sward::image
