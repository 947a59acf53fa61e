#include "document/file_watch.h"

#include "base/file.h"
#include "document/document_io.h"

#include "bake/temporary_folder.h"

#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace sward::editor {
namespace {

namespace fs = std::filesystem;
using project::Project;
using test::TemporaryFolder;
using testing::ElementsAre;
using testing::IsEmpty;
using What = FileEvent::What;

void write(const fs::path& file, const std::string& text) {
  std::ofstream(file, std::ios::trunc) << text;
}

/// A watch whose clock the test turns.
struct Watching {
  std::vector<FileEvent> tick() {
    now += std::chrono::seconds(1);
    return watch.poll(now);
  }
  /// What is told within two looks: one finds a change, the next finds it settled.
  std::vector<FileEvent> settle() {
    std::vector<FileEvent> events = tick();
    EXPECT_THAT(events, IsEmpty()) << "told before it settled";
    return tick();
  }
  FileWatch watch;
  FileWatch::Time now{};
};

/// A saved document that is watched.
struct WatchedProject : Watching {
  explicit WatchedProject(const std::string& name) : folder(name) {
    EXPECT_TRUE(saveDocumentAs(document, file).ok());
    watch.watchProject(document.file(), document.snapshot());
    EXPECT_THAT(settle(), IsEmpty()) << "what was just saved is no news";
  }
  std::string otherText() const {
    Project other = document.project();
    other.patch.seed += 1;
    return project::toJson(other);
  }
  TemporaryFolder folder;
  fs::path file = folder.path() / "a.sward";
  Document document = newDocument("lawn").value();
};

TEST(FileWatch, AProjectWrittenInPlaceIsNoticed) {
  WatchedProject p("watch-inplace");
  write(p.file, p.otherText());
  EXPECT_TRUE(p.watch.projectDiffers());
  EXPECT_THAT(p.settle(), ElementsAre(FileEvent{p.file, What::Changed, true}));
  EXPECT_THAT(p.settle(), IsEmpty()) << "told once";
}

TEST(FileWatch, AProjectReplacedByRenameIsNoticed) {
  WatchedProject p("watch-rename");
  const auto time = fs::last_write_time(p.file);
  const fs::path temporary = p.folder.path() / "a.sward~";
  write(temporary, p.otherText());
  fs::last_write_time(temporary, time);
  ASSERT_EQ(fs::file_size(temporary), fs::file_size(p.file)) << "the same size and time: another file all the same";
  fs::rename(temporary, p.file);
  EXPECT_THAT(p.settle(), ElementsAre(FileEvent{p.file, What::Changed, true}));
}

TEST(FileWatch, ATouchAndAnotherLayoutAreNoNews) {
  WatchedProject p("watch-touch");
  fs::last_write_time(p.file, fs::file_time_type::clock::now() + std::chrono::seconds(5));
  EXPECT_THAT(p.settle(), IsEmpty());
  write(p.file, "\n\n" + project::toJson(p.document.project()) + "\n");
  EXPECT_FALSE(p.watch.projectDiffers());
  EXPECT_THAT(p.settle(), IsEmpty());
}

TEST(FileWatch, OurOwnSavesAreNoNews) {
  WatchedProject p("watch-own");
  for (int i = 1; i < 4; ++i) {
    p.document.edit("size", [&](Project& project) { project.patch.sideM = 1.0 + i; });
    ASSERT_TRUE(saveDocument(p.document).ok());
    p.watch.watchProject(p.document.file(), p.document.snapshot());
    EXPECT_FALSE(p.watch.projectDiffers());
    EXPECT_THAT(p.settle(), IsEmpty());
  }
}

TEST(FileWatch, AChangeBetweenSavingAndTheFirstLookIsNoticed) {
  WatchedProject p("watch-race");
  ASSERT_TRUE(saveDocument(p.document).ok());
  write(p.file, p.otherText());
  p.watch.watchProject(p.document.file(), p.document.snapshot());
  EXPECT_THAT(p.settle(), ElementsAre(FileEvent{p.file, What::Changed, true}));
}

TEST(FileWatch, AnUnreadableOrLostProjectIsNoticedAndItsReturnToo) {
  WatchedProject p("watch-lost");
  const std::string text = base::readTextFile(p.file).value();
  write(p.file, "{ half");
  EXPECT_THAT(p.settle(), ElementsAre(FileEvent{p.file, What::Changed, true}));
  fs::remove(p.file);
  EXPECT_TRUE(p.watch.projectDiffers());
  EXPECT_THAT(p.settle(), ElementsAre(FileEvent{p.file, What::Removed, true}));
  write(p.file, text);
  EXPECT_THAT(p.settle(), ElementsAre(FileEvent{p.file, What::Appeared, true}));
  EXPECT_FALSE(p.watch.projectDiffers());
}

TEST(FileWatch, AReplacementThroughAMomentOfAbsenceIsOneChange) {
  WatchedProject p("watch-absence");
  fs::remove(p.file);
  EXPECT_THAT(p.tick(), IsEmpty());
  write(p.file, p.otherText());
  EXPECT_THAT(p.tick(), IsEmpty());
  EXPECT_THAT(p.tick(), ElementsAre(FileEvent{p.file, What::Changed, true}));
}

TEST(FileWatch, ADocumentWithoutAFileIsNotWatched) {
  Watching w;
  w.watch.watchProject({}, std::make_shared<const Project>());
  EXPECT_THAT(w.settle(), IsEmpty());
  EXPECT_FALSE(w.watch.projectDiffers());
}

TEST(FileWatch, AssetsAreToldByName) {
  const TemporaryFolder folder("watch-assets");
  const fs::path mesh = folder.path() / "a.gltf", buffer = folder.path() / "a.bin", missing = folder.path() / "b.png";
  write(mesh, "mesh");
  write(buffer, "buffer");
  Watching w;
  w.watch.watchAssets({mesh, buffer, missing});
  EXPECT_THAT(w.settle(), IsEmpty());
  write(buffer, "longer buffer");
  write(missing, "image");
  EXPECT_THAT(w.settle(),
              ElementsAre(FileEvent{buffer, What::Changed, false}, FileEvent{missing, What::Appeared, false}));
  fs::remove(mesh);
  EXPECT_THAT(w.settle(), ElementsAre(FileEvent{mesh, What::Removed, false}));
  EXPECT_THAT(w.settle(), IsEmpty());
}

TEST(FileWatch, AFileThatIsStillBeingWrittenWaits) {
  const TemporaryFolder folder("watch-writing");
  const fs::path file = folder.path() / "a.glb";
  write(file, "0");
  Watching w;
  w.watch.watchAssets({file});
  for (std::size_t length = 2; length < 6; ++length) {
    write(file, std::string(length, 'x'));
    EXPECT_THAT(w.tick(), IsEmpty());
  }
  EXPECT_THAT(w.tick(), ElementsAre(FileEvent{file, What::Changed, false}));
}

TEST(FileWatch, AskingForMoreAssetsForgetsNoChange) {
  const TemporaryFolder folder("watch-more");
  const fs::path a = folder.path() / "a.glb", b = folder.path() / "b.glb";
  write(a, "a");
  write(b, "b");
  Watching w;
  w.watch.watchAssets({a});
  write(a, "longer");
  w.watch.watchAssets({a, b});
  EXPECT_THAT(w.settle(), ElementsAre(FileEvent{a, What::Changed, false}));
  w.watch.watchAssets({b});
  write(a, "longer still");
  EXPECT_THAT(w.settle(), IsEmpty()) << "no longer asked for";
}

TEST(FileWatch, LooksOnceASecond) {
  const TemporaryFolder folder("watch-period");
  const fs::path file = folder.path() / "a.glb";
  write(file, "a");
  FileWatch watch;
  watch.watchAssets({file});
  FileWatch::Time now{};
  EXPECT_THAT(watch.poll(now), IsEmpty());
  write(file, "longer");
  for (int i = 1; i < 10; ++i) EXPECT_THAT(watch.poll(now + std::chrono::milliseconds(100 * i)), IsEmpty());
  EXPECT_THAT(watch.poll(now + std::chrono::milliseconds(1000)), IsEmpty());
  EXPECT_THAT(watch.poll(now + std::chrono::milliseconds(1900)), IsEmpty());
  EXPECT_EQ(watch.poll(now + std::chrono::milliseconds(2000)).size(), 1u);
}

}  // namespace
}  // namespace sward::editor
