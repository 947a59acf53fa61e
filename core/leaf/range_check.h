#pragma once

#include "base/result.h"

#include <string>

namespace sward::leaf {

/// An error that names the value, its unit and its range unless `value` is finite and in [low, high].
Result<void> checkRange(const std::string& name, double value, double low, double high, const std::string& unit,
                        const std::string& where);

}  // namespace sward::leaf
