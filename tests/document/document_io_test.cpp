#include "document/document_io.h"

#include "base/file.h"
#include "project/assets.h"

#include "bake/temporary_folder.h"

#include <csignal>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

namespace sward::editor {
namespace {

namespace fs = std::filesystem;
using project::Project;
using project::toJson;
using test::TemporaryFolder;
using testing::HasSubstr;

void touch(const fs::path& file) {
  fs::create_directories(file.parent_path());
  std::ofstream(file) << "x";
}

void setSide(Document& document, double sideM) {
  document.edit("patch size", [&](Project& p) { p.patch.sideM = sideM; });
}

/// Everything in a folder, so that leftovers of a failed save are seen.
std::vector<std::string> listing(const fs::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return names;
}

/// A saved document of a folder of the test's own.
struct Saved {
  explicit Saved(const std::string& name) : folder(name) {
    EXPECT_TRUE(saveDocumentAs(document, file).ok());
    text = base::readTextFile(file).value();
    setSide(document, 2.5);
  }
  void expectNothingLost() const {
    EXPECT_EQ(base::readTextFile(file).value(), text);
    EXPECT_THAT(listing(folder.path()), testing::ElementsAre("field.sward"));
    EXPECT_TRUE(document.modified());
    EXPECT_DOUBLE_EQ(document.project().patch.sideM, 2.5);
  }
  TemporaryFolder folder;
  fs::path file = folder.path() / "field.sward";
  Document document = newDocument("meadow").value();
  std::string text;
};

TEST(DocumentIo, SaveAndOpenGiveTheSameDocument) {
  Saved saved("io-save");
  ASSERT_TRUE(saveDocument(saved.document).ok());
  EXPECT_FALSE(saved.document.modified());
  const auto opened = openDocument(saved.file);
  ASSERT_TRUE(opened.ok()) << opened.error().text();
  EXPECT_EQ(toJson(opened->project()), toJson(saved.document.project()));
  EXPECT_EQ(opened->file(), saved.file);
  EXPECT_FALSE(opened->modified());
}

TEST(DocumentIo, ANewDocumentHasNoFile) {
  Document document = newDocument("lawn").value();
  EXPECT_FALSE(document.modified());
  const auto result = saveDocument(document);
  ASSERT_FALSE(result.ok());
  EXPECT_THAT(result.error().remedy, HasSubstr("Save As"));
  EXPECT_FALSE(newDocument("jungle").ok());
}

TEST(DocumentIo, OpeningSaysWhatIsWrong) {
  const TemporaryFolder folder("io-open");
  EXPECT_FALSE(openDocument(folder.path() / "missing.sward").ok());
  std::ofstream(folder.path() / "bad.sward") << "{\"patch\": 7}";
  const auto bad = openDocument(folder.path() / "bad.sward");
  ASSERT_FALSE(bad.ok());
  EXPECT_THAT(bad.error().where, HasSubstr("bad.sward"));
}

TEST(DocumentIo, AFileInTheWayOfTheFolderLosesNothing) {
  Saved saved("io-notdir");
  const auto result = saveDocumentAs(saved.document, saved.file / "inside.sward");
  ASSERT_FALSE(result.ok());
  EXPECT_THAT(result.error().where, HasSubstr("inside.sward"));
  EXPECT_FALSE(result.error().remedy.empty());
  EXPECT_EQ(saved.document.file(), saved.file) << "a failed Save As does not move the document";
  saved.expectNothingLost();
}

TEST(DocumentIo, AFullDiskLosesNothing) {
  Saved saved("io-full");
  // A file size limit makes write(2) fail after some bytes, as a disk that fills up does.
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  rlimit old{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &old), 0);
  rlimit tight = old;
  tight.rlim_cur = saved.text.size() / 2;
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &tight), 0);
  const auto result = saveDocument(saved.document);
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &old), 0);
  std::signal(SIGXFSZ, handler);
  ASSERT_FALSE(result.ok());
  EXPECT_THAT(result.error().remedy, HasSubstr("space"));
  saved.expectNothingLost();
  ASSERT_TRUE(saveDocument(saved.document).ok()) << "and can be saved once there is space";
}

/// Runs a part of a test as a user whom permissions stop; root passes them all.
class AsNobody {
 public:
  AsNobody() {
    if (m_root) m_dropped = ::setresuid(65534, 65534, 0) == 0;
  }
  ~AsNobody() {
    if (m_dropped) {
      EXPECT_EQ(::setresuid(0, 0, 0), 0);
    }
  }
  bool ready() const { return !m_root || m_dropped; }

