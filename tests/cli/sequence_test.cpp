#include "cli/run_program.h"

#include "base/file.h"

#include "bake/small_project.h"
#include "bake/temporary_folder.h"

#include <algorithm>
#include <map>

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

std::string contents(const fs::path& path) {
  const auto text = base::readTextFile(path);
  EXPECT_TRUE(text.ok()) << path;
  return text.ok() ? *text : std::string();
}

/// A folder with a small project of a sequence of five frames, drawn as texels.
class Sequence : public testing::Test {
 protected:
  Sequence() : m_folder("cli-sequence") {
    fs::create_directories(work());
    project::Project project = bake::test::smallProject();
    project.render.method = render::GroundMethod::Texels;
    project.wither.texel.resolution = 16;
    project.sequence.frames = 5;
    project.output = {64, 36};
    project.render.samples = 1;
    EXPECT_TRUE(project::save(project, work() / "p.sward").ok());
  }
  fs::path work() const { return m_folder.path() / "work"; }

  /// Renders frames with more options, into a folder of their own.
  Outcome render(const std::string& folder, std::vector<std::string> more, double interruptAfter = -1.0) const {
    fs::create_directories(work() / folder);
    std::vector<std::string> arguments{"render", "p.sward", "-o", folder + "/f_%02d.png", "--cache", "../cache"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return test::runProgram(work(), arguments, interruptAfter);
  }
  /// How many frames were drawn, not kept.
  static int drawn(const Outcome& outcome) {
    const Json result = Json::parse(outcome.out);
    return static_cast<int>(std::count_if(result["frames"].begin(), result["frames"].end(),
                                          [](const Json& frame) { return frame["state"] == "drawn"; }));
  }
  std::map<std::string, std::string> files(const std::string& folder) const {
    std::map<std::string, std::string> all;
    for (const std::string& name : listing(work() / folder)) all[name] = contents(work() / folder / name);
    return all;
  }

 private:
  test::TemporaryFolder m_folder;
};

TEST_F(Sequence, DrawsEveryFrameOnce) {
  const Outcome outcome = render("a", {"--frames", "0:4", "--json"});
  ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
  EXPECT_THAT(listing(work() / "a"),
              testing::ElementsAre("f.frames.json", "f_00.png", "f_01.png", "f_02.png", "f_03.png", "f_04.png"));
  const Json result = Json::parse(outcome.out);
  ASSERT_EQ(result["frames"].size(), 5u);
  EXPECT_EQ(result["frames"][3]["file"], "f_03.png");
  EXPECT_EQ(result["frames"][3]["weathering"], 0.75);
  const Json manifest = Json::parse(contents(work() / "a" / "f.frames.json"));
  EXPECT_EQ(manifest["frames"].size(), 5u);
  EXPECT_EQ(manifest["settings"]["project"]["sequence"]["frames"], 5);
  EXPECT_EQ(manifest["frames"][3]["hash"], result["frames"][3]["hash"]);
  // A frame is what a picture of that moment is.
  const Outcome one =
      test::runProgram(work(), {"render", "p.sward", "-o", "one.png", "--weathering", "0.75", "--cache", "../cache"});
  ASSERT_EQ(one.exitCode, 0) << one.err;
  EXPECT_EQ(contents(work() / "one.png"), contents(work() / "a" / "f_03.png"));
  EXPECT_NE(contents(work() / "a" / "f_00.png"), contents(work() / "a" / "f_04.png"));
}

TEST_F(Sequence, ShardsTogetherAreTheWholeByteForByte) {
  ASSERT_EQ(render("whole", {"--frames", "0:4"}).exitCode, 0);
  for (const char* shard : {"2/3", "3/3", "1/3"}) {
    const Outcome outcome = render("parts", {"--frames", "0:4", "--shard", shard});
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
  }
  EXPECT_EQ(files("whole"), files("parts"));  // the manifest, too
  // More machines than frames: the last has nothing to do.
  const Outcome idle = render("parts", {"--frames", "1:1", "--shard", "2/2", "--json"});
  EXPECT_EQ(idle.exitCode, 0);
  EXPECT_THAT(Json::parse(idle.out)["frames"], IsEmpty());
}

TEST_F(Sequence, LayersWitherOverASequence) {
  const std::vector<std::string> layers{"--frames", "0:4", "--method", "march", "--shard", "1/4", "--json"};
  const Outcome first = render("a", layers);
  ASSERT_EQ(first.exitCode, 0) << first.err;
  EXPECT_EQ(drawn(first), 2);
  EXPECT_NE(contents(work() / "a" / "f_00.png"), contents(work() / "a" / "f_04.png"));
  EXPECT_EQ(drawn(render("a", layers)), 0);
}

TEST_F(Sequence, FinishedFramesAreKeptAndBrokenOrStaleOnesDrawnAnew) {
  const std::vector<std::string> all{"--frames", "0:4", "--json"};
  ASSERT_EQ(render("a", {"--frames", "1:2"}).exitCode, 0);
  EXPECT_EQ(drawn(render("a", all)), 3);
  const auto before = files("a");
  EXPECT_EQ(drawn(render("a", all)), 0);
  // Cut off, changed in the middle, gone.
  ASSERT_TRUE(base::writeFileAtomically(work() / "a" / "f_01.png", before.at("f_01.png").substr(0, 60)).ok());
  std::string changed = before.at("f_02.png");
  changed[changed.size() / 2] = static_cast<char>(changed[changed.size() / 2] ^ 4);
  ASSERT_TRUE(base::writeFileAtomically(work() / "a" / "f_02.png", changed).ok());
  fs::remove(work() / "a" / "f_04.png");
  EXPECT_EQ(drawn(render("a", all)), 3);
  EXPECT_EQ(files("a"), before);
  // Other settings make frames stale, other names do not.
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.end(), all.begin(), all.end());
    return drawn(render("a", more));
  };
  EXPECT_EQ(with({"--set", "name=other"}), 0);
  EXPECT_EQ(with({"--set", "sequence.framesPerSecond=30"}), 0);
  EXPECT_EQ(with({"--sun", "100,20"}), 5);
  EXPECT_EQ(with({}), 5);
  EXPECT_EQ(with({"--set", "wither.ageing.tipLead=0.5"}), 5);
  EXPECT_EQ(with({}), 5);
  EXPECT_EQ(with({"--exposure", "1"}), 5);
  EXPECT_EQ(with({"--force"}), 5);
  EXPECT_EQ(with({}), 0);
  // Without its account nothing is known of the frames.
  ASSERT_TRUE(base::writeFileAtomically(work() / "a" / "f.frames.json", std::string("{")).ok());
  EXPECT_EQ(drawn(render("a", all)), 5);
  EXPECT_EQ(files("a"), before);
}

