#include "terrain/sun_shadow.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace sward::terrain {
namespace {

constexpr double kSunRadius = 0.00465;  ///< angular, of the disc

/// The shadow over a line of samples: its height, and the distance to what casts it.
struct Shadow {
  std::vector<double> height, distance;
};

/// The grid seen along the axis that the light mostly runs along: lines are swept one after another.
class Sweep {
 public:
  Sweep(const HeightField& field, const glm::dvec3& toSun) : m_grid(field.grid()) {
    const glm::dvec2 sun = glm::dvec2(toSun) / m_grid.cellM;  // in samples
    m_byColumns = std::abs(sun.x) >= std::abs(sun.y);
    const double along = m_byColumns ? sun.x : sun.y, across = m_byColumns ? sun.y : sun.x;
    m_lines = m_byColumns ? m_grid.columns : m_grid.rows;
    m_length = m_byColumns ? m_grid.rows : m_grid.columns;
    m_towardLast = along > 0.0;
    m_shift = across / std::abs(along);
    const glm::dvec2 step = m_grid.cellM * (m_byColumns ? glm::dvec2(1.0, m_shift) : glm::dvec2(m_shift, 1.0));
    m_stepM = glm::length(step);
    const double tangent = toSun.z / glm::length(glm::dvec2(toSun));
    m_fall = m_stepM * tangent;
    m_softness = kSunRadius * (1.0 + tangent * tangent);
    m_leastSoftness = 0.25 * m_fall;
  }

  std::vector<float> run() const {
    std::vector<float> seen(m_grid.heights.size(), 1.0f);
    const auto length = static_cast<std::size_t>(m_length);
    Shadow before{std::vector<double>(length, kNone), std::vector<double>(length, 0.0)}, here = before;
    // Where the grid repeats, the first round finds what shadows reach over its border.
    const bool repeats = m_grid.border == Border::Repeat;
    for (int round = repeats ? 0 : 1; round < 2; ++round) {
      for (int i = 0; i < m_lines; ++i) {
        const int line = m_towardLast ? m_lines - 1 - i : i;
        const bool first = i == 0 && !repeats;
        if (!first) advance(line, before, here);
        if (round == 1) judge(line, here, seen);
        std::swap(before, here);
      }
    }
    return seen;
  }

 private:
  static constexpr double kNone = -1e30;

  std::size_t at(int line, int place) const {
    return m_byColumns ? m_grid.offset(line, place) : m_grid.offset(place, line);
  }

  /// The shadow on a line from that on the line before it, nearer the sun.
  void advance(int line, const Shadow& before, Shadow& here) const {
    const int source = (line + (m_towardLast ? 1 : -1) + m_lines) % m_lines;
    const bool repeats = m_grid.border == Border::Repeat;
    for (int place = 0; place < m_length; ++place) {
      const double from = place + m_shift;
      const double low = std::floor(from);
      const double t = from - low;
      const auto index = [&](int i) {
        return repeats ? (i % m_length + m_length) % m_length : std::clamp(i, 0, m_length - 1);
      };
      const int a = index(static_cast<int>(low)), b = index(static_cast<int>(low) + 1);
      const auto ua = static_cast<std::size_t>(a), ub = static_cast<std::size_t>(b);
      const double ground = std::lerp(static_cast<double>(m_grid.heights[at(source, a)]),
                                      static_cast<double>(m_grid.heights[at(source, b)]), t);
      const double shadow = std::lerp(before.height[ua], before.height[ub], t);
      const bool carried = shadow > ground;
      const auto i = static_cast<std::size_t>(place);
      here.height[i] = (carried ? shadow : ground) - m_fall;
      here.distance[i] = (carried ? std::lerp(before.distance[ua], before.distance[ub], t) : 0.0) + m_stepM;
    }
  }

  void judge(int line, const Shadow& here, std::vector<float>& seen) const {
    for (int place = 0; place < m_length; ++place) {
      const auto i = static_cast<std::size_t>(place);
      const double over = static_cast<double>(m_grid.heights[at(line, place)]) - here.height[i];
      const double soft = std::max(here.distance[i] * m_softness, m_leastSoftness);
      seen[at(line, place)] = static_cast<float>(std::clamp(0.5 + 0.5 * over / soft, 0.0, 1.0));
    }
  }

  const HeightGrid& m_grid;
  bool m_byColumns = true, m_towardLast = true;
  int m_lines = 0, m_length = 0;
  double m_shift = 0.0;     ///< along a line, from a sample to where its light comes from on the line before
  double m_stepM = 0.0;     ///< from line to line
  double m_fall = 0.0;      ///< of a shadow from line to line
  double m_softness = 0.0;  ///< half the penumbra's height over the distance
  double m_leastSoftness = 0.0;
};

}  // namespace

std::vector<float> sunVisibility(const HeightField& field, const glm::dvec3& toSun) {
  const std::size_t count = field.grid().heights.size();
  if (!(toSun.z > 0.0)) return std::vector<float>(count, 0.0f);
  if (glm::length(glm::dvec2(toSun)) < 1e-6) return std::vector<float>(count, 1.0f);
  return Sweep(field, toSun).run();
}

}  // namespace sward::terrain
