#include "document/autosave.h"

#include "base/file.h"
#include "document/document_io.h"
#include "document/recovery_file.h"
#include "document/user_folders.h"

#include "bake/temporary_folder.h"

#include <csignal>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

namespace sward::editor {
namespace {

namespace fs = std::filesystem;
using project::Project;
using project::toJson;
using test::TemporaryFolder;
using testing::HasSubstr;
using testing::IsEmpty;
using namespace std::chrono_literals;

constexpr double kInterval = 10.0;

void setSide(Document& document, double sideM) {
  document.edit("patch size", [&](Project& p) { p.patch.sideM = sideM; });
}

Document unsaved(double sideM = 2.25) {
  Document document = newDocument("meadow").value();
  setSide(document, sideM);
  return document;
}

std::vector<std::string> listing(const fs::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) names.push_back(entry.path().filename().string());
  return names;
}

/// Leaves one autosave of `document` in the folder, as a crash would.
fs::path crashWith(const Document& document, const fs::path& folder) {
  Autosave autosave(folder);
  EXPECT_TRUE(autosave.write(document).ok());
  return autosave.file();
}

TEST(Autosave, WritesAtMostOnceAnIntervalAndOnlyWhatIsNew) {
  const TemporaryFolder folder("autosave-interval");
  Document document = newDocument("meadow").value();
  Autosave autosave(folder.path());
  Autosave::Time now{};
  EXPECT_FALSE(*autosave.update(document, now, kInterval)) << "nothing to lose";
  EXPECT_THAT(listing(folder.path()), IsEmpty());
  setSide(document, 2.0);
  EXPECT_TRUE(*autosave.update(document, now, kInterval)) << "the first change is kept at once";
  setSide(document, 3.0);
  EXPECT_FALSE(*autosave.update(document, now + 9s, kInterval));
  EXPECT_TRUE(*autosave.update(document, now + 10s, kInterval));
  EXPECT_FALSE(*autosave.update(document, now + 60s, kInterval)) << "the same state is kept already";
  const auto text = base::readTextFile(autosave.file());
  ASSERT_TRUE(text.ok());
  EXPECT_EQ(toJson(parseRecovery(*text, "f")->project), toJson(document.project()));
}

TEST(Autosave, GoesWhenTheDocumentIsSavedOrUndoneOrClosed) {
  const TemporaryFolder folder("autosave-clean"), projects("autosave-projects");
  Document document = unsaved();
  Autosave autosave(folder.path());
  Autosave::Time now{};
  ASSERT_TRUE(*autosave.update(document, now, kInterval));
  document.undo();
  EXPECT_FALSE(*autosave.update(document, now += 11s, kInterval));
  EXPECT_THAT(listing(folder.path()), IsEmpty());
  document.redo();
  ASSERT_TRUE(*autosave.update(document, now += 11s, kInterval));
  ASSERT_TRUE(saveDocumentAs(document, projects.path() / "a.sward").ok());
  EXPECT_FALSE(*autosave.update(document, now += 1s, kInterval));
  EXPECT_THAT(listing(folder.path()), IsEmpty());
  setSide(document, 3.0);
  ASSERT_TRUE(*autosave.update(document, now += 11s, kInterval));
  EXPECT_THAT(listing(folder.path()), testing::SizeIs(2));
  autosave.clear();
  EXPECT_THAT(listing(folder.path()), IsEmpty());
}

TEST(Autosave, MakesItsFolderForTheUserAlone) {
  const TemporaryFolder folder("autosave-folder");
  const fs::path deep = folder.path() / "state" / "sward" / "recovery";
  Autosave autosave(deep);
  ASSERT_TRUE(autosave.write(unsaved()).ok());
  EXPECT_EQ(fs::status(deep).permissions(), fs::perms::owner_all);
}

TEST(Autosave, SaysWhyItCannotWriteOnceAnInterval) {
  const TemporaryFolder folder("autosave-blocked");
  std::ofstream(folder.path() / "file") << "in the way";
  const Document document = unsaved();
  Autosave autosave(folder.path() / "file" / "recovery");
  Autosave::Time now{};
  const auto first = autosave.update(document, now, kInterval);
  ASSERT_FALSE(first.ok());
  EXPECT_THAT(first.error().remedy, HasSubstr("save by hand"));
  EXPECT_TRUE(autosave.update(document, now + 5s, kInterval).ok()) << "quiet until the next try";
  EXPECT_FALSE(autosave.update(document, now + 10s, kInterval).ok());
  EXPECT_FALSE(Autosave(fs::path()).write(document).ok());
}

TEST(Autosave, AFullDiskKeepsTheCopyBefore) {
  const TemporaryFolder folder("autosave-full");
  Document document = unsaved(2.25);
  Autosave autosave(folder.path());
  ASSERT_TRUE(autosave.write(document).ok());
  setSide(document, 2.5);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  rlimit old{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &old), 0);
  rlimit tight = old;
  tight.rlim_cur = 1000;
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &tight), 0);
  const auto result = autosave.write(document);
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &old), 0);
  std::signal(SIGXFSZ, handler);
  EXPECT_FALSE(result.ok());
  const auto text = base::readTextFile(autosave.file());
  EXPECT_DOUBLE_EQ(parseRecovery(*text, "f")->project.patch.sideM, 2.25);
}

