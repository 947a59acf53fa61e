#pragma once

#include "lpt/fit.h"

#include <cstddef>
#include <vector>

#include <glm/glm.hpp>

namespace sward::report {

/// A column of an LPT, or a layer texel of a PTM, solved in long double by none of core/lpt's code.
struct OracleSolution {
  int unknowns = 0;      ///< 10 or 6; 0 where nothing has a row
  int rows = 0;          ///< of data
  int rank = 0;          ///< of the system solved, ridge included
  int dataRank = 0;      ///< of the weighted rows alone
  long double mean = 0;  ///< ubar, the origin of v; 0 for `paper` and PTM
  /// Largest singular value; its ratio to the smallest that is kept; and to the gap below that one (the same but for
  /// rounding where nothing, or only zeros, are cut off).
  long double largest = 0, condition = 0, gapCondition = 0;
  /// By how much the nearest singular value of the system or of its rows misses the rank's tolerance, as a ratio >= 1.
  long double rankMargin = 0;
  struct Channel {
    std::vector<long double> x;     ///< coefficients in v
    long double rightHandSide = 0;  ///< 2-norm: root of the weighted mean square of the samples
    long double residual = 0;       ///< 2-norm, the ridge's rows included
    long double mean = 0;           ///< weighted mean of the samples
  };
  std::vector<Channel> channels;

  bool determined() const { return rank == unknowns; }
  /// 2-norm of the coefficients.
  long double norm(std::size_t channel) const;
  long double value(std::size_t channel, const glm::dvec3& light, long double u) const;
  /// Coefficients of the powers of u rather than v.
  std::vector<long double> expanded(std::size_t channel) const;
};

/// Texels [begin, end) of `input` as one problem, as lpt::FitOptions states it: all texels of a column for Basis::Lpt,
/// a single one for Basis::Ptm (u is left out). Rows are assembled from the samples, weighted by the root of
/// w / (W K), centred at the rows' weighted mean of u, the ridge's rows under them. Householder QR gives the solution
/// where the rank is full; where singular values of R fall under 1e-6 of the largest (which fit() documents as none),
/// the singular value decomposition of R gives the one of least norm.
OracleSolution solveOracle(const lpt::FitInput& input, const lpt::FitOptions& options, std::size_t begin,
                           std::size_t end);

}  // namespace sward::report
