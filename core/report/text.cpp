#include "report/text.h"

#include <array>
#include <cmath>
#include <cstdio>

namespace sward::report {

std::string numberText(double value) {
  if (!std::isfinite(value)) return "null";
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.6g", value);
  return text.data();
}

}  // namespace sward::report
