#include "report/speed_fit.h"

#include "base/parallel.h"
#include "base/random.h"
#include "lpt/fit.h"
#include "lpt/polynomial.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <tuple>

#include <Eigen/Dense>

namespace sward::report {
namespace {

constexpr int kLights = 15, kLayers = 16;
/// Share of the pixseries with one or two occupied layers in the trial on procedural grass.
constexpr double kThinShare = 0.39;

/// Layer samples like those of a patch, made up: a cosine response under a shadow edge of its own, with noise.
struct Samples {
  int columns = 0;
  std::vector<glm::dvec3> lights;
  std::vector<std::uint32_t> columnStart{0};
  std::vector<std::uint8_t> layer;
  std::vector<float> coverage, visibility;
  std::vector<std::vector<float>> luminance;

  lpt::FitInput input() const {
    lpt::FitInput in;
    in.columns = columns;
    in.layers = kLayers;
    in.columnStart = columnStart;
    in.layer = layer;
    in.coverage = coverage;
    in.visibility = visibility;
    in.lights = lights;
    for (const auto& one : luminance) in.samples.emplace_back(one);
    return in;
  }
  double lightSamples() const { return static_cast<double>(layer.size()) * kLights; }
};

/// Spherical Fibonacci points over the upper hemisphere, as baked lights are.
std::vector<glm::dvec3> hemisphere() {
  std::vector<glm::dvec3> lights;
  for (int i = 0; i < kLights; ++i) {
    const double z = 1.0 - (i + 0.5) / kLights, r = std::sqrt(1.0 - z * z);
    const double azimuth = i * std::numbers::pi * (3.0 - std::sqrt(5.0));
    lights.emplace_back(r * std::cos(azimuth), r * std::sin(azimuth), z);
  }
  return lights;
}

/// Occupied layers of one pixseries, ascending.
std::vector<std::uint8_t> occupiedLayers(base::Random& random, bool dense) {
  std::vector<std::uint8_t> all(kLayers);
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = static_cast<std::uint8_t>(i);
  if (dense) return all;
  const std::uint32_t count = random.uniform() < kThinShare ? 1 + random.index(2) : 3 + random.index(kLayers - 2);
  for (std::uint32_t i = 0; i < count; ++i) std::swap(all[i], all[i + random.index(kLayers - i)]);
  all.resize(count);
  std::sort(all.begin(), all.end());
  return all;
}

Samples makeSamples(int columns, bool dense) {
  Samples s;
  s.columns = columns;
  s.lights = hemisphere();
  s.luminance.resize(kLights);
  base::Random random(base::mix64(2006, dense ? 1 : 2));
  for (int c = 0; c < columns; ++c) {
    const double tilt = random.uniform(0.0, 1.2), turn = random.uniform(0.0, 2.0 * std::numbers::pi);
    const glm::dvec3 normal(std::sin(tilt) * std::cos(turn), std::sin(tilt) * std::sin(turn), std::cos(tilt));
    for (const std::uint8_t layer : occupiedLayers(random, dense)) {
      s.layer.push_back(layer);
      s.coverage.push_back(static_cast<float>(random.uniform(0.1, 1.0)));
      s.visibility.push_back(static_cast<float>(random.uniform()));
      const double horizon = random.uniform(0.0, 0.4 + 0.5 * layer / kLayers);
      for (std::size_t k = 0; k < kLights; ++k) {
        const double lit = s.lights[k].z > horizon ? std::max(glm::dot(normal, s.lights[k]), 0.0) : 0.0;
        s.luminance[k].push_back(static_cast<float>(lit + random.uniform(0.0, 0.05)));
      }
    }
    s.columnStart.push_back(static_cast<std::uint32_t>(s.layer.size()));
  }
  return s;
}

/// One pixseries the plain way: its weighted rows and the ridge's, written out, and Eigen's colPivHouseholderQr.
class PlainFitter {
 public:
  explicit PlainFitter(const lpt::FitInput& in, const lpt::FitOptions& options) : m_in(in), m_options(options) {}

  void fit(std::size_t column, float* out) {
    const std::size_t begin = m_in.columnStart[column], end = m_in.columnStart[column + 1];
    measure(begin, end);
    const auto rows = static_cast<Eigen::Index>((end - begin) * m_in.lights.size());
    m_rows.resize(rows + 9, 10);
    m_right.resize(rows + 9);
    Eigen::Index row = 0;
    for (std::size_t t = begin; t < end; ++t) {
      const double root = std::sqrt(weight(t) / m_weight);
      for (std::size_t k = 0; k < m_in.lights.size(); ++k, ++row) {
        const auto phi = lpt::lptBasis(m_in.lights[k].x, m_in.lights[k].y, u(t) - m_mean);
        for (std::size_t j = 0; j < 10; ++j) m_rows(row, static_cast<Eigen::Index>(j)) = root * phi[j];
        m_right(row) = root * static_cast<double>(m_in.samples[k][t]);
      }
    }
    const double rowScale = static_cast<double>(m_in.lights.size());
    m_rows.bottomRows(9).setZero();
    m_right.tail(9).setZero();
    for (Eigen::Index j = 0; j < 9; ++j) {
      const bool layered = j == 2 || j == 4 || j == 5 || j == 8;
      m_rows(row + j, j) = std::sqrt((layered ? m_options.layerRidge : m_options.lightRidge) * rowScale);
    }
    m_qr.compute(m_rows);
    store(m_qr.solve(m_right), out);
  }

