#include "mesh/procedural.h"

#include "base/curve_sampler.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace sward::mesh {
namespace {

void expectSound(const Model& model) {
  ASSERT_FALSE(model.empty());
  ASSERT_EQ(model.normals.size(), model.positions.size());
  ASSERT_EQ(model.uvs.size(), model.positions.size());
  ASSERT_EQ(model.colours.size(), model.positions.size());
  ASSERT_EQ(model.triangleMaterial.size(), model.triangles.size());
  for (std::size_t i = 0; i < model.positions.size(); ++i) {
    const glm::vec3& p = model.positions[i];
    ASSERT_TRUE(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z));
    ASSERT_GE(p.z, 0.0f);
    ASSERT_NEAR(glm::length(model.normals[i]), 1.0f, 1e-5f);
    for (int c = 0; c < 4; ++c) ASSERT_TRUE(model.colours[i][c] >= 0.0f && model.colours[i][c] <= 1.0f);
  }
  for (std::size_t t = 0; t < model.triangles.size(); ++t) {
    const glm::uvec3& corner = model.triangles[t];
    ASSERT_LT(std::max({corner.x, corner.y, corner.z}), model.positions.size());
    ASSERT_NE(model.positions[corner.x], model.positions[corner.y]);
    ASSERT_LT(model.triangleMaterial[t], model.materials.size());
  }
}

/// Every triangle's front is on the side that its shading normals point to.
void expectFrontsFollowNormals(const Model& model) {
  for (const glm::uvec3& t : model.triangles) {
    const glm::vec3 face =
        glm::cross(model.positions[t.y] - model.positions[t.x], model.positions[t.z] - model.positions[t.x]);
    ASSERT_GT(glm::dot(face, model.normals[t.x] + model.normals[t.y] + model.normals[t.z]), 0.0f);
  }
}

bool sameVertices(const Model& a, const Model& b) {
  return a.positions == b.positions && a.colours == b.colours;
}

TEST(Procedural, plantsAreSoundForManySeedsAndShapes) {
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    GrassShape grass;
    grass.seedHeadShare = seed % 3 == 0 ? 0.3 : 0.0;
    grass.bendDeg = seed % 5 == 0 ? 170.0 : 50.0;  // tips that would go under the ground
    grass.leanDeg = seed % 7 == 0 ? 85.0 : 12.0;
    grass.foldDeg = seed % 2 == 0 ? 0.0 : 40.0;
    expectSound(growGrass(grass, seed));
    FlowerShape flower;
    flower.petals = static_cast<int>(seed);
    flower.leaves = static_cast<int>(seed % 6);
    expectSound(growFlower(flower, seed));
    CloverShape clover;
    clover.headShare = seed % 2 == 0 ? 1.0 : 0.1;
    expectSound(growClover(clover, seed));
  }
}

TEST(Procedural, smallestShapesAreNotEmpty) {
  GrassShape grass;
  grass.bladesPerPlant = 1;
  grass.segments = 1;
  grass.heightVariation = grass.colourVariation = grass.clumpRadiusM = 0.0;
  expectSound(growGrass(grass, 1));
  FlowerShape flower;
  flower.petals = flower.leaves = 0;
  expectSound(growFlower(flower, 1));
  CloverShape clover;
  clover.stems = 1;
  clover.spreadM = 0.0;
  expectSound(growClover(clover, 1));
}

TEST(Procedural, theSeedDecidesEverything) {
  EXPECT_TRUE(sameVertices(growGrass({}, 7), growGrass({}, 7)));
  EXPECT_FALSE(sameVertices(growGrass({}, 7), growGrass({}, 8)));
  EXPECT_TRUE(sameVertices(growFlower({}, 7), growFlower({}, 7)));
  EXPECT_FALSE(sameVertices(growFlower({}, 7), growFlower({}, 8)));
  EXPECT_TRUE(sameVertices(growClover({}, 7), growClover({}, 7)));
  EXPECT_FALSE(sameVertices(growClover({}, 7), growClover({}, 8)));
}

TEST(Procedural, frontsFollowNormals) {
  GrassShape flat;
  flat.foldDeg = 0.0;
  for (std::uint64_t seed = 0; seed < 10; ++seed) {
    expectFrontsFollowNormals(growGrass({}, seed));
    expectFrontsFollowNormals(growGrass(flat, seed));
  }
}

