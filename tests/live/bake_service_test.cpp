#include "live/bake_service.h"

#include "bake/payload.h"

#include "bake/small_project.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <filesystem>
#include <functional>
#include <thread>
#include <vector>

#include <unistd.h>

namespace sward::editor {
namespace {

using project::Project;
using ProjectPtr = std::shared_ptr<const Project>;

ProjectPtr edited(const std::function<void(Project&)>& edit, Project project = bake::test::smallProject()) {
  edit(project);
  return std::make_shared<const Project>(std::move(project));
}
ProjectPtr ofHeight(double heightM) {
  return edited([&](Project& p) { p.patch.plants[0].grass.heightM = heightM; });
}

/// Coarse in no time, half soon; full takes seconds, so that there is time to do something meanwhile.
Project slowProject() {
  Project project = bake::test::smallProject();
  project.sampling.sliceSubSamples = 256;
  project.sampling.bladeSubSamples = 256;
  return project;
}

void pause() {
  std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

/// Takes grounds until the service rests.
std::vector<BakedGround> drain(BakeService& service) {
  std::vector<BakedGround> grounds;
  for (;;) {
    const bool running = service.status().running;
    while (auto baked = service.tryPop()) grounds.push_back(std::move(*baked));
    if (!running) return grounds;
    pause();
  }
}

/// Waits until the full bake has begun to make progress.
void awaitFull(BakeService& service) {
  for (;;) {
    const BakeStatus status = service.status();
    ASSERT_TRUE(status.running);
    if (status.quality == Quality::Full && status.fraction > 0.0) return;
    pause();
  }
}

TEST(BakeService, CoarseFirstThenHalfThenFull) {
  BakeService service({});
  const auto project = std::make_shared<const Project>(slowProject());
  service.request(project, 7);
  const auto grounds = drain(service);
  ASSERT_GE(grounds.size(), 2u) << "a slow bake leaves time to take what comes before";
  for (std::size_t i = 1; i < grounds.size(); ++i) EXPECT_LT(grounds[i - 1].quality, grounds[i].quality);
  for (const BakedGround& baked : grounds) EXPECT_EQ(baked.revision, 7u);
  EXPECT_EQ(grounds.front().quality, Quality::Coarse);
  EXPECT_EQ(grounds.back().quality, Quality::Full);
  EXPECT_FALSE(service.status().error.has_value());
}

TEST(BakeService, FullIsWhatARenderBakes) {
  BakeService service({});
  service.request(ofHeight(0.2), 1);
  service.request(ofHeight(0.22), 2);
  const auto grounds = drain(service);
  bake::Baker baker;
  const auto expected = baker.ground(*ofHeight(0.22), {}).value();
  EXPECT_EQ(bake::payloadOf(*grounds.back().ground), bake::payloadOf(*expected));
}

TEST(BakeService, TheNewestRequestWins) {
  BakeService service({});
  service.request(std::make_shared<const Project>(slowProject()), 1);
  awaitFull(service);
  for (std::uint64_t revision = 2; revision <= 6; ++revision) {
    service.request(ofHeight(0.2 + 0.01 * static_cast<double>(revision)), revision);
  }
  const auto grounds = drain(service);
  ASSERT_FALSE(grounds.empty());
  EXPECT_EQ(grounds.back().revision, 6u);
  EXPECT_EQ(grounds.back().quality, Quality::Full);
  for (const BakedGround& baked : grounds) {
    EXPECT_TRUE(baked.revision == 6 || baked.quality != Quality::Full) << "revision " << baked.revision;
  }
}

TEST(BakeService, ASliderThatMovesFasterThanBakesIsFollowed) {
  BakeService service({});
  std::uint64_t revision = 0;
  std::vector<BakedGround> meanwhile;
  // Requests until three pictures came, each newer than the one before: none is put off until the slider rests.
  while (meanwhile.size() < 3) {
    ++revision;
    service.request(ofHeight(0.2 + 1e-5 * static_cast<double>(revision)), revision);
    pause();
    if (auto baked = service.tryPop()) meanwhile.push_back(std::move(*baked));
    ASSERT_LT(revision, 100000u);
  }
  for (std::size_t i = 1; i < meanwhile.size(); ++i) EXPECT_GT(meanwhile[i].revision, meanwhile[i - 1].revision);
  EXPECT_EQ(drain(service).back().revision, revision);
}

TEST(BakeService, AnotherSunDoesNotDisturbTheBake) {
  BakeService service({});
  const Project slow = slowProject();
  service.request(std::make_shared<const Project>(slow), 1);
  awaitFull(service);
  double last = service.status().fraction;
  service.request(edited([](Project& p) { p.sun.angles.azimuthDeg = 12.0; }, slow), 2);
  std::vector<BakedGround> grounds;
  while (service.status().running) {
    const BakeStatus status = service.status();
    if (status.running && status.quality == Quality::Full) {
      EXPECT_GE(status.fraction, last) << "begun again";
      last = status.fraction;
    }
    pause();
  }
  for (const BakedGround& baked : drain(service)) grounds.push_back(baked);
  ASSERT_EQ(grounds.size(), 1u);
  EXPECT_EQ(grounds[0].quality, Quality::Full);
  EXPECT_EQ(grounds[0].revision, 2u) << "it answers the newer request";
  service.request(edited([](Project& p) { p.views[0].exposureEv = 1.0; }, slow), 3);
  EXPECT_TRUE(drain(service).empty()) << "handed out already";
  EXPECT_EQ(service.status().revision, 3u);
}

TEST(BakeService, CancelDropsEverything) {
  BakeService service({});
  service.request(std::make_shared<const Project>(slowProject()), 1);
  awaitFull(service);
  service.cancel();
  EXPECT_FALSE(service.status().running);
  EXPECT_FALSE(service.tryPop().has_value());
  service.request(ofHeight(0.2), 2);
  for (const BakedGround& baked : drain(service)) EXPECT_EQ(baked.revision, 2u);
  service.cancel();
  service.request(ofHeight(0.2), 3);
  const auto again = drain(service);
  ASSERT_EQ(again.size(), 1u) << "handed out again, from memory";
  EXPECT_EQ(again[0].quality, Quality::Full);
}

TEST(BakeService, AnErrorIsSaidAndTheNextRequestBakes) {
  BakeService service({});
  service.request(edited([](Project& p) { p.sampling.slices = 0; }), 1);
  EXPECT_TRUE(drain(service).empty());
  ASSERT_TRUE(service.status().error.has_value());
  EXPECT_EQ(service.status().error->where, "sampling.slices");
  service.request(edited([](Project& p) {
                    p.patch.plants[0].kind = project::PlantKind::Gltf;
                    p.patch.plants[0].gltf.path = "nowhere.glb";
                  }),
                  2);
  EXPECT_TRUE(drain(service).empty());
  ASSERT_TRUE(service.status().error.has_value());
  EXPECT_NE(service.status().error->text().find("nowhere.glb"), std::string::npos);
  service.request(ofHeight(0.2), 3);
  EXPECT_EQ(drain(service).back().quality, Quality::Full);
  EXPECT_FALSE(service.status().error.has_value());
}

TEST(BakeService, OnlyTheNewestGroundIsKept) {
  BakeService service({});
  for (std::uint64_t revision = 1; revision <= 2; ++revision) {
    service.request(ofHeight(0.2 + 0.02 * static_cast<double>(revision)), revision);
    while (service.status().running) pause();
  }
  const auto newest = service.tryPop();
  ASSERT_TRUE(newest.has_value());
  EXPECT_EQ(newest->revision, 2u);
  EXPECT_EQ(newest->quality, Quality::Full);
  EXPECT_FALSE(service.tryPop().has_value());
}

TEST(BakeService, ColoursBeginWithHalfAndTraceNothing) {
  BakeService service({});
  Project project = bake::test::smallProject();
  service.request(std::make_shared<const Project>(project), 1);
  drain(service);
  project.patch.plants[0].grass.tipColour.x = 0.5;
  service.request(std::make_shared<const Project>(project), 2);
  const auto grounds = drain(service);
  ASSERT_FALSE(grounds.empty());
  for (const BakedGround& baked : grounds) {
    EXPECT_NE(baked.quality, Quality::Coarse);
    EXPECT_EQ(baked.report.raysNearest + baked.report.raysOcclusion, 0u);
  }
}

TEST(BakeService, WhatIsOnTheDiskComesAtOnceAtFullQuality) {
  const auto folder = std::filesystem::temp_directory_path() / ("sward-live-" + std::to_string(::getpid()));
  for (const bool warm : {false, true}) {
    BakeService::Options options;
    options.cacheFolder = folder;
    BakeService service(options);
    service.request(ofHeight(0.2), 1);
    const auto grounds = drain(service);
    EXPECT_EQ(grounds.back().quality, Quality::Full);
    if (warm) {
      EXPECT_EQ(grounds.size(), 1u);
    }
  }
  std::filesystem::remove_all(folder);
}

TEST(BakeService, TellsWhenThereIsSomethingNew) {
  std::atomic<int> calls{0};
  BakeService::Options options;
  options.onChanged = [&] { ++calls; };
  BakeService service(options);
  service.request(ofHeight(0.2), 1);
  drain(service);
  EXPECT_GE(calls.load(), 3);
}

TEST(BakeService, GoesWhileBaking) {
  Project endless = slowProject();
  endless.sampling.visibilityDirections = 1024;
  endless.lights = {};
  endless.lights.count = 500;
  for (int i = 0; i < 3; ++i) {
    BakeService service({});
    service.request(std::make_shared<const Project>(endless), 1);
    if (i == 1) awaitFull(service);
    if (i == 2) pause();
  }
}

}  // namespace
}  // namespace sward::editor
