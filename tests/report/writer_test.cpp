#include "report/writer.h"

#include "bake/temporary_folder.h"
#include "base/file.h"
#include "image/io.h"
#include "report/example.h"

#include <csignal>
#include <cstdlib>
#include <fstream>
#include <set>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

namespace sward::report {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

const std::vector<std::string> kExampleFiles{"files.txt",
                                             "pictures/fit_difference.png",
                                             "pictures/fit_lpt8.exr",
                                             "pictures/fit_lpt8.png",
                                             "pictures/fit_reference.exr",
                                             "pictures/fit_reference.png",
                                             "plots/fit_bytes.svg",
                                             "plots/fit_elevation.svg",
                                             "plots/fit_time.svg",
                                             "report.html",
                                             "report.json",
                                             "tables/lpt_fit_lights.csv",
                                             "tables/lpt_fit_truth_0.npy"};

/// Every file below a folder, hidden ones too, sorted.
std::vector<std::string> filesBelow(const fs::path& folder) {
  std::set<std::string> files;
  if (!fs::exists(folder)) return {};
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (!entry.is_directory()) files.insert(fs::relative(entry.path(), folder).string());
  }
  return {files.begin(), files.end()};
}
std::vector<std::string> entriesOf(const fs::path& folder) {
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) names.insert(entry.path().filename().string());
  return {names.begin(), names.end()};
}
std::string contents(const fs::path& file) {
  const auto text = base::readTextFile(file);
  return text.ok() ? *text : std::string();
}

class Writer : public testing::Test {
 protected:
  Writer() : m_folder("report") {}
  fs::path root() const { return m_folder.path(); }
  fs::path folder() const { return root() / "r"; }
  Result<WrittenReport> write(const std::vector<Section>& sections, const JobContext& job = {}) const {
    SWARD_ASSIGN(StagedReport staged, StagedReport::stage(folder(), test::exampleHead(), sections, job));
    return staged.commit();
  }

 private:
  sward::test::TemporaryFolder m_folder;
};

TEST_F(Writer, WritesAWholeReport) {
  const auto written = write(test::exampleSections());
  ASSERT_TRUE(written.ok()) << written.error().text();
  EXPECT_EQ(filesBelow(folder()), kExampleFiles);
  EXPECT_EQ(written->files, kExampleFiles.size());
  EXPECT_EQ(written->page, folder() / "report.html");
  const auto linear = image::readImage(folder() / "pictures" / "fit_reference.exr");
  ASSERT_TRUE(linear.ok());
  const float truth = test::exampleSections()[1].strips[0].pictures[1].linear.at(100, 50, 1);
  EXPECT_NEAR(linear->at(100, 50, 1), truth, truth * 0x1p-11f) << "a half float's rounding";
  EXPECT_EQ(image::readImage(folder() / "pictures" / "fit_reference.png")->width, 750);
  // 750 pixels are more than a page embeds: every second.
  EXPECT_LT(contents(folder() / "report.html").size(), fs::file_size(folder() / "pictures" / "fit_reference.png") * 4);
  // To look at the page: SWARD_TEST_REPORT=DIR test_report --gtest_filter=Writer.WritesAWholeReport
  if (const char* keep = std::getenv("SWARD_TEST_REPORT")) {
    fs::copy(folder(), keep, fs::copy_options::recursive | fs::copy_options::overwrite_existing);
  }
}

TEST_F(Writer, NothingIsSeenBeforeItIsAllThere) {
  {
    auto staged = StagedReport::stage(folder(), test::exampleHead(), test::exampleSections());
    ASSERT_TRUE(staged.ok());
    for (const std::string& name : entriesOf(folder())) EXPECT_EQ(name.front(), '.') << name;
  }
  EXPECT_THAT(entriesOf(root()), IsEmpty()) << "nothing stays of a report that was not committed, its folder neither";
}

TEST_F(Writer, RemovesWhatKilledProcessesLeft) {
  const pid_t gone = ::fork();
  if (gone == 0) ::_exit(0);
  ASSERT_GT(gone, 0);
  ASSERT_EQ(::waitpid(gone, nullptr, 0), gone);
  const std::string forsaken = ".writing-" + std::to_string(gone), alive = ".writing-" + std::to_string(::getppid());
  for (const std::string& name : {forsaken, alive, std::string(".writing-mine")}) {
    fs::create_directories(folder() / name / "pictures");
  }
  ASSERT_TRUE(write({}).ok());
  const auto left = entriesOf(folder());
  EXPECT_THAT(left, testing::Not(testing::Contains(forsaken)));
  EXPECT_THAT(left, testing::Contains(alive)) << "another report may be on its way";
  EXPECT_THAT(left, testing::Contains(".writing-mine"));
}

