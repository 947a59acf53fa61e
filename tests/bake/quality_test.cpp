#include "bake/quality.h"

#include "bake/bake.h"
#include "bake/payload.h"

#include "bake/small_project.h"
#include "bake/temporary_folder.h"

#include <cmath>
#include <functional>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace sward::bake {
namespace {

using project::Project;
using sward::test::TemporaryFolder;
using test::smallProject;
using State = NodeReport::State;

/// Large enough to be divided by four.
Project divisibleProject() {
  Project project = smallProject();
  project.sampling.sliceResolution = 64;
  project.sampling.slices = 8;
  project.sampling.bladeWidth = 128;
  project.sampling.bladeHeight = 32;
  project.tiles.resolution = 32;
  project.tiles.overlap = 6;
  project.tiles.apron = 4;
  return project;
}

std::shared_ptr<const GroundBake> bakeAt(Baker& baker, const GroundRequest& request, BakeReport* report = nullptr,
                                         int threads = 0) {
  auto ground = baker.ground(request, {{}, {}, threads}, report);
  EXPECT_TRUE(ground.ok()) << (ground.ok() ? "" : ground.error().text());
  return ground.ok() ? *ground : nullptr;
}

std::uint64_t rays(const BakeReport& report) {
  return report.raysNearest + report.raysOcclusion;
}

class EachQuality : public testing::TestWithParam<Quality> {};
INSTANTIATE_TEST_SUITE_P(All, EachQuality, testing::Values(Quality::Coarse, Quality::Half, Quality::Full),
                         [](const auto& quality) { return std::string(qualityName(quality.param)); });

TEST_P(EachQuality, StaysValidAndKeepsTheTilesSize) {
  Project odd = smallProject();
  odd.tiles.resolution = 8;
  odd.tiles.overlap = 2;
  odd.sampling.blades = 8;
  Project ptm = divisibleProject();
  ptm.fit.basis = lpt::Basis::Ptm;
  for (const Project& project : {smallProject(), divisibleProject(), odd, ptm, project::fromTemplate("meadow").value(),
                                 project::fromTemplate("lawn").value(), project::fromTemplate("empty").value()}) {
    ASSERT_TRUE(project::requireValid(project).ok()) << project::requireValid(project).error().text();
    const Project reduced = atQuality(project, GetParam());
    const auto valid = project::requireValid(reduced);
    EXPECT_TRUE(valid.ok()) << valid.error().text();
    EXPECT_DOUBLE_EQ(1.0 * reduced.tiles.resolution / reduced.sampling.sliceResolution,
                     1.0 * project.tiles.resolution / project.sampling.sliceResolution);
    EXPECT_EQ(reduced.sampling.blades, project.sampling.blades);
    EXPECT_EQ(reduced.patch.seed, project.patch.seed);
    EXPECT_EQ(reduced.patch.plants.size(), project.patch.plants.size());
  }
}

TEST(Quality, FullIsTheProjectAndCoarseIsAQuarter) {
  const Project project = divisibleProject();
  EXPECT_EQ(project::toJson(atQuality(project, Quality::Full)), project::toJson(project));
  EXPECT_EQ(atQuality(project, Quality::Half).sampling.sliceResolution, 32);
  EXPECT_EQ(atQuality(project, Quality::Coarse).sampling.sliceResolution, 16);
  EXPECT_EQ(atQuality(project, Quality::Coarse).tiles.resolution, 8);
}

TEST(Quality, CoarseTracesNoRayAndIsTheSameOnAnyNumberOfThreads) {
  const Project project = divisibleProject();
  std::vector<std::byte> first;
  for (const int threads : {1, 2, 4}) {
    Baker baker;
    BakeReport report;
    const auto bytes = payloadOf(*bakeAt(baker, {project, Quality::Coarse}, &report, threads));
    EXPECT_EQ(rays(report), 0u);
    if (first.empty()) first = bytes;
    EXPECT_EQ(bytes, first) << threads << " threads";
  }
}

TEST(Quality, OnlyFullGroundsGoToTheDisk) {
  const TemporaryFolder folder("quality-disk");
  Baker baker(DiskCache::open(folder.path()).value());
  const Project project = smallProject();
  const auto files = [&] {
    int count = 0;
    for (const auto& item : std::filesystem::recursive_directory_iterator(folder.path())) {
      count += item.is_regular_file() ? 1 : 0;
    }
    return count;
  };
  bakeAt(baker, {project, Quality::Coarse});
  bakeAt(baker, {project, Quality::Half});
  EXPECT_EQ(files(), 0);
  bakeAt(baker, {project, Quality::Full});
  EXPECT_GT(files(), 10);
}

TEST_P(EachQuality, ColourEditsTraceNoRayAndFitNothing) {
  Baker baker({}, {std::uint64_t{1} << 30, true});
  Project project = divisibleProject();
  bakeAt(baker, {project, GetParam()});
  const std::vector<std::function<void(Project&)>> edits{
      [](Project& p) { p.patch.plants[0].grass.tipColour.x = 0.4; },
      [](Project& p) { p.patch.plants[1].flower.petalColour.y = 0.3; },
      [](Project& p) { p.patch.soil.colour.z = 0.2; }};
  for (const auto& edit : edits) {
    edit(project);
    EXPECT_TRUE(baker.tracesNothing({project, GetParam()}).value());
    BakeReport report;
    const auto ground = bakeAt(baker, {project, GetParam()}, &report);
    EXPECT_EQ(rays(report), 0u);
    for (const NodeReport& node : report.nodes) {
      const bool light =
          node.kind == "hits" || node.kind == "luminance" || node.kind == "visibility" || node.kind == "fit";
      EXPECT_FALSE(light && node.state == State::Baked) << node.kind << ' ' << node.what;
    }
    Baker fresh;
    EXPECT_EQ(payloadOf(*ground), payloadOf(*bakeAt(fresh, {project, GetParam()}))) << "the shortcut changes nothing";
  }
  project.patch.plants[0].grass.heightM *= 1.01;
  EXPECT_FALSE(baker.tracesNothing({project, GetParam()}).value());
}

TEST(Quality, AKeptLayoutStandsAtEveryQuality) {
  Baker baker;
  const Project project = divisibleProject();
  const std::vector<glm::ivec2> layout = layoutOf(*bakeAt(baker, {project, Quality::Full}));
  ASSERT_EQ(layout.size(), 6u);
  Project edited = project;
  edited.patch.plants[0].grass.heightM *= 1.3;
  for (const Quality quality : {Quality::Coarse, Quality::Half}) {
    const auto kept = bakeAt(baker, {edited, quality, layout});
    EXPECT_EQ(layoutOf(*kept), layout);
    EXPECT_EQ(kept->tiles.tiles.size(), 18u);
    EXPECT_NE(baker.key({edited, quality, layout}).value(), baker.key({edited, quality}).value());
  }
  // One that does not fit is chosen anew.
  EXPECT_EQ(bakeAt(baker, {edited, Quality::Coarse, {{1, 2}}})->tiles.diamonds.size(), 6u);
}

TEST(Quality, HoldsSaysWhatIsInMemoryOrOnDisk) {
  const TemporaryFolder folder("quality-holds");
  const Project project = smallProject();
  {
    Baker baker(DiskCache::open(folder.path()).value());
    const auto key = baker.key({project}).value();
    EXPECT_FALSE(baker.holds(key));
    bakeAt(baker, {project});
    EXPECT_TRUE(baker.holds(key));
  }
  Baker later(DiskCache::open(folder.path()).value());
  EXPECT_TRUE(later.holds(later.key({project}).value()));
  EXPECT_FALSE(later.holds(later.key({project, Quality::Coarse}).value()));
}

/// Mean of what is seen from straight above: the layers of every tile over its soil.
glm::vec3 meanColour(const GroundBake& ground, const lpt::Illumination& light) {
  glm::dvec3 sum(0.0);
  int count = 0;
  const int apron = ground.tiles.apron, size = ground.tiles.resolution;
  for (int tile = 0; tile < ground.slices.images; ++tile) {
    for (int y = apron; y < apron + size; ++y) {
      for (int x = apron; x < apron + size; ++x) {
        glm::vec3 colour(0.0f);
        float through = 1.0f;
        for (int layer = 0; layer < ground.slices.layers; ++layer) {
          const glm::vec4 texel = lpt::relitTexel(ground.slices, tile, layer, x, y, light);
          colour += through * texel.a * glm::vec3(texel);
          through *= 1.0f - texel.a;
        }
        const glm::vec4 soil = lpt::relitTexel(ground.soil, tile, 0, x, y, light);
        sum += glm::dvec3(colour + through * glm::vec3(soil));
        ++count;
      }
    }
  }
  return glm::vec3(sum / static_cast<double>(count));
}

TEST(Quality, CoarseAndHalfHaveTheColoursOfFull) {
  Baker baker;
  Project project = divisibleProject();
  // No flowers: a few white heads more or less, as few columns show them, say nothing about light.
  project.patch.plants.resize(1);
  project.lights = {};  // the usual fifteen: six, as elsewhere in these tests, fit light itself a fifth wrong
  project.patch.sideM = 0.8;
  project.sampling.sliceResolution = 128;
  project.tiles.resolution = 64;
  project.sampling.visibilityDirections = 8;
  const auto full = bakeAt(baker, {project, Quality::Full});
  const std::vector<glm::ivec2> layout = layoutOf(*full);
  const double lowZ = std::sin(0.5), highZ = std::sin(1.1);
  for (const glm::dvec3& sun :
       {glm::dvec3(std::sqrt(1 - lowZ * lowZ), 0.0, lowZ), glm::dvec3(0.0, -std::sqrt(1 - highZ * highZ), highZ)}) {
    const lpt::Illumination light{sun, glm::dvec3(std::numbers::pi), glm::dvec3(0.2)};
    const glm::vec3 expected = meanColour(*full, light);
    for (const Quality quality : {Quality::Coarse, Quality::Half}) {
      const glm::vec3 colour = meanColour(*bakeAt(baker, {project, quality, layout}), light);
      for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(colour[c] / expected[c], 1.0, 0.1) << qualityName(quality) << " channel " << c << " sun " << sun.z;
      }
    }
  }
}

}  // namespace
}  // namespace sward::bake
