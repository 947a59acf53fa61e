#include "lpt/fit_system.h"

#include <algorithm>
#include <cmath>

namespace sward::lpt::detail {
namespace {

/// Columns solved together, so that every step is one instruction over several of them.
constexpr std::size_t kLanes = 8;
using Lane = std::array<double, kLanes>;

/// Indices of a column's right-hand side and solution: functions g (0 to 5), v h (6 to 8), v^2 (9).
constexpr std::size_t kLayer = 6, kSquare = 9, kFunctions = 10;

struct Batch {
  std::size_t count = 0;
  std::array<int, kLanes> column{};
  Lane mean{}, weight{}, mu2{}, mu3{}, mu4{};
  std::array<Lane, 3> layerInverse{}, layerArrow{};  ///< of the layer block in its eigenbasis: 1/d, z
  Lane pivot{}, smallest{}, condition{};
  std::vector<std::array<Lane, kFunctions>> x;  ///< [channel]: right-hand side, then solution
};

/// Block elimination: the pivot of v^2 is mu4 + ridge - mu2^2 E[g]^T (A + ridge)^-1 E[g] - sum_j z_j^2 / d_j, where the
/// quadratic form is 1 (LightSystem), d_j = mu2 eigenvalue_j(H) + ridge and z_j = mu3 E[h]_j in the eigenbasis of H.
void factorise(const LightSystem& system, double ridge, Batch& b) {
  for (std::size_t l = 0; l < kLanes; ++l) {
    b.pivot[l] = b.mu4[l] + ridge - b.mu2[l] * b.mu2[l];
    b.smallest[l] = b.mu2[l] * system.layerValues[0] + ridge;
  }
  for (std::size_t j = 0; j < 3; ++j) {
    for (std::size_t l = 0; l < kLanes; ++l) {
      const double z = b.mu3[l] * system.layerMean[j];
      const double inverse = 1.0 / (b.mu2[l] * system.layerValues[j] + ridge);
      b.layerArrow[j][l] = z;
      b.layerInverse[j][l] = inverse;
      b.pivot[l] -= z * z * inverse;
    }
  }
  for (std::size_t l = 0; l < kLanes; ++l) b.smallest[l] = std::min(b.smallest[l], b.pivot[l]);
}

void rotateLayers(const LightSystem& system, std::array<Lane, kFunctions>& x, bool transpose) {
  std::array<Lane, 3> rotated{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      const double q = transpose ? system.layerVectors[j * 3 + i] : system.layerVectors[i * 3 + j];
      for (std::size_t l = 0; l < kLanes; ++l) rotated[i][l] += q * x[kLayer + j][l];
    }
  }
  for (std::size_t i = 0; i < 3; ++i) x[kLayer + i] = rotated[i];
}

/// Solves in place with the factors of factorise.
void solve(const LightSystem& system, const Batch& b, std::array<Lane, kFunctions>& x) {
  rotateLayers(system, x, true);
  Lane square = x[kSquare];
  std::array<Lane, kLayer> light{};
  for (std::size_t i = 0; i < kLayer; ++i) {
    for (std::size_t j = 0; j < kLayer; ++j) {
      const double a = system.inverse[i * 6 + j];
      for (std::size_t l = 0; l < kLanes; ++l) light[i][l] += a * x[j][l];
    }
  }
  // (A + ridge)^-1 E[g] is e6: of the light block the constant alone is coupled to v^2.
  constexpr std::size_t kConstant = kLayer - 1;
  for (std::size_t l = 0; l < kLanes; ++l) square[l] -= b.mu2[l] * x[kConstant][l];
  for (std::size_t j = 0; j < 3; ++j) {
    for (std::size_t l = 0; l < kLanes; ++l) {
      square[l] -= b.layerArrow[j][l] * b.layerInverse[j][l] * x[kLayer + j][l];
    }
  }
  for (std::size_t l = 0; l < kLanes; ++l) square[l] /= b.pivot[l];
  for (std::size_t i = 0; i < kLayer; ++i) x[i] = light[i];
  for (std::size_t l = 0; l < kLanes; ++l) x[kConstant][l] -= b.mu2[l] * square[l];
  for (std::size_t j = 0; j < 3; ++j) {
    for (std::size_t l = 0; l < kLanes; ++l) {
      x[kLayer + j][l] = (x[kLayer + j][l] - b.layerArrow[j][l] * square[l]) * b.layerInverse[j][l];
    }
  }
  x[kSquare] = square;
  rotateLayers(system, x, false);
}

/// Rayleigh quotient of the last of `steps` applications of the arrowhead (corner `corner`, arms `arm`, diagonal
/// `value`) or, with the pivot as corner and inverses as diagonal, of its inverse, to a vector of ones.
template <bool Inverse>
Lane iterate(const Lane& corner, const std::array<Lane, 9>& arm, const std::array<Lane, 9>& value) {
  constexpr int kSteps = 8;
  std::array<Lane, 9> x{};
  Lane top{}, quotient{};
  top.fill(1.0);
  for (Lane& lane : x) lane.fill(1.0);
  for (int step = 0; step < kSteps; ++step) {
    Lane next{}, dot{}, norm{};
    for (std::size_t l = 0; l < kLanes; ++l) next[l] = Inverse ? top[l] : corner[l] * top[l];
    for (std::size_t i = 0; i < 9; ++i) {
      for (std::size_t l = 0; l < kLanes; ++l) next[l] += (Inverse ? -arm[i][l] * value[i][l] : arm[i][l]) * x[i][l];
    }
    for (std::size_t l = 0; l < kLanes; ++l) {
      if constexpr (Inverse) next[l] /= corner[l];
      norm[l] = top[l] * top[l];
      dot[l] = top[l] * next[l];
    }
    for (std::size_t i = 0; i < 9; ++i) {
      for (std::size_t l = 0; l < kLanes; ++l) {
        const double y =
            Inverse ? (x[i][l] - arm[i][l] * next[l]) * value[i][l] : arm[i][l] * top[l] + value[i][l] * x[i][l];
        norm[l] += x[i][l] * x[i][l];
        dot[l] += x[i][l] * y;
        x[i][l] = y;
      }
    }
    for (std::size_t l = 0; l < kLanes; ++l) quotient[l] = dot[l] / norm[l];
    top = next;
  }
  return quotient;
}

/// Square root of the largest over the smallest eigenvalue of the normal matrix: the condition of the rows. Rayleigh
/// quotients lie inside the spectrum, so the estimate is never above the true value.
void estimateCondition(const LightSystem& system, double ridge, Batch& b) {
  std::array<Lane, 9> arm{}, value{}, inverse{};
  Lane corner{};
  for (std::size_t l = 0; l < kLanes; ++l) corner[l] = b.mu4[l] + ridge;
  for (std::size_t i = 0; i < 9; ++i) {
    for (std::size_t l = 0; l < kLanes; ++l) {
      const bool light = i < 6;
      arm[i][l] = light ? b.mu2[l] * system.lightMean[i] : b.layerArrow[i - 6][l];
      value[i][l] = light ? system.lightValues[i] : b.mu2[l] * system.layerValues[i - 6] + ridge;
      inverse[i][l] = 1.0 / value[i][l];
    }
  }
  const Lane largest = iterate<false>(corner, arm, value);
  const Lane smallestInverse = iterate<true>(b.pivot, arm, inverse);
  for (std::size_t l = 0; l < kLanes; ++l) b.condition[l] = std::sqrt(largest[l] * smallestInverse[l]);
}

/// Rank of the rows without a ridge, by the same elimination: the light block and its mean give lightRank; since
/// E[g] = A e6 and E[h] = H e3 / 2, the pivots of the layer block are mu2 times the eigenvalues of H, and that of v^2
/// is mu4 - mu2^2 - mu3^2 / mu2, which is 0 on one or two layers.
int dataRank(const LightSystem& system, const Batch& b, std::size_t l) {
  const double limit = kRankTolerance * kRankTolerance * system.dataScale;
  int rank = system.lightRank;
  for (const double value : system.layerValues) rank += b.mu2[l] * value > limit ? 1 : 0;
  const bool curved = b.mu2[l] > limit && b.mu4[l] - b.mu2[l] * b.mu2[l] - b.mu3[l] * b.mu3[l] / b.mu2[l] > limit;
  return rank + (curved ? 1 : 0);
}

/// From the functions of v = u - mean to b of lptBasis: v^2 = u^2 - 2 mean u + mean^2, 2 c v = 2 c u - 2 c mean.
std::array<double, kFunctions> expand(const std::array<Lane, kFunctions>& x, std::size_t l, double mean) {
  const double c4 = x[kLayer][l], c5 = x[kLayer + 1][l], c8 = x[kLayer + 2][l], c2 = x[kSquare][l];
  return {x[0][l],
          x[1][l],
          c2,
          x[2][l],
          c4,
          c5,
          x[3][l] - c4 * mean,
          x[4][l] - c5 * mean,
          c8 - c2 * mean,
          x[5][l] + mean * (c2 * mean - 2.0 * c8)};
}

class BlockFitter {
 public:
  BlockFitter(const FitJob& job, int begin, int end)
      : m_job(job), m_channels(static_cast<std::size_t>(job.input.channels)) {
    m_first = job.input.columnStart[static_cast<std::size_t>(begin)];
    m_texels = job.input.columnStart[static_cast<std::size_t>(end)] - m_first;
    m_moments.resize(m_channels * 6 * m_texels);
    for (std::size_t c = 0; c < m_channels; ++c) {
      lightMoments(job, c, job.system.functions, m_first, m_first + m_texels,
                   std::span(m_moments).subspan(c * 6 * m_texels, 6 * m_texels));
    }
    m_weights.resize(m_texels);
    for (std::size_t t = 0; t < m_texels; ++t) m_weights[t] = job.weight(m_first + t);
    m_batch.x.resize(m_channels);
  }