TEST(Procedural, trianglesPerBladeStayModerate) {
  GrassShape shape;
  shape.bladesPerPlant = 10;
  EXPECT_EQ(growGrass(shape, 1).triangles.size(), 10u * (2 * 12 - 2));  // two strips of six quads, the tips triangles
  shape.foldDeg = 0.0;
  EXPECT_EQ(growGrass(shape, 1).triangles.size(), 10u * (12 - 1));
}

/// A flat, straight blade: the rows' widths are plain distances between its two edges.
GrassShape straightBlade() {
  GrassShape shape;
  shape.bladesPerPlant = 1;
  shape.segments = 8;
  shape.heightVariation = shape.bendDeg = shape.leanDeg = shape.twistDeg = shape.foldDeg = 0.0;
  return shape;
}

TEST(Procedural, taperProfileIsHonoured) {
  GrassShape shape = straightBlade();
  Result<base::Curve> profile = base::Curve::fromPoints({{0.0, 0.3}, {0.4, 1.0}, {0.8, 0.5}, {1.0, 0.25}});
  ASSERT_TRUE(profile.ok());
  shape.profile = *profile;
  const Model model = growGrass(shape, 3);
  ASSERT_EQ(model.positions.size(), 18u);
  for (std::size_t row = 0; row <= 8; ++row) {
    const double s = static_cast<double>(row) / 8.0;
    const float width = glm::length(model.positions[2 * row + 1] - model.positions[2 * row]);
    EXPECT_NEAR(width, shape.widthM * (*profile)(s), 1e-7) << row;
    EXPECT_NEAR(model.positions[2 * row].z, shape.heightM * s, 1e-6) << row;
  }
}

TEST(Procedural, theBuiltInTaperIsWidestAtWidthAndEndsInAPoint) {
  GrassShape shape = straightBlade();
  shape.segments = 40;
  const Model model = growGrass(shape, 3);
  float widest = 0.0f;
  for (std::size_t row = 0; row <= 40; ++row) {
    widest = std::max(widest, glm::length(model.positions[2 * row + 1] - model.positions[2 * row]));
  }
  EXPECT_NEAR(widest, shape.widthM, 0.01 * shape.widthM);
  EXPECT_EQ(model.positions[80], model.positions[81]);
}

/// Arc length of each blade's midline; rows of flat blades are pairs of vertices.
std::vector<double> bladeLengths(const Model& model, int segments) {
  std::vector<double> lengths;
  const std::size_t perBlade = 2 * (static_cast<std::size_t>(segments) + 1);
  for (std::size_t first = 0; first < model.positions.size(); first += perBlade) {
    double length = 0.0;
    for (std::size_t row = 1; row <= static_cast<std::size_t>(segments); ++row) {
      const auto middle = [&](std::size_t r) {
        return 0.5 * (glm::dvec3(model.positions[first + 2 * r]) + glm::dvec3(model.positions[first + 2 * r + 1]));
      };
      length += glm::length(middle(row) - middle(row - 1));
    }
    lengths.push_back(length);
  }
  return lengths;
}

TEST(Procedural, lengthsFollowTheStatedVariation) {
  GrassShape shape;
  shape.foldDeg = 0.0;
  shape.segments = 24;
  shape.bladesPerPlant = 400;
  const std::vector<double> lengths = bladeLengths(growGrass(shape, 11), shape.segments);
  ASSERT_EQ(lengths.size(), 400u);
  for (const double length : lengths) {
    EXPECT_GT(length, shape.heightM * (1.0 - 2.0 * shape.heightVariation) * 0.99);
    EXPECT_LT(length, shape.heightM * (1.0 + 2.0 * shape.heightVariation) * 1.01);
  }
  const double mean = std::accumulate(lengths.begin(), lengths.end(), 0.0) / 400.0;
  double variance = 0.0;
  for (const double length : lengths) variance += (length - mean) * (length - mean) / 399.0;
  // Standard errors: sd / sqrt(400) = 5 % of sd for the mean, sd / sqrt(800) = 3.5 % for sd; cutting at two takes 4 %.
  const double deviation = shape.heightM * shape.heightVariation;
  EXPECT_NEAR(mean, shape.heightM, 0.2 * deviation);
  EXPECT_NEAR(std::sqrt(variance), 0.96 * deviation, 0.14 * deviation);
}

base::Curve curveOf(std::vector<base::CurvePoint> points) {
  return base::Curve::fromPoints(std::move(points)).value();
}

