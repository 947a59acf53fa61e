#pragma once

#include <span>

namespace sward::image {

/// Fills the pixels of weight 0 from those that have one, by pull and push (Gortler et al. 1996, section 3.4): weighted
/// means down a pyramid of halved images, and back up where nothing is known, interpolated bilinearly. Pixels with a
/// weight keep their bytes. values: [y][x][channels]; weight: [y][x], finite, >= 0. All weights 0: nothing changes.
/// `periodic` joins opposite borders.
void pullPush(std::span<float> values, std::span<const float> weight, int width, int height, int channels,
              bool periodic);

}  // namespace sward::image
