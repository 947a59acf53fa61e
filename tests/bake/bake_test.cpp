#include "bake/bake.h"

#include "bake/payload.h"
#include "bake/plants.h"
#include "mesh/gltf_write.h"

#include "bake/small_project.h"
#include "bake/temporary_folder.h"

#include "mesh/procedural.h"
#include "project/presets.h"

#include <fstream>
#include <functional>
#include <map>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace sward::bake {
namespace {

using project::Project;
using sward::test::TemporaryFolder;
using test::smallProject;
using State = NodeReport::State;

struct Baked {
  std::shared_ptr<const GroundBake> ground;
  BakeReport report;
};

Baked bakeWith(Baker& baker, const Project& project, const JobContext& job = {}) {
  Baked baked;
  auto ground = baker.ground(project, job, &baked.report);
  EXPECT_TRUE(ground.ok()) << (ground.ok() ? "" : ground.error().text());
  if (ground.ok()) baked.ground = *ground;
  return baked;
}

Baked bakeFrom(const std::filesystem::path& folder, const Project& project) {
  Baker baker(DiskCache::open(folder).value());
  return bakeWith(baker, project);
}

std::uint64_t rays(const BakeReport& report) {
  return report.raysNearest + report.raysOcclusion;
}

/// How many nodes of each kind were baked.
std::map<std::string, int> bakedKinds(const BakeReport& report) {
  std::map<std::string, int> kinds;
  for (const NodeReport& node : report.nodes) {
    if (node.state == State::Baked) ++kinds[node.kind];
  }
  return kinds;
}

/// A cache filled with the small project, shared by the tests that edit it.
class BakeGraph : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    s_folder = std::make_unique<TemporaryFolder>("bake");
    s_first = bakeFrom(s_folder->path(), smallProject());
  }
  static void TearDownTestSuite() {
    s_folder.reset();
    s_first = {};
  }
  /// Bakes an edited project on a copy of that cache.
  static Baked rebake(const std::function<void(Project&)>& edit) {
    const TemporaryFolder copy("bake-copy");
    std::filesystem::copy(s_folder->path(), copy.path(), std::filesystem::copy_options::recursive);
    Project project = smallProject();
    edit(project);
    return bakeFrom(copy.path(), project);
  }
  static std::unique_ptr<TemporaryFolder> s_folder;
  static Baked s_first;
};
std::unique_ptr<TemporaryFolder> BakeGraph::s_folder;
Baked BakeGraph::s_first;

TEST_F(BakeGraph, AFirstBakeMakesEverything) {
  const auto kinds = bakedKinds(s_first.report);
  EXPECT_EQ(kinds.at("hits"), 6);
  EXPECT_EQ(kinds.at("luminance"), 36);
  EXPECT_EQ(kinds.at("visibility"), 6);
  EXPECT_EQ(kinds.at("fit"), 7) << "one a layer set, and one for the seams";
  EXPECT_EQ(kinds.at("stack"), 6);
  EXPECT_EQ(kinds.at("tiles"), 1);
  EXPECT_EQ(kinds.at("ground"), 1);
  EXPECT_GT(s_first.report.raysNearest, 0u);
  EXPECT_GT(s_first.report.raysOcclusion, 0u);
  EXPECT_TRUE(s_first.report.warnings.empty());
}

TEST_F(BakeGraph, TheGroundHoldsWhatItShould) {
  const GroundBake& ground = *s_first.ground;
  EXPECT_EQ(ground.tiles.tiles.size(), 18u);
  EXPECT_EQ(ground.slices.images, 18);
  EXPECT_EQ(ground.slices.width, 20);
  EXPECT_EQ(ground.slices.layers, 4);
  EXPECT_EQ(ground.slices.channels, 2);
  EXPECT_EQ(ground.soil.images, 18);
  EXPECT_EQ(ground.soil.layers, 1);
  EXPECT_EQ(ground.soil.channels, 1);
  EXPECT_EQ(ground.soil.basis, lpt::Basis::Ptm);
  EXPECT_TRUE(ground.soil.transmission.empty());
  for (const auto& blade : ground.blades) {
    EXPECT_EQ(blade.width, 32);
    EXPECT_EQ(blade.height, 16);
    EXPECT_EQ(blade.layers, 8);
    EXPECT_EQ(blade.images, 1);
  }
  EXPECT_EQ(ground.map.tiles.size(), 200u);
  EXPECT_GT(ground.heightM, 0.1);
  EXPECT_LT(ground.heightM, 1.0);
  int covered = 0;
  for (std::size_t t = 0; t < ground.slices.texelCount(); ++t) covered += ground.slices.surface[t * 4 + 3] > 0 ? 1 : 0;
  EXPECT_GT(covered, static_cast<int>(ground.slices.texelCount() / 20));
  EXPECT_LT(covered, static_cast<int>(ground.slices.texelCount()));
}

