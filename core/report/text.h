#pragma once

#include <string>

namespace sward::report {

/// A number as JSON has it, six significant digits; "null" where it is not finite.
std::string numberText(double value);

}  // namespace sward::report
