#include "lpt/fit_system.h"

#include "base/parallel.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>

namespace sward::lpt::detail {
namespace {

constexpr Eigen::Index kF = kTexelFeatures, kP = kPtmCoefficients;
constexpr std::size_t kFeatures = kTexelFeatures, kFunctions = kPtmCoefficients;
using Features = Eigen::Matrix<double, kF, 1>;
using FeatureMatrix = Eigen::Matrix<double, kF, kF>;
using Response = Eigen::Matrix<double, kF, kP>;

/// So little that float samples do not tell, so much that features which are linear in others (a set of opaque plants
/// has no transmitted sky) leave the solution bounded.
constexpr double kTinyRidge = 1e-9;
/// Of the six functions of the light: they are told apart by thousands of texels.
constexpr double kCommonRidge = 1e-6;
/// A layer is held to what all layers have in common, as if it had that share of their texels besides its own.
constexpr double kSharedShare = 1e-4;

Eigen::Matrix<double, kP, kP> lightMatrix(const LightSystem& system) {
  Eigen::Matrix<double, kP, kP> sum = Eigen::Matrix<double, kP, kP>::Zero();
  for (const auto& functions : system.functions) {
    const Eigen::Map<const Eigen::Matrix<double, kP, 1>> g(functions.data());
    sum += g * g.transpose();
  }
  return sum / static_cast<double>(system.functions.size());
}

/// Light moments and features of the texels of some columns.
class BlockSamples {
 public:
  BlockSamples(const FitJob& job, std::size_t begin, std::size_t end)
      : m_job(job), m_first(job.input.columnStart[begin]), m_texels(job.input.columnStart[end] - m_first) {
    const auto channels = static_cast<std::size_t>(job.input.channels);
    m_moments.resize(channels * kFunctions * m_texels);
    m_weights.resize(m_texels);
    m_features.resize(m_texels);
    for (std::size_t c = 0; c < channels; ++c) {
      lightMoments(job, c, job.system.functions, m_first, m_first + m_texels,
                   std::span(m_moments).subspan(c * kFunctions * m_texels, kFunctions * m_texels));
    }
    for (std::size_t column = begin; column < end; ++column) gather(column);
  }

  /// 0 where a texel takes no part.
  double weight(std::size_t texel) const { return m_weights[texel - m_first]; }
  const TexelFeatures& features(std::size_t texel) const { return m_features[texel - m_first]; }
  Eigen::Matrix<double, kP, 1> moments(std::size_t channel, std::size_t texel) const {
    Eigen::Matrix<double, kP, 1> m;
    const double perLight = 1.0 / static_cast<double>(m_job.lights());
    for (std::size_t p = 0; p < kFunctions; ++p) {
      m(static_cast<Eigen::Index>(p)) = perLight * m_moments[(channel * kFunctions + p) * m_texels + texel - m_first];
    }
    return m;
  }

 private:
  void gather(std::size_t column) {
    ColumnFeatures features;
    for (std::size_t t = m_job.input.columnStart[column]; t < m_job.input.columnStart[column + 1]; ++t) {
      const auto unit = [](float value) { return std::isfinite(value) ? std::clamp(value, 0.0f, 1.0f) : 0.0f; };
      const std::size_t local = t - m_first;
      m_features[local] =
          features.next(unit(m_job.input.sky[0][t]), unit(m_job.input.sky[1][t]), unit(m_job.input.coverage[t]));
      m_weights[local] = complete(local) ? m_job.weight(t) : 0.0;
    }
  }
  bool complete(std::size_t local) const {
    for (std::size_t c = 0; c < static_cast<std::size_t>(m_job.input.channels); ++c) {
      if (!std::isfinite(m_moments[(c * kFunctions + kFunctions - 1) * m_texels + local])) return false;
    }
    return true;
  }

  const FitJob& m_job;
  std::size_t m_first, m_texels;
  std::vector<double> m_moments, m_weights;
  std::vector<TexelFeatures> m_features;
};

Features asVector(const TexelFeatures& features) {
  return Eigen::Map<const Eigen::Matrix<float, kF, 1>>(features.data()).cast<double>();
}

/// Normal equations of one layer: sums of w f f^T, and of w f m^T for each channel.
struct LayerSums {
  FeatureMatrix normal = FeatureMatrix::Zero();
  std::vector<Response> right;

