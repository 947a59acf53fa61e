#include "widgets/curve_editor.h"
#include "widgets/harness.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace sward::editor {
namespace {

bool increasing(const CurvePoints& points) {
  for (std::size_t i = 1; i < points.size(); ++i) {
    if (!(points[i].x > points[i - 1].x)) return false;
  }
  return true;
}

TEST(CurvePoints, MoveStopsAtNeighboursAndLimits) {
  const CurveLimits limits;
  const CurvePoints points{{0.0, 0.0}, {0.4, 0.5}, {0.6, 0.5}, {1.0, 1.0}};
  const CurvePoints right = movedPoints(points, {1}, 5.0, 5.0, limits);
  EXPECT_NEAR(right[1].x, 0.6 - limits.leastGap(), 1e-12);
  EXPECT_EQ(right[1].y, 1.0);
  const CurvePoints both = movedPoints(points, {1, 2}, 5.0, 0.1, limits);
  EXPECT_NEAR(both[2].x, 1.0 - limits.leastGap(), 1e-12) << "two neighbours move past neither a third one";
  EXPECT_NEAR(both[2].x - both[1].x, 0.2, 1e-12) << "nor toward each other";
  EXPECT_EQ(movedPoints(points, {0, 1, 2, 3}, 0.3, 0.0, limits), points) << "the ends stand at the limits";
  EXPECT_EQ(movedPoints(points, {7}, 0.3, 0.3, limits), points);
}

TEST(CurvePoints, AnyMovesKeepTheOrderAndTheLimits) {
  const CurveLimits limits{-2.0, 3.0, 10.0, 20.0};
  std::mt19937 random(7);
  std::uniform_real_distribution<double> far(-8.0, 8.0);
  CurvePoints points;
  for (int i = 0; i < 9; ++i) insertPoint(points, {-2.0 + 0.6 * i, far(random) + 15.0}, limits);
  ASSERT_EQ(points.size(), 9u);
  for (int step = 0; step < 20000; ++step) {
    PointSelection selection;
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (random() % 3 == 0) selection.insert(i);
    }
    points = movedPoints(points, selection, far(random) * (step % 2 == 0 ? 1.0 : 0.01), far(random), limits);
    ASSERT_TRUE(increasing(points)) << step;
    for (const base::CurvePoint& p : points) {
      ASSERT_TRUE(p.x >= limits.xLow && p.x <= limits.xHigh && p.y >= limits.yLow && p.y <= limits.yHigh) << step;
    }
  }
}

TEST(CurvePoints, InsertHoldsAndRefuses) {
  const CurveLimits limits;
  CurvePoints points{{0.0, 0.0}, {1.0, 1.0}};
  EXPECT_EQ(insertPoint(points, {0.5, 9.0}, limits), 1u);
  EXPECT_EQ(points[1].y, 1.0);
  EXPECT_FALSE(insertPoint(points, {0.5, 0.2}, limits).has_value()) << "a point stands there";
  EXPECT_FALSE(insertPoint(points, {-3.0, 0.2}, limits).has_value()) << "held at 0, where one stands";
  CurvePoints many;
  for (int i = 0; i < 400; ++i) insertPoint(many, {i / 400.0, 0.0}, limits);
  EXPECT_EQ(many.size(), kMaxCurvePoints);
}

TEST(CurvePoints, TextGoesThereAndBack) {
  const CurvePoints points{{0.0, 0.1}, {1.0 / 3.0, -2e-7}, {12345.678, 1e30}};
  EXPECT_EQ(parsedPoints(pointsText(points)), points);
  EXPECT_EQ(parsedPoints("[[0, 0.1], [0.5, 1]]"), (CurvePoints{{0.0, 0.1}, {0.5, 1.0}}));
  EXPECT_EQ(parsedPoints("0;0.1\t0.5;1"), (CurvePoints{{0.0, 0.1}, {0.5, 1.0}}));
  for (const char* text : {"", "1", "1 2 3", "a b", "1 nan", "1 2 # note"}) EXPECT_FALSE(parsedPoints(text)) << text;
}