TEST(Recovery, ACrashLeavesWhatCanBeRecovered) {
  const TemporaryFolder folder("recovery-crash"), projects("recovery-projects");
  const fs::path file = projects.path() / "field.sward";
  Document document = newDocument("meadow").value();
  ASSERT_TRUE(saveDocumentAs(document, file).ok());
  setSide(document, 2.75);
  const fs::path autosaved = crashWith(document, folder.path());

  const RecoveryList list = findRecoverable(folder.path());
  EXPECT_THAT(list.damaged, IsEmpty());
  ASSERT_EQ(list.usable.size(), 1u);
  EXPECT_EQ(list.usable[0].autosave, autosaved);
  EXPECT_EQ(list.usable[0].title, "field.sward");
  EXPECT_EQ(list.usable[0].file, file);
  EXPECT_FALSE(list.usable[0].fileIsNewer);

  Autosave next(folder.path());
  auto recovered = recover(autosaved, next);
  ASSERT_TRUE(recovered.ok()) << recovered.error().text();
  EXPECT_EQ(toJson(recovered->project()), toJson(document.project()));
  EXPECT_EQ(recovered->file(), file);
  EXPECT_EQ(recovered->project().folder, projects.path());
  EXPECT_TRUE(recovered->modified());
  EXPECT_FALSE(fs::exists(autosaved)) << "the new copy has taken its place";
  EXPECT_TRUE(fs::exists(next.file()));
  EXPECT_THAT(findRecoverable(folder.path()).usable, IsEmpty()) << "this program holds it now";
  ASSERT_TRUE(saveDocument(*recovered).ok());
  EXPECT_DOUBLE_EQ(openDocument(file)->project().patch.sideM, 2.75);
  EXPECT_FALSE(*next.update(*recovered, {}, kInterval));
  EXPECT_THAT(listing(folder.path()), IsEmpty());
}

TEST(Recovery, ACrashAfterARecoveryLosesNothing) {
  const TemporaryFolder folder("recovery-twice");
  const fs::path first = crashWith(unsaved(2.5), folder.path());
  {
    Autosave next(folder.path());
    ASSERT_TRUE(recover(first, next).ok());
  }
  const RecoveryList list = findRecoverable(folder.path());
  ASSERT_EQ(list.usable.size(), 1u);
  Autosave last(folder.path());
  EXPECT_DOUBLE_EQ(recover(list.usable[0].autosave, last)->project().patch.sideM, 2.5);
}

TEST(Recovery, AKilledProcessIsTellableFromALivingOne) {
  const TemporaryFolder folder("recovery-kill");
  int ready[2];
  ASSERT_EQ(::pipe(ready), 0);
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    Autosave autosave(folder.path());
    const char fine = autosave.write(unsaved(2.125)).ok() ? 'y' : 'n';
    const ssize_t written = ::write(ready[1], &fine, 1);
    while (written == 1) ::pause();
    ::_exit(1);
  }
  char fine = 'n';
  ASSERT_EQ(::read(ready[0], &fine, 1), 1);
  ::close(ready[0]), ::close(ready[1]);
  EXPECT_EQ(fine, 'y');
  const RecoveryList living = findRecoverable(folder.path());
  const auto files = listing(folder.path());
  const std::string name =
      *std::find_if(files.begin(), files.end(), [](const auto& n) { return fs::path(n).extension() == ".autosave"; });
  Autosave mine(folder.path());
  const auto stolen = recover(folder.path() / name, mine);
  const auto discarded = discardRecoverable(folder.path() / name);
  ::kill(child, SIGKILL);
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  EXPECT_TRUE(WIFSIGNALED(status));
  EXPECT_THAT(living.usable, IsEmpty());
  EXPECT_THAT(living.damaged, IsEmpty());
  EXPECT_FALSE(stolen.ok());
  EXPECT_FALSE(discarded.ok());
  const RecoveryList list = findRecoverable(folder.path());
  ASSERT_EQ(list.usable.size(), 1u);
  EXPECT_DOUBLE_EQ(recover(list.usable[0].autosave, mine)->project().patch.sideM, 2.125);
}

