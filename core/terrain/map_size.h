#pragma once

#include "base/result.h"
#include "terrain/heightmap.h"

#include <string>

namespace sward::terrain {

/// Refuses sizes that are no surface (one sample a side) or too large.
Result<void> checkMapSize(double columns, double rows, const std::string& place);

/// Refuses a map without a single known height.
Result<void> checkKnown(const RawHeights& raw, const std::string& name);

}  // namespace sward::terrain