TEST(CurvePoints, StepsAreNiceAndTicksAreShort) {
  EXPECT_EQ(niceStep(1.0, 10.0), 0.1);
  EXPECT_EQ(niceStep(1.0, 7.0), 0.2);
  EXPECT_EQ(niceStep(37.0, 9.0), 5.0);
  EXPECT_EQ(tickText(0.30000000000000004, 0.1), "0.3");
  EXPECT_EQ(tickText(-1e-18, 0.1), "0.0");
  EXPECT_EQ(tickText(1500.0, 500.0), "1500");
  EXPECT_EQ(snappedTo(0.34, 0.1), 0.3);
  EXPECT_EQ(snappedTo(0.34, 0.0), 0.34);
}

/// A curve under edit in a window.
struct CurveBench {
  Harness ui{760, 420};
  base::Curve curve = base::Curve::fromPoints({{0.0, 0.2}, {0.5, 0.8}, {1.0, 0.1}}).value();
  base::Curve other = base::Curve::fromPoints({{0.0, 0.95}, {1.0, 0.9}}).value();
  base::Curve builtIn = base::Curve::fromPoints({{0.0, 0.5}, {1.0, 0.0}}).value();
  std::vector<CurveLayer> layers{{.name = "Width", .curve = &curve}, {.name = "Other", .curve = &other}};
  CurveAxes axes;
  std::vector<CurvePreset> presets{{"Rising", base::Curve::fromPoints({{0, 0}, {1, 1}}).value()}};
  CurveEditor editor;
  CurveEvents last;
  int changes = 0, finishes = 0;
  ImVec2 size{720, 380};

  CurveBench() {
    layers[0].builtIn = &builtIn;
    ui.show([this] {
      const CurveEvents events = editor.draw("c", layers, axes, size, presets);
      if (events.changed || events.finished) last = events;
      changes += events.changed ? 1 : 0;
      finishes += events.finished ? 1 : 0;
    });
  }
  ImVec2 point(std::size_t i) const { return ui.at("curve:c:point:" + std::to_string(i)); }
  /// Screen place of (x, y), from where the outer points stand.
  ImVec2 place(double x, double y) const {
    const ItemLog::Item plot = ui.item("curve:c:plot");
    const auto mix = [](float a, float b, double t) { return a + (b - a) * static_cast<float>(t); };
    return ImVec2(mix(plot.min.x, plot.max.x, (x + 0.05) / 1.1), mix(plot.max.y, plot.min.y, (y + 0.05) / 1.1));
  }
};

TEST(CurveEditor, PointsStandWhereTheirValuesAre) {
  CurveBench b;
  const ImVec2 expected = b.place(0.5, 0.8), shown = b.point(1);
  EXPECT_NEAR(shown.x, expected.x, 1.0);
  EXPECT_NEAR(shown.y, expected.y, 1.0);
}

TEST(CurveEditor, OneDragMovesAPointInOneStep) {
  CurveBench b;
  b.ui.drag(b.point(1), b.place(0.6, 0.4), 8);
  EXPECT_NEAR(b.curve.points()[1].x, 0.6, 0.01);
  EXPECT_NEAR(b.curve.points()[1].y, 0.4, 0.01);
  EXPECT_GT(b.changes, 3);
  EXPECT_EQ(b.finishes, 1);
  EXPECT_EQ(b.last.label, "move curve point");
  EXPECT_EQ(b.last.layer, 0u);
  EXPECT_EQ(b.editor.selection(), PointSelection{1});
}

TEST(CurveEditor, PointsNeverCross) {
  CurveBench b;
  b.ui.drag(b.point(1), ImVec2(b.place(1.0, 0.5).x + 400, b.place(1.0, 0.5).y), 8);
  EXPECT_LT(b.curve.points()[1].x, 1.0);
  EXPECT_GT(b.curve.points()[1].x, 0.98);
  EXPECT_TRUE(increasing(b.curve.points()));
  b.ui.drag(b.point(1), ImVec2(-500, -500), 8);
  EXPECT_GT(b.curve.points()[1].x, 0.0);
  EXPECT_EQ(b.curve.points()[1].y, 1.0) << "held in the range";
  EXPECT_EQ(b.curve.points().size(), 3u);
}

