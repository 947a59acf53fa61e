#include "leaf/range_check.h"

#include <cstdio>

namespace sward::leaf {
namespace {

std::string shortText(double value) {
  char text[32];
  std::snprintf(text, sizeof(text), "%g", value);
  return text;
}

}  // namespace

Result<void> checkRange(const std::string& name, double value, double low, double high, const std::string& unit,
                        const std::string& where) {
  // NaN fails both comparisons.
  if (value >= low && value <= high) return {};
  const std::string suffix = unit.empty() ? "" : " " + unit;
  return Error::badInput(name + " is " + shortText(value) + suffix, where,
                         "Give " + shortText(low) + " to " + shortText(high) + suffix + ".");
}

}  // namespace sward::leaf
