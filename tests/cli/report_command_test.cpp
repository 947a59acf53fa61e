#include "cli/run_program.h"

#include "base/file.h"

#include "bake/small_project.h"
#include "bake/temporary_folder.h"
#include "report/recompute.h"

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
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// A folder with a small project `p.sward` in it.
class ReportCommand : public testing::Test {
 protected:
  ReportCommand() : m_folder("report-command") {
    fs::create_directories(work());
    EXPECT_TRUE(project::save(bake::test::smallProject(), work() / "p.sward").ok());
  }
  fs::path work() const { return m_folder.path() / "work"; }
  test::Outcome run(std::vector<std::string> arguments, double interruptAfter = -1.0) const {
    arguments.insert(arguments.end(), {"--cache", (m_folder.path() / "cache").string()});
    return test::runProgram(work(), arguments, interruptAfter);
  }
  std::string contents(const fs::path& path) const {
    const auto text = base::readTextFile(work() / path);
    EXPECT_TRUE(text.ok()) << path;
    return text.ok() ? *text : std::string();
  }

 private:
  test::TemporaryFolder m_folder;
};

TEST_F(ReportCommand, MeasuresTheLayersOfAProjectThatIsDrawnAsTexels) {
  const test::Outcome outcome =
      run({"report", "p.sward", "-o", "r", "--quick", "--section", "tiles", "--set", "render.method=texels"});
  ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("its layers are measured"));
  EXPECT_FALSE(Json::parse(contents("r/report.json"))["sections"]["tiles"]["rows"].empty());
}

TEST_F(ReportCommand, WritesAPageWhoseFiguresFollowFromItsFiles) {
  const test::Outcome outcome = run({"report", "p.sward", "-o", "r", "--quick", "--json"});
  ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
  EXPECT_THAT(outcome.err,
              AllOf(HasSubstr("layer_sampling: "), HasSubstr("edit_stall: "), HasSubstr("seconds: speed "),
                    HasSubstr("in all "), HasSubstr("wrote r/report.html"), HasSubstr("storage (lpt, bits 8, ")));
  EXPECT_THAT(test::listing(work() / "r"), testing::IsSupersetOf({"files.txt", "report.html", "report.json"}));
  const Json report = Json::parse(contents("r/report.json"));
  EXPECT_EQ(report, Json::parse(outcome.out));
  EXPECT_GT(report["sections"]["speed"]["rows"].size(), 20u);
  const std::string page = contents("r/report.html");
  EXPECT_THAT(page, AllOf(HasSubstr("sward report p.sward <span class=\"word\">-o</span> r"),
                          HasSubstr("layer_sampling"), testing::EndsWith("</html>\n")));
  for (const auto& [section, rows] : report["sections"].items()) {
    EXPECT_THAT(page, HasSubstr("<section class=\"chapter\" id=\"" + section + "\">"));
  }
  const auto [code, said] = report::test::recompute(work() / "r");
  EXPECT_EQ(code, 0) << said;
}

TEST_F(ReportCommand, MeasuresTheSectionsThatAreNamed) {
  const test::Outcome outcome = run({"report", "p.sward", "-o", "r", "--quick", "--section", "speed,speeed"});
  EXPECT_EQ(outcome.exitCode, 2);
  EXPECT_THAT(outcome.err, HasSubstr("there is no section \"speeed\". Did you mean \"speed\"? Sections: speed"));
  EXPECT_THAT(test::listing(work()), ElementsAre("p.sward"));
}

TEST_F(ReportCommand, CtrlCLeavesNothingHalfWritten) {
  for (const double after : {0.3, 1.5}) {
    const test::Outcome outcome = run({"report", "p.sward", "-o", "r"}, after);
    EXPECT_EQ(outcome.exitCode, 130) << outcome.err;
    // All cores for a second.
    EXPECT_LT(outcome.processorSeconds, std::max(std::thread::hardware_concurrency(), 1U));
    EXPECT_THAT(test::listing(work()), ElementsAre("p.sward"));
  }
}

TEST_F(ReportCommand, WrongFoldersAreFoundBeforeAnythingIsMeasured) {
  std::ofstream(work() / "file") << "x";
  const test::Outcome outcome = run({"report", "p.sward", "-o", "file/below"});
  EXPECT_EQ(outcome.exitCode, 2);
  // Sampling the light alone takes more.
  EXPECT_LT(outcome.processorSeconds, 5.0);
  EXPECT_THAT(outcome.err, HasSubstr("file: this is not a folder"));
  EXPECT_THAT(outcome.out, IsEmpty());
}

TEST_F(ReportCommand, HelpListsTheSections) {
  const test::Outcome outcome = run({"report", "--help"});
  EXPECT_EQ(outcome.exitCode, 0);
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("Sections:\n  speed"), HasSubstr("report.html"), HasSubstr("Examples:")));
}

}  // namespace
}  // namespace sward
