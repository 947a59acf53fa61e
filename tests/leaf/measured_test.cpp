// Both models against measured leaves: what they cannot follow once they may choose all contents.

#include "image/ciede2000.h"
#include "image/colour.h"
#include "leaf/colour.h"
#include "leaf/fit_contents.h"
#include "leaf/measured_leaves.h"
#include "leaf/simplex.h"
#include "leaf/tables.h"

#include <cmath>
#include <cstdio>
#include <string>

#include <gtest/gtest.h>

namespace sward::leaf {
namespace {

double difference(const Spectrum& a, const Spectrum& b) {
  return image::ciede2000(image::labFromXyz(xyzFromSpectrum(a)), image::labFromXyz(xyzFromSpectrum(b)));
}

TEST(Simplex, FindsTheMinimumOfAValley) {
  // Rosenbrock's: a curved valley, minimum 0 at (1, 1).
  const auto f = [](const std::vector<double>& p) {
    return 100.0 * std::pow(p[1] - p[0] * p[0], 2.0) + std::pow(1.0 - p[0], 2.0);
  };
  const std::vector<double> found = minimumOf(f, {-1.2, 1.0}, 0.5, 3000);
  EXPECT_NEAR(found[0], 1.0, 1e-5);
  EXPECT_NEAR(found[1], 1.0, 1e-5);
}

TEST(FitContents, FindsWhatItWasMadeOf) {
  const LeafContents leaf{1.7, 32.0, 7.0, 0.05, 0.0, 0.006};
  const LeafSpectra made = leafSpectra(leaf, Calibration::ProspectD, kSurfaceKept).value();
  const FittedContents found = fitContents(made.reflectance, &made.transmittance);
  EXPECT_LT(found.rmse, 1e-4);
  EXPECT_NEAR(found.contents.chlorophyll, leaf.chlorophyll, 0.2);
  EXPECT_NEAR(found.contents.structure, leaf.structure, 0.01);
  EXPECT_NEAR(found.contents.carotenoid, leaf.carotenoid, 0.3);
}

TEST(Measured, PlatesComeNearerThanSubtraction) {
  for (const MeasuredLeaf& leaf : measuredLeaves()) {
    const FittedContents plates = fitContents(leaf.reflectance);
    const FittedSubtraction paper = fitSubtraction(leaf.reflectance);
    const double ours = difference(plates.spectra.reflectance, leaf.reflectance);
    const double theirs = difference(paper.spectra.reflectance, leaf.reflectance);
    std::printf(
        "%-20s plates dE %.2f rmse %.4f N %.2f chl %.1f car %.2f brown %.3f dry %.4f | paper dE %.2f rmse %.4f "
        "level %.2f strength %.2f share %.2f clamped %d\n",
        leaf.name, ours, plates.rmse, plates.contents.structure, plates.contents.chlorophyll,
        plates.contents.carotenoid, plates.contents.brown, plates.contents.dryMatter, theirs, paper.rmse, paper.level,
        paper.strength, paper.chlorophyllShare, paper.spectra.clamped);
    EXPECT_LT(ours, 5.0) << leaf.name;
    EXPECT_LT(plates.rmse, paper.rmse) << leaf.name;
    RecordProperty(std::string("plates_") + leaf.record, std::to_string(ours));
    RecordProperty(std::string("subtraction_") + leaf.record, std::to_string(theirs));
  }
}

TEST(Measured, PlatesFollowReflectanceAndTransmittanceTogether) {
  if (!std::filesystem::exists(spectraFolder())) GTEST_SKIP() << "no spectra";
  const auto library = spectralLibrary(spectraFolder() / "measured/leaf_surface_spectral_library.xml");
  // A grass, broad leaves, and the one that turns.
  for (const std::string name : {"maize_leaf", "soybean_leaf", "lettuce_leaf", "walnut_leaf", "bean_leaf_2"}) {
    const bool turning = name == "bean_leaf_2";
    const std::string suffix = turning ? "_0002" : "_0000", base = turning ? "bean_leaf" : name;
    const auto r = library.find(base + "_reflectivity" + suffix), t = library.find(base + "_transmissivity" + suffix);
    ASSERT_TRUE(r != library.end() && t != library.end()) << name;
    Spectrum reflectance, transmittance;
    for (std::size_t i = 0; i < kSamples; ++i) {
      reflectance[i] = valueAt(r->second, wavelengthNm(i));
      transmittance[i] = valueAt(t->second, wavelengthNm(i));
    }
    const FittedContents plates = fitContents(reflectance, &transmittance);
    const double front = difference(plates.spectra.reflectance, reflectance);
    const double through = difference(plates.spectra.transmittance, transmittance);
    // The paper's model knows no transmittance: against it, plates that need not match one either.
    const FittedSubtraction paper = fitSubtraction(reflectance);
    const double alone = difference(fitContents(reflectance).spectra.reflectance, reflectance);
    std::printf(
        "%-14s R alone dE %.2f, both: R dE %.2f T dE %.2f N %.2f chl %.1f car %.2f brown %.3f dry %.4f; paper R dE "
        "%.2f clamped %d\n",
        name.c_str(), alone, front, through, plates.contents.structure, plates.contents.chlorophyll,
        plates.contents.carotenoid, plates.contents.brown, plates.contents.dryMatter,
        difference(paper.spectra.reflectance, reflectance), paper.spectra.clamped);
    EXPECT_LT(front, 6.0) << name;
    EXPECT_LT(through, 6.0) << name;
  }
}

}  // namespace
}  // namespace sward::leaf
