#include "live/reference_service.h"

#include "bake/bake.h"
#include "bake/ground_plan.h"
#include "bake/plants.h"
#include "bake/small_project.h"
#include "bake/soil.h"
#include "render/display.h"
#include "render/frame_plan.h"
#include "trace/reference.h"

#include <gtest/gtest.h>

#include <chrono>
#include <ctime>
#include <functional>
#include <memory>
#include <thread>

namespace sward::editor {
namespace {

using Ground = std::shared_ptr<const bake::GroundBake>;
using ProjectPtr = std::shared_ptr<const project::Project>;

constexpr int kSamples = 12;

ProjectPtr with(const ProjectPtr& project, const std::function<void(project::Project&)>& change) {
  auto changed = std::make_shared<project::Project>(*project);
  change(*changed);
  return changed;
}

/// A meadow that is baked once for all tests.
class ReferenceServiceTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    s_project = std::make_shared<const project::Project>(bake::test::smallProject());
    s_ground = bakeOf(s_project);
  }
  static void TearDownTestSuite() {
    s_project.reset();
    s_ground.reset();
  }
  static Ground bakeOf(const ProjectPtr& project) {
    auto ground = bake::Baker().ground(*project, JobContext{});
    EXPECT_TRUE(ground.ok()) << (ground.ok() ? "" : ground.error().text());
    return ground.ok() ? *ground : nullptr;
  }
  static ReferenceRequest request(int width = 61, int height = 40) {
    ReferenceRequest request{s_project, s_ground, s_project, {}, width, height};
    request.view.position = {0.1, -1.2, 0.5};
    request.view.target = {0.1, 0.4, 0.05};
    return request;
  }
  static ReferenceService::Options few() { return {.threads = 1, .samples = kSamples, .onChanged = {}}; }

  /// Polls until `done` holds; no wait of a test is longer than a hang.
  static bool waitUntil(const std::function<bool()>& done) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
    while (!done()) {
      if (std::chrono::steady_clock::now() > end) return false;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return true;
  }
  static bool rest(const ReferenceService& service) {
    return waitUntil([&] { return !service.status().running; });
  }

  static ProjectPtr s_project;
  static Ground s_ground;
};
ProjectPtr ReferenceServiceTest::s_project;
Ground ReferenceServiceTest::s_ground;

/// What the service should have traced.
ReferencePicture directly(const ReferenceRequest& request, int width, int height, int samples) {
  const project::Project& project = *request.project;
  auto grown = std::make_shared<const scene::Patch>(bake::growPatch(*request.planted).value());
  const auto patch = trace::PatchScene::create(grown).value();
  const trace::GroundPlan plan = bake::groundPlan(*request.ground);
  const scene::Daylight daylight = render::daylightOf(project).value();
  const render::Frame frame = render::planFrame(project, request.view, daylight).value();
  trace::ReferenceOptions options;
  options.width = width;
  options.height = height;
  options.exposure = frame.exposure;
  options.gridBendM = project.render.gridBendM;
  const auto reference =
      trace::Reference::create({patch.get(), &plan, bake::soilColours(project, plan.patchTexels).value(), daylight,
                                project.sky.hazeKm, std::nullopt},
                               frame.camera, options)
          .value();
  EXPECT_TRUE(reference->addSamples(samples, {}).ok());
  const render::ViewTransform transform = project.render.viewTransform;
  const image::Image mean = reference->mean();
  return {image::toBytes(render::toDisplay(mean, transform)), false, samples,
          render::displayNoise(mean, reference->variance(), transform)};
}

/// Seconds of processor time that this process has had, on all its threads: waiting costs none, whatever else runs.
double processorSeconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

TEST_F(ReferenceServiceTest, GrowsToTheReferenceItselfAndThenRests) {
  std::vector<std::shared_ptr<const ReferencePicture>> seen;
  ReferenceService service(few());
  service.request(request());
  ASSERT_TRUE(waitUntil([&] {
    auto picture = service.picture();
    if (picture && (seen.empty() || picture != seen.back())) seen.push_back(picture);
    return !service.status().running;
  }));
  ASSERT_FALSE(seen.empty());
  for (std::size_t i = 1; i < seen.size(); ++i) {
    EXPECT_TRUE(seen[i - 1]->half || seen[i]->samples > seen[i - 1]->samples);
    EXPECT_LE(seen[i]->half, seen[i - 1]->half);
  }
  const ReferencePicture expected = directly(request(), 61, 40, kSamples);
  EXPECT_EQ(seen.back()->samples, kSamples);
  EXPECT_FALSE(seen.back()->half);
  EXPECT_EQ(seen.back()->bytes.rgba, expected.bytes.rgba);
  EXPECT_EQ(seen.back()->noise, expected.noise);
  EXPECT_GT(expected.noise, 0.0);

  service.request(request());  // changes nothing
  const double before = processorSeconds();
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  EXPECT_LT(processorSeconds() - before, 0.02) << "a tenth of one processor: it does not rest";
  EXPECT_EQ(service.picture(), seen.back());
}

