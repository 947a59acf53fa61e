#include "tiles/seam_problem.h"

#include "base/check.h"
#include "base/parallel.h"

#include <algorithm>
#include <cmath>

namespace sward::tiles {

namespace {

constexpr std::size_t kBasis = 10;
using Vector10 = std::array<double, kBasis>;

float finiteOrZero(float value) {
  return std::isfinite(value) ? value : 0.0f;
}

float cleanCoverage(const SeamColumn& column) {
  return std::clamp(finiteOrZero(column.coverage), 0.0f, 1.0f);
}

/// Coefficients of what a column shows in one colour channel: r b_reflected + t b_transmitted. An empty column shows
/// nothing, whatever its coefficients were filled with.
Vector10 shownCoefficients(const SeamColumn& column, int channel) {
  Vector10 shown{};
  if (cleanCoverage(column) <= 0.0f) return shown;
  for (std::size_t response = 0; response < 2; ++response) {
    const double colour = static_cast<double>(finiteOrZero(column.meanColour[response][channel]));
    for (std::size_t j = 0; j < kBasis; ++j) {
      shown[j] += colour * static_cast<double>(finiteOrZero(column.coefficients[response][j]));
    }
  }
  return shown;
}

/// Lower Cholesky factor of the Gram matrix, row by row.
std::array<double, kBasis * kBasis> choleskyFactor(std::span<const double, 100> gram) {
  std::array<double, kBasis * kBasis> factor{};
  for (std::size_t i = 0; i < kBasis; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      double rest = gram[i * kBasis + j];
      for (std::size_t k = 0; k < j; ++k) rest -= factor[i * kBasis + k] * factor[j * kBasis + k];
      if (i == j) SWARD_CHECK_GT(rest, 0.0);
      factor[i * kBasis + j] = i == j ? std::sqrt(rest) : rest / factor[j * kBasis + j];
    }
  }
  return factor;
}

bool cornerPermits(const Corner& corner, Edge edge, int x, int y, int resolution, int overlap) {
  const int u = corner.flipX ? resolution - 1 - x : x;
  const int v = corner.flipY ? resolution - 1 - y : y;
  const int beyond = edge == corner.horizontal ? v - u : u - v;  // past the diagonal, along an axis
  const int band = std::min(overlap, std::min(u, v));
  return beyond == 0 ? edge == corner.diagonal || band >= 1 : beyond <= band;
}

}  // namespace

double seamCost(const SeamColumn& a, const SeamColumn& b, std::span<const double, 100> gram) {
  double sum = 0.0;
  for (int channel = 0; channel < 3; ++channel) {
    const Vector10 va = shownCoefficients(a, channel);
    const Vector10 vb = shownCoefficients(b, channel);
    Vector10 c{};
    for (std::size_t j = 0; j < kBasis; ++j) c[j] = va[j] - vb[j];
    for (std::size_t j = 0; j < kBasis; ++j) {
      for (std::size_t k = 0; k < kBasis; ++k) sum += c[j] * gram[j * kBasis + k] * c[k];
    }
  }
  return std::max(sum, 0.0) * 0.5 * (static_cast<double>(cleanCoverage(a)) + static_cast<double>(cleanCoverage(b)));
}

std::vector<std::uint8_t> permittedOwners(int resolution, int overlap) {
  std::vector<std::uint8_t> permitted;
  permitted.reserve(static_cast<std::size_t>(resolution) * static_cast<std::size_t>(resolution));
  for (int y = 0; y < resolution; ++y) {
    for (int x = 0; x < resolution; ++x) {
      unsigned mask = 0b1111U;
      for (const Corner& corner : kCorners) {
        for (const Edge edge : {corner.horizontal, corner.vertical}) {
          if (!cornerPermits(corner, edge, x, y, resolution, overlap)) mask &= ~(1U << edge);
        }
      }
      permitted.push_back(static_cast<std::uint8_t>(mask));
    }
  }
  return permitted;
}

