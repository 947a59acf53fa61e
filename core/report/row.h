#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace sward::report {

/// Repeated timings of one thing, in milliseconds.
struct TimeMs {
  double median = 0.0, min = 0.0, max = 0.0;
  int runs = 0;
};

/// One row of report.json (design.md). Only what was measured in this run is set.
struct Row {
  std::string method;
  std::map<std::string, std::string>
      numbersAndNames;  ///< "parameters": values as JSON text, such as {"slices", "16"} or {"basis", "\"lpt\""}
  std::optional<TimeMs> timeMs;
  std::optional<double> rate;  ///< per second, of what `rateUnit` says
  std::string rateUnit;        ///< goes into the parameters as "rate_unit"
  std::optional<double>
      ratio;  ///< this over `against`, as rate over rate (above 1 is better) unless notes say otherwise
  std::string against;
  std::optional<double> bakeSeconds;
  std::optional<std::uint64_t> bytes, bytesTotal;
  std::map<std::string, double> error;
  std::string reference;
  std::string notes;
};

/// Runs `body` `runs` times after one warm-up and gives the spread.
TimeMs timeRuns(int runs, const std::function<void()>& body);
/// Two bodies in turn, A B A B, so that a noisy machine hits both alike.
std::pair<TimeMs, TimeMs> timePairs(int runs, const std::function<void()>& a, const std::function<void()>& b);

}  // namespace sward::report
