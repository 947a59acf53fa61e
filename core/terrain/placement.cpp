#include "terrain/placement.h"

#include "base/random.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace sward::terrain {
namespace {

constexpr double kHectareM2 = 1e4;

Result<void> check(const PlacementRules& rules, const glm::dvec2& low, const glm::dvec2& high) {
  const auto bad = [](const std::string& what, const std::string& remedy) {
    return Error::badInput(what, "placement", remedy);
  };
  if (!std::isfinite(rules.perHectare) || rules.perHectare < 0.0) {
    return bad("a density of " + std::to_string(rules.perHectare) + " plants a hectare", "Give 0 or more");
  }
  if (!std::isfinite(rules.spacingM) || rules.spacingM < 0.0) {
    return bad("a spacing of " + std::to_string(rules.spacingM) + " m", "Give 0 or more");
  }
  if (std::isnan(rules.lowestM) || std::isnan(rules.highestM) || !std::isfinite(rules.steepestDeg) ||
      !(rules.featherM >= 0.0) || !(rules.featherDeg >= 0.0)) {
    return bad("heights, slopes or feathers that are no numbers", "Give heights in metres and slopes in degrees");
  }
  const glm::dvec2 size = high - low;
  if (!(size.x > 0.0) || !(size.y > 0.0) || !std::isfinite(size.x * size.y)) {
    return bad("a rectangle without area", "Give a lower and an upper corner");
  }
  const double asked = rules.perHectare / kHectareM2 * size.x * size.y;
  if (asked > kMostStands) {
    return bad(std::to_string(asked) + " plants", "Ask for at most 4 million: fewer a hectare, or a smaller area");
  }
  return {};
}

/// 0 at the bound and beyond, 1 from `feather` inside of it on.
double inside(double distance, double feather) {
  if (!(distance >= 0.0)) return 0.0;
  return feather > 0.0 ? std::min(distance / feather, 1.0) : 1.0;
}

/// Cells at least as wide as the spacing: what is too near to a place stands in the nine about it.
class Scatter {
 public:
  Scatter(const PlacementRules& rules, const glm::dvec2& low, const glm::dvec2& high, const HeightField& ground,
          const std::function<double(const glm::dvec2&)>& share)
      : m_rules(rules), m_low(low), m_high(high), m_ground(ground), m_share(share) {
    const double perM2 = std::max(rules.perHectare / kHectareM2, 1e-12);
    const glm::dvec2 size = high - low;
    // About one plant a cell; no more cells than twice the plants that there may be.
    const double wanted = std::max(rules.spacingM, 1.0 / std::sqrt(perM2));
    m_columns = static_cast<int>(std::clamp(std::floor(size.x / wanted), 1.0, 2.0 * kMostStands));
    m_rows = static_cast<int>(std::clamp(std::floor(size.y / wanted), 1.0, 2.0 * kMostStands));
    m_cell = size / glm::dvec2(m_columns, m_rows);
    m_mean = perM2 * m_cell.x * m_cell.y;
    m_start.assign(static_cast<std::size_t>(m_columns) * static_cast<std::size_t>(m_rows) + 1, 0);
  }

  Result<std::vector<Stand>> run(const JobContext& job) {
    for (int row = 0; row < m_rows; ++row) {
      if (job.cancelled()) return Error::cancelled();
      for (int column = 0; column < m_columns; ++column) fill(column, row);
    }
    return std::move(m_stands);
  }

 private:
  std::size_t cellAt(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(m_columns) + static_cast<std::size_t>(column);
  }

  void fill(int column, int row) {
    base::Random random(base::mix64(m_rules.seed, cellAt(column, row)));
    const std::size_t cell = cellAt(column, row);
    const int count = m_rules.perHectare > 0.0 ? static_cast<int>(std::floor(m_mean + random.uniform())) : 0;
    for (int i = 0; i < count; ++i) throwDarts(column, row, random);
    m_start[cell + 1] = m_stands.size();
  }

  void throwDarts(int column, int row, base::Random& random) {
    const double threshold = random.uniform();
    const std::uint64_t seed = random.next();
    for (int i = 0; i < kThrows; ++i) {
      const glm::dvec2 place =
          m_low + m_cell * (glm::dvec2(column, row) + glm::dvec2(random.uniform(), random.uniform()));
      const HeightSample ground = m_ground.sample(place);
      const double share = m_share ? std::clamp(m_share(place), 0.0, 1.0) : 1.0;
      // The first dart decides whether this plant is one of those that the density leaves; later ones must keep to it.
      if (!(threshold < allowed(m_rules, ground) * share)) {
        if (i == 0) return;
        continue;
      }
      if (tooNear(place, column, row)) continue;
      m_stands.push_back({glm::dvec3(place, ground.heightM), seed});
      return;
    }
  }

  bool tooNear(const glm::dvec2& place, int column, int row) const {
    const double least = m_rules.spacingM * m_rules.spacingM;
    const auto nearAny = [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const glm::dvec2 apart = glm::dvec2(m_stands[i].foot) - place;
        if (glm::dot(apart, apart) < least) return true;
      }
      return false;
    };
    for (int y = std::max(row - 1, 0); y <= row; ++y) {
      for (int x = std::max(column - 1, 0); x <= std::min(column + 1, m_columns - 1); ++x) {
        if (y == row && x >= column) break;  // not filled yet
        const std::size_t cell = cellAt(x, y);
        if (nearAny(m_start[cell], m_start[cell + 1])) return true;
      }
    }
    return nearAny(m_start[cellAt(column, row)], m_stands.size());
  }

  const PlacementRules& m_rules;
  glm::dvec2 m_low, m_high;
  const HeightField& m_ground;
  const std::function<double(const glm::dvec2&)>& m_share;
  int m_columns = 1, m_rows = 1;
  glm::dvec2 m_cell{1.0};
  double m_mean = 0.0;               ///< plants a cell
  std::vector<std::size_t> m_start;  ///< in m_stands, of each cell and of the one to come
  std::vector<Stand> m_stands;
};

}  // namespace

double allowed(const PlacementRules& rules, const HeightSample& ground) {
  const double slopeDeg = glm::degrees(std::atan(glm::length(ground.gradient)));
  return inside(ground.heightM - rules.lowestM, rules.featherM) *
         inside(rules.highestM - ground.heightM, rules.featherM) *
         inside(rules.steepestDeg - slopeDeg, rules.featherDeg);
}

Result<std::vector<Stand>> place(const PlacementRules& rules, const glm::dvec2& low, const glm::dvec2& high,
                                 const HeightField& ground, const std::function<double(const glm::dvec2&)>& share,
                                 const JobContext& job) {
  SWARD_TRY(check(rules, low, high));
  return Scatter(rules, low, high, ground, share).run(job);
}

}  // namespace sward::terrain