TEST(Recovery, TwoWindowsKeepTwoCopies) {
  const TemporaryFolder folder("recovery-two");
  {
    Autosave a(folder.path()), b(folder.path());
    ASSERT_TRUE(a.write(unsaved(2.0)).ok());
    ASSERT_TRUE(b.write(unsaved(3.0)).ok());
    EXPECT_NE(a.file(), b.file());
    EXPECT_THAT(findRecoverable(folder.path()).usable, IsEmpty()) << "locks tell even within one process";
  }
  EXPECT_THAT(findRecoverable(folder.path()).usable, testing::SizeIs(2));
}

TEST(Recovery, AReusedProcessNumberHidesAndDestroysNothing) {
  const TemporaryFolder folder("recovery-pid");
  // An autosave of a former process that had the number of this one.
  const fs::path old = crashWith(unsaved(2.5), folder.path());
  ASSERT_TRUE(old.filename().string().starts_with(std::to_string(::getpid())));
  for (int i = 0; i < 20; ++i) {
    const fs::path copy = folder.path() / (std::to_string(::getpid()) + "-" + std::to_string(i) + ".autosave");
    if (copy != old) fs::copy_file(old, copy);
  }
  const auto count = findRecoverable(folder.path()).usable.size();
  EXPECT_GE(count, 20u);
  Autosave autosave(folder.path());
  ASSERT_TRUE(autosave.write(unsaved(3.5)).ok());
  EXPECT_EQ(findRecoverable(folder.path()).usable.size(), count);
}

TEST(Recovery, TellsThatTheFileIsNewer) {
  const TemporaryFolder folder("recovery-newer");
  Document document = newDocument("lawn").value();
  ASSERT_TRUE(saveDocumentAs(document, folder.path() / "a.sward").ok());
  setSide(document, 2.0);
  crashWith(document, folder.path() / "recovery");
  fs::last_write_time(folder.path() / "a.sward", fs::file_time_type::clock::now() + 1h);
  ASSERT_EQ(findRecoverable(folder.path() / "recovery").usable.size(), 1u);
  EXPECT_TRUE(findRecoverable(folder.path() / "recovery").usable[0].fileIsNewer);
}

TEST(Recovery, NewestFirst) {
  const TemporaryFolder folder("recovery-order");
  RecoveryFile content;
  for (const int seconds : {200, 300, 100}) {
    content.title = std::to_string(seconds);
    content.unixSeconds = seconds;
    std::ofstream(folder.path() / (content.title + ".autosave")) << recoveryText(content).value();
  }
  std::vector<std::string> titles;
  for (const auto& entry : findRecoverable(folder.path()).usable) titles.push_back(entry.title);
  EXPECT_THAT(titles, testing::ElementsAre("300", "200", "100"));
}

TEST(Recovery, EveryTruncationIsAnErrorAndNeverAProject) {
  RecoveryFile content;
  content.title = "meadow";
  content.project = unsaved().project();
  const std::string text = recoveryText(content).value();
  ASSERT_TRUE(parseRecovery(text, "f").ok());
  for (std::size_t length = 0; length < text.size(); ++length) {
    const auto result = parseRecovery(text.substr(0, length), "f");
    ASSERT_FALSE(result.ok()) << length << " of " << text.size() << " bytes";
    ASSERT_FALSE(result.error().what.empty());
  }
  EXPECT_FALSE(parseRecovery(text + "\n", "f").ok()) << "nor is anything appended";
}

TEST(Recovery, EveryFlippedByteIsNoticed) {
  RecoveryFile content;
  content.title = "meadow";
  content.project = project::fromTemplate("empty").value();
  const std::string text = recoveryText(content).value();
  for (std::size_t i = 0; i < text.size(); ++i) {
    for (const int bit : {0, 5, 7}) {
      std::string flipped = text;
      flipped[i] = static_cast<char>(flipped[i] ^ (1 << bit));
      ASSERT_FALSE(parseRecovery(flipped, "f").ok()) << "byte " << i << ", bit " << bit;
    }
  }
}

