#include "widgets/fields.h"
#include "widgets/harness.h"

#include "image/colour.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sward::editor {
namespace {

/// A struct of the schema under edit, and what the editor's panel would count.
template <typename T>
struct Bench {
  Harness ui{480, 1400};
  std::string path;
  T value{};
  T defaults{};
  FieldOptions options;
  FieldEvents last;  ///< the last one that said anything
  int changes = 0, finishes = 0;

  explicit Bench(std::string where) : path(std::move(where)) {
    options.advanced = true;
    ui.show([this] {
      const FieldEvents events = drawFields(path, value, defaults, options);
      if (!events.openCurve.empty() || !events.browse.empty() || events.changed || events.finished) last = events;
      changes += events.changed ? 1 : 0;
      finishes += events.finished ? 1 : 0;
    });
  }
  ImVec2 field(const std::string& name) const { return ui.at("field:" + path + "." + name); }
  void typeInto(const std::string& name, const std::string& text) {
    ui.doubleClickAt(field(name));
    ui.type(text);
    ui.key(ImGuiKey_Enter);
  }
  void menu(const std::string& name, const std::string& item) {
    ui.click("label:" + path + "." + name, 1);
    ui.frames(2);
    ui.click("menu:" + item);
    ui.frames(2);
  }
};

using GrassBench = Bench<mesh::GrassShape>;

TEST(Fields, OneDragIsOneFinishedEditAndIsClamped) {
  GrassBench b("patch.plants[0].grass");
  const ImVec2 from = b.field("bendDeg");
  b.ui.drag(from, ImVec2(from.x + 30, from.y), 6);
  EXPECT_GT(b.value.bendDeg, 55.0);
  EXPECT_GT(b.changes, 1);
  EXPECT_EQ(b.finishes, 1);
  EXPECT_EQ(b.last.path, "patch.plants[0].grass.bendDeg");
  EXPECT_EQ(b.last.label, "bend");
  EXPECT_TRUE(b.last.finished);
  b.ui.drag(from, ImVec2(from.x + 2000, from.y));
  EXPECT_EQ(b.value.bendDeg, 180.0);
  b.ui.drag(from, ImVec2(from.x - 4000, from.y));
  EXPECT_EQ(b.value.bendDeg, 0.0);
  EXPECT_EQ(b.finishes, 3);
}

TEST(Fields, DragsOverDecadesStayInRangeAndShort) {
  GrassBench b("g");
  const ImVec2 from = b.field("heightM");
  b.ui.drag(from, ImVec2(from.x + 37, from.y));
  EXPECT_GT(b.value.heightM, 0.45);
  EXPECT_LT(b.value.heightM, 2.0);
  EXPECT_EQ(std::round(b.value.heightM * 1000.0) / 1000.0, b.value.heightM) << "values are rounded to a pixel's worth";
  b.ui.drag(from, ImVec2(from.x - 3000, from.y));
  EXPECT_EQ(b.value.heightM, 0.002);
}

TEST(Fields, ShiftDragsTenTimesFiner) {
  GrassBench b("g");
  const ImVec2 from = b.field("leanDeg");
  b.ui.drag(from, ImVec2(from.x + 40, from.y));
  const double coarse = b.value.leanDeg - b.defaults.leanDeg;
  b.value = b.defaults;
  b.ui.hold(false, true, false);
  b.ui.drag(from, ImVec2(from.x + 40, from.y));
  EXPECT_NEAR(b.value.leanDeg - b.defaults.leanDeg, coarse / 10.0, coarse * 0.03);
}

TEST(Fields, EscapeTakesADragBack) {
  GrassBench b("g");
  const ImVec2 from = b.field("bendDeg");
  b.ui.moveTo(from);
  b.ui.press();
  b.ui.moveTo(ImVec2(from.x + 50, from.y));
  EXPECT_NE(b.value.bendDeg, b.defaults.bendDeg);
  b.ui.key(ImGuiKey_Escape);
  EXPECT_EQ(b.value.bendDeg, b.defaults.bendDeg);
  EXPECT_EQ(b.finishes, 1);
  b.ui.moveTo(ImVec2(from.x + 90, from.y));
  b.ui.release();
  EXPECT_EQ(b.value.bendDeg, b.defaults.bendDeg);
}

TEST(Fields, ClickWithoutMovingChangesNothing) {
  GrassBench b("g");
  b.ui.clickAt(b.field("bendDeg"));
  b.ui.frames(3);
  EXPECT_EQ(b.value, b.defaults);
  EXPECT_EQ(b.changes + b.finishes, 0);
}

TEST(Fields, TypedNumbersCarryUnits) {
  GrassBench b("g");
  b.typeInto("heightM", "120 mm");
  EXPECT_DOUBLE_EQ(b.value.heightM, 0.12);
  EXPECT_EQ(b.changes, 1);
  EXPECT_EQ(b.finishes, 1);
  b.typeInto("heightM", "55");  // shown in cm, so typed in cm
  EXPECT_DOUBLE_EQ(b.value.heightM, 0.55);
  b.typeInto("heightM", "0,8m");
  EXPECT_DOUBLE_EQ(b.value.heightM, 0.8);
  b.typeInto("heightM", "900 m");
  EXPECT_DOUBLE_EQ(b.value.heightM, 20.0) << "clamped to the schema's range";
  b.typeInto("bendDeg", "0.5 rad");
  EXPECT_NEAR(b.value.bendDeg, 28.6478897565, 1e-9);
  b.typeInto("bladesPerPlant", "12.4");
  EXPECT_EQ(b.value.bladesPerPlant, 12);
}

TEST(Fields, WhatIsNoNumberChangesNothing) {
  GrassBench b("g");
  for (const char* text : {"tall", "", "12 kg", "nan", "inf", "--3"}) b.typeInto("heightM", text);
  EXPECT_EQ(b.value, b.defaults);
  EXPECT_EQ(b.changes + b.finishes, 0);
}

TEST(Fields, EntryIsTakenOverWhenAnotherFieldIsClicked) {
  GrassBench b("g");
  b.ui.doubleClickAt(b.field("heightM"));
  b.ui.type("70");
  EXPECT_EQ(b.changes, 0) << "half-typed numbers must not bake";
  b.ui.clickAt(b.field("bendDeg"));
  EXPECT_DOUBLE_EQ(b.value.heightM, 0.7);
  EXPECT_EQ(b.finishes, 1);
  EXPECT_EQ(b.last.label, "blade height");
}

TEST(Fields, EscapeLeavesAnEntryAsItWas) {
  GrassBench b("g");
  b.ui.doubleClickAt(b.field("heightM"));
  b.ui.type("70");
  b.ui.key(ImGuiKey_Escape);
  b.ui.frames(3);
  EXPECT_EQ(b.value, b.defaults);
  EXPECT_EQ(b.changes + b.finishes, 0);
}

TEST(Fields, CtrlClickTypesToo) {
  GrassBench b("g");
  b.ui.hold(true, false, false);
  b.ui.clickAt(b.field("heightM"));
  b.ui.hold(false, false, false);
  b.ui.type("33cm");
  b.ui.key(ImGuiKey_Enter);
  EXPECT_DOUBLE_EQ(b.value.heightM, 0.33);
}

TEST(Fields, TabGoesToTheNextNumber) {
  GrassBench b("g");
  b.ui.doubleClickAt(b.field("heightM"));
  b.ui.type("70");
  b.ui.key(ImGuiKey_Tab);
  b.ui.frames(2);
  b.ui.type("30");
  b.ui.key(ImGuiKey_Enter);
  EXPECT_DOUBLE_EQ(b.value.heightM, 0.7);
  EXPECT_DOUBLE_EQ(b.value.heightVariation, 0.3) << "30 % is the default too: nothing else may have changed";
  b.ui.doubleClickAt(b.field("heightM"));
  b.ui.key(ImGuiKey_Tab);
  b.ui.frames(2);
  b.ui.type("12");
  b.ui.key(ImGuiKey_Enter);
  EXPECT_DOUBLE_EQ(b.value.heightVariation, 0.12);
}

TEST(Fields, MenuResetsCopiesAndPastes) {
  GrassBench b("patch.plants[2].grass");
  b.value.heightM = 0.9;
  b.menu("heightM", "Copy value");
  EXPECT_STREQ(ImGui::GetClipboardText(), "0.9");
  b.menu("heightM", "Reset to default");
  EXPECT_EQ(b.value.heightM, b.defaults.heightM);
  EXPECT_EQ(b.changes, 1);
  EXPECT_EQ(b.finishes, 1);
  b.menu("heightM", "Paste value");
  EXPECT_EQ(b.value.heightM, 0.9);
  ImGui::SetClipboardText("77");
  b.menu("heightM", "Paste value");
  EXPECT_EQ(b.value.heightM, 20.0) << "pasted values are held in the range";
  ImGui::SetClipboardText("grass");
  b.menu("heightM", "Paste value");
  EXPECT_EQ(b.value.heightM, 20.0);
  b.menu("heightM", "Copy path");
  EXPECT_STREQ(ImGui::GetClipboardText(), "patch.plants[2].grass.heightM");
  EXPECT_EQ(b.finishes, 3);
}

TEST(Fields, OptionalValuesAreSwitchedByABox) {
  Bench<mesh::GltfSource> b("gltf");
  ASSERT_FALSE(b.value.heightM.has_value());
  EXPECT_FALSE(b.ui.has("field:gltf.heightM"));
  b.ui.click("enable:gltf.heightM");
  ASSERT_TRUE(b.value.heightM.has_value());
  EXPECT_EQ(b.finishes, 1);
  b.typeInto("heightM", "2 m");
  EXPECT_DOUBLE_EQ(*b.value.heightM, 2.0);
  b.ui.click("enable:gltf.heightM");
  EXPECT_FALSE(b.value.heightM.has_value());
  EXPECT_EQ(b.finishes, 3);
}

TEST(Fields, OptionalStructsOpenTheirFields) {
  Bench<mesh::GltfSource> b("gltf");
  EXPECT_FALSE(b.ui.has("enable:gltf.material.baseColour"));
  b.ui.click("enable:gltf.material");
  ASSERT_TRUE(b.value.material.has_value());
  b.ui.frames(2);
  b.ui.click("enable:gltf.material.alphaCutoff");
  ASSERT_TRUE(b.value.material->alphaCutoff.has_value());
  b.typeInto("material.alphaCutoff", "40");
  EXPECT_DOUBLE_EQ(*b.value.material->alphaCutoff, 0.4) << "shown in percent, so typed in percent";
}

TEST(Fields, WordsAreChosenFromAList) {
  Bench<project::Plant> b("p");
  b.ui.click("field:p.kind");
  b.ui.frames(2);
  b.ui.click("option:Clover");
  EXPECT_EQ(b.value.kind, project::PlantKind::Clover);
  EXPECT_EQ(b.changes, 1);
  EXPECT_EQ(b.finishes, 1);
  b.ui.frames(2);
  EXPECT_TRUE(b.ui.has("field:p.clover.stems")) << "the kind's own fields show";
  EXPECT_FALSE(b.ui.has("field:p.grass.heightM"));
}

TEST(Fields, TextIsTakenOverOnce) {
  Bench<project::Plant> b("p");
  b.ui.doubleClickAt(b.field("name"));
  b.ui.type("fescue");
  EXPECT_EQ(b.changes, 0);
  b.ui.key(ImGuiKey_Enter);
  EXPECT_EQ(b.value.name, "fescue");
  EXPECT_EQ(b.changes, 1);
  EXPECT_EQ(b.finishes, 1);
}

TEST(Fields, SeedsAreTypedOrThrown) {
  Bench<project::Patch> b("patch");
  b.ui.click("dice:patch.seed");
  EXPECT_NE(b.value.seed, 1u);
  b.ui.doubleClickAt(b.field("seed"));
  b.ui.key(ImGuiKey_A);
  b.ui.type("18446744073709551615");
  b.ui.key(ImGuiKey_Enter);
  EXPECT_EQ(b.value.seed, 18446744073709551615u);
  EXPECT_FALSE(b.ui.has("field:patch.plants")) << "lists belong to panels";
}

TEST(Fields, ColoursOpenAPickerAndKeepTheirLinearValue) {
  GrassBench b("g");
  b.ui.click("field:g.tipColour");
  b.ui.frames(5);
  ASSERT_TRUE(b.ui.has("picker:g.tipColour"));
  EXPECT_EQ(b.value, b.defaults) << "opening the picker changes nothing, not even by rounding";
  // A drag across the picker's square of saturation and value.
  const ItemLog::Item item = b.ui.item("picker:g.tipColour");
  const ImVec2 top(item.min.x, item.min.y - 150);
  b.ui.drag(ImVec2(top.x + 60, top.y), ImVec2(top.x + 90, top.y + 30));
  EXPECT_NE(b.value.tipColour, b.defaults.tipColour);
  EXPECT_EQ(b.finishes, 1);
  for (int i = 0; i < 3; ++i) {
    EXPECT_GE(b.value.tipColour[i], 0.0);
    EXPECT_LE(b.value.tipColour[i], 1.0);
  }
}

TEST(Fields, ColoursPasteFromHexAndShowThemselves) {
  GrassBench b("g");
  ImGui::SetClipboardText("#7A9C4B");
  b.menu("tipColour", "Paste value");
  EXPECT_EQ(hexText(b.value.tipColour), "#7A9C4B");
  EXPECT_NEAR(b.value.tipColour.x, image::linearFromSrgb(122.0f / 255.0f), 1e-6);
  b.ui.moveTo(ImVec2(1, 1));
  b.ui.frames(3);
  const ItemLog::Item item = b.ui.item("field:g.tipColour");
  const image::Image picture = b.ui.picture();
  const glm::vec3 shown = picture.rgb(static_cast<int>(item.min.x + 16), static_cast<int>(item.centre().y));
  EXPECT_NEAR(shown.x * 255.0f, 122.0f, 1.0f) << "stored linear, shown encoded";
  EXPECT_NEAR(shown.y * 255.0f, 156.0f, 1.0f);
  EXPECT_NEAR(shown.z * 255.0f, 75.0f, 1.0f);
}

TEST(Fields, FilterShowsMatchesAlone) {
  GrassBench b("g");
  b.options.filter = "heig";
  b.ui.frames(2);
  EXPECT_TRUE(b.ui.has("field:g.heightM"));
  EXPECT_TRUE(b.ui.has("field:g.heightVariation"));
  EXPECT_FALSE(b.ui.has("field:g.bendDeg"));
  b.options.filter = "transl";
  b.ui.frames(2);
  EXPECT_TRUE(b.ui.has("field:g.optics.translucency")) << "a struct shows for the fields in it";
  EXPECT_FALSE(b.ui.has("field:g.optics.transmissionTint"));
  b.options.filter = "leaf optics";
  b.ui.frames(2);
  EXPECT_TRUE(b.ui.has("field:g.optics.transmissionTint")) << "a struct's own name shows all of it";
}

TEST(Fields, AdvancedFieldsHideUnlessTheyDiffer) {
  GrassBench b("g");
  EXPECT_TRUE(b.ui.has("field:g.segments"));
  b.options.advanced = false;
  b.ui.frames(2);
  EXPECT_FALSE(b.ui.has("field:g.segments"));
  b.value.segments = 9;
  b.ui.frames(2);
  EXPECT_TRUE(b.ui.has("field:g.segments"));
}

TEST(Fields, GroupsFold) {
  GrassBench b("g");
  EXPECT_TRUE(b.ui.has("field:g.heightM"));
  b.ui.click("fold:Size");
  b.ui.frames(2);
  EXPECT_FALSE(b.ui.has("field:g.heightM"));
  EXPECT_TRUE(b.ui.has("field:g.bendDeg"));
  b.options.filter = "height";
  b.ui.frames(2);
  EXPECT_TRUE(b.ui.has("field:g.heightM")) << "a search looks into folded groups";
}

TEST(Fields, CurvesAskForTheirPanel) {
  GrassBench b("patch.plants[0].grass");
  b.ui.click("field:patch.plants[0].grass.profile");
  EXPECT_EQ(b.last.openCurve, "patch.plants[0].grass.profile");
  EXPECT_EQ(b.changes, 0);
}

TEST(Fields, FilesAskForADialog) {
  Bench<mesh::GltfSource> b("gltf");
  b.ui.click("browse:gltf.path");
  EXPECT_EQ(b.last.browse, "gltf.path");
  EXPECT_NE(b.last.files.find(".glb"), std::string::npos);
}

/// How much of a rectangle is nearly of one colour.
int pixelsLike(const image::Image& picture, const ItemLog::Item& item, ImU32 colour) {
  const ImVec4 c = ImGui::ColorConvertU32ToFloat4(colour);
  int count = 0;
  for (int y = static_cast<int>(item.min.y); y < static_cast<int>(item.max.y); ++y) {
    for (int x = static_cast<int>(item.min.x); x < static_cast<int>(item.max.x); ++x) {
      if (glm::distance(picture.rgb(x, y), glm::vec3(c.x, c.y, c.z)) < 0.08f) ++count;
    }
  }
  return count;
}

TEST(Fields, WrongValuesAreRed) {
  GrassBench b("g");
  b.ui.moveTo(ImVec2(1, 1));
  const ImU32 red = theme().colours.error;
  EXPECT_EQ(pixelsLike(b.ui.picture(), b.ui.item("field:g.heightM"), red), 0);
  b.value.heightM = 50.0;
  b.ui.frames(2);
  EXPECT_GT(pixelsLike(b.ui.picture(), b.ui.item("field:g.heightM"), red), 40);
  EXPECT_EQ(b.value.heightM, 50.0) << "shown, not silently mended";
  EXPECT_EQ(b.changes, 0);
  const std::vector<project::Problem> problems{{true, "g.widthM", "too wide", "Make it less."}};
  b.options.problems = &problems;
  b.ui.frames(2);
  EXPECT_GT(pixelsLike(b.ui.picture(), b.ui.item("field:g.widthM"), red), 40);
}

TEST(Fields, TooltipsShowAfterAWhile) {
  GrassBench b("g");
  b.ui.moveTo(b.ui.at("label:g.heightM"));
  b.ui.frames(5);
  const int before = ImGui::GetIO().MetricsRenderWindows;
  b.ui.frames(40);
  EXPECT_EQ(ImGui::GetIO().MetricsRenderWindows, before + 1);
}

TEST(Fields, ChangedValuesCarryAMark) {
  GrassBench b("g");
  b.ui.moveTo(ImVec2(1, 1));
  const ImU32 green = theme().colours.accent;
  EXPECT_EQ(pixelsLike(b.ui.picture(), b.ui.item("label:g.leanDeg"), green), 0);
  b.value.leanDeg = 20.0;
  b.ui.frames(2);
  EXPECT_GT(pixelsLike(b.ui.picture(), b.ui.item("label:g.leanDeg"), green), 5);
}

}  // namespace
}  // namespace sward::editor
