#include "project/limits.h"
#include "project/presets.h"
#include "project/project.h"

#include <cmath>
#include <fstream>
#include <functional>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace sward::project {
namespace {

using testing::HasSubstr;

std::vector<Problem> fatalOf(const Project& project) {
  std::vector<Problem> problems = validate(project);
  std::erase_if(problems, [](const Problem& p) { return !p.fatal; });
  return problems;
}

std::string describe(const std::vector<Problem>& problems) {
  std::string text;
  for (const Problem& p : problems) text += p.where + ": " + p.what + ". " + p.remedy + "\n";
  return text;
}

TEST(Validate, TemplatesAreFreeOfProblems) {
  for (const std::string& name : templateNames()) {
    const auto problems = validate(fromTemplate(name).value());
    const bool empty = name == "empty";
    EXPECT_EQ(problems.size(), empty ? 1u : 0u) << name << "\n" << describe(problems);
    EXPECT_TRUE(requireValid(fromTemplate(name).value()).ok());
  }
  EXPECT_FALSE(fromTemplate("medow").ok());
  EXPECT_THAT(fromTemplate("medow").error().remedy, HasSubstr("\"meadow\""));
}

TEST(Validate, PlantPresetsAreFreeOfProblems) {
  std::set<std::string> names;
  for (const PlantPreset& preset : plantPresets()) {
    EXPECT_TRUE(names.insert(preset.name).second) << preset.name;
    EXPECT_TRUE(preset.description.ends_with('.')) << preset.name;
    EXPECT_LE(preset.description.size(), 80u) << preset.name << ": one line";
    EXPECT_FALSE(preset.plant.name.empty());
    EXPECT_EQ(plantFromPreset(preset.name), preset.plant);
    Project project = fromTemplate("empty").value();
    project.patch.plants = {preset.plant};
    EXPECT_THAT(describe(validate(project)), testing::IsEmpty()) << preset.name;
  }
  EXPECT_GE(names.size(), 9u);
  EXPECT_EQ(plantFromPreset("no such plant"), Plant{});
}

TEST(Validate, TemplatesSayWhatTheyShow) {
  std::set<std::string> descriptions;
  for (const TemplateInfo& entry : templates()) {
    EXPECT_TRUE(fromTemplate(entry.name).ok());
    EXPECT_GT(entry.description.size(), 10u);
    EXPECT_TRUE(descriptions.insert(entry.description).second);
  }
}

/// One rule at its edges: an override that is still allowed, and one that is not.
struct Edge {
  const char* good;
  const char* bad;
  const char* where;
};

class ValidateEdge : public testing::TestWithParam<Edge> {};

Project with(const std::string& overrides) {
  std::vector<std::string> list;
  std::string rest = overrides;
  while (!rest.empty()) {
    const std::size_t end = std::min(rest.find(';'), rest.size());
    list.push_back(rest.substr(0, end));
    rest.erase(0, end + 1);
  }
  auto project = parse(toJson(fromTemplate("meadow").value()), "p.sward", list);
  EXPECT_TRUE(project.ok()) << overrides << ": " << (project.ok() ? "" : project.error().text());
  return project.ok() ? *project : Project{};
}

TEST_P(ValidateEdge, HoldsAndBreaks) {
  EXPECT_THAT(describe(fatalOf(with(GetParam().good))), testing::IsEmpty()) << GetParam().good;
  const auto problems = fatalOf(with(GetParam().bad));
  ASSERT_FALSE(problems.empty()) << GetParam().bad;
  EXPECT_THAT(describe(problems), HasSubstr(std::string(GetParam().where) + ":"));
  for (const Problem& p : problems) {
    EXPECT_FALSE(p.what.empty());
    EXPECT_FALSE(p.remedy.empty());
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, ValidateEdge,
    testing::Values(
        Edge{"sampling.sliceResolution=2048;tiles.resolution=512;sampling.bladeWidth=2048",
             "sampling.sliceResolution=2049", "sampling.sliceResolution"},
        Edge{"sampling.sliceResolution=8;sampling.blades=8;tiles.resolution=8;tiles.overlap=1;tiles.apron=1;"
             "sampling.sliceResolution=16",
             "sampling.sliceResolution=7", "sampling.sliceResolution"},
        Edge{"sampling.slices=1", "sampling.slices=0", "sampling.slices"},
        Edge{"sampling.slices=64", "sampling.slices=65", "sampling.slices"},
        Edge{"sampling.bladeWidth=256", "sampling.bladeWidth=384", "sampling.bladeWidth"},
        Edge{"sampling.blades=8", "sampling.blades=0", "sampling.blades"},
        Edge{"sampling.blades=16", "sampling.blades=7", "sampling.sliceResolution"},
        Edge{"sampling.sliceSubSamples=256", "sampling.sliceSubSamples=257", "sampling.sliceSubSamples"},
        Edge{"lights.count=6", "lights.count=0", "lights.count"},
        Edge{"lights.pattern=list;lights.directions=[{\"elevationDeg\": 0}]", "lights.pattern=list",
             "lights.directions"},
        Edge{"lights.pattern=list;lights.directions=[{\"elevationDeg\": 90}]",
             "lights.pattern=list;lights.directions=[{\"elevationDeg\": -1}]", "lights.directions[0].elevationDeg"},
        Edge{"lights.pattern=rings", "lights.pattern=rings;lights.rings.rings=0", "lights.rings.rings"},
        Edge{"lights.pattern=rings;lights.rings.rings=16;lights.rings.lightsPerRing=63",
             "lights.pattern=rings;lights.rings.rings=16;lights.rings.lightsPerRing=64", "lights.rings"},
        Edge{"lights.pattern=rings;lights.rings.rings=1;lights.rings.highestDeg=20",
             "lights.pattern=rings;lights.rings.highestDeg=20", "lights.rings.highestDeg"},
        Edge{"lights.rings.lowestDeg=-1", "lights.pattern=rings;lights.rings.lowestDeg=-1", "lights.rings.lowestDeg"},
        Edge{"lights.pattern=sun_path", "lights.pattern=sun_path;lights.sunPath.dates=[]", "lights.sunPath.dates"},
        Edge{"lights.pattern=sun_path;lights.sunPath.dates=[{\"month\": 2, \"day\": 29}, {\"month\": 9}]",
             "lights.pattern=sun_path;lights.sunPath.dates=[{\"month\": 2, \"day\": 30}, {\"month\": 9}]",
             "lights.sunPath.dates[0].day"},
        Edge{"lights.pattern=sun_path;lights.sunPath.latitudeDeg=-90",
             "lights.pattern=sun_path;lights.sunPath.latitudeDeg=-91", "lights.sunPath.latitudeDeg"},
        Edge{"patch.plants[0].grass.heightM=0.002", "patch.plants[0].grass.heightM=0", "patch.plants[0].grass.heightM"},
        Edge{"patch.plants[0].grass.heightM=20", "patch.plants[0].grass.heightM=20.1", "patch.plants[0].grass.heightM"},
        Edge{"patch.plants[0].flower.heightM=0", "patch.plants[4].flower.heightM=0", "patch.plants[4].flower.heightM"},
        Edge{"patch.plants[0].densityPerM2=0", "patch.plants[0].densityPerM2=-1", "patch.plants[0].densityPerM2"},
        Edge{"patch.sideM=14;patch.plants=[{\"densityPerM2\": 1000}]",
             "patch.sideM=14.2;patch.plants=[{\"densityPerM2\": 1000}]", "patch"},
        Edge{"patch.sideM=0.02", "patch.sideM=0", "patch.sideM"},
        Edge{"patch.plants[0].grass.rootColour=[0, 1, 0.5]", "patch.plants[0].grass.rootColour=[0, 1.1, 0.5]",
             "patch.plants[0].grass.rootColour[1]"},
        Edge{"patch.plants[0].grass.profile=[[0, 1], [1, 0]]", "patch.plants[0].grass.profile=[[0, 1], [1.5, 0]]",
             "patch.plants[0].grass.profile[1][0]"},
        Edge{"patch.plants[0].grass.profile=[[0, 0], [1, 0.1]]", "patch.plants[0].grass.profile=[[0, 0], [1, 0]]",
             "patch.plants[0].grass.profile"},
        Edge{"patch.plants[0].grass.heightDistribution=[[0, 0], [2, 0.01]]",
             "patch.plants[0].grass.heightDistribution=[[0, 0], [2, 0]]", "patch.plants[0].grass.heightDistribution"},
        Edge{"patch.plants[0].grass.heightDistribution=[[0, 1], [2, 0]]",
             "patch.plants[0].grass.heightDistribution=[[0, 1], [2.1, 0]]",
             "patch.plants[0].grass.heightDistribution[1][0]"},
        Edge{"patch.plants[0].grass.colourAlong=[[0, 0], [1, 0]]",
             "patch.plants[0].grass.colourAlong=[[0, 0], [1, 1.1]]", "patch.plants[0].grass.colourAlong[1][1]"},
        // A clover does not grow by a grass's curve.
        Edge{"patch.plants[3].grass.profile=[[0, 0]]", "patch.plants[1].grass.profile=[[0, 0]]",
             "patch.plants[1].grass.profile"},
        Edge{"tiles.resolution=128", "tiles.resolution=66", "tiles.resolution"},
        Edge{"tiles.resolution=64", "tiles.resolution=65", "tiles.resolution"},
        Edge{"tiles.resolution=192;tiles.overlap=32", "tiles.resolution=192;tiles.overlap=33", "tiles.resolution"},
        Edge{"tiles.overlap=16", "tiles.overlap=17", "tiles.overlap"},
        Edge{"sampling.blades=8", "sampling.blades=2;tiles.resolution=128", "tiles.coloursPerAxis"},
        Edge{"tiles.apron=32", "tiles.apron=12", "tiles.apron"},
        Edge{"tiles.apron=32", "tiles.apron=64", "tiles.apron"},
        Edge{"tiles.tilesPerPair=9", "tiles.tilesPerPair=10", "tiles.tilesPerPair"},
        Edge{"tiles.coloursPerAxis=4;tiles.tilesPerPair=15", "tiles.coloursPerAxis=4;tiles.tilesPerPair=16",
             "tiles.tilesPerPair"},
        Edge{"tiles.coloursPerAxis=4", "tiles.coloursPerAxis=5", "tiles.coloursPerAxis"},
        Edge{"tiles.map=hashed;tiles.tilesPerPair=9", "tiles.map=hashed", "tiles.map"},
        Edge{"tiles.mapWidth=3900", "tiles.mapWidth=3901", "tiles.mapWidth"},
        Edge{"fit.bits=16", "fit.bits=12", "fit.bits"},
        Edge{"fit.clampQuantile=0.49", "fit.clampQuantile=0.5", "fit.clampQuantile"},
        Edge{"views[0].focalLengthMm=1", "views[0].focalLengthMm=0", "views[0].focalLengthMm"},
        Edge{"views[0].name=other", "views[0].name=top", "views[1].name"},
        Edge{"views[0].target=[0, 0, 0]", "views[0].position=[1, 2, 3];views[0].target=[1, 2, 3]", "views[0].target"},
        Edge{"output.width=16384;output.height=16384", "output.width=16385", "output.width"},
        Edge{"output.width=1", "output.width=0", "output.width"},
        Edge{"render.samples=1", "render.samples=0", "render.samples"},
        Edge{"sky.turbidity=1.7", "sky.turbidity=1.6", "sky.turbidity"},
        Edge{"sun.angles.elevationDeg=-90", "sun.angles.elevationDeg=-90.5", "sun.angles.elevationDeg"},
        Edge{"sun.byMoment=true;sun.moment={\"year\": 2024, \"month\": 2, \"day\": 29}",
             "sun.byMoment=true;sun.moment={\"year\": 2025, \"month\": 2, \"day\": 29}", "sun.moment.day"},
        Edge{"patch.plants[0].share=0", "patch.plants=[{\"share\": 0}]", "patch.plants"}));

TEST(Validate, MessagesNameTheUnit) {
  const auto problems = fatalOf(with("patch.plants[0].grass.heightM=99"));
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_EQ(problems[0].what, "the value is 99 m");
  EXPECT_EQ(problems[0].remedy, "Give 0.002 to 20 m.");
}

TEST(Validate, EveryNumberThatIsNotFiniteIsFound) {
  const std::vector<std::function<double*(Project&)>> numbers{
      [](Project& p) { return &p.patch.sideM; },
      [](Project& p) { return &p.patch.plants[0].densityPerM2; },
      [](Project& p) { return &p.patch.plants[0].share; },
      [](Project& p) { return &p.views[0].position.x; },
      [](Project& p) { return &p.sun.intensity; },
      [](Project& p) { return &p.fit.layerRidge; },
      [](Project& p) { return &p.patch.plants[0].grass.optics.translucency; }};
  for (const auto& number : numbers) {
    for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()}) {
      Project project = fromTemplate("meadow").value();
      *number(project) = bad;
      EXPECT_FALSE(fatalOf(project).empty());
      EXPECT_FALSE(requireValid(project).ok());
    }
  }
}

