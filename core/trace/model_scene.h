#pragma once

#include "base/result.h"
#include "mesh/model.h"

#include <cstdint>
#include <memory>

#include <glm/glm.hpp>

namespace sward::trace {

/// A model alone in an Embree scene. The model is the caller's and must outlive it. Threads may share it.
class ModelScene {
 public:
  /// Errors: a vertex that is not finite; Embree cannot start, or has no memory. A model without triangles is hit by
  /// nothing.
  static Result<ModelScene> create(const mesh::Model& model);
  ModelScene(ModelScene&&) noexcept;
  ModelScene& operator=(ModelScene&&) noexcept;
  ~ModelScene();

  const mesh::Model& model() const;

  struct Found {
    bool any = false;
    float t = 0.0f, u = 0.0f, v = 0.0f;
    std::uint32_t triangle = 0;
    mesh::SurfaceSample surface;
  };
  /// The nearest surface along a ray that is more opaque than `chance`; at most kMostLeaves others are passed.
  Found nearest(const glm::vec3& origin, const glm::vec3& direction, float start, float chance) const;
  /// Whether there is one. Opaque models are asked no alpha.
  bool occluded(const glm::vec3& origin, const glm::vec3& direction, float start, float chance) const;
  static constexpr int kMostLeaves = 64;

 private:
  struct Impl;
  explicit ModelScene(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> m_impl;
};

}  // namespace sward::trace
