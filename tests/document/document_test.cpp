#include "document/document.h"

#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace sward::editor {
namespace {

using project::Project;
using project::toJson;

Document meadow() {
  Project project = project::fromTemplate("meadow").value();
  project.folder = "/projects";
  return Document(std::move(project), "/projects/meadow.sward");
}

bool setSide(Document& document, double sideM, const std::string& key = {}) {
  return document.edit(
      "patch size", [&](Project& p) { p.patch.sideM = sideM; }, key);
}

TEST(Document, StartsUnmodifiedWithNothingToUndo) {
  const Document document = meadow();
  EXPECT_FALSE(document.modified());
  EXPECT_FALSE(document.canUndo());
  EXPECT_FALSE(document.canRedo());
  EXPECT_EQ(document.undoName(), "");
  EXPECT_EQ(document.redoName(), "");
  EXPECT_TRUE(document.stepNames().empty());
  EXPECT_EQ(document.title(), "meadow.sward");
  EXPECT_EQ(Document().title(), "Untitled");
}

TEST(Document, UndoAndRedoReturnTheVeryStates) {
  Document document = meadow();
  const Snapshot first = document.snapshot();
  ASSERT_TRUE(setSide(document, 2.0));
  const Snapshot second = document.snapshot();
  EXPECT_NE(first, second);
  EXPECT_EQ(document.undoName(), "patch size");
  document.undo();
  EXPECT_EQ(document.snapshot(), first);
  EXPECT_EQ(document.redoName(), "patch size");
  document.redo();
  EXPECT_EQ(document.snapshot(), second);
  EXPECT_DOUBLE_EQ(document.project().patch.sideM, 2.0);
  EXPECT_DOUBLE_EQ(first->patch.sideM, 1.6) << "a job's snapshot never changes";
}

TEST(Document, AChangeOfNothingIsNoStep) {
  Document document = meadow();
  const auto revision = document.revision();
  EXPECT_FALSE(setSide(document, document.project().patch.sideM));
  EXPECT_FALSE(document.canUndo());
  EXPECT_EQ(document.revision(), revision);
  ASSERT_TRUE(setSide(document, 2.0));
  document.undo();
  EXPECT_FALSE(document.edit("nothing", [](Project&) {}));
  EXPECT_TRUE(document.canRedo()) << "an edit that changed nothing takes no redo away";
}

TEST(Document, AChangeThatThrowsLeavesTheDocumentAlone) {
  Document document = meadow();
  setSide(document, 2.0, "side");
  const std::string before = toJson(document.project());
  EXPECT_THROW(document.edit("bad",
                             [](Project& p) {
                               p.name = "half";
                               throw std::runtime_error("no");
                             }),
               std::runtime_error);
  EXPECT_EQ(toJson(document.project()), before);
  EXPECT_EQ(document.position(), 1u);
}

TEST(Document, OneDragIsOneStep) {
  Document document = meadow();
  for (int i = 1; i <= 100; ++i) ASSERT_TRUE(setSide(document, 2.0 + 0.01 * i, "patch.sideM"));
  EXPECT_EQ(document.position(), 1u);
  document.closeStep();
  ASSERT_TRUE(setSide(document, 5.0, "patch.sideM"));
  EXPECT_EQ(document.position(), 2u) << "a closed step is not joined";
  document.undo();
  EXPECT_DOUBLE_EQ(document.project().patch.sideM, 3.0);
  document.undo();
  EXPECT_DOUBLE_EQ(document.project().patch.sideM, 1.6);
}

TEST(Document, AnotherKeyOrNoKeyDoesNotJoin) {
  Document document = meadow();
  setSide(document, 2.0, "a");
  setSide(document, 2.1, "b");
  setSide(document, 2.2);
  setSide(document, 2.3);
  setSide(document, 2.4, "b");
  EXPECT_EQ(document.position(), 5u);
}

TEST(Document, ADragBackToItsStartIsDropped) {
  Document document = meadow();
  setSide(document, 2.0);
  const Snapshot before = document.snapshot();
  setSide(document, 3.0, "drag");
  setSide(document, 2.0, "drag");
  EXPECT_TRUE(document.modified());
  document.closeStep();
  EXPECT_EQ(document.position(), 1u);
  EXPECT_EQ(document.snapshot(), before);
  EXPECT_FALSE(document.canRedo());
  document.closeStep();
  EXPECT_EQ(document.position(), 1u) << "closing twice drops nothing more";
}

TEST(Document, UndoClosesTheOpenStep) {
  Document document = meadow();
  setSide(document, 2.0, "drag");
  document.undo();
  EXPECT_DOUBLE_EQ(document.project().patch.sideM, 1.6);
  setSide(document, 2.5, "drag");
  EXPECT_EQ(document.stepNames().size(), 1u);
  document.undo();
  EXPECT_DOUBLE_EQ(document.project().patch.sideM, 1.6) << "the later drag did not join the undone one";
}

TEST(Document, UndoDuringADragThatCameBackTakesTheStepBefore) {
  Document document = meadow();
  setSide(document, 2.0);
  setSide(document, 3.0, "drag");
  setSide(document, 2.0, "drag");
  document.undo();
  EXPECT_DOUBLE_EQ(document.project().patch.sideM, 1.6);
  EXPECT_EQ(document.redoName(), "patch size");
}

TEST(Document, AnEditAfterUndoClearsRedoBeforeItMerges) {
  Document document = meadow();
  setSide(document, 2.0, "drag");
  document.closeStep();
  setSide(document, 3.0);
  document.undo();
  setSide(document, 4.0, "drag");
  setSide(document, 4.5, "drag");
  EXPECT_FALSE(document.canRedo());
  EXPECT_EQ(document.position(), 2u);
  document.undo();
  EXPECT_DOUBLE_EQ(document.project().patch.sideM, 2.0);
}

TEST(Document, ModifiedFollowsTheSavedPosition) {
  Document document = meadow();
  setSide(document, 2.0);
  EXPECT_TRUE(document.modified());
  document.markSaved("/projects/meadow.sward");
  EXPECT_FALSE(document.modified());
  document.undo();
  EXPECT_TRUE(document.modified()) << "undone past the saved state";
  document.redo();
  EXPECT_FALSE(document.modified());
  document.undo();
  setSide(document, 2.0);
  EXPECT_TRUE(document.modified()) << "the saved state's branch is gone; its twin cannot be told";
  document.undo();
  EXPECT_TRUE(document.modified());
}

TEST(Document, SavingInADragClosesTheStep) {
  Document document = meadow();
  setSide(document, 2.0, "drag");
  document.markSaved("/projects/meadow.sward");
  setSide(document, 3.0, "drag");
  EXPECT_TRUE(document.modified());
  document.undo();
  EXPECT_FALSE(document.modified());
  EXPECT_DOUBLE_EQ(document.project().patch.sideM, 2.0) << "what was saved is still a state of the history";
}

TEST(Document, ARecoveredDocumentIsModifiedUntilSaved) {
  Document document = meadow();
  document.markUnsaved();
  EXPECT_TRUE(document.modified());
  setSide(document, 2.0);
  document.undo();
  EXPECT_TRUE(document.modified());
  document.markSaved("/projects/meadow.sward");
  EXPECT_FALSE(document.modified());
}

TEST(Document, RevisionsNeverRepeat) {
  std::set<std::uint64_t> seen;
  std::vector<std::uint64_t> all;
  for (int i = 0; i < 3; ++i) {
    Document document = meadow();
    const auto note = [&] {
      seen.insert(document.revision());
      all.push_back(document.revision());
    };
    note();
    setSide(document, 2.0, "drag"), note();
    setSide(document, 3.0, "drag"), note();
    document.undo(), note();
    document.redo(), note();
    document.goTo(0), note();
  }
  EXPECT_EQ(seen.size(), all.size());
}

TEST(Document, RevisionStaysWhereNothingChanges) {
  Document document = meadow();
  const auto revision = document.revision();
  document.undo();
  document.redo();
  document.goTo(7);
  document.closeStep();
  document.markSaved("/projects/meadow.sward");
  document.markSaved("/elsewhere/meadow.sward");
  EXPECT_EQ(document.revision(), revision) << "no asset path, so nothing to rewrite";
}

TEST(Document, GoToWalksTheHistory) {
  Document document = meadow();
  for (int i = 0; i < 5; ++i) setSide(document, 2.0 + i);
  document.goTo(2);
  EXPECT_DOUBLE_EQ(document.project().patch.sideM, 3.0);
  EXPECT_EQ(document.stepNames().size(), 5u);
  document.goTo(99);
  EXPECT_DOUBLE_EQ(document.project().patch.sideM, 6.0);
}

TEST(Document, SavingElsewhereMovesTheWholeHistory) {
  Project project = project::fromTemplate("lawn").value();
  project.folder = "/projects/lawn";
  project.patch.soil.texture = "textures/soil.png";
  Document document(project, "/projects/lawn/lawn.sward");
  document.edit("soil", [](Project& p) { p.patch.soil.texture = "/library/soil.png"; });
  document.edit("soil", [](Project& p) { p.patch.soil.texture = "other.png"; });
  const auto revision = document.revision();
  document.markSaved("/projects/copies/lawn.sward");
  EXPECT_NE(document.revision(), revision);
  EXPECT_EQ(document.project().patch.soil.texture, "../lawn/other.png");
  document.undo();
  EXPECT_EQ(document.project().patch.soil.texture, "/library/soil.png") << "absolute by someone's choice";
  document.undo();
  EXPECT_EQ(document.project().patch.soil.texture, "../lawn/textures/soil.png");
  EXPECT_EQ(document.project().folder, "/projects/copies");
}

}  // namespace
}  // namespace sward::editor