  void column(int c) {
    const std::size_t begin = m_job.input.columnStart[static_cast<std::size_t>(c)] - m_first;
    const std::size_t end = m_job.input.columnStart[static_cast<std::size_t>(c) + 1] - m_first;
    double weight = 0.0, first = 0.0;
    for (std::size_t t = begin; t < end; ++t) {
      weight += m_weights[t];
      first += m_weights[t] * m_job.u(m_first + t);
    }
    if (!(weight > 0.0)) return;
    if (!complete(begin, end)) {
      fitLptColumnByRows(m_job, c, m_scratch);
      return;
    }
    append(c, begin, end, weight, first / weight);
    if (m_batch.count == kLanes) flush();
  }

  /// Solves what is waiting; lanes beyond count hold older columns and are not written.
  void flush() {
    if (m_batch.count == 0) return;
    const double ridge = m_job.options.layerRidge;
    factorise(m_job.system, ridge, m_batch);
    estimateCondition(m_job.system, ridge, m_batch);
    for (auto& x : m_batch.x) solve(m_job.system, m_batch, x);
    for (std::size_t l = 0; l < m_batch.count; ++l) store(l);
    m_batch.count = 0;
  }

 private:
  bool complete(std::size_t begin, std::size_t end) const {
    for (std::size_t c = 0; c < m_channels; ++c) {
      const double* sums = &m_moments[(c * 6 + 5) * m_texels];
      for (std::size_t t = begin; t < end; ++t) {
        if (m_weights[t] > 0.0 && !std::isfinite(sums[t])) return false;
      }
    }
    return true;
  }

