#include "widgets/harness.h"
#include "widgets/icons.h"
#include "widgets/theme.h"

#include <gtest/gtest.h>

namespace sward::editor {
namespace {

class Themes : public ::testing::TestWithParam<ThemeKind> {};

TEST_P(Themes, TextIsReadableOnEverythingItStandsOn) {
  const Palette& p = paletteOf(GetParam());
  for (const ImU32 ground : {p.panel, p.raised, p.field, p.fieldHover, p.plot}) {
    EXPECT_GE(contrast(p.text, ground), 7.0);     // WCAG 2.1 AAA
    EXPECT_GE(contrast(p.textDim, ground), 4.5);  // AA
    EXPECT_GE(contrast(p.error, ground), 4.5);
  }
  for (const ImU32 sign : {p.warning, p.info, p.accent}) EXPECT_GE(contrast(sign, p.panel), 3.0);  // graphics
  for (const ImU32 line : p.series) EXPECT_GE(contrast(line, p.plot), 3.0);
  EXPECT_GE(contrast(p.onAccent, p.accent), 4.5);
  EXPECT_GE(contrast(p.onAccent, p.accentStrong), 4.5);
}

INSTANTIATE_TEST_SUITE_P(Both, Themes, ::testing::Values(ThemeKind::Dark, ThemeKind::Light));

TEST(Theme, ContrastIsThatOfWcag) {
  EXPECT_NEAR(contrast(IM_COL32_WHITE, IM_COL32_BLACK), 21.0, 1e-4);
  EXPECT_NEAR(contrast(IM_COL32(0x77, 0x77, 0x77, 255), IM_COL32_WHITE), 4.48, 0.01);
  EXPECT_NEAR(contrast(IM_COL32_WHITE, IM_COL32_WHITE), 1.0, 1e-6);
}

TEST(Theme, FontsHoldWhatTheInterfaceWrites) {
  Harness ui;
  const Fonts& fonts = theme().fonts;
  for (const ImFont* font : {fonts.body, fonts.strong, fonts.small, fonts.heading}) {
    ASSERT_NE(font, nullptr);
    for (const ImWchar code : icon::kCodePoints)
      EXPECT_NE(font->FindGlyphNoFallback(code), nullptr) << std::hex << code;
    for (const ImWchar code : {0xB0, 0xB2, 0xD7, 0xB7, 0x2026, 0x2192, 0x2190, 0x2212, 0x2013, 0xFC, 0xE9}) {
      EXPECT_NE(font->FindGlyphNoFallback(code), nullptr) << std::hex << code;
    }
  }
}

TEST(Theme, FontsAreOfTheScale) {
  Harness one(500, 900, ThemeKind::Dark, 1.0f);
  EXPECT_FLOAT_EQ(theme().fonts.body->FontSize, 16.0f);
  Harness three(500, 900, ThemeKind::Dark, 3.0f);
  EXPECT_FLOAT_EQ(theme().fonts.body->FontSize, 48.0f);
  EXPECT_FLOAT_EQ(px(10), 30.0f);
  ImFontAtlas atlas;
  loadFonts(atlas, 100.0f);
  EXPECT_FLOAT_EQ(atlas.ConfigData[0].SizePixels, 48.0f) << "a scale beyond 3 is held";
}

TEST(Theme, MissingFontsAreNamedAndReplaced) {
  Harness ui;
  ImFontAtlas atlas;
  const FontFiles none{"/nowhere/a.otf", "/nowhere/b.otf", "/nowhere/icons.ttf"};
  const std::vector<std::string> missing = loadFonts(atlas, 1.0f, none);
  ASSERT_EQ(missing.size(), 3u);
  EXPECT_NE(missing[0].find("/nowhere/a.otf"), std::string::npos);
  EXPECT_NE(missing[0].find("fonts-inter"), std::string::npos);
  EXPECT_TRUE(atlas.Build());
  ASSERT_NE(theme().fonts.body, nullptr);
  EXPECT_NE(theme().fonts.body->FindGlyphNoFallback('A'), nullptr);
  loadFonts(*ImGui::GetIO().Fonts, 1.0f);
}

TEST(ItemLog, NamesWhatIsDrawnAndSaysWhatIsOutOfSight) {
  Harness ui(200, 100);
  ui.show([] {
    ImGui::BeginChild("list", ImVec2(0, 60));
    for (int i = 0; i < 10; ++i) {
      ImGui::Button("row");
      logItem("row:", std::to_string(i));
    }
    ImGui::EndChild();
  });
  EXPECT_TRUE(ui.item("row:0").visible);
  EXPECT_FALSE(ui.item("row:9").visible);
  EXPECT_LE(ui.item("row:1").max.y, 100.0f);
  EXPECT_FALSE(ui.has("row:10"));
  ItemLog log;
  log.add("a \"quoted\" name", ImVec2(1, 2), ImVec2(11, 22), true);
  EXPECT_EQ(log.toJson(),
            "{\"items\": {\n\"a \\\"quoted\\\" name\": {\"x\": 1, \"y\": 2, \"width\": 10, \"height\": 20, "
            "\"visible\": true}\n}}\n");
  log.beginFrame();
  EXPECT_EQ(log.find("a \"quoted\" name"), nullptr);
}

}  // namespace
}  // namespace sward::editor
