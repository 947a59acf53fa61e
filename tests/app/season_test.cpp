#include "app/offscreen.h"

#include "image/io.h"
#include "project/project.h"
#include "widgets/item_log.h"
#include "wither/season.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <thread>

namespace sward::editor {
namespace {

namespace fs = std::filesystem;

constexpr int kWidth = 1440, kHeight = 900;

/// The editor with a small lawn of texels, driven by the mouse.
class SeasonTest : public testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = (fs::temp_directory_path() / "sward-season.XXXXXX").string();
    m_folder = mkdtemp(pattern.data());
    project::Project project = project::fromTemplate("lawn").value();
    project.patch.sideM = 0.25;
    project.wither.texel.resolution = 64;
    project.wither.weathering = 0.2;
    project.render.method = render::GroundMethod::Texels;
    project.render.samples = 1;
    ASSERT_TRUE(project::save(project, m_folder / "small.sward").ok());
    ApplicationOptions options;
    options.project = m_folder / "small.sward";
    options.unattended = true;
    auto editor = OffscreenEditor::create(options, kWidth, kHeight);
    ASSERT_TRUE(editor.ok()) << editor.error().text();
    m_editor = std::move(*editor);
    setItemLog(&m_log);
    frames(2);
  }
  void TearDown() override {
    setItemLog(nullptr);
    m_editor.reset();
    std::error_code code;
    fs::remove_all(m_folder, code);
  }

  Application& application() { return m_editor->application(); }
  UiState& ui() { return application().ui(); }
  const Document& document() { return application().document(); }
  const project::Project& project() { return document().project(); }
  const wither::WitherOptions& withering() { return project().wither; }

  void frames(int count) {
    for (int i = 0; i < count; ++i) {
      m_log.beginFrame();
      m_editor->frame();
    }
  }
  ImVec2 at(const std::string& name) {
    const ItemLog::Item* item = m_log.find(name);
    if (item == nullptr) {
      ADD_FAILURE() << "nothing called " << name << " was drawn";
      return {0.0f, 0.0f};
    }
    EXPECT_TRUE(item->visible) << name;
    return item->centre();
  }
  bool has(const std::string& name) const { return m_log.find(name) != nullptr; }
  void dragFrom(ImVec2 from, ImVec2 by) {
    m_editor->moveMouse(from.x, from.y);
    frames(2);
    m_editor->mouseButton(0, true);
    frames(2);
    for (int i = 1; i <= 4; ++i) {
      const float part = 0.25f * static_cast<float>(i);
      m_editor->moveMouse(from.x + part * by.x, from.y + part * by.y);
      frames(1);
    }
    m_editor->mouseButton(0, false);
    frames(3);
  }
  void drag(const std::string& name, ImVec2 by) { dragFrom(at(name), by); }
  void click(const std::string& name) { dragFrom(at(name), {0.0f, 0.0f}); }
  bool frameUntil(const std::function<bool()>& done) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(120);
    while (!done() && std::chrono::steady_clock::now() < end) {
      frames(1);
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    return done();
  }
  double bakedWeathering() {
    const auto& ground = application().live().state().ground;
    return ground && ground->texels ? ground->texels->weathering : -1.0;
  }
  /// For eyes: the window into the folder that SWARD_TEST_PICTURES names, if it does.
  void show(const std::string& name) {
    const char* folder = std::getenv("SWARD_TEST_PICTURES");
    if (folder == nullptr) return;
    EXPECT_TRUE(m_editor->settle(120.0));
    EXPECT_TRUE(image::writePng(fs::path(folder) / (name + ".png"), m_editor->picture()).ok());
  }

  fs::path m_folder;
  ItemLog m_log;
  std::unique_ptr<OffscreenEditor> m_editor;
};

