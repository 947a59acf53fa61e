#include "report/plot_axis.h"

#include "report/markup.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace sward::report {
namespace {

constexpr double kRoom = 0.07;        ///< of the range, at each end: a marker is never cut by the frame
constexpr double kFromZero = 0.7;     ///< values whose least is under this part of the greatest show 0 as well
constexpr double kDomainZero = 0.15;  ///< the same of what curves run over

std::string superscript(int exponent) {
  static const std::array<const char*, 10> digits{"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string out = exponent < 0 ? "⁻" : "";
  for (const char digit : std::to_string(std::abs(exponent))) out += digits[static_cast<std::size_t>(digit - '0')];
  return out;
}

/// mantissa * 10^exponent as short as it is readable: "0.02", "500", "20 k", "5·10⁻⁷".
std::string tickLabel(int mantissa, int exponent) {
  if (exponent < -4 || exponent > 14) {
    return (mantissa == 1 ? "" : std::to_string(mantissa) + "·") + "10" + superscript(exponent);
  }
  if (exponent < 0) return fixedText(mantissa * std::pow(10.0, exponent), -exponent);
  constexpr std::array<const char*, 5> kPrefixes{"", " k", " M", " G", " T"};
  const auto prefix = static_cast<std::size_t>(exponent < 4 ? 0 : exponent / 3);
  return std::to_string(mantissa) + std::string(static_cast<std::size_t>(exponent) - 3 * prefix, '0') +
         kPrefixes[prefix];
}

/// The step of 1, 2 or 5 times a power of ten that parts `range` into about `parts`.
double niceStep(double range, int parts) {
  const double raw = range / parts;
  const double power = std::pow(10.0, std::floor(std::log10(raw)));
  const double mantissa = raw / power;
  return power * (mantissa < 1.5 ? 1.0 : mantissa < 3.5 ? 2.0 : mantissa < 7.5 ? 5.0 : 10.0);
}

void addLinearTicks(Axis& axis) {
  const double step = niceStep(axis.high - axis.low, 5);
  const double largest = std::max(std::abs(axis.low), std::abs(axis.high));
  const bool prefixed = largest >= 1e4 && step >= 100.0;
  const bool tiny = step < 1e-4;
  const int decimals = std::max(0, -static_cast<int>(std::floor(std::log10(step) + 1e-9)));
  for (double i = std::ceil(axis.low / step - 1e-9); i * step <= axis.high * (1.0 + 1e-12) + 1e-12 * step; ++i) {
    const double value = i * step;
    std::string label = prefixed && i != 0.0 ? prefixedText(value)
                        : tiny               ? figureText(value)
                                             : fixedText(value, decimals);
    while (!label.empty() && label.back() == ' ') label.pop_back();
    axis.ticks.push_back({value, label});
  }
}

/// Ticks at 1 to 9 times powers of ten; which are labelled depends on how many decades there are.
void addLogTicks(Axis& axis) {
  const double decades = std::log10(axis.high) - std::log10(axis.low);
  if (decades < 0.75) return addLinearTicks(axis);
  const int first = static_cast<int>(std::floor(std::log10(axis.low)));
  const int last = static_cast<int>(std::ceil(std::log10(axis.high)));
  const int every = std::max(1, static_cast<int>(std::ceil(decades / 8.0)));
  for (int exponent = first; exponent <= last; ++exponent) {
    for (int mantissa = 1; mantissa <= 9; ++mantissa) {
      const double value = mantissa * std::pow(10.0, exponent);
      if (value < axis.low || value > axis.high) continue;
      const bool power = mantissa == 1 && exponent % every == 0;
      const bool between = decades < 2.3 && (mantissa == 2 || mantissa == 5);
      if (mantissa > 1 && decades > 5.0) continue;
      axis.ticks.push_back({value, power || between ? tickLabel(mantissa, exponent) : std::string()});
    }
  }
}

Axis logAxis(const std::vector<double>& values) {
  Axis axis{1.0, 10.0, true, {}};
  if (!values.empty()) {
    double low = std::log10(*std::min_element(values.begin(), values.end()));
    double high = std::log10(*std::max_element(values.begin(), values.end()));
    // Less than a third of a decade would make differences of per cents look large.
    const double missing = std::max(0.0, 0.35 - (high - low));
    low -= 0.5 * missing;
    high += 0.5 * missing;
    const double room = kRoom * (high - low);
    // Kept where a double holds them.
    axis.low = std::pow(10.0, std::max(low - room, -300.0));
    axis.high = std::pow(10.0, std::min(high + room, 300.0));
  }
  addLogTicks(axis);
  return axis;
}

Axis linearAxis(const std::vector<double>& values, double zeroShare) {
  Axis axis{0.0, 1.0, false, {}};
  if (!values.empty()) {
    const double low = std::clamp(*std::min_element(values.begin(), values.end()), -1e300, 1e300);
    const double high = std::clamp(*std::max_element(values.begin(), values.end()), -1e300, 1e300);
    const bool fromZero = low >= 0.0 && low < zeroShare * high;
    double range = high - (fromZero ? 0.0 : low);
    if (!(range > 1e-9 * std::max(std::abs(low), std::abs(high)))) range = high == 0.0 ? 1.0 : 0.2 * std::abs(high);
    const double middle = 0.5 * (low + high);
    axis.low = fromZero ? 0.0 : std::min(low, middle - 0.5 * range) - kRoom * range;
    axis.high = std::max(high, middle + 0.5 * range) + kRoom * range;
    if (fromZero) axis.high = high + kRoom * range;
  }
  addLinearTicks(axis);
  return axis;
}

std::vector<double> shownOf(std::span<const double> values, bool log) {
  std::vector<double> shown;
  for (const double value : values) {
    if (std::isfinite(value) && (!log || value > 0.0)) shown.push_back(value);
  }
  return shown;
}

}  // namespace

double Axis::place(double value) const {
  if (!log) return (value - low) / (high - low);
  return (std::log(value) - std::log(low)) / (std::log(high) - std::log(low));
}

Axis axisOf(std::span<const double> values, bool log) {
  const std::vector<double> shown = shownOf(values, log);
  return log ? logAxis(shown) : linearAxis(shown, kFromZero);
}

Axis domainAxisOf(std::span<const double> values, bool log) {
  const std::vector<double> shown = shownOf(values, log);
  return log ? logAxis(shown) : linearAxis(shown, kDomainZero);
}

}  // namespace sward::report
