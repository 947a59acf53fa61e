#include "report/row.h"

#include <algorithm>
#include <chrono>

namespace sward::report {
namespace {

double millisecondsOf(const std::function<void()>& body) {
  const auto start = std::chrono::steady_clock::now();
  body();
  return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
}

TimeMs spread(std::vector<double> times) {
  std::sort(times.begin(), times.end());
  const std::size_t n = times.size();
  const double median = n % 2 == 1 ? times[n / 2] : 0.5 * (times[n / 2 - 1] + times[n / 2]);
  return {median, times.front(), times.back(), static_cast<int>(n)};
}

}  // namespace

TimeMs timeRuns(int runs, const std::function<void()>& body) {
  body();
  std::vector<double> times;
  for (int run = 0; run < std::max(runs, 1); ++run) times.push_back(millisecondsOf(body));
  return spread(std::move(times));
}

std::pair<TimeMs, TimeMs> timePairs(int runs, const std::function<void()>& a, const std::function<void()>& b) {
  a();
  b();
  std::vector<double> timesA, timesB;
  for (int run = 0; run < std::max(runs, 1); ++run) {
    timesA.push_back(millisecondsOf(a));
    timesB.push_back(millisecondsOf(b));
  }
  return {spread(std::move(timesA)), spread(std::move(timesB))};
}

}  // namespace sward::report
