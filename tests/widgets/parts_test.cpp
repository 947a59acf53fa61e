#include "widgets/harness.h"
#include "widgets/icons.h"
#include "widgets/parts.h"
#include "widgets/text.h"
#include "widgets/toasts.h"
#include "widgets/units.h"

#include "image/colour.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace sward::editor {
namespace {

TEST(Units, FieldsKeepAUnitThatSuitsTheirDefault) {
  EXPECT_EQ(displayUnit("m", 0.4).suffix, "cm");
  EXPECT_EQ(displayUnit("m", 0.005).suffix, "mm");
  EXPECT_EQ(displayUnit("m", 1.2).suffix, "m");
  EXPECT_EQ(displayUnit("m", 0.0).suffix, "m");
  EXPECT_EQ(displayUnit("plants/m2", 400).suffix, "plants/m\u00B2");
  EXPECT_EQ(shownValue(0.4, displayUnit("m", 0.4)), "40 cm");
  EXPECT_EQ(shownValue(50, displayUnit("degrees", 50)), "50\u00B0");
  EXPECT_EQ(shownValue(0.153, displayUnit("", 0.2, true)), "15.3 %");
}

TEST(Units, NumbersAreShort) {
  const DisplayUnit plain;
  EXPECT_EQ(shownNumber(0.1 + 0.2, plain), "0.3");
  EXPECT_EQ(shownNumber(1234.5678, plain), "1235");
  EXPECT_EQ(shownNumber(-0.0000001, plain), "0");
  EXPECT_EQ(shownNumber(100000, plain), "100000");
  EXPECT_EQ(shownNumber(std::numeric_limits<double>::infinity(), plain), "inf");
  EXPECT_EQ(shownNumber(1e300, plain), "1e+300");
  EXPECT_EQ(cleaned(41.2 / 100), 0.412);
}

TEST(Units, TypedUnitsConvertWhenTheyFit) {
  const DisplayUnit cm = displayUnit("m", 0.4);
  EXPECT_EQ(parsedValue("12", "m", cm), 0.12);
  EXPECT_EQ(parsedValue(" 12 cm ", "m", cm), 0.12);
  EXPECT_EQ(parsedValue("5in", "m", cm), 0.127);
  EXPECT_EQ(parsedValue("1.5 km", "m", cm), 1500.0);
  EXPECT_EQ(parsedValue("2 m", "km", displayUnit("km", 12)), 0.002);
  EXPECT_EQ(parsedValue("0,5 turns", "degrees", displayUnit("degrees", 10)), 180.0);
  EXPECT_EQ(parsedValue("30%", "", DisplayUnit{}), 0.3);
  EXPECT_EQ(parsedValue("400 plants", "plants/m2", displayUnit("plants/m2", 400)), 400.0);
  EXPECT_EQ(parsedValue("90 min", "hours", displayUnit("hours", 15)), 1.5);
  for (const char* text : {"", "cm", "12 kg", "12 degrees", "1 2", "1e999", "nan"}) {
    EXPECT_FALSE(parsedValue(text, "m", cm).has_value()) << text;
  }
}

TEST(Units, ExactTextReadsBackAsTheSameValue) {
  for (const double value : {0.4, 0.0123456789, 1.0 / 3.0, 19.999, 0.002}) {
    const DisplayUnit unit = displayUnit("m", 0.4);
    EXPECT_NEAR(*parsedValue(exactValue(value, unit), "m", unit), value, 1e-11 * value);
  }
}

TEST(Text, WordsOfAFilterMayStandAnywhere) {
  EXPECT_TRUE(holdsWords("Blade height", "hei"));
  EXPECT_TRUE(holdsWords("Blade height", "height bla"));
  EXPECT_FALSE(holdsWords("Blade height", "blade width"));
  EXPECT_TRUE(holdsWords("Blade height", "  "));
}

TEST(Parts, ButtonsPressTogglesToggleAndDisabledOnesDoNot) {
  Harness ui(300, 200);
  int pressed = 0, off = 0;
  bool on = false;
  ui.show([&] {
    if (iconButton("save", icon::kSave, "Save", "Ctrl+S")) ++pressed;
    if (iconButton("never", icon::kSave, "Save", "", false)) ++off;
    if (toolToggle("snap", icon::kSnap, on, "Snap")) on = !on;
    if (primaryButton("go", "Render")) ++pressed;
  });
  ui.click("action:save");
  ui.click("action:go");
  ui.click("action:never");
  ui.click("action:snap");
  EXPECT_EQ(pressed, 2);
  EXPECT_EQ(off, 0);
  EXPECT_TRUE(on);
}

TEST(Parts, SearchIsTypedAndEmptied) {
  Harness ui(300, 200);
  std::string text;
  int changes = 0;
  ui.show([&] { changes += searchBox("fields", text, 200) ? 1 : 0; });
  ui.click("search:fields");
  ui.type("hei");
  EXPECT_EQ(text, "hei");
  EXPECT_EQ(changes, 3);
  ui.click("action:clear fields");
  EXPECT_EQ(text, "");
}

TEST(Parts, SectionsFoldAndRemember) {
  Harness ui(300, 200);
  bool open = false;
  ui.show([&] { open = sectionHeader("plants", "Plants"); });
  EXPECT_TRUE(open);
  ui.click("section:plants");
  EXPECT_FALSE(open);
  ui.frames(5);
  EXPECT_FALSE(open);
}

TEST(Parts, SplitHandlesStayInTheirRange) {
  Harness ui(600, 200);
  float size = 200;
  ui.show([&] {
    ImGui::SetCursorPosX(size);
    splitHandle("left", true, 150, size, 100, 400, 250);
  });
  ImVec2 at = ui.at("split:left");
  ui.drag(at, ImVec2(at.x + 60, at.y));
  EXPECT_NEAR(size, 260, 1);
  at = ui.at("split:left");
  ui.drag(at, ImVec2(at.x + 900, at.y));
  EXPECT_EQ(size, 400);
  ui.doubleClickAt(ui.at("split:left"));
  EXPECT_EQ(size, 250);
}

TEST(Parts, AProgressPillIsCancelledByItsCross) {
  Harness ui(400, 200);
  int cancelled = 0;
  ui.show([&] { cancelled += progressPill("bake", "Baking", 0.4f, 220, true) ? 1 : 0; });
  ui.click("progress:bake");
  EXPECT_EQ(cancelled, 0);
  ui.click("action:cancel bake");
  EXPECT_EQ(cancelled, 1);
}

TEST(Toasts, GoByThemselvesUnlessTheMouseRestsOnThem) {
  Harness ui(600, 400);
  Toasts toasts;
  ui.show([&] { toasts.draw(ImVec2(0, 0), ImVec2(600, 400)); });
  const int number = toasts.add(Severity::Done, "Saved", "", 1.0);
  EXPECT_EQ(toasts.add(Severity::Done, "Saved", "", 1.0), number) << "the same text is one notice";
  EXPECT_TRUE(toasts.needFrames());
  ui.frames(3);
  ui.moveTo(ui.at("toast:" + std::to_string(number)));
  ui.frames(120);
  EXPECT_EQ(toasts.count(), 1u);
  ui.moveTo(ImVec2(5, 5));
  ui.frames(80);
  EXPECT_EQ(toasts.count(), 0u);
  EXPECT_FALSE(toasts.needFrames());
}

TEST(Toasts, ActionsReportTheirNotice) {
  Harness ui(600, 400);
  Toasts toasts;
  int acted = 0;
  ui.show([&] {
    if (const int number = toasts.draw(ImVec2(0, 0), ImVec2(600, 400))) acted = number;
  });
  toasts.add(Severity::Error, "The disk is full", "", Toasts::kForever);
  const int second = toasts.add(Severity::Warning, "The file changed on disk", "Reload", Toasts::kForever);
  ui.frames(600);
  EXPECT_EQ(toasts.count(), 2u);
  EXPECT_FALSE(toasts.needFrames()) << "what stays needs no redrawing";
  ui.click("action:toast " + std::to_string(second) + " act");
  EXPECT_EQ(acted, second);
  EXPECT_EQ(toasts.count(), 1u);
  ui.frames(3);
  ui.click("action:toast 1 close");
  EXPECT_EQ(toasts.count(), 0u);
}

}  // namespace
}  // namespace sward::editor
