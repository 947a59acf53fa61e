#pragma once

#include "mesh/model.h"

#include <cmath>
#include <numbers>

namespace sward::wither {

/// An upright ribbon in the xz plane on the origin: vertices row by row, left then right.
inline mesh::Model flatBlade(int segments, double height, double width) {
  mesh::Model model;
  model.materials.emplace_back();
  for (int i = 0; i <= segments; ++i) {
    const double s = static_cast<double>(i) / segments;
    for (const double x : {-0.5, 0.5}) {
      model.positions.emplace_back(x * width, 0.0, s * height);
      model.normals.emplace_back(0.0f, -1.0f, 0.0f);
      model.uvs.emplace_back(x + 0.5, s);
      model.colours.emplace_back(0.1f, 0.2f, 0.05f, 1.0f);
    }
    if (i == 0) continue;
    const auto a = static_cast<std::uint32_t>(2 * i - 2);
    model.triangles.emplace_back(a, a + 1, a + 2);
    model.triangles.emplace_back(a + 2, a + 1, a + 3);
    model.triangleMaterial.insert(model.triangleMaterial.end(), 2, 0u);
  }
  return model;
}

/// A closed upright tube with fans for its ends.
inline mesh::Model tube(int sides, int rings, double radius, double height) {
  mesh::Model model;
  model.materials.emplace_back();
  const auto vertex = [&](double x, double y, double z, const glm::vec3& normal) {
    model.positions.emplace_back(x, y, z);
    model.normals.push_back(normal);
    model.uvs.emplace_back(0.0f, 0.0f);
    model.colours.emplace_back(1.0f);
    return static_cast<std::uint32_t>(model.positions.size() - 1);
  };
  for (int r = 0; r <= rings; ++r) {
    for (int i = 0; i < sides; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / sides;
      vertex(radius * std::cos(angle), radius * std::sin(angle), height * r / rings,
             {std::cos(angle), std::sin(angle), 0.0});
    }
  }
  const std::uint32_t bottom = vertex(0.0, 0.0, 0.0, {0.0f, 0.0f, -1.0f}), top = vertex(0.0, 0.0, height, {0, 0, 1});
  for (int i = 0; i < sides; ++i) {
    const auto here = static_cast<std::uint32_t>(i), next = static_cast<std::uint32_t>((i + 1) % sides);
    const auto across = static_cast<std::uint32_t>(sides);
    for (std::uint32_t r = 0; r < static_cast<std::uint32_t>(rings); ++r) {
      const std::uint32_t row = r * across;
      model.triangles.emplace_back(row + here, row + next, row + across + here);
      model.triangles.emplace_back(row + next, row + across + next, row + across + here);
    }
    const std::uint32_t last = static_cast<std::uint32_t>(rings) * across;
    model.triangles.emplace_back(bottom, next, here);
    model.triangles.emplace_back(top, last + here, last + next);
  }
  model.triangleMaterial.assign(model.triangles.size(), 0u);
  return model;
}

inline mesh::Model turned(mesh::Model model, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  const auto turn = [&](glm::vec3& v) { v = glm::vec3(c * v.x - s * v.y, s * v.x + c * v.y, v.z); };
  for (glm::vec3& p : model.positions) turn(p);
  for (glm::vec3& n : model.normals) turn(n);
  return model;
}

/// Adds another mesh of the same materials.
inline void append(mesh::Model& model, const mesh::Model& other) {
  const auto first = static_cast<std::uint32_t>(model.positions.size());
  model.positions.insert(model.positions.end(), other.positions.begin(), other.positions.end());
  model.normals.insert(model.normals.end(), other.normals.begin(), other.normals.end());
  model.uvs.insert(model.uvs.end(), other.uvs.begin(), other.uvs.end());
  model.colours.insert(model.colours.end(), other.colours.begin(), other.colours.end());
  for (const glm::uvec3& t : other.triangles) model.triangles.push_back(t + first);
  model.triangleMaterial.insert(model.triangleMaterial.end(), other.triangleMaterial.begin(),
                                other.triangleMaterial.end());
}

}  // namespace sward::wither
