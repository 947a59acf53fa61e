#include "report/section_fit.h"

#include "report/light_rows.h"
#include "scene/lights.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace sward::report {
namespace {

/// Everything measured of one method.
struct Measured {
  lpt::Method method;
  double bakeSeconds = 0.0;
  std::uint64_t bytes = 0;
  HeldOutErrors heldOut;
  std::vector<std::size_t> leftOut;     ///< training lights
  std::vector<ErrorSum> leftOutErrors;  ///< of each
  BetweenErrors between;
  TimeMs relight;
  std::array<Predicted, 2> predicted;  ///< under the two lights of the arrays

  double rmse() const { return total(heldOut.covered).rmse(); }
  /// Over the lights of `between` alone.
  double rmseOnTexels(const LightSamples& samples) const {
    ErrorSum sum;
    for (const std::size_t k : samples.betweenLights) sum.add(heldOut.covered[k]);
    return sum.rmse();
  }
};

/// The held-out lights whose predictions are written: nearest to 15 and to 65 degrees.
std::array<std::size_t, 2> arrayLights(const LightSamples& samples) {
  std::array<std::size_t, 2> chosen{};
  for (std::size_t i = 0; i < 2; ++i) {
    double least = 360.0;
    for (std::size_t k = 0; k < samples.heldOut.size(); ++k) {
      const double away =
          std::abs(scene::anglesFromDirection(samples.heldOut[k]).elevationDeg - (i == 0 ? 15.0 : 65.0));
      if (away < least) least = away, chosen[i] = k;
    }
  }
  return chosen;
}

class FitSection {
 public:
  FitSection(const SectionInput& input, const LightSamples& samples, const JobContext& job)
      : m_input(input), m_samples(samples), m_job(job), m_lights(arrayLights(samples)) {
    m_quiet = job;
    m_quiet.onProgress = nullptr;
  }

  Result<Section> make() {
    const std::vector<lpt::Method> methods = fittedMethods(m_samples);
    for (const lpt::Method& method : methods) {
      if (m_job.onProgress) {
        m_job.onProgress("Light of " + std::string(method.name),
                         0.5 + 0.5 * static_cast<double>(m_measured.size()) / static_cast<double>(methods.size()));
      }
      SWARD_TRY(measure(method));
    }
    writeSummary();
    for (const Measured& measured : m_measured) m_section.rows.push_back(row(measured));
    m_section.rows.push_back(samplesRow());
    addPlots();
    addTable();
    addArrays();
    return std::move(m_section);
  }

 private:
  Result<void> measure(const lpt::Method& method) {
    Measured m;
    m.method = method;
    SWARD_ASSIGN(const FittedMethod fitted, fitMethod(method, m_input.project.fit, m_samples, m_quiet));
    const lpt::Representation& r = *fitted.representation;
    m.bakeSeconds = fitted.seconds;
    m.bytes = r.lightingBytes();
    SWARD_ASSIGN(m.heldOut, heldOutErrors(r, m_samples, m_quiet));
    SWARD_ASSIGN(m.between, betweenErrors(r, m_samples, m_quiet));
    for (std::size_t i = 0; i < 2; ++i) {
      SWARD_ASSIGN(m.predicted[i], predict(r, m_samples, m_samples.heldOut[m_lights[i]], m_quiet));
    }
    SWARD_TRY(timeRelight(r, m));
    SWARD_TRY(leaveOneOut(method, m));
    m_measured.push_back(std::move(m));
    return {};
  }

  Result<void> timeRelight(const lpt::Representation& r, Measured& m) {
    std::vector<float> reflected(m_samples.texels()), transmitted(m_samples.texels());
    const std::array<std::span<float>, 2> out{reflected, transmitted};
    bool ok = true;
    const glm::dvec3& light = m_samples.heldOut[m_lights[0]];
    m.relight = timeRuns(m_input.quick ? 5 : 11, [&] { ok = r.relight(light, out, m_quiet).ok() && ok; });
    return ok ? Result<void>() : Result<void>(Error::cancelled());
  }

  /// Fits again without a light and compares under it: each in turn, or three of them when quick.
  Result<void> leaveOneOut(const lpt::Method& method, Measured& m) {
    const std::size_t count = m_samples.training.size();
    if (count < 2 || method.basis == lpt::Basis::Marched) return {};  // marched reads no light
    const std::size_t step = m_input.quick ? std::max<std::size_t>(count / 3, 1) : 1;
    for (std::size_t k = step / 2; k < count; k += step) {
      SWARD_ASSIGN(const auto fitted,
                   lpt::represent(m_samples.input(k), method.options(m_input.project.fit), true, m_quiet));
      SWARD_ASSIGN(const Predicted predicted, predict(*fitted, m_samples, m_samples.training[k], m_quiet));
      m.leftOut.push_back(k);
      m.leftOutErrors.push_back(errorOf(predicted, m_samples.train.response[k], m_samples, TexelWeight::Covered));
    }
    return {};
  }

