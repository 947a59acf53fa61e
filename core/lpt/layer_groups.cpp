#include "lpt/representation_kinds.h"

#include "base/parallel.h"
#include "lpt/fit_system.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace sward::lpt::detail {
namespace {

/// Weighted sums over the texels of a column up to one of them, so that those of any run of texels are differences. u
/// is at most 1 and there are at most 256 texels: a difference keeps 13 digits.
struct Sums {
  std::array<double, 5> power{};   ///< w u^p
  std::array<double, 6> moment{};  ///< w s, s the means over the lights of sample times g
  std::array<double, 3> layer{};   ///< w u s_3, s_4, s_5
  double square = 0.0;             ///< w u^2 s_5
};

/// How much of the summed squares w y^2 the regularised fit of a run explains: W r^T M^-1 r, with M the normal matrix
/// and r the right-hand side of LightSystem, by its block elimination. The run's objective is the rest; the sum of the
/// squares does not depend on the groups.
class RunGain {
 public:
  RunGain(const LightSystem& system, double ridge) : m_system(system), m_ridge(ridge) {}

  double operator()(const Sums& begin, const Sums& end) const {
    const double weight = end.power[0] - begin.power[0];
    if (!(weight > 0.0)) return 0.0;
    const double mean = (end.power[1] - begin.power[1]) / weight;
    std::array<double, 5> u;
    for (std::size_t p = 0; p < 5; ++p) u[p] = (end.power[p] - begin.power[p]) / weight;
    const double mu2 = u[2] - mean * mean, mu3 = u[3] - mean * (3.0 * u[2] - 2.0 * mean * mean);
    const double mu4 = u[4] - mean * (4.0 * u[3] - mean * (6.0 * u[2] - 3.0 * mean * mean));
    std::array<double, 6> light;
    for (std::size_t p = 0; p < 6; ++p) light[p] = (end.moment[p] - begin.moment[p]) / weight;
    std::array<double, 3> layer;  // of v h = 2 v (lx, ly, 1), where g has 2 lx, 2 ly and 1
    for (std::size_t p = 0; p < 3; ++p) {
      layer[p] = (p == 2 ? 2.0 : 1.0) * ((end.layer[p] - begin.layer[p]) / weight - mean * light[p + 3]);
    }
    const double square = (end.square - begin.square) / weight -
                          mean * (2.0 * (end.layer[2] - begin.layer[2]) / weight - mean * light[5]);
    return weight * explained(light, layer, square, mu2, mu3, mu4);
  }

 private:
  double explained(const std::array<double, 6>& light, const std::array<double, 3>& layer, double square, double mu2,
                   double mu3, double mu4) const {
    // (A + ridge)^-1 E[g] is e6 (LightSystem).
    double sum = 0.0, pivot = mu4 + m_ridge - mu2 * mu2;
    square -= mu2 * light[5];
    for (std::size_t i = 0; i < 6; ++i) {
      double row = 0.0;
      for (std::size_t j = 0; j < 6; ++j) row += m_system.inverse[i * 6 + j] * light[j];
      sum += row * light[i];
    }
    for (std::size_t j = 0; j < 3; ++j) {
      double rotated = 0.0;
      for (std::size_t i = 0; i < 3; ++i) rotated += m_system.layerVectors[i * 3 + j] * layer[i];
      const double value = mu2 * m_system.layerValues[j] + m_ridge;
      if (!(value > kMinPivot)) continue;  // the run does not determine it: it explains nothing
      const double arrow = mu3 * m_system.layerMean[j];
      sum += rotated * rotated / value;
      square -= arrow * rotated / value;
      pivot -= arrow * arrow / value;
    }
    return pivot > kMinPivot ? sum + square * square / pivot : sum;
  }

  const LightSystem& m_system;
  double m_ridge;
};

class GroupSearch {
 public:
  GroupSearch(const FitJob& job, int groups)
      : m_job(job),
        m_gain(job.system, job.options.paper ? 0.0 : job.options.layerRidge),
        m_channels(static_cast<std::size_t>(job.input.channels)),
        m_inner(static_cast<std::size_t>(groups) - 1) {}

  /// False when no texel of the column is complete.
  bool column(std::size_t column, std::uint16_t* start) {
    gather(column);
    if (m_texels.empty()) return false;
    measureRuns();
    divide();
    std::fill_n(start, m_inner, static_cast<std::uint16_t>(m_job.input.layers));
    for (std::size_t g = 0; g < m_borders.size(); ++g) {
      const int above = m_job.input.layer[m_texels[m_borders[g] - 1]],
                below = m_job.input.layer[m_texels[m_borders[g]]];
      start[g] = static_cast<std::uint16_t>((above + below + 1) / 2);
    }
    return true;
  }

