#include "report/section_quantisation.h"

#include "report/light_rows.h"

#include <array>
#include <optional>

namespace sward::report {
namespace {

constexpr std::array<double, 3> kQuantiles{0.0, 0.001, 0.01};

class QuantisationSection {
 public:
  QuantisationSection(const SectionInput& input, const LightSamples& samples, const JobContext& job)
      : m_input(input), m_samples(samples), m_job(job) {
    m_plot.name = "quantisation_clamp";
    m_plot.title = "Error by the share of coefficients cut off";
    m_plot.xLabel = "share at each end";
    m_plot.yLabel = "RMSE on held-out lights";
  }

  /// Rows of one basis: the ranges' clamps, both numbers of bits.
  Result<void> add(std::string_view eight, std::string_view sixteen) {
    for (const std::string_view name : {eight, sixteen}) {
      const lpt::Method& method = *lpt::findMethod(name);
      SWARD_ASSIGN(const ErrorSum floats, errorWith(method, 0.0, false));
      SWARD_ASSIGN(const ErrorSum whole, errorWith(method, 0.0, true));
      Plot::Series series{std::string(name), {}, true};
      for (const double quantile : kQuantiles) {
        SWARD_ASSIGN(const ErrorSum sum, errorWith(method, quantile, true));
        m_section.rows.push_back(row(method, quantile, floats, whole, sum));
        series.points.push_back({quantile, sum.rmse(), std::string(name)});
      }
      m_plot.series.push_back(std::move(series));
    }
    return {};
  }

  Section take() {
    m_section.name = "quantisation";
    m_section.title = "Stored integers";
    m_section.summary =
        "What storing coefficients as integers adds to the error of the fit, on the samples of lpt_fit under its "
        "held-out lights. Mean square errors by cause are differences: of the fit kept as floats; what rounding to the "
        "stored steps adds; what cutting off a share of the coefficients at each end of their ranges adds to that (a "
        "narrower range has finer steps, so that it may take away). added_percent is of the RMSE, over floats.";
    m_section.plots.push_back(std::move(m_plot));
    return std::move(m_section);
  }

 private:
  Result<ErrorSum> errorWith(const lpt::Method& method, double quantile, bool quantised) {
    lpt::FitOptions options = method.options(m_input.project.fit);
    options.clampQuantile = quantile;
    SWARD_ASSIGN(const auto fitted, lpt::represent(m_samples.input(), options, quantised, m_job));
    SWARD_ASSIGN(const HeldOutErrors errors, heldOutErrors(*fitted, m_samples, m_job));
    m_bytes = fitted->lightingBytes();
    return total(errors.covered);
  }

  Row row(const lpt::Method& method, double quantile, const ErrorSum& floats, const ErrorSum& whole,
          const ErrorSum& sum) const {
    Row row;
    row.method = std::string(method.name);
    row.numbersAndNames = sampleParameters(m_samples);
    row.numbersAndNames["bits"] = std::to_string(method.bits);
    row.numbersAndNames["clamp_quantile"] = jsonNumber(quantile);
    row.numbersAndNames["added_percent"] = jsonNumber(100.0 * (sum.rmse() / floats.rmse() - 1.0));
    row.error = figuresOf(sum);
    row.error["mse_fit"] = floats.mse();
    row.error["mse_quantisation"] = whole.mse() - floats.mse();
    row.error["mse_clamp"] = sum.mse() - whole.mse();
    row.bytes = m_bytes;
    row.bytesTotal = m_bytes + surfaceBytes(m_samples);
    row.reference = kHeldOutReference;
    return row;
  }

  const SectionInput& m_input;
  const LightSamples& m_samples;
  const JobContext& m_job;
  std::uint64_t m_bytes = 0;  ///< of the last one
  Plot m_plot;
  Section m_section;
};

}  // namespace

Result<Section> quantisationSection(const SectionInput& input, LightSampleSource& source, const JobContext& job) {
  if (job.onProgress) job.onProgress("Sampling light", 0.0);
  SWARD_ASSIGN(const auto samples, source.get(input, job));
  JobContext quiet = job;
  quiet.onProgress = nullptr;
  QuantisationSection section(input, *samples, quiet);
  if (job.onProgress) job.onProgress("Quantising", 0.5);
  SWARD_TRY(section.add("lpt8", "lpt16"));
  SWARD_TRY(section.add("ptm8", "ptm"));
  return section.take();
}

}  // namespace sward::report
