#include "cli/run_program.h"

#include "base/file.h"

#include "bake/small_project.h"
#include "bake/temporary_folder.h"

#include <algorithm>
#include <fstream>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace sward {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;
using test::listing;
using test::Outcome;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

std::string contents(const fs::path& path) {
  const auto text = base::readTextFile(path);
  EXPECT_TRUE(text.ok()) << path;
  return text.ok() ? *text : std::string();
}

/// A folder with a small project `p.sward` in it; the cache lies beside the work.
class Cli : public testing::Test {
 protected:
  Cli() : m_folder("cli") {
    fs::create_directories(work());
    EXPECT_TRUE(project::save(bake::test::smallProject(), work() / "p.sward").ok());
  }
  fs::path work() const { return m_folder.path() / "work"; }
  fs::path cache() const { return m_folder.path() / "cache"; }
  Outcome run(std::vector<std::string> arguments, double interruptAfter = -1.0) const {
    arguments.insert(arguments.end(), {"--cache", cache().string()});
    return test::runProgram(work(), arguments, interruptAfter);
  }
  Outcome bare(const std::vector<std::string>& arguments) const { return test::runProgram(work(), arguments); }

 private:
  test::TemporaryFolder m_folder;
};

TEST_F(Cli, WithoutACommandItOpensTheEditorOrSaysWhyNot) {
  const Outcome outcome = bare({});  // there is no display here
  EXPECT_EQ(outcome.exitCode, 1);
  EXPECT_THAT(outcome.out, IsEmpty());
  EXPECT_THAT(outcome.err, testing::AllOf(HasSubstr("DISPLAY"), HasSubstr("sward render PROJECT")));
}

TEST_F(Cli, HelpAndVersionGoToStdout) {
  const Outcome help = bare({"--help"});
  EXPECT_EQ(help.exitCode, 0);
  EXPECT_THAT(help.out, testing::AllOf(HasSubstr("Exit codes"), HasSubstr("Examples"), HasSubstr("render")));
  EXPECT_THAT(bare({"--version"}).out, testing::StartsWith("sward 0."));
  for (const char* command : {"render", "bake", "report", "new", "check", "info", "export"}) {
    const Outcome one = bare({command, "--help"});
    EXPECT_EQ(one.exitCode, 0) << command;
    EXPECT_THAT(one.out, testing::AllOf(HasSubstr("--set"), HasSubstr("--threads"), HasSubstr("--json"),
                                        HasSubstr("--quiet"), HasSubstr("--cache")))
        << command;
  }
}

struct Wrong {
  std::vector<std::string> arguments;
  const char* message;
};

class CliWrong : public Cli, public testing::WithParamInterface<Wrong> {};

TEST_P(CliWrong, EndsWithTwoAndSaysWhy) {
  std::ofstream(work() / "broken.sward") << "{\"name\": }";
  std::ofstream(work() / "unknown.sward") << "{\"sun\": {\"angels\": {}}}";
  std::ofstream(work() / "file") << "x";
  fs::create_directories(work() / "folder.png");
  const auto before = listing(work());
  const Outcome outcome = bare(GetParam().arguments);
  EXPECT_EQ(outcome.exitCode, 2) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr(GetParam().message));
  EXPECT_THAT(outcome.out, IsEmpty());
  EXPECT_EQ(listing(work()), before);
}

