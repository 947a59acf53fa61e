#pragma once

#include "leaf/spectra.h"

#include <span>

namespace sward::leaf {

/// A measured reflectance of leaves, surface light included, to compare models with.
struct MeasuredLeaf {
  const char* name;    ///< for people
  const char* stage;   ///< green, turning or dry
  const char* record;  ///< of the library
  Spectrum reflectance;
};

/// Six from the USGS Spectral Library Version 7 (Kokaly et al. 2017, U.S. Geological Survey Data Series 1035; the data
/// are CC0 1.0), means over 10 nm, linear between: lawn grass, three aspen leaves (their first 14 nm repeat what was
/// measured at 414), two dry grasses. The grasses were measured as they lay, many blades deep.
std::span<const MeasuredLeaf> measuredLeaves();

}  // namespace sward::leaf
