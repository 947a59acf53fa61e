#include "bake/session_node.h"

#include <span>
#include <utility>

/// The nodes of the graph that turn samples of light to what layers keep of them.
namespace sward::bake {

using trace::LayerSet;

Result<Session::LightSamples> Session::lightSamples(LayerSet set, bool withLights) {
  LightSamples out;
  SWARD_ASSIGN(out.hits, hits(set));
  SWARD_ASSIGN(out.visibility, visibility(set));
  for (std::size_t light = 0; withLights && light < m_lights.size(); ++light) {
    SWARD_ASSIGN(out.lit.emplace_back(), luminance(set, light));
  }
  out.coverage.resize(out.hits->texels());
  for (std::size_t t = 0; t < out.coverage.size(); ++t) out.coverage[t] = out.hits->coverage(t);
  lpt::FitInput& input = out.input;
  input.columns = out.hits->shape.columns();
  input.layers = out.hits->shape.layers;
  input.columnStart = out.hits->columnStart;
  input.layer = out.hits->layer;
  input.coverage = out.coverage;
  input.visibility = out.visibility->visibility;
  input.sky = {out.visibility->skyReflected, out.visibility->skyTransmitted};
  input.visibilityDirections = m_project.sampling.visibilityDirections;
  input.lights = withLights ? std::span(m_lights) : std::span<const glm::dvec3>();
  input.channels = set == LayerSet::Ground ? 1 : 2;
  for (const auto& one : out.lit) input.samples.emplace_back(one->reflected);
  for (std::size_t light = 0; light < out.lit.size() && input.channels == 2; ++light) {
    input.samples.emplace_back(out.lit[light]->transmitted);
  }
  return out;
}

Result<lpt::Fit> Session::meanOfLights(const LightSamples& samples) const {
  const lpt::FitInput& input = samples.input;
  std::vector<std::vector<float>> means(static_cast<std::size_t>(input.channels));
  for (std::size_t c = 0; c < means.size(); ++c) {
    std::vector<double> sums(input.layer.size(), 0.0);
    for (std::size_t light = 0; light < m_lights.size(); ++light) {
      const auto values = input.samples[c * m_lights.size() + light];
      for (std::size_t t = 0; t < sums.size(); ++t) sums[t] += static_cast<double>(values[t]);
    }
    means[c].resize(sums.size());
    for (std::size_t t = 0; t < sums.size(); ++t) {
      means[c][t] = static_cast<float>(sums[t] / static_cast<double>(m_lights.size()));
    }
  }
  const std::vector<std::span<const float>> responses(means.begin(), means.end());
  return lpt::constantFit(input, responses);
}

/// One medium for all layer sets of a session.
Result<std::shared_ptr<const trace::VoxelDensity>> Session::density() {
  if (!m_density) {
    SWARD_ASSIGN(auto grown, patch());
    const trace::VoxelOptions voxels = trace::VoxelOptions::of(m_project.sampling);
    SWARD_ASSIGN(m_density, trace::VoxelDensity::create(std::move(grown), voxels, {m_job.stop, {}, m_job.threads}));
  }
  return m_density;
}

Result<std::shared_ptr<const HeldRepresentation>> Session::representation(LayerSet set,
                                                                          const lpt::FitOptions& options) {
  return node<HeldRepresentation>("representation", trace::layerSetName(set), m_keys.of(set).representation,
                                  Keep::Memory, [&](const JobContext& job) -> Result<HeldRepresentation> {
                                    SWARD_ASSIGN(const LightSamples samples,
                                                 lightSamples(set, options.basis != lpt::Basis::Marched));
                                    lpt::RepresentationInput input{samples.input, samples.hits.get(), nullptr};
                                    if (options.basis == lpt::Basis::Marched) {
                                      SWARD_ASSIGN(const auto medium, density());
                                      input.density = medium;
                                    }
                                    HeldRepresentation held;
                                    SWARD_ASSIGN(held.value, lpt::represent(input, options, true, job));
                                    return held;
                                  });
}

Result<lpt::Fit> Session::sunResponses(LayerSet set, const lpt::FitOptions& options, const JobContext& job) {
  SWARD_ASSIGN(const LightSamples samples, lightSamples(set, false));
  if (options.basis == lpt::Basis::Sampled) {
    SWARD_ASSIGN(const auto lit, sunLuminance(set));
    std::vector<std::span<const float>> responses{lit->reflected};
    if (samples.input.channels == 2) responses.emplace_back(lit->transmitted);
    return lpt::constantFit(samples.input, responses);
  }
  SWARD_ASSIGN(const auto held, representation(set, options));
  std::vector<std::vector<float>> values(static_cast<std::size_t>(samples.input.channels),
                                         std::vector<float>(samples.hits->texels()));
  const std::vector<std::span<float>> out(values.begin(), values.end());
  SWARD_TRY(held->value->relight(*m_settings.sun, out, job));
  const std::vector<std::span<const float>> responses(values.begin(), values.end());
  return lpt::constantFit(samples.input, responses);
}

Result<lpt::Fit> Session::makeFit(LayerSet set, const lpt::FitOptions& options, const JobContext& job) {
  const auto made = [&]() -> Result<lpt::Fit> {
    if (lpt::needsSun(options.basis)) return sunResponses(set, options, job);
    SWARD_ASSIGN(const LightSamples samples, lightSamples(set, true));
    if (options.basis == lpt::Basis::Constant) return meanOfLights(samples);
    return lpt::fit(samples.input, options, job);
  };
  SWARD_ASSIGN(lpt::Fit fitted, made());
  if (m_job.cancelled()) return Error::cancelled();
  SWARD_ASSIGN(const auto found, hits(set));
  lpt::fillEmpty(fitted, found->shape.width, found->shape.height, true);
  return fitted;
}

Result<std::shared_ptr<const lpt::Fit>> Session::fitWith(LayerSet set, const lpt::FitOptions& options,
                                                         const std::string& what, const base::Hash128& key) {
  // What holds for one sun alone is not worth a place on the disk.
  return node<lpt::Fit>("fit", what, key, lpt::needsSun(options.basis) ? Keep::WhileHeld : keepTraced(),
                        [&](const JobContext& job) { return makeFit(set, options, job); });
}

Result<std::shared_ptr<const lpt::Fit>> Session::fit(LayerSet set) {
  return fitWith(set, fitOptionsOf(m_project, set), trace::layerSetName(set), m_keys.of(set).fit);
}

Result<std::shared_ptr<const lpt::Fit>> Session::seamFit() {
  const lpt::FitOptions options = seamOptionsOf(m_project);
  if (m_project.fit == options) return fit(LayerSet::Slices);
  return node<lpt::Fit>("fit", "seams", m_keys.seamFit, keepTraced(), [&](const JobContext& job) -> Result<lpt::Fit> {
    // The layers' own fit, while what both read is held: light that is kept on the disk alone, or nowhere.
    SWARD_ASSIGN(const LightSamples held, lightSamples(LayerSet::Slices, true));
    if (!lpt::needsSun(m_project.fit.basis)) {
      SWARD_ASSIGN(m_slicesFit, fit(LayerSet::Slices));
    }
    return makeFit(LayerSet::Slices, options, job);
  });
}

}  // namespace sward::bake
