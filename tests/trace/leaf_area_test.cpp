#include "trace/leaf_area.h"

#include "base/random.h"
#include "trace/triangle_clip.h"

#include "trace/test_patches.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace sward::trace {
namespace {

using testing::patchOf;
using testing::quad;
using testing::sceneOf;

using testing::addBox;

LeafArea areaOf(const std::shared_ptr<scene::Patch>& patch, int columns, int layers) {
  auto area = leafArea(patch, columns, layers, {});
  EXPECT_TRUE(area.ok()) << (area.ok() ? "" : area.error().text());
  return std::move(area).value();
}

double traceOf(const std::array<float, 6>& s) {
  return static_cast<double>(s[0]) + static_cast<double>(s[3]) + static_cast<double>(s[5]);
}

/// Leaf area of a grid in square metres.
double totalArea(const LeafArea& area) {
  double sum = 0.0;
  for (const auto& s : area.tensor) sum += traceOf(s);
  return sum * area.voxelM.x * area.voxelM.y * area.voxelM.z;
}

TEST(TriangleClip, PartsOfATriangleLieInTheirCellsAndSumToIt) {
  base::Random random(31);
  for (int i = 0; i < 500; ++i) {
    ClipPolygon triangle;
    const double size = std::exp2(random.uniform(-4.0, 4.0));
    const auto corner = [&] {
      return size * glm::dvec3(random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0), random.uniform(-1.0, 1.0));
    };
    const glm::dvec3 a = corner(), b = corner(), c = corner();
    triangle.add({a, 0.0, 0.0});
    triangle.add({b, 1.0, 0.0});
    triangle.add({c, 0.0, 1.0});
    double sum = 0.0;
    forEachCell(triangle, [&](const glm::ivec3& cell, const ClipPolygon& part) {
      sum += part.share();
      for (const ClipCorner& p : part.all()) {
        for (int axis = 0; axis < 3; ++axis) {
          ASSERT_GE(p.at[axis], cell[axis] - 1e-12 * size);
          ASSERT_LE(p.at[axis], cell[axis] + 1 + 1e-12 * size);
        }
        // Where it lies by its place in the triangle: a handful of cuts, each rounding by an ulp of the coordinates.
        ASSERT_LT(glm::length(a + p.u * (b - a) + p.v * (c - a) - p.at), 1e-13 * size);
      }
    });
    EXPECT_NEAR(sum, 1.0, 1e-12);
  }
}

TEST(TriangleClip, PlanesOfTheGridBelongToOneCell) {
  for (int axis = 0; axis < 3; ++axis) {
    ClipPolygon triangle;
    glm::dvec3 a(0.25), b(0.25), c(0.25);
    a[axis] = b[axis] = c[axis] = 2.0;
    b[(axis + 1) % 3] += 0.5;
    c[(axis + 2) % 3] += 0.5;
    triangle.add({a, 0.0, 0.0});
    triangle.add({b, 1.0, 0.0});
    triangle.add({c, 0.0, 1.0});
    int parts = 0;
    forEachCell(triangle, [&](const glm::ivec3& cell, const ClipPolygon& part) {
      ++parts;
      EXPECT_EQ(cell[axis], 2);
      EXPECT_DOUBLE_EQ(part.share(), 1.0);
    });
    EXPECT_EQ(parts, 1);
  }
}

// Every part of a tensor is rounded to float once: the trace errs by 2^-24 of it at most, and so does the sum.
constexpr double kRounding = 0x1.0p-23;