TEST_F(ReferenceServiceTest, AMovingViewGetsOneBatchAtHalfSizeAndTheRestFollows) {
  ReferenceService service(few());
  ReferenceRequest moving = request();
  moving.moving = true;
  service.request(moving);
  ASSERT_TRUE(rest(service));
  const auto half = service.picture();
  ASSERT_TRUE(half);
  EXPECT_TRUE(half->half);
  EXPECT_EQ(half->bytes.rgba, directly(moving, 31, 20, ReferenceService::kBatch).bytes.rgba);
  service.request(request());
  EXPECT_TRUE(service.picture()) << "the same picture, only without haste";
  ASSERT_TRUE(rest(service));
  EXPECT_FALSE(service.picture()->half);
  EXPECT_EQ(service.picture()->samples, kSamples);
}

TEST_F(ReferenceServiceTest, AnotherPictureEndsTheBatchThatIsTraced) {
  ReferenceService::Options options = few();
  options.samples = 1 << 20;
  ReferenceService service(options);
  const double started = processorSeconds();
  service.request(request(1600, 1200));
  ASSERT_TRUE(waitUntil([&] { return processorSeconds() - started > 0.3; }));
  const double before = processorSeconds();
  ReferenceRequest small = request();
  small.moving = true;
  service.request(small);
  EXPECT_FALSE(service.picture());
  ASSERT_TRUE(rest(service));
  // The batch of 800 x 600 pixels takes some seconds; what follows, a hundredth of one.
  EXPECT_LT(processorSeconds() - before, 0.3);
  ASSERT_TRUE(service.picture());
  EXPECT_EQ(service.picture()->bytes.width, 31);
}

TEST_F(ReferenceServiceTest, TheTreeIsKeptUntilPlantsOrTheirColoursChange) {
  ReferenceService service(few());
  const auto traced = [&](const ReferenceRequest& wanted) {
    service.request(wanted);
    EXPECT_TRUE(rest(service));
    const auto picture = service.picture();
    EXPECT_TRUE(picture);
    return picture ? picture->bytes.rgba : std::vector<std::uint8_t>{};
  };
  ReferenceRequest wanted = request();
  auto last = traced(wanted);
  const auto expectAnother = [&](int trees, const char* what) {
    const auto now = traced(wanted);
    EXPECT_NE(now, last) << what;
    EXPECT_EQ(service.status().trees, trees) << what;
    last = now;
  };
  wanted.project = with(wanted.project, [](project::Project& p) { p.sun.angles = {40.0, 12.0}; });
  expectAnother(1, "the sun");
  wanted.view.position.x += 0.2;
  expectAnother(1, "the view");
  wanted.project = wanted.planted = with(wanted.project, [](project::Project& p) { p.tiles.seed += 1; });
  wanted.ground = bakeOf(wanted.planted);
  expectAnother(1, "the tiles");
  wanted.project = wanted.planted = with(wanted.project, [](project::Project& p) {
    p.patch.soil.colour = {0.9f, 0.1f, 0.1f};
  });
  wanted.ground = bakeOf(wanted.planted);
  expectAnother(1, "the soil");
  wanted.project = wanted.planted = with(wanted.project, [](project::Project& p) { p.patch.seed += 1; });
  wanted.ground = bakeOf(wanted.planted);
  expectAnother(2, "where plants stand");
}

TEST_F(ReferenceServiceTest, HeldItTracesNothingAndClosedItKeepsNothing) {
  ReferenceService service(few());
  ReferenceRequest held = request();
  held.held = true;
  service.request(held);
  EXPECT_FALSE(service.status().running);
  service.request(request());
  ASSERT_TRUE(rest(service));
  const auto complete = service.picture();
  ASSERT_TRUE(complete);
  service.request(held);
  EXPECT_EQ(service.picture(), complete);
  service.close();
  EXPECT_FALSE(service.picture());
  EXPECT_FALSE(service.status().running);
  service.request(request());
  ASSERT_TRUE(rest(service));
  EXPECT_EQ(service.status().trees, 2);
  EXPECT_EQ(service.picture()->bytes.rgba, complete->bytes.rgba);
}

TEST_F(ReferenceServiceTest, WhatCannotBeTracedIsSaidAndTheNextIsTraced) {
  ReferenceService service(few());
  ReferenceRequest bad = request();
  bad.planted = with(bad.planted, [](project::Project& p) {
    p.patch.plants[0].kind = project::PlantKind::Gltf;
    p.patch.plants[0].gltf.path = "nowhere.glb";
  });
  bad.ground = std::make_shared<const bake::GroundBake>(*s_ground);
  service.request(bad);
  ASSERT_TRUE(rest(service));
  ASSERT_TRUE(service.status().error.has_value());
  EXPECT_NE(service.status().error->text().find("nowhere.glb"), std::string::npos);
  service.request(request());
  ASSERT_TRUE(rest(service));
  EXPECT_FALSE(service.status().error.has_value());
  EXPECT_TRUE(service.picture());
}

TEST_F(ReferenceServiceTest, GoesWhileTracing) {
  for (int i = 0; i < 10; ++i) {
    ReferenceService service(few());
    service.request(request(1000, 700));
    std::this_thread::sleep_for(std::chrono::milliseconds(5 * i));
  }
}

}  // namespace
}  // namespace sward::editor