TEST_F(Writer, TakesThePlaceOfTheReportBefore) {
  ASSERT_TRUE(write(test::exampleSections()).ok());
  std::ofstream(folder() / "mine.txt") << "mine";
  std::ofstream(folder() / "plots" / "mine.svg") << "mine";
  std::ofstream(folder() / "report.json") << "old";
  auto sections = test::exampleSections();
  sections.resize(1);
  ASSERT_TRUE(write(sections).ok());
  EXPECT_THAT(filesBelow(folder()),
              ElementsAre("files.txt", "mine.txt", "plots/mine.svg", "report.html", "report.json"));
  EXPECT_THAT(entriesOf(folder()), testing::Not(testing::Contains("pictures"))) << "it is empty";
  EXPECT_THAT(contents(folder() / "report.json"), HasSubstr("layer_sampling"));
}

TEST_F(Writer, AListingNamesNoFilesOfOthers) {
  fs::create_directories(folder());
  std::ofstream(root() / "precious.png") << "x";
  std::ofstream(folder() / "photo.png") << "x";
  std::ofstream(folder() / "files.txt")
      << "../precious.png\nphoto.png\npictures/../photo.png\n/etc/passwd\nreport.html\n";
  ASSERT_TRUE(write({}).ok());
  EXPECT_TRUE(fs::exists(root() / "precious.png"));
  EXPECT_TRUE(fs::exists(folder() / "photo.png"));
  EXPECT_TRUE(fs::exists(folder() / "report.html"));
}

TEST_F(Writer, CancelledItLeavesTheOldReport) {
  ASSERT_TRUE(write(test::exampleSections()).ok());
  std::ofstream(folder() / "report.json") << "old";
  std::stop_source stop;
  stop.request_stop();
  const auto cancelled = write(test::exampleSections(), {stop.get_token(), {}, 0});
  ASSERT_FALSE(cancelled.ok());
  EXPECT_EQ(cancelled.error().kind, ErrorKind::Cancelled);
  EXPECT_EQ(contents(folder() / "report.json"), "old");
  EXPECT_EQ(filesBelow(folder()), kExampleFiles);
}

TEST_F(Writer, AFolderInTheWayChangesNothing) {
  ASSERT_TRUE(write(test::exampleSections()).ok());
  std::ofstream(folder() / "report.json") << "old";
  fs::remove(folder() / "report.html");
  fs::create_directories(folder() / "report.html" / "x");
  const auto failed = write(test::exampleSections());
  ASSERT_FALSE(failed.ok());
  EXPECT_EQ(failed.error().kind, ErrorKind::BadInput);
  EXPECT_THAT(failed.error().where, HasSubstr("report.html"));
  EXPECT_EQ(contents(folder() / "report.json"), "old");
}

TEST_F(Writer, AFileInThePlaceOfAFolder) {
  fs::create_directories(folder());
  std::ofstream(folder() / "pictures") << "x";
  const auto failed = write(test::exampleSections());
  ASSERT_FALSE(failed.ok());
  EXPECT_THAT(failed.error().text(), HasSubstr("pictures: this is not a folder"));
  EXPECT_THAT(entriesOf(folder()), ElementsAre("pictures"));
  std::ofstream(root() / "file") << "x";
  for (const fs::path& place : {root() / "file", root() / "file" / "below"}) {
    const auto folderCheck = checkReportFolder(place);
    ASSERT_FALSE(folderCheck.ok());
    EXPECT_EQ(folderCheck.error().kind, ErrorKind::BadInput);
    EXPECT_EQ(folderCheck.error().where, (root() / "file").string());
  }
}

/// Runs as somebody who may not write everywhere, where the tests run as root. The real user too: access(2) asks for
/// it.
class AsNobody {
 public:
  AsNobody() : m_root(::geteuid() == 0) {
    if (m_root && ::setresuid(65534, 65534, 0) != 0) m_root = false;
  }
  ~AsNobody() {
    if (m_root && ::setresuid(0, 0, 0) != 0) std::abort();
  }
  AsNobody(const AsNobody&) = delete;
  AsNobody& operator=(const AsNobody&) = delete;