TEST(CurveEditor, DoubleClickAddsAndTheSamePressDrags) {
  CurveBench b;
  b.ui.doubleClickAt(b.place(0.25, 0.05));
  ASSERT_EQ(b.curve.points().size(), 4u);
  EXPECT_NEAR(b.curve.points()[1].x, 0.25, 0.01);
  EXPECT_NEAR(b.curve.points()[1].y, 0.05, 0.01);
  EXPECT_EQ(b.finishes, 1);
  EXPECT_EQ(b.last.label, "add curve point");
  b.ui.hold(true, false, false);
  b.ui.drag(b.place(0.75, 0.05), b.place(0.8, 0.3), 6);
  b.ui.hold(false, false, false);
  ASSERT_EQ(b.curve.points().size(), 5u);
  EXPECT_NEAR(b.curve.points()[3].x, 0.8, 0.01);
  EXPECT_EQ(b.finishes, 2) << "adding and placing a point is one step";
}

TEST(CurveEditor, APointAddedOnTheLineKeepsTheValueThere) {
  CurveBench b;
  const double before = b.curve(0.3);
  b.ui.doubleClickAt(b.place(0.3, before));
  ASSERT_EQ(b.curve.points().size(), 4u);
  EXPECT_NEAR(b.curve(b.curve.points()[1].x), before, 0.01);
}

TEST(CurveEditor, ClickOnEmptySpaceChangesNothing) {
  CurveBench b;
  b.ui.clickAt(b.place(0.2, 0.05));
  b.ui.clickAt(b.point(1));
  b.ui.frames(3);
  EXPECT_EQ(b.changes + b.finishes, 0);
}

TEST(CurveEditor, DeleteRemovesTheSelection) {
  CurveBench b;
  b.ui.clickAt(b.point(1));
  b.ui.key(ImGuiKey_Delete);
  EXPECT_EQ(b.curve.points().size(), 2u);
  EXPECT_EQ(b.last.label, "delete curve point");
  EXPECT_EQ(b.finishes, 1);
}

TEST(CurveEditor, SeveralPointsMoveTogether) {
  CurveBench b;
  b.ui.clickAt(b.point(0));
  b.ui.hold(false, true, false);
  b.ui.clickAt(b.point(1));
  b.ui.hold(false, false, false);
  EXPECT_EQ(b.editor.selection(), (PointSelection{0, 1}));
  const ImVec2 from = b.point(1);
  b.ui.drag(from, ImVec2(from.x, b.place(0, 0.9).y));
  EXPECT_NEAR(b.curve.points()[0].y, 0.3, 0.01);
  EXPECT_NEAR(b.curve.points()[1].y, 0.9, 0.01);
  EXPECT_EQ(b.finishes, 1);
  EXPECT_EQ(b.last.label, "move curve points");
}

TEST(CurveEditor, TheRubberBandSelects) {
  CurveBench b;
  b.ui.drag(b.place(0.3, 0.98), b.place(1.04, 0.0));
  EXPECT_EQ(b.editor.selection(), (PointSelection{1, 2}));
  b.ui.hold(false, true, false);
  b.ui.drag(b.place(0.1, 0.0), b.place(-0.04, 0.4));
  b.ui.hold(false, false, false);
  EXPECT_EQ(b.editor.selection(), (PointSelection{0, 1, 2})) << "Shift adds";
  EXPECT_EQ(b.changes, 0);
  b.ui.clickAt(b.place(0.2, 0.02));
  EXPECT_TRUE(b.editor.selection().empty());
}

TEST(CurveEditor, SnappingEndsOnTheGrid) {
  CurveBench b;
  b.axes.xSnap = 0.125;
  b.axes.ySnap = 0.25;
  b.ui.click("action:c.snap");
  ASSERT_TRUE(b.editor.snaps());
  b.ui.drag(b.point(1), b.place(0.61, 0.44));
  EXPECT_EQ(b.curve.points()[1], (base::CurvePoint{0.625, 0.5}));
  b.ui.hold(false, false, true);
  b.ui.drag(b.point(1), b.place(0.55, 0.4));
  b.ui.hold(false, false, false);
  EXPECT_NEAR(b.curve.points()[1].x, 0.55, 0.01) << "Alt does the opposite";
  EXPECT_NE(b.curve.points()[1].x, 0.5);
}

