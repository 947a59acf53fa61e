#include "app/actions.h"

#include "base/check.h"

#include <gtest/gtest.h>

namespace sward::editor {
namespace {

Action named(const std::string& id, const std::string& label, const char* shortcut = "") {
  Action action;
  action.id = id;
  action.menu = "Menu";
  action.label = label;
  if (*shortcut != '\0') action.shortcuts = {Shortcut::parse(shortcut)};
  action.run = [] {};
  return action;
}

TEST(Shortcut, TextAndParsingAreInverse) {
  for (const char* text : {"Ctrl+S", "Ctrl+Shift+Z", "F12", "Shift+Del", "Alt+Enter", "Ctrl+,", "7", "F"}) {
    const Shortcut shortcut = Shortcut::parse(text);
    EXPECT_FALSE(shortcut.empty()) << text;
    EXPECT_EQ(shortcut.text(), text);
  }
  for (const char* text : {"", "Ctrl+", "Ctrl+Nothing", "Shift+Ctrl+S"})
    EXPECT_TRUE(Shortcut::parse(text).empty()) << text;
  EXPECT_EQ(Shortcut::parse("f"), Shortcut::parse("F"));
}

TEST(ActionTable, RunsEnabledActionsAlone) {
  ActionTable table;
  int runs = 0;
  bool enabled = false;
  Action action = named("file.save", "Save", "Ctrl+S");
  action.run = [&] { ++runs; };
  action.enabled = [&] { return enabled; };
  table.add(action);
  EXPECT_FALSE(table.run("file.save"));
  enabled = true;
  EXPECT_TRUE(table.run("file.save"));
  EXPECT_FALSE(table.run("file.nothing"));
  EXPECT_EQ(runs, 1);
}

TEST(ActionTable, RefusesASecondIdOrShortcut) {
  ActionTable table;
  table.add(named("a", "A", "Ctrl+A"));
  EXPECT_THROW(table.add(named("a", "Another")), base::ContractError);
  EXPECT_THROW(table.add(named("b", "B", "Ctrl+A")), base::ContractError);
}

TEST(ActionTable, PlainKeysAreLeftToTextFields) {
  ActionTable table;
  table.add(named("frame", "Frame", "F"));
  table.add(named("save", "Save", "Ctrl+S"));
  EXPECT_EQ(table.forShortcut(Shortcut::parse("F"), true), nullptr);
  ASSERT_NE(table.forShortcut(Shortcut::parse("F"), false), nullptr);
  EXPECT_EQ(table.forShortcut(Shortcut::parse("F"), false)->id, "frame");
  ASSERT_NE(table.forShortcut(Shortcut::parse("Ctrl+S"), true), nullptr);
  EXPECT_EQ(table.forShortcut({}, false), nullptr);
}

TEST(ActionTable, SearchPutsTheBestMatchFirst) {
  ActionTable table;
  table.add(named("file.revert", "Revert"));
  table.add(named("file.saveAs", "Save as..."));
  table.add(named("file.save", "Save"));
  table.add(named("view.save", "Save camera as view"));
  const auto found = table.search("sa");
  ASSERT_EQ(found.size(), 3u);
  for (const Action* action : found) EXPECT_NE(action->id, "file.revert");
  EXPECT_EQ(table.search("revert").front()->id, "file.revert");
  EXPECT_EQ(table.search("scv").front()->id, "view.save");
  EXPECT_EQ(table.search("").size(), 4u);
  EXPECT_TRUE(table.search("xyzzy").empty());
}

TEST(MatchScore, LettersMustOccurInOrder) {
  EXPECT_EQ(matchScore("ba", "ab"), 0);
  EXPECT_GT(matchScore("ab", "ab"), matchScore("ab", "axxb"));
}

}  // namespace
}  // namespace sward::editor
