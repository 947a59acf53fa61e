#pragma once

#include "base/random.h"
#include "mesh/measure.h"
#include "scene/patch.h"
#include "wither/texel.h"

#include <cstring>
#include <vector>

#include <glm/glm.hpp>
#include <gtest/gtest.h>

namespace sward::wither::testing {

/// Leaf area of a patch's plants: that of the models, times the square of the instances' scale.
inline double leafAreaM2(const scene::Patch& patch) {
  double sum = 0.0;
  for (const scene::Instance& instance : patch.instances) {
    const double scale = glm::length(glm::dvec3(instance.worldFromModel[0]));
    sum += mesh::measure(*patch.models[instance.model]).leafAreaM2 * scale * scale;
  }
  return sum;
}

inline bool sameBytes(const Texel& a, const Texel& b) {
  return a.grid() == b.grid() && a.size() == b.size() &&
         std::memcmp(a.places().data(), b.places().data(), a.size() * sizeof(glm::u16vec3)) == 0 &&
         std::memcmp(a.voxels().data(), b.voxels().data(), a.size() * sizeof(Voxel)) == 0;
}

inline TexelGrid cube(int columns, double sideM = 1.0) {
  return {columns, columns, sideM, sideM};
}

inline Texel texelOf(const TexelGrid& grid, std::vector<Texel::Entry> entries) {
  auto texel = Texel::fromEntries(grid, std::move(entries));
  EXPECT_TRUE(texel.ok()) << (texel.ok() ? "" : texel.error().text());
  return texel.ok() ? std::move(texel).value() : Texel();
}

/// Something of everything: leaves of one direction, of several, of none; veins; dense and thin.
inline Voxel randomVoxel(base::Random& random) {
  const auto direction = [&] { return glm::normalize(glm::dvec3(random.normal(), random.normal(), random.normal())); };
  Voxel voxel;
  voxel.density = static_cast<float>(std::exp(random.uniform(-3.0, 6.0)));
  const glm::dvec3 n = direction(), t = glm::normalize(glm::cross(n, direction()));
  const double share = random.uniform(), rest = (1.0 - share) / 3.0;
  voxel.normal = random.uniform() < 0.1 ? glm::vec3(0.0f) : glm::vec3(n);
  voxel.tangent = random.uniform() < 0.1 ? glm::vec3(0.0f) : glm::vec3(t);
  voxel.diffuse = {random.uniform(), random.uniform(), random.uniform()};
  voxel.transmitted = {random.uniform(), random.uniform(), random.uniform()};
  voxel.specular = static_cast<float>(random.uniform());
  const double d = static_cast<double>(voxel.density);
  const std::array<double, 6> s{share * n.x * n.x + rest, share * n.x * n.y, share * n.x * n.z,
                                share * n.y * n.y + rest, share * n.y * n.z, share * n.z * n.z + rest};
  for (std::size_t i = 0; i < 6; ++i) voxel.spread[i] = static_cast<float>(d * s[i]);
  return voxel;
}

/// A share of all places, at random.
inline Texel randomTexel(const TexelGrid& grid, double filled, std::uint64_t seed) {
  base::Random random(seed);
  std::vector<Texel::Entry> entries;
  for (int z = 0; z < grid.layers; ++z) {
    for (int y = 0; y < grid.columns; ++y) {
      for (int x = 0; x < grid.columns; ++x) {
        if (random.uniform() < filled) entries.push_back({{x, y, z}, randomVoxel(random)});
      }
    }
  }
  return texelOf(grid, std::move(entries));
}

}  // namespace sward::wither::testing
