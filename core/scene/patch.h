#pragma once

#include "mesh/model.h"

#include <cstdint>
#include <memory>
#include <vector>

#include <glm/glm.hpp>

namespace sward::scene {

/// One kind of plant on a patch: how many, and how they are turned. `models` are its variants, one picked at random.
struct PlantScatter {
  double count = 0.0;          ///< plants on the whole patch; the fraction is settled by chance
  double sizeVariation = 0.2;  ///< relative standard deviation of the scale, cut at two
  double tiltDeg = 5.0;        ///< largest inclination of the plant's axis
  double clumping = 0.0;       ///< 0 evenly scattered (jittered grid) to 1 strongly clustered
  std::vector<std::uint32_t> models;
};

/// A plant standing on the patch: which model, where, how turned. Rotation times uniform scale, then translation.
struct Instance {
  std::uint32_t model = 0;
  glm::mat4x3 worldFromModel{1.0f};
};

/// Grass over a periodic square of side sideM in x and y, instances with their feet inside it; heightM bounds all
/// geometry.
struct Patch {
  double sideM = 1.0;
  double heightM = 0.0;
  std::vector<std::shared_ptr<const mesh::Model>> models;
  std::vector<Instance> instances;
};

/// Scatters plants over a periodic square of side sideM, the same for the same seed. heightM of the result is the top
/// of the highest instance. Models without triangles are never picked.
Patch scatter(double sideM, std::vector<std::shared_ptr<const mesh::Model>> models,
              const std::vector<PlantScatter>& plants, std::uint64_t seed);

}  // namespace sward::scene
