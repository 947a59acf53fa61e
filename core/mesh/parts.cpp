#include "mesh/parts.h"

#include "base/random.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <numeric>

namespace sward::mesh {
namespace {

/// Open addressing, since a tree of 50,000 places is slower than all the rest. 0 and -0 are one place.
std::vector<std::uint32_t> weld(const Model& model) {
  constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
  const std::size_t mask = std::bit_ceil(model.positions.size() * 2 + 1) - 1;
  std::vector<std::uint32_t> slots(mask + 1, kNone);  // number of the place
  std::vector<glm::vec3> places;
  std::vector<std::uint32_t> welded;
  welded.reserve(model.positions.size());
  for (const glm::vec3& position : model.positions) {
    const glm::vec3 p = position + 0.0f;  // -0 + 0 is 0
    const std::uint64_t low =
        std::uint64_t{std::bit_cast<std::uint32_t>(p.x)} << 32 | std::bit_cast<std::uint32_t>(p.y);
    std::size_t slot = base::mix64(low, std::bit_cast<std::uint32_t>(p.z)) & mask;
    while (slots[slot] != kNone && places[slots[slot]] != p) slot = (slot + 1) & mask;
    if (slots[slot] == kNone) {
      slots[slot] = static_cast<std::uint32_t>(places.size());
      places.push_back(p);
    }
    welded.push_back(slots[slot]);
  }
  return welded;
}

std::uint32_t rootOf(std::vector<std::uint32_t>& parents, std::uint32_t vertex) {
  while (parents[vertex] != vertex) vertex = parents[vertex] = parents[parents[vertex]];
  return vertex;
}

}  // namespace

Parts findParts(const Model& model) {
  Parts parts{weld(model), {}, std::vector<bool>(model.positions.size(), false)};
  std::vector<std::uint32_t> parents(model.positions.size());
  std::iota(parents.begin(), parents.end(), 0u);
  std::vector<std::uint64_t> edges;  // undirected, with the direction in which it is crossed in the lowest bit
  edges.reserve(model.triangles.size() * 3);
  for (const glm::uvec3& triangle : model.triangles) {
    for (int i = 0; i < 3; ++i) {
      const std::uint32_t a = parts.welded[triangle[i]], b = parts.welded[triangle[(i + 1) % 3]];
      parents[rootOf(parents, a)] = rootOf(parents, b);
      if (a != b) edges.push_back(std::uint64_t{std::min(a, b)} << 32 | std::uint64_t{std::max(a, b)} << 1 | (a < b));
    }
  }
  std::sort(edges.begin(), edges.end());
  for (std::size_t i = 0; i < edges.size();) {
    const std::uint64_t edge = edges[i] >> 1;
    int balance = 0;
    for (; i < edges.size() && edges[i] >> 1 == edge; ++i) balance += (edges[i] & 1) != 0 ? 1 : -1;
    if (balance != 0) parts.open[rootOf(parents, static_cast<std::uint32_t>(edges[i - 1] >> 32))] = true;
  }
  parts.ofTriangle.reserve(model.triangles.size());
  for (const glm::uvec3& triangle : model.triangles) {
    parts.ofTriangle.push_back(rootOf(parents, parts.welded[triangle.x]));
  }
  return parts;
}

}  // namespace sward::mesh