TEST_F(BakeGraph, TilesJoinThroughTheirAprons) {
  const GroundBake& ground = *s_first.ground;
  const lpt::LayerStack& slices = ground.slices;
  const int size = ground.tiles.resolution, apron = ground.tiles.apron;
  const auto column = [&](std::size_t tile, int x, int y) {
    const auto side = static_cast<std::size_t>(slices.width);
    return (tile * side + static_cast<std::size_t>(y + apron)) * side + static_cast<std::size_t>(x + apron);
  };
  int compared = 0;
  for (std::size_t a = 0; a < ground.tiles.tiles.size(); ++a) {
    for (std::size_t b = 0; b < ground.tiles.tiles.size(); ++b) {
      if (ground.tiles.tiles[a].edges[tiles::kEast] != ground.tiles.tiles[b].edges[tiles::kWest]) continue;
      // The first texel across the middle of the edge is the neighbour's own.
      const std::size_t mine = column(a, size, size / 2), theirs = column(b, 0, size / 2);
      for (std::size_t j = 0; j < 20; ++j) {
        ASSERT_EQ(slices.coefficients[mine * 20 + j], slices.coefficients[theirs * 20 + j]) << a << ' ' << b;
      }
      ++compared;
    }
  }
  EXPECT_GT(compared, 18);
}

TEST_F(BakeGraph, ASecondBakeDoesNothing) {
  const Baked again = bakeFrom(s_folder->path(), smallProject());
  EXPECT_TRUE(bakedKinds(again.report).empty());
  EXPECT_EQ(rays(again.report), 0u);
  int touched = 0;
  for (const NodeReport& node : again.report.nodes) touched += node.state != State::Skipped ? 1 : 0;
  EXPECT_EQ(touched, 1) << "a warm start reads one entry";
  EXPECT_EQ(payloadOf(*again.ground), payloadOf(*s_first.ground));
}

TEST_F(BakeGraph, AWarmBakerReadsNoFile) {
  Baker baker(DiskCache::open(s_folder->path()).value());
  bakeWith(baker, smallProject());
  const Baked again = bakeWith(baker, smallProject());
  EXPECT_EQ(again.report.nodes.back().kind, "ground");
  EXPECT_EQ(again.report.nodes.back().state, State::FromMemory);
}

TEST_F(BakeGraph, SunViewsRenderingAndOutputBakeNothing) {
  const Baked again = rebake([](Project& p) {
    p.name = "another";
    p.sun.angles = {10.0, 80.0};
    p.sun.intensity = 2.0;
    p.sky.turbidity = 5.0;
    p.views.push_back({"other", {1, 2, 3}, {0, 0, 0}, 50.0, 1.0});
    p.render.method = render::GroundMethod::BlendedPaper;
    p.render.samples = 3;
    p.output.width = 64;
    p.patch.plants[0].name = "renamed";
  });
  EXPECT_TRUE(bakedKinds(again.report).empty());
  EXPECT_EQ(rays(again.report), 0u);
}

class BakeColourEdit : public BakeGraph, public testing::WithParamInterface<int> {};

TEST_P(BakeColourEdit, TracesNoRay) {
  const std::vector<std::function<void(Project&)>> edits{
      [](Project& p) {
        p.patch.plants[0].grass.tipColour = {0.3, 0.1, 0.05};
      },
      [](Project& p) { p.patch.plants[0].grass.rootColour.y = 0.2; },
      [](Project& p) { p.patch.plants[0].grass.colourVariation = 0.4; },
      [](Project& p) { p.patch.plants[0].grass.optics.translucency = 0.1; },
      [](Project& p) {
        p.patch.plants[0].grass.colourAlong = base::Curve::fromPoints({{0.0, 1.0}, {0.5, 0.0}, {1.0, 1.0}}).value();
      },
      [](Project& p) {
        p.patch.plants[1].flower.petalColour = {0.8, 0.1, 0.1};
      },
      [](Project& p) {
        p.patch.soil.colour = {0.3, 0.25, 0.2};
      }};
  const auto edit = edits[static_cast<std::size_t>(GetParam())];
  const Baked again = rebake(edit);
  EXPECT_EQ(rays(again.report), 0u);
  const auto kinds = bakedKinds(again.report);
  for (const char* untouched : {"hits", "luminance", "visibility", "fit"}) {
    EXPECT_FALSE(kinds.contains(untouched)) << untouched;
  }
  EXPECT_TRUE(kinds.contains("surface"));
  // The shortcut must not change the result: the same as a bake from nothing.
  Project project = smallProject();
  edit(project);
  Baker fresh;
  const Baked whole = bakeWith(fresh, project);
  EXPECT_EQ(payloadOf(*again.ground), payloadOf(*whole.ground));
  EXPECT_NE(payloadOf(*again.ground), payloadOf(*s_first.ground));
}