  void add(const LayerSums& other) {
    normal += other.normal;
    for (std::size_t c = 0; c < right.size(); ++c) right[c] += other.right[c];
  }
};
using SetSums = std::vector<LayerSums>;

SetSums emptySums(const FitInput& in, int layers) {
  LayerSums one;
  one.right.assign(static_cast<std::size_t>(in.channels), Response::Zero());
  return SetSums(static_cast<std::size_t>(layers), one);
}

/// Sums of blocks of columns, added in order: the same on any number of threads.
SetSums sumLayers(const FitJob& job, const JobContext& context) {
  constexpr std::size_t kBlock = 1024;
  const auto columns = static_cast<std::size_t>(job.input.columns);
  const std::size_t blocks = (columns + kBlock - 1) / kBlock;
  std::vector<SetSums> partial(blocks);
  base::parallelFor(context, blocks, 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t b = begin; b < end; ++b) {
      const std::size_t first = b * kBlock, last = std::min(columns, first + kBlock);
      const BlockSamples samples(job, first, last);
      partial[b] = emptySums(job.input, job.input.layers);
      for (std::size_t t = job.input.columnStart[first]; t < job.input.columnStart[last]; ++t) {
        const double w = samples.weight(t);
        if (!(w > 0.0)) continue;
        LayerSums& layer = partial[b][job.input.layer[t]];
        const Features f = asVector(samples.features(t));
        layer.normal += w * f * f.transpose();
        for (std::size_t c = 0; c < layer.right.size(); ++c) {
          layer.right[c] += w * f * samples.moments(c, t).transpose();
        }
      }
    }
  });
  SetSums sums = emptySums(job.input, job.input.layers);
  for (const SetSums& block : partial) {
    for (std::size_t layer = 0; layer < block.size(); ++layer) sums[layer].add(block[layer]);
  }
  return sums;
}

Response solve(FeatureMatrix normal, const Response& right) {
  normal.diagonal().array() += kTinyRidge;
  return normal.ldlt().solve(right);
}

/// Coordinates are multiples of the weighted mean of what `values` predicts; 0 where that is nothing.
void scaleCoordinates(const SetSums& sums, std::vector<Response>& response, const Eigen::Matrix<double, kP, 1>& mean,
                      std::vector<Features>& coordinates) {
  double total = 0.0, weight = 0.0;
  for (std::size_t layer = 0; layer < sums.size(); ++layer) {
    coordinates.emplace_back(response[layer] * mean);
    total += sums[layer].normal.col(0).dot(coordinates.back());
    weight += sums[layer].normal(0, 0);
  }
  const double scale = total > 1e-6 * weight ? weight / total : 0.0;
  for (Features& coordinate : coordinates) coordinate *= scale;
}

/// The nine functions of v = g - mean in responseBasis, by power of v: (2 lx, 2 ly, 1) v^k, the last 2 v for k = 1.
class ColumnSystem {
 public:
  static constexpr Eigen::Index kSize = 9;
  using Matrix = Eigen::Matrix<double, kSize, kSize>;
  using Vector = Eigen::Matrix<double, kSize, 1>;

  ColumnSystem(const Eigen::Matrix<double, kP, kP>& lights, const FitOptions& options)
      : m_all(lights), m_lights(lights.bottomRightCorner<3, 3>()) {
    m_ridge.setConstant(options.layerRidge);
    m_ridge.head<3>() << options.lightRidge, options.lightRidge, 0.0;
    m_ridge.array() += kTinyRidge;
    m_scale.setOnes();
    m_scale(5) = 2.0;
  }

  struct Texel {
    double weight = 0.0, g = 0.0;
    Eigen::Vector3d moments;  ///< of 2 lx, 2 ly and 1, less the common response's
  };
  struct Solution {
    std::array<double, kLptCoefficients> b{};
    int rank = 0;
    double condition = 0.0;
  };

