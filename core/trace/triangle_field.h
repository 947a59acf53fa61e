#pragma once

#include "base/job.h"
#include "base/result.h"
#include "trace/layer_pattern.h"
#include "trace/layers.h"

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <glm/glm.hpp>

namespace sward::trace {

/// All triangles of a patch's plants, laid out in the world, for sampling a few layers without a tree of rays: building
/// one takes longer than passing over all triangles a dozen times. Finds what a PatchScene finds (a test compares them)
/// in time proportional to triangles, where rays take time proportional to samples: for coarse samplings alone.
/// Periodic like PatchScene.
class TriangleField {
 public:
  /// Errors: a vertex or a transform that is not finite, a plant far larger than the patch, over 2^32 triangles.
  static Result<std::unique_ptr<TriangleField>> create(std::shared_ptr<const scene::Patch> patch,
                                                       const JobContext& job);

  /// An instance's part of the field.
  struct Part {
    std::uint32_t instance = 0;
    std::uint32_t firstTriangle = 0;  ///< in the numbers of all triangles
    std::size_t firstVertex = 0;      ///< in positions()
    const mesh::Model* model = nullptr;
    bool alpha = false;
  };
  const scene::Patch& patch() const { return *m_patch; }
  std::span<const Part> parts() const { return m_parts; }
  std::span<const glm::vec3> positions() const { return m_positions; }
  std::uint64_t triangles() const { return m_triangles; }
  const Part& partOf(std::uint32_t triangle) const;

 private:
  std::shared_ptr<const scene::Patch> m_patch;
  std::vector<Part> m_parts;
  std::vector<glm::vec3> m_positions;
  std::uint64_t m_triangles = 0;
};

/// sampleHits of every layer set (in the order of LayerSet) by passing over all triangles.
Result<std::vector<LayerHits>> passHits(const TriangleField& field, const SamplingOptions& options,
                                        const JobContext& job);

}  // namespace sward::trace
