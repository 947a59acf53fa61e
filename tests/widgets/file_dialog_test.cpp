#include "widgets/file_dialog.h"
#include "widgets/harness.h"

#include <gtest/gtest.h>

#include <stdlib.h>

#include <algorithm>
#include <fstream>

namespace sward::editor {
namespace {

namespace fs = std::filesystem;

/// A folder of its own, removed at the end.
struct Tree {
  fs::path root;

  Tree() {
    std::string name = (fs::temp_directory_path() / "sward-files-XXXXXX").string();
    root = mkdtemp(name.data());
    for (const char* folder : {"meadows", "meadows/alpine", "pictures", "empty", ".secret"}) {
      fs::create_directories(root / folder);
    }
    write("lawn 10.sward", 10);
    write("lawn 2.sward", 2000);
    write("Heath.SWARD", 300);
    write("notes.txt", 5);
    write(".hidden.sward", 5);
    write("meadows/may.sward", 20);
  }
  ~Tree() {
    std::error_code code;
    fs::remove_all(root, code);
  }
  Tree(const Tree&) = delete;
  Tree& operator=(const Tree&) = delete;
  void write(const std::string& name, int bytes) const {
    std::ofstream(root / name) << std::string(static_cast<std::size_t>(bytes), 'x');
  }
};

const FileFilter kProjects{"Sward projects", {".sward"}};

std::vector<std::string> names(const std::vector<FolderEntry>& entries) {
  std::vector<std::string> list;
  for (const FolderEntry& entry : entries) list.push_back(entry.name);
  return list;
}

TEST(FolderList, ListsFoldersAndWhatTheFilterLetsThrough) {
  const Tree tree;
  auto entries = listFolder(tree.root, kProjects, false).value();
  sortEntries(entries, FolderSort::Name, false);
  const std::vector<std::string> expected{"empty",       "meadows",      "pictures",
                                          "Heath.SWARD", "lawn 2.sward", "lawn 10.sward"};
  EXPECT_EQ(names(entries), expected);
  EXPECT_EQ(entries[4].bytes, 2000u);
  EXPECT_GT(entries[4].modifiedS, 1700000000);
  sortEntries(entries, FolderSort::Size, true);
  EXPECT_EQ(names(entries)[3], "lawn 2.sward") << "folders stay first in every order";
  auto all = listFolder(tree.root, FileFilter{}, true).value();
  EXPECT_EQ(all.size(), 9u);
  fs::create_symlink(tree.root / "gone", tree.root / "broken.sward");
  EXPECT_EQ(listFolder(tree.root, FileFilter{}, true).value().size(), 9u);
}

TEST(FolderList, SaysWhyAFolderCannotBeRead) {
  const auto missing = listFolder("/nowhere/at/all", kProjects, false);
  ASSERT_FALSE(missing.ok());
  EXPECT_NE(missing.error().text().find("/nowhere/at/all"), std::string::npos);
}

TEST(FolderList, NumbersCountAsPeopleCount) {
  EXPECT_TRUE(naturalLess("grass 2", "grass 10"));
  EXPECT_TRUE(naturalLess("Grass", "heath"));
  EXPECT_TRUE(naturalLess("a007", "a8"));
  EXPECT_TRUE(naturalLess("a", "a1"));
  EXPECT_FALSE(naturalLess("a", "a"));
  EXPECT_NE(naturalLess("A", "a"), naturalLess("a", "A")) << "names that differ have an order";
  EXPECT_NE(naturalLess("a01", "a1"), naturalLess("a1", "a01"));
}

TEST(FolderList, TypedTextFindsNames) {
  const std::vector<FolderEntry> entries{{"Alpine", true, 0, 0}, {"beech", false, 0, 0}, {"birch", false, 0, 0}};
  EXPECT_EQ(findTyped(entries, "B", 0), 1u);
  EXPECT_EQ(findTyped(entries, "b", 2), 2u);
  EXPECT_EQ(findTyped(entries, "bi", 0), 2u);
  EXPECT_EQ(findTyped(entries, "a", 2), 0u) << "round the end";
  EXPECT_FALSE(findTyped(entries, "x", 0).has_value());
  EXPECT_FALSE(findTyped({}, "x", 0).has_value());
}

TEST(FolderList, SizesAndNames) {
  EXPECT_EQ(fileSizeText(0), "0 B");
  EXPECT_EQ(fileSizeText(999), "999 B");
  EXPECT_EQ(fileSizeText(3400000), "3.4 MB");
  EXPECT_EQ(fileSizeText(250000000), "250 MB");
  EXPECT_EQ(timeText(0), "");
  EXPECT_EQ(nameProblem("meadow.sward"), "");
  for (const char* name : {"", ".", "..", "a/b"}) EXPECT_NE(nameProblem(name), "") << name;
  EXPECT_NE(nameProblem(std::string(300, 'a')), "");
}

struct DialogBench {
  Tree tree;
  Harness ui{900, 640};
  FileDialog dialog;
  std::optional<fs::path> chosen;
  FileDialogOptions options;