TEST_F(BakeGraph, AHeightCurveIsGeometry) {
  const Baked again = rebake([](Project& p) {
    p.patch.plants[0].grass.heightDistribution = base::Curve::fromPoints({{0.5, 0.0}, {1.0, 1.0}, {1.5, 0.0}}).value();
  });
  EXPECT_GT(rays(again.report), 0u);
  EXPECT_TRUE(bakedKinds(again.report).contains("hits"));
}

INSTANTIATE_TEST_SUITE_P(All, BakeColourEdit, testing::Range(0, 7));

TEST_F(BakeGraph, OneChangedLightIsTracedAlone) {
  const auto edit = [](Project& p) { p.lights.directions[2] = {80.0, 30.0}; };
  const Baked again = rebake(edit);
  EXPECT_EQ(again.report.raysNearest, 0u);
  EXPECT_GT(again.report.raysOcclusion, 0u);
  for (const NodeReport& node : again.report.nodes) {
    if (node.kind != "luminance") continue;
    const bool changed = node.what.ends_with("light 3");
    EXPECT_EQ(node.state, changed ? State::Baked : State::FromDisk) << node.what;
  }
  const auto kinds = bakedKinds(again.report);
  EXPECT_EQ(kinds.at("luminance"), 6) << "one a layer set";
  EXPECT_FALSE(kinds.contains("hits"));
  EXPECT_FALSE(kinds.contains("visibility"));
  Project project = smallProject();
  edit(project);
  Baker fresh;
  EXPECT_EQ(payloadOf(*again.ground), payloadOf(*bakeWith(fresh, project).ground));
}

TEST_F(BakeGraph, FitOptionsOnlyFitAgain) {
  for (const bool solve : {true, false}) {
    const Baked again = rebake([&](Project& p) {
      if (solve) {
        p.fit.layerRidge = 0.1;
      } else {
        p.fit.bits = 16;
      }
    });
    EXPECT_EQ(rays(again.report), 0u);
    EXPECT_EQ(bakedKinds(again.report).contains("fit"), solve);
    EXPECT_EQ(again.ground->slices.bits, solve ? 8 : 16);
  }
}

TEST_F(BakeGraph, TileOptionsOnlyCutAgain) {
  const Baked again = rebake([](Project& p) { p.tiles.overlap = 2; });
  EXPECT_EQ(rays(again.report), 0u);
  const auto kinds = bakedKinds(again.report);
  EXPECT_TRUE(kinds.contains("tiles"));
  EXPECT_FALSE(kinds.contains("fit"));
}

TEST_F(BakeGraph, GeometryIsTracedAgain) {
  const std::vector<std::function<void(Project&)>> edits{
      [](Project& p) { p.patch.plants[0].grass.heightM = 0.21; },
      [](Project& p) { p.patch.seed = 2; },
      [](Project& p) { p.patch.plants[1].share = 0.3; },
      [](Project& p) { p.sampling.seed = 2; },
      [](Project& p) { p.patch.plants[0].tiltDeg = 9.0; },
      [](Project& p) { p.patch.plants[0].grass.profile = base::Curve::constant(0.5); }};
  for (std::size_t i = 0; i < edits.size(); ++i) {
    const auto kinds = bakedKinds(rebake(edits[i]).report);
    EXPECT_TRUE(kinds.contains("hits")) << "edit " << i;
  }
}

TEST_F(BakeGraph, ADamagedEntryIsMadeAgain) {
  const TemporaryFolder copy("bake-damaged");
  std::filesystem::copy(s_folder->path(), copy.path(), std::filesystem::copy_options::recursive);
  for (const auto& item : std::filesystem::recursive_directory_iterator(copy.path())) {
    if (item.is_regular_file()) std::filesystem::resize_file(item.path(), item.file_size() / 2);
  }
  const Baked again = bakeFrom(copy.path(), smallProject());
  EXPECT_EQ(payloadOf(*again.ground), payloadOf(*s_first.ground));
  EXPECT_EQ(bakedKinds(again.report).at("hits"), 6);
}

