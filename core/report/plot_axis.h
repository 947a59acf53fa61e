#pragma once

#include <span>
#include <string>
#include <vector>

namespace sward::report {

/// One axis of a plot: its range, and where its marks stand.
struct Axis {
  struct Tick {
    double value = 0.0;
    std::string label;  ///< empty: a mark between labelled ones
  };
  double low = 0.0, high = 1.0;  ///< low < high; both above 0 when logarithmic
  bool log = false;
  std::vector<Tick> ticks;  ///< within [low, high], rising

  /// Where a value lies between low (0) and high (1); linear beyond.
  double place(double value) const;
};

/// The axis that shows all of `values` with some room at both ends: those that are finite and, on a logarithmic axis,
/// above 0. Ticks stand at 1, 2 or 5 times powers of ten (or the powers alone where many fit); a linear axis of values
/// that are not negative starts at 0 unless they lie close together far from it. No values: [0, 1] or [1, 10].
Axis axisOf(std::span<const double> values, bool log);
/// The same for what curves run over (a wavelength, a season), whose size is no measure: a linear axis starts where the
/// values do, but for those that start near 0.
Axis domainAxisOf(std::span<const double> values, bool log);

}  // namespace sward::report