TEST_F(SeasonTest, AWaterPointIsEditedAsOneStepFromTheAutumnsCurve) {
  click("outliner:Withering");
  EXPECT_EQ(ui().selection.kind, Selection::Kind::Wither);
  for (const char* field : {"field:wither.weathering", "field:wither.ageing.autumn", "field:wither.ageing.water"})
    EXPECT_TRUE(has(field)) << field;
  click("field:wither.ageing.water");
  EXPECT_EQ(ui().activeCurve, "wither.ageing.water");
  EXPECT_EQ(ui().bottomTab, BottomTab::Curves);
  frames(2);
  const wither::AgeingOptions before = withering().ageing;
  drag("curve:wither.ageing.water:point:3", {0.0f, 25.0f});
  show("withering");
  ASSERT_EQ(document().position(), 1U);
  EXPECT_EQ(withering().ageing.autumn, wither::Autumn::Custom);
  EXPECT_EQ(withering().ageing.chlorophyll, wither::chlorophyllCurve(before));
  const base::Curve normal = wither::waterCurve(before);
  ASSERT_EQ(withering().ageing.water.points().size(), normal.points().size());
  EXPECT_LT(withering().ageing.water.points()[3].y, normal.points()[3].y);
  EXPECT_EQ(withering().ageing.water.points()[4], normal.points()[4]);
  application().run("edit.undo");
  EXPECT_EQ(withering().ageing, before);
  EXPECT_FALSE(document().modified());
}

TEST_F(SeasonTest, AnAutumnIsChosenInOneStepAndOwnCurvesBeginWithIt) {
  click("outliner:Withering");
  click("field:wither.ageing.autumn");
  click("option:Ample water");
  EXPECT_EQ(document().position(), 1U);
  EXPECT_EQ(withering().ageing.autumn, wither::Autumn::AmpleWater);
  const base::Curve water = wither::waterCurve(withering().ageing);
  click("field:wither.ageing.autumn");
  click("option:Own curves");
  EXPECT_EQ(document().position(), 2U);
  EXPECT_EQ(withering().ageing.water, water);
  application().run("edit.undo");
  application().run("edit.undo");
  EXPECT_FALSE(document().modified());
}

TEST_F(SeasonTest, SamplesAreMingledEditedAndRemoved) {
  click("outliner:Withering");
  click("mingle.three");
  ASSERT_EQ(withering().mingle.size(), 3U);
  frames(2);
  drag("field:wither.mingle[0].share", {20.0f, 0.0f});
  EXPECT_EQ(document().position(), 2U);
  EXPECT_GT(withering().mingle[0].share, 0.4);
  click("field:wither.mingle[0].ageing");
  EXPECT_EQ(ui().activeCurve, "wither.mingle[0].ageing");
  frames(2);
  show("mingling");
  const wither::MingleSample green = withering().mingle[0];
  drag("curve:wither.mingle[0].ageing:point:1", {0.0f, -20.0f});
  EXPECT_EQ(document().position(), 3U);
  EXPECT_GT(withering().mingle[0].ageing.points()[1].y, green.ageing.points()[1].y);
  click("mingle.remove:0");
  ASSERT_EQ(withering().mingle.size(), 2U);
  EXPECT_EQ(withering().mingle[0].name, "turning");
  for (int i = 0; i < 4; ++i) application().run("edit.undo");
  EXPECT_TRUE(withering().mingle.empty());
  frames(2);
  click("mingle.add");
  EXPECT_EQ(withering().mingle.size(), 2U);
  EXPECT_EQ(document().stepNames().size(), 1U);
}

TEST_F(SeasonTest, ScrubbingIsOneStep) {
  click("tab:Season");
  frames(2);
  EXPECT_FALSE(has("season.texels")) << "texels are drawn already";
  const ImVec2 middle = at("season.timeline");
  dragFrom(middle, {90.0f, 0.0f});
  EXPECT_EQ(document().position(), 1U);
  EXPECT_GT(withering().weathering, 0.55);
  EXPECT_LT(withering().weathering, 0.75);
  dragFrom(middle, {0.0f, 0.0f});
  EXPECT_EQ(document().position(), 2U);
  EXPECT_NEAR(withering().weathering, 0.5, 0.01);
  drag("season.degree", {30.0f, 0.0f});
  EXPECT_EQ(document().position(), 3U);
  ASSERT_TRUE(frameUntil([&] { return bakedWeathering() == withering().weathering; }));
  show("season");
}

