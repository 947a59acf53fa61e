#include "editor/x_session.h"

#include "base/file.h"
#include "image/io.h"
#include "project/project.h"

#include <gtest/gtest.h>

#include <cmath>
#include <csignal>
#include <cstdlib>
#include <memory>

#include <nlohmann/json.hpp>

namespace sward {
namespace {

namespace fs = std::filesystem;

constexpr int kWidth = 1440, kHeight = 900;

/// A small meadow, so that bakes take a second or two.
project::Project smallProject() {
  project::Project project = project::fromTemplate("meadow").value();
  project.patch.sideM = 0.5;
  project.sampling.sliceResolution = 64;
  project.sampling.slices = 8;
  project.sampling.bladeWidth = 128;
  project.sampling.bladeHeight = 32;
  project.sampling.blades = 4;
  project.sampling.sliceSubSamples = 1;
  project.sampling.bladeSubSamples = 1;
  project.sampling.visibilityDirections = 4;
  project.lights.count = 8;
  project.tiles.resolution = 32;
  project.tiles.overlap = 6;
  project.tiles.mapWidth = project.tiles.mapHeight = 64;
  project.render.samples = 2;
  project.output = {320, 180};
  return project;
}

class EditorWindow : public testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = (fs::temp_directory_path() / "sward-editor.XXXXXX").string();
    m_home = mkdtemp(pattern.data());
    m_file = m_home / "small.sward";
    ASSERT_TRUE(project::save(smallProject(), m_file).ok());
    m_server = std::make_unique<XServer>(kWidth, kHeight);
    ASSERT_TRUE(m_server->running()) << "Xvfb does not start";
  }
  void TearDown() override {
    if (HasFailure() && m_session) {
      std::fprintf(stderr, "the editor said:\n%s\n", m_session->errors().c_str());
      const fs::path picture = m_home / "screen.png";
      if (image::writePng(picture, m_server->screenshot()).ok())
        std::fprintf(stderr, "the screen is in %s\n", picture.c_str());
    }
    m_session.reset();
    m_server.reset();
    std::error_code code;
    if (!HasFailure()) fs::remove_all(m_home, code);
  }

  void start(std::vector<std::string> arguments, std::map<std::string, std::string> environment = {}) {
    m_session.reset();
    m_session =
        std::make_unique<EditorSession>(*m_server, m_home / "user", std::move(arguments), std::move(environment));
    ASSERT_TRUE(m_session->waitForItem("viewport.picture")) << m_session->errors();
    m_session->focus();
    if (m_session->item("dialog:hintsDone")) m_session->click("dialog:hintsDone");
  }
  void openSmall() { start({m_file.string()}); }

  bool settled(double seconds = 240.0) {
    return m_session->waitUntil([&] { return m_session->state("settled") == "true"; }, seconds);
  }
  project::Project saved() const { return project::load(m_file).value(); }

  /// Mean colour of a part of the screen.
  glm::dvec3 mean(const EditorSession::Item& part) const {
    const image::Image screen = m_server->screenshot();
    glm::dvec3 sum{0.0};
    double count = 0.0;
    for (int y = static_cast<int>(part.y); y < static_cast<int>(part.y + part.height); ++y) {
      for (int x = static_cast<int>(part.x); x < static_cast<int>(part.x + part.width); ++x) {
        for (int c = 0; c < 3; ++c) sum[c] += screen.pixels[screen.offset(x, y) + static_cast<std::size_t>(c)];
        count += 1.0;
      }
    }
    return sum / count;
  }

  fs::path m_home, m_file;
  std::unique_ptr<XServer> m_server;
  std::unique_ptr<EditorSession> m_session;
};

