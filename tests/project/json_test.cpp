#include "project/project.h"

#include "project/words.h"

#include "project/fields.h"

#include <filesystem>
#include <fstream>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace sward::project {
namespace {

using test::changed;
using test::Json;
using testing::HasSubstr;

/// A document in which every field of the schema is present: all four kinds, all optional values, lists with entries.
Project fullProject() {
  Project project = fromTemplate("meadow").value();
  Plant gltf;
  gltf.name = "imported";
  gltf.kind = PlantKind::Gltf;
  gltf.gltf.path = "assets/tuft.glb";
  gltf.gltf.heightM = 0.3;
  mesh::MaterialOverride material;
  material.baseColour = glm::dvec3(0.1, 0.2, 0.3);
  material.alphaCutoff = 0.4;
  gltf.gltf.material = material;
  project.patch.plants.push_back(gltf);
  project.patch.plants[0].grass.profile = base::Curve::fromPoints({{0.0, 0.6}, {0.3, 1.0}, {1.0, 0.0}}).value();
  project.patch.plants[0].grass.heightDistribution = base::Curve::fromPoints({{0.2, 0.1}, {1.0, 0.9}}).value();
  project.patch.plants[0].grass.colourAlong = base::Curve::fromPoints({{0.0, 0.1}, {1.0, 0.8}}).value();
  project.patch.soil.texture = "soil.png";
  project.lights.directions = {{10.0, 20.0}, {30.0, 40.0}};
  project.lights.rings.rings = 3;  // not the defaults, so that unused ones are written too
  project.lights.sunPath.positions = 7;
  project.sun.byMoment = true;
  project.sun.angles.azimuthDeg = 12.5;
  return project;
}

TEST(ProjectJson, EveryFieldSurvivesTheRoundTrip) {
  const std::string text = toJson(fullProject());
  const Json original = Json::parse(text);
  const auto fields = test::leaves(original);
  EXPECT_GT(fields.size(), 250u);
  for (const auto& field : fields) {
    if (field.to_string() == "/version") continue;
    Json edited = original;
    edited[field] = changed(original[field]);
    const auto project = parse(edited.dump(), "p.sward");
    ASSERT_TRUE(project.ok()) << field << ": " << project.error().text();
    const Json again = Json::parse(toJson(*project));
    // A switched kind may write or leave out defaults of the unused ones; the edited value itself must be there.
    ASSERT_TRUE(again.contains(field)) << field;
    EXPECT_EQ(again[field], edited[field]) << field;
  }
}

TEST(ProjectJson, EveryFieldDecidesEquality) {
  const Project full = parse(toJson(fullProject()), "p.sward").value();
  const Json original = Json::parse(toJson(full));
  for (const auto& field : test::leaves(original)) {
    if (field.to_string() == "/version") continue;
    Json edited = original;
    edited[field] = changed(original[field]);
    EXPECT_FALSE(parse(edited.dump(), "p.sward").value() == full) << field;
  }
  Project moved = full;
  moved.folder = "elsewhere";
  EXPECT_TRUE(moved == full) << "the folder is not part of the document";
}

TEST(ProjectJson, TextIsAFixedPoint) {
  for (const std::string& name : templateNames()) {
    const std::string text = toJson(fromTemplate(name).value());
    EXPECT_EQ(toJson(parse(text, "p.sward").value()), text) << name;
  }
  const std::string text = toJson(fullProject());
  EXPECT_EQ(toJson(parse(text, "p.sward").value()), text);
}

TEST(ProjectJson, KeysStandInTheOrderOfTheDesign) {
  const Json json = Json::parse(toJson(fullProject()));
  std::vector<std::string> keys;
  for (auto item = json.begin(); item != json.end(); ++item) keys.push_back(item.key());
  EXPECT_THAT(keys,
              testing::ElementsAre("version", "name", "patch", "lights", "sampling", "fit", "tiles", "leaf", "wither",
                                   "terrain", "sun", "sky", "render", "accuracy", "views", "output", "sequence"));
}

TEST(ProjectJson, CurvesAndColoursStayOnOneLine) {
  Project project = fullProject();
  project.views[0].position = {0.0, -5.0, 1.65};
  const std::string text = toJson(project);
  EXPECT_THAT(text, HasSubstr("\"profile\": [[0.0, 0.6], [0.3, 1.0], [1.0, 0.0]]"));
  EXPECT_THAT(text, HasSubstr("\"position\": [0.0, -5.0, 1.65]"));
}

TEST(ProjectJson, MissingKeysKeepTheirDefaults) {
  const auto project = parse("{}", "dir/p.sward");
  ASSERT_TRUE(project.ok());
  Project fresh;
  EXPECT_EQ(toJson(*project), toJson(fresh));
  EXPECT_EQ(project->folder, "dir");
}

TEST(ProjectJson, UnknownKeyNamesItsPathAndTheNearestName) {
  Json json = Json::parse(toJson(fullProject()));
  json["patch"]["plants"][1]["grass"]["hightM"] = 0.2;
  const auto project = parse(json.dump(), "p.sward");
  ASSERT_FALSE(project.ok());
  EXPECT_THAT(project.error().where, HasSubstr("p.sward: patch.plants[1].grass.hightM"));
  EXPECT_THAT(project.error().remedy, HasSubstr("\"heightM\""));
}

TEST(ProjectJson, EveryFieldRefusesAWrongType) {
  const Json original = Json::parse(toJson(fullProject()));
  for (const auto& field : test::leaves(original)) {
    Json edited = original;
    edited[field] = Json::object();
    const auto project = parse(edited.dump(), "p.sward");
    ASSERT_FALSE(project.ok()) << field;
    EXPECT_FALSE(project.error().where.empty()) << field;
    EXPECT_EQ(project.error().kind, ErrorKind::BadInput);
  }
}

struct BadText {
  const char* text;
  const char* where;
  const char* what;
};

class ProjectBadText : public testing::TestWithParam<BadText> {};

TEST_P(ProjectBadText, IsAnErrorWithItsPlace) {
  const auto project = parse(GetParam().text, "p.sward");
  ASSERT_FALSE(project.ok()) << GetParam().text;
  EXPECT_EQ(project.error().kind, ErrorKind::BadInput);
  EXPECT_THAT(project.error().where, HasSubstr(GetParam().where));
  EXPECT_THAT(project.error().text(), HasSubstr(GetParam().what));
}

INSTANTIATE_TEST_SUITE_P(
    All, ProjectBadText,
    testing::Values(BadText{"", "p.sward:1:1", "JSON"}, BadText{"{\n  \"name\": ,\n}", "p.sward:2:11", "JSON"},
                    BadText{"{\"name\": \"a\"", "p.sward:1", "JSON"}, BadText{"[]", "p.sward", "a list"},
                    BadText{"null", "p.sward", "null"},
                    BadText{"{\"patch\": {\"sideM\": NaN}}", "p.sward:1:21", "JSON"},
                    BadText{"{\"patch\": {\"sideM\": 1e999}}", "p.sward", "overflow"},
                    BadText{"{\"version\": 2}", "version", "newer version"},
                    BadText{"{\"version\": 0}", "version", "no format version"},
                    BadText{"{\"version\": 1e300}", "version", "whole number"},
                    BadText{"{\"name\": \"a\", \"name\": \"b\"}", "p.sward", "twice"},
                    BadText{"{\"sampling\": {\"seed\": -1}}", "sampling.seed", "from 0"},
                    BadText{"{\"sampling\": {\"slices\": 1.5}}", "sampling.slices", "whole number"},
                    BadText{"{\"tiles\": {\"map\": \"hash\"}}", "tiles.map", "scan_order, hashed"},
                    BadText{"{\"patch\": {\"soil\": {\"colour\": [1, 2]}}}", "patch.soil.colour", "three numbers"},
                    BadText{"{\"patch\": {\"plants\": [{\"grass\": {\"profile\": [[0, 1], [0, 1]]}}]}}",
                            "patch.plants[0].grass.profile", "do not increase"},
                    BadText{"{\"name\": \"a\\u0000b\"}", "name", "zero character"},
                    BadText{"{\"name\": \"\xff\"}", "p.sward", "UTF-8"}));

TEST(ProjectJson, ADepthBombIsRefusedBeforeItIsParsed) {
  const auto project = parse(std::string(1 << 20, '['), "p.sward");
  ASSERT_FALSE(project.ok());
  EXPECT_THAT(project.error().where, HasSubstr("p.sward:1:33"));
  EXPECT_THAT(project.error().what, HasSubstr("deep"));
  const auto inText = parse("{\"name\": \"" + std::string(1000, '[') + "\"}", "p.sward");
  EXPECT_TRUE(inText.ok());
}

TEST(ProjectJson, LongListsAreRefused) {
  std::string text = "{\"views\": [";
  for (int i = 0; i < 1001; ++i) text += i == 0 ? "{}" : ",{}";
  const auto project = parse(text + "]}", "p.sward");
  ASSERT_FALSE(project.ok());
  EXPECT_THAT(project.error().text(), HasSubstr("At most 1000"));
}

TEST(ProjectJson, AHugeFileIsRefused) {
  const auto path = std::filesystem::temp_directory_path() / "sward_huge.sward";
  std::ofstream(path) << "{}";
  std::filesystem::resize_file(path, std::uintmax_t{64} << 20);
  const auto project = load(path);
  std::filesystem::remove(path);
  ASSERT_FALSE(project.ok());
  EXPECT_THAT(project.error().what, HasSubstr("larger than"));
}

TEST(ProjectJson, RandomByteFlipsNeverCrash) {
  const std::string text = toJson(fullProject());
  std::mt19937 random(7);
  int accepted = 0;
  for (int trial = 0; trial < 3000; ++trial) {
    std::string damaged = text;
    for (int flips = 1 + static_cast<int>(random() % 4); flips > 0; --flips) {
      damaged[random() % damaged.size()] ^= static_cast<char>(1 << (random() % 8));
    }
    if (trial % 3 == 0) damaged.resize(random() % damaged.size());
    const auto project = parse(damaged, "p.sward");
    if (project.ok()) {
      ++accepted;
      validate(*project);
      EXPECT_TRUE(parse(toJson(*project), "p.sward").ok());
    } else {
      EXPECT_FALSE(project.error().what.empty());
    }
  }
  EXPECT_LT(accepted, 3000);
}

TEST(ProjectOverrides, SetValuesOfEveryType) {
  const std::string text = toJson(fullProject());
  const auto project =
      parse(text, "p.sward",
            {"sun.angles.elevationDeg=20", "patch.plants[0].share=0.5", "name=Other meadow", "tiles.map=hashed",
             "views[1].position=[1, 2, 3]", "sun.byMoment=false", "patch.plants[6].gltf.heightM=null"});
  ASSERT_TRUE(project.ok()) << project.error().text();
  EXPECT_EQ(project->sun.angles.elevationDeg, 20.0);
  EXPECT_EQ(project->patch.plants[0].share, 0.5);
  EXPECT_EQ(project->name, "Other meadow");
  EXPECT_EQ(project->tiles.map, tiles::MapMethod::Hashed);
  EXPECT_EQ(project->views[1].position, glm::dvec3(1, 2, 3));
  EXPECT_FALSE(project->sun.byMoment);
  EXPECT_FALSE(project->patch.plants[6].gltf.heightM.has_value());
}

TEST(ProjectOverrides, MakeObjectsThatTheFileLeavesOut) {
  const auto project = parse("{}", "p.sward", {"sun.angles.elevationDeg=20"});
  ASSERT_TRUE(project.ok()) << project.error().text();
  EXPECT_EQ(project->sun.angles.elevationDeg, 20.0);
}

TEST(ProjectOverrides, RefuseWrongPathsAndValues) {
  const std::string text = toJson(fullProject());
  for (const char* bad : {"", "=", "sun", "sun=", "sun.angles.elevation=1", "patch.plants[99].share=1", "a..b=1",
                          "patch.plants[x].share=1", "patch.plants[-1].share=1", "name.x=1", "views[0=1",
                          "sun.angles.elevationDeg=high", "sampling.slices=1e999", "name=[[[["}) {
    const auto project = parse(text, "p.sward", {bad});
    if (std::string_view(bad) == "name=[[[[") {
      EXPECT_TRUE(project.ok()) << "text that is not JSON is text";
      continue;
    }
    ASSERT_FALSE(project.ok()) << bad;
    EXPECT_EQ(project.error().kind, ErrorKind::BadInput) << bad;
  }
}

TEST(ProjectFiles, SaveRefusesWhatCouldNotBeOpenedAgain) {
  const auto path = std::filesystem::temp_directory_path() / "sward_nan.sward";
  std::filesystem::remove(path);
  Project project = fullProject();
  project.sun.intensity = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(save(project, path).ok());
  EXPECT_FALSE(std::filesystem::exists(path));
  EXPECT_TRUE(save(fullProject(), path).ok());
  EXPECT_EQ(toJson(load(path).value()), toJson(fullProject()));
  std::filesystem::remove(path);
}

TEST(ProjectFiles, AMissingFileSaysSo) {
  const auto project = load("/nowhere/meadow.sward");
  ASSERT_FALSE(project.ok());
  EXPECT_EQ(project.error().kind, ErrorKind::BadInput);
  EXPECT_THAT(project.error().where, HasSubstr("/nowhere/meadow.sward"));
}

}  // namespace
}  // namespace sward::project