 private:
  bool m_root = ::geteuid() == 0;
  bool m_dropped = false;
};

TEST(DocumentIo, AReadOnlyFolderLosesNothing) {
  Saved saved("io-folder");
  fs::permissions(saved.folder.path(), fs::perms(0555));
  {
    const AsNobody nobody;
    ASSERT_TRUE(nobody.ready());
    const auto result = saveDocument(saved.document);
    ASSERT_FALSE(result.ok());
    EXPECT_THAT(result.error().remedy, HasSubstr("permissions"));
  }
  fs::permissions(saved.folder.path(), fs::perms(0755));
  saved.expectNothingLost();
}

TEST(DocumentIo, AReadOnlyFileLosesNothing) {
  Saved saved("io-readonly");
  fs::permissions(saved.folder.path(), fs::perms(0777));
  fs::permissions(saved.file, fs::perms(0444));
  {
    const AsNobody nobody;
    ASSERT_TRUE(nobody.ready());
    const auto result = saveDocument(saved.document);
    ASSERT_FALSE(result.ok()) << "rename(2) alone would replace it";
    EXPECT_THAT(result.error().remedy, HasSubstr("permissions"));
  }
  saved.expectNothingLost();
}

TEST(DocumentIo, SavingKeepsPermissionsAndFollowsLinks) {
  Saved saved("io-link");
  fs::permissions(saved.file, fs::perms(0600));
  fs::create_directories(saved.folder.path() / "links");
  const fs::path link = saved.folder.path() / "links" / "link.sward";
  fs::create_symlink(saved.file, link);
  ASSERT_TRUE(saveDocumentAs(saved.document, link).ok());
  EXPECT_TRUE(fs::is_symlink(link));
  EXPECT_EQ(fs::status(saved.file).permissions(), fs::perms(0600));
  EXPECT_DOUBLE_EQ(openDocument(saved.file)->project().patch.sideM, 2.5);
  EXPECT_EQ(saved.document.file(), link);
}

TEST(DocumentIo, WhatCouldNotBeOpenedAgainIsNotSaved) {
  Saved saved("io-nan");
  saved.document.edit("name", [](Project& p) { p.name = "\xff\xfe"; });
  EXPECT_FALSE(saveDocument(saved.document).ok());
  saved.expectNothingLost();
}

TEST(DocumentIo, SaveAsElsewhereNamesTheSameAssets) {
  const TemporaryFolder folder("io-rebase");
  const fs::path meshFile = folder.path() / "work" / "assets" / "tuft.glb";
  touch(meshFile);
  touch(folder.path() / "library" / "soil.png");
  Document document = newDocument("empty").value();
  ASSERT_TRUE(saveDocumentAs(document, folder.path() / "work" / "a.sward").ok());
  document.edit("assets", [&](Project& p) {
    project::Plant plant;
    plant.kind = project::PlantKind::Gltf;
    plant.gltf.path = project::assetPath(meshFile, p.folder);
    p.patch.plants.push_back(plant);
    p.patch.soil.texture = (folder.path() / "library" / "soil.png").string();
  });
  EXPECT_EQ(document.project().patch.plants[0].gltf.path, "assets/tuft.glb");
  const fs::path target = folder.path() / "copies" / "deep" / "b.sward";
  EXPECT_FALSE(saveDocumentAs(document, target).ok()) << "the folder is not there";
  EXPECT_EQ(document.project().patch.plants[0].gltf.path, "assets/tuft.glb") << "a failed save moves nothing";
  fs::create_directories(target.parent_path());
  ASSERT_TRUE(saveDocumentAs(document, target).ok());
  for (const Project& p : {document.project(), openDocument(target)->project()}) {
    EXPECT_EQ(p.patch.plants[0].gltf.path, "../../work/assets/tuft.glb");
    EXPECT_EQ(p.patch.soil.texture, (folder.path() / "library" / "soil.png").string());
    EXPECT_TRUE(project::missingAssets(p).empty());
  }
  EXPECT_EQ(toJson(document.project()), base::readTextFile(target).value());
}

TEST(DocumentIo, AssetsOfANeverSavedProjectBecomeRelative) {
  const TemporaryFolder folder("io-first");
  touch(folder.path() / "assets" / "soil.png");
  Document document = newDocument("empty").value();
  document.edit("soil", [&](Project& p) {
    p.patch.soil.texture = project::assetPath(folder.path() / "assets" / "soil.png", p.folder);
  });
  EXPECT_TRUE(fs::path(document.project().patch.soil.texture).is_absolute());
  ASSERT_TRUE(saveDocumentAs(document, folder.path() / "a.sward").ok());
  EXPECT_EQ(document.project().patch.soil.texture, "assets/soil.png");
  EXPECT_FALSE(document.modified());
}