TEST(Bake, GivesTheSameBytesOnAnyNumberOfThreads) {
  std::vector<std::byte> first;
  for (const int threads : {1, 2, 4}) {
    Baker baker;
    JobContext job;
    job.threads = threads;
    const auto bytes = payloadOf(*bakeWith(baker, smallProject(), job).ground);
    if (first.empty()) first = bytes;
    EXPECT_EQ(bytes, first) << threads << " threads";
  }
}

TEST(Bake, PtmIsBakedToo) {
  Project project = smallProject();
  project.fit.basis = lpt::Basis::Ptm;
  Baker baker;
  const Baked baked = bakeWith(baker, project);
  EXPECT_EQ(baked.ground->slices.basis, lpt::Basis::Ptm);
  EXPECT_EQ(baked.ground->slices.coefficients.size(), baked.ground->slices.texelCount() * 2 * 6);
  EXPECT_EQ(bakedKinds(baked.report).at("fit"), 7) << "seams compare LPT columns whatever is drawn";
}

TEST(Bake, BareSoilIsAGround) {
  Project project = smallProject();
  project.patch.plants.clear();
  Baker baker;
  const Baked baked = bakeWith(baker, project);
  ASSERT_NE(baked.ground, nullptr);
  EXPECT_GT(baked.ground->heightM, 0.0);
  EXPECT_LT(baked.ground->heightM, 0.05);
  for (std::size_t t = 0; t < baked.ground->slices.texelCount(); ++t) {
    ASSERT_EQ(baked.ground->slices.surface[t * 4 + 3], 0);
  }
  // Nothing shades it: lit from straight above, Lambert's white gives 1.
  float values[6] = {};
  lpt::dequantise(baked.ground->soil, 0, lpt::kReflected, values);
  EXPECT_NEAR(values[5], 1.0, 0.1);
}

TEST(Bake, CancelledAtAnyMomentKeepsNoDamage) {
  const TemporaryFolder folder("bake-cancel");
  const auto expected = [] {
    Baker baker;
    return payloadOf(*bakeWith(baker, smallProject()).ground);
  }();
  int cancelled = 0;
  for (int moment = 0; moment < 60; moment += 7) {
    Baker baker(DiskCache::open(folder.path()).value());
    std::stop_source stop;
    int calls = 0;
    JobContext job{stop.get_token(),
                   [&](const std::string&, double) {
                     if (++calls > moment) stop.request_stop();
                   },
                   2};
    const auto ground = baker.ground(smallProject(), job);
    if (!ground.ok()) {
      EXPECT_EQ(ground.error().kind, ErrorKind::Cancelled);
      ++cancelled;
    }
  }
  EXPECT_GT(cancelled, 0);
  const Baked after = bakeFrom(folder.path(), smallProject());
  EXPECT_EQ(payloadOf(*after.ground), expected);
}

TEST(Bake, ProgressRisesToOne) {
  Baker baker;
  double last = 0.0;
  bool falls = false;
  JobContext job;
  job.threads = 1;
  job.onProgress = [&](const std::string& stage, double fraction) {
    EXPECT_FALSE(stage.empty());
    falls = falls || fraction < last - 1e-9;
    last = fraction;
  };
  bakeWith(baker, smallProject(), job);
  EXPECT_GT(last, 0.5);
  EXPECT_LE(last, 1.0);
}

TEST(Bake, AnInvalidProjectIsAnError) {
  Project project = smallProject();
  project.sampling.slices = 0;
  Baker baker;
  const auto ground = baker.ground(project, {});
  ASSERT_FALSE(ground.ok());
  EXPECT_EQ(ground.error().kind, ErrorKind::BadInput);
  EXPECT_EQ(ground.error().where, "sampling.slices");
}

TEST(Bake, AFullDiskIsReportedAndTheBakeGoesOn) {
  const TemporaryFolder folder("bake-full");
  for (const char* kind : {"hits", "fit", "ground"}) {
    // A file where the kind's folder should be: nothing can be stored below it, whoever runs the test.
    std::ofstream(folder.path() / kind) << "x";
  }
  const Baked baked = bakeFrom(folder.path(), smallProject());
  ASSERT_NE(baked.ground, nullptr);
  EXPECT_EQ(baked.report.warnings.size(), 1u);
}