TEST(Validate, TheHitCountFitsIn32Bits) {
  const auto problems =
      fatalOf(with("sampling.sliceResolution=2048;sampling.slices=64;sampling.sliceSubSamples=16;"
                   "tiles.resolution=512"));
  EXPECT_THAT(describe(problems), HasSubstr("sampling.sliceSubSamples: "));
}

TEST(Validate, FewLightsAndNoViewsAreWarnings) {
  Project project = fromTemplate("meadow").value();
  project.lights.count = 5;
  project.views.clear();
  const auto problems = validate(project);
  ASSERT_EQ(problems.size(), 2u) << describe(problems);
  EXPECT_FALSE(problems[0].fatal);
  EXPECT_FALSE(problems[1].fatal);
  EXPECT_TRUE(requireValid(project).ok());
}

TEST(Validate, LightsOnOneCircleAreAWarning) {
  const auto warnings = [](const std::string& overrides) { return describe(validate(with(overrides))); };
  const std::string ring = "lights.pattern=rings;lights.rings.rings=1;lights.rings.lightsPerRing=15";
  EXPECT_EQ(warnings(ring), "");
  EXPECT_THAT(warnings(ring + ";lights.rings.zenith=false"), HasSubstr("lights.rings: a single ring"));
  const std::string days = "lights.pattern=sun_path;lights.sunPath.positions=12;lights.sunPath.dates=";
  EXPECT_EQ(warnings(days + "[{\"month\": 6}, {\"month\": 12}]"), "");
  EXPECT_THAT(warnings(days + "[{\"month\": 6}]"), HasSubstr("lights.sunPath.dates: a single day"));
}

TEST(Validate, AssetsMustBeThere) {
  const auto folder = std::filesystem::temp_directory_path() / "sward_assets_test";
  std::filesystem::create_directories(folder / "folder.glb");
  std::ofstream(folder / "grass.glb") << "x";
  Project project = fromTemplate("empty").value();
  project.folder = folder;
  project.patch.plants.resize(1);
  project.patch.plants[0].kind = PlantKind::Gltf;
  for (const char* bad : {"", "missing.glb", "grass.obj", "folder.glb"}) {
    project.patch.plants[0].gltf.path = bad;
    EXPECT_THAT(describe(fatalOf(project)), HasSubstr("patch.plants[0].gltf.path:")) << bad;
  }
  project.patch.plants[0].gltf.path = "grass.glb";
  EXPECT_TRUE(fatalOf(project).empty());
  project.patch.soil.texture = "missing.png";
  EXPECT_THAT(describe(fatalOf(project)), HasSubstr("patch.soil.texture:"));
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace sward::project
