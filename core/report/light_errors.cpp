#include "report/light_errors.h"

#include "report/light_truth.h"

#include "base/parallel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

namespace sward::report {
namespace {

/// A texel of the set of moved texels and the four around it.
struct Surroundings {
  std::array<int, 4> column;
  int layer = 0;
  std::array<std::size_t, 4> texel;  ///< where covered
  std::array<double, 4> coverage{};  ///< 0 where there is no texel
  double covered = 0.0;              ///< sum of coverage
};

std::array<int, 4> columnsAround(int column, const trace::LayerShape& shape) {
  const int x = column % shape.width, y = column / shape.width;
  const int right = (x + 1) % shape.width, up = (y + 1) % shape.height;
  return {column, y * shape.width + right, up * shape.width + x, up * shape.width + right};
}

Surroundings around(const LightSamples& samples, int column, int layer) {
  Surroundings s;
  s.column = columnsAround(column, samples.shape());
  s.layer = layer;
  const trace::LayerHits& hits = samples.train.hits;
  for (std::size_t i = 0; i < 4; ++i) {
    const auto c = static_cast<std::size_t>(s.column[i]);
    const auto begin = hits.layer.begin() + hits.columnStart[c], end = hits.layer.begin() + hits.columnStart[c + 1];
    const auto found = std::lower_bound(begin, end, static_cast<std::uint8_t>(layer));
    if (found == end || *found != layer) continue;
    s.texel[i] = static_cast<std::size_t>(found - hits.layer.begin());
    s.coverage[i] = static_cast<double>(samples.train.coverage[s.texel[i]]);
    s.covered += s.coverage[i];
  }
  return s;
}

/// Calls body(moved texel, its surroundings, sums of the row) for all texels; sums of the rows are added in order.
std::vector<ErrorSum> sumRows(const LightSamples& samples, std::size_t sums, const JobContext& job,
                              const std::function<void(std::size_t, const Surroundings&, ErrorSum*)>& body) {
  const trace::LayerHits& hits = samples.between.hits;
  const auto rows = static_cast<std::size_t>(samples.shape().height);
  const auto width = static_cast<std::size_t>(samples.shape().width);
  std::vector<ErrorSum> perRow(rows * sums);
  base::parallelFor(job, rows, 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t column = begin * width; column < end * width; ++column) {
      for (std::size_t t = hits.columnStart[column]; t < hits.columnStart[column + 1]; ++t) {
        body(t, around(samples, static_cast<int>(column), hits.layer[t]), &perRow[column / width * sums]);
      }
    }
  });
  std::vector<ErrorSum> result(sums);
  for (std::size_t i = 0; i < perRow.size(); ++i) result[i % sums].add(perRow[i]);
  return result;
}

float channelOf(const trace::LayerLuminance& luminance, int channel, std::size_t texel) {
  return channel == 0 ? luminance.reflected[texel] : luminance.transmitted[texel];
}

double trueCoverage(const LightSamples& samples, std::size_t texel) {
  return static_cast<double>(samples.truthCoverage[texel]);
}

}  // namespace

void ErrorSum::add(double weight, double difference) {
  if (!(weight > 0.0)) return;  // no truth to differ from
  ++count;
  weights += weight;
  squares += weight * difference * difference;
  errors += weight * difference;
  max = std::max(max, std::abs(difference));
}

void ErrorSum::add(const ErrorSum& other) {
  count += other.count;
  weights += other.weights;
  squares += other.squares;
  errors += other.errors;
  max = std::max(max, other.max);
}

double ErrorSum::rmse() const {
  return std::sqrt(mse());
}
double ErrorSum::psnrDb() const {
  return -10.0 * std::log10(std::max(mse(), 1e-30));
}

ErrorSum total(std::span<const ErrorSum> sums) {
  ErrorSum sum;
  for (const ErrorSum& one : sums) sum.add(one);
  return sum;
}

double texelWeight(const LightSamples& samples, std::size_t texel, TexelWeight weight) {
  const double coverage = trueCoverage(samples, texel);
  if (weight == TexelWeight::Covered) return coverage;
  return coverage * std::max(static_cast<double>(samples.visibility[texel]), 0.5 / samples.visibilityDirections);
}

Result<Predicted> predict(const lpt::Representation& representation, const LightSamples& samples,
                          const glm::dvec3& light, const JobContext& job) {
  Predicted out{std::vector<float>(samples.texels()), std::vector<float>(samples.texels())};
  const std::array<std::span<float>, 2> channels{out.reflected, out.transmitted};
  SWARD_TRY(representation.relight(light, channels, job));
  for (const std::span<float>& channel : channels) {
    for (float& value : channel) value = std::max(value, 0.0f);
  }
  return out;
}

