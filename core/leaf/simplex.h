#pragma once

#include <functional>
#include <vector>

namespace sward::leaf {

/// The place of a local minimum of `f` by the downhill simplex (Nelder and Mead 1965), from `start` with an edge of
/// `step` in every coordinate, after `evaluations` calls of `f` at most; NaN counts as worse than everything. Started
/// again twice from the best place so far, since a simplex may collapse on the way. Deterministic.
std::vector<double> minimumOf(const std::function<double(const std::vector<double>&)>& f, std::vector<double> start,
                              double step, int evaluations);

}  // namespace sward::leaf
