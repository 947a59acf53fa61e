#include "live/bake_service.h"

#include "bake/small_project.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <thread>
#include <vector>

namespace sward::editor {
namespace {

using project::Project;

std::shared_ptr<const Project> projectOf(double heightM) {
  Project project = bake::test::smallProject();
  project.patch.plants[0].grass.heightM = heightM;
  return std::make_shared<const Project>(std::move(project));
}

/// Takes grounds until the service rests.
std::vector<BakedGround> drain(BakeService& service) {
  std::vector<BakedGround> grounds;
  for (;;) {
    const bool running = service.status().running;
    while (auto baked = service.tryPop()) grounds.push_back(std::move(*baked));
    if (!running) return grounds;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

TEST(BakeService, EndsAtFullQuality) {
  BakeService service({});
  service.request(projectOf(0.2), 7);
  const auto grounds = drain(service);
  ASSERT_FALSE(grounds.empty());
  EXPECT_EQ(grounds.back().quality, Quality::Full);
  EXPECT_EQ(grounds.back().revision, 7u);
  for (std::size_t i = 1; i < grounds.size(); ++i) EXPECT_LT(grounds[i - 1].quality, grounds[i].quality);
}

}  // namespace
}  // namespace sward::editor