TEST(Bake, AnAssetEntersByItsBytes) {
  const TemporaryFolder folder("bake-asset");
  Project project = smallProject();
  project.folder = folder.path();
  mesh::GrassShape shape;
  shape.segments = 2;
  project::Plant plant;
  plant.kind = project::PlantKind::Gltf;
  plant.gltf.path = "tuft.glb";
  plant.densityPerM2 = 100;
  project.patch.plants = {plant};
  ASSERT_TRUE(mesh::writeGlb(folder.path() / "tuft.glb", mesh::growGrass(shape, 1)).ok());
  const Baked first = bakeFrom(folder.path() / "cache", project);
  ASSERT_TRUE(mesh::writeGlb(folder.path() / "same.glb", mesh::growGrass(shape, 1)).ok());
  Project renamed = project;
  std::filesystem::rename(folder.path() / "same.glb", folder.path() / "tuft.glb");
  EXPECT_TRUE(bakedKinds(bakeFrom(folder.path() / "cache", renamed).report).empty()) << "same bytes, written again";
  ASSERT_TRUE(mesh::writeGlb(folder.path() / "tuft.glb", mesh::growGrass(shape, 2)).ok());
  EXPECT_TRUE(bakedKinds(bakeFrom(folder.path() / "cache", project).report).contains("hits"));
  // A new base colour is a colour edit also for a mesh that brought its own.
  Project tinted = project;
  tinted.patch.plants[0].gltf.material = mesh::MaterialOverride{glm::dvec3(0.5, 0.1, 0.1), {}, {}};
  bakeFrom(folder.path() / "cache", tinted);
  tinted.patch.plants[0].gltf.material->baseColour = glm::dvec3(0.1, 0.5, 0.1);
  const Baked recoloured = bakeFrom(folder.path() / "cache", tinted);
  EXPECT_EQ(rays(recoloured.report), 0u);
  EXPECT_TRUE(bakedKinds(recoloured.report).contains("surface"));
}

TEST(BakePayload, DamagedGroundsAreRefused) {
  Baker baker;
  const auto bytes = payloadOf(*bakeWith(baker, smallProject()).ground);
  EXPECT_TRUE(fromPayload<GroundBake>(bytes).has_value());
  for (std::size_t cut = 0; cut < bytes.size(); cut += 1 + bytes.size() / 400) {
    EXPECT_FALSE(fromPayload<GroundBake>(std::span(bytes).first(cut)).has_value()) << cut;
  }
}

TEST(Plants, EveryVariantDiffers) {
  const Project project = smallProject();
  const auto a = plantModel(project, 0, 0).value(), b = plantModel(project, 0, 1).value();
  EXPECT_NE(a.positions, b.positions);
  EXPECT_NEAR(plantCount(project, 0), 300 * 0.16 * 0.8, 1e-9);
}

TEST(Plants, EveryPresetGrows) {
  for (const project::PlantPreset& preset : project::plantPresets()) {
    Project project = smallProject();
    project.patch.plants = {preset.plant};
    double height = 0.0;
    for (int variant = 0; variant < variantCount(preset.plant); ++variant) {
      const auto model = plantModel(project, 0, variant);
      ASSERT_TRUE(model.ok()) << preset.name;
      EXPECT_GT(model->triangles.size(), 20u) << preset.name;
      EXPECT_LT(model->triangles.size(), 3000u) << preset.name;  // thousands of them are traced
      height = std::max(height, static_cast<double>(mesh::bounds(*model).high.z));
    }
    EXPECT_GT(height, 0.03) << preset.name;
    EXPECT_LT(height, 1.0) << preset.name;
  }
}

TEST(Plants, ColoursDoNotMoveGeometry) {
  const Project project = smallProject();
  Project recoloured = project;
  recoloured.patch.plants[0].grass.colourVariation = 0.0;
  recoloured.patch.plants[0].grass.tipColour = {0.9, 0.1, 0.4};
  recoloured.patch.plants[0].grass.colourAlong = base::Curve::constant(0.25);
  recoloured.patch.plants[0].grass.seedHeadShare = project.patch.plants[0].grass.seedHeadShare;
  recoloured.patch.plants[1].flower.colourVariation = 0.0;
  for (std::size_t plant = 0; plant < 2; ++plant) {
    const auto a = plantModel(project, plant, 0).value(), b = plantModel(recoloured, plant, 0).value();
    EXPECT_EQ(a.positions, b.positions);
    EXPECT_EQ(a.triangles, b.triangles);
    EXPECT_NE(a.colours, b.colours);
  }
}

}  // namespace
}  // namespace sward::bake
