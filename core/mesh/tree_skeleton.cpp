#include "mesh/tree.h"

#include "base/random.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sward::mesh {
namespace {

constexpr double kPi = std::numbers::pi;
/// Leaves of a stem crowd where a tapered cylinder is wide: Weber and Penn's shape 4.
constexpr Crown kLeavesAlong = Crown::TaperedCylindrical;

/// A turtle: it walks along z.
struct Frame {
  glm::dvec3 place{0.0};
  glm::dmat3 turn{1.0};
  glm::dvec3 direction() const { return turn[2]; }
};

glm::dmat3 aboutX(double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {{1.0, 0.0, 0.0}, {0.0, c, s}, {0.0, -s, c}};
}
glm::dmat3 aboutZ(double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {{c, s, 0.0}, {-s, c, 0.0}, {0.0, 0.0, 1.0}};
}
glm::dmat3 aboutAxis(const glm::dvec3& axis, double angle) {
  const double c = std::cos(angle), s = std::sin(angle), t = 1.0 - c;
  return {{c + t * axis.x * axis.x, t * axis.x * axis.y + s * axis.z, t * axis.x * axis.z - s * axis.y},
          {t * axis.x * axis.y - s * axis.z, c + t * axis.y * axis.y, t * axis.y * axis.z + s * axis.x},
          {t * axis.x * axis.z + s * axis.y, t * axis.y * axis.z - s * axis.x, c + t * axis.z * axis.z}};
}

/// A stem while it grows.
struct Growth {
  int level = 0;
  Frame frame;
  double lengthM = 1.0, radiusM = 0.1;
  double offsetM = 0.0;  ///< along the parent, where it left
  double parentLengthM = 1.0;
  int segment = 0;           ///< at which it begins: above 0 for a clone
  double branchShare = 1.0;  ///< of its branches: clones of one stem have as many as the stem had
  double spin = 0.0;         ///< rotation of the last branch about it
  bool left = false;         ///< of branches on two sides: where the last one stands
  glm::dvec3 forkAxis{1.0, 0.0, 0.0};
  double forkBack = 0.0;  ///< by which each further segment turns back about forkAxis, until the fork is undone
};

class Grower {
 public:
  Grower(const TreeShape& shape, std::uint64_t seed) : m_shape(shape), m_random(base::mix64(seed, 0x7472656575)) {
    m_levels = std::clamp(shape.levels, 1, 4);
    const double baseSize = std::clamp(shape.baseSize, 0.0, 0.95);
    m_tree.heightM = std::max(shape.heightM + shape.heightVariationM * m_random.uniform(-1.0, 1.0), 0.05);
    Growth trunk;
    trunk.lengthM = m_tree.heightM * std::max(varied(at(0).length, at(0).lengthVariation), 0.05);
    trunk.radiusM = trunk.lengthM * std::max(shape.ratio, 1e-5);
    m_trunkM = trunk.lengthM;
    m_bareM = baseSize * trunk.lengthM;
    trunk.spin = m_random.uniform(0.0, 2.0 * kPi);
    grow(trunk);
  }
  TreeSkeleton take() { return std::move(m_tree); }

 private:
  const TreeLevel& at(int level) const { return m_shape.level[static_cast<std::size_t>(std::min(level, 3))]; }
  double varied(double value, double by) { return value + by * m_random.uniform(-1.0, 1.0); }
  double variedRad(double deg, double byDeg) { return glm::radians(varied(deg, byDeg)); }
  bool isLast(int level) const { return level + 1 >= m_levels; }
  int segmentsOf(int level) const { return std::clamp(at(level).curveSegments, 1, 64); }

  /// Radius at z along a stem, 0 to 1 (Weber and Penn, 4.7, without their periodic taper).
  double radiusAt(const Growth& stem, double z) const {
    const double taper = std::clamp(at(stem.level).taper, 0.0, 2.0);
    const double unit = taper < 1.0 ? taper : 2.0 - taper;
    double radius = stem.radiusM * (1.0 - unit * z);
    if (stem.level == 0) {
      const double y = std::max(1.0 - 8.0 * z, 0.0);
      radius *= 1.0 + std::max(m_shape.flare, 0.0) * (std::pow(100.0, y) - 1.0) / 100.0;
    }
    return radius;
  }

  /// By how much a segment turns about its x axis.
  double curveOf(const TreeLevel& level, int segment, int segments) {
    const double back = level.curveBackDeg;
    const double each = back == 0.0              ? level.curveDeg / segments
                        : 2 * segment < segments ? 2.0 * level.curveDeg / segments
                                                 : 2.0 * back / segments;
    return variedRad(each, level.curveVariationDeg / segments);
  }