 private:
  /// Prefix sums over the texels with a weight and all samples.
  void gather(std::size_t column) {
    m_texels.clear();
    m_sums.assign(m_channels, std::vector<Sums>(1));
    const std::size_t begin = m_job.input.columnStart[column], end = m_job.input.columnStart[column + 1];
    m_moments.assign(m_channels * 6 * (end - begin), 0.0);
    for (std::size_t c = 0; c < m_channels && end > begin; ++c) {
      lightMoments(m_job, c, m_job.system.functions, begin, end,
                   std::span(m_moments).subspan(c * 6 * (end - begin), 6 * (end - begin)));
    }
    for (std::size_t t = begin; t < end; ++t) {
      if (m_job.weight(t) > 0.0 && finite(t - begin, end - begin)) append(t, t - begin, end - begin);
    }
  }
  bool finite(std::size_t local, std::size_t count) const {
    for (std::size_t c = 0; c < m_channels; ++c) {
      if (!std::isfinite(m_moments[(c * 6 + 5) * count + local])) return false;
    }
    return true;
  }
  void append(std::size_t texel, std::size_t local, std::size_t count) {
    m_texels.push_back(texel);
    const double w = m_job.weight(texel), u = m_job.u(texel), perLight = w / static_cast<double>(m_job.lights());
    for (std::size_t c = 0; c < m_channels; ++c) {
      Sums sums = m_sums[c].back();
      double power = w;
      for (double& sum : sums.power) {
        sum += power;
        power *= u;
      }
      for (std::size_t p = 0; p < 6; ++p) {
        const double moment = perLight * m_moments[(c * 6 + p) * count + local];
        sums.moment[p] += moment;
        if (p >= 3) sums.layer[p - 3] += u * moment;
        if (p == 5) sums.square += u * u * moment;
      }
      m_sums[c].push_back(sums);
    }
  }

  void measureRuns() {
    const std::size_t n = m_texels.size();
    m_run.assign((n + 1) * (n + 1), 0.0);
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = i + 1; j <= n; ++j) {
        for (const auto& sums : m_sums) m_run[i * (n + 1) + j] += m_gain(sums[i], sums[j]);
      }
    }
  }

  /// The most explained by the first j texels in g + 1 groups, and where the last of them starts; fewer groups win a
  /// tie, so that equal fits make no border.
  void divide() {
    const std::size_t n = m_texels.size(), width = n + 1, last = std::min(m_inner, n - 1);
    m_best.assign((last + 1) * width, 0.0);
    m_from.assign((last + 1) * width, 0);
    for (std::size_t j = 1; j <= n; ++j) m_best[j] = m_run[j];
    for (std::size_t g = 1; g <= last; ++g) {
      for (std::size_t j = g + 1; j <= n; ++j) {
        double& best = m_best[g * width + j];
        best = -1.0;
        for (std::size_t i = g; i < j; ++i) {
          const double sum = m_best[(g - 1) * width + i] + m_run[i * width + j];
          if (sum > best) best = sum, m_from[g * width + j] = i;
        }
      }
    }
    std::size_t groups = 0;
    for (std::size_t g = 1; g <= last; ++g) {
      if (m_best[g * width + n] > m_best[groups * width + n]) groups = g;
    }
    m_borders.resize(groups);
    for (std::size_t g = groups, j = n; g > 0; --g) {
      j = m_from[g * width + j];
      m_borders[g - 1] = j;
    }
  }

  const FitJob& m_job;
  RunGain m_gain;
  std::size_t m_channels, m_inner;
  std::vector<std::size_t> m_texels;      ///< of the column, complete ones
  std::vector<double> m_moments;          ///< [channel][6][texel]
  std::vector<std::vector<Sums>> m_sums;  ///< [channel][texels + 1]
  std::vector<double> m_run, m_best;      ///< [first][end]; [groups - 1][end]
  std::vector<std::size_t> m_from, m_borders;
};

}  // namespace

std::vector<std::uint16_t> equalGroups(int layers, int groups) {
  std::vector<std::uint16_t> start;
  for (int g = 1; g < groups; ++g) start.push_back(static_cast<std::uint16_t>((layers * g + groups / 2) / groups));
  return start;
}

std::vector<std::uint16_t> bestGroups(const FitInput& input, const FitOptions& options, int groups,
                                      const JobContext& job) {
  const LightSystem system = makeLightSystem(input.lights, options);
  const std::vector<std::uint16_t> equal = equalGroups(input.layers, groups);
  std::vector<std::uint16_t> start(static_cast<std::size_t>(input.columns) * equal.size());
  FitOptions lpt = options;
  lpt.basis = Basis::Lpt;
  Fit unused;
  const FitJob work{input, lpt, system, unused};
  base::parallelFor(job, static_cast<std::size_t>(input.columns), 128, [&](std::size_t begin, std::size_t end) {
    GroupSearch search(work, groups);
    for (std::size_t c = begin; c < end; ++c) {
      std::uint16_t* out = start.data() + c * equal.size();
      // Fewer than six lights do not tell the functions apart, and no group is better than another.
      if (equal.empty() || (system.wellConditioned && search.column(c, out))) continue;
      std::copy(equal.begin(), equal.end(), out);
    }
  });
  return start;
}

}  // namespace sward::lpt::detail