  const Measured* find(std::string_view name) const {
    const auto found =
        std::find_if(m_measured.begin(), m_measured.end(), [&](const Measured& m) { return m.method.name == name; });
    return found == m_measured.end() ? nullptr : &*found;
  }

  void writeSummary() {
    m_section.name = "lpt_fit";
    m_section.title = "Ways to keep how grass answers light";
    m_section.summary =
        sampleSummary(m_samples) +
        " Leave-one-out errors are those under each training light of a fit without it. Between texels: predictions "
        "half-way between four texels (their mean by coverage, as layers are drawn; \"filled\": the plain mean with "
        "what was filled into empty texels, as a texture filter reads) against samples of the patch moved by half a "
        "texel. lpt_depth tells the layers of a column apart by their depth, as the paper does; lpt8 and lpt16 (unless "
        "the project says otherwise) by how bright each texel is expected to be: a regression on its sky terms, its "
        "coverage and what stands above, which all texels of a layer share (70 numbers a layer). \"Seen\" weights by "
        "visibility, too, as fits do. Groups of lpt_clustered are contiguous and each "
        "column's own, a byte a border. The table lpt_fit_lights holds the sums from which every error follows: RMSE "
        "is the root of squares over weights, bias errors over weights.";
  }

  Row row(const Measured& m) const {
    Row row;
    row.method = std::string(m.method.name);
    row.numbersAndNames = sampleParameters(m_samples);
    row.numbersAndNames["bits"] = std::to_string(m.method.bits);
    const Measured *ptm = find("ptm"), *ptm8 = find("ptm8");
    row.ratio = m.rmse() / ptm->rmse();
    row.against = "ptm's held-out RMSE";
    const auto over = [&](const Measured& other) {
      return jsonNumber(static_cast<double>(m.bytes) / static_cast<double>(other.bytes));
    };
    row.numbersAndNames["bytes_over_ptm"] = over(*ptm);
    row.numbersAndNames["bytes_over_ptm8"] = over(*ptm8);
    row.numbersAndNames["between_over_on"] = jsonNumber(total(m.between.drawn).rmse() / m.rmseOnTexels(m_samples));
    row.timeMs = m.relight;
    row.bakeSeconds = m.bakeSeconds;
    row.bytes = m.bytes;
    row.bytesTotal = m.bytes + surfaceBytes(m_samples);
    row.error = figuresOf(total(m.heldOut.covered));
    row.error["rmse_low"] = ofElevation(m_samples, m.heldOut.covered, Elevation::Low).rmse();
    row.error["rmse_middle"] = ofElevation(m_samples, m.heldOut.covered, Elevation::Middle).rmse();
    row.error["rmse_high"] = ofElevation(m_samples, m.heldOut.covered, Elevation::High).rmse();
    row.error["rmse_seen"] = total(m.heldOut.seen).rmse();
    if (!m.leftOut.empty()) row.error["rmse_leave_one_out"] = total(m.leftOutErrors).rmse();
    row.error["rmse_between"] = total(m.between.drawn).rmse();
    row.error["rmse_between_filled"] = total(m.between.filled).rmse();
    row.reference = kHeldOutReference;
    row.notes =
        "Ratio: held-out RMSE over ptm's (smaller is better). Low: sun under 25 degrees; high: over 50. Time: "
        "relighting the whole set on the processor. Bake: the fit alone.";
    return row;
  }

  /// What the comparison itself cannot tell apart.
  Row samplesRow() const {
    Row row;
    row.method = "samples";
    row.numbersAndNames = sampleParameters(m_samples);
    ErrorSum noise;
    noise.weights = 1.0;
    noise.squares = m_samples.noiseVariance;
    row.error = {
        {"rmse", noise.rmse()}, {"psnr_db", noise.psnrDb()}, {"rmse_between", betweenSamples(m_samples).rmse()}};
    row.bakeSeconds = m_samples.sampleSeconds;
    row.numbersAndNames["truth_sub_samples"] = std::to_string(kTruthFactor * m_samples.subSamples);
    row.numbersAndNames["truth_s"] = jsonNumber(m_samples.truthSeconds);
    row.reference = "the two halves of the truth's rays";
    row.notes =
        "No method: the noise of the truth, and what interpolating the truth itself between texels costs. Bake: "
        "sampling the training lights and the visibility.";
    return row;
  }

