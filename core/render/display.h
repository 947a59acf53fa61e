#pragma once

#include "image/bytes.h"
#include "image/image.h"
#include "render/options.h"
#include "render/view_mode.h"

#include <span>

namespace sward::render {

/// Columns of a picture, [begin, end).
struct Columns {
  int begin = 0;
  int end = 0;
  bool operator==(const Columns&) const = default;
};

/// Linear radiance times exposure to display: the view transform, then sRGB encoding, per pixel. RGB or RGBA; alpha is
/// kept.
image::Image toDisplay(const image::Image& linear, ViewTransform transform);

/// RMSE of display values that noise makes in a linear picture whose values have these variances: half the difference
/// that one standard deviation to either side makes, a value at a time. 0 of an empty picture.
double displayNoise(const image::Image& mean, const image::Image& variance, ViewTransform transform);

/// How a target's values become colours.
struct DisplayLook {
  ViewTransform transform = ViewTransform::Filmic;  ///< of the plain picture
  ViewMode mode;
  Legend legend;  ///< of the mode
};

/// The same in 8 bits, for `columns` of `out`, which has the picture's size; alpha 255. `rgba` are floats, rows from
/// the bottom, each multiplied by `gain` first. The plain picture: exactly the bytes that image::writePng makes of
/// toDisplay's values. View modes: RGB or (in R) the scalar, times alpha, the share of the pixel that is ground; the
/// rest is backdrop. On all threads.
void toDisplayBytes(std::span<const float> rgba, float gain, const DisplayLook& look, Columns columns,
                    image::ByteImage& out);

}  // namespace sward::render
