#include "terrain/lod_tree.h"

#include "base/random.h"
#include "terrain/hills.h"
#include "terrain/sun_shadow.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <tuple>

#include <gtest/gtest.h>

namespace sward::terrain {
namespace {

std::shared_ptr<const HeightField> hills(double amplitude = 14.0) {
  HillOptions options;
  options.amplitudeM = amplitude;
  return HeightField::create(makeHills(options).value()).value();
}

/// Rough ground of 60 x 40 samples with a level border, as heightmaps have.
std::shared_ptr<const HeightField> island() {
  base::Random random(77);
  HeightGrid grid;
  grid.columns = 60;
  grid.rows = 40;
  grid.cellM = {5.0, 7.0};
  grid.origin = {-130.0, -150.0};
  for (int y = 0; y < grid.rows; ++y) {
    for (int x = 0; x < grid.columns; ++x) {
      const bool border = x < 3 || y < 3 || x > 56 || y > 36;
      grid.heights.push_back(border ? 2.0f : static_cast<float>(random.uniform(-8.0, 12.0)));
    }
  }
  return HeightField::create(std::move(grid)).value();
}

/// Two smooth hills on a level plain.
std::shared_ptr<const HeightField> twoHills() {
  HeightGrid grid;
  grid.columns = 90;
  grid.rows = 70;
  grid.cellM = {5.0, 7.0};
  for (int y = 0; y < grid.rows; ++y) {
    for (int x = 0; x < grid.columns; ++x) {
      const auto bump = [&](double cx, double cy, double radius, double height) {
        return height * std::exp(-0.5 * (std::pow(5.0 * x - cx, 2) + std::pow(7.0 * y - cy, 2)) / (radius * radius));
      };
      grid.heights.push_back(static_cast<float>(bump(160, 240, 40, 60) + bump(300, 260, 25, 35)));
    }
  }
  return HeightField::create(std::move(grid)).value();
}

LodView viewFrom(glm::dvec3 eye, double errorAngle = 3e-2) {
  LodView view;
  view.eye = eye;
  view.errorAngle = errorAngle;
  view.farM = 600.0;
  return view;
}

using Point = std::tuple<long, long>;  ///< in steps of level -8

struct Mesh {
  std::map<std::tuple<Point, Point>, int> edges;  ///< directed
  std::map<Point, glm::vec3> places;
  long lowX = 1L << 60, highX = -(1L << 60), lowY = 1L << 60, highY = -(1L << 60);
};

Mesh meshOf(const LodTree& tree, const std::vector<LodChunk>& chunks) {
  Mesh mesh;
  for (const LodChunk& chunk : chunks) {
    std::array<glm::vec3, kChunkVertices> vertices;
    tree.vertices(chunk.node, glm::dvec3(3.0, -7.0, 1.0), vertices);
    const auto pointOf = [&](std::uint16_t index) {
      const long scale = 1L << (chunk.node.level + 8);
      return Point{(chunk.node.x * kChunkQuads + index % (kChunkQuads + 1)) * scale,
                   (chunk.node.y * kChunkQuads + index / (kChunkQuads + 1)) * scale};
    };
    const auto& indices = LodTree::indices(chunk.coarserSides);
    for (std::size_t i = 0; i < indices.size(); i += 3) {
      for (std::size_t k = 0; k < 3; ++k) {
        const Point a = pointOf(indices[i + k]), b = pointOf(indices[i + (k + 1) % 3]);
        ++mesh.edges[{a, b}];
        const auto [found, isNew] = mesh.places.try_emplace(a, vertices[indices[i + k]]);
        EXPECT_EQ(found->second, vertices[indices[i + k]]) << "a shared vertex has two places";
        mesh.lowX = std::min(mesh.lowX, std::get<0>(a));
        mesh.highX = std::max(mesh.highX, std::get<0>(a));
        mesh.lowY = std::min(mesh.lowY, std::get<1>(a));
        mesh.highY = std::max(mesh.highY, std::get<1>(a));
      }
    }
  }
  return mesh;
}

/// Every edge is met by one triangle from each side, but those on the whole mesh's border.
void expectWatertight(const LodTree& tree, const std::vector<LodChunk>& chunks) {
  const Mesh mesh = meshOf(tree, chunks);
  int wrong = 0;
  for (const auto& [edge, count] : mesh.edges) {
    const auto& [a, b] = edge;
    const bool border =
        (std::get<0>(a) == std::get<0>(b) && (std::get<0>(a) == mesh.lowX || std::get<0>(a) == mesh.highX)) ||
        (std::get<1>(a) == std::get<1>(b) && (std::get<1>(a) == mesh.lowY || std::get<1>(a) == mesh.highY));
    const auto back = mesh.edges.find({b, a});
    const int others = back == mesh.edges.end() ? 0 : back->second;
    if (count != 1 || others != (border ? 0 : 1)) ++wrong;
  }
  EXPECT_EQ(wrong, 0) << "of " << mesh.edges.size() << " edges";
}

TEST(LodTree, IsWatertightFromEverywhere) {
  for (const auto& field : {hills(), hills(40.0), island()}) {
    const LodTree tree(field);
    int levels = 0;
    for (const glm::dvec3& eye : {glm::dvec3(0, 0, 2), glm::dvec3(77.7, -31.2, 5), glm::dvec3(-5000, 800, 300),
                                  glm::dvec3(123456.7, 9.0, 40), glm::dvec3(10, 10, 2000)}) {
      const auto chunks = tree.select(viewFrom(eye));
      expectWatertight(tree, chunks);
      levels = std::max(levels, chunks.back().node.level - chunks.front().node.level);
    }
    EXPECT_GE(levels, 4) << "the test sees stitches";
  }
}

TEST(LodTree, IsWatertightWithHiddenParts) {
  // Chunks outside the view are left coarse, and still meet their neighbours.
  const LodTree tree(hills());
  LodView view = viewFrom({0, 0, 3});
  view.planes = {{0.0, 1.0, 0.0, -1.0}, {0.6, 0.8, 0.0, 0.0}};
  const auto chunks = tree.select(view);
  expectWatertight(tree, chunks);
  const auto shown = std::count_if(chunks.begin(), chunks.end(), [](const LodChunk& c) { return c.visible; });
  EXPECT_GT(shown, 10);
  EXPECT_LT(shown, std::ssize(chunks));
}

TEST(LodTree, NeighboursDifferByOneLevelAndErrorsAreKept) {
  const LodTree tree(hills());
  const LodView view = viewFrom({20, 30, 6});
  for (const LodChunk& chunk : tree.select(view)) {
    const HeightGrid& grid = tree.field().grid();
    const glm::dvec2 side = grid.cellM * std::ldexp(static_cast<double>(kChunkQuads), chunk.node.level);
    const glm::dvec2 low = grid.origin + side * glm::dvec2(chunk.node.x, chunk.node.y);
    const HeightRange range = tree.field().range(low, low + side);
    const glm::dvec3 outside =
        glm::max(glm::max(glm::dvec3(low, range.low) - view.eye, view.eye - glm::dvec3(low + side, range.high)), 0.0);
    if (chunk.node.level > view.finestLevel) {
      EXPECT_LE(tree.errorM(chunk.node), view.errorAngle * glm::length(outside) + 1e-9);
    }
  }
}

/// Height of a chunk's triangles at random places of theirs against the field.
TEST(LodTree, ErrorsBoundTheDistanceToTheField) {
  base::Random random(5);
  double nearest = 0.0;  // largest share of its bound that an error takes
  for (const auto& field : {hills(), island()}) {
    const LodTree tree(field);
    for (const double angle : {1e-1, 1e-2}) {
      for (const LodChunk& chunk : tree.select(viewFrom({0, 0, 20}, angle))) {
        std::array<glm::vec3, kChunkVertices> v;
        tree.vertices(chunk.node, glm::dvec3(0.0), v);
        const auto& indices = LodTree::indices(chunk.coarserSides);
        for (int k = 0; k < 12; ++k) {
          const std::size_t i = 3 * random.index(static_cast<std::uint32_t>(indices.size() / 3));
          double a = random.uniform(), b = random.uniform();
          if (a + b > 1.0) a = 1.0 - a, b = 1.0 - b;
          const glm::dvec3 p = glm::dvec3(v[indices[i]]) * (1.0 - a - b) + glm::dvec3(v[indices[i + 1]]) * a +
                               glm::dvec3(v[indices[i + 2]]) * b;
          const double error = std::abs(p.z - field->height(glm::dvec2(p)));
          // Vertices are floats: at some kilometres their places are off by half a millimetre, on slopes below 10.
          const double rounding = 1e-5 + 2e-7 * glm::length(glm::dvec2(p)) * 10.0;
          EXPECT_LE(error, chunk.errorM + rounding) << chunk.node.level;
          if (chunk.errorM > 0.1) nearest = std::max(nearest, error / chunk.errorM);
        }
      }
    }
  }
  EXPECT_GT(nearest, 0.3) << "the bound says little";
}

TEST(LodTree, LevelGroundTakesFewTriangles) {
  HeightGrid grid;
  grid.columns = grid.rows = 64;
  grid.heights.assign(64 * 64, 3.0f);
  const LodTree tree(HeightField::create(std::move(grid)).value());
  EXPECT_LT(tree.errorM({7, 0, 0}), 1e-30);
  EXPECT_LT(tree.select(viewFrom({0, 0, 2})).size(), 400u);
}

TEST(SunVisibility, AgreesWithRays) {
  for (const auto& field : {hills(60.0), twoHills()}) {
    for (const double azimuth : {20.0, 117.0, 251.0, 340.0}) {
      const double elevation = 14.0 * std::numbers::pi / 180.0, a = azimuth * std::numbers::pi / 180.0;
      const glm::dvec3 sun(std::sin(a) * std::cos(elevation), std::cos(a) * std::cos(elevation), std::sin(elevation));
      const auto seen = sunVisibility(*field, sun);
      const HeightGrid& grid = field->grid();
      base::Random random(3);
      int lit = 0, dark = 0, wrong = 0;
      for (int i = 0; i < 4000; ++i) {
        const int x = static_cast<int>(random.index(static_cast<std::uint32_t>(grid.columns)));
        const int y = static_cast<int>(random.index(static_cast<std::uint32_t>(grid.rows)));
        const float share = seen[grid.offset(x, y)];
        if (share > 0.02f && share < 0.98f) continue;
        const glm::dvec2 place = grid.origin + grid.cellM * glm::dvec2(x, y);
        const bool blocked = field->rayCast(glm::dvec3(place, field->height(place) + 0.02), sun, 4000.0).has_value();
        ++(blocked ? dark : lit);
        wrong += blocked == (share > 0.5f) ? 1 : 0;
      }
      // The sweep interpolates between samples linearly, rays meet splines: edges of shadows differ.
      EXPECT_LT(wrong, (lit + dark) * 6 / 100) << azimuth;
      EXPECT_GT(lit, 500);
      EXPECT_GT(dark, 50);
    }
  }
}

TEST(SunVisibility, HardCases) {
  const auto field = island();
  const auto all = [&](const glm::dvec3& sun, float value) {
    const auto seen = sunVisibility(*field, sun);
    return std::all_of(seen.begin(), seen.end(), [&](float v) { return v == value; });
  };
  EXPECT_TRUE(all({0, 0, 1}, 1.0f));
  EXPECT_TRUE(all({1, 0, 0}, 0.0f));
  EXPECT_TRUE(all({0.6, 0, -0.8}, 0.0f));
  HeightGrid grid;
  grid.columns = grid.rows = 16;
  grid.border = Border::Repeat;
  grid.heights.assign(256, 3.0f);
  const auto level = HeightField::create(std::move(grid)).value();
  const glm::dvec3 low = glm::normalize(glm::dvec3(0.3, -1.0, 0.1));
  for (const float v : sunVisibility(*level, low)) EXPECT_EQ(v, 1.0f);
}

}  // namespace
}  // namespace sward::terrain