TEST(CurveEditor, ShiftKeepsADragToOneAxis) {
  CurveBench b;
  b.ui.clickAt(b.point(1));
  b.ui.pause();
  b.ui.moveTo(b.point(1));
  b.ui.press();
  b.ui.hold(false, true, false);
  b.ui.moveTo(b.place(0.7, 0.7));
  b.ui.release();
  EXPECT_NEAR(b.curve.points()[1].x, 0.7, 0.01);
  EXPECT_EQ(b.curve.points()[1].y, 0.8);
}

TEST(CurveEditor, ArrowsNudgeInOneStepForEachHold) {
  CurveBench b;
  b.ui.clickAt(b.point(1));
  b.ui.key(ImGuiKey_RightArrow);
  EXPECT_NEAR(b.curve.points()[1].x, 0.51, 1e-9);
  EXPECT_EQ(b.finishes, 1);
  ImGui::GetIO().KeysDown[ImGuiKey_UpArrow] = true;
  b.ui.frames(60);
  ImGui::GetIO().KeysDown[ImGuiKey_UpArrow] = false;
  b.ui.frames(2);
  EXPECT_GT(b.curve.points()[1].y, 0.85);
  EXPECT_EQ(b.finishes, 2);
}

TEST(CurveEditor, PointsCopyAndPasteAsText) {
  CurveBench b;
  const base::Curve before = b.curve;
  b.ui.clickAt(b.place(0.2, 0.02));
  b.ui.hold(true, false, false);
  b.ui.key(ImGuiKey_C);
  EXPECT_STREQ(ImGui::GetClipboardText(), "0 0.2\n0.5 0.8\n1 0.1\n");
  ImGui::SetClipboardText("0.9 4\n0.1 0.3");
  b.ui.key(ImGuiKey_V);
  EXPECT_EQ(b.curve.points(), (CurvePoints{{0.1, 0.3}, {0.9, 1.0}})) << "sorted, held in the range";
  EXPECT_EQ(b.last.label, "paste curve");
  EXPECT_EQ(b.finishes, 1);
  ImGui::SetClipboardText("no points");
  b.ui.key(ImGuiKey_V);
  EXPECT_EQ(b.curve.points().size(), 2u);
  EXPECT_EQ(b.finishes, 1);
}

TEST(CurveEditor, NumbersOfOnePointAreTyped) {
  CurveBench b;
  b.ui.clickAt(b.point(1));
  b.ui.doubleClickAt(b.ui.at("curve:c:x"));
  b.ui.type("0.33");
  b.ui.key(ImGuiKey_Enter);
  EXPECT_EQ(b.curve.points()[1].x, 0.33);
  b.ui.doubleClickAt(b.ui.at("curve:c:y"));
  b.ui.type("7");
  b.ui.key(ImGuiKey_Enter);
  EXPECT_EQ(b.curve.points()[1].y, 1.0);
  b.ui.doubleClickAt(b.ui.at("curve:c:x"));
  b.ui.type("5");
  b.ui.key(ImGuiKey_Enter);
  EXPECT_LT(b.curve.points()[1].x, 1.0) << "typed numbers stop at the neighbour too";
  EXPECT_EQ(b.finishes, 3);
}

TEST(CurveEditor, PresetsAndResetAreOneStepEach) {
  CurveBench b;
  b.ui.click("action:c.presets");
  b.ui.frames(2);
  b.ui.click("curve:c:preset:Rising");
  EXPECT_EQ(b.curve.points(), (CurvePoints{{0, 0}, {1, 1}}));
  EXPECT_EQ(b.finishes, 1);
  b.ui.frames(2);
  b.ui.click("action:c.more");
  b.ui.frames(2);
  b.ui.click("curve:c:menu:reset");
  EXPECT_TRUE(b.curve.points().empty());
  EXPECT_EQ(b.finishes, 2);
}

TEST(CurveEditor, TheFirstPointOfABuiltInCurveKeepsItsForm) {
  CurveBench b;
  b.curve = base::Curve();
  b.ui.frames(2);
  EXPECT_FALSE(b.ui.has("curve:c:point:0"));
  b.ui.doubleClickAt(b.place(0.4, 0.9));
  ASSERT_EQ(b.curve.points().size(), 3u);
  EXPECT_EQ(b.curve.points()[0], (base::CurvePoint{0.0, 0.5}));
}