  /// Turns a frame toward the sky, or the ground: Weber and Penn, 4.8. Never past it.
  void attract(int level, int segments, Frame& frame) const {
    if (level < 2 || m_shape.attractionUp == 0.0) return;
    const double pull = m_shape.attractionUp;
    const glm::dvec3 goal(0.0, 0.0, pull > 0.0 ? 1.0 : -1.0);
    const glm::dvec3 axis = glm::cross(frame.direction(), goal);
    const double sine = glm::length(axis);
    if (sine < 1e-6) return;
    const double away = std::atan2(sine, glm::dot(frame.direction(), goal));
    const double declination = std::acos(std::clamp(frame.direction().z, -1.0, 1.0));
    const double angle = std::min(std::abs(pull) * declination * std::sin(declination) / segments, away);
    frame.turn = aboutAxis(axis / sine, angle) * frame.turn;
  }

  void grow(Growth stem) {
    if (m_tree.stems.size() >= kMostStems) return;
    const TreeLevel& level = at(stem.level);
    const int segments = segmentsOf(stem.level);
    const double step = stem.lengthM / segments;
    const std::size_t self = m_tree.stems.size();
    m_tree.stems.push_back({stem.level, {}});
    const auto node = [&](int segment) {
      const double z = static_cast<double>(segment) / segments;
      m_tree.stems[self].nodes.push_back({stem.frame.place, stem.frame.direction(), radiusAt(stem, z)});
      // The flare needs more rings than the trunk's curve does.
      if (stem.level == 0 && segment == 0 && m_shape.flare > 0.0) {
        for (const double part : {0.02, 0.05, 0.1}) {
          if (part * stem.lengthM >= 0.8 * step) break;
          m_tree.stems[self].nodes.push_back({stem.frame.place + stem.frame.direction() * (part * stem.lengthM),
                                              stem.frame.direction(), radiusAt(stem, part)});
        }
      }
    };
    std::vector<Growth> clones;
    node(stem.segment);
    for (int segment = stem.segment; segment < segments; ++segment) {
      const Frame before = stem.frame;
      stem.frame.place += stem.frame.direction() * step;
      node(segment + 1);
      populate(stem, before, segment, step);
      if (segment + 1 == segments) break;
      const double forked = stem.branchShare;
      split(stem, segment, segments, clones);
      if (stem.branchShare != forked) continue;  // a fork's angle is its own
      stem.frame.turn = aboutAxis(stem.forkAxis, stem.forkBack) * stem.frame.turn;
      stem.frame.turn = stem.frame.turn * aboutX(curveOf(level, segment, segments));
      attract(stem.level, segments, stem.frame);
    }
    for (const Growth& clone : clones) grow(clone);
  }

  /// Clones that leave at the end of a segment; the stem itself turns the other way.
  void split(Growth& stem, int segment, int segments, std::vector<Growth>& clones) {
    const TreeLevel& level = at(stem.level);
    int count = 0;
    if (stem.level == 0 && segment == 0 && m_shape.baseSplits > 0) {
      count = std::min(m_shape.baseSplits, 8);
    } else {
      // What rounding leaves over is carried to the next segment, level by level (4.2).
      double& carried = m_splitError[static_cast<std::size_t>(stem.level)];
      const double wanted = std::clamp(level.segmentSplits, 0.0, 4.0) + carried;
      count = static_cast<int>(std::floor(wanted + 0.5));
      count = std::max(count, 0);
      carried = wanted - count;
    }
    if (count == 0) return;
    stem.branchShare /= count + 1;
    const double declination = std::acos(std::clamp(stem.frame.direction().z, -1.0, 1.0));
    const Frame forked = stem.frame;
    for (int i = 0; i <= count; ++i) {
      const double least = glm::radians(4.0);  // clones that grow into one another are no fork
      const double angle = std::max(variedRad(level.splitAngleDeg, level.splitAngleVariationDeg) - declination, least);
      const double about = 2.0 * kPi * i / (count + 1) + glm::radians(20.0) * m_random.uniform(-1.0, 1.0);
      Growth clone = stem;
      clone.frame.turn = forked.turn * aboutZ(about) * aboutX(angle) * aboutZ(-about);
      clone.forkAxis = forked.turn * aboutZ(about)[0];
      clone.forkBack = -angle / (segments - segment);
      if (i == 0) {
        stem = clone;
        continue;
      }
      clone.segment = segment + 1;
      clone.spin = m_random.uniform(0.0, 2.0 * kPi);
      clones.push_back(clone);
    }
  }

  /// How many branches a whole stem carries (4.3).
  double branchesOf(const Growth& stem) const {
    const int wanted = std::clamp(at(stem.level + 1).branches, 0, 1000);
    if (stem.level == 0) return wanted;
    if (stem.level == 1) {
      const double most = std::max(at(1).length, 1e-6);
      return wanted * std::min(0.2 + 0.8 * (stem.lengthM / stem.parentLengthM) / most, 1.0);
    }
    return wanted * (1.0 - 0.5 * stem.offsetM / stem.parentLengthM);
  }

  double leavesOf(const Growth& stem) const {
    if (stem.level == 0) return m_shape.leaves;
    return m_shape.leaves * crownRatio(kLeavesAlong, std::clamp(stem.offsetM / stem.parentLengthM, 0.0, 1.0));
  }