TEST(Procedural, heightsFollowTheirCurve) {
  GrassShape shape;
  shape.foldDeg = 0.0;
  shape.segments = 24;
  shape.bladesPerPlant = 500;
  // A triangle over 0.25 to 1.25 with its peak at 0.5: a quarter of the blades below the peak.
  shape.heightDistribution = curveOf({{0.25, 0.0}, {0.5, 1.0}, {1.25, 0.0}});
  std::vector<double> lengths = bladeLengths(growGrass(shape, 11), shape.segments);
  std::sort(lengths.begin(), lengths.end());
  EXPECT_GE(lengths.front(), 0.25 * shape.heightM * 0.98);
  EXPECT_LE(lengths.back(), 1.25 * shape.heightM * 1.001);
  // The monotone cubic through three points is no triangle; its own sampler says where the quantiles are. Strata leave
  // each quantile an error of one blade, 24 segments measure a curved blade short by less than 1 %.
  const base::CurveSampler expected(shape.heightDistribution, 0.0, kHighestRelativeHeight);
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    const double low = expected(static_cast<double>(i) / 500.0),
                 high = expected((static_cast<double>(i) + 1.0) / 500.0);
    EXPECT_GE(lengths[i], 0.985 * low * shape.heightM) << i;
    EXPECT_LE(lengths[i], 1.005 * high * shape.heightM) << i;
  }
}

TEST(Procedural, aHeightCurveMovesHeightsAlone) {
  GrassShape shape;
  shape.foldDeg = 0.0;
  const Model without = growGrass(shape, 4);
  shape.heightDistribution = curveOf({{0.0, 0.0}, {1.0, 1.0}, {2.0, 0.0}});
  const Model with = growGrass(shape, 4);
  EXPECT_TRUE(sameVertices(with, growGrass(shape, 4)));
  ASSERT_EQ(with.positions.size(), without.positions.size());
  EXPECT_NE(with.positions, without.positions);
  EXPECT_EQ(with.colours, without.colours);
  // Rows of two vertices: the roots stand where they stood.
  const std::size_t perBlade = 2 * (static_cast<std::size_t>(shape.segments) + 1);
  for (std::size_t first = 0; first < with.positions.size(); first += perBlade) {
    const glm::vec3 a = 0.5f * (with.positions[first] + with.positions[first + 1]);
    const glm::vec3 b = 0.5f * (without.positions[first] + without.positions[first + 1]);
    EXPECT_LT(glm::distance(glm::vec2(a), glm::vec2(b)), 1e-6f);
  }
}

TEST(Procedural, extremeHeightCurvesStillGrowBlades) {
  GrassShape shape;
  for (const auto& curve :
       {curveOf({{0.0, 1.0}, {0.01, 0.0}}), curveOf({{2.0, 1.0}}), curveOf({{1.99, 0.0}, {2.0, 1.0}}),
        curveOf({{0.0, 0.0}, {2.0, 0.0}})}) {  // the last is refused by project::validate
    shape.heightDistribution = curve;
    for (std::uint64_t seed = 0; seed < 10; ++seed) expectSound(growGrass(shape, seed));
  }
}

TEST(Procedural, builtInCurvesAreCloseToWhatEmptyOnesDo) {
  GrassShape shape = straightBlade();
  shape.segments = 40;
  const Model plain = growGrass(shape, 3);
  shape.profile = builtInProfile();
  shape.colourAlong = builtInColourAlong();
  const Model curved = growGrass(shape, 3);
  for (std::size_t row = 0; row <= 40; ++row) {
    const auto width = [&](const Model& m) { return glm::length(m.positions[2 * row + 1] - m.positions[2 * row]); };
    EXPECT_NEAR(width(curved), width(plain), 0.04 * shape.widthM) << row;
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(curved.colours[2 * row][c], plain.colours[2 * row][c], 0.01) << row;
  }
  for (const double variation : {0.0, 0.1, 0.3, 0.5}) {
    const base::Curve density = builtInHeightDistribution(variation);
    EXPECT_EQ(density.points().front().y, 0.0);
    EXPECT_EQ(density.points().back().y, 0.0);
    EXPECT_GE(density.points().front().x, 0.0);
    EXPECT_LE(density.points().back().x, kHighestRelativeHeight);
    const base::CurveSampler sampler(density, 0.0, kHighestRelativeHeight);
    EXPECT_NEAR(sampler.mean(), 1.0, 1e-3);
    // A normal cut at two sigma has its 16 % quantile a little inside of one sigma.
    EXPECT_NEAR(1.0 - sampler(0.1587), 0.95 * variation, 0.08 * variation + 0.01);
  }
}