TEST(DocumentIo, RelativePathsHoldThroughLinkedFolders) {
  const TemporaryFolder folder("io-linked");
  touch(folder.path() / "data" / "assets" / "soil.png");
  fs::create_directories(folder.path() / "data" / "projects");
  fs::create_symlink(folder.path() / "data" / "projects", folder.path() / "link");
  Document document = newDocument("empty").value();
  document.edit("soil", [&](Project& p) { p.patch.soil.texture = (folder.path() / "data/assets/soil.png").string(); });
  ASSERT_TRUE(saveDocumentAs(document, folder.path() / "link" / "a.sward").ok());
  EXPECT_EQ(document.project().patch.soil.texture, "../assets/soil.png");
  EXPECT_TRUE(project::missingAssets(openDocument(folder.path() / "link" / "a.sward")->project()).empty());
}

TEST(DocumentIo, RevertIsAStepThatCanBeUndone) {
  Saved saved("io-revert");
  const auto reverted = revertDocument(saved.document);
  ASSERT_TRUE(reverted.ok());
  EXPECT_TRUE(*reverted);
  EXPECT_EQ(toJson(saved.document.project()), saved.text);
  EXPECT_FALSE(saved.document.modified());
  EXPECT_EQ(saved.document.undoName(), "revert to saved");
  saved.document.undo();
  EXPECT_DOUBLE_EQ(saved.document.project().patch.sideM, 2.5);
  EXPECT_TRUE(saved.document.modified());
  saved.document.redo();
  EXPECT_FALSE(*revertDocument(saved.document)) << "nothing to go back to";
  fs::remove(saved.file);
  setSide(saved.document, 2.75);
  EXPECT_FALSE(revertDocument(saved.document).ok());
  EXPECT_DOUBLE_EQ(saved.document.project().patch.sideM, 2.75);
}

TEST(DocumentIo, NamesGetTheExtensionThatTheyLack) {
  EXPECT_EQ(withProjectExtension("a/field"), "a/field.sward");
  EXPECT_EQ(withProjectExtension("a/field.sward"), "a/field.sward");
  EXPECT_EQ(withProjectExtension("a/"), "a/");
}

TEST(Assets, MissingOnesAreListedAndRelocated) {
  const TemporaryFolder folder("io-missing");
  touch(folder.path() / "there.glb");
  Project project;
  project.folder = folder.path();
  project.patch.plants.resize(4);
  for (project::Plant& plant : project.patch.plants) plant.kind = project::PlantKind::Gltf;
  project.patch.plants[0].gltf.path = "there.glb";
  project.patch.plants[1].gltf.path = "gone.glb";
  project.patch.plants[2].kind = project::PlantKind::Grass;
  project.patch.plants[2].gltf.path = "unused.glb";
  project.patch.plants[3].gltf.path = "gone.glb";
  project.patch.soil.texture = "soil.png";
  std::vector<std::string> missing;
  for (const auto& asset : project::missingAssets(project)) missing.push_back(asset.where + " " + asset.path);
  EXPECT_THAT(missing, testing::ElementsAre("patch.plants[1].gltf.path gone.glb", "patch.plants[3].gltf.path gone.glb",
                                            "patch.soil.texture soil.png"));
  EXPECT_EQ(project::assets(project).size(), 5u);

  touch(folder.path() / "moved" / "found.glb");
  EXPECT_FALSE(project::relocate(project, "patch.plants[1].gltf.path", folder.path() / "moved" / "nowhere.glb").ok());
  EXPECT_FALSE(project::relocate(project, "patch.plants[9].gltf.path", folder.path() / "there.glb").ok());
  ASSERT_TRUE(project::relocate(project, "patch.plants[1].gltf.path", folder.path() / "moved" / "found.glb").ok());
  EXPECT_EQ(project.patch.plants[1].gltf.path, "moved/found.glb");
  EXPECT_EQ(project.patch.plants[3].gltf.path, "moved/found.glb") << "the same lost file, found once";
  EXPECT_EQ(project.patch.plants[0].gltf.path, "there.glb");
  EXPECT_EQ(project::missingAssets(project).size(), 1u);
}

}  // namespace
}  // namespace sward::editor
