#include "report/choice.h"

#include "bake/small_project.h"
#include "bake/temporary_folder.h"

#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace sward::report {
namespace {

/// Two layers of 16 x 16 up to 8 of 64 x 64, seen from above.
project::Project boundedProject(ErrorBound metric, double bound) {
  project::Project project = bake::test::smallProject();
  project.lights = {};
  project.lights.count = 10;
  project.accuracy = {metric, bound};
  project.render.samples = 4;
  scene::View view;
  view.name = "near";
  view.position = {0.0, -0.9, 0.8};
  view.target = {0.0, 0.0, 0.1};
  project.views = {view};
  return project;
}

class Choosing : public testing::Test {
 protected:
  Choosing() : m_context(gpu::Context::create(gpu::Device::OsMesa).value()), m_folder("choice") {}
  Choice choose(const project::Project& project) {
    const auto choice = chooseCheapest({project, project.views, *m_context, m_folder.path(), {64, 36, 8}}, {});
    EXPECT_TRUE(choice.ok()) << (choice.ok() ? "" : choice.error().text());
    return choice.ok() ? *choice : Choice{};
  }
  std::unique_ptr<gpu::Context> m_context;
  sward::test::TemporaryFolder m_folder;
};

TEST_F(Choosing, ALooseBoundTakesTheCheapestAndStopsThere) {
  const Choice choice = choose(boundedProject(ErrorBound::Rmse, 0.9));
  EXPECT_TRUE(choice.met);
  EXPECT_EQ(choice.trials.size(), 2u) << "a floor and one fit";
  EXPECT_TRUE(choice.trials.front().floor);
  EXPECT_EQ(choice.chosen.method.name, "constant");
  EXPECT_EQ(choice.chosen, choice.trials.back().candidate);
  EXPECT_GT(choice.noise, 0.0);
}

TEST_F(Choosing, NothingKeepsAnImpossibleBoundAndNoFitIsTriedInVain) {
  const project::Project project = boundedProject(ErrorBound::Rmse, 1e-6);
  const Choice choice = choose(project);
  EXPECT_FALSE(choice.met);
  EXPECT_TRUE(std::all_of(choice.trials.begin(), choice.trials.end(), [](const Trial& t) { return t.floor; }));
  EXPECT_THAT(choiceText(choice), testing::HasSubstr("nothing measured keeps rmse"));
  project::Project applied = project;
  applyCandidate(choice.chosen, applied);
  EXPECT_TRUE(project::requireValid(applied).ok());
}

TEST_F(Choosing, WhatIsChosenKeepsTheBoundAndCheaperOnesDoNot) {
  // Just under what the cheapest layers allow: finer ones, or none, must be chosen.
  const Choice loose = choose(boundedProject(ErrorBound::Rmse, 0.9));
  const double bound = 0.93 * std::min(loose.trials.front().value, loose.trials.back().value);
  const Choice choice = choose(boundedProject(ErrorBound::Rmse, bound));
  for (const Trial& trial : choice.trials) {
    EXPECT_EQ(trial.meets, trial.value <= bound);
    const bool last = &trial == &choice.trials.back();
    if (!trial.floor) {
      EXPECT_EQ(trial.meets, choice.met && last) << "it stops at the first that keeps the bound";
    }
  }
  EXPECT_GT(choice.trials.size(), 2u);
}

TEST_F(Choosing, TheSameQuestionIsAnsweredFromTheCache) {
  const project::Project project = boundedProject(ErrorBound::Flip, 0.9);
  const Choice first = choose(project);
  const Choice again = choose(project);
  ASSERT_EQ(first.trials.size(), again.trials.size());
  EXPECT_EQ(first.chosen, again.chosen);
  // Timings never come out the same twice when they are measured.
  EXPECT_EQ(first.trials.back().drawMs, again.trials.back().drawMs);
}

TEST_F(Choosing, CancellingEndsIt) {
  std::stop_source stop;
  stop.request_stop();
  const project::Project project = boundedProject(ErrorBound::Rmse, 0.5);
  const auto choice = chooseCheapest({project, project.views, *m_context, {}, {}}, {stop.get_token(), {}, 0});
  ASSERT_FALSE(choice.ok());
  EXPECT_EQ(choice.error().kind, ErrorKind::Cancelled);
  EXPECT_FALSE(chooseCheapest({project, {}, *m_context, {}, {}}, {}).ok()) << "no view";
}

TEST(ParseAccuracy, ReadsAMetricAndABound) {
  const auto accuracy = parseAccuracy("rmse=0.02");
  ASSERT_TRUE(accuracy.ok());
  EXPECT_EQ(accuracy->metric, ErrorBound::Rmse);
  EXPECT_EQ(accuracy->bound, 0.02);
  EXPECT_EQ(parseAccuracy("psnr=30")->metric, ErrorBound::Psnr);
  for (const char* wrong :
       {"", "rmse", "rmse=", "rmse=x", "rmse=-1", "rmse=nan", "rmse=1e999", "mse=1", "=0.1", "none=0.1", "rmse=0.1x"}) {
    EXPECT_FALSE(parseAccuracy(wrong).ok()) << wrong;
  }
}

}  // namespace
}  // namespace sward::report
