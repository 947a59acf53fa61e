#pragma once

#include "report/fit_oracle.h"

#include <span>

/// Rounding bounds of lpt::fit, private to core/report. With m rows and n unknowns, u = 2^-53, gamma = (m + n) n u (the
/// m n u of Higham, Accuracy and Stability of Numerical Algorithms, 2002, theorem 19.4, and the rounding of rows, mean
/// and expansion to powers of u), s the largest singular value, k the condition, x the solution, y the right-hand side
/// and r the residual:
///
/// - orthogonal: Householder QR and the decomposition of R solve a problem that is off by gamma relative in matrix and
///   right-hand side; by Wedin's theorem (Higham, 20.1; for the pseudo-inverse, where rank is lost, one more k |x|)
///     |dx| <= gamma (2 k |x| + k |y| / s + k^2 |r| / s),
///   k with the gap below the last singular value that is kept in place of that value;
/// - moments: normal equations are off by gamma s^2 in the matrix and gamma s |y| on the right, and have condition k^2:
///     |dx| <= gamma k^2 (|x| + |y| / s).
///   The same holds of a pseudo-inverse that is computed once and applied to all samples (PTM).
///
/// Coefficients are then stored as float: |db_j| <= 2^-24 |b_j| + 2^-150, which is nearly all of the error wherever
/// there is a ridge.
namespace sward::report::detail {

/// |dx| as above.
double solverBound(const OracleSolution& exact, std::size_t channel, bool normalEquations);

/// |f - exact| where f = sum b_j phi_j is read from stored coefficients: the solver's error along phi, storage, and
/// 2^-50 for the sum in double.
double valueBound(double solver, std::span<const float> coefficients, std::span<const double> phi,
                  std::span<const double> centred);

/// Largest |b_j|. With ridges: the minimum is not above its value at the best constant, S^2 (the weighted variance of
/// the samples), so sum_j ridge_j c_j^2 <= S^2; the free constant is ybar - sum_j c_j mean(phi_j), where the six light
/// functions (less the constant) have squares that sum to 5.5 or less on the unit disc and the four of v to 9 or less,
/// so |c9| <= |ybar| + S (5.5 / lightRidge + 9 / layerRidge)^(1/2); and going from v to u adds 3 |c| of the layer
/// coefficients at most. Without: |x| <= |y| / (s / k).
double coefficientBound(const OracleSolution& exact, std::size_t channel, const lpt::FitOptions& options);

}  // namespace sward::report::detail
