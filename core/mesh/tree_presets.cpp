#include "mesh/tree.h"

namespace sward::mesh {
namespace {

/// A branch level by its commonest values; what is left out is TreeLevel's own.
struct Branch {
  double down, downV, rotate, rotateV;
  int branches;
  double length, lengthV, taper;
  int segments;
  double curve, back, curveV;
};
TreeLevel branch(const Branch& b) {
  TreeLevel level;
  level.downAngleDeg = b.down;
  level.downAngleVariationDeg = b.downV;
  level.rotateDeg = b.rotate;
  level.rotateVariationDeg = b.rotateV;
  level.branches = b.branches;
  level.length = b.length;
  level.lengthVariation = b.lengthV;
  level.taper = b.taper;
  level.curveSegments = b.segments;
  level.curveDeg = b.curve;
  level.curveBackDeg = b.back;
  level.curveVariationDeg = b.curveV;
  return level;
}

TreeShape quakingAspen() {
  TreeShape t;
  t.crown = Crown::TendFlame;
  t.heightM = 13.0;
  t.heightVariationM = 3.0;
  t.baseSize = 0.4;
  t.ratio = 0.015;
  t.ratioPower = 1.2;
  t.flare = 0.6;
  t.attractionUp = 0.5;
  t.levels = 3;
  t.level = {
      branch({0, 0, 0, 0, 0, 1.0, 0, 1.0, 8, 0, 0, 20}), branch({60, -50, 140, 0, 50, 0.3, 0, 1.0, 5, -40, 0, 50}),
      branch({45, 10, 140, 0, 30, 0.6, 0, 1.0, 3, -40, 0, 75}), branch({45, 10, 77, 0, 10, 0, 0, 1.0, 1, 0, 0, 0})};
  t.leaves = 12;
  t.leafLengthM = 0.2;
  t.barkColour = {0.42, 0.40, 0.33};
  t.leafColour = {0.13, 0.2, 0.045};
  return t;
}

TreeShape blackTupelo() {
  TreeShape t;
  t.crown = Crown::TaperedCylindrical;
  t.heightM = 23.0;
  t.heightVariationM = 5.0;
  t.baseSize = 0.2;
  t.ratio = 0.015;
  t.ratioPower = 1.3;
  t.flare = 1.0;
  t.attractionUp = 0.5;
  t.levels = 4;
  t.level = {branch({0, 0, 0, 0, 0, 1.0, 0, 1.1, 10, 0, 0, 40}),
             branch({60, -40, 140, 0, 50, 0.3, 0.05, 1.0, 8, 0, 0, 90}),
             branch({30, 10, 140, 0, 20, 0.6, 0.1, 1.0, 4, -10, 0, 120}),
             branch({45, 10, 140, 0, 8, 0.4, 0, 1.0, 1, 0, 0, 0})};
  t.leaves = 4;
  t.leafLengthM = 0.34;
  t.leafWidth = 0.5;
  t.barkColour = {0.14, 0.115, 0.085};
  t.leafColour = {0.085, 0.155, 0.035};
  return t;
}

TreeShape weepingWillow() {
  TreeShape t;
  t.crown = Crown::Cylindrical;
  t.heightM = 15.0;
  t.heightVariationM = 5.0;
  t.baseSize = 0.05;
  t.ratio = 0.03;
  t.ratioPower = 2.0;
  t.flare = 0.75;
  t.baseSplits = 2;
  t.attractionUp = -3.0;
  t.levels = 4;
  t.level = {branch({0, 0, 0, 0, 0, 0.8, 0, 1.0, 8, 0, 20, 120}),
             branch({20, 10, -120, 30, 25, 0.5, 0.1, 1.0, 12, 40, 80, 90}),
             branch({30, 10, -120, 30, 10, 1.5, 0, 1.0, 12, 0, 0, 0}),
             branch({20, 10, 140, 0, 40, 0.1, 0, 1.0, 1, 0, 0, 0})};
  t.level[0].segmentSplits = 0.1;
  t.level[0].splitAngleDeg = 30.0;
  t.level[1].segmentSplits = 0.2;
  t.level[1].splitAngleDeg = 30.0;
  t.level[1].splitAngleVariationDeg = 10.0;
  t.leaves = 7;
  t.leafLengthM = 0.32;
  t.leafWidth = 0.2;
  t.barkColour = {0.19, 0.16, 0.115};
  t.leafColour = {0.135, 0.205, 0.07};
  return t;
}

TreeShape blackOak() {
  TreeShape t;
  t.crown = Crown::Hemispherical;
  t.heightM = 10.0;
  t.heightVariationM = 3.0;
  t.baseSize = 0.05;
  t.ratio = 0.018;
  t.ratioPower = 1.3;
  t.flare = 1.2;
  t.baseSplits = 2;
  t.attractionUp = 0.8;
  t.levels = 3;
  t.level = {
      branch({0, 0, 0, 0, 0, 1.0, 0, 0.95, 8, 0, 0, 90}), branch({30, -30, 80, 0, 40, 0.8, 0.1, 1.0, 10, 40, -70, 150}),
      branch({45, 10, 140, 0, 60, 0.2, 0.05, 1.0, 3, 0, 0, -30}), branch({45, 10, 140, 0, 0, 0.4, 0, 1.0, 1, 0, 0, 0})};
  t.level[0].segmentSplits = 0.4;
  t.level[0].splitAngleDeg = 10.0;
  t.level[1].segmentSplits = 0.2;
  t.level[1].splitAngleDeg = 10.0;
  t.level[1].splitAngleVariationDeg = 10.0;
  t.level[2].segmentSplits = 0.1;
  t.level[2].splitAngleDeg = 10.0;
  t.level[2].splitAngleVariationDeg = 10.0;
  t.leaves = 12;
  t.leafLengthM = 0.26;
  t.leafWidth = 0.66;
  t.barkColour = {0.12, 0.1, 0.075};
  t.leafColour = {0.075, 0.13, 0.032};
  return t;
}

}  // namespace

const std::vector<TreePreset>& treePresets() {
  static const std::vector<TreePreset> presets{{"quaking aspen", quakingAspen()},
                                               {"black tupelo", blackTupelo()},
                                               {"weeping willow", weepingWillow()},
                                               {"black oak", blackOak()}};
  return presets;
}

}  // namespace sward::mesh
