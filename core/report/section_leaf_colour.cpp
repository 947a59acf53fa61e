#include "report/section_leaf_colour.h"

#include "image/ciede2000.h"
#include "image/colour.h"
#include "leaf/ageing.h"
#include "leaf/colour.h"
#include "report/leaf_pictures.h"
#include "report/text.h"

#include <algorithm>

namespace sward::report {
namespace {

constexpr int kRuns = 7, kQuickRuns = 3;

struct Model {
  const char* name;
  leaf::LeafOptions options;
};

std::vector<Model> models() {
  leaf::LeafOptions plates, subtraction;
  subtraction.model = leaf::LeafOptions::Model::Subtraction;
  return {{"plates", plates}, {"subtraction", subtraction}};
}

/// A place among the shares that does not repeat soon; even over the table's cells.
LeafAge scattered(int i) {
  const double u = (i * 0.6180339887498949), v = (i * 0.7548776662466927);
  return {u - static_cast<double>(static_cast<int>(u)), v - static_cast<double>(static_cast<int>(v))};
}

Result<Row> directRow(const Model& model, bool quick) {
  constexpr int kCount = 200;
  Row row;
  row.method = model.name;
  SWARD_TRY(leaf::checkOptions(model.options));
  double sum = 0.0;  // read below, so that nothing is optimised away
  TimeMs time = timeRuns(quick ? kQuickRuns : kRuns, [&] {
    for (int i = 0; i < kCount; ++i) {
      const LeafAge age = scattered(i);
      const auto leaf = leaf::agedColour(model.options, age.chlorophyllShare, age.waterShare);
      sum += leaf.ok() ? leaf->colour.reflectance.g : 0.0;
    }
  });
  row.rate = sum > 0.0 ? kCount / (time.median * 1e-3) : 0.0;
  row.rateUnit = "leaf colours";
  for (double* value : {&time.median, &time.min, &time.max}) *value /= kCount;
  row.timeMs = time;
  SWARD_ASSIGN(const leaf::LeafColourDetail fresh, leaf::agedColour(model.options, 1.0, 1.0));
  double desaturated = 0.0;
  for (int i = 0; i <= 100; ++i) {
    const LeafAge age = leafAge(i / 100.0);
    SWARD_ASSIGN(const leaf::LeafColourDetail leaf,
                 leaf::agedColour(model.options, age.chlorophyllShare, age.waterShare));
    desaturated = std::max({desaturated, leaf.desaturatedReflectance, leaf.desaturatedTransmittance});
  }
  row.numbersAndNames = {{"clamped_wavelengths", std::to_string(fresh.clampedSamples)},
                         {"wavelengths", std::to_string(leaf::kSamples)},
                         {"desaturated", numberText(desaturated)}};
  row.notes = "one leaf's reflectance and transmittance, computed anew";
  return row;
}

double deltaE(const glm::dvec3& a, const glm::dvec3& b) {
  return image::ciede2000(image::labFromLinear(a), image::labFromLinear(b));
}

Result<Row> tableRow(const Model& model, const Row& direct, bool quick) {
  constexpr int kLookups = 200000, kCompared = 2000;
  SWARD_ASSIGN(const leaf::AgeingColours table, leaf::AgeingColours::build(model.options));
  Row row;
  row.method = std::string(model.name) + "_table";
  double sum = 0.0;
  TimeMs time = timeRuns(quick ? kQuickRuns : kRuns, [&] {
    for (int i = 0; i < kLookups; ++i) {
      const LeafAge age = scattered(i);
      sum += table(age.chlorophyllShare, age.waterShare).reflectance.g;
    }
  });
  row.rate = sum > 0.0 ? kLookups / (time.median * 1e-3) : 0.0;
  row.rateUnit = "leaf colours";
  if (direct.rate && *direct.rate > 0.0) row.ratio = *row.rate / *direct.rate;
  row.against = "the colour computed anew";
  for (double* value : {&time.median, &time.min, &time.max}) *value /= kLookups;
  row.timeMs = time;
  double greatest = 0.0, total = 0.0;
  for (int i = 0; i < kCompared; ++i) {
    const LeafAge age = scattered(i);
    SWARD_ASSIGN(const leaf::LeafColourDetail truth,
                 leaf::agedColour(model.options, age.chlorophyllShare, age.waterShare));
    const leaf::LeafColour looked = table(age.chlorophyllShare, age.waterShare);
    const double r = deltaE(looked.reflectance, truth.colour.reflectance);
    const double t = deltaE(looked.transmittance, truth.colour.transmittance);
    greatest = std::max({greatest, r, t});
    total += 0.5 * (r + t);
  }
  row.numbersAndNames = {{"delta_e_max", numberText(greatest)}, {"delta_e_mean", numberText(total / kCompared)}};
  row.bytes = table.bytes();
  row.reference = "the colour computed anew";
  row.notes = "bilinear in the root of chlorophyll's share and in water's";
  return row;
}

std::string quoted(const std::string& text) {
  return '"' + text + '"';
}

Row measuredRow(const char* method, const leaf::MeasuredLeaf& measured, const leaf::Spectrum& fitted, double rmse,
                double max) {
  Row row;
  row.method = method;
  const double difference = image::ciede2000(image::labFromXyz(leaf::xyzFromSpectrum(fitted)),
                                             image::labFromXyz(leaf::xyzFromSpectrum(measured.reflectance)));
  row.numbersAndNames = {
      {"leaf", quoted(measured.name)}, {"stage", quoted(measured.stage)}, {"delta_e", numberText(difference)}};
  row.error = {{"rmse", rmse}, {"max", max}};
  row.reference = std::string("measured: USGS spectral library 7, ") + measured.record;
  return row;
}

void addMeasured(const FittedLeaf& leaf, std::vector<Row>& rows) {
  Row plates =
      measuredRow("plates_measured", leaf.measured, leaf.plates.spectra.reflectance, leaf.plates.rmse, leaf.plates.max);
  const leaf::LeafContents& c = leaf.plates.contents;
  plates.numbersAndNames.insert({{"structure", numberText(c.structure)},
                                 {"chlorophyll_ug_cm2", numberText(c.chlorophyll)},
                                 {"carotenoid_ug_cm2", numberText(c.carotenoid)},
                                 {"brown", numberText(c.brown)},
                                 {"dry_matter_g_cm2", numberText(c.dryMatter)}});
  rows.push_back(std::move(plates));
  Row subtraction = measuredRow("subtraction_measured", leaf.measured, leaf.subtraction.spectra.reflectance,
                                leaf.subtraction.rmse, leaf.subtraction.max);
  subtraction.numbersAndNames.insert({{"level", numberText(leaf.subtraction.level)},
                                      {"strength", numberText(leaf.subtraction.strength)},
                                      {"chlorophyll_share", numberText(leaf.subtraction.chlorophyllShare)},
                                      {"clamped_wavelengths", std::to_string(leaf.subtraction.spectra.clamped)}});
  rows.push_back(std::move(subtraction));
}

const char* summary() {
  return "The colour of a leaf as it ages, by two models. Plates: light passes through N plates that hold chlorophyll, "
         "carotenoids, brown pigments, water and dry matter (PROSPECT; Jacquemoud and Baret 1990, coefficients of "
         "Feret "
         "et al. 2017 in compact forms of our own), which gives reflectance and transmittance. Subtraction: the "
         "paper's, "
         "light minus what dissolved pigments absorb, which knows no transmittance and no water.\n\n"
         "Each is fitted to measured leaves: five contents for the plates, level, strength and share of chlorophyll "
         "for "
         "the subtraction. Fits are least squares over wavelengths, weighted by what the eye sees of them; delta_e is "
         "CIEDE2000 of the colours under D65 (1 is about what an eye can tell), rmse and max are of the reflectance, "
         "400 "
         "to 750 nm. Grasses were measured many blades deep, where structure and contents count only in "
         "proportion.\n\n"
         "Strips show twelve ages with the default options. Colours outside the gamut of Rec. 709, above all light "
         "through green and yellow leaves, are moved towards grey at their luminance; desaturated is the most.";
}

}  // namespace

Result<Section> leafColourSection(const SectionInput& input, const JobContext& job) {
  Section section;
  section.name = "leaf_colour";
  section.title = "Leaf colour";
  section.summary = summary();
  for (const Model& model : models()) {
    SWARD_ASSIGN(Row direct, directRow(model, input.quick));
    SWARD_ASSIGN(Row table, tableRow(model, direct, input.quick));
    section.rows.push_back(std::move(direct));
    section.rows.push_back(std::move(table));
    const std::string name = model.name;
    SWARD_ASSIGN(Strip strip, ageStrip(model.options, "leaf_ages_" + name, "Ages of a leaf, " + name));
    section.strips.push_back(std::move(strip));
    if (job.cancelled()) return Error::cancelled();
  }
  std::vector<FittedLeaf> fitted;
  for (const leaf::MeasuredLeaf& measured : leaf::measuredLeaves()) {
    if (job.onProgress) job.onProgress(measured.name, 0.3 + 0.1 * static_cast<double>(fitted.size()));
    fitted.push_back({measured, leaf::fitContents(measured.reflectance), leaf::fitSubtraction(measured.reflectance)});
    addMeasured(fitted.back(), section.rows);
    if (job.cancelled()) return Error::cancelled();
  }
  section.strips.push_back(measuredStrip(fitted));
  SWARD_ASSIGN(Plot plot, agePlot(models().front().options));
  section.plots.push_back(std::move(plot));
  return section;
}

}  // namespace sward::report