  /// Moments of a texel's common response, its PTM being `common`.
  Eigen::Vector3d without(const Eigen::Matrix<double, kP, 1>& moments,
                          const Eigen::Matrix<double, kP, 1>& common) const {
    return moments.tail<3>() - m_all.bottomRows<3>() * common;
  }

  Solution solve(std::span<const Texel> texels) const {
    double weight = 0.0, mean = 0.0;
    for (const Texel& texel : texels) weight += texel.weight, mean += texel.weight * texel.g;
    mean /= weight;
    std::array<double, 5> power{};
    Vector right = Vector::Zero();
    for (const Texel& texel : texels) {
      const double v = texel.g - mean;
      double w = texel.weight / weight;
      for (std::size_t k = 0; k < power.size(); ++k) {
        power[k] += w;
        if (k < 3) right.segment<3>(static_cast<Eigen::Index>(3 * k)) += w * texel.moments;
        w *= v;
      }
    }
    Matrix normal;
    for (Eigen::Index i = 0; i < 3; ++i) {
      for (Eigen::Index j = 0; j < 3; ++j) {
        normal.block<3, 3>(3 * i, 3 * j) = power[static_cast<std::size_t>(i + j)] * m_lights;
      }
    }
    normal = m_scale.asDiagonal() * normal * m_scale.asDiagonal();
    normal.diagonal() += m_ridge;
    const Eigen::LLT<Matrix> factors(normal);
    Solution out;
    out.b = expand(factors.solve(m_scale.cwiseProduct(right)), mean);
    out.condition = condition(normal, factors);
    out.rank = 3 * std::min(distinct(texels), 3);
    return out;
  }

 private:
  /// To powers of g.
  static std::array<double, kLptCoefficients> expand(const Vector& x, double m) {
    const Eigen::Vector3d slope(x(3), x(4), 2.0 * x(5)), square = x.tail<3>();
    const Eigen::Vector3d b0 = x.head<3>() - m * slope + m * m * square, b1 = slope - 2.0 * m * square;
    return {square(0), square(1), square(2), 0.0, b1(0), b1(1), b0(0), b0(1), 0.5 * b1(2), b0(2)};
  }

  /// Of the rows, never above the true one: Rayleigh quotients lie inside the spectrum of the normal matrix.
  static double condition(const Matrix& normal, const Eigen::LLT<Matrix>& factors) {
    constexpr int kSteps = 6;
    Vector large = Vector::Ones(), small = Vector::Ones();
    double largest = 1.0, smallestInverse = 1.0;
    for (int step = 0; step < kSteps; ++step) {
      const Vector up = normal * large, down = factors.solve(small);
      largest = large.dot(up) / large.squaredNorm();
      smallestInverse = small.dot(down) / small.squaredNorm();
      large = up.normalized();
      small = down.normalized();
    }
    return std::sqrt(largest * smallestInverse);
  }

  static int distinct(std::span<const Texel> texels) {
    std::array<double, 3> seen{};
    std::size_t count = 0;
    for (const Texel& texel : texels) {
      const auto same = [&](double g) { return std::abs(g - texel.g) <= kRankTolerance * kLargest; };
      if (count < 3 && std::none_of(seen.begin(), seen.begin() + static_cast<std::ptrdiff_t>(count), same)) {
        seen[count++] = texel.g;
      }
    }
    return static_cast<int>(count);
  }

  static constexpr double kLargest = static_cast<double>(kLargestCoordinate);
  Eigen::Matrix<double, kP, kP> m_all;
  Eigen::Matrix3d m_lights;
  Vector m_ridge, m_scale;
};

/// The PTM of a texel's common response.
Eigen::Matrix<double, kP, 1> commonOf(const CommonResponse& common, std::size_t set, const TexelFeatures& features) {
  const float* values = &common.values[set * CommonResponse::kFunctions * kFeatures];
  using Rows = Eigen::Matrix<float, kP, kF, Eigen::RowMajor>;
  return Eigen::Map<const Rows>(values).cast<double>() * asVector(features);
}

}  // namespace

bool hasCommonResponse(const FitJob& job) {
  return job.options.basis == Basis::Lpt && !job.options.paper && job.options.coordinate == LayerCoordinate::Response &&
         job.system.wellConditioned && !job.input.layer.empty() && !job.input.sky[0].empty() &&
         !job.input.sky[1].empty();
}

