#pragma once

#include "base/result.h"
#include "mesh/model.h"
#include "scene/patch.h"
#include "wither/season.h"

#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

namespace sward::wither {

/// A blade, stem or leaf that bends as one: its vein as a polyline at rest, and how it differs from its neighbours.
struct Strand {
  std::vector<glm::dvec3> vein;  ///< from the root to the tip, metres; at least two points, evenly spaced along it
  double lengthM = 0.0;          ///< along the vein
  glm::dvec2 bendTo{1.0, 0.0};   ///< unit, horizontal: where its tip sinks to
  double delay = 0.0;            ///< of the season: starts later (above 0) or earlier than the sward
  double droop = 1.0;            ///< times BodyOptions::droopDeg
  int sample = 0;                ///< index of the mingle sample it belongs to
};

/// Where a point hangs on a strand: s along the vein, in [0, 1].
struct Attachment {
  std::int32_t strand = -1;  ///< -1: on none; stays where it is
  float s = 0.0f;
};

/// A mesh taken apart into strands, with an attachment for every vertex.
struct Strands {
  std::vector<Strand> strands;
  std::vector<Attachment> attachments;  ///< one a vertex, or a point
};

/// Strands of a plant standing on z = 0. Triangles that share places of vertices make a part (mesh::findParts); a part
/// that reaches near the ground is a strand of its own, the others (petals, spikelets) hang on the strand nearest to
/// their lowest point, as a whole: all at one s. Where no part is near the ground, the lowest counts as such.
/// The root is, of what lies as low as the part's lowest vertex, what is nearest to the plant's foot; the vein joins
/// the middles of sections at even distances along the surface from there. Vertices hang on the nearest place of the
/// vein. Delay and droop are drawn from the seed and the strand's index. A part whose highest point is its root (a leaf
/// that hangs) has droop 0. Vertices that no triangle uses hang on nothing. Errors: a vertex that is not finite, a
/// triangle that names a vertex that is not there.
Result<Strands> strandsOf(const mesh::Model& plant, const AgeingOptions& ageing, const BodyOptions& body,
                          std::uint64_t seed);

/// The strands of every plant of a patch, where it stands.
struct PatchStrands {
  std::vector<Strands> models;             ///< one a model of the patch, in its own space
  std::vector<Strand> strands;             ///< of all instances, in the patch's space, instance by instance
  std::vector<std::uint32_t> firstStrand;  ///< one an instance: index into `strands` of its model's first
};
/// Delay, droop and mingle sample are drawn anew for every instance's strands, samples by their shares. Errors: as
/// strandsOf a plant; a transform that is not finite.
Result<PatchStrands> strandsOf(const scene::Patch& patch, const WitherOptions& options, std::uint64_t seed);

/// A strand at one moment: for points on and beside it. Built once a moment and strand, then asked for many points.
/// theta(s) = theta_tip s^2 turns the vein's tangents about the horizontal axis across bendTo; the vein is integrated
/// from them, so its length is kept but for the vein's strain (science.md section 4, the decision on falling). No
/// tangent turns past 175 degrees from upright, so that what hangs already stays. The vein never goes under z = 0:
/// there it runs on along the ground. What rests under the ground is kept from going deeper.
class BentStrand {
 public:
  BentStrand(const Strand& strand, const BladeState& state);
  /// Where a point that rested at `rest`, attached at s, is now: its offset from the vein turned and shrunk. The state
  /// at rest gives `rest` to rounding.
  glm::dvec3 position(const glm::dvec3& rest, double s) const;
  /// A direction at s, turned as the strand is; its length is kept.
  glm::dvec3 direction(const glm::dvec3& rest, double s) const;
  /// Unit tangent of the vein at s, now; up where the strand has no length.
  glm::dvec3 tangent(double s) const;

  /// One point of the vein. Public for loops over many points, which read the nodes themselves.
  struct Node {
    glm::dvec3 rest{0.0}, now{0.0};
    double cosine = 1.0, sine = 0.0;  ///< of the turn about the axis
  };
  const std::vector<Node>& nodes() const { return m_nodes; }  ///< evenly spaced along s from 0 to 1
  const glm::dvec3& axis() const { return m_axis; }           ///< unit, horizontal
  double across() const { return m_across; }                  ///< scale of offsets: 1 - strain across

 private:
  struct Place {
    std::size_t node;
    double t;
  };
  Place placeOf(double s) const;
  glm::dvec3 turned(const glm::dvec3& v, const Place& at) const;
  std::vector<Node> m_nodes;
  glm::dvec3 m_axis{0.0, 1.0, 0.0};
  double m_across = 1.0;
};

}  // namespace sward::wither
