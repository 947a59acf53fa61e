#include "document/edits.h"

#include "document/selection.h"
#include "project/presets.h"
#include "project/limits.h"
#include "wither/season.h"

#include <limits>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace sward::editor {
namespace {

using project::Plant;
using project::Project;
using testing::ElementsAre;

Project lawn() {
  return project::fromTemplate("lawn").value();
}

template <typename T>
std::vector<std::string> names(const std::vector<T>& list) {
  std::vector<std::string> out;
  for (const T& entry : list) out.push_back(entry.name);
  return out;
}

/// A project with plants of these names.
Project withPlants(const std::vector<std::string>& plants) {
  Project project = project::fromTemplate("empty").value();
  for (const std::string& name : plants) project.patch.plants.emplace_back().name = name;
  return project;
}

bool saysRange(const Project& project, const std::string& where) {
  for (const auto& problem : project::validate(project)) {
    if (problem.where == where && problem.what.find("the value is") == 0) return true;
  }
  return false;
}

TEST(UniqueName, CountsOn) {
  EXPECT_EQ(uniqueName("a", {}, "x"), "a");
  EXPECT_EQ(uniqueName("a", {"a"}, "x"), "a 2");
  EXPECT_EQ(uniqueName("a 2", {"a", "a 2"}, "x"), "a 3");
  EXPECT_EQ(uniqueName("a", {"a", "a 2", "a 3"}, "x"), "a 4");
  EXPECT_EQ(uniqueName("  a\t", {"b"}, "x"), "a");
  EXPECT_EQ(uniqueName(" ", {"x"}, "x"), "x 2");
  EXPECT_EQ(uniqueName("7", {"7"}, "x"), "7 2");
  EXPECT_EQ(uniqueName("a 99999999999999999999", {"a 99999999999999999999"}, "x"), "a 99999999999999999999 2");
}

TEST(PlantEdits, EveryPresetCanBeAdded) {
  Project project = project::fromTemplate("empty").value();
  for (const project::PlantPreset& preset : project::plantPresets()) ASSERT_TRUE(addPlant(project, preset.plant));
  const auto all = names(project.patch.plants);
  EXPECT_EQ(std::set<std::string>(all.begin(), all.end()).size(), all.size());
  EXPECT_TRUE(project::requireValid(project).ok());
}

TEST(PlantEdits, AddGoesAfterTheGivenOneWithANameOfItsOwn) {
  Project project = withPlants({"a", "b"});
  Plant plant;
  plant.name = "a";
  EXPECT_EQ(addPlant(project, plant, 0), 1u);
  EXPECT_THAT(names(project.patch.plants), ElementsAre("a", "a 2", "b"));
  EXPECT_EQ(addPlant(project, plant), 3u);
  EXPECT_THAT(names(project.patch.plants), ElementsAre("a", "a 2", "b", "a 3"));
}

TEST(PlantEdits, AnUnsetShareBecomesTheMean) {
  Project project = lawn();
  Plant plant;
  plant.share = 0.0;
  const auto index = addPlant(project, plant);
  ASSERT_TRUE(index);
  EXPECT_DOUBLE_EQ(project.patch.plants[*index].share, 0.5);
  Project empty = withPlants({});
  ASSERT_TRUE(addPlant(empty, plant));
  EXPECT_DOUBLE_EQ(empty.patch.plants[0].share, 1.0);
  plant.share = 0.125;
  EXPECT_DOUBLE_EQ(empty.patch.plants[*addPlant(empty, plant)].share, 0.125);
}

TEST(PlantEdits, DuplicateRemoveMoveRename) {
  Project project = withPlants({"a", "b", "c", "d"});
  project.patch.plants[1].densityPerM2 = 77.0;
  EXPECT_EQ(duplicatePlant(project, 1), 2u);
  EXPECT_DOUBLE_EQ(project.patch.plants[2].densityPerM2, 77.0);
  EXPECT_THAT(names(project.patch.plants), ElementsAre("a", "b", "b 2", "c", "d"));
  EXPECT_TRUE(removePlant(project, 1));
  EXPECT_TRUE(movePlant(project, 0, 2));
  EXPECT_THAT(names(project.patch.plants), ElementsAre("b 2", "c", "a", "d"));
  EXPECT_TRUE(movePlant(project, 3, 0));
  EXPECT_THAT(names(project.patch.plants), ElementsAre("d", "b 2", "c", "a"));
  EXPECT_TRUE(movePlant(project, 0, 99));
  EXPECT_THAT(names(project.patch.plants), ElementsAre("b 2", "c", "a", "d"));
  EXPECT_EQ(renamePlant(project, 0, "a"), "a 2");
  EXPECT_EQ(renamePlant(project, 0, " a 2 "), "a 2") << "its own name is free for it";
  EXPECT_EQ(renamePlant(project, 0, "  "), "a 2");
}

TEST(PlantEdits, WrongIndicesChangeNothing) {
  Project project = lawn();
  const Project before = project;
  EXPECT_FALSE(duplicatePlant(project, 2));
  EXPECT_FALSE(removePlant(project, 2));
  EXPECT_FALSE(movePlant(project, 2, 0));
  EXPECT_FALSE(movePlant(project, 1, 1));
  EXPECT_EQ(renamePlant(project, kAtEnd, "x"), "");
  EXPECT_FALSE(removeView(project, 4));
  EXPECT_FALSE(updateView(project, 4, {}));
  EXPECT_FALSE(duplicateView(project, 4));
  EXPECT_TRUE(project == before);
}

TEST(PlantEdits, ListsStopAtTheFormatsLimits) {
  Project project = withPlants({});
  while (addPlant(project, Plant{})) ASSERT_LT(project.patch.plants.size(), 10000u);
  EXPECT_FALSE(saysRange(project, "patch.plants"));
  EXPECT_FALSE(duplicatePlant(project, 0));
  project.patch.plants.emplace_back();
  EXPECT_TRUE(saysRange(project, "patch.plants")) << "one more is refused by the schema too";
  while (addView(project, {})) ASSERT_LT(project.views.size(), 10000u);
  EXPECT_FALSE(saysRange(project, "views"));
  project.views.emplace_back();
  EXPECT_TRUE(saysRange(project, "views"));
  ASSERT_TRUE(convertToList(project, {{0.0, 45.0}}));
  while (addLight(project, {10.0, 45.0})) ASSERT_LT(project.lights.directions.size(), 10000u);
  EXPECT_FALSE(saysRange(project, "lights.directions"));
  project.lights.directions.emplace_back();
  EXPECT_TRUE(saysRange(project, "lights.directions"));
}

TEST(ViewEdits, KeepNamesUniqueAndUpdateKeepsTheName) {
  Project project = lawn();
  const std::size_t count = project.views.size();
  scene::View view;
  view.name = "main";
  view.position = {1.0, 2.0, 3.0};
  const auto index = addView(project, view, 0);
  ASSERT_EQ(index, 1u);
  EXPECT_EQ(project.views[1].name, "main 2");
  view.focalLengthMm = 85.0;
  EXPECT_TRUE(updateView(project, 0, view));
  EXPECT_EQ(project.views[0].name, "main");
  EXPECT_DOUBLE_EQ(project.views[0].focalLengthMm, 85.0);
  EXPECT_EQ(renameView(project, 1, "main"), "main 2");
  EXPECT_EQ(duplicateView(project, 1), 2u);
  EXPECT_EQ(project.views[2].name, "main 3");
  EXPECT_TRUE(moveView(project, 2, 0));
  EXPECT_TRUE(removeView(project, 0));
  EXPECT_TRUE(removeView(project, 1));
  EXPECT_EQ(project.views.size(), count);
  view.name.clear();
  EXPECT_EQ(project.views[*addView(project, view)].name, "view");
  EXPECT_TRUE(project::requireValid(project).ok());
}

TEST(LightEdits, APatternBecomesAListThatCanBeEdited) {
  Project project = lawn();
  EXPECT_FALSE(addLight(project, {10.0, 20.0})) << "a pattern has no single lights";
  EXPECT_FALSE(moveLight(project, 0, {10.0, 20.0}));
  EXPECT_FALSE(removeLight(project, 0));
  ASSERT_TRUE(convertToList(project, {{10.0, 20.0}, {-30.0, 95.0}}));
  EXPECT_EQ(project.lights.pattern, scene::LightPattern::List);
  EXPECT_EQ(project.lights.directions[1], (scene::SunAngles{330.0, 90.0}));
  EXPECT_EQ(addLight(project, {725.0, -5.0}), 2u);
  EXPECT_EQ(project.lights.directions[2], (scene::SunAngles{5.0, 0.0}));
  EXPECT_TRUE(moveLight(project, 0, {-1e-14, 45.0}));
  EXPECT_EQ(project.lights.directions[0], (scene::SunAngles{0.0, 45.0}));
  EXPECT_FALSE(moveLight(project, 3, {}));
  EXPECT_TRUE(removeLight(project, 1));
  EXPECT_TRUE(removeLight(project, 1));
  EXPECT_FALSE(removeLight(project, 0)) << "the last one stays";
  EXPECT_TRUE(project::requireValid(project).ok());
  usePattern(project, scene::LightPattern::Fibonacci, 5000);
  EXPECT_EQ(project.lights.count, project::kMaxLights);
  EXPECT_EQ(project.lights.directions.size(), 1u);
}

TEST(LightEdits, RefuseWhatIsNoDirection) {
  Project project = lawn();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(convertToList(project, {}));
  EXPECT_FALSE(convertToList(project, {{nan, 20.0}}));
  EXPECT_FALSE(convertToList(project, std::vector<scene::SunAngles>(project::kMaxLights + 1)));
  EXPECT_TRUE(project == lawn());
  ASSERT_TRUE(convertToList(project, {{10.0, 20.0}}));
  EXPECT_FALSE(addLight(project, {0.0, std::numeric_limits<double>::infinity()}));
  EXPECT_FALSE(moveLight(project, 0, {nan, 0.0}));
  EXPECT_EQ(project.lights.directions.size(), 1u);
}

TEST(SelectionTest, FollowsNamesThenPlaces) {
  Project project = withPlants({"a", "b", "c"});
  const Selection b = selectPlant(project, 1);
  movePlant(project, 1, 2);
  EXPECT_EQ(followSelection(b, project), selectPlant(project, 2));
  renamePlant(project, 2, "z");
  EXPECT_EQ(followSelection(b, project), selectPlant(project, 1)) << "no such name: the same place";
  Project shorter = withPlants({"x"});
  EXPECT_EQ(followSelection(b, shorter), selectPlant(shorter, 0));
  EXPECT_EQ(followSelection(b, withPlants({})), Selection{});
  project.patch.plants[0].name = "b";
  project.patch.plants[1].name = "b";
  EXPECT_EQ(followSelection(b, project).index, 1u) << "of two of that name, the one in its place";
}

TEST(WitherEdits, OwnCurvesBeginWithTheAutumnBefore) {
  Project project;
  chooseAutumn(project, wither::Autumn::AmpleWater);
  EXPECT_TRUE(project.wither.ageing.water.points().empty());
  const base::Curve water = wither::waterCurve(project.wither.ageing);
  const base::Curve chlorophyll = wither::chlorophyllCurve(project.wither.ageing);
  chooseAutumn(project, wither::Autumn::Custom);
  EXPECT_EQ(project.wither.ageing.water, water);
  EXPECT_EQ(project.wither.ageing.chlorophyll, chlorophyll);
  // A look at another autumn does not lose them.
  chooseAutumn(project, wither::Autumn::LowTemperature);
  chooseAutumn(project, wither::Autumn::Custom);
  EXPECT_EQ(project.wither.ageing.water, water);
}

TEST(WitherEdits, AnEditedCurveKeepsTheOtherOneOfItsAutumn) {
  Project project;
  project.wither.ageing.autumn = wither::Autumn::LowTemperature;
  const base::Curve water = wither::waterCurve(project.wither.ageing);
  const base::Curve half = base::Curve::constant(0.5);
  setChlorophyll(project, half);
  EXPECT_EQ(project.wither.ageing.autumn, wither::Autumn::Custom);
  EXPECT_EQ(project.wither.ageing.chlorophyll, half);
  EXPECT_EQ(project.wither.ageing.water, water);
  setWater(project, half);
  EXPECT_EQ(project.wither.ageing.water, half);
  EXPECT_EQ(project.wither.ageing.chlorophyll, half);
}

TEST(WitherEdits, SamplesAreAddedUpToTheLimitAndRemoved) {
  Project project = lawn();
  EXPECT_FALSE(removeMingleSample(project, 0));
  EXPECT_EQ(addMingleSample(project), 1U);
  EXPECT_THAT(names(project.wither.mingle), ElementsAre("rest", "sample"));
  EXPECT_EQ(project.wither.mingle[0].share, project.wither.mingle[1].share);
  while (addMingleSample(project)) ASSERT_LE(project.wither.mingle.size(), 64U);
  EXPECT_EQ(project.wither.mingle.size(), 64U);
  EXPECT_TRUE(project::validate(project).empty());
  EXPECT_TRUE(removeMingleSample(project, 1));
  EXPECT_EQ(project.wither.mingle.size(), 63U);
  mingleGreenTurningStraw(project);
  EXPECT_THAT(names(project.wither.mingle), ElementsAre("green", "turning", "straw"));
  EXPECT_TRUE(project::validate(project).empty());
}

TEST(SelectionTest, EveryKindStaysValidInAnEmptyProject) {
  const Project empty;
  for (int kind = 0; kind <= static_cast<int>(Selection::Kind::Render); ++kind) {
    const Selection selection{static_cast<Selection::Kind>(kind), 5, "name"};
    const Selection followed = followSelection(selection, empty);
    EXPECT_EQ(followSelection(followed, empty), followed);
    EXPECT_NE(followed.kind, Selection::Kind::Plant);
    EXPECT_NE(followed.kind, Selection::Kind::View);
  }
  EXPECT_EQ(selectPlant(empty, 0), Selection{});
  EXPECT_EQ(selectView(empty, 0).kind, Selection::Kind::Render);
}

TEST(SelectionTest, FindsWhatShowsAProblem) {
  const Project project = lawn();
  EXPECT_EQ(selectionAt("patch.plants[1].gltf.path", project), selectPlant(project, 1));
  EXPECT_EQ(selectionAt("views[2].target", project), selectView(project, 2));
  EXPECT_EQ(selectionAt("patch.soil.texture", project)->kind, Selection::Kind::Ground);
  EXPECT_EQ(selectionAt("patch.plants", project)->kind, Selection::Kind::Ground);
  EXPECT_EQ(selectionAt("patch.plants[9].name", project)->kind, Selection::Kind::Ground);
  EXPECT_EQ(selectionAt("lights.directions[3].azimuthDeg", project)->kind, Selection::Kind::Lights);
  EXPECT_EQ(selectionAt("sun.moment.day", project)->kind, Selection::Kind::SunSky);
  EXPECT_EQ(selectionAt("terrain.hills.seed", project)->kind, Selection::Kind::Terrain);
  EXPECT_EQ(selectionAt("wither.mingle[0].ageing", project)->kind, Selection::Kind::Wither);
  EXPECT_EQ(selectionAt("leaf.chlorophyll", project)->kind, Selection::Kind::Leaf);
  EXPECT_EQ(selectionAt("output", project)->kind, Selection::Kind::Render);
  EXPECT_FALSE(selectionAt("name", project));
  EXPECT_FALSE(selectionAt("", project));
}

}  // namespace
}  // namespace sward::editor
