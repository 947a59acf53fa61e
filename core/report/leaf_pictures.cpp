#include "report/leaf_pictures.h"

#include "image/colour.h"
#include "leaf/ageing.h"
#include "leaf/colour.h"

#include <algorithm>

namespace sward::report {
namespace {

constexpr int kPatch = 80;  ///< pixels along a patch of colour
constexpr int kAges = 12;

void fillPatch(image::Image& picture, int column, int row, const glm::dvec3& linear) {
  for (int y = row * kPatch; y < (row + 1) * kPatch; ++y) {
    for (int x = column * kPatch; x < (column + 1) * kPatch; ++x) {
      for (int c = 0; c < 3; ++c) picture.at(x, y, c) = static_cast<float>(linear[c]);
    }
  }
}

Picture pictureOf(const std::string& name, const std::string& caption, image::Image linear) {
  Picture picture{name, caption, std::move(linear), {}};
  picture.display = picture.linear;
  for (float& value : picture.display.pixels) value = image::srgbFromLinear(value);
  return picture;
}

glm::dvec3 shown(const leaf::Spectrum& spectrum) {
  return leaf::intoGamut(leaf::linearFromSpectrum(spectrum)).linear;
}

}  // namespace

LeafAge leafAge(double life) {
  const double chlorophyll = std::max(0.0, 1.0 - life / 0.75);
  return {chlorophyll * chlorophyll, std::clamp(1.0 - (life - 0.35) / 0.65, 0.0, 1.0)};
}

Result<Strip> ageStrip(const leaf::LeafOptions& options, const std::string& name, const std::string& title) {
  image::Image linear(kAges * kPatch, 2 * kPatch, 3);
  for (int i = 0; i < kAges; ++i) {
    const LeafAge age = leafAge(static_cast<double>(i) / (kAges - 1));
    SWARD_ASSIGN(const leaf::LeafColourDetail leaf, leaf::agedColour(options, age.chlorophyllShare, age.waterShare));
    fillPatch(linear, i, 0, leaf.colour.reflectance);
    fillPatch(linear, i, 1, leaf.colour.transmittance);
  }
  return Strip{title, {pictureOf(name, "from fresh to straw; above reflected, below transmitted", std::move(linear))}};
}

Strip measuredStrip(const std::vector<FittedLeaf>& leaves) {
  image::Image linear(static_cast<int>(leaves.size()) * kPatch, 3 * kPatch, 3);
  std::string names;
  for (std::size_t i = 0; i < leaves.size(); ++i) {
    fillPatch(linear, static_cast<int>(i), 0, shown(leaves[i].measured.reflectance));
    fillPatch(linear, static_cast<int>(i), 1, shown(leaves[i].plates.spectra.reflectance));
    fillPatch(linear, static_cast<int>(i), 2, shown(leaves[i].subtraction.spectra.reflectance));
    names += (i > 0 ? "; " : "") + std::string(leaves[i].measured.name);
  }
  return {
      "Measured leaves, and each model fitted to them",
      {pictureOf("leaf_measured", "from above measured, plates, subtraction; from left " + names, std::move(linear))}};
}

Result<Plot> agePlot(const leaf::LeafOptions& options) {
  Plot plot;
  plot.name = "leaf_ages";
  plot.title = "Reflectance of an ageing leaf, plates";
  plot.xLabel = "wavelength, nm";
  plot.yLabel = "reflectance without surface light";
  plot.caption =
      "Chlorophyll leaves first and lifts green, then red; water leaves last, air between the cells brightens all of "
      "it "
      "and brown pigments take some back, most in blue.";
  const struct {
    const char* name;
    double life;
  } ages[] = {{"fresh", 0.0}, {"a quarter", 0.25}, {"half", 0.5}, {"straw", 1.0}};
  for (const auto& age : ages) {
    const LeafAge shares = leafAge(age.life);
    SWARD_ASSIGN(const leaf::LeafSpectra spectra,
                 leaf::leafSpectra(leaf::agedContents(options, shares.chlorophyllShare, shares.waterShare),
                                   leaf::Calibration::ProspectD, leaf::kSurfaceRemoved));
    Plot::Series series{age.name, {}, true};
    for (std::size_t i = 0; i < leaf::kSamples; ++i) {
      series.points.push_back({leaf::wavelengthNm(i), spectra.reflectance[i], ""});
    }
    plot.series.push_back(std::move(series));
  }
  return plot;
}

}  // namespace sward::report
