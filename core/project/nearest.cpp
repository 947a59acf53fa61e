#include "project/nearest.h"

#include <algorithm>
#include <cctype>
#include <numeric>

namespace sward::project {
namespace {

char lower(char c) {
  return static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
}

/// Levenshtein's distance, case ignored.
std::size_t editDistance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t change = diagonal + (lower(a[i - 1]) == lower(b[j - 1]) ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, change});
    }
  }
  return row[b.size()];
}

}  // namespace

std::string nearestName(std::string_view given, const std::vector<std::string>& known) {
  if (given.size() > 64) return {};
  std::string best;
  std::size_t bestDistance = 0;
  for (const std::string& name : known) {
    const std::size_t distance = editDistance(given, name);
    if (best.empty() || distance < bestDistance) {
      best = name;
      bestDistance = distance;
    }
  }
  const std::size_t allowed = std::max<std::size_t>(2, given.size() / 2);
  return bestDistance <= allowed ? best : std::string{};
}

}  // namespace sward::project