  /// Branches and leaves along one segment.
  void populate(Growth& stem, const Frame& from, int segment, double step) {
    const bool last = isLast(stem.level);
    const double bare = stem.level == 0 ? m_bareM : 0.0;
    const double begin = std::max(segment * step, bare), end = (segment + 1) * step;
    if (end <= begin) return;
    const double whole = last ? leavesOf(stem) : branchesOf(stem);
    double& carried = m_childError[static_cast<std::size_t>(stem.level)];
    const double wanted = whole * stem.branchShare * (end - begin) / std::max(stem.lengthM - bare, 1e-9) + carried;
    const int count = std::max(static_cast<int>(std::floor(wanted + 0.5)), 0);
    carried = wanted - count;
    for (int i = 0; i < count; ++i) {
      const double offset = begin + (end - begin) * (i + m_random.uniform(0.2, 0.8)) / count;
      Frame at = from;
      at.place = from.place + from.direction() * (offset - segment * step);
      last ? addLeaf(stem, at, offset) : addBranch(stem, at, offset);
    }
  }

  /// Turned about its parent and away from it (4.3).
  Frame sideways(Growth& stem, const Frame& at, double offset, const TreeLevel& level) {
    if (level.rotateDeg >= 0.0) {
      stem.spin += variedRad(level.rotateDeg, level.rotateVariationDeg);
    } else {  // on the two sides of the parent in turn
      stem.left = !stem.left;
      stem.spin = (stem.left ? 1.0 : -1.0) * variedRad(-level.rotateDeg, level.rotateVariationDeg);
    }
    double down = 0.0;
    if (level.downAngleVariationDeg >= 0.0) {
      down = variedRad(level.downAngleDeg, level.downAngleVariationDeg);
    } else {
      const double bare = stem.level == 0 ? m_bareM : 0.0;
      const double ratio = std::clamp((stem.lengthM - offset) / std::max(stem.lengthM - bare, 1e-9), 0.0, 1.0);
      down = glm::radians(level.downAngleDeg +
                          level.downAngleVariationDeg * (1.0 - 2.0 * crownRatio(Crown::Conical, ratio)));
    }
    Frame frame = at;
    frame.turn = frame.turn * aboutZ(stem.spin) * aboutX(std::clamp(down, 0.0, kPi));
    return frame;
  }

  void addBranch(Growth& stem, const Frame& at, double offset) {
    const TreeLevel& level = this->at(stem.level + 1);
    Growth child;
    child.level = stem.level + 1;
    child.frame = sideways(stem, at, offset, level);
    const double most = std::max(varied(level.length, level.lengthVariation), 0.0);
    child.lengthM = stem.level == 0
                        ? m_trunkM * most *
                              crownRatio(m_shape.crown,
                                         std::clamp((m_trunkM - offset) / std::max(m_trunkM - m_bareM, 1e-9), 0.0, 1.0))
                        : most * (stem.lengthM - 0.6 * offset);
    if (!(child.lengthM > 1e-3)) return;
    child.offsetM = offset;
    child.parentLengthM = stem.lengthM;
    const double thinner = std::pow(child.lengthM / stem.lengthM, std::max(m_shape.ratioPower, 0.0));
    child.radiusM = std::min(stem.radiusM * thinner, radiusAt(stem, offset / stem.lengthM));
    child.radiusM = std::max(child.radiusM, 5e-4);
    child.spin = m_random.uniform(0.0, 2.0 * kPi);
    grow(child);
  }

  void addLeaf(Growth& stem, const Frame& at, double offset) {
    if (m_tree.leaves.size() >= kMostLeaves) return;
    const Frame frame = sideways(stem, at, offset, this->at(stem.level + 1));
    m_tree.leaves.push_back({frame.place, frame.turn[2], frame.turn[1]});
  }

  const TreeShape& m_shape;
  base::Random m_random;
  TreeSkeleton m_tree;
  int m_levels = 1;
  double m_trunkM = 1.0, m_bareM = 0.0;
  std::array<double, 4> m_splitError{}, m_childError{};
};

}  // namespace

double crownRatio(Crown crown, double ratio) {
  const double r = std::clamp(ratio, 0.0, 1.0);
  switch (crown) {
    case Crown::Conical:
      return 0.2 + 0.8 * r;
    case Crown::Spherical:
      return 0.2 + 0.8 * std::sin(kPi * r);
    case Crown::Hemispherical:
      return 0.2 + 0.8 * std::sin(0.5 * kPi * r);
    case Crown::Cylindrical:
      return 1.0;
    case Crown::TaperedCylindrical:
      return 0.5 + 0.5 * r;
    case Crown::Flame:
      return r <= 0.7 ? r / 0.7 : (1.0 - r) / 0.3;
    case Crown::InverseConical:
      return 1.0 - 0.8 * r;
    case Crown::TendFlame:
      return r <= 0.7 ? 0.5 + 0.5 * r / 0.7 : 0.5 + 0.5 * (1.0 - r) / 0.3;
  }
  return 1.0;
}

TreeSkeleton growSkeleton(const TreeShape& shape, std::uint64_t seed) {
  return Grower(shape, seed).take();
}

}  // namespace sward::mesh
