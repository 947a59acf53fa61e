#pragma once

#include "lpt/fit.h"
#include "lpt/polynomial.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

/// Parts of fit() that its files share; not for other folders.
namespace sward::lpt::detail {

/// The errors that fit() documents.
Result<void> checkFit(const FitInput& input, const FitOptions& options);

/// Singular values of the weighted rows below this share of the largest count as zero: what they stand for would be the
/// rounding of float samples (6e-8), magnified a million times.
inline constexpr double kRankTolerance = 1e-6;
/// Normal equations are left for the orthogonal path when a pivot falls under this share of the largest eigenvalue:
/// above it, rounding costs the solution less than the 6e-8 of a float.
inline constexpr double kMinPivot = 1e-8;

/// What the columns of an LPT share: means over the lights of the products of their functions. With g = ptmBasis and
/// h = (2 lx, 2 ly, 2) the ten functions in v are g (6), v h (3) and v^2; normalised by the weight of the rows their
/// normal matrix is, since the weighted mean of v is 0 (mu_p the weighted mean of v^p),
///
///   [ A + ridge     0                mu2 E[g] ]
///   [ 0             mu2 H + ridge    mu3 E[h] ]      A = E[g g^T], H = E[h h^T]
///   [ mu2 E[g]^T    mu3 E[h]^T       mu4 + ridge ]
///
/// The light block is the same for every column, and in the eigenbases of both blocks the matrix is an arrowhead. The
/// constant, the sixth of g, has no ridge, so E[g] = A e6 = (A + ridge) e6: what the light block's inverse makes of
/// E[g] is e6, exactly, and E[g]^T (A + ridge)^-1 E[g] = E[g]^T e6 = 1. Computed from the inverse both would be off by
/// the condition of A + ridge, which the pivot of v^2, a difference, would magnify once more.
struct LightSystem {
  std::vector<std::array<double, 6>> functions;  ///< g of each light
  std::array<double, 36> inverse{};              ///< (A + ridge)^-1, symmetric
  std::array<double, 6> lightValues{};           ///< eigenvalues of A + ridge, ascending
  std::array<double, 6> lightMean{};             ///< E[g] in their eigenvectors
  std::array<double, 3> layerValues{};           ///< eigenvalues of H, ascending
  std::array<double, 3> layerMean{};             ///< E[h] in their eigenvectors
  std::array<double, 9> layerVectors{};          ///< [i * 3 + j]: component i of eigenvector j
  double dataScale = 0.0;                        ///< the largest eigenvalue of A alone
  int distinctLights = 0;                        ///< different (lx, ly)
  int lightRank = 0;                             ///< numerical rank of the six functions on the lights
  bool wellConditioned = false;                  ///< at least six lights, and A + ridge safe to invert
};
LightSystem makeLightSystem(std::span<const glm::dvec3> lights, const FitOptions& options);

/// Everything a block of columns reads and writes; columns and texels are disjoint between blocks.
struct FitJob {
  const FitInput& input;
  const FitOptions& options;
  const LightSystem& system;
  Fit& fit;

  std::size_t lights() const { return input.lights.size(); }
  std::span<const float> sample(std::size_t channel, std::size_t light) const {
    return input.samples[channel * lights() + light];
  }
  double u(std::size_t texel) const { return static_cast<double>(input.layer[texel]) / input.layers; }
  /// Weight of a texel's rows: 0 where it counts as absent.
  double weight(std::size_t texel) const;
};

/// Reused buffers of one block.
struct RowScratch {
  std::vector<double> rows;     ///< [row][n]
  std::vector<double> samples;  ///< [row][channel]
};

/// The least-squares problem of min sum_rows |row x - y|^2 + sum_j ridge_j x_j^2.
struct Rows {
  std::span<const double> rows;     ///< [row][n]
  std::span<const double> samples;  ///< [row][channel]
  std::span<const double> ridge;    ///< n
  int channels = 1;
};
struct RowSolution {
  std::vector<double> x;  ///< [channel][n], of minimum norm where the system is rank-deficient
  int rank = 0;           ///< of the rows without the ridge
  double condition = 0.0;
};
/// Orthogonal solution: Householder QR of the rows, then singular values of its triangle stacked on the ridge.
RowSolution solveRows(const Rows& problem);

/// Columns [begin, end) of an LPT.
void fitLptBlock(const FitJob& job, int begin, int end);
/// One column of an LPT from its rows: of an irregular column, or of every column of `paper`.
void fitLptColumnByRows(const FitJob& job, int column, RowScratch& scratch);

/// Whether the columns share a CommonResponse: LayerCoordinate::Response, and the input has what it needs.
bool hasCommonResponse(const FitJob& job);
/// By weighted least squares over all texels.
CommonResponse fitCommonResponse(const FitJob& job, const JobContext& context);
/// Columns [begin, end) of an LPT on the common response in job.fit.
void fitResponseBlock(const FitJob& job, int begin, int end);

/// (K x 6) pseudo-inverse that every complete texel of a PTM shares.
struct PtmSystem {
  std::vector<std::array<double, 6>> inverse;  ///< coefficients per unit of each light's sample
  int rank = 0;
  double condition = 0.0;
  FitPath path = FitPath::Moments;
};
PtmSystem makePtmSystem(const LightSystem& system, const FitOptions& options);
/// Columns [begin, end) of a PTM.
void fitPtmBlock(const FitJob& job, const PtmSystem& ptm, int begin, int end);

/// Sums over the lights of sample times g, for texels [begin, end): out[p * (end - begin) + texel - begin]. The last
/// sum (of the samples alone) is not finite exactly where a sample is not.
void lightMoments(const FitJob& job, std::size_t channel, std::span<const std::array<double, 6>> functions,
                  std::size_t begin, std::size_t end, std::span<double> out);

/// A coefficient as float; what float cannot hold becomes its largest value.
float storedCoefficient(double value);
/// A positive weight as float, which stays positive.
float storedWeight(double value);

}  // namespace sward::lpt::detail