TEST(LeafArea, IsConserved) {
  // Lifted out of the ground, into which tilted plants reach.
  const auto patch = std::make_shared<scene::Patch>(*testing::smallMeadow());
  for (scene::Instance& instance : patch->instances) instance.worldFromModel[3].z += 0.01f;
  patch->heightM += 0.01;
  double expected = 0.0;
  for (const scene::Instance& instance : patch->instances) {
    const mesh::Model& model = *patch->models[instance.model];
    for (std::size_t t = 0; t < model.triangles.size(); ++t) {
      const glm::uvec3 corner = model.triangles[t];
      // As TriangleField lays them out, in float.
      const glm::dvec3 a(instance.worldFromModel * glm::vec4(model.positions[corner.x], 1.0f));
      const glm::dvec3 b(instance.worldFromModel * glm::vec4(model.positions[corner.y], 1.0f));
      const glm::dvec3 c(instance.worldFromModel * glm::vec4(model.positions[corner.z], 1.0f));
      const double alpha = mesh::hasAlpha(model) ? 0.5 : 1.0;
      ASSERT_GE(std::min({a.z, b.z, c.z}), 0.0);
      expected += 0.5 * alpha * glm::length(glm::cross(b - a, c - a));
    }
  }
  for (const glm::ivec2 grid : {glm::ivec2(1, 1), glm::ivec2(16, 4), glm::ivec2(100, 7)}) {
    EXPECT_NEAR(totalArea(areaOf(patch, grid.x, grid.y)) / expected, 1.0, kRounding) << grid.x;
  }
}

TEST(LeafArea, SolidsCountHalfAndWhatIsUndergroundNothing) {
  mesh::Model box;
  addBox(box, {0.875f, 0.25f, 0.125f}, {0.25f, 0.5f, 0.25f});  // over the border
  const double half = 0.25 * 0.5 + 0.25 * 0.25 + 0.5 * 0.25;
  EXPECT_NEAR(totalArea(areaOf(patchOf(box, 1.0, 0.5), 16, 8)) / half, 1.0, 1e-6);  // corners rounded to float
  const auto sunk = patchOf(quad({0.25f, 0.25f, -0.25f}, {0.5f, 0.0f, 0.0f}, {0.0f, 0.0f, 0.5f}), 1.0, 0.25);
  EXPECT_NEAR(totalArea(areaOf(sunk, 16, 8)) / (0.5 * 0.25), 1.0, kRounding);
}

TEST(LeafArea, ShiftsWithThePlants) {
  // Steps of a voxel are exact in float: the grid turns by whole cells, over the border.
  const int n = 32, layers = 8;
  const mesh::Model plant = quad({-0.25f, -0.03125f, 0.0f}, {0.5f, 0.0f, 0.0f}, {0.0f, 0.0625f, 0.25f});
  const auto grid = [&](int dx, int dy) {
    return areaOf(
        patchOf(plant, 1.0, 0.25, {{(8.0f + static_cast<float>(dx)) / n, (3.0f + static_cast<float>(dy)) / n, 0.0f}}),
        n, layers);
  };
  const LeafArea still = grid(0, 0), moved = grid(21, 30);
  for (int z = 0; z < layers; ++z) {
    for (int y = 0; y < n; ++y) {
      for (int x = 0; x < n; ++x) {
        const auto from = static_cast<std::size_t>((z * n + y) * n + x);
        const auto to = static_cast<std::size_t>((z * n + (y + 30) % n) * n + (x + 21) % n);
        ASSERT_NEAR(traceOf(still.tensor[from]), traceOf(moved.tensor[to]), 1e-5 * n);
        ASSERT_EQ(still.blocked[from], moved.blocked[to]);
      }
    }
  }
}

TEST(LeafArea, RefusesWhatCannotBeCut) {
  const auto patch = patchOf(quad({0.0f, 0.0f, 0.0f}, {1.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 0.1f}), 1.0, 0.1);
  for (const glm::ivec2 grid : {glm::ivec2(0, 4), glm::ivec2(4, 0), glm::ivec2(-1, 1), glm::ivec2(4096, 1024)}) {
    const auto area = leafArea(patch, grid.x, grid.y, {});
    ASSERT_FALSE(area.ok());
    EXPECT_EQ(area.error().kind, ErrorKind::BadInput);
  }
  mesh::Model broken = quad({0.0f, 0.0f, 0.0f}, {1.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 0.1f});
  broken.positions[1].x = NAN;
  EXPECT_FALSE(leafArea(patchOf(broken, 1.0, 0.1), 4, 4, {}).ok());
  EXPECT_FALSE(leafArea(patchOf(mesh::Model{}, 1.0, 0.0), 4, 4, {}).ok());
  JobContext job;
  std::stop_source stop;
  stop.request_stop();
  job.stop = stop.get_token();
  EXPECT_EQ(leafArea(patch, 4, 4, job).error().kind, ErrorKind::Cancelled);
}

}  // namespace
}  // namespace sward::trace
