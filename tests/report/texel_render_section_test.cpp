#include "report/section_texel_render.h"

#include "bake/bake.h"
#include "bake/small_project.h"
#include "bake/temporary_folder.h"
#include "base/curve.h"
#include "image/metrics.h"
#include "report/example.h"
#include "render/frame_plan.h"
#include "report/recompute.h"
#include "report/speed_views.h"
#include "report/texel_suns.h"
#include "report/texel_truth.h"
#include "report/writer.h"
#include "wither/voxelise.h"

#include <cmath>
#include <map>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace sward::report {
namespace {

using testing::HasSubstr;

TexelRenderSizes smallSizes() {
  TexelRenderSizes sizes;
  sizes.width = 64;
  sizes.height = 36;
  sizes.samples = 8;
  sizes.causeSamples = 2;
  sizes.runs = 1;
  sizes.columns = {32, 16};
  sizes.weatherings = {0.0, 0.7};
  sizes.views = {"down", "45"};
  return sizes;
}

project::Project texelProject() {
  project::Project project = bake::test::smallProject();
  project.render.method = render::GroundMethod::Texels;
  project.wither.texel.resolution = 32;
  return project;
}

TEST(TexelRender, RowsAreWhatThePicturesShow) {
  const sward::test::TemporaryFolder folder("texel_render"), written("texel_render_report");
  const auto context = gpu::Context::create(gpu::Device::Egl);
  ASSERT_TRUE(context.ok()) << context.error().text();
  const project::Project project = bake::test::smallProject();
  const auto measured = measureTexelRender({project, **context, folder.path(), true}, smallSizes(), {});
  ASSERT_TRUE(measured.ok()) << measured.error().text();
  std::map<std::string, int> rows;
  for (const Row& row : measured->rows) {
    ++rows[row.method];
    for (const auto& [name, value] : row.error) EXPECT_TRUE(std::isfinite(value)) << row.method << ' ' << name;
    EXPECT_FALSE(row.reference.empty()) << row.method;
    EXPECT_TRUE(row.numbersAndNames.contains("view") && row.numbersAndNames.contains("weathering"));
    if (!row.timeMs) continue;
    EXPECT_GT(row.error.at("rmse"), 0.0);
    EXPECT_GT(*row.bytesTotal, *row.bytes);
    EXPECT_EQ(row.ratio.has_value(), row.method == "texels");
  }
  // One view of the first degree, two of the last; two levels. Causes at the last degree.
  const std::map<std::string, int> expected{{"texels_sun_behind", 1},
                                            {"texels_sun_across", 1},
                                            {"texels_sun_against", 1},
                                            {"march_sun_behind", 1},
                                            {"march_sun_across", 1},
                                            {"march_sun_against", 1},
                                            {"texels", 6},
                                            {"march", 3},
                                            {"cause_voxels", 2},
                                            {"cause_voxels_without_points", 2},
                                            {"cause_points", 2},
                                            {"cause_highlight", 2},
                                            {"cause_light", 2},
                                            {"cause_sky", 2},
                                            {"cause_sun_disc", 2},
                                            {"cause_bounces", 2}};
  EXPECT_EQ(rows, expected);
  // The reference, each level's and the layers' pictures and differences, the layers' reference; of a view and degree.
  EXPECT_EQ(measured->strips.size(), 3U);
  for (const Strip& strip : measured->strips) EXPECT_EQ(strip.pictures.size(), 8U) << strip.title;

  const auto write = [&](const Section& section) {
    auto staged = StagedReport::stage(written.path(), test::exampleHead(), {section});
    ASSERT_TRUE(staged.ok() && staged->commit().ok());
  };
  write(*measured);
  const auto [code, said] = test::recompute(written.path());
  EXPECT_EQ(code, 0) << said;
  Section wrong = *measured;
  ASSERT_EQ(wrong.rows[0].method, "texels");
  wrong.rows[0].numbersAndNames["relative_bias"] = "0.9";
  wrong.rows[0].numbersAndNames["rmse_without_noise"] = "0.9";
  wrong.rows[0].numbersAndNames["march_ms"] = "0.001";
  wrong.rows[1].bytesTotal = *wrong.rows[0].bytesTotal + 1;
  write(wrong);
  const auto [wrongCode, wrongSaid] = test::recompute(written.path());
  EXPECT_EQ(wrongCode, 1);
  for (const char* what :
       {"relative_bias is", "rmse_without_noise squared is", "ratio is", "bytes do not rise with the columns"}) {
    EXPECT_THAT(wrongSaid, HasSubstr(what));
  }
}

TEST(TexelRender, AProjectThatHasWitheredIsMeasuredAsItIs) {
  const sward::test::TemporaryFolder folder("texel_render");
  const auto context = gpu::Context::create(gpu::Device::Egl);
  ASSERT_TRUE(context.ok()) << context.error().text();
  project::Project project = texelProject();
  project.wither.weathering = 0.45;
  TexelRenderSizes sizes = smallSizes();
  sizes.views = {"45"};
  sizes.causes = false;
  sizes.columns = {32, 16, 12};  // no texel has a level of 12
  const auto measured = measureTexelRender({project, **context, folder.path(), true}, sizes, {});
  ASSERT_TRUE(measured.ok()) << measured.error().text();
  ASSERT_EQ(measured->rows.size(), 3U);
  for (const Row& row : measured->rows) EXPECT_EQ(row.numbersAndNames.at("weathering"), "0.45");
}

TEST(TexelRender, ACancelledJobSaysSo) {
  const sward::test::TemporaryFolder folder("texel_render");
  const auto context = gpu::Context::create(gpu::Device::Egl);
  ASSERT_TRUE(context.ok());
  const project::Project project = bake::test::smallProject();
  std::stop_source stop;
  JobContext job;
  job.stop = stop.get_token();
  job.onProgress = [&](const std::string& stage, double) {
    if (stage.ends_with("view 45")) stop.request_stop();
  };
  const auto measured = measureTexelRender({project, **context, folder.path(), true}, smallSizes(), job);
  ASSERT_FALSE(measured.ok());
  EXPECT_EQ(measured.error().kind, ErrorKind::Cancelled);
}

/// A matt plane is as bright from everywhere: leaves on it make what is left of the phase, and bare soil none.
TEST(TexelRender, TheSunIsMovedRoundTheEye) {
  const sward::test::TemporaryFolder folder("texel_render");
  const auto context = gpu::Context::create(gpu::Device::Egl);
  ASSERT_TRUE(context.ok()) << context.error().text();
  project::Project project = texelProject();
  for (project::Plant& plant : project.patch.plants) plant.densityPerM2 = 0.0;
  project.patch.soil.colourVariation = 0.0;
  bake::Baker baker;
  const auto ground = baker.ground(project, {});
  ASSERT_TRUE(ground.ok()) << ground.error().text();
  const auto daylight = render::daylightOf(project);
  ASSERT_TRUE(daylight.ok());
  auto truth = GroundTruth::create(project, **ground, *daylight, {});
  ASSERT_TRUE(truth.ok()) << truth.error().text();
  auto renderer = render::Renderer::create(**context);
  ASSERT_TRUE(renderer.ok() && (*renderer)->setGround(*ground).ok());
  render::Frame frame;
  frame.camera = *cameraOf({"45", 45.0, 3.0});
  frame.width = 32;
  frame.height = 18;
  frame.options.method = render::GroundMethod::Texels;
  frame.options.macroVariation = frame.options.gridBendM = 0.0;
  const auto rows = sunRows({project, *daylight, 16}, {"texels", **renderer, *truth, frame}, {});
  ASSERT_TRUE(rows.ok()) << rows.error().text();
  ASSERT_EQ(rows->size(), 3U);
  const double elevation = std::stod((*rows)[0].numbersAndNames.at("sun_elevation_deg"));
  // Both lie in one plane with the zenith when the sun is behind or ahead.
  EXPECT_NEAR(std::stod((*rows)[0].numbersAndNames.at("phase_deg")), std::abs(45.0 - elevation), 0.01);
  EXPECT_NEAR(std::stod((*rows)[2].numbersAndNames.at("phase_deg")), 135.0 - elevation, 0.01);
  // Noise of the sky's light; the soil's colour is kept to 10 bits of its root.
  for (const Row& row : *rows) EXPECT_NEAR(std::stod(row.numbersAndNames.at("relative_bias")), 0.0, 0.02) << row.method;
}

/// Of all leaves that a texel holds: area, and the area-weighted mean of the height and of the reflectance.
struct Leaves {
  double area = 0.0, height = 0.0;
  glm::dvec3 colour{0.0};
};
Leaves leavesOf(const wither::Texel& texel) {
  Leaves leaves;
  const double volume = texel.grid().voxelVolumeM3();
  for (std::size_t i = 0; i < texel.size(); ++i) {
    const double area = volume * double{texel.voxels()[i].density};
    leaves.area += area;
    leaves.height += area * (texel.places()[i].z + 0.5) * texel.grid().voxelM().z;
    leaves.colour += area * glm::dvec3(texel.voxels()[i].diffuse);
  }
  leaves.height /= leaves.area;
  leaves.colour /= leaves.area;
  return leaves;
}

/// The reference's blades must be those that the texel was made from, withered alike: another season, other delays or a
/// sample of the mingling too many would show in height and colour.
TEST(TexelTruth, BladesAreThoseOfTheTexel) {
  for (const double weathering : {0.0, 0.5, 1.0}) {
    project::Project project = texelProject();
    project.wither.weathering = weathering;
    project.wither.texel.proportion = 60.0;
    project.patch.plants[0].grass.segments = 12;  // meshes age at their vertices, points where they are
    wither::MingleSample late, early;
    late.ageing = base::Curve::constant(0.5 * weathering);
    early.share = 0.5;
    project.wither.mingle = {late, early};
    bake::Baker baker;
    const auto ground = baker.ground(project, {});
    ASSERT_TRUE(ground.ok()) << ground.error().text();
    const auto blades = witheredBlades(project);
    ASSERT_TRUE(blades.ok()) << blades.error().text();
    const auto direct = wither::voxelise(*blades, (*ground)->texels->grid(), nullptr, {});
    ASSERT_TRUE(direct.ok()) << direct.error().text();
    const Leaves points = leavesOf(*(*ground)->texels->levels.front().texel);
    const Leaves meshes = leavesOf(direct->texel);
    // The splat's Gaussian is 0.6 of a voxel of 6 mm; what it carries under the ground is lost or lifted.
    const double voxel = (*ground)->texels->grid().voxelM().z;
    EXPECT_NEAR(points.height, meshes.height, 0.1 * voxel) << weathering;
    EXPECT_NEAR(points.area / meshes.area, 1.0, 0.02) << weathering;
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(points.colour[c] / meshes.colour[c], 1.0, 0.04) << weathering;
  }
}

TEST(TexelTruth, CoarserGroundsDrawTheLevelsThatAreLeft) {
  bake::Baker baker;
  const auto ground = baker.ground(texelProject(), {});
  ASSERT_TRUE(ground.ok()) << ground.error().text();
  EXPECT_EQ(coarserGround(*ground, 32), *ground);
  EXPECT_EQ(coarserGround(*ground, 64), nullptr);
  const auto coarse = coarserGround(*ground, 16);
  ASSERT_NE(coarse, nullptr);
  const bake::TexelBake &whole = *(*ground)->texels, &rest = *coarse->texels;
  EXPECT_EQ(rest.levels.size() + 1, whole.levels.size());
  EXPECT_EQ(rest.levels.front().texel, whole.levels[1].texel);
  ASSERT_EQ(rest.soil.size(), 16U * 16U);
  const glm::vec3 mean = (whole.soil[2] + whole.soil[3] + whole.soil[34] + whole.soil[35]) / 4.0f;
  EXPECT_NEAR(rest.soil[1].g, mean.g, 1e-6f);
  EXPECT_LT(bytesOf(rest).total, bytesOf(whole).total);
  const auto dull = dullGround(**ground, {});
  const wither::Texel& level = *dull->texels->levels.front().texel;
  ASSERT_EQ(level.size(), whole.levels.front().texel->size());
  for (std::size_t i = 0; i < level.size(); i += 97) {
    EXPECT_EQ(level.voxels()[i].specular, 0.0f);
    EXPECT_EQ(level.voxels()[i].density, whole.levels.front().texel->voxels()[i].density);
    EXPECT_EQ(level.places()[i], whole.levels.front().texel->places()[i]);
  }
}

}  // namespace
}  // namespace sward::report
