// Leaves that age: where their colours go, the table of them, and the paper's own model beside.

#include "leaf/ageing.h"

#include "image/ciede2000.h"
#include "image/colour.h"
#include "leaf/pigment_subtraction.h"

#include <algorithm>
#include <limits>

#include <gtest/gtest.h>

namespace sward::leaf {
namespace {

double luminanceOf(const glm::dvec3& linear) {
  return image::xyzFromLinear(linear).y;
}

TEST(Ageing, FreshGrassIsGreenAndStrawIsStraw) {
  const LeafColour fresh = agedColour({}, 1.0, 1.0).value().colour;
  const LeafColour straw = agedColour({}, 0.0, 0.0).value().colour;
  // Green above red above blue, dark; straw red above green above blue, bright: measured grass and straw lie there.
  EXPECT_NEAR(fresh.reflectance.g, 0.14, 0.03);
  EXPECT_NEAR(fresh.reflectance.r, 0.05, 0.025);
  EXPECT_LT(fresh.reflectance.b, fresh.reflectance.r);
  EXPECT_NEAR(straw.reflectance.r, 0.50, 0.06);
  EXPECT_NEAR(straw.reflectance.g, 0.37, 0.05);
  EXPECT_NEAR(straw.reflectance.b, 0.16, 0.04);
  // Light through a leaf is yellower than what it reflects.
  EXPECT_GT(fresh.transmittance.r / fresh.transmittance.g, fresh.reflectance.r / fresh.reflectance.g);
}

TEST(Ageing, ChlorophyllDarkensEverything) {
  for (const double water : {0.0, 0.5, 1.0}) {
    double before = 2.0, beforeThrough = 2.0;
    for (int i = 0; i <= 40; ++i) {
      const LeafColour colour = agedColour({}, i / 40.0, water).value().colour;
      EXPECT_LT(luminanceOf(colour.reflectance), before);
      EXPECT_LT(luminanceOf(colour.transmittance), beforeThrough);
      before = luminanceOf(colour.reflectance);
      beforeThrough = luminanceOf(colour.transmittance);
    }
  }
}

TEST(Ageing, DryingBrightens) {
  for (const double chlorophyll : {0.0, 0.05, 0.3, 1.0}) {
    const double wet = luminanceOf(agedColour({}, chlorophyll, 1.0).value().colour.reflectance);
    EXPECT_GT(luminanceOf(agedColour({}, chlorophyll, 0.5).value().colour.reflectance), wet);
    // Without brown pigments every step brightens: more surfaces between air and cell.
    LeafOptions clean;
    clean.brownWhenDry = 0.0;
    double before = 0.0;
    for (int i = 0; i <= 20; ++i) {
      const double now = luminanceOf(agedColour(clean, chlorophyll, 1.0 - i / 20.0).value().colour.reflectance);
      EXPECT_GT(now, before);
      before = now;
    }
  }
}

TEST(Ageing, ContentsEndWhereTheOptionsSay) {
  const LeafOptions options;
  EXPECT_EQ(agedContents(options, 1.0, 1.0), freshContents(options));
  EXPECT_EQ(freshContents(options), LeafContents{}) << "the defaults of both are one leaf";
  const LeafContents dry = agedContents(options, 0.0, 0.0);
  EXPECT_EQ(dry.chlorophyll, 0.0);
  EXPECT_EQ(dry.waterCm, 0.0);
  EXPECT_DOUBLE_EQ(dry.structure, options.structureWhenDry);
  EXPECT_DOUBLE_EQ(dry.brown, options.brownWhenDry);
  EXPECT_DOUBLE_EQ(dry.carotenoid, options.carotenoidWhenDry);
  EXPECT_EQ(agedContents(options, 0.0, 1.0).carotenoid, options.carotenoid) << "yellow leaves keep theirs";
  EXPECT_EQ(dry.dryMatter, options.dryMatter);
}

TEST(Ageing, ColoursStayInTheGamutAndBelowOne) {
  for (const auto model : {LeafOptions::Model::Plates, LeafOptions::Model::Subtraction}) {
    LeafOptions options;
    options.model = model;
    for (int i = 0; i <= 10; ++i) {
      for (int j = 0; j <= 10; ++j) {
        const LeafColour colour = agedColour(options, i / 10.0, j / 10.0).value().colour;
        EXPECT_LE(luminanceOf(colour.reflectance) + luminanceOf(colour.transmittance), 1.0);
        for (int c = 0; c < 3; ++c) {
          EXPECT_GE(colour.reflectance[c], 0.0);
          EXPECT_GE(colour.transmittance[c], 0.0);
          EXPECT_LE(colour.reflectance[c] + colour.transmittance[c], 1.0 + 1e-15);
        }
      }
    }
  }
}

/// Greatest and mean CIEDE2000 between the table and agedColour, at the cells' middles and at random-like places.
std::pair<double, double> tableError(const LeafOptions& options) {
  const AgeingColours table = AgeingColours::build(options).value();
  double worst = 0.0, sum = 0.0;
  int count = 0;
  for (int i = 0; i < 67; ++i) {
    for (int j = 0; j < 35; ++j, ++count) {
      const double chlorophyll = std::pow((i + 0.5) / 67.0, 2.0), water = (j + 0.5) / 35.0;
      const LeafColour direct = agedColour(options, chlorophyll, water).value().colour;
      const LeafColour looked = table(chlorophyll, water);
      const double r =
          image::ciede2000(image::labFromLinear(direct.reflectance), image::labFromLinear(looked.reflectance));
      const double t =
          image::ciede2000(image::labFromLinear(direct.transmittance), image::labFromLinear(looked.transmittance));
      worst = std::max({worst, r, t});
      sum += r;
    }
  }
  return {worst, sum / count};
}

TEST(AgeingTable, IsTheDirectColour) {
  const auto [plates, platesMean] = tableError({});
  EXPECT_LT(plates, 0.5);
  EXPECT_LT(platesMean, 0.1);
  const auto [subtraction, subtractionMean] = tableError({.model = LeafOptions::Model::Subtraction});
  // Clamping makes kinks that no smooth interpolation follows.
  EXPECT_LT(subtraction, 0.5);
  EXPECT_LT(subtractionMean, 0.1);
  RecordProperty("plates", std::to_string(plates));
  RecordProperty("subtraction", std::to_string(subtraction));
}

TEST(AgeingTable, IsExactAtItsNodesAndLimitedOutside) {
  const LeafOptions options;
  const AgeingColours table = AgeingColours::build(options).value();
  for (const double chlorophyll : {0.0, 0.25, 1.0}) {
    for (const double water : {0.0, 0.5, 1.0}) {
      const LeafColour direct = agedColour(options, chlorophyll, water).value().colour;
      const LeafColour looked = table(chlorophyll, water);
      for (int c = 0; c < 3; ++c) {  // stored as floats
        EXPECT_NEAR(looked.reflectance[c], direct.reflectance[c], 0x1p-24 * direct.reflectance[c]);
        EXPECT_NEAR(looked.transmittance[c], direct.transmittance[c], 0x1p-24 * direct.transmittance[c]);
      }
    }
  }
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  EXPECT_EQ(table(2.0, inf).reflectance, table(1.0, 1.0).reflectance);
  EXPECT_EQ(table(-1.0, nan).reflectance, table(0.0, 0.0).reflectance);
  EXPECT_EQ(table(nan, -inf).reflectance, table(0.0, 0.0).reflectance);
}

TEST(Ageing, RefusesWhatIsOutsideItsRange) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(agedColour({}, 1.2, 1.0).error().text(), "colour of a leaf: the share of chlorophyll is 1.2. Give 0 to 1.");
  EXPECT_FALSE(agedColour({}, 1.0, nan).ok());
  EXPECT_EQ(AgeingColours::build({.structureWhenDry = 0.0}).error().text(),
            "colour of the leaf: structureWhenDry is 0 plates. Give 1 to 100 plates.");
  EXPECT_FALSE(checkOptions({.brownWhenDry = nan}).ok());
  EXPECT_FALSE(checkOptions({.surfaceShare = 1.5}).ok());
  EXPECT_FALSE(checkOptions({.model = LeafOptions::Model::Subtraction, .subtractionLevel = 0.8}).ok());
  EXPECT_TRUE(checkOptions({}).ok());
}

TEST(Subtraction, SubtractsAndCountsWhatItClamps) {
  LeafOptions options;
  options.subtractionLevel = 1.0;
  options.subtractionTransmission = 0.0;
  options.subtractionStrength = 0.0;
  const SubtractionSpectra white = subtractionSpectra(options, 1.0).value();
  EXPECT_EQ(white.clamped, 0);
  for (const double r : white.reflectance) EXPECT_EQ(r, 1.0);

  options.subtractionStrength = 0.8;
  const SubtractionSpectra some = subtractionSpectra(options, 0.5).value();
  EXPECT_EQ(some.clamped, 0);
  for (std::size_t i = 0; i < kSamples; ++i) {
    const PigmentAbsorbance p = pigmentAbsorbanceAt(wavelengthNm(i));
    const double taken = 0.8 / 40.0 * (0.5 * (27.0 * p.chlorophyllA + 9.0 * p.chlorophyllB) + 4.0 * p.carotenoid);
    EXPECT_NEAR(some.reflectance[i], 1.0 - taken, 1e-15);
  }

  options.subtractionStrength = 100.0;
  const SubtractionSpectra dark = subtractionSpectra(options, 1.0).value();
  int zeros = 0;
  for (const double r : dark.reflectance) {
    EXPECT_GE(r, 0.0);
    zeros += r == 0.0 ? 1 : 0;
  }
  EXPECT_EQ(dark.clamped, zeros);
  EXPECT_GT(dark.clamped, 50);
}

TEST(Subtraction, KnowsNoWater) {
  const LeafOptions options{.model = LeafOptions::Model::Subtraction};
  EXPECT_EQ(agedColour(options, 0.4, 0.0).value().colour.reflectance,
            agedColour(options, 0.4, 1.0).value().colour.reflectance);
  EXPECT_GT(agedColour(options, 1.0, 1.0).value().clampedSamples, 0);
  EXPECT_EQ(agedColour(options, 0.0, 1.0).value().clampedSamples, 0);
}

}  // namespace
}  // namespace sward::leaf
