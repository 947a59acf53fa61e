#include "report/section_relight.h"

#include "base/parallel.h"
#include "report/light_rows.h"

#include <array>

namespace sward::report {
namespace {

/// A method's times with its error.
struct Relit {
  lpt::Method method;
  TimeMs time;
  ErrorSum error;
  std::uint64_t bytes = 0;
};

/// Relights all texels and both channels, under another held-out light in each run.
Result<Relit> relightMethod(const lpt::Method& method, const SectionInput& input, const LightSamples& samples,
                            const JobContext& job) {
  SWARD_ASSIGN(const FittedMethod fitted, fitMethod(method, input.project.fit, samples, job));
  std::vector<float> reflected(samples.texels()), transmitted(samples.texels());
  const std::array<std::span<float>, 2> out{reflected, transmitted};
  Relit relit{method, {}, {}, fitted.representation->lightingBytes()};
  bool ok = true;
  std::size_t run = 0;
  relit.time = timeRuns(input.quick ? 9 : 31, [&] {
    const glm::dvec3& light = samples.heldOut[run++ % samples.heldOut.size()];
    ok = fitted.representation->relight(light, out, job).ok() && ok;
  });
  if (!ok) return Error::cancelled();
  SWARD_ASSIGN(const HeldOutErrors errors, heldOutErrors(*fitted.representation, samples, job));
  relit.error = total(errors.covered);
  return relit;
}

Row rowOf(const Relit& relit, const LightSamples& samples, double ptmMs, const JobContext& job) {
  Row row;
  row.method = std::string(relit.method.name);
  row.numbersAndNames = sampleParameters(samples);
  row.numbersAndNames["bits"] = std::to_string(relit.method.bits);
  row.numbersAndNames["threads"] = std::to_string(base::threadCount(job));
  row.timeMs = relit.time;
  row.rate = static_cast<double>(samples.texels()) / (relit.time.median * 1e-3);
  row.rateUnit = "layer texels";
  row.ratio = ptmMs / relit.time.median;
  row.against = "ptm, relit in the same run";
  row.bytes = relit.bytes;
  row.error = figuresOf(relit.error);
  row.reference = kHeldOutReference;
  return row;
}

}  // namespace

Result<Section> lptRelightSection(const SectionInput& input, LightSampleSource& source, const JobContext& job) {
  if (job.onProgress) job.onProgress("Sampling light", 0.0);
  SWARD_ASSIGN(const auto samples, source.get(input, job));
  JobContext quiet = job;
  quiet.onProgress = nullptr;
  const std::vector<lpt::Method> methods = fittedMethods(*samples);
  std::vector<Relit> all;
  double ptmMs = 0.0;
  for (const lpt::Method& method : methods) {
    if (job.onProgress) {
      job.onProgress("Relighting with " + std::string(method.name),
                     0.5 + 0.5 * static_cast<double>(all.size()) / static_cast<double>(methods.size()));
    }
    SWARD_ASSIGN(Relit relit, relightMethod(method, input, *samples, quiet));
    if (method.name == "ptm") ptmMs = relit.time.median;
    all.push_back(std::move(relit));
  }
  Section section;
  section.name = "lpt_relight";
  section.title = "Relighting";
  section.summary =
      "What a new light costs: the responses of every occupied layer texel, reflected and transmitted, evaluated on "
      "the "
      "processor straight from the stored integers, another light in each run. Errors as in lpt_fit, on the same "
      "samples. The renderer relights lpt and ptm on the graphics card (section speed); the others are relit so and "
      "drawn as constants of that light.";
  Plot plot = errorPlot("lpt_relight_time", "Time to relight against error", "ms");
  for (const Relit& relit : all) {
    section.rows.push_back(rowOf(relit, *samples, ptmMs, job));
    const std::string name(relit.method.name);
    plot.series.push_back({name, {{relit.time.median, relit.error.rmse(), name}}, false});
  }
  section.plots.push_back(std::move(plot));
  return section;
}

}  // namespace sward::report
