#pragma once

#include "mesh/model.h"
#include "mesh/options.h"

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include <glm/glm.hpp>

namespace sward::mesh {

/// Outline of a tree's crown: how long branches are over the height at which they leave the trunk (Weber and Penn 1995,
/// ShapeRatio, in its order).
enum class Crown : std::uint8_t {
  Conical,
  Spherical,
  Hemispherical,
  Cylindrical,
  TaperedCylindrical,
  Flame,
  InverseConical,
  TendFlame
};
/// Relative length of a branch; `ratio` is 0 at the top and 1 at the lowest branch.
double crownRatio(Crown crown, double ratio);

/// One level of branching: 0 the trunk, 1 its branches, and so on. Angles in degrees; the names are Weber and Penn's.
struct TreeLevel {
  int branches = 0;            ///< that leave each stem of the level before
  double length = 1.0;         ///< relative to the stem before; of the trunk: to the tree's height
  double lengthVariation = 0;  ///< absolute, of `length`
  double taper = 1.0;          ///< 0 a cylinder, 1 a cone; up to 2: the tip thickens again
  int curveSegments = 3;       ///< nCurveRes
  double curveDeg = 0.0;       ///< by which a stem has turned at its tip
  double curveBackDeg = 0.0;   ///< if not 0: the first half turns by curveDeg, the second by this
  double curveVariationDeg = 0.0;
  double downAngleDeg = 45.0;         ///< from the parent's direction
  double downAngleVariationDeg = 0.0; /**< under 0: not at random, but wider toward the parent's foot */
  double rotateDeg = 140.0;           ///< about the parent, from one branch to the next
  double rotateVariationDeg = 0.0;
  double segmentSplits = 0.0;  ///< clones that a segment of a stem splits off
  double splitAngleDeg = 0.0;
  double splitAngleVariationDeg = 0.0;
  bool operator==(const TreeLevel&) const = default;
};

/// A tree after Weber and Penn (1995), "Creation and Rendering of Realistic Trees". Metres.
struct TreeShape {
  Crown crown = Crown::TendFlame;
  double heightM = 13.0, heightVariationM = 3.0;
  double baseSize = 0.4;      ///< part of the trunk's length without branches, 0 to 0.95
  double ratio = 0.015;       ///< of the trunk's radius to its length
  double ratioPower = 1.2;    ///< by which branches are thinner than their parents
  double flare = 0.6;         ///< by how much the trunk is wider at its foot
  int baseSplits = 0;         ///< clones of the trunk at the end of its first segment
  double attractionUp = 0.5;  ///< of levels from 2 on toward the sky (under 0: toward the ground)
  int levels = 3;             ///< of branching, 1 to 4; leaves stand on the last
  std::array<TreeLevel, 4> level{};
  int leaves = 12;  ///< on a stem of the last level
  double leafLengthM = 0.17;
  double leafWidth = 1.0;                   ///< relative to its length
  glm::dvec3 barkColour{0.20, 0.17, 0.13};  ///< linear RGB
  glm::dvec3 leafColour{0.09, 0.16, 0.035};
  double colourVariation = 0.15;  ///< relative, leaf to leaf
  LeafOptics optics;              ///< of leaves; wood lets nothing through
  bool operator==(const TreeShape&) const = default;
};

/// Species of Weber and Penn's appendix, with leaves fewer and larger than theirs, so that a tree has tens of thousands
/// of triangles.
struct TreePreset {
  std::string_view name;
  TreeShape shape;
};
const std::vector<TreePreset>& treePresets();

/// Cross-section of a stem.
struct StemNode {
  glm::dvec3 centre{0.0};
  glm::dvec3 direction{0.0, 0.0, 1.0};  ///< unit
  double radiusM = 0.0;
};
struct Stem {
  int level = 0;
  std::vector<StemNode> nodes;  ///< two at least, from foot to tip
};
struct TreeLeaf {
  glm::dvec3 foot{0.0}, along{0.0, 0.0, 1.0}, face{1.0, 0.0, 0.0};  ///< `along`: unit, to the tip; `face`: unit
};
/// Where a tree's wood and leaves are, before there are triangles: what every level of detail is made from.
struct TreeSkeleton {
  double heightM = 0.0;
  std::vector<Stem> stems;  ///< parents before their branches
  std::vector<TreeLeaf> leaves;
};
/// The same seed gives the same tree. Values outside their ranges are taken as the nearest end; at most kMostStems
/// stems and kMostLeaves leaves are grown.
TreeSkeleton growSkeleton(const TreeShape& shape, std::uint64_t seed);
inline constexpr std::size_t kMostStems = 100000, kMostLeaves = 1000000;

/// Material 0 is bark, 1 leaves. Stems are tubes of 10 sides (trunk) down to 3, leaves kites of two triangles.
Model treeModel(const TreeShape& shape, const TreeSkeleton& skeleton, std::uint64_t seed);
/// Both at once.
Model growTree(const TreeShape& shape, std::uint64_t seed);

}  // namespace sward::mesh