INSTANTIATE_TEST_SUITE_P(
    All, CliWrong,
    testing::Values(
        Wrong{{"rendr", "p.sward"}, "Did you mean `sward render`"}, Wrong{{"edit", "--colour"}, "--colour"},
        Wrong{{"render", "p.sward"}, "--output"}, Wrong{{"render", "p.sward", "-o", "a.png", "--colour"}, "--colour"},
        Wrong{{"render", "missing.sward", "-o", "a.png"}, "missing.sward"},
        Wrong{{"render", "broken.sward", "-o", "a.png"}, "broken.sward:1:10"},
        Wrong{{"render", "unknown.sward", "-o", "a.png"}, "Did you mean \"angles\""},
        Wrong{{"render", "p.sward", "-o", "a.png", "--view", "mian"}, "Did you mean \"main\""},
        Wrong{{"render", "p.sward", "-o", "a.png", "--size", "0x0"}, "--size"},
        Wrong{{"render", "p.sward", "-o", "a.png", "--size", "1000000x10"}, "--size"},
        Wrong{{"render", "p.sward", "-o", "a.png", "--size", "16384x16385"}, "--size"},
        Wrong{{"render", "p.sward", "-o", "a.png", "--size", "640"}, "640"},
        Wrong{{"render", "p.sward", "-o", "a.png", "--size", "99999999999999999999x1"}, "--size"},
        Wrong{{"render", "p.sward", "-o", "a.png", "--sun", "nan,5"}, "--sun"},
        Wrong{{"render", "p.sward", "-o", "a.png", "--sun", "10,95"}, "--sun"},
        Wrong{{"render", "p.sward", "-o", "a.png", "--method", "marsh"}, "Did you mean \"march\""},
        Wrong{{"render", "p.sward", "-o", "a.png", "--method", "lpt8,ptm8"}, "same kind"},
        Wrong{{"render", "p.sward", "-o", "a.png", "--device", "vulkan"}, "vulkan"},
        Wrong{{"render", "p.sward", "-o", "a.png", "--spp", "0"}, "--spp"},
        Wrong{{"render", "p.sward", "-o", "a.png", "--threads", "-1"}, "--threads"},
        Wrong{{"render", "p.sward", "-o", "a.bmp"}, ".png"}, Wrong{{"render", "p.sward", "-o", "a"}, ".png"},
        Wrong{{"render", "p.sward", "-o", "none/a.png"}, "none"},
        Wrong{{"render", "p.sward", "-o", "file/a.png"}, "not a folder"},
        Wrong{{"render", "p.sward", "-o", "folder.png"}, "folder"},
        Wrong{{"render", "p.sward", "-o", "/dev/full"}, "/dev/full"},
        Wrong{{"render", "p.sward", "-o", "a.png", "--set", "sampling.slices=0"}, "sampling.slices"},
        Wrong{{"render", "p.sward", "-o", "a.png", "--set", "sampling.slice=1"}, "Did you mean \"slices\""},
        Wrong{{"render", "p.sward", "-o", "a.png", "--set", "sampling"}, "path=value"},
        Wrong{{"bake", "p.sward", "--for", "nobody"}, "nobody"},
        Wrong{{"check", "p.sward", "--set", "tiles.apron=3"}, "tiles.apron"},
        // Found by asking where the sun stands, not by ranges.
        Wrong{{"check", "p.sward", "--set", "lights.pattern=sun_path", "--set", "lights.sunPath.latitudeDeg=80",
               "--set", "lights.sunPath.dates=[{\"month\": 12}]"},
              "never stands higher"},
        Wrong{{"report", "p.sward", "-o", "r", "--section", "sped"}, "Did you mean \"speed\"? Sections: speed"},
        Wrong{{"render", "p.sward", "-o", "a.png", "--weathering", "1.5"}, "--weathering"},
        Wrong{{"render", "p.sward", "-o", "a.png", "--weathering", "nan"}, "Give 0 to 1"},
        Wrong{{"render", "p.sward", "-o", "a.png", "--method", "texels", "--max-error", "rmse=0.1"}, "--method march"},
        Wrong{{"bake", "p.sward", "--set", "render.method=texels", "--max-error", "rmse=0.1"}, "--method march"},
        Wrong{{"export", "p.sward", "-o", "v", "--frames", "3"}, "Add --texels"},
        Wrong{{"export", "p.sward", "-o", "file", "--texels"}, "file"},
        Wrong{{"check", "p.sward", "--set", "wither.ageing.weathering=[[0,0.5],[1,0.2]]"}, "never go back"},
        Wrong{{"check", "p.sward", "--set", "wither.texel.resolution=33"}, "multiple of 8"},
        Wrong{{"check", "p.sward", "--set", "wither.ageing.water=[[0,1],[0,0.5]]"}, "wither.ageing.water"},
        Wrong{{"report", "p.sward", "-o", "file"}, "file"}, Wrong{{"export", "p.sward", "-o", "file"}, "file"},
        Wrong{{"new", "n.sward", "--template", "medow"}, "Did you mean \"meadow\""},
        Wrong{{"new", "n.sward", "--grass", "missing.glb"}, "missing.glb"},
        Wrong{{"new", "n.sward", "--grass", "file"}, "file"}, Wrong{{"new", "p.sward"}, "--force"},
        Wrong{{"new", "/dev/full", "--force"}, "/dev/full"}, Wrong{{"new"}, "file"}));

TEST_F(Cli, RenderDrawsAndAChangedSunBakesNothing) {
  const Outcome first = run({"render", "p.sward", "-o", "a.png", "--size", "96x54", "--spp", "2", "--json"});
  ASSERT_EQ(first.exitCode, 0) << first.err;
  const Json result = Json::parse(first.out);
  EXPECT_EQ(result["width"], 96);
  EXPECT_GT(result["bake"]["rays"]["nearest"], 0);
  EXPECT_EQ(contents(work() / "a.png").substr(1, 3), "PNG");
  const Outcome second =
      run({"render", "p.sward", "-o", "b.exr", "--size", "96x54", "--spp", "2", "--sun", "30,50", "--json"});
  ASSERT_EQ(second.exitCode, 0) << second.err;
  const Json again = Json::parse(second.out);
  EXPECT_EQ(again["bake"]["rays"]["nearest"], 0);
  EXPECT_EQ(again["bake"]["rays"]["occlusion"], 0);
  for (const Json& node : again["bake"]["nodes"]) EXPECT_NE(node["state"], "baked");
  EXPECT_EQ(contents(work() / "b.exr").substr(0, 4), std::string("\x76\x2f\x31\x01"));
  EXPECT_THAT(listing(work()), testing::ElementsAre("a.png", "b.exr", "p.sward"));
}