SeamSpace::SeamSpace(std::span<const SeamColumn> columns, std::span<const double, 100> gram, const JobContext& job)
    : m_vectors(columns.size() * kSize), m_coverage(columns.size()) {
  const auto factor = choleskyFactor(gram);
  base::parallelFor(job, columns.size(), 4096, [&](std::size_t begin, std::size_t end) {
    for (std::size_t at = begin; at < end; ++at) {
      m_coverage[at] = cleanCoverage(columns[at]);
      for (int channel = 0; channel < 3; ++channel) {
        const Vector10 c = shownCoefficients(columns[at], channel);
        float* out = &m_vectors[at * kSize + static_cast<std::size_t>(channel) * kBasis];
        for (std::size_t j = 0; j < kBasis; ++j) {
          double sum = 0.0;
          for (std::size_t k = j; k < kBasis; ++k) sum += factor[k * kBasis + j] * c[k];
          out[j] = static_cast<float>(sum);
        }
      }
    }
  });
}

double SeamSpace::cost(std::uint32_t a, std::uint32_t b) const {
  const float weight = 0.5f * (m_coverage[a] + m_coverage[b]);
  if (a == b || weight <= 0.0f) return 0.0;
  const float* va = &m_vectors[a * kSize];
  const float* vb = &m_vectors[b * kSize];
  // Two partial sums: fixed order, half the chain of dependent additions.
  double even = 0.0;
  double odd = 0.0;
  for (std::size_t j = 0; j < kSize; j += 2) {
    const double d0 = static_cast<double>(va[j] - vb[j]);
    const double d1 = static_cast<double>(va[j + 1] - vb[j + 1]);
    even += d0 * d0;
    odd += d1 * d1;
  }
  return static_cast<double>(weight) * (even + odd);
}

double SeamProblem::energy(std::span<const std::uint8_t> owner) const {
  const auto stride = static_cast<std::size_t>(resolution);
  double sum = 0.0;
  for (int y = 0; y < resolution; ++y) {
    for (int x = 0; x < resolution; ++x) {
      const std::size_t p = texel(x, y);
      if (x + 1 < resolution) sum += between(p, p + 1, owner[p], owner[p + 1]);
      if (y + 1 < resolution) sum += between(p, p + stride, owner[p], owner[p + stride]);
    }
  }
  return sum;
}

SeamProblem makeSeamProblem(const SeamSpace& space, int patchResolution, int resolution, int overlap,
                            std::span<const std::uint8_t> permitted, const std::array<glm::ivec2, 4>& offsets) {
  SeamProblem problem{.resolution = resolution, .overlap = overlap, .permitted = permitted, .costs = {}};
  problem.costs.assign(permitted.size() * 6, 0.0);
  for (int y = 0; y < resolution; ++y) {
    for (int x = 0; x < resolution; ++x) {
      // A seam beside this texel may bring in what its neighbours may show.
      unsigned shown = permitted[problem.texel(x, y)];
      if (x > 0) shown |= permitted[problem.texel(x - 1, y)];
      if (y > 0) shown |= permitted[problem.texel(x, y - 1)];
      if (x + 1 < resolution) shown |= permitted[problem.texel(x + 1, y)];
      if (y + 1 < resolution) shown |= permitted[problem.texel(x, y + 1)];
      std::array<std::uint32_t, 4> column{};
      for (const Edge edge : kEdges) column[edge] = wrappedColumn(glm::ivec2(x, y) + offsets[edge], patchResolution);
      std::size_t pair = problem.texel(x, y) * 6;
      for (std::size_t a = 0; a < 4; ++a) {
        for (std::size_t b = a + 1; b < 4; ++b, ++pair) {
          if ((shown >> a & 1U) != 0 && (shown >> b & 1U) != 0) {
            problem.costs[pair] = space.cost(column[a], column[b]);
          }
        }
      }
    }
  }
  return problem;
}

}  // namespace sward::tiles