TEST_F(EditorWindow, FromAnEditToASavedAndRenderedProject) {
  openSmall();
  ASSERT_TRUE(settled());
  const double before = smallProject().patch.plants[0].grass.heightM;

  // A drag of the blade height is one step, whatever its pieces.
  ASSERT_TRUE(m_session->drag("field:patch.plants[0].grass.heightM", 60.0, 0.0));
  EXPECT_TRUE(m_session->reaches("position", "1"));
  EXPECT_TRUE(m_session->reaches("undo", "blade height"));
  EXPECT_TRUE(m_session->reaches("modified", "true"));

  // The sun, with L held over the picture.
  m_session->moveTo(m_session->item("viewport.picture")->x + 200, m_session->item("viewport.picture")->y + 150);
  m_session->keyDown("l");
  ASSERT_TRUE(m_session->drag("viewport.picture", 120.0, -40.0));
  m_session->keyUp("l");
  EXPECT_TRUE(m_session->reaches("position", "2"));
  EXPECT_TRUE(m_session->reaches("undo", "sun"));
  ASSERT_TRUE(settled());

  m_session->key("ctrl+z");
  m_session->key("ctrl+z");
  EXPECT_TRUE(m_session->reaches("position", "0"));
  EXPECT_TRUE(m_session->reaches("modified", "false"));
  m_session->key("ctrl+y");
  EXPECT_TRUE(m_session->reaches("position", "1"));

  m_session->key("ctrl+s");
  ASSERT_TRUE(m_session->waitUntil([&] { return m_session->state("modified") == "false"; }, 10.0));
  EXPECT_GT(saved().patch.plants[0].grass.heightM, before * 1.01);
  EXPECT_EQ(saved().sun, smallProject().sun);

  // Reopened, it is what was saved.
  m_session->key("ctrl+q");
  EXPECT_EQ(m_session->waitForExit(), 0);
  openSmall();
  EXPECT_TRUE(m_session->reaches("position", "0"));

  // And rendered from the window.
  m_session->key("F12");
  ASSERT_TRUE(m_session->click("dialog:render"));
  const fs::path picture = m_home / "small.png";
  ASSERT_TRUE(m_session->waitUntil([&] { return fs::exists(picture); }, 120.0));
  const auto read = image::readImage(picture);
  ASSERT_TRUE(read.ok());
  EXPECT_EQ(read->width, 320);
  EXPECT_EQ(read->height, 180);
}

TEST_F(EditorWindow, ThePictureShowsGrassUnderSky) {
  openSmall();
  ASSERT_TRUE(settled());
  const auto picture = *m_session->item("viewport.picture");
  const auto part = [&](double from, double to) {
    return EditorSession::Item{picture.x + 0.3 * picture.width, picture.y + from * picture.height, 0.4 * picture.width,
                               (to - from) * picture.height, true};
  };
  const glm::dvec3 sky = mean(part(0.15, 0.25)), grass = mean(part(0.7, 0.95));
  EXPECT_GT(sky.b, sky.g - 0.05);
  EXPECT_GT(grass.g, grass.b * 1.3);
  EXPECT_GT(grass.g, grass.r);
  EXPECT_GT(sky.b, grass.b + 0.2);
}

TEST_F(EditorWindow, ACurvePointIsMovedAsOneStep) {
  openSmall();
  ASSERT_TRUE(settled());
  ASSERT_TRUE(m_session->click("tab:Curves"));
  ASSERT_TRUE(m_session->click("curveTab:patch.plants[0].grass.profile"));
  // The first edit of a built-in curve starts from its points.
  // Two clicks in one slow frame are one: a person tries again, too.
  for (int i = 0; i < 5 && m_session->number("position") == 0; ++i) {
    ASSERT_TRUE(m_session->click("curve:patch.plants[0].grass.profile:plot", 1, 2));
    m_session->reaches("position", "1", 3.0);
  }
  EXPECT_TRUE(m_session->reaches("position", "1"));
  ASSERT_TRUE(m_session->drag("curve:patch.plants[0].grass.profile:point:1", 20.0, 30.0));
  EXPECT_TRUE(m_session->reaches("position", "2"));
  EXPECT_TRUE(m_session->reaches("undo", "move curve point"));
  m_session->key("ctrl+s");
  ASSERT_TRUE(m_session->waitUntil([&] { return m_session->state("modified") == "false"; }, 10.0));
  EXPECT_NE(saved().patch.plants[0].grass.profile, smallProject().patch.plants[0].grass.profile);
  EXPECT_FALSE(saved().patch.plants[0].grass.profile.points().empty());
}