CommonResponse fitCommonResponse(const FitJob& job, const JobContext& context) {
  SetSums sums = sumLayers(job, context);
  const auto channels = static_cast<std::size_t>(job.input.channels);
  CommonResponse out;
  out.channels = job.input.channels;
  constexpr std::size_t kSet = CommonResponse::kFunctions * kFeatures;
  out.values.assign(sums.size() * channels * kSet, 0.0f);
  LayerSums all = emptySums(job.input, 1).front();
  for (const LayerSums& layer : sums) all.add(layer);
  const double total = all.normal(0, 0);
  if (!(total > 0.0) || context.cancelled()) return out;
  const Eigen::Matrix<double, kP, kP> lights = lightMatrix(job.system);
  Eigen::Matrix<double, kP, kP> ridged = lights;
  ridged.diagonal().head<kP - 1>().array() += kCommonRidge;
  const Eigen::Matrix<double, kP, kP> inverse = ridged.inverse();
  const FeatureMatrix shared = kSharedShare / total * all.normal;
  for (std::size_t c = 0; c < channels; ++c) {
    const Response base = solve(all.normal / total, all.right[c] / total);
    std::vector<Response> response;
    for (const LayerSums& layer : sums) {
      const FeatureMatrix normal = layer.normal / total;
      const Response change = solve(normal + shared, layer.right[c] / total - normal * base);
      response.emplace_back((base + change) * inverse);
    }
    std::vector<Features> coordinates;
    scaleCoordinates(sums, response, lights.col(kP - 1), coordinates);
    for (std::size_t layer = 0; layer < sums.size(); ++layer) {
      float* values = &out.values[(layer * channels + c) * kSet];
      for (std::size_t f = 0; f < kFeatures; ++f) {
        const auto row = static_cast<Eigen::Index>(f);
        for (std::size_t p = 0; p < kFunctions; ++p) {
          values[p * kFeatures + f] = storedCoefficient(response[layer](row, static_cast<Eigen::Index>(p)));
        }
        values[kFunctions * kFeatures + f] = storedCoefficient(coordinates[layer](row));
      }
    }
  }
  return out;
}

void fitResponseBlock(const FitJob& job, int begin, int end) {
  const BlockSamples samples(job, static_cast<std::size_t>(begin), static_cast<std::size_t>(end));
  const ColumnSystem system(lightMatrix(job.system), job.options);
  const CommonAtLight coordinates(job.fit.common, glm::dvec3(0.0, 0.0, 1.0));
  const auto channels = static_cast<std::size_t>(job.input.channels);
  std::vector<ColumnSystem::Texel> texels;
  for (auto column = static_cast<std::size_t>(begin); column < static_cast<std::size_t>(end); ++column) {
    for (std::size_t c = 0; c < channels; ++c) {
      texels.clear();
      double weight = 0.0;
      for (std::size_t t = job.input.columnStart[column]; t < job.input.columnStart[column + 1]; ++t) {
        const double w = samples.weight(t);
        if (!(w > 0.0)) continue;
        weight += w;
        const std::size_t layer = job.input.layer[t];
        const TexelFeatures& f = samples.features(t);
        const float g = coordinates.coordinate(static_cast<int>(layer), static_cast<int>(c), f);
        const auto common = commonOf(job.fit.common, layer * channels + c, f);
        texels.push_back({w, static_cast<double>(g), system.without(samples.moments(c, t), common)});
      }
      if (texels.empty()) break;
      const ColumnSystem::Solution solution = system.solve(texels);
      Fit& fit = job.fit;
      fit.weight[column] = storedWeight(weight);
      fit.condition[column] = std::max(fit.condition[column], static_cast<float>(solution.condition));
      fit.rank[column] = std::max(fit.rank[column], static_cast<std::uint8_t>(solution.rank));
      fit.path[column] = FitPath::Moments;
      float* out = &fit.coefficients[(column * channels + c) * kLptCoefficients];
      for (std::size_t j = 0; j < kLptCoefficients; ++j) out[j] = storedCoefficient(solution.b[j]);
    }
  }
}

}  // namespace sward::lpt::detail