  void append(int c, std::size_t begin, std::size_t end, double weight, double mean) {
    const std::size_t l = m_batch.count++;
    m_batch.column[l] = c;
    m_batch.mean[l] = mean;
    m_batch.weight[l] = weight;
    const double scale = 1.0 / weight;
    double mu2 = 0.0, mu3 = 0.0, mu4 = 0.0;
    for (std::size_t t = begin; t < end; ++t) {
      const double v = m_job.u(m_first + t) - mean, w = m_weights[t] * scale;
      mu2 += w * v * v;
      mu3 += w * v * v * v;
      mu4 += w * v * v * v * v;
    }
    m_batch.mu2[l] = mu2;
    m_batch.mu3[l] = mu3;
    m_batch.mu4[l] = mu4;
    for (std::size_t channel = 0; channel < m_channels; ++channel) appendSamples(channel, begin, end, scale);
  }

  void appendSamples(std::size_t channel, std::size_t begin, std::size_t end, double scale) {
    const std::size_t l = m_batch.count - 1;
    const double* s = &m_moments[channel * 6 * m_texels];
    const double perRow = scale / static_cast<double>(m_job.lights());
    std::array<double, kFunctions> r{};
    for (std::size_t t = begin; t < end; ++t) {
      if (m_weights[t] == 0.0) continue;  // its samples may be anything
      const double v = m_job.u(m_first + t) - m_batch.mean[l], w = m_weights[t] * perRow;
      std::array<double, 6> moment;
      for (std::size_t p = 0; p < 6; ++p) moment[p] = w * s[p * m_texels + t];
      for (std::size_t p = 0; p < 6; ++p) r[p] += moment[p];
      r[kLayer] += v * moment[3];
      r[kLayer + 1] += v * moment[4];
      r[kLayer + 2] += 2.0 * v * moment[5];
      r[kSquare] += v * v * moment[5];
    }
    for (std::size_t j = 0; j < kFunctions; ++j) m_batch.x[channel][j][l] = r[j];
  }