TEST_F(EditorWindow, ANewProjectFromATemplateIsSavedUnderAName) {
  openSmall();
  m_session->key("ctrl+n");
  ASSERT_TRUE(m_session->click("template:lawn"));
  ASSERT_TRUE(m_session->waitUntil([&] { return m_session->state("file").empty(); }, 10.0));
  m_session->key("ctrl+s");
  ASSERT_TRUE(m_session->click("action:files.type"));
  m_session->key("ctrl+a");
  m_session->type((m_home / "my lawn").string());
  m_session->key("Return");
  ASSERT_TRUE(m_session->click("action:files.accept"));
  ASSERT_TRUE(m_session->waitUntil([&] { return fs::exists(m_home / "my lawn.sward"); }, 10.0));
  EXPECT_TRUE(project::load(m_home / "my lawn.sward").ok());
}

TEST_F(EditorWindow, FromNothingToAPlantedProject) {
  ASSERT_TRUE(project::save(project::fromTemplate("empty").value(), m_file).ok());
  openSmall();
  ASSERT_TRUE(m_session->click("outliner.addPlant"));
  ASSERT_TRUE(m_session->click("addPlant:Buttercup"));
  EXPECT_TRUE(m_session->reaches("position", "1")) << m_session->errors();
  ASSERT_TRUE(m_session->click("outliner.addPlant"));
  ASSERT_TRUE(m_session->click("addPlant:Meadow grass"));
  // The new plant is selected, and its values are shown.
  EXPECT_TRUE(m_session->waitForItem("field:patch.plants[1].grass.heightM"));
  ASSERT_TRUE(m_session->click("action:edit.undo"));
  ASSERT_TRUE(m_session->click("action:edit.undo"));
  EXPECT_TRUE(m_session->reaches("position", "0"));
  ASSERT_TRUE(m_session->click("action:edit.redo"));
  EXPECT_TRUE(m_session->reaches("position", "1"));
  m_session->key("ctrl+s");
  ASSERT_TRUE(m_session->waitUntil([&] { return m_session->state("modified") == "false"; }, 10.0));
  ASSERT_EQ(saved().patch.plants.size(), 1u);
  EXPECT_EQ(saved().patch.plants[0].kind, project::PlantKind::Flower);
}

TEST_F(EditorWindow, UnsavedChangesAreAskedAbout) {
  openSmall();
  ASSERT_TRUE(m_session->drag("field:patch.plants[0].grass.heightM", 40.0, 0.0));
  m_session->key("ctrl+q");
  ASSERT_TRUE(m_session->click("dialog:cancel"));
  EXPECT_TRUE(m_session->alive());
  m_session->key("ctrl+q");
  ASSERT_TRUE(m_session->click("dialog:dontSave"));
  EXPECT_EQ(m_session->waitForExit(), 0);
  EXPECT_EQ(project::toJson(saved()), project::toJson(smallProject()));
}

TEST_F(EditorWindow, WorkIsRecoveredAfterAKill) {
  openSmall();
  ASSERT_TRUE(m_session->drag("field:patch.plants[0].grass.heightM", 40.0, 0.0));
  ASSERT_TRUE(m_session->waitUntil([&] { return m_session->state("autosaved") == "true"; }, 60.0));
  m_session->kill(SIGKILL);
  m_session->waitForExit();
  openSmall();
  ASSERT_TRUE(m_session->click("dialog:recover0"));
  ASSERT_TRUE(m_session->waitUntil([&] { return m_session->state("modified") == "true"; }, 10.0));
  m_session->key("ctrl+s");
  ASSERT_TRUE(m_session->waitUntil([&] { return m_session->state("modified") == "false"; }, 10.0));
  EXPECT_GT(saved().patch.plants[0].grass.heightM, smallProject().patch.plants[0].grass.heightM);
}

TEST_F(EditorWindow, ClosingWhileBakingEndsAtOnce) {
  project::Project big = smallProject();
  big.sampling.sliceResolution = 512;
  big.sampling.bladeWidth = 512;
  big.sampling.sliceSubSamples = 64;
  big.tiles.resolution = 256;
  ASSERT_TRUE(project::save(big, m_file).ok());
  openSmall();
  ASSERT_TRUE(m_session->waitUntil([&] { return m_session->state("baking") == "true"; }, 30.0));
  m_session->key("ctrl+q");
  EXPECT_EQ(m_session->waitForExit(), 0) << m_session->errors();
}