TEST_F(Cli, RenderWithersLayersAndTexels) {
  const std::vector<std::string> small{"--size", "64x36", "--spp", "2"};
  const auto picture = [&](const std::string& file, std::vector<std::string> more) {
    std::vector<std::string> arguments{"render", "p.sward", "-o", file};
    arguments.insert(arguments.end(), small.begin(), small.end());
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.exitCode, 0) << outcome.err;
    return contents(work() / file);
  };
  const std::string set = "wither.texel.resolution=32";
  for (const std::string method : {"march", "texels"}) {
    const std::string fresh = picture("a.png", {"--method", method, "--set", set});
    EXPECT_NE(picture("b.png", {"--method", method, "--set", set, "--weathering", "0.9"}), fresh) << method;
    EXPECT_EQ(picture("c.png", {"--method", method, "--set", set, "--weathering", "0"}), fresh) << method;
  }
  // Nothing grows: the soil alone.
  picture("bare.png", {"--method", "texels", "--set", set, "--set", "patch.plants=[]"});
}

TEST_F(Cli, ExportWritesTexelsAndFramesOfAnAutumn) {
  const std::string set = "wither.texel.resolution=32";
  const Outcome one = run({"export", "p.sward", "-o", "one", "--texels", "--set", set});
  ASSERT_EQ(one.exitCode, 0) << one.err;
  EXPECT_THAT(listing(work() / "one"), testing::ElementsAre("p.vdb"));
  const Outcome three = run({"export", "p.sward", "-o", "three", "--texels", "--frames", "3", "--set", set});
  ASSERT_EQ(three.exitCode, 0) << three.err;
  EXPECT_THAT(listing(work() / "three"), testing::ElementsAre("p.0001.vdb", "p.0002.vdb", "p.0003.vdb"));
}

TEST_F(Cli, QuietSaysNothing) {
  const Outcome outcome = run({"bake", "p.sward", "--quiet"});
  EXPECT_EQ(outcome.exitCode, 0);
  EXPECT_THAT(outcome.out, IsEmpty());
  EXPECT_THAT(outcome.err, IsEmpty());
}

TEST_F(Cli, BakeListsItsNodes) {
  const Json first = Json::parse(run({"bake", "p.sward", "--json"}).out);
  const Json second = Json::parse(run({"bake", "p.sward", "--json", "--for", "main"}).out);
  EXPECT_GT(first["nodes"].size(), 40u);
  EXPECT_EQ(first["nodes"].size(), second["nodes"].size());
  EXPECT_EQ(first["nodes"][1]["state"], "baked");
  EXPECT_EQ(second["nodes"][1]["state"], "skipped");
  EXPECT_GT(first["groundBytes"], 0);
}

TEST_F(Cli, AnUnusableCacheIsAWarning) {
  const Outcome outcome = bare({"bake", "p.sward", "--cache", "/dev/full"});
  EXPECT_EQ(outcome.exitCode, 0);
  EXPECT_THAT(outcome.err, HasSubstr("warning"));
  EXPECT_THAT(outcome.err, HasSubstr("/dev/full"));
}

TEST_F(Cli, CheckListsProblems) {
  EXPECT_EQ(bare({"check", "p.sward"}).exitCode, 0);
  const Outcome bad = bare({"check", "p.sward", "--json", "--set", "tiles.apron=3", "--set", "lights.pattern=fibonacci",
                            "--set", "lights.count=3"});
  EXPECT_EQ(bad.exitCode, 2);
  const Json result = Json::parse(bad.out);
  EXPECT_EQ(result["valid"], false);
  ASSERT_EQ(result["problems"].size(), 2u);
  EXPECT_EQ(result["problems"][0]["fatal"], false);
  EXPECT_EQ(result["problems"][1]["where"], "tiles.apron");
}

TEST_F(Cli, CheckOpensAssets) {
  std::ofstream(work() / "bad.glb") << "glTF but not really";
  const Outcome bad =
      bare({"check", "p.sward", "--set", "patch.plants[0].kind=gltf", "--set", "patch.plants[0].gltf.path=bad.glb"});
  EXPECT_EQ(bad.exitCode, 2) << bad.err;
  EXPECT_THAT(bad.err, HasSubstr("patch.plants[0].gltf.path"));
}

