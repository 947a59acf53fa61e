#pragma once

#include "image/bytes.h"
#include "image/image.h"
#include "render/options.h"

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

/// The same in 8 bits, exactly the bytes that image::writePng makes of toDisplay's values, for `columns` of `out`,
/// which has the picture's size; alpha 255. `rgba` are floats, rows from the bottom, each multiplied by `gain` first.
/// On all threads.
void toDisplayBytes(std::span<const float> rgba, float gain, ViewTransform transform, Columns columns,
                    image::ByteImage& out);

}  // namespace sward::render
