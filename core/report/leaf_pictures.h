#pragma once

#include "base/result.h"
#include "leaf/fit_contents.h"
#include "leaf/measured_leaves.h"
#include "report/section.h"

#include <vector>

namespace sward::report {

/// A leaf's life for pictures, from 0 (fresh) to 1 (straw): chlorophyll goes first and faster, water follows.
struct LeafAge {
  double chlorophyllShare = 1.0, waterShare = 1.0;
};
LeafAge leafAge(double life);

/// Twelve ages from left to right, reflectance above, transmittance below.
Result<Strip> ageStrip(const leaf::LeafOptions& options, const std::string& name, const std::string& title);

struct FittedLeaf {
  leaf::MeasuredLeaf measured;
  leaf::FittedContents plates;
  leaf::FittedSubtraction subtraction;
};
/// A column for every leaf: measured, plates, subtraction from above.
Strip measuredStrip(const std::vector<FittedLeaf>& leaves);

/// Reflectance over wavelength at some ages.
Result<Plot> agePlot(const leaf::LeafOptions& options);

}  // namespace sward::report
