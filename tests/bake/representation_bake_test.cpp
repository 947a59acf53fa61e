#include "bake/bake.h"
#include "bake/keys.h"
#include "bake/plants.h"
#include "bake/quality.h"

#include "bake/small_project.h"
#include "bake/temporary_folder.h"

#include "scene/sun_sky.h"
#include "trace/layers.h"

#include <map>
#include <string>

#include <gtest/gtest.h>

namespace sward::bake {
namespace {

using project::Project;
using test::smallProject;
using State = NodeReport::State;

Project projectOf(lpt::Basis basis, double azimuthDeg = 150.0) {
  Project project = smallProject();
  project.fit.basis = basis;
  project.sun.byMoment = false;
  project.sun.angles = {azimuthDeg, 40.0};
  return project;
}

std::shared_ptr<const GroundBake> bakeWith(Baker& baker, const Project& project, BakeReport* report = nullptr) {
  const auto ground = baker.ground(project, {}, report);
  EXPECT_TRUE(ground.ok()) << (ground.ok() ? "" : ground.error().text());
  return ground.ok() ? *ground : nullptr;
}

std::map<std::string, int> bakedKinds(const BakeReport& report) {
  std::map<std::string, int> kinds;
  for (const NodeReport& node : report.nodes) {
    if (node.state == State::Baked) ++kinds[node.kind];
  }
  return kinds;
}

TEST(GroundOfRepresentations, TracedLightIsWhatTheTilesHold) {
  const Project project = projectOf(lpt::Basis::Sampled);
  Baker baker;
  const auto ground = bakeWith(baker, project);
  ASSERT_TRUE(ground);
  ASSERT_EQ(ground->slices.basis, lpt::Basis::Constant);
  ASSERT_EQ(ground->slices.bits, 16);
  const auto patch = std::make_shared<const scene::Patch>(growPatch(project).value());
  const auto scene = trace::PatchScene::create(patch).value();
  const auto hits = trace::sampleHits(*scene, trace::LayerSet::Slices, project.sampling, {}).value();
  const auto lit = trace::sampleLuminance(*scene, hits, scene::sunDirection(project.sun).value(), {}).value();
  // Stored twice as 16 bits of at most 1: half a step each, and floats' rounding.
  const float bound = 1.1f / 65535.0f;
  const tiles::TileSet& set = ground->tiles;
  const auto side = static_cast<std::size_t>(set.side());
  int compared = 0;
  for (int tile = 0; tile < 18; ++tile) {
    for (int y = 0; y < set.resolution; ++y) {
      for (int x = 0; x < set.resolution; ++x) {
        const std::uint32_t column = set.patchColumn(tile, x, y);
        for (std::uint32_t t = hits.columnStart[column]; t < hits.columnStart[column + 1]; ++t) {
          const std::size_t plane = static_cast<std::size_t>(tile) * 4 + hits.layer[t];
          const std::size_t texel =
              (plane * side + static_cast<std::size_t>(y + set.apron)) * side + static_cast<std::size_t>(x + set.apron);
          float value = 0.0f;
          lpt::dequantise(ground->slices, texel, lpt::kReflected, std::span(&value, 1));
          EXPECT_NEAR(value, lit.reflected[t], bound);
          lpt::dequantise(ground->slices, texel, lpt::kTransmitted, std::span(&value, 1));
          EXPECT_NEAR(value, lit.transmitted[t], bound);
          ++compared;
        }
      }
    }
  }
  EXPECT_GT(compared, 1000);
}

TEST(GroundOfRepresentations, AnotherSunTracesItsOwnLightAlone) {
  const sward::test::TemporaryFolder folder("sampled");
  {
    Baker baker(DiskCache::open(folder.path()).value());
    ASSERT_TRUE(bakeWith(baker, projectOf(lpt::Basis::Sampled)));
  }
  Baker baker(DiskCache::open(folder.path()).value());
  BakeReport report;
  ASSERT_TRUE(bakeWith(baker, projectOf(lpt::Basis::Sampled, 200.0), &report));
  const auto kinds = bakedKinds(report);
  EXPECT_EQ(kinds.at("luminance"), 6) << "the sun's, of each layer set";
  EXPECT_FALSE(kinds.contains("hits"));
  EXPECT_FALSE(kinds.contains("visibility"));
  EXPECT_FALSE(kinds.contains("tiles"));
  EXPECT_EQ(report.raysNearest, 0u);
}

TEST(GroundOfRepresentations, AnotherSunTracesNothingForAFit) {
  for (const lpt::Basis basis : {lpt::Basis::Hsh, lpt::Basis::Clustered, lpt::Basis::Marched}) {
    SCOPED_TRACE(static_cast<int>(basis));
    const sward::test::TemporaryFolder folder("fitted");
    Baker baker(DiskCache::open(folder.path()).value());
    const auto first = bakeWith(baker, projectOf(basis));
    BakeReport report;
    const auto second = bakeWith(baker, projectOf(basis, 260.0), &report);
    ASSERT_TRUE(first && second);
    EXPECT_NE(first->slices.coefficients, second->slices.coefficients) << "the light has moved";
    EXPECT_EQ(first->slices.surface, second->slices.surface);
    EXPECT_EQ(report.raysNearest + report.raysOcclusion, 0u);
    EXPECT_FALSE(bakedKinds(report).contains("representation"));
  }
}

TEST(GroundOfRepresentations, TheSunBakesNothingForWhatRenderersRelight) {
  for (const lpt::Basis basis : {lpt::Basis::Lpt, lpt::Basis::Ptm, lpt::Basis::Constant}) {
    Baker baker;
    EXPECT_EQ(baker.key({projectOf(basis, 10.0)}).value(), baker.key({projectOf(basis, 300.0)}).value());
    EXPECT_TRUE(sameGroundValues(projectOf(basis, 10.0), projectOf(basis, 300.0)));
  }
  EXPECT_FALSE(sameGroundValues(projectOf(lpt::Basis::Hsh, 10.0), projectOf(lpt::Basis::Hsh, 300.0)));
}

TEST(GroundOfRepresentations, ASunBelowTheHorizonStillBakes) {
  for (const Quality quality : {Quality::Coarse, Quality::Full}) {
    Project project = projectOf(lpt::Basis::Sampled);
    project.sun.angles.elevationDeg = -90.0;
    Baker baker;
    EXPECT_TRUE(baker.ground(GroundRequest{project, quality}, {}).ok());
  }
}

TEST(SliceResolution, ScalesTilesAndBladesAlong) {
  const Project project = smallProject();
  Project finer = project;
  ASSERT_TRUE(setSliceResolution(finer, 64));
  EXPECT_EQ(finer.tiles.resolution, 32);
  EXPECT_EQ(finer.sampling.bladeWidth, 64);
  EXPECT_TRUE(project::requireValid(finer).ok());
  Project coarser = project;
  ASSERT_TRUE(setSliceResolution(coarser, 16));
  EXPECT_EQ(coarser.tiles.resolution, 8);
  EXPECT_TRUE(project::requireValid(coarser).ok());
  for (const int impossible : {0, 7, 48, 8, 1 << 20}) {
    Project same = project;
    EXPECT_FALSE(setSliceResolution(same, impossible)) << impossible;
    EXPECT_EQ(same, project);
  }
}

}  // namespace
}  // namespace sward::bake
