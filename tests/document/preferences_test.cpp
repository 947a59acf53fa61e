#include "document/preferences.h"

#include "base/file.h"

#include "bake/temporary_folder.h"

#include <fstream>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace sward::editor {
namespace {

namespace fs = std::filesystem;
using test::TemporaryFolder;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using Json = nlohmann::ordered_json;

void write(const fs::path& file, const std::string& text) {
  std::ofstream(file, std::ios::trunc) << text;
}

/// Every value another than its default.
Preferences unusual() {
  Preferences p;
  p.uiScale = 1.75;
  p.theme = ThemeChoice::Light;
  p.cacheLimitBytes = 123456789012;
  p.device = "software";
  p.showHints = false;
  p.autosaveSeconds = 42.5;
  p.recentFiles = {"/a/one.sward", "/b/two.sward"};
  p.window = {-100, 50, 1920, 1080, true, true};
  p.panelSizes = {{"inspector", 320.5}, {"outliner", 0.25}};
  p.openPanels = {"outliner", "curves"};
  return p;
}

TEST(Preferences, EveryValueSurvivesTheRoundTrip) {
  const TemporaryFolder folder("prefs-round");
  const fs::path file = folder.path() / "sward" / "preferences.json";
  ASSERT_TRUE(savePreferences(unusual(), file).ok());
  const LoadedPreferences loaded = loadPreferences(file);
  EXPECT_THAT(loaded.messages, IsEmpty());
  EXPECT_EQ(loaded.preferences, unusual());
  // Each key of the file matters: without it, something is at its default again.
  const Json json = Json::parse(base::readTextFile(file).value());
  EXPECT_EQ(json.size(), 10u);
  for (auto item = json.begin(); item != json.end(); ++item) {
    Json without = json;
    without.erase(item.key());
    write(file, without.dump());
    EXPECT_FALSE(loadPreferences(file).preferences == unusual()) << item.key();
  }
}

TEST(Preferences, AMissingFileGivesDefaultsWithoutAWord) {
  const LoadedPreferences loaded = loadPreferences("/nowhere/preferences.json");
  EXPECT_THAT(loaded.messages, IsEmpty());
  EXPECT_EQ(loaded.preferences, Preferences{});
}

TEST(Preferences, UnknownKeysAreKept) {
  const TemporaryFolder folder("prefs-unknown");
  const fs::path file = folder.path() / "p.json";
  write(file, R"({"uiScale": 2.0, "future": {"a": [1, 2]}, "theme": "light"})");
  LoadedPreferences loaded = loadPreferences(file);
  EXPECT_THAT(loaded.messages, IsEmpty());
  loaded.preferences.uiScale = 1.5;
  ASSERT_TRUE(savePreferences(loaded.preferences, file).ok());
  const Json json = Json::parse(base::readTextFile(file).value());
  EXPECT_EQ(json["future"], Json::parse(R"({"a": [1, 2]})"));
  EXPECT_EQ(json["uiScale"], 1.5);
  EXPECT_EQ(loadPreferences(file).preferences, loaded.preferences);
}

TEST(Preferences, WrongValuesFallBackOneByOne) {
  const TemporaryFolder folder("prefs-wrong");
  const fs::path file = folder.path() / "p.json";
  ASSERT_TRUE(savePreferences(unusual(), file).ok());
  const Json good = Json::parse(base::readTextFile(file).value());
  const std::vector<std::pair<std::string, Json>> cases{{"/uiScale", -1.0},
                                                        {"/uiScale", 0.25},
                                                        {"/uiScale", 5},
                                                        {"/uiScale", "big"},
                                                        {"/theme", "pink"},
                                                        {"/theme", 7},
                                                        {"/cacheLimitBytes", 5},
                                                        {"/cacheLimitBytes", -5},
                                                        {"/cacheLimitBytes", 1e18},
                                                        {"/device", 3},
                                                        {"/showHints", 1},
                                                        {"/autosaveSeconds", 0.0},
                                                        {"/autosaveSeconds", 1e9},
                                                        {"/recentFiles", "x"},
                                                        {"/recentFiles", {1, 2}},
                                                        {"/window", 3},
                                                        {"/window/x", 1e12},
                                                        {"/window/width", 0},
                                                        {"/window/height", "a"},
                                                        {"/window/known", 2},
                                                        {"/window/maximised", "no"},
                                                        {"/panelSizes", {1}},
                                                        {"/panelSizes/outliner", -1},
                                                        {"/openPanels", {{"a", 1}}}};
  for (const auto& [place, value] : cases) {
    Json json = good;
    json[Json::json_pointer(place)] = value;
    write(file, json.dump());
    const LoadedPreferences loaded = loadPreferences(file);
    EXPECT_EQ(loaded.messages.size(), 1u) << place << " = " << value;
    EXPECT_FALSE(loaded.preferences == unusual()) << place << " = " << value;
    // All else is as it was: setting the default there by hand gives the same.
    const Json::json_pointer at(place);
    Json without = good;
    without[at.parent_pointer()].erase(at.back());
    write(file, without.dump());
    EXPECT_EQ(loaded.preferences, loadPreferences(file).preferences) << place << " = " << value;
    EXPECT_TRUE(fs::exists(file)) << "a wrong value does not set the file aside";
  }
}

TEST(Preferences, ADamagedFileIsSetAside) {
  const TemporaryFolder folder("prefs-damaged");
  const fs::path file = folder.path() / "p.json";
  const std::string deep = std::string(200000, '[');
  for (const std::string& text : {std::string(), std::string("{"), std::string("[1]"), std::string("\xff\xfe"), deep}) {
    write(file, text);
    const LoadedPreferences loaded = loadPreferences(file);
    EXPECT_EQ(loaded.preferences, Preferences{});
    ASSERT_EQ(loaded.messages.size(), 1u);
    EXPECT_THAT(loaded.messages[0], HasSubstr("p.json.bad"));
    EXPECT_FALSE(fs::exists(file));
    EXPECT_EQ(base::readTextFile(file.string() + ".bad").value(), text);
  }
  ASSERT_TRUE(savePreferences(unusual(), file).ok());
  EXPECT_EQ(loadPreferences(file).preferences, unusual());
}

TEST(Preferences, NoTruncationOrFlippedByteCrashes) {
  const TemporaryFolder folder("prefs-fuzz");
  const fs::path file = folder.path() / "p.json";
  ASSERT_TRUE(savePreferences(unusual(), file).ok());
  const std::string text = base::readTextFile(file).value();
  // The last byte is a newline, which is no loss.
  for (std::size_t length = 0; length + 1 < text.size(); ++length) {
    write(file, text.substr(0, length));
    EXPECT_EQ(loadPreferences(file).messages.size(), 1u) << length;
  }
  std::mt19937 random(7);
  for (int i = 0; i < 3000; ++i) {
    std::string flipped = text;
    const std::size_t at = random() % text.size();
    flipped[at] = static_cast<char>(flipped[at] ^ static_cast<char>(1u << (random() % 8)));
    write(file, flipped);
    const LoadedPreferences loaded = loadPreferences(file);
    const Preferences& p = loaded.preferences;
    EXPECT_TRUE(p.uiScale == 0.0 || (p.uiScale >= 0.5 && p.uiScale <= 4.0));
    EXPECT_TRUE(p.autosaveSeconds >= 1.0 && p.autosaveSeconds <= 3600.0);
    EXPECT_TRUE(p.window.width >= 64 && p.window.height >= 64);
    EXPECT_LE(p.recentFiles.size(), Preferences::kMaxRecent);
  }
}

TEST(Preferences, AFailedSaveSaysSoAndKeepsTheOldFile) {
  const TemporaryFolder folder("prefs-fail");
  const fs::path file = folder.path() / "p.json";
  ASSERT_TRUE(savePreferences(unusual(), file).ok());
  const std::string text = base::readTextFile(file).value();
  Preferences bad = unusual();
  bad.device = "\xff";
  EXPECT_FALSE(savePreferences(bad, file).ok());
  EXPECT_EQ(base::readTextFile(file).value(), text);
  EXPECT_FALSE(savePreferences(unusual(), file / "inside" / "p.json").ok());
  EXPECT_FALSE(savePreferences(unusual(), fs::path()).ok());
}

TEST(Preferences, SavingFollowsALink) {
  const TemporaryFolder folder("prefs-link");
  write(folder.path() / "dotfile.json", "{}");
  fs::create_symlink(folder.path() / "dotfile.json", folder.path() / "p.json");
  ASSERT_TRUE(savePreferences(unusual(), folder.path() / "p.json").ok());
  EXPECT_TRUE(fs::is_symlink(folder.path() / "p.json"));
  EXPECT_EQ(loadPreferences(folder.path() / "dotfile.json").preferences, unusual());
}

TEST(RecentFiles, NewestFirstOnceEachAtMostTwelve) {
  Preferences p;
  for (int i = 0; i < 20; ++i) p.addRecent("/p/" + std::to_string(i) + ".sward");
  ASSERT_EQ(p.recentFiles.size(), Preferences::kMaxRecent);
  EXPECT_EQ(p.recentFiles.front(), "/p/19.sward");
  EXPECT_EQ(p.recentFiles.back(), "/p/8.sward");
  p.addRecent("/p/x/../10.sward");
  EXPECT_EQ(p.recentFiles.front(), "/p/10.sward");
  EXPECT_EQ(p.recentFiles.size(), Preferences::kMaxRecent);
  EXPECT_EQ(std::count(p.recentFiles.begin(), p.recentFiles.end(), "/p/10.sward"), 1);
  p.removeRecent("/p/10.sward");
  EXPECT_EQ(p.recentFiles.size(), Preferences::kMaxRecent - 1);
  p.addRecent("");
  EXPECT_EQ(p.recentFiles.front(), "/p/19.sward");
  p.addRecent("relative.sward");
  EXPECT_TRUE(p.recentFiles.front().is_absolute());
}

TEST(RecentFiles, MissingOnesAreKeptAndTold) {
  const TemporaryFolder folder("prefs-recent");
  write(folder.path() / "here.sward", "{}");
  Preferences p;
  p.addRecent(folder.path() / "here.sward");
  p.addRecent(folder.path() / "gone.sward");
  const auto list = recentFiles(p);
  ASSERT_EQ(list.size(), 2u);
  EXPECT_TRUE(list[0].missing);
  EXPECT_FALSE(list[1].missing);
}

}  // namespace
}  // namespace sward::editor
