#include "terrain/placement.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>
#include <stop_token>

#include <gtest/gtest.h>

namespace sward::terrain {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// z = slope * x over any place.
std::shared_ptr<const HeightField> plane(double slope) {
  HeightGrid grid;
  grid.columns = grid.rows = 9;
  grid.origin = {-400.0, -400.0};
  grid.cellM = {100.0, 100.0};
  for (int y = 0; y < 9; ++y) {
    for (int x = 0; x < 9; ++x) grid.heights.push_back(static_cast<float>(slope * (-400.0 + 100.0 * x)));
  }
  auto made = HeightField::create(std::move(grid));
  if (!made) throw std::runtime_error(made.error().text());
  return std::move(made).value();
}

std::vector<Stand> placed(const PlacementRules& rules, double sideM = 200.0, double slope = 0.0,
                          const std::function<double(const glm::dvec2&)>& share = {}) {
  auto made = place(rules, glm::dvec2(-0.5 * sideM), glm::dvec2(0.5 * sideM), *plane(slope), share, {});
  if (!made) throw std::runtime_error(made.error().text());
  return std::move(made).value();
}

double leastDistance(const std::vector<Stand>& stands) {
  double least = kInfinity;
  for (std::size_t i = 0; i < stands.size(); ++i) {
    for (std::size_t j = i + 1; j < stands.size(); ++j) {
      least = std::min(least, glm::length(glm::dvec2(stands[i].foot) - glm::dvec2(stands[j].foot)));
    }
  }
  return least;
}

TEST(Placement, StandsAreAsManyAsAskedAndApart) {
  PlacementRules rules;
  rules.perHectare = 300.0;
  rules.spacingM = 3.0;
  const std::vector<Stand> stands = placed(rules);
  // 1,200 in 4 hectares; cells round up or down each by its own chance: a standard deviation of 17 at most, and few
  // darts find no place, for they cover a fifth of the ground.
  EXPECT_NEAR(static_cast<double>(stands.size()), 1200.0, 60.0);
  EXPECT_GE(leastDistance(stands), 3.0);
  std::set<std::uint64_t> seeds;
  for (const Stand& stand : stands) {
    EXPECT_LE(std::max(std::abs(stand.foot.x), std::abs(stand.foot.y)), 100.0);
    seeds.insert(stand.seed);
  }
  EXPECT_EQ(seeds.size(), stands.size());
}

TEST(Placement, NeverTooNearHoweverDense) {
  PlacementRules rules;
  rules.perHectare = 50000.0;
  rules.spacingM = 2.0;
  const std::vector<Stand> stands = placed(rules, 60.0);
  EXPECT_GE(leastDistance(stands), 2.0);
  // Random packing of discs covers 0.547 of the plane, 0.70 / spacing^2 a square metre; row after row packs closer, and
  // no packing passes the hexagonal 1.155, on a square that half a spacing wider.
  EXPECT_GT(static_cast<double>(stands.size()), 0.70 * 3600.0 / 4.0);
  EXPECT_LT(static_cast<double>(stands.size()), 1.155 * 62.0 * 62.0 / 4.0);
}

TEST(Placement, WithoutSpacingIsRandom) {
  PlacementRules rules;
  rules.perHectare = 400.0;
  rules.spacingM = 0.0;
  EXPECT_NEAR(static_cast<double>(placed(rules).size()), 1600.0, 70.0);
}

TEST(Placement, FollowsTheMask) {
  PlacementRules rules;
  rules.perHectare = 400.0;
  rules.spacingM = 1.0;
  const auto stands = placed(rules, 200.0, 0.0, [](const glm::dvec2& p) { return p.x < 0.0 ? 0.25 : 1.0; });
  const auto left = std::count_if(stands.begin(), stands.end(), [](const Stand& s) { return s.foot.x < 0.0; });
  EXPECT_NEAR(static_cast<double>(left), 200.0, 45.0);
  EXPECT_NEAR(static_cast<double>(stands.size()) - static_cast<double>(left), 800.0, 60.0);
  EXPECT_TRUE(placed(rules, 100.0, 0.0, [](const glm::dvec2&) { return 0.0; }).empty());
  EXPECT_TRUE(placed(rules, 100.0, 0.0, [](const glm::dvec2&) { return std::nan(""); }).empty());
}

TEST(Placement, KeepsHeightsAndSlopes) {
  PlacementRules rules;
  rules.perHectare = 200.0;
  rules.lowestM = 5.0;
  rules.highestM = 20.0;
  const std::vector<Stand> stands = placed(rules, 200.0, 0.3);
  ASSERT_FALSE(stands.empty());
  for (const Stand& stand : stands) {
    EXPECT_NEAR(stand.foot.z, 0.3 * stand.foot.x, 1e-4);
    EXPECT_GE(stand.foot.z, 5.0);
    EXPECT_LE(stand.foot.z, 20.0);
  }
  rules.steepestDeg = 10.0;  // the plane has 16.7 degrees
  EXPECT_TRUE(placed(rules, 200.0, 0.3).empty());
}

TEST(Placement, FeathersThinOut) {
  PlacementRules rules;
  rules.lowestM = 0.0;
  rules.featherM = 10.0;
  rules.featherDeg = 5.0;
  rules.steepestDeg = 30.0;
  EXPECT_DOUBLE_EQ(allowed(rules, {5.0, {0.0, 0.0}}), 0.5);
  EXPECT_DOUBLE_EQ(allowed(rules, {0.0, {0.0, 0.0}}), 0.0);
  EXPECT_DOUBLE_EQ(allowed(rules, {-1.0, {0.0, 0.0}}), 0.0);
  EXPECT_NEAR(allowed(rules, {50.0, {std::tan(glm::radians(28.0)), 0.0}}), 0.4, 1e-12);
  EXPECT_DOUBLE_EQ(allowed(rules, {std::nan(""), {0.0, 0.0}}), 0.0);
}

TEST(Placement, IsTheSameForTheSameSeed) {
  PlacementRules rules;
  rules.perHectare = 300.0;
  EXPECT_EQ(placed(rules), placed(rules));
  PlacementRules other = rules;
  other.seed = 2;
  EXPECT_NE(placed(rules), placed(other));
}

TEST(Placement, OddRules) {
  PlacementRules none;
  none.perHectare = 0.0;
  EXPECT_TRUE(placed(none).empty());
  PlacementRules wide;
  wide.spacingM = 1e6;
  EXPECT_LE(placed(wide).size(), 1u);
  const auto ground = plane(0.0);
  const auto refused = [&](PlacementRules rules, glm::dvec2 low = {0, 0}, glm::dvec2 high = {10, 10}) {
    return !place(rules, low, high, *ground, {}, {}).ok();
  };
  PlacementRules bad;
  bad.perHectare = -1.0;
  EXPECT_TRUE(refused(bad));
  bad = {};
  bad.spacingM = std::nan("");
  EXPECT_TRUE(refused(bad));
  bad = {};
  bad.lowestM = std::nan("");
  EXPECT_TRUE(refused(bad));
  EXPECT_TRUE(refused({}, {0, 0}, {0, 10}));
  EXPECT_TRUE(refused({}, {0, 0}, {kInfinity, 10}));
  bad = {};
  bad.perHectare = 1e12;
  EXPECT_TRUE(refused(bad));
  JobContext job;
  std::stop_source stop;
  stop.request_stop();
  job.stop = stop.get_token();
  EXPECT_FALSE(place({}, {0, 0}, {10, 10}, *ground, {}, job).ok());
}

}  // namespace
}  // namespace sward::terrain
