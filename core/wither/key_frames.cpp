#include "wither/key_frames.h"

#include "wither/extinction.h"
#include "wither/mingle.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace sward::wither {
namespace {

constexpr int kCell = TexelGrid::kBrick;

/// Opacity, and opacity times the root of reflectance.
using Look = std::array<double, 4>;

/// The view along one axis of a block.
struct View {
  int axis = 0, across = 0, up = 0;  ///< the axes of its columns and of its picture
  glm::ivec2 size{0};                ///< columns of voxels

  View(const TexelGrid& grid, int along)
      : axis(along), across(along == 0 ? 1 : 0), up(along == 2 ? 1 : 2), size(grid.size()[across], grid.size()[up]) {}
  std::size_t columnOf(const glm::u16vec3& place) const {
    return static_cast<std::size_t>(place[up]) * static_cast<std::size_t>(size.x) + place[across];
  }
};

/// Looks of a view's cells, row by row.
std::vector<Look> cellsOf(const Texel& texel, const View& view) {
  glm::dvec3 along(0.0);
  along[view.axis] = 1.0;
  const double length = texel.grid().voxelM()[view.axis];
  std::vector<Look> columns(static_cast<std::size_t>(view.size.x) * static_cast<std::size_t>(view.size.y), Look{});
  for (std::size_t i = 0; i < texel.size(); ++i) {
    const Voxel& voxel = texel.voxels()[i];
    const double depth = extinction(voxel, along) * length;
    Look& column = columns[view.columnOf(texel.places()[i])];
    column[0] += depth;
    for (std::size_t c = 0; c < 3; ++c)
      column[c + 1] += depth * static_cast<double>(voxel.diffuse[static_cast<int>(c)]);
  }
  const int row = view.size.x / kCell;
  std::vector<Look> cells(static_cast<std::size_t>(row) * static_cast<std::size_t>(view.size.y / kCell), Look{});
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const Look& column = columns[i];
    if (!(column[0] > 0.0)) continue;
    const auto x = static_cast<int>(i) % view.size.x / kCell, y = static_cast<int>(i) / view.size.x / kCell;
    Look& cell = cells[static_cast<std::size_t>(y * row + x)];
    const double opacity = -std::expm1(-column[0]) / (kCell * kCell);
    cell[0] += opacity;
    for (std::size_t c = 1; c < 4; ++c) cell[c] += opacity * column[c] / column[0];
  }
  for (Look& cell : cells) {
    // alpha sqrt(sum of alpha c / alpha) = sqrt(alpha sum)
    for (std::size_t c = 1; c < 4; ++c) cell[c] = std::sqrt(std::max(cell[0] * cell[c], 0.0));
  }
  return cells;
}

/// A stretch between two frames, with the true texel in its middle.
struct Interval {
  KeyFrame low, middle, high;
  KeyFrame lowQuarter, highQuarter;  ///< made only where the middle is well
  double error = 0.0;
};

/// Makes texels and measures intervals.
class Chooser {
 public:
  Chooser(const TexelAt& texelAt, const KeyFrameOptions& options, const JobContext& job)
      : m_texelAt(texelAt), m_largest(std::max(options.largestError, 0.0)), m_job(job) {}

  Result<KeyFrame> frame(double weathering) {
    if (m_job.cancelled()) return Error::cancelled();
    SWARD_ASSIGN(Texel texel, m_texelAt(weathering));
    ++m_made;
    return KeyFrame{weathering, std::make_shared<const Texel>(std::move(texel))};
  }

  /// `middle` may be known already.
  Result<Interval> interval(const KeyFrame& low, const KeyFrame& middle, const KeyFrame& high) {
    Interval interval{low, middle, high, {}, {}, 0.0};
    if (middle.texel == nullptr) {
      SWARD_ASSIGN(interval.middle, frame(0.5 * (low.weathering + high.weathering)));
    }
    SWARD_ASSIGN(interval.error, differenceAt(interval, interval.middle));
    if (interval.error > m_largest) return interval;
    // A change that is odd about the middle vanishes there.
    SWARD_ASSIGN(interval.lowQuarter, frame(0.5 * (low.weathering + interval.middle.weathering)));
    SWARD_ASSIGN(interval.highQuarter, frame(0.5 * (interval.middle.weathering + high.weathering)));
    for (const KeyFrame* quarter : {&interval.lowQuarter, &interval.highQuarter}) {
      SWARD_ASSIGN(const double error, differenceAt(interval, *quarter));
      interval.error = std::max(interval.error, error);
    }
    return interval;
  }

