#include "project/sequence.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace sward::project {
namespace {

base::Curve curve(std::vector<base::CurvePoint> points) {
  return base::Curve::fromPoints(std::move(points)).value();
}

TEST(Sequence, WithoutCurvesTheWholeSeasonPassesEvenly) {
  Project project;
  project.sequence.frames = 5;
  for (int frame = 0; frame < 5; ++frame) {
    EXPECT_DOUBLE_EQ(projectAt(project, frame).wither.weathering, 0.25 * frame);
  }
}

TEST(Sequence, NothingButTheMomentChanges) {
  Project project;
  project.sequence.frames = 3;
  project.wither.weathering = 0.7;
  Project middle = projectAt(project, 1);
  EXPECT_DOUBLE_EQ(middle.wither.weathering, 0.5);
  middle.wither.weathering = project.wither.weathering;
  EXPECT_EQ(middle, project);
}

TEST(Sequence, BothCurvesAreFollowed) {
  Project project;
  project.sequence.frames = 11;
  project.sequence.season = curve({{0.0, 0.2}, {1.0, 0.8}});
  project.wither.ageing.weathering = curve({{0.0, 0.0}, {0.5, 0.4}, {1.0, 0.4}});
  // Linear between two points; the second curve rests from the middle of the season on.
  EXPECT_DOUBLE_EQ(seasonAt(project.sequence, shareOf(project.sequence, 5)), 0.5);
  EXPECT_DOUBLE_EQ(projectAt(project, 5).wither.weathering, 0.4);
  EXPECT_DOUBLE_EQ(projectAt(project, 10).wither.weathering, 0.4);
  EXPECT_LT(projectAt(project, 0).wither.weathering, 0.4);
}

TEST(Sequence, OneFrameAndFramesBeyondTheEnds) {
  Project project;
  project.sequence.frames = 1;
  EXPECT_EQ(shareOf(project.sequence, 0), 0.0);
  EXPECT_EQ(shareOf(project.sequence, 7), 0.0);
  project.sequence.frames = 4;
  EXPECT_EQ(shareOf(project.sequence, -3), 0.0);
  EXPECT_EQ(shareOf(project.sequence, 99), 1.0);
  project.sequence.frames = 0;  // no valid project; nothing is divided by it
  EXPECT_EQ(shareOf(project.sequence, 2), 0.0);
}

TEST(Sequence, AMomentIsFoundWhereTheSequenceFirstShowsIt) {
  Sequence sequence;
  EXPECT_DOUBLE_EQ(shareOfSeason(sequence, 0.3), 0.3);
  sequence.season = curve({{0.0, 0.1}, {0.5, 0.9}, {1.0, 0.1}});  // there and back
  for (const double season : {0.15, 0.5, 0.89}) {
    const double share = shareOfSeason(sequence, season);
    EXPECT_LT(share, 0.5);
    EXPECT_NEAR(seasonAt(sequence, share), season, 1e-9);
  }
  EXPECT_EQ(shareOfSeason(sequence, 0.95), 0.0);
  EXPECT_EQ(shareOfSeason(sequence, 0.0), 0.0);
}

TEST(Sequence, DaysAndHoursMoveTheSunOfADateAlone) {
  Project project;
  project.sequence.frames = 11;
  project.sequence.days = 100;
  project.sequence.hourUtc = curve({{0.0, 6.0}, {1.0, 16.0}});
  EXPECT_EQ(projectAt(project, 5).sun, project.sun);
  project.sun.byMoment = true;
  project.sun.moment.month = 12;
  project.sun.moment.day = 1;
  const scene::SunMoment half = projectAt(project, 5).sun.moment;
  EXPECT_EQ(half.year, project.sun.moment.year + 1);  // 31 days of December, 19 more
  EXPECT_EQ(half.month, 1);
  EXPECT_EQ(half.day, 20);
  EXPECT_DOUBLE_EQ(half.hourUtc, 11.0);
  EXPECT_TRUE(validate(project).empty() || !validate(project).front().fatal);
  project.sun.moment.day = 31;
  project.sun.moment.month = 2;  // no such day: validate() says so, nothing moves
  EXPECT_EQ(projectAt(project, 5).sun.moment.month, 2);
}

TEST(Sequence, WhatCannotBeIsSaid) {
  const auto problemAt = [](const Project& project, const std::string& where) -> const char* {
    for (const Problem& problem : validate(project)) {
      if (problem.where.rfind(where, 0) == 0) return problem.fatal ? "fatal" : "warning";
    }
    return "none";
  };
  Project project;
  EXPECT_STREQ(problemAt(project, "sequence"), "none");
  project.sequence.days = 30;
  EXPECT_STREQ(problemAt(project, "sequence.days"), "warning");  // the sun stands at angles
  project.sun.byMoment = true;
  EXPECT_STREQ(problemAt(project, "sequence.days"), "none");
  project.sun.moment = {2050, 12, 20, 12.0, 48.0, 11.0};
  EXPECT_STREQ(problemAt(project, "sequence.days"), "fatal");
  project = {};
  project.sequence.frames = 0;
  EXPECT_STREQ(problemAt(project, "sequence.frames"), "fatal");
  project = {};
  project.sequence.season = curve({{0.0, 0.0}, {1.0, 1.5}});
  EXPECT_STREQ(problemAt(project, "sequence.season"), "fatal");
}

}  // namespace
}  // namespace sward::project