  explicit DialogBench(FileDialogMode mode = FileDialogMode::Open) {
    options.mode = mode;
    options.title = "Open a project";
    options.folder = tree.root;
    options.filters = {kProjects, {"All files", {}}};
    options.extension = ".sward";
    options.places = {{"Meadows", tree.root / "meadows"}};
    options.name = "new";
    ui.show([this] {
      if (const auto path = dialog.draw()) chosen = path;
    });
  }
  void open() {
    dialog.open(options);
    ui.frames(4);
  }
  void doubleClick(const std::string& name) {
    ui.doubleClickAt(ui.at(name));
    ui.frames(3);
  }
};

TEST(FileDialog, DoubleClickEntersFoldersAndOpensFiles) {
  DialogBench b;
  b.open();
  EXPECT_TRUE(b.ui.has("file:lawn 2.sward"));
  EXPECT_FALSE(b.ui.has("file:notes.txt"));
  EXPECT_FALSE(b.ui.has("file:.hidden.sward"));
  b.doubleClick("file:meadows");
  EXPECT_EQ(b.dialog.folder(), b.tree.root / "meadows");
  EXPECT_TRUE(b.dialog.isOpen());
  b.doubleClick("file:may.sward");
  EXPECT_EQ(b.chosen, b.tree.root / "meadows/may.sward");
  EXPECT_FALSE(b.dialog.isOpen());
  EXPECT_FALSE(b.ui.has("action:files.accept"));
}

TEST(FileDialog, KeysDoAllOfIt) {
  DialogBench b;
  b.open();
  b.ui.type("mea");
  b.ui.key(ImGuiKey_Enter);
  EXPECT_EQ(b.dialog.folder(), b.tree.root / "meadows");
  b.ui.key(ImGuiKey_Backspace);
  EXPECT_EQ(b.dialog.folder(), b.tree.root);
  b.ui.key(ImGuiKey_Enter);
  EXPECT_EQ(b.dialog.folder(), b.tree.root / "meadows") << "the folder one came from is selected";
  b.ui.key(ImGuiKey_DownArrow);
  b.ui.key(ImGuiKey_DownArrow);
  b.ui.key(ImGuiKey_Enter);
  EXPECT_EQ(b.chosen, b.tree.root / "meadows/may.sward");
}

TEST(FileDialog, EscapeAndCancelChooseNothing) {
  DialogBench b;
  b.open();
  b.ui.key(ImGuiKey_Escape);
  EXPECT_FALSE(b.dialog.isOpen());
  b.open();
  ASSERT_TRUE(b.dialog.isOpen());
  b.ui.click("action:files.cancel");
  EXPECT_FALSE(b.dialog.isOpen());
  EXPECT_FALSE(b.chosen.has_value());
}

TEST(FileDialog, PlacesCrumbsAndHiddenFiles) {
  DialogBench b;
  b.open();
  b.ui.click("place:Meadows");
  EXPECT_EQ(b.dialog.folder(), b.tree.root / "meadows");
  const auto depth = std::distance(b.tree.root.begin(), b.tree.root.end());
  b.ui.frames(2);
  b.ui.click("crumb:" + std::to_string(depth - 1));
  EXPECT_EQ(b.dialog.folder(), b.tree.root);
  b.ui.click("action:files.hidden");
  b.ui.frames(2);
  EXPECT_TRUE(b.ui.has("file:.hidden.sward"));
  EXPECT_TRUE(b.ui.has("file:.secret"));
}

TEST(FileDialog, FiltersChange) {
  DialogBench b;
  b.open();
  b.ui.click("action:files.filter");
  b.ui.frames(2);
  b.ui.click("filter:All files");
  b.ui.frames(2);
  EXPECT_TRUE(b.ui.has("file:notes.txt"));
}

TEST(FileDialog, SaveAddsTheExtension) {
  DialogBench b(FileDialogMode::Save);
  b.open();
  b.ui.key(ImGuiKey_Enter);
  EXPECT_EQ(b.chosen, b.tree.root / "new.sward");
}

TEST(FileDialog, SaveAsksBeforeItReplaces) {
  DialogBench b(FileDialogMode::Save);
  b.options.name = "lawn 2.sward";
  b.open();
  b.ui.click("action:files.accept");
  b.ui.frames(3);
  EXPECT_FALSE(b.chosen.has_value());
  ASSERT_TRUE(b.ui.has("action:files.yes"));
  b.ui.click("action:files.no");
  b.ui.frames(3);
  EXPECT_TRUE(b.dialog.isOpen());
  EXPECT_FALSE(b.chosen.has_value());
  b.ui.click("action:files.accept");
  b.ui.frames(3);
  b.ui.click("action:files.yes");
  EXPECT_EQ(b.chosen, b.tree.root / "lawn 2.sward");
  EXPECT_FALSE(b.dialog.isOpen());
}

TEST(FileDialog, SaveRefusesNamesThatAreNone) {
  DialogBench b(FileDialogMode::Save);
  b.options.name = "a/b";
  b.open();
  b.ui.click("action:files.accept");
  b.ui.frames(2);
  EXPECT_TRUE(b.dialog.isOpen());
  EXPECT_FALSE(b.chosen.has_value());
}

TEST(FileDialog, ClickOnAFileTakesItsName) {
  DialogBench b(FileDialogMode::Save);
  b.open();
  b.ui.click("file:Heath.SWARD");
  b.ui.click("action:files.accept");
  b.ui.frames(3);
  b.ui.click("action:files.yes");
  EXPECT_EQ(b.chosen, b.tree.root / "Heath.SWARD") << "an ending in capitals is the same ending";
}

TEST(FileDialog, NewFoldersAreMadeAndEntered) {
  DialogBench b(FileDialogMode::Save);
  b.open();
  b.ui.click("action:files.new folder");
  b.ui.frames(3);
  b.ui.type("autumn");
  b.ui.key(ImGuiKey_Enter);
  b.ui.frames(2);
  EXPECT_TRUE(fs::is_directory(b.tree.root / "autumn"));
  EXPECT_EQ(b.dialog.folder(), b.tree.root / "autumn");
  EXPECT_TRUE(b.dialog.isOpen());
}

TEST(FileDialog, AFolderIsChosen) {
  DialogBench b(FileDialogMode::Folder);
  b.open();
  EXPECT_FALSE(b.ui.has("file:lawn 2.sward"));
  b.ui.click("file:pictures");
  b.ui.click("action:files.accept");
  EXPECT_EQ(b.chosen, b.tree.root / "pictures");
}

TEST(FileDialog, AStartThatIsGoneGivesWayToItsParent) {
  DialogBench b;
  b.options.folder = b.tree.root / "meadows/gone/deeper";
  b.open();
  EXPECT_EQ(b.dialog.folder(), b.tree.root / "meadows");
}

TEST(FileDialog, AFolderThatCannotBeReadSaysSoAndLetsGoBack) {
  DialogBench b;
  b.open();
  EXPECT_EQ(b.dialog.error(), "");
  fs::remove(b.tree.root / "empty");  // behind the dialog's back
  b.doubleClick("file:empty");
  EXPECT_TRUE(b.dialog.isOpen());
  EXPECT_NE(b.dialog.error().find("empty"), std::string::npos);
  EXPECT_NE(b.dialog.error().find("cannot be read"), std::string::npos);
  b.ui.key(ImGuiKey_Backspace);
  EXPECT_EQ(b.dialog.folder(), b.tree.root);
  EXPECT_EQ(b.dialog.error(), "");
}

TEST(FileDialog, ATypedPathGoesThere) {
  DialogBench b;
  b.open();
  b.ui.click("action:files.type");
  b.ui.frames(3);
  b.ui.hold(true, false, false);
  b.ui.key(ImGuiKey_A);
  b.ui.hold(false, false, false);
  b.ui.type((b.tree.root / "meadows").string());
  b.ui.key(ImGuiKey_Enter);
  b.ui.frames(2);
  EXPECT_EQ(b.dialog.folder(), b.tree.root / "meadows");
}

TEST(FileDialog, FitsASmallWindowAtAnyScale) {
  const Tree tree;
  for (const float scale : {0.75f, 1.0f, 2.0f, 3.0f}) {
    Harness ui(600, 400, ThemeKind::Light, scale);
    FileDialog dialog;
    ui.show([&] { dialog.draw(); });
    FileDialogOptions options;
    options.mode = FileDialogMode::Save;
    options.folder = tree.root;
    dialog.open(options);
    ui.frames(4);
    const ItemLog::Item& accept = ui.item("action:files.accept");
    EXPECT_LE(accept.max.x, 600.0f) << scale;
    EXPECT_LE(accept.max.y, 400.0f) << scale;
    EXPECT_TRUE(accept.visible) << scale;
  }
}

}  // namespace
}  // namespace sward::editor