TEST(Recovery, DamagedFilesAreReportedBesideTheUsable) {
  const TemporaryFolder folder("recovery-damaged");
  const fs::path good = crashWith(unsaved(2.5), folder.path());
  const std::string text = base::readTextFile(good).value();
  // Files of many lengths, as the disk would have them; the whole walk is made on texts above.
  for (std::size_t length = 0; length < text.size(); length += 401) {
    std::ofstream(folder.path() / ("cut" + std::to_string(length) + ".autosave")) << text.substr(0, length);
  }
  const std::size_t cuts = (text.size() + 400) / 401;
  fs::create_directory(folder.path() / "folder.autosave");
  std::ofstream(folder.path() / "notes.txt") << "not ours";
  const RecoveryList list = findRecoverable(folder.path());
  ASSERT_EQ(list.usable.size(), 1u);
  EXPECT_EQ(list.usable[0].autosave, good);
  EXPECT_EQ(list.damaged.size(), cuts + 1);
  for (const DamagedAutosave& damaged : list.damaged) EXPECT_FALSE(damaged.problem.text().empty());
  Autosave autosave(folder.path());
  EXPECT_FALSE(recover(list.damaged[0].autosave, autosave).ok());
  EXPECT_TRUE(discardRecoverable(list.damaged[0].autosave).ok());
  EXPECT_EQ(findRecoverable(folder.path()).damaged.size(), cuts);
  EXPECT_TRUE(fs::exists(folder.path() / "notes.txt"));
}

TEST(Recovery, LeftoversOfTheDeadAreRemovedAndOfTheLivingKept) {
  const TemporaryFolder folder("recovery-leftovers");
  Autosave living(folder.path());
  ASSERT_TRUE(living.write(unsaved()).ok());
  const std::string stem = living.file().stem().string();
  const fs::path living1 = folder.path() / ("." + stem + ".tmp1-1.autosave");
  const fs::path dead1 = folder.path() / ".99-1.tmp99-1.autosave";
  std::ofstream{living1} << "half";
  std::ofstream{dead1} << "half";
  std::ofstream(folder.path() / "99-1.lock");
  const RecoveryList list = findRecoverable(folder.path());
  EXPECT_THAT(list.usable, IsEmpty());
  EXPECT_THAT(list.damaged, IsEmpty());
  EXPECT_TRUE(fs::exists(living1));
  EXPECT_FALSE(fs::exists(dead1));
  EXPECT_FALSE(fs::exists(folder.path() / "99-1.lock"));
  EXPECT_THAT(findRecoverable(folder.path() / "nowhere").usable, IsEmpty());
}

TEST(Recovery, WhatCouldNotBeReadBackIsNotWritten) {
  const TemporaryFolder folder("recovery-nan");
  Document document = unsaved(2.5);
  Autosave autosave(folder.path());
  ASSERT_TRUE(autosave.write(document).ok());
  setSide(document, std::numeric_limits<double>::quiet_NaN());
  EXPECT_FALSE(autosave.write(document).ok());
  EXPECT_DOUBLE_EQ(parseRecovery(base::readTextFile(autosave.file()).value(), "f")->project.patch.sideM, 2.5);
}

/// Sets a variable of the environment for a test.
class Variable {
 public:
  Variable(const char* name, const char* value) : m_name(name) {
    if (const char* old = std::getenv(name)) m_old = old;
    value != nullptr ? ::setenv(name, value, 1) : ::unsetenv(name);
  }
  ~Variable() { m_old ? ::setenv(m_name, m_old->c_str(), 1) : ::unsetenv(m_name); }

 private:
  const char* m_name;
  std::optional<std::string> m_old;
};

TEST(UserFolders, FollowTheEnvironment) {
  const Variable home("HOME", "/home/ann"), config("XDG_CONFIG_HOME", nullptr), state("XDG_STATE_HOME", nullptr);
  EXPECT_EQ(configFolder(), "/home/ann/.config/sward");
  EXPECT_EQ(stateFolder(), "/home/ann/.local/state/sward");
  const Variable config2("XDG_CONFIG_HOME", "/etc/ann"), state2("XDG_STATE_HOME", "/var/ann");
  EXPECT_EQ(configFolder(), "/etc/ann/sward");
  EXPECT_EQ(recoveryFolder(), "/var/ann/sward/recovery");
  const Variable relative("XDG_STATE_HOME", "relative");
  EXPECT_EQ(stateFolder(), "/home/ann/.local/state/sward") << "the specification asks to ignore it";
}

}  // namespace
}  // namespace sward::editor
