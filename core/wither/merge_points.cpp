#include "wither/points.h"

#include "base/random.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

namespace sward::wither {
namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

/// The points that lead, by cells twice as wide as the threshold: what is near lies in eight of them at most, and
/// leaders are a threshold apart, so that a cell holds few.
class LeaderGrid {
 public:
  LeaderGrid(std::size_t points, double threshold)
      : m_mask(std::bit_ceil(2 * points + 1) - 1),
        m_heads(m_mask + 1, kNone),
        m_threshold(threshold),
        m_cell(2.0 * threshold) {}

  /// Number of the nearest leader within the threshold; kNone.
  std::uint32_t nearest(const glm::dvec3& place) const {
    const glm::dvec3 low = glm::floor((place - m_threshold) / m_cell),
                     high = glm::floor((place + m_threshold) / m_cell);
    double best = m_threshold * m_threshold;
    std::uint32_t found = kNone;
    for (int i = 0; i < 8; ++i) {
      const glm::bvec3 upper((i & 1) != 0, (i & 2) != 0, (i & 4) != 0);
      if (glm::any(glm::bvec3(upper.x && low.x == high.x, upper.y && low.y == high.y, upper.z && low.z == high.z))) {
        continue;
      }
      const glm::dvec3 cell = glm::mix(low, high, upper);
      for (std::uint32_t l = m_heads[slot(cell)]; l != kNone; l = m_next[l]) {
        const glm::dvec3 away = m_places[l] - place;
        const double distance = glm::dot(away, away);
        if (distance >= best) continue;
        best = distance;
        found = l;
      }
    }
    return found;
  }

  void add(const glm::dvec3& place) {
    const glm::dvec3 cell = glm::floor(place / m_cell);
    std::uint32_t& head = m_heads[slot(cell)];
    m_next.push_back(head);
    head = static_cast<std::uint32_t>(m_places.size());
    m_places.push_back(place);
  }

 private:
  std::size_t slot(const glm::dvec3& cell) const {
    const glm::dvec3 c = cell + 0.0;  // -0 + 0 is 0
    return base::mix64(std::bit_cast<std::uint64_t>(c.x), std::bit_cast<std::uint64_t>(c.y),
                       std::bit_cast<std::uint64_t>(c.z)) &
           m_mask;
  }
  std::size_t m_mask;
  std::vector<std::uint32_t> m_heads, m_next;
  std::vector<glm::dvec3> m_places;
  double m_threshold, m_cell;
};

struct Sum {
  glm::dvec3 position{0.0}, normal{0.0}, tangent{0.0}, diffuse{0.0}, transmitted{0.0};
  std::array<double, 6> spread{};
  double specular = 0.0, area = 0.0;
  std::uint32_t count = 0, first = 0;
};

glm::vec3 direction(const glm::dvec3& sum, double weight) {
  const double length = glm::length(sum);
  return length > 1e-3 * weight ? glm::vec3(sum / length) : glm::vec3(0.0f);
}

}  // namespace

Points mergePoints(const Points& points, double thresholdM) {
  if (!(thresholdM > 0.0) || points.size() < 2) return points;
  LeaderGrid leaders(points.size(), thresholdM);
  std::vector<Sum> sums;
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    const glm::dvec3 place(points.positions[i]);
    std::uint32_t into = leaders.nearest(place);
    if (into == kNone) {
      into = static_cast<std::uint32_t>(sums.size());
      leaders.add(place);
      sums.push_back({});
      sums.back().first = i;
    }
    Sum& sum = sums[into];
    // Points without area still count for where they are.
    const double weight = std::max(static_cast<double>(points.areaM2[i]), 1e-30);
    sum.position += weight * place;
    sum.normal += weight * glm::dvec3(points.normals[i]);
    sum.tangent += weight * glm::dvec3(points.tangents[i]);
    sum.diffuse += weight * glm::dvec3(points.diffuse[i]);
    sum.transmitted += weight * glm::dvec3(points.transmitted[i]);
    sum.specular += weight * static_cast<double>(points.specular[i]);
    for (std::size_t c = 0; c < 6; ++c) sum.spread[c] += weight * static_cast<double>(points.spread[i][c]);
    sum.area += weight;
    ++sum.count;
  }
  Points merged;
  merged.resize(sums.size());
  for (std::size_t i = 0; i < sums.size(); ++i) {
    const Sum& sum = sums[i];
    merged.attachments[i] = points.attachments[sum.first];
    for (std::size_t c = 0; c < 6; ++c) merged.spread[i][c] = static_cast<float>(sum.spread[c] / sum.area);
    const bool alone = sum.count == 1;  // to the last bit as it was
    merged.positions[i] = alone ? points.positions[sum.first] : glm::vec3(sum.position / sum.area);
    merged.normals[i] = alone ? points.normals[sum.first] : direction(sum.normal, sum.area);
    merged.tangents[i] = alone ? points.tangents[sum.first] : direction(sum.tangent, sum.area);
    merged.diffuse[i] = alone ? points.diffuse[sum.first] : glm::vec3(sum.diffuse / sum.area);
    merged.transmitted[i] = alone ? points.transmitted[sum.first] : glm::vec3(sum.transmitted / sum.area);
    merged.specular[i] = alone ? points.specular[sum.first] : static_cast<float>(sum.specular / sum.area);
    merged.areaM2[i] = alone ? points.areaM2[sum.first] : static_cast<float>(sum.area);
  }
  return merged;
}

}  // namespace sward::wither
