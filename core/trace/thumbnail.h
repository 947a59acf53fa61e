#pragma once

#include "base/job.h"
#include "base/result.h"
#include "mesh/model.h"

#include <cstdint>
#include <vector>

namespace sward::trace {

struct ThumbnailOptions {
  int size = 128;             ///< pixels along each side, 8 to 1024
  int samplesPerSide = 4;     ///< of a pixel, 1 to 16: their square is traced
  double turnDeg = 30.0;      ///< of the viewer about the plant, from south to east
  double aboveDeg = 14.0;     ///< of the viewer over the horizon, -90 to 90
  double marginShare = 0.06;  ///< of the picture, free on each side
};

/// A small picture: sRGB, straight alpha, rows from the top.
struct Thumbnail {
  int size = 0;
  std::vector<std::uint8_t> rgba;
};

/// One plant by itself under a fixed sun and sky, framed on its bounds, before nothing: its shadow on the ground is
/// black of some alpha. A model without triangles gives a wholly transparent picture. Errors: a vertex that is not
/// finite, sizes out of range, no memory. The same bytes on any number of threads.
Result<Thumbnail> drawThumbnail(const mesh::Model& model, const ThumbnailOptions& options, const JobContext& job);

}  // namespace sward::trace
