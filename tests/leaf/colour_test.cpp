// From spectra to colours.

#include "leaf/colour.h"

#include "image/ciede2000.h"
#include "image/colour.h"
#include "leaf/prospect.h"
#include "leaf/tables.h"

#include <cmath>

#include <gtest/gtest.h>

namespace sward::leaf {
namespace {

Spectrum flat(double value) {
  Spectrum spectrum;
  spectrum.fill(value);
  return spectrum;
}

TEST(Colour, FlatSpectraAreGrey) {
  for (const double value : {0.0, 0.18, 1.0}) {
    const glm::dvec3 rgb = linearFromSpectrum(flat(value));
    // 71 products and a matrix: some hundred roundings of values up to 1.
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(rgb[c], value, 1e-12);
  }
}

TEST(Colour, IsLinear) {
  Spectrum ramp, twice;
  for (std::size_t i = 0; i < kSamples; ++i) {
    ramp[i] = static_cast<double>(i) / kSamples;
    twice[i] = 2.0 * ramp[i];
  }
  const glm::dvec3 difference = linearFromSpectrum(twice) - 2.0 * linearFromSpectrum(ramp);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(difference[c], 0.0, 1e-12);
}

/// XYZ by the CIE's own tables at 1 nm, all of 360 to 830 nm, white at image::kWhiteXyz as xyzFromSpectrum has it.
glm::dvec3 tableXyz(const Samples& spectrum) {
  Samples d65;
  for (const auto& row : numberRows(spectraFolder() / "cie/cie_illuminant_D65_300-830_5nm.csv")) {
    if (row.size() == 2) d65.emplace_back(row[0], row[1]);
  }
  glm::dvec3 sum(0.0), white(0.0);
  for (const auto& row : numberRows(spectraFolder() / "cie/cie1931_2deg_xyz_360-830_1nm.csv")) {
    if (row.size() != 4) continue;
    const glm::dvec3 weight = valueAt(d65, row[0]) * glm::dvec3(row[1], row[2], row[3]);
    sum += weight * valueAt(spectrum, row[0]);
    white += weight;
  }
  return sum / white * image::kWhiteXyz;
}

TEST(Colour, CompactFormsCostLittleColour) {
  if (!std::filesystem::exists(spectraFolder())) GTEST_SKIP() << "no spectra";
  double worst = 0.0;
  int leaves = 0;
  for (const auto& [label, samples] : spectralLibrary(spectraFolder() / "measured/leaf_surface_spectral_library.xml")) {
    if (samples.empty() || samples.front().first > 400.0) continue;
    Spectrum spectrum;
    for (std::size_t i = 0; i < kSamples; ++i) spectrum[i] = valueAt(samples, wavelengthNm(i));
    const double difference =
        image::ciede2000(image::labFromXyz(tableXyz(samples)), image::labFromXyz(xyzFromSpectrum(spectrum)));
    worst = std::max(worst, difference);
    ++leaves;
  }
  EXPECT_GE(leaves, 40);
  // Half of what an eye can tell; against the tables at 1 nm over 360 to 830 nm.
  EXPECT_LT(worst, 0.5);
  RecordProperty("worst_ciede2000", std::to_string(worst));
}

TEST(Gamut, LeavesColoursInsideAsTheyAre) {
  for (const glm::dvec3 colour : {glm::dvec3(0.0), glm::dvec3(1.0), glm::dvec3(0.06, 0.13, 0.025)}) {
    const GamutColour inside = intoGamut(colour);
    EXPECT_EQ(inside.linear, colour);
    EXPECT_EQ(inside.desaturation, 0.0);
  }
}

TEST(Gamut, KeepsLuminance) {
  for (const glm::dvec3 colour : {glm::dvec3(0.3, 0.4, -0.05), glm::dvec3(-0.2, 0.5, 0.1), glm::dvec3(1.3, 0.7, 0.2),
                                  glm::dvec3(-0.001, 0.01, -0.002)}) {
    const GamutColour inside = intoGamut(colour);
    EXPECT_GT(inside.desaturation, 0.0);
    EXPECT_LE(inside.desaturation, 1.0);
    for (int c = 0; c < 3; ++c) {
      EXPECT_GE(inside.linear[c], 0.0);
      EXPECT_LE(inside.linear[c], 1.0);
    }
    EXPECT_NEAR(image::xyzFromLinear(inside.linear).y, image::xyzFromLinear(colour).y, 1e-12);
  }
  // Nothing but black has no luminance, nothing but white has all.
  EXPECT_EQ(intoGamut({0.0, -0.5, 0.1}).linear, glm::dvec3(0.0));
  EXPECT_EQ(intoGamut({1.5, 1.2, 1.1}).linear, glm::dvec3(1.0));
}

}  // namespace
}  // namespace sward::leaf
