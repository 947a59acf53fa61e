#include "image/ssim.h"

#include "base/parallel.h"
#include "image/metrics_common.h"

#include <array>
#include <cmath>
#include <vector>

namespace sward::image {

namespace {

constexpr int kRadius = 5;
constexpr double kSigma = 1.5;
constexpr double kC1 = 0.01 * 0.01;  // (K1 * range)^2, range 1
constexpr double kC2 = 0.03 * 0.03;
constexpr int kMoments = 5;
constexpr std::size_t kRowsAtOnce = 64;  // each range works the rows of its windows out anew: 10 more

using Window = std::array<double, 2 * kRadius + 1>;

/// Gaussian-weighted first and second moments of both images: x, y, xx, yy, xy.
using Moments = std::array<double, kMoments>;

Window gaussianWindow() {
  Window window;
  double sum = 0.0;
  for (int i = -kRadius; i <= kRadius; ++i) {
    const double weight = std::exp(-0.5 * i * i / (kSigma * kSigma));
    window[static_cast<std::size_t>(i + kRadius)] = weight;
    sum += weight;
  }
  for (double& weight : window) weight /= sum;
  return window;
}

// Position i beyond [0, size) mirrored at the edge, which repeats its pixel: ... 1 0 | 0 1 ... size-1 | size-1 ...
int mirrored(int i, int size) {
  const int period = 2 * size;
  const int inPeriod = ((i % period) + period) % period;
  return inPeriod < size ? inPeriod : period - 1 - inPeriod;
}

double lumaAt(const Image& image, int x, int y) {
  const glm::dvec3 value = glm::clamp(glm::dvec3(colourAt(image, x, y)), 0.0, 1.0);
  return image.channels == 1 ? value.x : 0.2126 * value.x + 0.7152 * value.y + 0.0722 * value.z;
}

// Moments of one row of all windows around y: the Gaussian along x at every pixel.
void momentsAlongRow(const Image& reference, const Image& test, int y, const Window& window, std::vector<Moments>& row,
                     Moments* out) {
  row.resize(static_cast<std::size_t>(reference.width + 2 * kRadius));
  for (std::size_t i = 0; i < row.size(); ++i) {
    const int x = mirrored(static_cast<int>(i) - kRadius, reference.width);
    const double a = lumaAt(reference, x, y);
    const double b = lumaAt(test, x, y);
    row[i] = {a, b, a * a, b * b, a * b};
  }
  for (std::size_t x = 0; x < static_cast<std::size_t>(reference.width); ++x) {
    out[x] = {};
    for (std::size_t k = 0; k < window.size(); ++k) {
      for (std::size_t m = 0; m < kMoments; ++m) out[x][m] += window[k] * row[x + k][m];
    }
  }
}

// Equation 13. Equal windows have equal terms above and below, bit for bit, so that they give exactly 1.
double similarity(const Moments& m) {
  const double varianceX = m[2] - m[0] * m[0];
  const double varianceY = m[3] - m[1] * m[1];
  const double covariance = m[4] - m[0] * m[1];
  return (2.0 * m[0] * m[1] + kC1) * (2.0 * covariance + kC2) /
         ((m[0] * m[0] + m[1] * m[1] + kC1) * (varianceX + varianceY + kC2));
}

// How many pixels at each end of a side the mean leaves out.
int margin(int side) {
  return side > 2 * kRadius ? kRadius : 0;
}

// Fills rows [begin, end) of the map and their sums over the counted columns.
void similarityOfRows(const Image& reference, const Image& test, int begin, int end, Image& map,
                      std::vector<double>& rowSums) {
  const Window window = gaussianWindow();
  const std::size_t width = static_cast<std::size_t>(reference.width);
  std::vector<Moments> row;
  std::vector<Moments> alongRows(width * static_cast<std::size_t>(end - begin + 2 * kRadius));
  for (int y = begin - kRadius; y < end + kRadius; ++y) {
    momentsAlongRow(reference, test, mirrored(y, reference.height), window, row,
                    alongRows.data() + width * static_cast<std::size_t>(y - begin + kRadius));
  }
  const int left = margin(reference.width);
  for (int y = begin; y < end; ++y) {
    for (int x = 0; x < reference.width; ++x) {
      Moments sum{};
      const Moments* top = alongRows.data() + width * static_cast<std::size_t>(y - begin) + x;
      for (std::size_t k = 0; k < window.size(); ++k) {
        for (std::size_t m = 0; m < kMoments; ++m) sum[m] += window[k] * top[k * width][m];
      }
      const double value = similarity(sum);
      map.at(x, y, 0) = static_cast<float>(value);
      if (x >= left && x < reference.width - left) rowSums[static_cast<std::size_t>(y)] += value;
    }
  }
}

}  // namespace

Result<Ssim> ssim(const Image& referenceDisplay, const Image& testDisplay, const JobContext& job) {
  SWARD_TRY(checkComparable(referenceDisplay, testDisplay, ChannelNeed::Colour, job));
  const int width = referenceDisplay.width;
  const int height = referenceDisplay.height;
  Ssim result{0.0, Image(width, height, 1)};
  std::vector<double> rowSums(static_cast<std::size_t>(height), 0.0);
  base::parallelFor(job, rowSums.size(), kRowsAtOnce, [&](std::size_t begin, std::size_t end) {
    similarityOfRows(referenceDisplay, testDisplay, static_cast<int>(begin), static_cast<int>(end), result.map,
                     rowSums);
  });
  if (job.cancelled()) return Error::cancelled();
  for (int y = margin(height); y < height - margin(height); ++y) result.mean += rowSums[static_cast<std::size_t>(y)];
  result.mean /= static_cast<double>(width - 2 * margin(width)) * static_cast<double>(height - 2 * margin(height));
  return result;
}

}  // namespace sward::image