TEST_F(SeasonTest, PlayingShowsOtherMomentsAndLeavesTheDocumentAlone) {
  ASSERT_TRUE(m_editor->settle(120.0));
  EXPECT_EQ(bakedWeathering(), 0.2);
  click("tab:Season");
  application().keyPressed(Shortcut::parse("Space"));
  ASSERT_TRUE(frameUntil([&] { return bakedWeathering() > 0.4; }));
  EXPECT_TRUE(application().nextWake().has_value());
  EXPECT_FALSE(document().modified());
  EXPECT_FALSE(document().canUndo());
  EXPECT_EQ(withering().weathering, 0.2);
  click("season.play");
  EXPECT_FALSE(ui().season.running);
  ASSERT_TRUE(ui().season.at.has_value());
  const double paused = ui().season.weathering;
  ASSERT_TRUE(frameUntil([&] { return bakedWeathering() == paused; }));
  show("paused");
  EXPECT_FALSE(document().modified());
  click("season.keep");
  EXPECT_EQ(document().position(), 1U);
  const double kept = withering().weathering;  // a whole per cent, as it reads
  EXPECT_EQ(kept, std::round(100.0 * paused) / 100.0);
  EXPECT_FALSE(ui().season.at.has_value());
  ASSERT_TRUE(frameUntil([&] { return bakedWeathering() == kept; }));
  click("season.play");
  ASSERT_TRUE(frameUntil([&] { return bakedWeathering() != kept; }));
  click("action:season.stop");
  ASSERT_TRUE(frameUntil([&] { return bakedWeathering() == kept && application().live().settled(); }));
  EXPECT_EQ(document().position(), 1U);
}

TEST_F(SeasonTest, TheSequenceIsEditedWithUndo) {
  click("tab:Season");
  frames(2);
  const project::Sequence before = project().sequence;
  drag("season.frames", {40.0f, 0.0f});
  EXPECT_EQ(document().position(), 1U);
  EXPECT_GT(project().sequence.frames, before.frames);
  EXPECT_EQ(document().undoName(), "frames");
  drag("season.rate", {-40.0f, 0.0f});
  EXPECT_EQ(document().position(), 2U);
  EXPECT_LT(project().sequence.framesPerSecond, before.framesPerSecond);
  show("sequence");
  application().run("edit.undo");
  application().run("edit.undo");
  EXPECT_EQ(project().sequence, before);
  click("outliner:Withering");
  frames(2);
  EXPECT_TRUE(has("field:sequence.frames"));
  EXPECT_TRUE(has("field:sequence.season"));
}

TEST_F(SeasonTest, TexelsAreShownPlainlyAndComparedWithTheReferenceAlone) {
  ASSERT_TRUE(m_editor->settle(120.0));
  ui().mode.quantity = render::ViewQuantity::Albedo;
  ui().compare.on = true;
  ui().compare.other = CompareState::Other::Ptm;
  const auto reference = [&] { return application().live().state().reference; };
  ASSERT_TRUE(frameUntil([&] { return reference() && reference()->picture; }));
  EXPECT_FALSE(application().live().state().viewError);
  show("reference");
  EXPECT_EQ(ui().compare.other, CompareState::Other::Ptm) << "what was chosen for layers is kept";
}

TEST_F(SeasonTest, LayersOfferToBeDrawnAsTexels) {
  application().edit("layers", [](project::Project& p) { p.render.method = render::GroundMethod::March; }, {});
  click("tab:Season");
  frames(2);
  show("layers");
  click("season.texels");
  EXPECT_EQ(project().render.method, render::GroundMethod::Texels);
  EXPECT_EQ(document().undoName(), "draw as texels");
  application().run("edit.undo");
  EXPECT_EQ(project().render.method, render::GroundMethod::March);
}

TEST_F(SeasonTest, LeafColourIsEdited) {
  click("outliner:Leaf colour");
  EXPECT_EQ(ui().selection.kind, Selection::Kind::Leaf);
  drag("field:leaf.chlorophyll", {40.0f, 0.0f});
  EXPECT_EQ(document().position(), 1U);
  EXPECT_GT(project().leaf.chlorophyll, 35.0);
  show("leaf");
}

}  // namespace
}  // namespace sward::editor
