#pragma once

#include "base/bytes.h"
#include "base/job.h"
#include "base/result.h"
#include "lpt/common_response.h"
#include "lpt/options.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

namespace sward::lpt {

/// What a fit reads: sparse samples of a layer set (trace::LayerHits' layout), `channels` responses fitted with the
/// same weights. All spans are the caller's.
struct FitInput {
  int columns = 0;
  int layers = 0;                              ///< u of layer i is i / layers
  std::span<const std::uint32_t> columnStart;  ///< columns + 1
  std::span<const std::uint8_t> layer;         ///< one a texel
  std::span<const float> coverage;             ///< alpha, one a texel
  std::span<const float> visibility;           ///< delta, one a texel
  int visibilityDirections = 16;               ///< m: weights never fall under 1/(2m)
  /// What the sky gives a texel, reflected and transmitted, one a texel; empty: not known (LayerCoordinate).
  std::array<std::span<const float>, 2> sky;
  std::span<const glm::dvec3> lights;  ///< unit vectors
  int channels = 1;
  /// samples[channel * lights.size() + k][texel] is the response under light k.
  std::vector<std::span<const float>> samples;
};

enum class FitPath : std::uint8_t {
  Empty,      ///< no texel: all coefficients 0
  Moments,    ///< normal equations from precomputed moments, by block elimination (PTM: one pseudo-inverse for all)
  Orthogonal  ///< rank-revealing orthogonal decomposition: `paper`, too few lights, missing samples, a pivot too small
};

/// Coefficients of every column, with what is needed to judge them.
struct Fit {
  Basis basis = Basis::Lpt;
  int columns = 0, layers = 0, channels = 1;
  int perColumn = 10;               ///< coefficients of one channel of one column: 10 (LPT) or 6 * layers (PTM)
  std::vector<float> coefficients;  ///< [column][channel][perColumn]; the ten are b of lptBasis (u, not v)
  std::vector<std::uint8_t>
      rank;  ///< numerical rank of the data alone (before the ridge), per column; PTM: the least of its layers'
  /// 2-norm condition of the least-squares system solved (weighted rows with the ridge's; of its numerical rank where
  /// that is deficient), per column; 0 where empty. Moments: estimated by power and inverse iteration, never above the
  /// true one and in practice within a tenth below it. Orthogonal: from singular values. PTM: the largest of its
  /// layers'.
  std::vector<float> condition;
  std::vector<float> weight;  ///< summed weight of the column's texels; 0 where empty
  std::vector<FitPath> path;  ///< PTM: Orthogonal when any of its layers is
  /// PTM (and what else has its own coefficients a layer texel): weight of each layer texel, [column][layer], 0 where
  /// there is none; empty for LPT.
  std::vector<float> layerWeight;
  /// What the columns of an LPT share; then the ten are those of responseBasis. Empty: those of lptBasis.
  CommonResponse common;

  std::span<const float> column(int column, int channel) const {
    return std::span(coefficients)
        .subspan((static_cast<std::size_t>(column) * static_cast<std::size_t>(channels) +
                  static_cast<std::size_t>(channel)) *
                     static_cast<std::size_t>(perColumn),
                 static_cast<std::size_t>(perColumn));
  }
};

/// Weighted, centred, regularised least squares of science.md section 1 (LPT, equation 4; PTM per layer texel), or the
/// paper's own (options.paper): least squares of minimum norm in u. LayerCoordinate::Response needs sky terms and
/// lights that tell the six functions of a PTM apart; without them, the coordinate is Depth. In Response, a sample
/// that is not finite leaves out its texel, and rank is that of the nine functions on distinct coordinates. Weights are
/// max(delta, 1/(2m)) alpha; delta alone for a paper's LPT. Texels without a positive, finite weight count as absent. A
/// sample that is not finite leaves out its row (texel and light) in every channel; the result never holds a NaN.
/// Columns without a row are empty: zero coefficients. Same bytes on any number of threads. Errors: no lights or one
/// that is not finite, lengths or layers that do not match, ridges below 0; Error::cancelled(). Throws ContractError
/// for a basis other than Lpt and Ptm: represent() has them all.
Result<Fit> fit(const FitInput& input, const FitOptions& options, const JobContext& job);

/// One response a texel as a fit of basis Constant: the light of one sun, or a mean over lights.
/// responses[channel][texel] as in `input`, whose samples and lights are not read; values that are not finite count as
/// absent.
Fit constantFit(const FitInput& input, std::span<const std::span<const float>> responses);

/// Fills empty columns from their neighbours on a periodic or bordered width x height image (pull-push, weighted by the
/// columns' weight), so that filtering across an outline is sound. Of a basis with coefficients a layer texel every
/// layer image is filled by itself, weighted by layerWeight; a layer without any texel stays zero.
void fillEmpty(Fit& fit, int width, int height, bool periodic);

/// Cache payload. load returns false on damaged data and leaves `fit` as it was.
void save(base::ByteWriter& out, const Fit& fit);
bool load(base::ByteReader& in, Fit& fit);

}  // namespace sward::lpt
