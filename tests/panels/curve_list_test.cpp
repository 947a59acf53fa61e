#include "panels/curve_list.h"

#include "panels/season_panel.h"
#include "wither/season.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace sward::editor {
namespace {

base::Curve curve(std::vector<base::CurvePoint> points) {
  return base::Curve::fromPoints(std::move(points)).value();
}

std::optional<CurveEntry> entryAt(const project::Project& project, const std::string& path) {
  const std::vector<CurveEntry> all = curvesOf(project);
  const auto found = std::find_if(all.begin(), all.end(), [&](const CurveEntry& e) { return e.path == path; });
  return found == all.end() ? std::nullopt : std::optional(*found);
}

TEST(CurveList, TheSeasonsCurvesStandTogether) {
  project::Project project;
  project.wither.mingle = {{"late", 1.0, 1.0, {}}, {"early", 1.0, 1.0, curve({{0.0, 0.5}, {1.0, 1.0}})}};
  for (const char* path :
       {"wither.ageing.water", "wither.ageing.chlorophyll", "wither.ageing.weathering", "wither.mingle[0].ageing",
        "wither.mingle[1].ageing", "sequence.season", "sequence.hourUtc"}) {
    const auto entry = entryAt(project, path);
    ASSERT_TRUE(entry) << path;
    EXPECT_EQ(entry->owner, "wither");
    EXPECT_FALSE(entry->builtIn.points().empty()) << path;
  }
  EXPECT_EQ(entryAt(project, "wither.mingle[1].ageing")->label, "early");
}

TEST(CurveList, AnAutumnShowsItsOwnWaterWhateverRestsBehindIt) {
  project::Project project;
  project.wither.ageing.water = curve({{0.0, 1.0}, {1.0, 0.5}});
  project.wither.ageing.autumn = wither::Autumn::AmpleWater;
  auto entry = entryAt(project, "wither.ageing.water");
  EXPECT_EQ(entry->curve, wither::waterCurve(project.wither.ageing));
  project.wither.ageing.autumn = wither::Autumn::Custom;
  entry = entryAt(project, "wither.ageing.water");
  EXPECT_EQ(entry->curve, project.wither.ageing.water);
}

TEST(CurveList, AWeatheringCurveIsLiftedToWhereItDoesNotFall) {
  project::Project project;
  project.wither.mingle = {{"one", 1.0, 1.0, {}}};
  const base::Curve falling = curve({{0.0, 0.2}, {0.4, 0.7}, {0.6, 0.3}, {1.0, 0.9}});
  const base::Curve lifted = curve({{0.0, 0.2}, {0.4, 0.7}, {0.6, 0.7}, {1.0, 0.9}});
  EXPECT_TRUE(setCurve(project, "wither.ageing.weathering", falling));
  EXPECT_TRUE(setCurve(project, "wither.mingle[0].ageing", falling));
  EXPECT_EQ(project.wither.ageing.weathering, lifted);
  EXPECT_EQ(project.wither.mingle[0].ageing, lifted);
  EXPECT_TRUE(setCurve(project, "wither.ageing.water", falling)) << "water may come back";
  EXPECT_EQ(project.wither.ageing.water, falling);
  EXPECT_FALSE(setCurve(project, "wither.mingle[1].ageing", falling));
}

TEST(SeasonPlayTest, TheMomentIsWhereTheSeasonReachesTheDegree) {
  project::Project project;
  UiState ui;
  project.wither.weathering = 0.5;
  EXPECT_EQ(shownMoment(ui, project), 0.5);
  project.wither.ageing.weathering = curve({{0.0, 0.1}, {0.3, 0.5}, {0.6, 0.5}, {1.0, 0.8}});
  const auto season = wither::Season::create(project.wither.ageing, project.wither.body);
  ASSERT_TRUE(season.ok());
  for (const double degree : {0.0, 0.05, 0.1, 0.3, 0.5, 0.7, 0.8, 1.0}) {
    project.wither.weathering = degree;
    // Two bisections of [0, 1], the coarser one of 40 steps: 2^-40.
    EXPECT_NEAR(shownMoment(ui, project), season->seasonOf(degree), 1e-11) << degree;
  }
}

TEST(SeasonPlayTest, PlayingRunsToTheEndAndBeginsAgainOrRests) {
  project::Project project;
  project.sequence.frames = 101;  // every frame a hundredth of the season, and of a tenth of a second
  project.sequence.framesPerSecond = 10.0;
  SeasonPlay play;
  play.running = true;
  play.at = 0.0;
  for (int i = 0; i < 25; ++i) advancePlay(play, project, 0.1);
  EXPECT_NEAR(*play.at, 0.25, 1e-12);
  EXPECT_EQ(play.weathering, *play.at);
  advancePlay(play, project, 0.06);
  EXPECT_NEAR(*play.at, 0.25, 1e-12) << "between two frames the first of them stands";
  advancePlay(play, project, 0.04 + 8.0);  // 10.1 s long
  EXPECT_NEAR(*play.at, 0.05, 1e-12);
  EXPECT_TRUE(play.running);
  play.loop = false;
  advancePlay(play, project, 20.0);
  EXPECT_EQ(*play.at, 1.0);
  EXPECT_FALSE(play.running);
}

TEST(SeasonPlayTest, PlayFollowsTheSequencesCurve) {
  project::Project project;
  project.sequence.frames = 11;
  project.sequence.framesPerSecond = 10.0;
  project.sequence.season = curve({{0.0, 0.4}, {1.0, 0.6}});
  UiState ui;
  project.wither.weathering = 0.5;
  togglePlay(ui, project);
  EXPECT_NEAR(ui.season.seconds, 0.55, 1e-9);  // the middle of 1.1 s
  advancePlay(ui.season, project, 0.25);
  EXPECT_NEAR(*ui.season.at, 0.56, 1e-12);  // frame 8
  project.sequence.frames = 1;
  advancePlay(ui.season, project, 0.05);
  EXPECT_NEAR(*ui.season.at, 0.4, 1e-12);
}

TEST(SeasonPlayTest, PlayStartsWhereTheProjectStandsAndAnewAtTheEnd) {
  project::Project project;
  UiState ui;
  project.wither.weathering = 0.4;
  togglePlay(ui, project);
  EXPECT_TRUE(ui.season.running);
  EXPECT_EQ(ui.season.at, 0.4);
  togglePlay(ui, project);
  EXPECT_FALSE(ui.season.running);
  EXPECT_EQ(ui.season.at, 0.4) << "a pause keeps the moment";
  ui.season.at = 1.0;
  togglePlay(ui, project);
  EXPECT_EQ(ui.season.at, 0.0);
}

}  // namespace
}  // namespace sward::editor
