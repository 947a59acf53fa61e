#include "app/offscreen.h"

#include "image/io.h"
#include "project/project.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <thread>

namespace sward::editor {
namespace {

namespace fs = std::filesystem;

/// A project that bakes in a second, in a folder of its own.
class OffscreenEditorTest : public testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = (fs::temp_directory_path() / "sward-offscreen.XXXXXX").string();
    m_folder = mkdtemp(pattern.data());
    project::Project project = project::fromTemplate("lawn").value();
    project.patch.sideM = 0.4;
    project.sampling.sliceResolution = project.sampling.bladeWidth = 64;
    project.sampling.slices = 8;
    project.sampling.bladeHeight = 32;
    project.sampling.blades = 4;
    project.sampling.sliceSubSamples = project.sampling.bladeSubSamples = 1;
    project.sampling.visibilityDirections = 4;
    project.lights.count = 8;
    project.tiles.resolution = 32;
    project.tiles.overlap = 6;
    project.tiles.mapWidth = project.tiles.mapHeight = 32;
    project.render.samples = 1;
    ASSERT_TRUE(project::save(project, m_folder / "small.sward").ok());
    ApplicationOptions options;
    options.project = m_folder / "small.sward";
    options.unattended = true;
    auto editor = OffscreenEditor::create(options, 1000, 700);
    ASSERT_TRUE(editor.ok()) << editor.error().text();
    m_editor = std::move(*editor);
    m_editor->frame();
  }
  void TearDown() override {
    m_editor.reset();
    std::error_code code;
    fs::remove_all(m_folder, code);
  }
  Application& application() { return m_editor->application(); }
  const project::Project& project() { return application().document().project(); }

  fs::path m_folder;
  std::unique_ptr<OffscreenEditor> m_editor;
};

TEST_F(OffscreenEditorTest, ADroppedMeshBecomesAPlantThatIsSelected) {
  const std::size_t before = project().patch.plants.size();
  application().dropped({fs::path(SWARD_SOURCE_DIR) / "projects" / "assets" / "oat_tuft.glb"});
  ASSERT_EQ(project().patch.plants.size(), before + 1);
  EXPECT_EQ(project().patch.plants.back().kind, project::PlantKind::Gltf);
  EXPECT_EQ(application().ui().selection.kind, Selection::Kind::Plant);
  EXPECT_EQ(application().ui().selection.index, before);
  application().run("edit.undo");
  EXPECT_EQ(project().patch.plants.size(), before);
}

TEST_F(OffscreenEditorTest, ADroppedPictureBecomesTheSoil) {
  image::Image brown(4, 4, 3);
  ASSERT_TRUE(image::writePng(m_folder / "soil.png", brown).ok());
  application().dropped({m_folder / "soil.png"});
  EXPECT_EQ(project().patch.soil.texture, "soil.png");
}

TEST_F(OffscreenEditorTest, WhatIsNothingOfOursChangesNothing) {
  application().dropped({m_folder / "letter.txt", m_folder / "gone.glb"});
  EXPECT_FALSE(application().document().modified());
}

TEST_F(OffscreenEditorTest, ADroppedProjectIsOpened) {
  ASSERT_TRUE(project::save(project::fromTemplate("empty").value(), m_folder / "other.sward").ok());
  application().dropped({m_folder / "other.sward"});
  EXPECT_EQ(application().document().file().filename(), "other.sward");
  EXPECT_TRUE(project().patch.plants.empty());
}

TEST_F(OffscreenEditorTest, AProjectWithChangesIsNotReplacedUnasked) {
  application().edit("size", [](project::Project& p) { p.patch.sideM = 0.5; }, {});
  ASSERT_TRUE(project::save(project::fromTemplate("empty").value(), m_folder / "other.sward").ok());
  application().dropped({m_folder / "other.sward"});
  m_editor->frame();
  EXPECT_EQ(application().document().file().filename(), "small.sward");
  EXPECT_EQ(project().patch.sideM, 0.5);
}

TEST_F(OffscreenEditorTest, ShowsThePictureOfTheWholeProjectAndThenRests) {
  ASSERT_TRUE(m_editor->settle(120.0));
  const image::Image window = m_editor->picture();
  // The viewport's lower half is lawn.
  glm::dvec3 sum{0.0};
  for (int y = 330; y < 400; ++y) {
    for (int x = 380; x < 500; ++x) {
      for (int c = 0; c < 3; ++c) sum[c] += window.pixels[window.offset(x, y) + static_cast<std::size_t>(c)];
    }
  }
  EXPECT_GT(sum.g, 1.5 * sum.b);
  EXPECT_GT(sum.g, 1.1 * sum.r);
  EXPECT_FALSE(application().nextWake().has_value());
}

TEST_F(OffscreenEditorTest, TheReferenceGrowsBesideThePictureAndNothingIsEdited) {
  ASSERT_TRUE(m_editor->settle(120.0));
  const image::Image alone = m_editor->picture();
  UiState& ui = application().ui();
  ui.compare.on = true;
  ui.compare.other = CompareState::Other::Reference;
  const auto reference = [&] { return application().live().state().reference; };
  const auto frameUntil = [&](const std::function<bool()>& done) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(120);
    while (!done() && std::chrono::steady_clock::now() < end) {
      m_editor->frame();
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    return done();
  };
  ASSERT_TRUE(frameUntil([&] { return reference() && reference()->rmse.has_value(); }));
  EXPECT_GE(reference()->picture->samples, 4);
  EXPECT_GT(reference()->picture->noise, 0.0);
  EXPECT_GT(*reference()->rmse, 0.0);
  EXPECT_LT(*reference()->rmse, 0.3) << "two pictures of one lawn";
  m_editor->frame();
  const image::Image beside = m_editor->picture();
  // The meadow lies between x = 255 and 615, its split at 435; below y = 350 there is the caption.
  const auto change = [&](int x0, int x1) {
    double sum = 0.0;
    for (int y = 250; y < 350; ++y) {
      for (int x = x0; x < x1; ++x) sum += std::abs(alone.at(x, y, 1) - beside.at(x, y, 1));
    }
    return sum / (100.0 * (x1 - x0));
  };
  EXPECT_GT(change(450, 600), 3.0 * change(270, 425)) << "left, macro variation alone is gone";
  EXPECT_FALSE(application().document().modified());

  ui.mode.quantity = render::ViewQuantity::Albedo;
  m_editor->frame();
  EXPECT_FALSE(reference().has_value()) << "there is a reference of the plain picture alone";
  ui.mode = {};
  ASSERT_TRUE(frameUntil([&] { return reference() && reference()->picture; }));
  ui.compare.on = false;
  m_editor->frame();
  EXPECT_FALSE(reference().has_value());
  EXPECT_TRUE(m_editor->settle(60.0));
}

TEST_F(OffscreenEditorTest, ViewActionsMoveTheCameraAndViewsAreKept) {
  application().run("view.top");
  EXPECT_FALSE(application().ui().boundView.has_value());
  const glm::dvec3 position = application().ui().camera.position;
  const std::size_t views = project().views.size();
  application().run("view.save");
  ASSERT_EQ(project().views.size(), views + 1);
  EXPECT_EQ(project().views.back().position, position);
  application().run("view.remove");
  EXPECT_EQ(project().views.size(), views);
  for (int i = 0; i < 3; ++i) m_editor->frame();
}

}  // namespace
}  // namespace sward::editor
