#include "wither/strand.h"

#include "mesh/procedural.h"
#include "wither/test_blades.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <set>

namespace sward::wither {
namespace {

constexpr double kPi = std::numbers::pi;

Strands found(const mesh::Model& model) {
  return strandsOf(model, AgeingOptions{}, BodyOptions{}, 1).value();
}

/// A vein straight up from a foot.
Strand upright(int segments, double length = 0.4, const glm::dvec3& foot = {0.1, 0.2, 0.0}) {
  Strand strand;
  for (int i = 0; i <= segments; ++i) strand.vein.push_back(foot + glm::dvec3(0.0, 0.0, length * i / segments));
  strand.lengthM = length;
  strand.bendTo = glm::dvec2(0.6, 0.8);
  return strand;
}

double lengthNow(const BentStrand& bent) {
  double length = 0.0;
  for (std::size_t i = 1; i < bent.nodes().size(); ++i) {
    length += glm::length(bent.nodes()[i].now - bent.nodes()[i - 1].now);
  }
  return length;
}

/// foot + integral from 0 to s of (sin theta, cos theta), theta = tip a^2, by 10,000 midpoints.
glm::dvec3 closedForm(const Strand& strand, double tip, double s) {
  glm::dvec2 sum(0.0);
  const int count = 10000;
  for (int i = 0; i < count; ++i) {
    const double a = s * (i + 0.5) / count;
    sum += glm::dvec2(std::sin(tip * a * a), std::cos(tip * a * a));
  }
  sum *= s * strand.lengthM / count;
  return strand.vein.front() + glm::dvec3(strand.bendTo * sum.x, sum.y);
}

TEST(BentStrandTest, UprightBladeFollowsTheClosedForm) {
  const double tip = 1.9;
  double last = 0.0;
  for (const int segments : {24, 48, 96}) {
    const Strand strand = upright(segments);
    const BentStrand bent(strand, {0.0, 0.0, tip});
    double worst = 0.0;
    for (const double s : {0.0, 0.25, 0.5, 0.75, 1.0}) {
      const glm::dvec3 rest = strand.vein.front() + glm::dvec3(0.0, 0.0, s * strand.lengthM);
      worst = std::max(worst, glm::length(bent.position(rest, s) - closedForm(strand, tip, s)));
      const double theta = tip * s * s;
      const glm::dvec3 exact(strand.bendTo * std::sin(theta), std::cos(theta));
      // Chords stand for the tangent of the segment's middle: half a segment from the ends.
      EXPECT_LT(glm::length(bent.tangent(s) - exact), 1.1 * tip / segments);
    }
    // A midpoint step's error is h^3 / 24 times the second derivative of (sin, cos)(tip s^2), at most 2 tip + (2
    // tip)^2.
    EXPECT_LT(worst, strand.lengthM * (2.0 * tip + 4.0 * tip * tip) / 24.0 / segments / segments);
    if (last > 0.0) {
      EXPECT_NEAR(std::log2(last / worst), 2.0, 0.2);
    }
    last = worst;
  }
}

TEST(BentStrandTest, KeepsItsLengthButForTheStrain) {
  for (const double tip : {0.0, 0.3, 1.5, 2.9}) {
    for (const double strain : {0.0, 0.04, 0.3}) {
      const BentStrand bent(upright(12), {strain, 0.2, tip});
      EXPECT_NEAR(lengthNow(bent), 0.4 * (1.0 - strain), 1e-6 * 0.4) << tip << " " << strain;
    }
  }
}

TEST(BentStrandTest, TipTurnsMostAndTheRootRests) {
  const Strand strand = upright(12);
  const BentStrand bent(strand, {0.02, 0.3, 1.2});
  EXPECT_EQ(bent.position(strand.vein.front(), 0.0), strand.vein.front());
  double last = 0.0;
  for (int i = 1; i <= 20; ++i) {
    const double turn = std::acos(std::min(bent.direction({0.0, 0.0, 1.0}, i / 20.0).z, 1.0));
    EXPECT_GT(turn, last);
    last = turn;
  }
  EXPECT_NEAR(last, 1.2, 0.01);
  EXPECT_EQ(bent.direction({0.0, 0.0, 1.0}, 0.0), glm::dvec3(0.0, 0.0, 1.0));
}

TEST(BentStrandTest, AtRestNothingMoves) {
  const mesh::Model grass = mesh::growGrass({}, 3);
  const Strands strands = found(grass);
  for (const Strand& strand : strands.strands) {
    const BentStrand bent(strand, {});
    for (const glm::vec3& p : grass.positions) {
      for (const double s : {0.0, 0.37, 1.0}) {
        EXPECT_LT(glm::length(bent.position(glm::dvec3(p), s) - glm::dvec3(p)), 1e-12);
      }
    }
  }
}

TEST(BentStrandTest, NormalsStayPerpendicular) {
  const Strand strand = upright(12);
  const BentStrand bent(strand, {0.03, 0.25, 1.7});
  for (int i = 0; i <= 30; ++i) {
    const double s = i / 30.0;
    const glm::dvec3 tangent = bent.direction({0.0, 0.0, 1.0}, s);
    for (const double angle : {0.0, 0.8, 2.2, 4.0}) {
      const glm::dvec3 normal = bent.direction({std::cos(angle), std::sin(angle), 0.0}, s);
      EXPECT_NEAR(glm::length(normal), 1.0, 1e-12);
      EXPECT_NEAR(glm::dot(normal, tangent), 0.0, 1e-12);
    }
  }
}

TEST(BentStrandTest, OffsetsShrinkAcross) {
  const Strand strand = upright(12);
  const BentStrand bent(strand, {0.0, 0.25, 1.0});
  const glm::dvec3 on = strand.vein[6];
  const glm::dvec3 beside = on + glm::dvec3(0.003, -0.001, 0.0);
  const double now = glm::length(bent.position(beside, 0.5) - bent.position(on, 0.5));
  EXPECT_NEAR(now, 0.75 * glm::length(beside - on), 1e-12);
}

TEST(BentStrandTest, NeverGoesUnderTheGround) {
  // A short foot, then a blade that already leans far over: its tip would go deep.
  Strand strand;
  for (int i = 0; i <= 12; ++i) strand.vein.emplace_back(0.03 * i, 0.0, 0.1 * std::sin(kPi * i / 12.0));
  strand.lengthM = 0.43;
  const BentStrand bent(strand, {0.0, 0.0, 2.5});
  double rest = 0.0;
  for (std::size_t i = 1; i < strand.vein.size(); ++i) rest += glm::length(strand.vein[i] - strand.vein[i - 1]);
  EXPECT_NEAR(lengthNow(bent), rest, 1e-6 * rest);
  for (int i = 0; i <= 100; ++i) {
    const double s = i / 100.0;
    const glm::dvec3 point = bent.nodes()[static_cast<std::size_t>(s * 24.0)].rest;
    EXPECT_GE(bent.position(point, s).z, 0.0);
    EXPECT_GE(bent.position(point - glm::dvec3(0.0, 0.0, 0.003), s).z, -0.003);
  }
  const BentStrand tall(upright(12), {0.0, 0.0, 3.0});
  for (const BentStrand::Node& node : tall.nodes()) EXPECT_GE(node.now.z, 0.0);
}

TEST(BentStrandTest, BladeLyingFlatStays) {
  Strand strand;
  for (int i = 0; i <= 12; ++i) strand.vein.emplace_back(0.02 * i, 0.0, 0.0);
  strand.lengthM = 0.24;
  const BentStrand bent(strand, {0.0, 0.0, 2.0});
  for (const BentStrand::Node& node : bent.nodes()) {
    EXPECT_LT(glm::length(node.now - node.rest), 1e-12);
    EXPECT_NEAR(node.sine, 0.0, 1e-12);
  }
}

TEST(BentStrandTest, HangingLeafStays) {
  Strand strand;
  for (int i = 0; i <= 12; ++i) strand.vein.emplace_back(0.0, 0.0, 0.5 - 0.02 * i);
  strand.lengthM = 0.24;
  const BentStrand bent(strand, {0.0, 0.0, 2.0});
  for (const BentStrand::Node& node : bent.nodes()) EXPECT_LT(glm::length(node.now - node.rest), 1e-12);
}

TEST(BentStrandTest, StrandWithoutLengthIsHarmless) {
  Strand strand;
  strand.vein.assign(2, glm::dvec3(0.1, 0.1, 0.0));
  for (const BladeState& state : {BladeState{}, BladeState{0.3, 0.6, 2.0}}) {
    const BentStrand bent(strand, state);
    EXPECT_EQ(bent.position(strand.vein[0], 0.5), strand.vein[0]);
    EXPECT_EQ(bent.tangent(0.3), glm::dvec3(0.0, 0.0, 1.0));
    EXPECT_TRUE(std::isfinite(bent.position({0.1, 0.1, 0.01}, 1.0).z));
    EXPECT_TRUE(std::isfinite(bent.position({0.1, 0.1, 0.01}, std::numeric_limits<double>::quiet_NaN()).z));
  }
  strand.vein.assign(1, glm::dvec3(0.0));
  EXPECT_EQ(BentStrand(strand, {0.1, 0.1, 1.0}).position({0.0, 0.0, 0.0}, 1.0), glm::dvec3(0.0));
}

TEST(StrandsOf, GrassHasAStrandABlade) {
  mesh::GrassShape shape;
  shape.bladesPerPlant = 9;
  const mesh::Model grass = mesh::growGrass(shape, 5);
  const Strands strands = found(grass);
  ASSERT_EQ(strands.attachments.size(), grass.positions.size());
  // Blades of two halves that meet at the midrib are one part each.
  ASSERT_EQ(strands.strands.size(), 9u);
  for (std::size_t i = 0; i < grass.positions.size(); ++i) {
    const Attachment& at = strands.attachments[i];
    ASSERT_GE(at.strand, 0);
    // u, v of a ribbon are its place across and along.
    EXPECT_NEAR(at.s, grass.uvs[i].y, 0.04) << i;
  }
  for (const Strand& strand : strands.strands) {
    EXPECT_NEAR(glm::length(strand.bendTo), 1.0, 1e-12);
    const double spacing = strand.lengthM / static_cast<double>(strand.vein.size() - 1);
    for (std::size_t i = 1; i < strand.vein.size(); ++i) {
      EXPECT_NEAR(glm::length(strand.vein[i] - strand.vein[i - 1]), spacing, 0.02 * spacing);
    }
  }
}

/// The vein runs inside the blade: nearer to its middle than half its width.
TEST(StrandsOf, VeinRunsInsideTheBlade) {
  mesh::GrassShape shape;
  shape.bladesPerPlant = 1;
  shape.foldDeg = 0.0;
  shape.segments = 12;
  const mesh::Model grass = mesh::growGrass(shape, 7);
  const Strand strand = found(grass).strands.at(0);
  for (std::size_t i = 1; i + 1 < strand.vein.size(); ++i) {
    double nearest = 1.0;  // to the middle line, joined row by row: vertices 2 k and 2 k + 1 are the edges of row k
    for (std::size_t row = 0; row + 1 < grass.positions.size() / 2; ++row) {
      const auto middle = [&](std::size_t r) {
        return 0.5 * (glm::dvec3(grass.positions[2 * r]) + glm::dvec3(grass.positions[2 * r + 1]));
      };
      for (int k = 0; k <= 8; ++k) {
        nearest = std::min(nearest, glm::length(glm::mix(middle(row), middle(row + 1), k / 8.0) - strand.vein[i]));
      }
    }
    EXPECT_LT(nearest, 0.5 * shape.widthM) << i;
  }
}

TEST(StrandsOf, HeadsHangAsAWhole) {
  mesh::GrassShape shape;
  shape.seedHeadShare = 0.4;
  const mesh::Model grass = mesh::growGrass(shape, 2);
  const Strands strands = found(grass);
  EXPECT_EQ(strands.strands.size(), 9u);
  for (std::size_t t = 0; t < grass.triangles.size(); ++t) {
    const Attachment &a = strands.attachments[grass.triangles[t].x], &b = strands.attachments[grass.triangles[t].y];
    EXPECT_EQ(a.strand, b.strand);
    if (grass.triangleMaterial[t] == 1 && grass.positions[grass.triangles[t].x].z > 0.45f) {
      EXPECT_GT(a.s, 0.5f);
    }
  }
  const mesh::Model flower = mesh::growFlower({}, 4), clover = mesh::growClover({}, 4);
  EXPECT_GE(found(flower).strands.size(), 1u);
  EXPECT_GE(found(clover).strands.size(), 5u);
  for (const mesh::Model* model : {&flower, &clover}) {
    const Strands hung = found(*model);
    for (const Attachment& at : hung.attachments) EXPECT_GE(at.strand, 0);
  }
}

TEST(StrandsOf, CrossedCardsAreTwoStrands) {
  mesh::Model cards = flatBlade(1, 0.4, 0.2);
  append(cards, turned(flatBlade(1, 0.4, 0.2), kPi / 2.0));
  const Strands strands = found(cards);
  ASSERT_EQ(strands.strands.size(), 2u);
  for (std::size_t i = 0; i < cards.positions.size(); ++i) {
    EXPECT_NEAR(strands.attachments[i].s, cards.positions[i].z > 0.2f ? 1.0 : 0.0, 1e-6) << i;
  }
  EXPECT_NEAR(strands.strands[0].lengthM, 0.4, 0.01);
}

TEST(StrandsOf, ClosedSolid) {
  const mesh::Model stem = tube(16, 24, 0.01, 0.5);
  const Strands strands = found(stem);
  ASSERT_EQ(strands.strands.size(), 1u);
  for (std::size_t i = 0; i < stem.positions.size(); ++i) {
    EXPECT_NEAR(strands.attachments[i].s, stem.positions[i].z / 0.5, 0.04);
  }
  for (const glm::dvec3& p : strands.strands[0].vein) EXPECT_LT(std::hypot(p.x, p.y), 0.005);
}

TEST(StrandsOf, OddMeshes) {
  EXPECT_TRUE(found(mesh::Model{}).strands.empty());
  mesh::Model one = flatBlade(1, 0.4, 0.1);
  one.positions.emplace_back(1.0f, 1.0f, 1.0f);  // used by no triangle
  EXPECT_EQ(found(one).attachments.back().strand, -1);
  mesh::Model point = flatBlade(2, 0.0, 0.0);  // all in one place
  const Strands collapsed = found(point);
  ASSERT_EQ(collapsed.strands.size(), 1u);
  EXPECT_EQ(collapsed.strands[0].lengthM, 0.0);
  mesh::Model floating = flatBlade(4, 0.3, 0.01);
  for (glm::vec3& p : floating.positions) p.z += 5.0f;
  EXPECT_EQ(found(floating).strands.size(), 1u);
  mesh::Model bad = flatBlade(2, 0.3, 0.01);
  bad.positions[3].y = std::numeric_limits<float>::quiet_NaN();
  EXPECT_FALSE(strandsOf(bad, AgeingOptions{}, BodyOptions{}, 1).ok());
  bad = flatBlade(2, 0.3, 0.01);
  bad.triangles[0].y = 1000;
  EXPECT_FALSE(strandsOf(bad, AgeingOptions{}, BodyOptions{}, 1).ok());
}

TEST(StrandsOf, LyingBladeIsRootedAtTheFoot) {
  mesh::Model blade = flatBlade(10, 0.3, 0.01);
  for (glm::vec3& p : blade.positions) p = {p.z + 0.01f, p.x, 0.0f};  // along x, from 0.01 to 0.31
  const Strands strands = found(blade);
  ASSERT_EQ(strands.strands.size(), 1u);
  EXPECT_NEAR(strands.strands[0].vein.front().x, 0.01, 0.02);
  EXPECT_NEAR(strands.strands[0].vein.back().x, 0.31, 0.01);
  EXPECT_GT(strands.strands[0].droop, 0.0);
}

TEST(StrandsOf, TuftInOneMeshIsAStrandABlade) {
  // Five blades that lean out from one vertex, through which all are joined.
  mesh::Model tuft;
  tuft.materials.emplace_back();
  const int blades = 5, segments = 6;
  for (int k = 0; k < blades; ++k) {
    mesh::Model blade = flatBlade(segments, 0.3 - 0.02 * k, 0.01);
    for (glm::vec3& p : blade.positions) {
      if (p.z == 0.0f) p = {0.0f, 0.0f, 0.0f};
      p.y += 0.5f * p.z;
    }
    append(tuft, turned(blade, 2.0 * kPi * k / blades));
  }
  const Strands strands = found(tuft);
  ASSERT_EQ(strands.strands.size(), 5u);
  for (std::size_t i = 0; i < tuft.positions.size(); ++i) {
    const Attachment& at = strands.attachments[i];
    const glm::dvec3 p(tuft.positions[i]);
    if (p.z == 0.0) {
      EXPECT_LT(at.s, 0.01f);
      continue;
    }
    const Strand& strand = strands.strands[static_cast<std::size_t>(at.strand)];
    EXPECT_NEAR(at.s, p.z / strand.vein.back().z, 0.05);
    // The lowest row of the shortest blade: 5 mm beside its middle, 18 mm out.
    EXPECT_GT(glm::dot(strand.bendTo, glm::dvec2(p) / glm::length(glm::dvec2(p))), 0.96);
    EXPECT_NEAR(strand.vein.front().z, 0.0, 1e-9);
  }
}

TEST(StrandsOf, HangingLeafHasNoDroop) {
  mesh::Model blade = flatBlade(8, 0.3, 0.01);
  mesh::Model rim = blade;
  for (glm::vec3& p : rim.positions) p.z = -p.z;  // over the edge of a pot
  const Strands strands = found(rim);
  ASSERT_EQ(strands.strands.size(), 1u);
  // Its root is its lowest point, as far as a mesh tells: it is a blade that stands under the ground.
  EXPECT_EQ(strands.strands[0].vein.front().z, -0.3f);
}

TEST(StrandsOf, ManyTrianglesAreQuick) {
  // 102,400 triangles of one part; what is tested is the result, the speed is the report's.
  const mesh::Model large = tube(200, 256, 0.02, 0.6);
  const Strands strands = found(large);
  ASSERT_EQ(strands.strands.size(), 1u);
  EXPECT_NEAR(strands.strands[0].lengthM, 0.6, 0.03);
}

TEST(PatchStrandsTest, StandWhereThePlantsStand) {
  mesh::GrassShape shape;
  std::vector<std::shared_ptr<const mesh::Model>> models;
  for (std::uint64_t seed = 0; seed < 2; ++seed) {
    models.push_back(std::make_shared<mesh::Model>(mesh::growGrass(shape, seed)));
  }
  scene::PlantScatter plants;
  plants.count = 40;
  plants.models = {0, 1};
  const scene::Patch patch = scene::scatter(1.0, models, {plants}, 9);
  WitherOptions options;
  options.mingle = {{"late", 1.0, 1.0, {}}, {"none", 0.0, 1.0, {}}, {"early", 3.0, 1.0, {}}};
  const PatchStrands strands = strandsOf(patch, options, 11).value();
  ASSERT_EQ(strands.firstStrand.size(), patch.instances.size());
  std::set<double> delays;
  int early = 0;
  for (std::size_t i = 0; i < patch.instances.size(); ++i) {
    const scene::Instance& instance = patch.instances[i];
    const Strands& model = strands.models[instance.model];
    const double scale = glm::length(glm::dvec3(instance.worldFromModel[0]));
    for (std::size_t k = 0; k < model.strands.size(); ++k) {
      const Strand& strand = strands.strands.at(strands.firstStrand[i] + k);
      const glm::dvec3 tip = instance.worldFromModel * glm::vec4(model.strands[k].vein.back(), 1.0f);
      EXPECT_LT(glm::length(tip - strand.vein.back()), 1e-6);
      EXPECT_NEAR(strand.lengthM, scale * model.strands[k].lengthM, 1e-6);
      EXPECT_NE(strand.sample, 1);
      EXPECT_LE(std::abs(strand.delay), 2.0 * options.ageing.variation);
      early += strand.sample == 2 ? 1 : 0;
      delays.insert(strand.delay);
    }
  }
  EXPECT_GT(delays.size(), strands.strands.size() * 9 / 10);  // a few are cut to the same ends
  // Three quarters, within four standard deviations.
  const auto count = static_cast<double>(strands.strands.size());
  EXPECT_NEAR(early / count, 0.75, 4.0 * std::sqrt(0.75 * 0.25 / count));
  const PatchStrands again = strandsOf(patch, options, 11).value();
  EXPECT_EQ(again.strands.back().delay, strands.strands.back().delay);
  scene::Patch bad = patch;
  bad.instances[3].worldFromModel[3].x = std::numeric_limits<float>::infinity();
  EXPECT_FALSE(strandsOf(bad, options, 1).ok());
}

}  // namespace
}  // namespace sward::wither