  void store(std::size_t l) {
    const int column = m_batch.column[l];
    if (!(m_batch.smallest[l] > kMinPivot * m_job.system.lightValues[5])) {
      fitLptColumnByRows(m_job, column, m_scratch);
      return;
    }
    Fit& fit = m_job.fit;
    const auto at = static_cast<std::size_t>(column);
    fit.weight[at] = storedWeight(m_batch.weight[l]);
    fit.condition[at] = static_cast<float>(m_batch.condition[l]);
    fit.rank[at] = static_cast<std::uint8_t>(dataRank(m_job.system, m_batch, l));
    fit.path[at] = FitPath::Moments;
    for (std::size_t c = 0; c < m_channels; ++c) {
      const auto b = expand(m_batch.x[c], l, m_batch.mean[l]);
      float* out = &fit.coefficients[(at * m_channels + c) * kLptCoefficients];
      for (std::size_t j = 0; j < kFunctions; ++j) out[j] = storedCoefficient(b[j]);
    }
  }

  const FitJob& m_job;
  std::size_t m_channels, m_first = 0, m_texels = 0;
  std::vector<double> m_moments;  ///< [channel][6][texel of the block]
  std::vector<double> m_weights;  ///< [texel of the block]
  Batch m_batch;
  RowScratch m_scratch;
};

}  // namespace

void lightMoments(const FitJob& job, std::size_t channel, std::span<const std::array<double, 6>> functions,
                  std::size_t begin, std::size_t end, std::span<double> out) {
  constexpr std::size_t kWide = 8;
  const std::size_t count = end - begin;
  const auto sums = [&]<std::size_t Width>(std::size_t t, std::integral_constant<std::size_t, Width>) {
    std::array<std::array<double, Width>, 6> sum{};
    for (std::size_t k = 0; k < functions.size(); ++k) {
      const float* y = job.sample(channel, k).data() + begin + t;
      const std::array<double, 6>& g = functions[k];
      for (std::size_t p = 0; p < 6; ++p) {
        for (std::size_t l = 0; l < Width; ++l) sum[p][l] += g[p] * static_cast<double>(y[l]);
      }
    }
    for (std::size_t p = 0; p < 6; ++p) std::copy(sum[p].begin(), sum[p].end(), &out[p * count + t]);
  };
  std::size_t t = 0;
  for (; t + kWide <= count; t += kWide) sums(t, std::integral_constant<std::size_t, kWide>{});
  for (; t < count; ++t) sums(t, std::integral_constant<std::size_t, 1>{});
}

void fitLptBlock(const FitJob& job, int begin, int end) {
  if (job.options.paper || !job.system.wellConditioned) {
    RowScratch scratch;
    for (int c = begin; c < end; ++c) fitLptColumnByRows(job, c, scratch);
    return;
  }
  BlockFitter fitter(job, begin, end);
  for (int c = begin; c < end; ++c) fitter.column(c);
  fitter.flush();
}

}  // namespace sward::lpt::detail
