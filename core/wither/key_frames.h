#pragma once

#include "base/job.h"
#include "base/result.h"
#include "wither/texel.h"

#include <functional>
#include <memory>
#include <vector>

namespace sward::wither {

/// How differently two texels of one grid look from afar, relative to what they cover: the largest, over the views
/// along x, y and z through one block, of the sum over the view's cells (8 x 8 columns of voxels) of the absolute
/// difference of opacity, and of that of opacity times the root of reflectance (about what a display shows) in the
/// channel where it is largest, over the sum of opacity of the one that covers more. 0: alike; 1: one of them is empty;
/// 2: nowhere at the same place. So a texel of a few blades counts as one of many does. The opacity of a column is 1 -
/// exp(-sum of extinctions times length); a cell's is its columns' mean; reflectance is weighted by extinction along a
/// column and by opacity over a cell. Errors: different grids.
Result<double> lookDifference(const Texel& a, const Texel& b);

struct KeyFrame {
  double weathering = 0.0;
  std::shared_ptr<const Texel> texel;
};

/// Texels at chosen weathering degrees, between which others are interpolated (lerp).
struct KeyFrames {
  std::vector<KeyFrame> frames;  ///< rising, from 0 to 1; at least two
  double error = 0.0;            ///< the largest look difference that was measured between frames
  int made = 0;                  ///< texels that were asked for
  /// The texel at a degree, clamped to [0, 1]: a frame's own, or lerp between its neighbours. Errors: lerp's.
  Result<Texel> at(double weathering, const JobContext& job) const;
};

/// Makes the texel at a weathering degree.
using TexelAt = std::function<Result<Texel>(double weathering)>;

struct KeyFrameOptions {
  double largestError = 0.02;    ///< look difference; below 0 counts as 0
  int mostFrames = 65;           ///< at least 2
  double narrowest = 1.0 / 256;  ///< no two frames are nearer than that
};

/// Chooses key frames by bisection, the worst interval first: frames at 0 and 1, and in the middle of any interval
/// where the interpolated texel looks different from the true one by more than the largest error, in its middle or,
/// where that is well, at its quarters. Stops when all are well, at mostFrames, or at the narrowest interval, where a
/// jump lies. Holds the texels of all frames, and up to three more for each interval. Same frames on any number of
/// threads. Errors: those of `texelAt`, texels of different grids, Error::cancelled().
Result<KeyFrames> chooseKeyFrames(const TexelAt& texelAt, const KeyFrameOptions& options, const JobContext& job);

}  // namespace sward::wither
