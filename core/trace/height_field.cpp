#include "trace/height_field.h"

#include "trace/fast_floor.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace sward::trace {

HeightField::HeightField(const scene::Patch& patch, int texels)
    : m_texels(texels), m_sideM(patch.sideM), m_unitM(std::max(patch.heightM, 1e-6) / (kSteps - 2)) {
  m_levels.emplace_back(static_cast<std::size_t>(texels) * static_cast<std::size_t>(texels), std::uint8_t{0});
  for (const scene::Instance& instance : patch.instances) {
    if (patch.models[instance.model]) raise(patch, instance);
  }
  buildLevels();
}

// Each triangle counts over its whole box.
void HeightField::raise(const scene::Patch& patch, const scene::Instance& instance) {
  const mesh::Model& model = *patch.models[instance.model];
  std::vector<glm::vec3> world;
  world.reserve(model.positions.size());
  for (const glm::vec3& p : model.positions) world.push_back(instance.worldFromModel * glm::vec4(p, 1.0f));
  const double texelsPerM = m_texels / m_sideM;
  constexpr double kSlack = 1e-3;  // texels: far above the rounding of transforms and segments
  for (const glm::uvec3& corner : model.triangles) {
    const glm::vec3 a = world[corner.x], b = world[corner.y], c = world[corner.z];
    const glm::dvec3 low = glm::min(a, glm::min(b, c)), high = glm::max(a, glm::max(b, c));
    const double units = std::ceil(std::clamp(high.z / m_unitM, 0.0, kSteps - 1.0)) + 1.0;
    const auto top = static_cast<std::uint8_t>(std::min<double>(units, kSteps));
    // A box wider than the patch covers every texel once.
    const auto span = [&](double from, double to) {
      const std::int64_t first = floorOf(from * texelsPerM - kSlack);
      const std::int64_t count = std::min<std::int64_t>(floorOf(to * texelsPerM + kSlack) - first + 1, m_texels);
      const std::int64_t rest = first % m_texels;
      return std::pair<int, int>(static_cast<int>(rest < 0 ? rest + m_texels : rest), static_cast<int>(count));
    };
    const auto [x0, columns] = span(low.x, high.x);
    const auto [y0, rows] = span(low.y, high.y);
    for (int row = 0; row < rows; ++row) {
      for (int column = 0; column < columns; ++column) {
        std::uint8_t& here = m_levels[0][index(wrap(x0 + column), wrap(y0 + row))];
        here = std::max(here, top);
      }
    }
  }
}

void HeightField::buildLevels() {
  for (int half = 1; 2 * half <= m_texels; half *= 2) {
    const std::vector<std::uint8_t>& finer = m_levels.back();
    std::vector<std::uint8_t> level(finer.size());
    for (int y = 0; y < m_texels; ++y) {
      for (int x = 0; x < m_texels; ++x) {
        const int east = wrap(x + half), north = wrap(y + half);
        level[index(x, y)] = std::max(std::max(finer[index(x, y)], finer[index(east, y)]),
                                      std::max(finer[index(x, north)], finer[index(east, north)]));
      }
    }
    m_levels.push_back(std::move(level));
  }
}

std::uint8_t HeightField::over(int x, int y, int side) const {
  const auto k =
      std::min(static_cast<std::size_t>(std::bit_width(static_cast<unsigned>(side)) - 1), m_levels.size() - 1);
  const std::vector<std::uint8_t>& level = m_levels[k];
  // Two overlapping squares a side cover it; all of a patch whose side is no power of two needs more.
  const int part = 1 << k, last = std::min(side, m_texels) - part;
  std::uint8_t top = 0;
  for (int dy = 0;; dy = std::min(dy + part, last)) {
    for (int dx = 0;; dx = std::min(dx + part, last)) {
      top = std::max(top, level[index(wrap(x + dx), wrap(y + dy))]);
      if (dx >= last) break;
    }
    if (dy >= last) break;
  }
  return top;
}

}  // namespace sward::trace
