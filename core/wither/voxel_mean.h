#pragma once

#include "wither/texel.h"

#include <array>

#include <glm/glm.hpp>

/// Private to core/wither: means over leaves, in double.
namespace sward::wither {

/// Sums of what leaves are, each weighted by its area (or by any measure of it).
struct LeafSums {
  double weight = 0.0;
  double specular = 0.0;
  glm::dvec3 normal{0.0}, tangent{0.0}, diffuse{0.0}, transmitted{0.0};
  std::array<double, 6> spread{};

  void add(const Voxel& voxel, double w) {
    weight += w;
    specular += w * static_cast<double>(voxel.specular);
    normal += w * glm::dvec3(voxel.normal);
    tangent += w * glm::dvec3(voxel.tangent);
    diffuse += w * glm::dvec3(voxel.diffuse);
    transmitted += w * glm::dvec3(voxel.transmitted);
  }
  /// A direction from a weighted sum of directions: zero where they cancel, up to the rounding of floats.
  glm::vec3 direction(const glm::dvec3& sum) const {
    constexpr double kCancelled = 1e-5;
    const double length = glm::length(sum);
    return length > kCancelled * weight ? glm::vec3(sum / length) : glm::vec3(0.0f);
  }
  /// Everything but density and spread; weight > 0.
  Voxel means() const {
    Voxel voxel;
    voxel.normal = direction(normal);
    voxel.tangent = direction(tangent);
    voxel.diffuse = glm::vec3(diffuse / weight);
    voxel.transmitted = glm::vec3(transmitted / weight);
    voxel.specular = static_cast<float>(specular / weight);
    return voxel;
  }
};

}  // namespace sward::wither
