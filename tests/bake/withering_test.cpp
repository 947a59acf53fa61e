#include "bake/withering.h"

#include "bake/bake.h"
#include "bake/keys.h"
#include "bake/plants.h"
#include "bake/small_project.h"
#include "bake/texel_baker.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

namespace sward::bake {
namespace {

project::Project texelProject() {
  project::Project project = test::smallProject();
  project.render.method = render::GroundMethod::Texels;
  project.wither.texel.resolution = 32;
  return project;
}

wither::MingleSample sampleOf(const char* name, double share, double density, double own) {
  wither::MingleSample sample;
  sample.name = name;
  sample.share = share;
  sample.density = density;
  sample.ageing = base::Curve::constant(own);
  return sample;
}

double areaOf(const TexelBake& bake) {
  return bake.levels.front().texel->areaM2();
}

/// Means of red over green reflectance, weighted by leaf area: low in green grass, above 1 in straw.
double rednessOf(const TexelBake& bake) {
  double red = 0.0, green = 0.0;
  for (const wither::Voxel& voxel : bake.levels.front().texel->voxels()) {
    red += double{voxel.density} * double{voxel.diffuse.r};
    green += double{voxel.density} * double{voxel.diffuse.g};
  }
  return red / green;
}

double meanHeightM(const TexelBake& bake) {
  const wither::Texel& texel = *bake.levels.front().texel;
  double sum = 0.0, weight = 0.0;
  for (std::size_t i = 0; i < texel.size(); ++i) {
    const double density = double{texel.voxels()[i].density};
    sum += density * (texel.places()[i].z + 0.5) * texel.grid().voxelM().z;
    weight += density;
  }
  return sum / weight;
}

TEST(Withering, PlantsAtRestAreThePlantsThatGrew) {
  const project::Project project = test::smallProject();
  EXPECT_FALSE(withers(project));
  const auto grown = plantModel(project, 0, 1).value(), stands = patchModel(project, 0, 1).value();
  EXPECT_EQ(grown.positions, stands.positions);
  EXPECT_EQ(grown.colours, stands.colours);
}

TEST(Withering, APatchSinksAndYellowsAndKeepsItsPlaces) {
  project::Project project = test::smallProject();
  const scene::Patch fresh = growPatch(project).value();
  project.wither.weathering = 1.0;
  const scene::Patch dry = growPatch(project).value();
  EXPECT_LT(dry.heightM, 0.85 * fresh.heightM);
  ASSERT_EQ(dry.instances.size(), fresh.instances.size());
  for (std::size_t i = 0; i < fresh.instances.size(); ++i) {
    EXPECT_EQ(dry.instances[i].worldFromModel, fresh.instances[i].worldFromModel);
  }
  for (const auto& model : dry.models) {
    for (const glm::vec3& position : model->positions) EXPECT_GE(position.z, -1e-6f);
  }
}

TEST(Withering, SamplesMultiplyTheModelsAndTheirDensities) {
  project::Project project = test::smallProject();
  const std::size_t before = growPatch(project).value().models.size();
  project.wither.mingle = {sampleOf("green", 1.0, 1.0, 0.0), sampleOf("straw", 3.0, 0.5, 1.0)};
  const scene::Patch patch = growPatch(project).value();
  EXPECT_EQ(patch.models.size(), 2 * before);
  EXPECT_DOUBLE_EQ(samplePart(project, 0), 0.25);
  EXPECT_DOUBLE_EQ(samplePart(project, 1), 0.375);
}

TEST(Withering, AGroundIsBakedAnewForAnotherDegreeAlone) {
  Baker baker;
  const project::Project fresh = test::smallProject();
  project::Project aged = fresh, other = fresh;
  aged.wither.weathering = 0.5;
  other.wither.ageing.tipLead = 0.6;  // of no plant that stands as it grew
  const auto key = [&](const project::Project& project) { return baker.key({project, Quality::Full, {}}).value(); };
  EXPECT_EQ(key(fresh), key(other));
  EXPECT_NE(key(fresh), key(aged));
  EXPECT_TRUE(sameGroundValues(fresh, other));
  EXPECT_FALSE(sameGroundValues(fresh, aged));
}

TEST(TexelBaker, AgesWithoutVoxelisingAnew) {
  TexelBaker baker;
  project::Project project = texelProject();
  TexelReport first, second;
  const auto fresh = baker.texels(project, {}, &first).value();
  project.wither.weathering = 1.0;
  const auto dry = baker.texels(project, {}, &second).value();
  EXPECT_GT(first.points, 0u);
  EXPECT_EQ(first.points, second.points);
  // A hash of the values against growing, cutting and drawing points.
  EXPECT_LT(second.restSeconds, first.restSeconds);
  EXPECT_LT(rednessOf(*fresh), 0.9);
  EXPECT_GT(rednessOf(*dry), 1.05);
  // Half of its plants are short, and their blades bend at rest already: the mean sinks by less than the tallest.
  EXPECT_LT(meanHeightM(*dry), 0.9 * meanHeightM(*fresh));
  // Blades shrink: 1 - eps of the area goes with length and width.
  EXPECT_LT(areaOf(*dry), areaOf(*fresh));
  EXPECT_GT(areaOf(*dry), 0.4 * areaOf(*fresh));
}

TEST(TexelBaker, LevelsHalveDownToOneBrick) {
  TexelBaker baker;
  const auto bake = baker.texels(texelProject(), {}).value();
  ASSERT_EQ(bake->levels.size(), 3u);  // 32, 16, 8
  for (std::size_t i = 1; i < bake->levels.size(); ++i) {
    const wither::TexelGrid &fine = bake->levels[i - 1].texel->grid(), &coarse = bake->levels[i].texel->grid();
    EXPECT_EQ(coarse.columns * 2, fine.columns);
    EXPECT_EQ(coarse.layers * 2, fine.layers);
    EXPECT_EQ(bake->levels[i].sky.front.size(), bake->levels[i].texel->size());
  }
  EXPECT_EQ(bake->soil.size(), 32u * 32u);
}

TEST(TexelBaker, GridsOfAnyHeightCanBeHalved) {
  for (const double height : {1e-3, 0.05, 0.3, 0.79, 1.0, 1.7, 40.0}) {
    const wither::TexelGrid grid = texelGridOf(1.0, height, 128);
    ASSERT_TRUE(wither::checkGrid(grid).ok());
    const int bricks = grid.layers / wither::TexelGrid::kBrick;
    EXPECT_EQ(bricks & (bricks - 1), 0) << height;
    if (height < 0.1 || height > 30.0) continue;
    const double stretch = grid.voxelM().z / grid.voxelM().x;
    EXPECT_LE(std::max(stretch, 1.0 / stretch), std::sqrt(2.0) + 1e-9) << height;
  }
}

TEST(TexelBaker, MingledSamplesWeighByTheirDensity) {
  TexelBaker baker;
  project::Project project = texelProject();
  project.wither.mingle = {sampleOf("all", 1.0, 1.0, 0.0)};
  const double one = areaOf(*baker.texels(project, {}).value());
  project.wither.mingle = {sampleOf("all", 1.0, 2.5, 0.0)};
  // Splatting is linear in the points' areas.
  EXPECT_NEAR(areaOf(*baker.texels(project, {}).value()), 2.5 * one, 1e-4 * one);
  project.wither.mingle = {sampleOf("none", 1.0, 0.0, 0.0)};
  const auto none = baker.texels(project, {});
  ASSERT_TRUE(none.ok()) << none.error().text();
  EXPECT_EQ(areaOf(**none), 0.0);
  project.wither.mingle = {sampleOf("green", 1.0, 1.0, 0.0), sampleOf("straw", 1.0, 1.0, 1.0)};
  const double mixed = rednessOf(*baker.texels(project, {}).value());
  project.wither.mingle.pop_back();
  EXPECT_GT(mixed, rednessOf(*baker.texels(project, {}).value()));
}

TEST(TexelBaker, SameBytesOnAnyNumberOfThreads) {
  project::Project project = texelProject();
  project.wither.weathering = 0.4;
  JobContext one, four;
  one.threads = 1;
  four.threads = 4;
  TexelBaker a, b;
  const auto first = a.texels(project, one).value(), second = b.texels(project, four).value();
  const auto x = first->levels.front().texel->voxels(), y = second->levels.front().texel->voxels();
  ASSERT_EQ(x.size(), y.size());
  EXPECT_EQ(std::memcmp(x.data(), y.data(), x.size_bytes()), 0);
}

TEST(TexelBaker, ABareAndACancelledPatch) {
  TexelBaker baker;
  project::Project bare = texelProject();
  bare.patch.plants.clear();
  const auto empty = baker.texels(bare, {});
  ASSERT_TRUE(empty.ok()) << empty.error().text();
  EXPECT_TRUE((*empty)->levels.front().texel->empty());
  std::stop_source stop;
  stop.request_stop();
  JobContext job;
  job.stop = stop.get_token();
  const auto cancelled = baker.texels(texelProject(), job);
  ASSERT_FALSE(cancelled.ok());
  EXPECT_EQ(cancelled.error().kind, ErrorKind::Cancelled);
}

TEST(Baker, GivesTexelsInPlaceOfLayersAndRemembersThem) {
  Baker baker;
  const project::Project project = texelProject();
  const GroundRequest request{project, Quality::Full, {}};
  const auto key = baker.key(request).value();
  EXPECT_FALSE(baker.holds(key));
  BakeReport report;
  const auto ground = baker.ground(request, {}, &report).value();
  ASSERT_TRUE(ground->texels);
  EXPECT_TRUE(ground->slices.surface.empty());
  ASSERT_EQ(report.nodes.size(), 2u);  // what texels are aged from, and the texels
  EXPECT_TRUE(baker.holds(key));
  EXPECT_EQ(baker.ground(request, {}, &report).value(), ground);
  EXPECT_EQ(report.nodes.front().state, NodeReport::State::Skipped);
  EXPECT_EQ(report.nodes.back().state, NodeReport::State::FromMemory);
  const auto coarse = baker.ground({project, Quality::Coarse, {}}, {}).value();
  EXPECT_LE(coarse->texels->grid().columns, ground->texels->grid().columns);
}

}  // namespace
}  // namespace sward::bake
