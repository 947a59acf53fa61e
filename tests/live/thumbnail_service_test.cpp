#include "live/thumbnail_service.h"

#include <gtest/gtest.h>

#include <chrono>
#include <map>
#include <thread>
#include <vector>

namespace sward::editor {
namespace {

std::vector<PlantPicture> drain(ThumbnailService& service) {
  std::vector<PlantPicture> pictures;
  for (;;) {
    const bool busy = service.busy();
    while (auto picture = service.tryPop()) pictures.push_back(std::move(*picture));
    if (!busy) return pictures;
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

ThumbnailService::Options small() {
  ThumbnailService::Options options;
  options.picture.size = 32;
  return options;
}

TEST(ThumbnailService, DrawsEachSlotAndNothingTwice) {
  ThumbnailService service(small());
  project::Plant plant;
  service.request(1, plant, 0, 5, {});
  plant.kind = project::PlantKind::Clover;
  service.request(2, plant, 1, 5, {});
  const auto pictures = drain(service);
  ASSERT_EQ(pictures.size(), 2u);
  EXPECT_EQ(pictures[0].slot, 1u);
  EXPECT_EQ(pictures[1].slot, 2u);
  EXPECT_NE(pictures[0].thumbnail.rgba, pictures[1].thumbnail.rgba);
  plant.name = "renamed";
  plant.densityPerM2 = 7.0;
  service.request(2, plant, 1, 5, {});
  EXPECT_TRUE(drain(service).empty()) << "neither a name nor a density shows on a plant";
  plant.clover.stems = 3;
  service.request(2, plant, 1, 5, {});
  EXPECT_EQ(drain(service).size(), 1u);
}

TEST(ThumbnailService, TheNewestValuesOfASlotWin) {
  ThumbnailService service(small());
  project::Plant plant;
  for (int i = 0; i < 50; ++i) {
    plant.grass.bladesPerPlant = 3 + i;
    service.request(4, plant, 0, 5, {});
  }
  const auto pictures = drain(service);
  ASSERT_FALSE(pictures.empty());
  EXPECT_LT(pictures.size(), 50u);
  ThumbnailService other(small());
  other.request(4, plant, 0, 5, {});
  EXPECT_EQ(pictures.back().thumbnail.rgba, drain(other).back().thumbnail.rgba);
}

TEST(ThumbnailService, AForgottenSlotGivesNothing) {
  ThumbnailService service(small());
  project::Plant plant;
  service.request(1, plant, 0, 5, {});
  service.forget(1);
  EXPECT_TRUE(drain(service).empty());
}

TEST(ThumbnailService, AMissingFileIsSaid) {
  ThumbnailService service(small());
  project::Plant plant;
  plant.kind = project::PlantKind::Gltf;
  plant.gltf.path = "nowhere.glb";
  service.request(1, plant, 0, 5, "/nonexistent");
  const auto pictures = drain(service);
  ASSERT_EQ(pictures.size(), 1u);
  ASSERT_TRUE(pictures[0].error.has_value());
  EXPECT_NE(pictures[0].error->text().find("nowhere.glb"), std::string::npos);
}

TEST(ThumbnailService, GoesWhileDrawing) {
  for (int i = 0; i < 20; ++i) {
    ThumbnailService service({});
    project::Plant plant;
    plant.grass.bladesPerPlant = 20 + i;
    service.request(1, plant, 0, 5, {});
    if (i % 2 == 1) std::this_thread::sleep_for(std::chrono::milliseconds(i));
  }
}

}  // namespace
}  // namespace sward::editor