TEST_F(Sequence, AnInterruptedRunGoesOnWhereItWas) {
  const std::vector<std::string> all{"--frames", "0:39", "--set", "sequence.frames=40"};
  ASSERT_EQ(render("whole", all).exitCode, 0);
  const auto whole = files("whole");
  // Interrupted later and later, until it has ended with some frames drawn; however fast the machine is, it goes on.
  for (double after = 0.2; after < 20.0; after *= 2.0) {
    const Outcome outcome = render("cut", all, after);
    EXPECT_THAT(outcome.exitCode, testing::AnyOf(0, 130)) << outcome.err;
    for (const auto& [name, bytes] : files("cut")) {
      ASSERT_TRUE(whole.contains(name)) << name << " was left over";
      if (name == "f.frames.json") continue;
      EXPECT_TRUE(bytes == whole.at(name)) << name << " is not whole";
    }
    if (outcome.exitCode == 0 || listing(work() / "cut").size() > 2) break;
  }
  const Outcome last = render("cut", all);
  EXPECT_EQ(last.exitCode, 0) << last.err;
  EXPECT_TRUE(files("cut") == whole);
}

struct Wrong {
  std::vector<std::string> arguments;
  const char* message;
};
class SequenceWrong : public Sequence, public testing::WithParamInterface<Wrong> {};

TEST_P(SequenceWrong, EndsWithTwoAndWritesNothing) {
  fs::create_directories(work() / "folder_00.png");
  const auto before = listing(work());
  std::vector<std::string> arguments{"render", "p.sward"};
  arguments.insert(arguments.end(), GetParam().arguments.begin(), GetParam().arguments.end());
  const Outcome outcome = test::runProgram(work(), arguments);
  EXPECT_EQ(outcome.exitCode, 2) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr(GetParam().message));
  EXPECT_THAT(outcome.out, IsEmpty());
  EXPECT_EQ(listing(work()), before);
}

INSTANTIATE_TEST_SUITE_P(
    All, SequenceWrong,
    testing::Values(Wrong{{"-o", "f.png", "--frames", "0:1"}, "autumn_%04d.png"},
                    Wrong{{"-o", "f_%02d_%02d.png", "--frames", "0:1"}, "several places"},
                    Wrong{{"-o", "f_%s.png", "--frames", "0:1"}, "percent sign"},
                    Wrong{{"-o", "f_%02d.png"}, "Add --frames"}, Wrong{{"-o", "f_%02d.bmp", "--frames", "0:1"}, ".png"},
                    Wrong{{"-o", "none/f_%02d.png", "--frames", "0:1"}, "none"},
                    Wrong{{"-o", "folder_%02d.png", "--frames", "0:1"}, "folder"},
                    Wrong{{"-o", "f_%02d.png", "--frames", "0:5"}, "0:4"},
                    Wrong{{"-o", "f_%02d.png", "--frames", "-1:4"}, "--frames"},
                    Wrong{{"-o", "f_%02d.png", "--frames", "3:2"}, "after the last"},
                    Wrong{{"-o", "f_%02d.png", "--frames", "3"}, "no range"},
                    Wrong{{"-o", "f_%02d.png", "--frames", "0:1", "--shard", "0/4"}, "--shard"},
                    Wrong{{"-o", "f_%02d.png", "--frames", "0:1", "--shard", "5/4"}, "--shard"},
                    Wrong{{"-o", "f_%02d.png", "--frames", "0:1", "--shard", "1"}, "--shard"},
                    Wrong{{"-o", "f.png", "--shard", "1/2"}, "Add --frames"},
                    Wrong{{"-o", "f.png", "--force"}, "Add --frames"},
                    Wrong{{"-o", "f_%02d.png", "--frames", "0:1", "--weathering", "0.5"}, "--weathering"},
                    Wrong{{"-o", "f_%02d.png", "--frames", "0:1", "--max-error", "rmse=0.1"}, "--max-error"},
                    Wrong{{"-o", "f_%02d.png", "--frames", "0:1", "--view", "nobody"}, "nobody"},
                    Wrong{{"-o", "f_%02d.png", "--frames", "0:1", "--set", "sequence.frames=0"}, "sequence.frames"},
                    Wrong{{"-o", "f_%02d.png", "--frames", "0:1", "--set", "sequence.season=[[0,2]]"},
                          "sequence.season"}));

}  // namespace
}  // namespace sward