ErrorSum errorOf(const Predicted& predicted, const trace::LayerLuminance& truth, const LightSamples& samples,
                 TexelWeight weight) {
  ErrorSum sum;
  for (std::size_t t = 0; t < samples.texels(); ++t) {
    const double w = texelWeight(samples, t, weight);
    sum.add(w, static_cast<double>(predicted.reflected[t]) - static_cast<double>(truth.reflected[t]));
    sum.add(w, static_cast<double>(predicted.transmitted[t]) - static_cast<double>(truth.transmitted[t]));
  }
  return sum;
}

Result<HeldOutErrors> heldOutErrors(const lpt::Representation& representation, const LightSamples& samples,
                                    const JobContext& job) {
  HeldOutErrors errors;
  for (std::size_t k = 0; k < samples.heldOut.size(); ++k) {
    SWARD_ASSIGN(const Predicted predicted, predict(representation, samples, samples.heldOut[k], job));
    errors.covered.push_back(errorOf(predicted, samples.truth[k], samples, TexelWeight::Covered));
    errors.seen.push_back(errorOf(predicted, samples.truth[k], samples, TexelWeight::Seen));
  }
  return errors;
}

ErrorSum ofElevation(const LightSamples& samples, std::span<const ErrorSum> heldOut, Elevation elevation) {
  ErrorSum sum;
  for (std::size_t k = 0; k < heldOut.size(); ++k) {
    if (elevationOf(samples.heldOut[k]) == elevation) sum.add(heldOut[k]);
  }
  return sum;
}

Result<BetweenErrors> betweenErrors(const lpt::Representation& representation, const LightSamples& samples,
                                    const JobContext& job) {
  BetweenErrors errors;
  for (std::size_t k = 0; k < samples.betweenLights.size(); ++k) {
    const glm::dvec3& light = samples.heldOut[samples.betweenLights[k]];
    SWARD_ASSIGN(const Predicted predicted, predict(representation, samples, light, job));
    const auto sums = sumRows(samples, 2, job, [&](std::size_t t, const Surroundings& s, ErrorSum* row) {
      const auto weight = static_cast<double>(samples.between.coverage[t]);
      for (int channel = 0; channel < 2; ++channel) {
        const std::vector<float>& relit = channel == 0 ? predicted.reflected : predicted.transmitted;
        double drawn = 0.0, filled = 0.0;
        for (std::size_t i = 0; i < 4; ++i) {
          const double value = s.coverage[i] > 0.0
                                   ? static_cast<double>(relit[s.texel[i]])
                                   : std::max(representation.evaluate(s.column[i], s.layer, channel, light), 0.0);
          drawn += s.coverage[i] * value;
          filled += 0.25 * value;
        }
        drawn = s.covered > 0.0 ? drawn / s.covered : filled;
        const auto truth = static_cast<double>(channelOf(samples.between.response[k], channel, t));
        row[0].add(weight, drawn - truth);
        row[1].add(weight, filled - truth);
      }
    });
    if (job.cancelled()) return Error::cancelled();
    errors.drawn.push_back(sums[0]);
    errors.filled.push_back(sums[1]);
  }
  return errors;
}

ErrorSum betweenSamples(const LightSamples& samples) {
  ErrorSum sum;
  for (std::size_t k = 0; k < samples.betweenLights.size(); ++k) {
    const trace::LayerLuminance& known = samples.truth[samples.betweenLights[k]];
    const auto sums = sumRows(samples, 1, {}, [&](std::size_t t, const Surroundings& s, ErrorSum* row) {
      const bool allKnown =
          std::all_of(s.column.begin(), s.column.end(), [&](int column) { return hasTruth(column, samples.shape()); });
      if (!allKnown) return;
      double covered = 0.0;
      for (std::size_t i = 0; i < 4; ++i) covered += s.coverage[i] > 0.0 ? trueCoverage(samples, s.texel[i]) : 0.0;
      if (!(covered > 0.0)) return;
      for (int channel = 0; channel < 2; ++channel) {
        double drawn = 0.0;
        for (std::size_t i = 0; i < 4; ++i) {
          if (!(s.coverage[i] > 0.0)) continue;
          drawn += trueCoverage(samples, s.texel[i]) * static_cast<double>(channelOf(known, channel, s.texel[i]));
        }
        const auto truth = static_cast<double>(channelOf(samples.between.response[k], channel, t));
        row->add(static_cast<double>(samples.between.coverage[t]), drawn / covered - truth);
      }
    });
    sum.add(sums[0]);
  }
  return sum;
}

}  // namespace sward::report