 private:
  bool m_root;
};

TEST_F(Writer, AReadOnlyFolderIsSaidAndLeftAlone) {
  fs::create_directories(folder());
  ::chmod(folder().c_str(), 0555);
  ::chmod(root().c_str(), 0555);
  {
    const AsNobody nobody;
    for (const fs::path& place : {folder(), folder() / "deeper" / "still"}) {
      const auto checked = checkReportFolder(place);
      ASSERT_FALSE(checked.ok()) << place;
      EXPECT_EQ(checked.error().kind, ErrorKind::Failed);
      EXPECT_THAT(checked.error().text(), testing::AllOf(HasSubstr("Permission denied"), HasSubstr(folder().string())));
    }
    EXPECT_FALSE(write(test::exampleSections()).ok());
  }
  EXPECT_THAT(entriesOf(folder()), IsEmpty());
  ::chmod(root().c_str(), 0755);
  ::chmod(folder().c_str(), 0755);
}

TEST_F(Writer, AWriteProtectedFileIsNotReplaced) {
  ASSERT_TRUE(write(test::exampleSections()).ok());
  ::chmod(root().c_str(), 0777);
  for (const char* name : {"", "plots", "pictures", "tables"}) ::chmod((folder() / name).c_str(), 0777);
  for (const std::string& name : kExampleFiles) ::chmod((folder() / name).c_str(), 0666);
  std::ofstream(folder() / "report.json") << "old";
  ::chmod((folder() / "report.json").c_str(), 0444);
  {
    const AsNobody nobody;
    const auto failed = write(test::exampleSections());
    ASSERT_FALSE(failed.ok());
    EXPECT_THAT(failed.error().text(), HasSubstr("report.json: the file is write-protected"));
  }
  EXPECT_EQ(contents(folder() / "report.json"), "old");
  EXPECT_EQ(filesBelow(folder()), kExampleFiles);
}

TEST_F(Writer, AFullDiskLeavesNothing) {
  // A limit on the size of files stands for the full disk: EFBIG instead of ENOSPC, at the same calls.
  struct rlimit before {};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto ignored = ::signal(SIGXFSZ, SIG_IGN);
  struct rlimit small = before;
  small.rlim_cur = 4096;
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
  const auto failed = write(test::exampleSections());
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &before), 0);
  ::signal(SIGXFSZ, ignored);
  ASSERT_FALSE(failed.ok());
  EXPECT_EQ(failed.error().kind, ErrorKind::Failed);
  EXPECT_THAT(failed.error().text(), HasSubstr("Free some space"));
  EXPECT_THAT(entriesOf(root()), IsEmpty());
}

TEST_F(Writer, NamesThatAreNoFilesAreRefused) {
  for (const char* name : {"", "../up", "a/b", "a b", "Gräser", "</script>", "a.png"}) {
    auto sections = test::exampleSections();
    sections[1].strips[0].pictures[0].name = name;
    EXPECT_FALSE(write(sections).ok()) << name;
    EXPECT_EQ(fileNameFrom(name).find_first_of("/. <"), std::string::npos);
    EXPECT_FALSE(fileNameFrom(name).empty());
  }
  auto sections = test::exampleSections();
  sections[1].plots[1].name = sections[1].plots[0].name;
  const auto twice = write(sections);
  ASSERT_FALSE(twice.ok());
  EXPECT_THAT(twice.error().text(), HasSubstr("two have the name \"fit_time\""));
  EXPECT_THAT(entriesOf(root()), IsEmpty());
}

TEST_F(Writer, HostileTextsAndFolderNames) {
  const fs::path place = root() / "Gräser & \"more\" <b>" / "r";
  auto staged = StagedReport::stage(place, test::exampleHead(), test::hostileSections());
  ASSERT_TRUE(staged.ok()) << staged.error().text();
  ASSERT_TRUE(staged->commit().ok());
  EXPECT_EQ(filesBelow(place), kExampleFiles);
}

TEST_F(Writer, TheSameBytesOnAnyNumberOfThreads) {
  ASSERT_TRUE(write(test::exampleSections(), {{}, {}, 1}).ok());
  const std::string page = contents(folder() / "report.html");
  ASSERT_TRUE(write(test::exampleSections(), {{}, {}, 4}).ok());
  EXPECT_EQ(page, contents(folder() / "report.html"));
}

}  // namespace
}  // namespace sward::report
