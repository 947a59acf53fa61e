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

/// Strands of a plant standing on z = 0. Triangles that share places of vertices make a part; a part that reaches near
/// the ground is a strand of its own, the others (petals, spikelets) hang on the strand nearest to their lowest point,
/// as a whole. Delay and droop are drawn from the seed and the strand's index. A part whose highest point is its root
/// (a leaf that hangs) bends no further. Errors: a vertex that is not finite.
Result<Strands> strandsOf(const mesh::Model& plant, const AgeingOptions& ageing, const BodyOptions& body,
                          std::uint64_t seed);

/// The strands of every plant of a patch, where it stands.
struct PatchStrands {
  std::vector<Strands> models;             ///< one a model of the patch, in its own space
  std::vector<Strand> strands;             ///< of all instances, in the patch's space, instance by instance
  std::vector<std::uint32_t> firstStrand;  ///< one an instance: index into `strands` of its model's first
};
/// Delay, droop and mingle sample are drawn anew for every instance's strands, samples by their shares. Errors: as
/// strandsOf a plant.
Result<PatchStrands> strandsOf(const scene::Patch& patch, const WitherOptions& options, std::uint64_t seed);

/// A strand at one moment: for points on and beside it. Built once a moment and strand, then asked for many points.
/// theta(s) = theta_tip s^2 turns the vein's tangents about the horizontal axis across bendTo; the vein is integrated
/// from them, so its length is kept but for the vein's strain (science.md section 4, the decision on falling). It never
/// goes under z = 0: there it runs on along the ground.
class BentStrand {
 public:
  BentStrand(const Strand& strand, const BladeState& state);
  /// Where a point that rested at `rest`, attached at s, is now: its offset from the vein turned and shrunk.
  glm::dvec3 position(const glm::dvec3& rest, double s) const;
  /// A direction at s, turned as the strand is.
  glm::dvec3 direction(const glm::dvec3& rest, double s) const;
  /// Unit tangent of the vein at s, now.
  glm::dvec3 tangent(double s) const;

 private:
  struct Node {
    glm::dvec3 rest, now;
    double cosine, sine;  ///< of the turn about the axis
  };
  std::vector<Node> m_nodes;
  glm::dvec3 m_axis{0.0};
  double m_across = 1.0;  ///< scale of offsets: 1 - strain of the mesophyll
};

}  // namespace sward::wither
