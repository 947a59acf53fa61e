#include "lpt/light_quality.h"

#include "lpt/fit_system.h"
#include "scene/lights.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <Eigen/SVD>

namespace sward::lpt {
namespace {

constexpr double kDegrees = std::numbers::pi / 180.0;
constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// Directions that are tried over the hemisphere; no point of it is further than 1.8 degrees from one of them.
constexpr int kDirections = 4096;
/// How many of the largest gaps among them are refined.
constexpr int kRefined = 16;

std::array<double, 6> functionsOf(const glm::dvec3& l) {
  return {l.x * l.x, l.y * l.y, l.x * l.y, l.x, l.y, 1.0};
}

/// The nearest direction of the upper hemisphere.
glm::dvec3 raised(glm::dvec3 direction) {
  direction.z = std::max(direction.z, 0.0);
  const double length = glm::length(direction);
  return length > 0.0 ? direction / length : glm::dvec3(0.0, 0.0, 1.0);
}

}  // namespace

LightSetQuality::LightSetQuality(std::span<const glm::dvec3> lights) : m_lights(lights.begin(), lights.end()) {
  decompose();
  const std::vector<glm::dvec3> directions = scene::fibonacciHemisphere(kDirections);
  // The lattice's points stand for equal solid angles.
  const auto covered = std::count_if(directions.begin(), directions.end(),
                                     [&](const glm::dvec3& direction) { return leverage(direction) <= 1.0; });
  m_coverage = static_cast<double>(covered) / kDirections;
  findWorstGap(directions);
}

void LightSetQuality::decompose() {
  // At least six rows, so that all six right singular vectors come out; rows of zeros change none of them.
  const auto rows = static_cast<Eigen::Index>(std::max<std::size_t>(m_lights.size(), 6));
  Eigen::Matrix<double, Eigen::Dynamic, 6> matrix = Eigen::Matrix<double, Eigen::Dynamic, 6>::Zero(rows, 6);
  for (std::size_t i = 0; i < m_lights.size(); ++i) {
    const auto phi = functionsOf(m_lights[i]);
    for (std::size_t j = 0; j < 6; ++j) matrix(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = phi[j];
  }
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(matrix, Eigen::ComputeThinV);
  const auto& values = svd.singularValues();
  const double largest = values(0);
  m_rank = 0;
  for (Eigen::Index j = 0; j < 6; ++j) m_rank += largest > 0.0 && values(j) > detail::kRankTolerance * largest ? 1 : 0;
  const double rounding = static_cast<double>(rows) * std::numeric_limits<double>::epsilon() * largest;
  m_condition = values(5) > rounding ? largest / values(5) : kInfinity;
  m_nullTolerance = detail::kRankTolerance * std::max(largest, 1.0);
  for (int j = 0; j < 6; ++j) {
    for (int i = 0; i < 6; ++i) {
      m_vectors[static_cast<std::size_t>(j)][static_cast<std::size_t>(i)] =
          svd.matrixV()(i, j) / (j < m_rank ? values(j) : 1.0);
    }
  }
}

double LightSetQuality::leverage(const glm::dvec3& direction) const {
  const auto phi = functionsOf(direction);
  double sum = 0.0;
  for (int j = 0; j < 6; ++j) {
    const auto& vector = m_vectors[static_cast<std::size_t>(j)];
    double part = 0.0;
    for (std::size_t i = 0; i < 6; ++i) part += vector[i] * phi[i];
    if (j >= m_rank && std::abs(part) > m_nullTolerance) return kInfinity;
    if (j < m_rank) sum += part * part;
  }
  return sum;
}

double LightSetQuality::gapDeg(const glm::dvec3& direction) const {
  // atan2 keeps its accuracy where an arc cosine loses half of the digits. The largest cosine names the nearest.
  const glm::dvec3* nearest = nullptr;
  double cosine = -kInfinity;
  for (const glm::dvec3& light : m_lights) {
    const double c = glm::dot(light, direction);
    if (c > cosine) cosine = c, nearest = &light;
  }
  if (nearest == nullptr) return 180.0;
  return std::atan2(glm::length(glm::cross(*nearest, direction)), cosine) / kDegrees;
}

void LightSetQuality::findWorstGap(std::span<const glm::dvec3> directions) {
  if (m_lights.empty()) return;
  std::vector<std::pair<double, std::size_t>> gaps;
  for (std::size_t i = 0; i < directions.size(); ++i) gaps.emplace_back(gapDeg(directions[i]), i);
  std::partial_sort(gaps.begin(), gaps.begin() + kRefined, gaps.end(),
                    [](const auto& a, const auto& b) { return a.first > b.first; });
  m_worstGapDeg = 0.0;
  for (int candidate = 0; candidate < kRefined; ++candidate) {
    glm::dvec3 best = directions[gaps[static_cast<std::size_t>(candidate)].second];
    double gap = gaps[static_cast<std::size_t>(candidate)].first;
    // The gap is the lower envelope of smooth humps: a grid round the best place finds its ridges' crossings, where a
    // gradient would not.
    for (double reach = 2.0 * kDegrees; reach > 1e-7; reach *= 0.5) {
      const glm::dvec3 centre = best;
      const glm::dvec3 across = std::abs(centre.z) < 0.9 ? glm::dvec3(0, 0, 1) : glm::dvec3(1, 0, 0);
      const glm::dvec3 u = glm::normalize(glm::cross(centre, across)), v = glm::cross(centre, u);
      for (int i = -4; i <= 4; ++i) {
        for (int j = -4; j <= 4; ++j) {
          const glm::dvec3 there =
              raised(centre + reach * 0.25 * (static_cast<double>(i) * u + static_cast<double>(j) * v));
          const double found = gapDeg(there);
          if (found > gap) gap = found, best = there;
        }
      }
    }
    if (gap > m_worstGapDeg) m_worstGapDeg = gap, m_worstGap = best;
  }
}

glm::dvec3 directionAt(const glm::dvec2& place) {
  // Lambert (1772): r^2 = 1 - lz on a disc scaled to radius 1, so |(lx, ly)| = r sqrt(2 - r^2).
  const double square = std::min(glm::dot(place, place), 1.0);
  const glm::dvec2 horizontal = place * std::sqrt(2.0 - square);
  return {horizontal.x, horizontal.y, 1.0 - square};
}

glm::dvec2 placeOf(const glm::dvec3& direction) {
  const double z = std::clamp(direction.z, 0.0, 1.0);
  return glm::dvec2(direction.x, direction.y) / std::sqrt(1.0 + z);
}

HemisphereMap hemisphereMap(const LightSetQuality& quality, int size) {
  HemisphereMap map;
  map.size = std::max(size, 0);
  for (int row = 0; row < map.size; ++row) {
    for (int column = 0; column < map.size; ++column) {
      const glm::dvec2 place{2.0 * (column + 0.5) / map.size - 1.0, 1.0 - 2.0 * (row + 0.5) / map.size};
      const bool inside = glm::dot(place, place) <= 1.0;
      constexpr float kNone = std::numeric_limits<float>::quiet_NaN();
      const glm::dvec3 direction = directionAt(place);
      map.leverage.push_back(inside ? static_cast<float>(quality.leverage(direction)) : kNone);
      map.gapDeg.push_back(inside ? static_cast<float>(quality.gapDeg(direction)) : kNone);
    }
  }
  return map;
}

}  // namespace sward::lpt
