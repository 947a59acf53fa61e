#include "mesh/tree.h"

#include "base/random.h"
#include "mesh/ribbon.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace sward::mesh {
namespace {

enum : std::uint32_t { kBark = 0, kLeaf = 1 };
/// Sides of a stem's tube by its level: twigs are a few pixels wide at most.
constexpr std::array kSides{10, 6, 4, 3};

/// A side that turns as little as it must from ring to ring (Wang et al. 2008 say rotation-minimising; projecting the
/// last side is enough for such bends).
std::vector<AxisRow> rowsOf(const Stem& stem) {
  std::vector<AxisRow> rows;
  glm::dvec3 side(1.0, 0.0, 0.0);
  double length = 0.0, whole = 0.0;
  for (std::size_t i = 1; i < stem.nodes.size(); ++i) {
    whole += glm::length(stem.nodes[i].centre - stem.nodes[i - 1].centre);
  }
  for (std::size_t i = 0; i < stem.nodes.size(); ++i) {
    const StemNode& node = stem.nodes[i];
    if (i > 0) length += glm::length(node.centre - stem.nodes[i - 1].centre);
    if (std::abs(glm::dot(side, node.direction)) > 0.99) side = glm::dvec3(0.0, 1.0, 0.0);
    side = glm::normalize(side - node.direction * glm::dot(side, node.direction));
    rows.push_back({node.centre, node.direction, side, whole > 0.0 ? length / whole : 0.0});
  }
  return rows;
}

void appendStem(Model& model, const TreeShape& shape, const Stem& stem, double brightness) {
  const std::vector<AxisRow> rows = rowsOf(stem);
  const auto radius = [&](double s) {
    // Rows and nodes are the same: their places on the way are increasing.
    const auto after =
        std::lower_bound(rows.begin(), rows.end(), s, [](const AxisRow& row, double at) { return row.s < at; });
    const auto i = static_cast<std::size_t>(after - rows.begin());
    return stem.nodes[std::min(i, stem.nodes.size() - 1)].radiusM;
  };
  const glm::dvec3 colour = shape.barkColour * brightness;
  const int sides = kSides[static_cast<std::size_t>(std::clamp(stem.level, 0, 3))];
  appendTube(model, {rows, radius, sides, [&](double, double) { return colour; }, kBark});
}

}  // namespace

Model treeModel(const TreeShape& shape, const TreeSkeleton& skeleton, std::uint64_t seed) {
  Model model;
  model.name = "tree";
  LeafOptics wood = shape.optics;
  wood.translucency = 0.0;
  model.materials = {plantMaterial("bark", wood), plantMaterial("leaf", shape.optics)};
  base::Random random(base::mix64(seed, 0x6c656166));
  // Twigs are younger and so a little greener and lighter than the trunk.
  for (const Stem& stem : skeleton.stems) appendStem(model, shape, stem, 1.0 + 0.12 * stem.level);
  for (const TreeLeaf& leaf : skeleton.leaves) {
    const glm::dvec3 colour = variedColour(random, shape.leafColour, shape.colourVariation);
    const double length = shape.leafLengthM * random.uniform(0.8, 1.2);
    appendScale(model, leaf.foot, leaf.along * length, leaf.face, 0.5 * shape.leafWidth * length, colour * 0.9, colour,
                kLeaf);
  }
  return model;
}

Model growTree(const TreeShape& shape, std::uint64_t seed) {
  return treeModel(shape, growSkeleton(shape, seed), seed);
}

}  // namespace sward::mesh
