#include "lpt/fit.h"

#include "base/check.h"
#include "base/parallel.h"
#include "lpt/fit_system.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace sward::lpt {
namespace {

Error mismatch(std::string what) {
  return Error::badInput(std::move(what), "polynomial fit", "Sample the layers again; the bake's inputs do not match");
}

Result<void> checkShape(const FitInput& in) {
  if (in.columns < 0 || in.layers < 1 || in.layers > 256) {
    return mismatch(std::to_string(in.columns) + " columns of " + std::to_string(in.layers) +
                    " layers; layers must be 1 to 256");
  }
  if (in.channels < 1 || in.visibilityDirections < 1) {
    return mismatch(std::to_string(in.channels) + " channels and " + std::to_string(in.visibilityDirections) +
                    " view directions; both must be at least 1");
  }
  if (in.columnStart.size() != static_cast<std::size_t>(in.columns) + 1 || in.columnStart.front() != 0 ||
      in.columnStart.back() != in.layer.size() || !std::is_sorted(in.columnStart.begin(), in.columnStart.end())) {
    return mismatch("column starts that do not cover the " + std::to_string(in.layer.size()) + " texels of " +
                    std::to_string(in.columns) + " columns");
  }
  if (in.coverage.size() != in.layer.size() || in.visibility.size() != in.layer.size()) {
    return mismatch(std::to_string(in.coverage.size()) + " coverages and " + std::to_string(in.visibility.size()) +
                    " visibilities for " + std::to_string(in.layer.size()) + " texels");
  }
  for (const auto& sky : in.sky) {
    if (!sky.empty() && sky.size() != in.layer.size())
      return mismatch(std::to_string(sky.size()) + " sky terms for " + std::to_string(in.layer.size()) + " texels");
  }
  const auto high = std::find_if(in.layer.begin(), in.layer.end(), [&](std::uint8_t l) { return l >= in.layers; });
  if (high != in.layer.end()) {
    return mismatch("a texel in layer " + std::to_string(*high) + " of " + std::to_string(in.layers));
  }
  return {};
}

Result<void> checkSamples(const FitInput& in) {
  if (in.lights.empty()) {
    return Error::badInput("no light directions to fit", "polynomial fit", "Give at least one; 15 is usual");
  }
  for (std::size_t k = 0; k < in.lights.size(); ++k) {
    const glm::dvec3& light = in.lights[k];
    if (!std::isfinite(light.x) || !std::isfinite(light.y) || std::hypot(light.x, light.y) > 1.0 + 1e-6) {
      return Error::badInput("light " + std::to_string(k) + " is not a unit vector", "polynomial fit",
                             "Normalise the light directions");
    }
  }
  const std::size_t expected = in.lights.size() * static_cast<std::size_t>(in.channels);
  if (in.samples.size() != expected) {
    return mismatch(std::to_string(in.samples.size()) + " arrays of samples for " + std::to_string(in.channels) +
                    " channels of " + std::to_string(in.lights.size()) + " lights");
  }
  for (const auto& samples : in.samples) {
    if (samples.size() != in.layer.size()) {
      return mismatch(std::to_string(samples.size()) + " samples for " + std::to_string(in.layer.size()) + " texels");
    }
  }
  return {};
}

Result<void> checkOptions(const FitOptions& options) {
  const auto good = [](double ridge) { return std::isfinite(ridge) && ridge >= 0.0; };
  if (good(options.layerRidge) && good(options.lightRidge)) return {};
  return Error::badInput("a ridge that is negative or not finite", "fit.layerRidge, fit.lightRidge",
                         "Use values from 0 to about 1, such as 0.02 and 0.002");
}

Fit emptyFit(const FitInput& in, const FitOptions& options) {
  Fit fit;
  fit.basis = options.basis;
  fit.columns = in.columns;
  fit.layers = in.layers;
  fit.channels = in.channels;
  fit.perColumn = stackCoefficients(options.basis) * (options.basis == Basis::Lpt ? 1 : in.layers);
  const auto columns = static_cast<std::size_t>(in.columns);
  fit.coefficients.assign(columns * static_cast<std::size_t>(in.channels) * static_cast<std::size_t>(fit.perColumn),
                          0.0f);
  fit.rank.assign(columns, 0);
  fit.condition.assign(columns, 0.0f);
  fit.weight.assign(columns, 0.0f);
  fit.path.assign(columns, FitPath::Empty);
  if (options.basis == Basis::Ptm) fit.layerWeight.assign(columns * static_cast<std::size_t>(in.layers), 0.0f);
  return fit;
}

}  // namespace