TEST(Procedural, bendTurnsTheTipAndLeanTheRoot) {
  GrassShape shape = straightBlade();
  const auto tipReach = [](const Model& model) {
    const glm::vec3 tip = model.positions.back();
    return glm::length(glm::vec2(tip));
  };
  shape.clumpRadiusM = 0.0;
  EXPECT_NEAR(tipReach(growGrass(shape, 2)), 0.0f, 1e-6f);
  shape.bendDeg = 60.0;
  const Model bent = growGrass(shape, 2);
  EXPECT_GT(tipReach(bent), 0.05f);
  EXPECT_LT(bounds(bent).high.z, 0.99 * shape.heightM);
}

TEST(Procedural, bladesLeanOutward) {
  GrassShape shape;
  shape.bladesPerPlant = 60;
  shape.foldDeg = 0.0;
  const Model model = growGrass(shape, 5);
  const std::size_t perBlade = 2 * (static_cast<std::size_t>(shape.segments) + 1);
  int outward = 0, blades = 0;
  for (std::size_t first = 0; first < model.positions.size(); first += perBlade, ++blades) {
    const glm::vec2 root(model.positions[first]), tip(model.positions[first + perBlade - 1]);
    outward += glm::dot(root, tip - root) > 0.0f ? 1 : 0;
  }
  EXPECT_GT(outward, blades * 8 / 10);
}

TEST(Procedural, coloursRunFromRootToTip) {
  GrassShape shape = straightBlade();
  shape.colourVariation = 0.0;
  shape.foldDeg = 20.0;
  const Model model = growGrass(shape, 1);
  float lowest = 1.0f, highest = 0.0f;
  glm::vec3 root(0.0f), tip(0.0f);
  for (std::size_t i = 0; i < model.positions.size(); ++i) {
    if (model.uvs[i].x == 0.5f) continue;  // the midrib is a little paler
    if (model.uvs[i].y < lowest) lowest = model.uvs[i].y, root = glm::vec3(model.colours[i]);
    if (model.uvs[i].y > highest) highest = model.uvs[i].y, tip = glm::vec3(model.colours[i]);
  }
  for (int c = 0; c < 3; ++c) {
    EXPECT_NEAR(root[c], shape.rootColour[c], 1e-6);
    EXPECT_NEAR(tip[c], shape.tipColour[c], 1e-6);
  }
}

TEST(Procedural, colourAlongTheBladeFollowsItsCurve) {
  GrassShape shape = straightBlade();
  shape.colourVariation = 0.0;
  const Model plain = growGrass(shape, 1);
  shape.colourAlong = curveOf({{0.0, 0.5}, {0.25, 1.0}, {0.5, 0.0}, {1.0, 0.75}});
  const Model curved = growGrass(shape, 1);
  EXPECT_EQ(curved.positions, plain.positions);
  EXPECT_EQ(curved.triangles, plain.triangles);
  for (std::size_t row = 0; row <= 8; ++row) {
    const glm::dvec3 expected =
        glm::mix(shape.rootColour, shape.tipColour, shape.colourAlong(static_cast<double>(row) / 8.0));
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(curved.colours[2 * row][c], expected[c], 1e-6) << row;  // at the edge
  }
}

TEST(Procedural, seedHeadsStandAboveTheLeavesAndMeetTheirShare) {
  GrassShape shape;
  shape.heightVariation = 0.0;
  const float leaves = bounds(growGrass(shape, 9)).high.z;
  shape.seedHeadShare = 1.0;
  EXPECT_GT(bounds(growGrass(shape, 9)).high.z, leaves);
  shape.seedHeadShare = 0.05;  // less than one of nine blades
  int withHead = 0;
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    const Model model = growGrass(shape, seed);
    withHead += std::count(model.triangleMaterial.begin(), model.triangleMaterial.end(), 1u) > 0 ? 1 : 0;
  }
  // Binomial with p = 0.45, n = 400: mean 180, standard deviation 10; four of them.
  EXPECT_NEAR(withHead, 180, 40);
}

TEST(Procedural, flowersAndCloverKeepTheirHeights) {
  FlowerShape flower;
  flower.heightVariation = flower.bendDeg = 0.0;
  CloverShape clover;
  clover.heightVariation = clover.headShare = 0.0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    EXPECT_NEAR(bounds(growFlower(flower, seed)).high.z, flower.heightM, 0.06 * flower.heightM);
    const float top = bounds(growClover(clover, seed)).high.z;
    EXPECT_GT(top, 0.8 * clover.heightM);
    EXPECT_LT(top, 1.2 * clover.heightM);
  }
}

}  // namespace
}  // namespace sward::mesh