TEST(CurveEditor, ClickOnAnotherLineChoosesItUnlessLocked) {
  CurveBench b;
  b.layers[1].locked = true;
  b.ui.clickAt(b.place(0.3, b.other(0.3)));
  EXPECT_EQ(b.editor.active(), 0u);
  b.layers[1].locked = false;
  b.ui.pause();
  b.ui.clickAt(b.place(0.3, b.other(0.3)));
  EXPECT_EQ(b.editor.active(), 1u);
  b.ui.drag(b.point(0), b.place(0.0, 0.5));
  EXPECT_NEAR(b.other.points()[0].y, 0.5, 0.01);
  EXPECT_EQ(b.last.layer, 1u);
  b.ui.click("curve:c:layer:0");
  EXPECT_EQ(b.editor.active(), 0u);
}

TEST(CurveEditor, LockedCurvesAreNotEdited) {
  CurveBench b;
  b.layers[0].locked = true;
  const base::Curve before = b.curve;
  b.ui.drag(b.point(1), b.place(0.6, 0.4));
  b.ui.doubleClickAt(b.place(0.2, 0.02));
  b.ui.key(ImGuiKey_Delete);
  EXPECT_EQ(b.curve, before);
  EXPECT_EQ(b.changes, 0);
}

TEST(CurveEditor, WheelZoomsAboutTheMousePanMovesAndFFrames) {
  CurveBench b;
  const ImVec2 start = b.point(1);
  b.ui.moveTo(start);
  b.ui.wheel(3);
  b.ui.frames(2);
  EXPECT_NEAR(b.point(1).x, start.x, 1.0) << "what is under the mouse stays";
  EXPECT_NEAR(b.point(1).y, start.y, 1.0);
  EXPECT_FALSE(b.ui.item("curve:c:point:0").visible);
  b.ui.drag(start, ImVec2(start.x - 40, start.y + 30), 4, 2);
  EXPECT_NEAR(b.point(1).x, start.x - 40, 1.5);
  EXPECT_NEAR(b.point(1).y, start.y + 30, 1.5);
  EXPECT_EQ(b.changes, 0);
  b.ui.clickAt(b.point(1));
  ImGui::GetIO().KeysDown[static_cast<int>('F')] = true;
  b.ui.frames(1);
  ImGui::GetIO().KeysDown[static_cast<int>('F')] = false;
  b.ui.frames(2);
  EXPECT_NEAR(b.point(1).x, start.x, 1.0);
  EXPECT_NEAR(b.point(1).y, start.y, 1.0);
}

TEST(CurveEditor, ContextMenuWorksInASmallPlotToo) {
  CurveBench b;
  b.size = ImVec2(300, 120);
  b.ui.frames(2);
  EXPECT_FALSE(b.ui.has("action:c.snap"));
  b.ui.clickAt(b.point(1), 1);
  b.ui.frames(2);
  ASSERT_TRUE(b.ui.has("curve:c:menu:delete"));
  ASSERT_TRUE(b.ui.has("curve:c:x")) << "numbers of the point under the mouse";
  b.ui.click("curve:c:menu:delete");
  EXPECT_EQ(b.curve.points().size(), 2u);
}

TEST(CurveEditor, SurvivesAnySizeAndAShorterCurve) {
  CurveBench b;
  b.ui.hold(true, false, false);
  b.ui.clickAt(b.place(0.2, 0.02));
  b.ui.hold(false, false, false);
  for (const ImVec2 size : {ImVec2(1, 1), ImVec2(40, 30), ImVec2(2000, 15), ImVec2(30, 900), ImVec2(720, 380)}) {
    b.size = size;
    b.ui.frames(2);
  }
  b.ui.clickAt(b.point(2));
  b.curve = base::Curve::constant(0.5);
  b.ui.frames(2);
  EXPECT_TRUE(b.editor.selection().empty());
  b.layers.clear();
  b.ui.frames(2);
  b.ui.doubleClickAt(ImVec2(300, 200));
  EXPECT_EQ(b.changes, 1);
}

}  // namespace
}  // namespace sward::editor