  int made() const { return m_made; }

 private:
  Result<double> differenceAt(const Interval& interval, const KeyFrame& truth) const {
    const double t =
        (truth.weathering - interval.low.weathering) / (interval.high.weathering - interval.low.weathering);
    SWARD_ASSIGN(const Texel between, lerp(*interval.low.texel, *interval.high.texel, t, m_job));
    return lookDifference(*truth.texel, between);
  }

  const TexelAt& m_texelAt;
  double m_largest;
  const JobContext& m_job;
  int m_made = 0;
};

KeyFrames framesOf(const std::vector<Interval>& intervals, int made) {
  KeyFrames result;
  result.made = made;
  for (const Interval& interval : intervals) {
    result.frames.push_back(interval.low);
    result.error = std::max(result.error, interval.error);
  }
  result.frames.push_back(intervals.back().high);
  return result;
}

}  // namespace

Result<double> lookDifference(const Texel& a, const Texel& b) {
  if (a.grid() != b.grid()) {
    return Error::badInput("two texels of different grids cannot be compared", "key frames",
                           "Make all key frames in one grid.");
  }
  double largest = 0.0;
  for (int axis = 0; axis < 3; ++axis) {
    const View view(a.grid(), axis);
    const std::vector<Look> first = cellsOf(a, view), second = cellsOf(b, view);
    Look sums{};
    double opacity = 0.0, other = 0.0;
    for (std::size_t i = 0; i < first.size(); ++i) {
      for (std::size_t c = 0; c < 4; ++c) sums[c] += std::abs(first[i][c] - second[i][c]);
      opacity += first[i][0];
      other += second[i][0];
    }
    const double covered = std::max(opacity, other);
    for (const double sum : sums) largest = std::max(largest, covered > 0.0 ? sum / covered : 0.0);
  }
  return largest;
}

Result<Texel> KeyFrames::at(double weathering, const JobContext& job) const {
  if (frames.empty()) return Error::badInput("there are no key frames", "key frames", "Choose some first.");
  const auto above =
      std::find_if(frames.begin(), frames.end(), [&](const KeyFrame& frame) { return frame.weathering >= weathering; });
  if (above == frames.end()) return *(weathering >= 0.0 ? frames.back() : frames.front()).texel;
  if (above == frames.begin() || above->weathering == weathering) return *above->texel;
  const KeyFrame& below = *(above - 1);
  return lerp(*below.texel, *above->texel, (weathering - below.weathering) / (above->weathering - below.weathering),
              job);
}

Result<KeyFrames> chooseKeyFrames(const TexelAt& texelAt, const KeyFrameOptions& options, const JobContext& job) {
  Chooser chooser(texelAt, options, job);
  SWARD_ASSIGN(const KeyFrame first, chooser.frame(0.0));
  SWARD_ASSIGN(const KeyFrame last, chooser.frame(1.0));
  SWARD_ASSIGN(Interval whole, chooser.interval(first, {}, last));
  std::vector<Interval> intervals{std::move(whole)};
  const double largest = std::max(options.largestError, 0.0);
  while (static_cast<int>(intervals.size()) + 1 < options.mostFrames) {
    const auto wide = [&](const Interval& interval) {
      return interval.high.weathering - interval.low.weathering >= 2.0 * options.narrowest;
    };
    const auto worst = std::max_element(intervals.begin(), intervals.end(), [&](const Interval& a, const Interval& b) {
      return (wide(a) ? a.error : -1.0) < (wide(b) ? b.error : -1.0);
    });
    if (!wide(*worst) || worst->error <= largest) break;
    SWARD_ASSIGN(Interval low, chooser.interval(worst->low, worst->lowQuarter, worst->middle));
    SWARD_ASSIGN(Interval high, chooser.interval(worst->middle, worst->highQuarter, worst->high));
    *worst = std::move(low);
    intervals.insert(worst + 1, std::move(high));
  }
  return framesOf(intervals, chooser.made());
}

}  // namespace sward::wither
