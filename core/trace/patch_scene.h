#pragma once

#include "base/job.h"
#include "base/result.h"
#include "scene/patch.h"

#include <cstdint>
#include <memory>

#include <glm/glm.hpp>

namespace sward::trace {

/// Rays traced since the scene was made, for the report.
struct RayCounts {
  std::uint64_t nearest = 0;
  std::uint64_t occlusion = 0;
};

/// An Embree scene of a patch, with those copies from the neighbouring patches that reach into the square. The patch
/// holds instances; tracing lays them out as one flat tree while that stays under two million triangles, since tufts
/// overlap so much that a tree of instances traced ten times slower, and as one tree a model with instances on top
/// beyond that. Both find the same hits (a test shows it). Rays that leave the square go on at the opposite side
/// (exactly periodic, at any inclination), until they are above the patch's height. Alpha counts as a chance of a hit,
/// decided by a hash of the ray and the primitive, so that results repeat.
class PatchScene {
 public:
  /// An error when Embree cannot be had. A patch without instances is fine: nothing is ever hit.
  /// A cancelled job returns Error::cancelled(), also while the tree is built.
  static Result<std::unique_ptr<PatchScene>> create(std::shared_ptr<const scene::Patch> patch,
                                                    const JobContext& job = {});
  ~PatchScene();

  const scene::Patch& patch() const;
  RayCounts rayCounts() const;

  struct Impl;
  Impl& impl() const { return *m_impl; }  ///< for the sources of core/trace

 private:
  PatchScene();
  std::unique_ptr<Impl> m_impl;
};

}  // namespace sward::trace
