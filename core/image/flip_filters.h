#pragma once

#include <cstddef>
#include <vector>

namespace sward::image {

/// One row of 2 * radius + 1 weights; a filter of the plane is the product of two.
using FlipKernel = std::vector<float>;

/// Separable filters of FLIP at a number of pixels per degree.
struct FlipFilters {
  explicit FlipFilters(double pixelsPerDegree);

  /// The eye's contrast sensitivity per opponent channel; blue-yellow is a sum of two products.
  FlipKernel achromatic;
  FlipKernel redGreen;
  FlipKernel blueYellowWide;
  FlipKernel blueYellowNarrow;
  /// Feature detectors: a Gaussian, its first derivative (edges) and its second (points).
  FlipKernel smooth;
  FlipKernel edge;
  FlipKernel point;

  int spatialRadius() const { return static_cast<int>(achromatic.size()) / 2; }
  int featureRadius() const { return static_cast<int>(smooth.size()) / 2; }
};

/// Rows of one value a pixel.
struct FlipPlane {
  FlipPlane() = default;
  FlipPlane(int columns, int lines);

  int width = 0;
  int rows = 0;
  std::vector<float> values;

  float* row(int y) { return values.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(width); }
  const float* row(int y) const {
    return values.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(width);
  }
};

/// Adds to `out` the correlation of `in` with `alongX` times `alongY` (of one size). `in` has `halo` rows more above
/// and below than `out`, at least the kernel's radius; columns beyond the sides repeat the outermost.
void addFiltered(const FlipPlane& in, int halo, const FlipKernel& alongX, const FlipKernel& alongY, FlipPlane& out);

}  // namespace sward::image
