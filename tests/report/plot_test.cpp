#include "report/plot_svg.h"

#include "base/random.h"
#include "report/example.h"
#include "report/markup_check.h"
#include "report/plot_axis.h"
#include "report/plot_labels.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace sward::report {
namespace {

using testing::HasSubstr;
using testing::Not;

void expectAxis(const Axis& axis, const std::vector<double>& values) {
  ASSERT_LT(axis.low, axis.high);
  for (const double value : values) {
    EXPECT_GE(axis.place(value), 0.0) << value;
    EXPECT_LE(axis.place(value), 1.0) << value;
  }
  int labelled = 0;
  for (std::size_t i = 0; i < axis.ticks.size(); ++i) {
    labelled += axis.ticks[i].label.empty() ? 0 : 1;
    EXPECT_GE(axis.place(axis.ticks[i].value), -1e-9);
    EXPECT_LE(axis.place(axis.ticks[i].value), 1.0 + 1e-9);
    if (i == 0) continue;
    EXPECT_LT(axis.ticks[i - 1].value, axis.ticks[i].value);
  }
  EXPECT_GE(labelled, 2) << axis.low << " to " << axis.high;
  EXPECT_LE(labelled, 12) << axis.low << " to " << axis.high;
}

TEST(Axis, ShowsAllValuesWithReadableTicks) {
  base::Random random(3);
  for (int run = 0; run < 500; ++run) {
    const double scale = std::pow(10.0, random.uniform(-9.0, 9.0)), spread = std::pow(10.0, random.uniform(-3.0, 7.0));
    std::vector<double> values{scale, scale * (1.0 + spread), scale * (1.0 + 0.3 * spread)};
    SCOPED_TRACE(testing::Message() << values[0] << " to " << values[1]);
    expectAxis(axisOf(values, true), values);
    expectAxis(axisOf(values, false), values);
    values.push_back(-values[2]);
    expectAxis(axisOf(values, false), values);
  }
  for (const bool log : {false, true}) {
    expectAxis(axisOf({}, log), {});
    const std::vector<double> one{7.0}, same{3.0, 3.0};
    expectAxis(axisOf(one, log), one);
    expectAxis(axisOf(same, log), same);
  }
  const std::vector<double> huge{1e-290, 1e290};
  expectAxis(axisOf(huge, true), huge);
  const std::vector<double> zeros{0.0, 0.0};
  expectAxis(axisOf(zeros, false), zeros);
}

TEST(Axis, WhatCurvesRunOverStartsWhereTheyDo) {
  const std::vector<double> wavelengths{400.0, 550.0, 750.0}, season{0.0, 0.5, 1.0};
  EXPECT_EQ(axisOf(wavelengths, false).low, 0.0);
  const Axis axis = domainAxisOf(wavelengths, false);
  expectAxis(axis, wavelengths);
  EXPECT_GT(axis.low, 350.0);
  EXPECT_LT(axis.high, 800.0);
  EXPECT_EQ(domainAxisOf(season, false).low, 0.0);
  expectAxis(domainAxisOf({{-1.0, 1.0}}, false), {-1.0, 1.0});
  expectAxis(domainAxisOf({{0.1, 10.0}}, true), {0.1, 10.0});
}

TEST(Plot, CurvesStartWhereTheirDataDoes) {
  Plot plot;
  plot.xLabel = plot.yLabel = "x";
  plot.series.push_back({"curve", {{400.0, 10.0, ""}, {750.0, 11.0, ""}}, true});
  const auto marksZero = [&] { return plotSvg(plot, SeriesLooks(), false).svg.find(">0</text>") != std::string::npos; };
  EXPECT_FALSE(marksZero());
  plot.series[0].line = false;
  EXPECT_TRUE(marksZero());
}

TEST(Axis, LogarithmicTicksAreAtOneTwoFive) {
  const std::vector<double> values{1.0, 50.0};
  std::vector<std::string> labels;
  for (const auto& tick : axisOf(values, true).ticks) {
    if (!tick.label.empty()) labels.push_back(tick.label);
  }
  EXPECT_THAT(labels, testing::ElementsAre("1", "2", "5", "10", "20", "50"));
  const std::vector<double> wide{1e-7, 1e5};
  labels.clear();
  for (const auto& tick : axisOf(wide, true).ticks) {
    if (!tick.label.empty()) labels.push_back(tick.label);
  }
  EXPECT_THAT(labels, testing::ElementsAre("10⁻⁶", "0.0001", "0.01", "1", "100", "10 k"));
}

TEST(Axis, LinearTicksOfOneAxisHaveTheSameDecimals) {
  const std::vector<double> values{0.02, 0.11};
  std::vector<std::string> labels;
  for (const auto& tick : axisOf(values, false).ticks) labels.push_back(tick.label);
  EXPECT_THAT(labels, testing::ElementsAre("0.00", "0.02", "0.04", "0.06", "0.08", "0.10"));
}

TEST(Labels, ALabelStandsNearestToItsOwnPointWhereThereIsRoom) {
  // A marker above another, closed in but for places beside the other and, farther away, above itself.
  LabelPlacer placer({0.0, 0.0, 300.0, 300.0});
  placer.avoidPoint(100.0, 100.0, 6.0);
  placer.avoidPoint(100.0, 118.0, 6.0);
  placer.avoid({0.0, 70.0, 93.0, 109.0});
  placer.avoid({107.0, 70.0, 300.0, 109.0});
  placer.avoid({90.0, 40.0, 110.0, 93.0});
  const auto upper = placer.place(100.0, 100.0, 50.0, 13.0);
  ASSERT_TRUE(upper.has_value());
  const auto distance = [](const Box& box, double x, double y) {
    return std::hypot(x - std::clamp(x, box.left, box.right), y - std::clamp(y, box.top, box.bottom));
  };
  EXPECT_LT(distance(*upper, 100.0, 100.0), distance(*upper, 100.0, 118.0));
}

TEST(Labels, NoLabelCoversAnotherOrAPoint) {
  base::Random random(5);
  const Box frame{0.0, 0.0, 500.0, 300.0};
  int placed = 0;
  for (int run = 0; run < 30; ++run) {
    LabelPlacer placer(frame);
    std::vector<Box> taken;
    std::vector<std::array<double, 2>> points;
    for (int i = 0; i < 24; ++i) {
      points.push_back({random.uniform(0.0, 500.0), random.uniform(0.0, 300.0)});
      const auto& [x, y] = points.back();
      taken.push_back({x - 6.0, y - 6.0, x + 6.0, y + 6.0});
      placer.avoid(taken.back());
    }
    for (const auto& [x, y] : points) {
      const auto box = placer.place(x, y, 70.0, 12.0);
      if (!box) continue;
      ++placed;
      EXPECT_TRUE(box->inside(frame));
      for (const Box& other : taken) EXPECT_FALSE(box->overlaps(other));
      taken.push_back(*box);
    }
  }
  EXPECT_GT(placed, 600) << "of 720";
}

TEST(Labels, AreDroppedWhenThereIsNoRoom) {
  LabelPlacer placer({0.0, 0.0, 100.0, 100.0});
  placer.avoid({0.0, 0.0, 100.0, 100.0});
  EXPECT_FALSE(placer.place(50.0, 50.0, 20.0, 12.0).has_value());
  EXPECT_FALSE(LabelPlacer({0.0, 0.0, 100.0, 100.0}).place(50.0, 50.0, 120.0, 12.0).has_value());
}

TEST(Labels, LinesAreAvoidedWhereThereIsAChoice) {
  LabelPlacer placer({0.0, 0.0, 200.0, 200.0});
  placer.avoidLine(100.0, 100.0, 200.0, 100.0);
  const auto box = placer.place(100.0, 100.0, 30.0, 12.0);
  ASSERT_TRUE(box.has_value());
  EXPECT_LT(box->right, 100.0);
}

TEST(Pareto, TheFrontIsWhatNoOtherBeats) {
  base::Random random(9);
  std::vector<Plot::Point> points;
  for (int i = 0; i < 200; ++i) {
    points.push_back({std::floor(random.uniform(0.0, 30.0)), std::floor(random.uniform(0.0, 30.0)), {}});
  }
  const auto beaten = [&](const Plot::Point& p) {
    return std::any_of(points.begin(), points.end(),
                       [&](const Plot::Point& q) { return q.x <= p.x && q.y <= p.y && (q.x < p.x || q.y < p.y); });
  };
  const auto front = paretoFront(points);
  for (const Plot::Point& p : points) {
    const bool on =
        std::any_of(front.begin(), front.end(), [&](const Plot::Point& q) { return q.x == p.x && q.y == p.y; });
    EXPECT_EQ(on, !beaten(p)) << p.x << ", " << p.y;
  }
  for (std::size_t i = 1; i < front.size(); ++i) EXPECT_LT(front[i - 1].x, front[i].x);
  const double nan = std::nan("");
  EXPECT_TRUE(paretoFront({{nan, 1.0, {}}, {1.0, nan, {}}}).empty());
}

TEST(Plot, IsWellFormedAndNamesItsPoints) {
  for (const auto& sections : {test::exampleSections(), test::hostileSections()}) {
    const SeriesLooks looks(sections);
    for (const Section& section : sections) {
      for (const Plot& plot : section.plots) {
        for (const bool alone : {false, true}) {
          const PlotText drawn = plotSvg(plot, looks, alone);
          EXPECT_EQ(test::markupProblem(drawn.svg, test::MarkupKind::Xml), "") << plot.name;
          EXPECT_EQ(drawn.leftOut, 0);
          EXPECT_EQ(drawn.svg.find("<style>") != std::string::npos, alone);
        }
      }
    }
  }
  const auto sections = test::exampleSections();
  const std::string svg = plotSvg(sections[1].plots[0], SeriesLooks(sections), false).svg;
  for (const char* name : {"constant", "ptm8", "ptm", "lpt_paper", "lpt8", "lpt16", "lpt_clustered2", "lpt_clustered4",
                           "hsh", "marched"}) {
    EXPECT_THAT(svg, HasSubstr(std::string("<title>") + name + "\n")) << "tooltip";
    EXPECT_THAT(svg, HasSubstr(std::string(">") + name + "</text>")) << "beside its point or in the legend";
  }
  EXPECT_THAT(svg, HasSubstr("sw-front"));
  EXPECT_THAT(plotSvg(sections[1].plots[2], SeriesLooks(sections), false).svg, Not(HasSubstr("sw-front")));
}

TEST(Plot, PointsThatAxesCannotShowAreCounted) {
  const double infinity = std::numeric_limits<double>::infinity();
  Plot plot;
  plot.name = "p";
  plot.logX = true;
  plot.pareto = true;
  plot.series = {
      {"a", {{0.0, 1.0, {}}, {-1.0, 1.0, {}}, {2.0, infinity, {}}, {std::nan(""), 1.0, {}}, {3.0, 0.0, {}}}}};
  const PlotText drawn = plotSvg(plot, SeriesLooks(), false);
  EXPECT_EQ(drawn.leftOut, 4);
  EXPECT_THAT(drawn.svg, Not(HasSubstr("nan")));
  EXPECT_THAT(drawn.svg, Not(HasSubstr("inf")));
  plot.series.clear();
  EXPECT_EQ(test::markupProblem(plotSvg(plot, SeriesLooks(), true).svg, test::MarkupKind::Xml), "");
}

TEST(Plot, ASeriesKeepsItsLookInAllPlots) {
  const SeriesLooks looks(test::exampleSections());
  EXPECT_EQ(looks.of("constant"), 0u);
  EXPECT_EQ(looks.of("marched"), 9u);
  // Colour or shape differs between any two of 35.
  EXPECT_NE(looks.of("lpt8") % SeriesLooks::kColours, looks.of("ptm8") % SeriesLooks::kColours);
}

}  // namespace
}  // namespace sward::report