  void addPlots() {
    Plot front = errorPlot("lpt_fit_bytes", "Bytes of light data against error", "bytes");
    Plot time = errorPlot("lpt_fit_time", "Time to relight against error", "ms");
    Plot elevation;
    elevation.name = "lpt_fit_elevation";
    elevation.title = "Error by the sun's elevation";
    elevation.xLabel = "degrees";
    elevation.yLabel = "RMSE";
    for (const Measured& m : m_measured) {
      const std::string name(m.method.name);
      front.series.push_back({name, {{static_cast<double>(m.bytes), m.rmse(), name}}, false});
      time.series.push_back({name, {{m.relight.median, m.rmse(), name}}, false});
      Plot::Series line{name, {}, true};
      for (std::size_t k = m.heldOut.covered.size(); k-- > 0;) {  // the lattice descends
        const double deg = scene::anglesFromDirection(m_samples.heldOut[k]).elevationDeg;
        line.points.push_back({deg, m.heldOut.covered[k].rmse(), ""});
      }
      if (m.method.name != "lpt_paper") elevation.series.push_back(std::move(line));
    }
    m_section.plots = {std::move(front), std::move(time), std::move(elevation)};
  }

  static void addSum(Table& table, const std::string& method, const char* protocol, std::size_t index,
                     const glm::dvec3& light, const ErrorSum& sum) {
    const auto number = [](double value) {
      char text[32];
      std::snprintf(text, sizeof(text), "%.12g", value);
      return std::string(text);
    };
    const scene::SunAngles angles = scene::anglesFromDirection(light);
    table.rows.push_back({method, protocol, std::to_string(index), number(angles.azimuthDeg),
                          number(angles.elevationDeg), number(light.x), number(light.y), number(light.z),
                          std::to_string(sum.count), number(sum.weights), number(sum.squares), number(sum.errors),
                          number(sum.max)});
  }

  void addTable() {
    Table table{"lpt_fit_lights",
                {"method", "protocol", "light", "azimuth_deg", "elevation_deg", "lx", "ly", "lz", "n", "weights",
                 "squares", "errors", "max"},
                {}};
    for (const Measured& m : m_measured) {
      const std::string name(m.method.name);
      for (std::size_t k = 0; k < m_samples.heldOut.size(); ++k) {
        addSum(table, name, "held_out", k, m_samples.heldOut[k], m.heldOut.covered[k]);
        addSum(table, name, "held_out_seen", k, m_samples.heldOut[k], m.heldOut.seen[k]);
      }
      for (std::size_t i = 0; i < m.leftOut.size(); ++i) {
        addSum(table, name, "leave_one_out", m.leftOut[i], m_samples.training[m.leftOut[i]], m.leftOutErrors[i]);
      }
      for (std::size_t i = 0; i < m_samples.betweenLights.size(); ++i) {
        const std::size_t k = m_samples.betweenLights[i];
        addSum(table, name, "between", k, m_samples.heldOut[k], m.between.drawn[i]);
        addSum(table, name, "between_filled", k, m_samples.heldOut[k], m.between.filled[i]);
      }
    }
    m_section.tables.push_back(std::move(table));
  }

  void addArray(const std::string& name, const std::vector<float>& reflected, const std::vector<float>& transmitted) {
    Array array{name, {2, m_samples.texels()}, reflected};
    array.values.insert(array.values.end(), transmitted.begin(), transmitted.end());
    m_section.arrays.push_back(std::move(array));
  }

  /// Under the low and the high light, [channel][texel], and the weight of each texel.
  void addArrays() {
    m_section.arrays.push_back({"lpt_fit_weight", {m_samples.texels()}, m_samples.truthCoverage});
    for (std::size_t i = 0; i < 2; ++i) {
      const std::string k = std::to_string(m_lights[i]);
      const trace::LayerLuminance& truth = m_samples.truth[m_lights[i]];
      addArray("lpt_fit_truth_" + k, truth.reflected, truth.transmitted);
      for (const Measured& m : m_measured) {
        addArray("lpt_fit_" + std::string(m.method.name) + "_" + k, m.predicted[i].reflected,
                 m.predicted[i].transmitted);
      }
    }
  }

  const SectionInput& m_input;
  const LightSamples& m_samples;
  const JobContext& m_job;
  JobContext m_quiet;
  std::array<std::size_t, 2> m_lights;
  std::vector<Measured> m_measured;
  Section m_section;
};

}  // namespace

Result<Section> lptFitSection(const SectionInput& input, LightSampleSource& source, const JobContext& job) {
  if (job.onProgress) job.onProgress("Sampling light", 0.0);
  SWARD_ASSIGN(const auto samples, source.get(input, job));
  return FitSection(input, *samples, job).make();
}

}  // namespace sward::report
