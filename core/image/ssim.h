#pragma once

#include "base/job.h"
#include "base/result.h"
#include "image/image.h"

namespace sward::image {

/// Structural similarity: 1 where windows are equal, down to -1.
struct Ssim {
  double mean = 0.0;
  Image map;  ///< one channel, of the images' size
};

/// SSIM of Wang, Bovik, Sheikh and Simoncelli 2004: windows of 11 x 11 under a Gaussian of sigma 1.5, K1 = 0.01,
/// K2 = 0.03, population moments, on the luma (0.2126 R' + 0.7152 G' + 0.0722 B') of display values, grey or RGB,
/// clamped to [0, 1] as a display clamps them (so the range of values is 1). Windows that stick out of the image see it
/// mirrored at its edge; as in the paper the mean leaves these out, but along a side of fewer than 11 pixels, where no
/// window fits, all count.
/// Errors: sizes or channels that differ, an empty image, a value that is not finite.
Result<Ssim> ssim(const Image& referenceDisplay, const Image& testDisplay, const JobContext& job = {});

}  // namespace sward::image
