#pragma once

#include "base/job.h"
#include "base/result.h"
#include "wither/points.h"
#include "wither/season.h"
#include "wither/strand.h"
#include "wither/withered_model.h"

#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

namespace sward::wither {

/// All strands of a sward at one weathering degree, laid out for loops over many points.
class SwardPose {
 public:
  /// Blades of mingle samples age by their sample's curve (SampleSeasons).
  SwardPose(std::span<const Strand> strands, const Season& season, std::span<const MingleSample> samples,
            double weathering, const JobContext& job);

  /// Moves points from where they rest: as BentStrand does, in single precision (to 1e-6 of the block). Writes
  /// positions, normals, tangents, spreads and areas of `moved`, which shrink with length and width; where a strand
  /// rests, or a point hangs on none, they are copied to the last bit. The rest of `moved` is copied from `rest` where
  /// its size differed. Errors: a point on a strand that is not there.
  Result<void> move(const Points& rest, Points& moved, const JobContext& job) const;
  /// Ages diffuse and transmitted colours of `moved` from those at rest. Shares are taken linear between 17 places of
  /// each blade. Where the moment is 0 they stay.
  Result<void> age(const Points& rest, const AgeColour& colour, Points& moved, const JobContext& job) const;
  /// Both, reading the points once.
  Result<void> moveAndAge(const Points& rest, const AgeColour& colour, Points& moved, const JobContext& job) const;

 private:
  static constexpr std::size_t kShares = 17;
  struct Node {
    glm::vec3 rest;
    float cosine;
    glm::vec3 now;
    float sine;
  };
  struct Body {
    std::uint32_t first = 0;  ///< node
    float segments = 0.0f;
    glm::vec2 bendTo{1.0f, 0.0f};
    float across = 1.0f, area = 1.0f;
    bool rests = true;  ///< nothing has moved
    bool fresh = true;  ///< nothing has aged
  };
  void moveRange(const Points& rest, Points& moved, std::size_t begin, std::size_t end) const;
  void ageRange(const Points& rest, const AgeColour& colour, Points& moved, std::size_t begin, std::size_t end) const;
  template <typename Range>
  Result<void> forRanges(const Points& rest, Points& moved, const JobContext& job, const Range& range) const;

  std::vector<Body> m_bodies;
  std::vector<Node> m_nodes;
  std::vector<Season::Shares> m_shares;  ///< kShares a strand
};

/// Both steps. `moved` may be empty or what an earlier call gave.
Result<void> pose(const Points& rest, std::span<const Strand> strands, const Season& season,
                  std::span<const MingleSample> samples, double weathering, const AgeColour& colour, Points& moved,
                  const JobContext& job);

/// The paper's own motion, for comparison: a point turns on its circle about the root by tip (h_tip / h)^2, h its
/// height at rest (omega_i = omega / h_i^2), cut at 175 degrees since the printed form has no bound at the root; its
/// tangent is the line from its foot (section 2.3), and its normal turns as the tangent does. It stretches the blade.
/// No shrinking, no colours. Points under the ground are lifted on it.
Result<void> paperPose(const Points& rest, std::span<const Strand> strands, const Season& season,
                       std::span<const MingleSample> samples, double weathering, Points& moved, const JobContext& job);

}  // namespace sward::wither
