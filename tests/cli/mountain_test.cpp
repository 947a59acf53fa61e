#include "cli/run_program.h"

#include "bake/temporary_folder.h"
#include "image/io.h"
#include "project/project.h"

#include <filesystem>
#include <string>

#include <gtest/gtest.h>

namespace sward {
namespace {

namespace fs = std::filesystem;

/// The withering paper's scene: 6,400 texels of 400 blades, 2.56 million, over a mountain; 120 m of a real heightmap,
/// whose heights are of the sea's level.
project::Project mountain(const fs::path& heightmap) {
  project::Project p = project::Project{};
  project::Plant plant;
  plant.name = "grass";
  plant.densityPerM2 = 400.0 / (1.5 * 1.5);
  plant.variants = 12;
  plant.grass.bladesPerPlant = 1;
  plant.grass.heightM = 0.5;
  plant.grass.widthM = 0.016;
  p.patch.sideM = 1.5;
  p.patch.plants = {plant};
  p.terrain.source = terrain::Source::Heightmap;
  p.terrain.heightmap.path = heightmap.string();
  p.terrain.heightmap.extentXM = 80 * 1.5;
  p.terrain.heightmap.verticalScale = 0.9;
  p.terrain.heightmap.position = {0.0, 0.0, -1494.0};
  p.render.method = render::GroundMethod::Texels;
  p.render.samples = 2;
  p.wither.texel.resolution = 64;
  scene::View view;
  view.name = "main";
  view.position = {-58.0, -70.0, 36.0};
  view.target = {5.0, 10.0, 18.0};
  view.focalLengthMm = 30.0;
  p.views = {view};
  p.output = {160, 90};
  return p;
}

glm::dvec3 meanOf(const image::Image& picture, int fromRow, int toRow) {
  glm::dvec3 sum(0.0);
  for (int y = fromRow; y < toRow; ++y)
    for (int x = 0; x < picture.width; ++x) sum += glm::dvec3(picture.rgb(x, y));
  return sum / static_cast<double>((toRow - fromRow) * picture.width);
}

TEST(Mountain, OfThePaperGoesFromGreenToStraw) {
  const fs::path heightmap = fs::path(SWARD_SHARED_DIR) / "assets" / "terrain" / "hugo_site_filled_76x55.asc";
  if (!fs::exists(heightmap)) GTEST_SKIP() << "no assets";
  const test::TemporaryFolder folder("cli-mountain");
  ASSERT_TRUE(project::save(mountain(fs::absolute(heightmap)), folder.path() / "m.sward").ok());
  glm::dvec3 before(0.0);
  for (const char* degree : {"0", "0.30", "0.917"}) {
    const test::Outcome outcome = test::runProgram(
        folder.path(), {"render", "m.sward", "-o", "m.exr", "--weathering", degree, "--cache", "cache", "-q"});
    ASSERT_EQ(outcome.exitCode, 0) << outcome.err;
    const auto picture = image::readImage(folder.path() / "m.exr");
    ASSERT_TRUE(picture.ok());
    const glm::dvec3 sky = meanOf(*picture, 0, 8), slope = meanOf(*picture, 45, 90);
    EXPECT_GT(sky.b, sky.r) << "the sky stands over the mountain";
    EXPECT_GT(slope.r, 0.0);
    // Green, then redder with every degree; straw is red before green.
    if (before == glm::dvec3(0.0)) {
      EXPECT_GT(slope.g, 1.2 * slope.r);
      EXPECT_GT(slope.g, 2.0 * slope.b);
    } else {
      EXPECT_GT(slope.r / slope.g, before.r / before.g * 1.05) << degree;
    }
    before = slope;
  }
  EXPECT_GT(before.r, before.g);
}

}  // namespace
}  // namespace sward