TEST_F(EditorWindow, AMissingAssetIsSaidAndCanBeRelocated) {
  project::Project project = smallProject();
  project::Plant plant;
  plant.name = "lost";
  plant.kind = project::PlantKind::Gltf;
  plant.gltf.path = "gone/lost.glb";
  plant.densityPerM2 = 50.0;
  project.patch.plants.push_back(plant);
  ASSERT_TRUE(project::save(project, m_file).ok());
  fs::create_directories(m_home / "found");
  fs::copy_file(fs::path(SWARD_SOURCE_DIR) / "projects" / "assets" / "oat_tuft.glb", m_home / "found" / "oat.glb");
  openSmall();
  const std::string where = "patch.plants[" + std::to_string(project.patch.plants.size() - 1) + "].gltf.path";
  ASSERT_TRUE(m_session->click("missing:" + where));
  ASSERT_TRUE(m_session->click("action:files.type"));
  m_session->key("ctrl+a");
  m_session->type((m_home / "found" / "oat.glb").string());
  m_session->key("Return");
  ASSERT_TRUE(settled());
  m_session->key("ctrl+s");
  ASSERT_TRUE(m_session->waitUntil([&] { return m_session->state("modified") == "false"; }, 10.0));
  EXPECT_EQ(saved().patch.plants.back().gltf.path, "found/oat.glb");
}

TEST_F(EditorWindow, WithoutOpenGl45TheViewportSaysSo) {
  start({m_file.string()}, {{"MESA_GL_VERSION_OVERRIDE", "3.3"}});
  ASSERT_TRUE(m_session->waitUntil([&] { return !m_session->state("viewError").empty(); }, 60.0));
  EXPECT_NE(m_session->state("viewError").find("4.5"), std::string::npos) << m_session->state("viewError");
  // Everything else works on.
  ASSERT_TRUE(m_session->drag("field:patch.plants[0].grass.heightM", 40.0, 0.0));
  EXPECT_TRUE(m_session->reaches("position", "1"));
}

TEST_F(EditorWindow, SurvivesTinyAndHugeSizes) {
  openSmall();
  for (const auto& [width, height] : {std::pair(200, 100), std::pair(4000, 3000), std::pair(1200, 800)}) {
    m_session->resize(width, height);
    ASSERT_TRUE(m_session->waitUntil([&] { return m_session->number("windowWidth") == width; }, 20.0))
        << width << " x " << height << ", it is " << m_session->number("windowWidth");
  }
  ASSERT_TRUE(settled());
  EXPECT_TRUE(m_session->alive());
}

TEST_F(EditorWindow, AChangeOnDiskIsNoticed) {
  openSmall();
  ASSERT_TRUE(settled());
  project::Project other = smallProject();
  other.patch.plants[0].grass.heightM *= 1.5;
  ASSERT_TRUE(project::save(other, m_file).ok());
  EXPECT_TRUE(m_session->waitUntil([&] { return m_session->number("position") == 1; }, 20.0));
  EXPECT_TRUE(m_session->reaches("modified", "false"));
}

TEST_F(EditorWindow, AFailedSaveSaysSoAndLosesNothing) {
  openSmall();
  ASSERT_TRUE(m_session->drag("field:patch.plants[0].grass.heightM", 40.0, 0.0));
  // The folder is gone: nothing can be written there, not even by root.
  fs::rename(m_file, m_home / "kept.sward");
  fs::create_directory(m_file);
  m_session->key("ctrl+s");
  ASSERT_TRUE(m_session->waitForItem("dialog:close"));
  EXPECT_TRUE(m_session->reaches("modified", "true"));
  m_session->click("dialog:close");
  EXPECT_TRUE(m_session->reaches("position", "1"));
}

TEST(EditorStart, WithoutADisplayItSaysSo) {
  const std::string command = std::string("env -u DISPLAY -u WAYLAND_DISPLAY ") + SWARD_BINARY +
                              " edit > /dev/null 2> " + (fs::temp_directory_path() / "sward-no-display.txt").string();
  const int status = std::system(command.c_str());
  EXPECT_EQ(WEXITSTATUS(status), 1);
  const std::string text = base::readTextFile(fs::temp_directory_path() / "sward-no-display.txt").value();
  EXPECT_NE(text.find("DISPLAY"), std::string::npos) << text;
  EXPECT_NE(text.find("sward render"), std::string::npos) << text;
}

}  // namespace
}  // namespace sward