 private:
  double u(std::size_t t) const { return static_cast<double>(m_in.layer[t]) / m_in.layers; }
  double weight(std::size_t t) const {
    return std::max(static_cast<double>(m_in.visibility[t]), 0.5 / m_in.visibilityDirections) *
           static_cast<double>(m_in.coverage[t]);
  }
  void measure(std::size_t begin, std::size_t end) {
    m_weight = 0.0;
    m_mean = 0.0;
    for (std::size_t t = begin; t < end; ++t) {
      m_weight += weight(t);
      m_mean += weight(t) * u(t);
    }
    m_mean /= m_weight;
  }
  void store(Eigen::VectorXd b, float* out) const {
    b(9) += m_mean * (b(2) * m_mean - 2.0 * b(8));
    b(8) -= b(2) * m_mean;
    b(6) -= b(4) * m_mean;
    b(7) -= b(5) * m_mean;
    for (Eigen::Index j = 0; j < 10; ++j) out[j] = static_cast<float>(b(j));
  }

  const lpt::FitInput& m_in;
  const lpt::FitOptions& m_options;
  double m_weight = 0.0, m_mean = 0.0;
  Eigen::MatrixXd m_rows;
  Eigen::VectorXd m_right;
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> m_qr;
};

std::vector<float> fitPlainly(const lpt::FitInput& in, const lpt::FitOptions& options, const JobContext& job) {
  std::vector<float> out(static_cast<std::size_t>(in.columns) * 10);
  base::parallelFor(job, static_cast<std::size_t>(in.columns), 128, [&](std::size_t begin, std::size_t end) {
    PlainFitter fitter(in, options);
    for (std::size_t c = begin; c < end; ++c) fitter.fit(c, &out[c * 10]);
  });
  return out;
}

/// Largest difference of a coefficient, relative to the largest coefficient of its pixseries.
double largestDifference(std::span<const float> a, std::span<const float> b) {
  double largest = 0.0;
  for (std::size_t c = 0; c + 10 <= a.size(); c += 10) {
    double scale = 0.0, difference = 0.0;
    for (std::size_t j = c; j < c + 10; ++j) {
      scale = std::max(scale, std::abs(static_cast<double>(b[j])));
      difference = std::max(difference, std::abs(static_cast<double>(a[j]) - static_cast<double>(b[j])));
    }
    if (scale > 0.0) largest = std::max(largest, difference / scale);
  }
  return largest;
}

struct Comparison {
  TimeMs fast, plain;
  double difference = 0.0, rate = 0.0, ratio = 0.0;
  std::string failure;
};

Comparison compare(const Samples& samples, const JobContext& job, int runs) {
  const lpt::FitOptions options;
  const lpt::FitInput in = samples.input();
  Comparison c;
  lpt::Fit fast;
  std::vector<float> plain;
  std::tie(c.fast, c.plain) = timePairs(
      runs,
      [&] {
        auto result = lpt::fit(in, options, job);
        if (result) {
          fast = std::move(result).value();
        } else {
          c.failure = result.error().text();
        }
      },
      [&] { plain = fitPlainly(in, options, job); });
  if (!c.failure.empty()) return c;
  c.difference = largestDifference(fast.coefficients, plain);
  c.rate = samples.lightSamples() / (c.fast.median * 1e-3);
  c.ratio = c.plain.median / c.fast.median;
  return c;
}

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.4g", value);
  return text;
}

}  // namespace

Row lptFitRow(const JobContext& job, bool quick) {
  JobContext silent = job;
  silent.onProgress = nullptr;  // its cost is not the fit's
  const int columns = quick ? 128 * 128 : 256 * 256, runs = quick ? 3 : 5;
  Row row;
  row.method = "lpt_fit";
  row.against = "Eigen colPivHouseholderQr, one per pixseries, rows and ridge written out, same threads";
  const Samples denseSamples = makeSamples(columns, true);
  const Comparison dense = compare(denseSamples, silent, runs);
  const Samples sparseSamples = makeSamples(columns, false);
  const Comparison sparse = compare(sparseSamples, silent, runs);
  if (!dense.failure.empty() || !sparse.failure.empty()) {
    row.notes = "not measured: " + (dense.failure.empty() ? sparse.failure : dense.failure);
    return row;
  }
  row.numbersAndNames = {{"pixseries", std::to_string(columns)},
                         {"layers", std::to_string(kLayers)},
                         {"lights", std::to_string(kLights)},
                         {"channels", "1"},
                         {"threads", std::to_string(base::threadCount(job))},
                         {"target_rate", "1e8"},
                         {"target_ratio", "10"},
                         {"sparse_rate", number(sparse.rate)},
                         {"sparse_ratio", number(sparse.ratio)},
                         {"sparse_light_samples", number(sparseSamples.lightSamples())},
                         {"sparse_ms", number(sparse.fast.median)},
                         {"against_ms", number(dense.plain.median)}};
  row.timeMs = dense.fast;
  row.rate = dense.rate;
  row.rateUnit = "light samples";
  row.ratio = dense.ratio;
  row.error = {{"max", std::max(dense.difference, sparse.difference)}};
  row.reference = "coefficients of the QR, relative to the largest of their pixseries";
  row.notes =
      "Made-up shadow-edge responses. Dense: all layers occupied. Sparse: 39 % of the pixseries have one or two "
      "occupied layers, the others 3 to 16. Validation, rank and condition are in the time. In depth; what lpt8 adds "
      "to "
      "it is in lpt_fit's bake seconds, beside lpt_depth's.";
  return row;
}

}  // namespace sward::report