Result<void> detail::checkFit(const FitInput& input, const FitOptions& options) {
  SWARD_TRY(checkShape(input));
  SWARD_TRY(checkSamples(input));
  return checkOptions(options);
}

Result<Fit> fit(const FitInput& input, const FitOptions& options, const JobContext& job) {
  SWARD_CHECK(options.basis == Basis::Lpt || options.basis == Basis::Ptm);
  SWARD_TRY(detail::checkFit(input, options));
  // A block's moments (128 columns of 16 texels: 100 KB a channel) stay in the second-level cache.
  constexpr std::size_t kGrain = 128;
  Fit result = emptyFit(input, options);
  const detail::LightSystem system = detail::makeLightSystem(input.lights, options);
  const detail::FitJob work{input, options, system, result};
  detail::PtmSystem ptm;
  if (options.basis == Basis::Ptm) ptm = detail::makePtmSystem(system, options);
  const bool common = detail::hasCommonResponse(work);
  if (common) result.common = detail::fitCommonResponse(work, job);
  base::ProgressCounter progress(job, "Fitting light", static_cast<std::uint64_t>(input.columns));
  base::parallelFor(job, static_cast<std::size_t>(input.columns), kGrain, [&](std::size_t begin, std::size_t end) {
    if (common) {
      detail::fitResponseBlock(work, static_cast<int>(begin), static_cast<int>(end));
    } else if (options.basis == Basis::Lpt) {
      detail::fitLptBlock(work, static_cast<int>(begin), static_cast<int>(end));
    } else {
      detail::fitPtmBlock(work, ptm, static_cast<int>(begin), static_cast<int>(end));
    }
    progress.add(end - begin);
  });
  if (job.cancelled()) return Error::cancelled();
  return result;
}

void save(base::ByteWriter& out, const Fit& fit) {
  out.value(fit.basis);
  out.value(fit.columns);
  out.value(fit.layers);
  out.value(fit.channels);
  out.array(fit.coefficients);
  out.array(fit.rank);
  out.array(fit.condition);
  out.array(fit.weight);
  out.array(fit.path);
  out.array(fit.layerWeight);
  save(out, fit.common);
}

namespace {

bool consistent(const Fit& fit) {
  if (stackCoefficients(fit.basis) == 0 || fit.columns < 0 || fit.layers < 1 || fit.layers > 256) return false;
  if (fit.channels < 1 || fit.channels > 256) return false;
  const auto columns = static_cast<std::size_t>(fit.columns);
  const std::size_t layerWeights = fit.basis != Basis::Lpt ? columns * static_cast<std::size_t>(fit.layers) : 0;
  return fit.coefficients.size() ==
             columns * static_cast<std::size_t>(fit.channels) * static_cast<std::size_t>(fit.perColumn) &&
         fit.rank.size() == columns && fit.condition.size() == columns && fit.weight.size() == columns &&
         fit.path.size() == columns && fit.layerWeight.size() == layerWeights &&
         (fit.common.empty() || (fit.basis == Basis::Lpt && fit.common.fits(fit.layers, fit.channels))) &&
         std::all_of(fit.path.begin(), fit.path.end(), [](FitPath path) { return path <= FitPath::Orthogonal; }) &&
         std::all_of(fit.coefficients.begin(), fit.coefficients.end(), [](float b) { return std::isfinite(b); });
}

}  // namespace

bool load(base::ByteReader& in, Fit& fit) {
  Fit read;
  in.value(read.basis);
  in.value(read.columns);
  in.value(read.layers);
  in.value(read.channels);
  in.array(read.coefficients);
  in.array(read.rank);
  in.array(read.condition);
  in.array(read.weight);
  in.array(read.path);
  in.array(read.layerWeight);
  if (!load(in, read.common) || !in.ok()) return false;
  if (read.layers > 0 && read.layers <= 256 && read.basis != Basis::Lpt)
    read.perColumn = stackCoefficients(read.basis) * read.layers;
  if (!consistent(read)) return false;
  fit = std::move(read);
  return true;
}

}  // namespace sward::lpt