TEST_F(Cli, NewExportAndNewAgain) {
  ASSERT_EQ(bare({"export", "p.sward", "-o", "plants"}).exitCode, 0);
  EXPECT_THAT(listing(work() / "plants"), testing::ElementsAre("flower.glb", "grass-1.glb", "grass-2.glb"));
  fs::create_directories(work() / "projects");
  const Outcome made = bare({"new", "projects/mine.sward", "--grass", "plants/grass-1.glb", "--template", "lawn"});
  ASSERT_EQ(made.exitCode, 0) << made.err;
  const auto project = project::load(work() / "projects" / "mine.sward");
  ASSERT_TRUE(project.ok());
  EXPECT_EQ(project->patch.plants[0].kind, project::PlantKind::Gltf);
  EXPECT_EQ(project->patch.plants[0].gltf.path, "../plants/grass-1.glb");
  EXPECT_EQ(bare({"check", "projects/mine.sward"}).exitCode, 0);
  // What was chosen for the plant is said, and a value of one's own goes before it.
  EXPECT_THAT(made.err, HasSubstr("a square metre (patch.plants[0].densityPerM2)"));
  const Outcome tall = bare(
      {"new", "projects/tall.sward", "--grass", "plants/grass-1.glb", "--set", "patch.plants[0].gltf.heightM=1.5"});
  ASSERT_EQ(tall.exitCode, 0) << tall.err;
  EXPECT_EQ(project::load(work() / "projects" / "tall.sward")->patch.plants[0].gltf.heightM, 1.5);
  const std::string list = bare({"new", "--list"}).out;
  for (const char* name : {"meadow   ", "flowers  ", "dry      ", "lawn     ", "empty    "}) {
    EXPECT_THAT(list, HasSubstr(name));
  }
  EXPECT_THAT(list, HasSubstr("clover, daisies"));
  EXPECT_EQ(bare({"new", "p.sward", "--force", "--quiet"}).exitCode, 0);
}

TEST_F(Cli, InfoNamesDevicesAndLibraries) {
  const Outcome outcome = bare({"info", "--json"});
  ASSERT_EQ(outcome.exitCode, 0);
  const Json info = Json::parse(outcome.out);
  EXPECT_EQ(info["devices"].size(), 2u);
  EXPECT_TRUE(info["libraries"].contains("Embree"));
}

/// A project whose bake takes many seconds.
std::vector<std::string> slow() {
  return {"--set", "sampling.sliceResolution=512",
          "--set", "sampling.bladeWidth=512",
          "--set", "tiles.resolution=128",
          "--set", "sampling.sliceSubSamples=16",
          "--set", "sampling.visibilityDirections=256"};
}

/// What the program may still work after a signal: all cores for a second. Unchecked, it would go on for a minute.
const double kASecondOfAllThreads = std::max(std::thread::hardware_concurrency(), 1U);

TEST_F(Cli, CtrlCEndsABakeWithinASecond) {
  for (const char* command : {"render", "bake"}) {
    std::vector<std::string> arguments{command, "p.sward"};
    if (std::string_view(command) == "render") arguments.insert(arguments.end(), {"-o", "a.png"});
    for (const std::string& argument : slow()) arguments.push_back(argument);
    const Outcome outcome = run(arguments, 0.6);
    EXPECT_EQ(outcome.exitCode, 130) << command << ": " << outcome.err;
    EXPECT_LT(outcome.processorSeconds, kASecondOfAllThreads) << command;
    EXPECT_THAT(listing(work()), testing::ElementsAre("p.sward")) << command;
  }
}

TEST_F(Cli, CtrlCEndsAPictureWithinASecond) {
  ASSERT_EQ(run({"bake", "p.sward"}).exitCode, 0);
  const Outcome outcome = run({"render", "p.sward", "-o", "a.png", "--size", "3840x2160", "--spp", "4096"}, 2.0);
  EXPECT_EQ(outcome.exitCode, 130) << outcome.err;
  EXPECT_LT(outcome.processorSeconds, kASecondOfAllThreads);
  EXPECT_THAT(listing(work()), testing::ElementsAre("p.sward"));
}

TEST_F(Cli, AFailingRenderLeavesTheOldPicture) {
  std::ofstream(work() / "a.png") << "old";
  EXPECT_EQ(bare({"render", "p.sward", "-o", "a.png", "--view", "nobody"}).exitCode, 2);
  std::vector<std::string> arguments{"render", "p.sward", "-o", "a.png"};
  for (const std::string& argument : slow()) arguments.push_back(argument);
  EXPECT_EQ(run(arguments, 0.5).exitCode, 130);
  EXPECT_EQ(contents(work() / "a.png"), "old");
}

}  // namespace
}  // namespace sward
