#include "image/flip.h"

#include "image/colour.h"
#include "metric_images.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace sward::image {
namespace {

/// What another implementation gave: the mean, and the map at five pixels.
struct Figures {
  double mean;
  std::array<double, 5> pixels;
};
constexpr std::array<std::pair<int, int>, 5> kPixels{{{0, 0}, {95, 63}, {48, 32}, {17, 5}, {70, 22}}};

// The figures below are those of the authors' implementation (NVlabs/flip at 1eb247c, FLIP.h for the CPU) on the images
// of metric_images.h, its sums in double. It works in float; run in double it differs from itself by up to 1e-5 in
// these means and 6e-5 at these pixels (where the errors are near 0, and q_c = 0.7 and q_f = 0.5 raise the rounding of
// colours, about 1e-5 of L*, to powers below 1). The bounds are twice that; most figures agree to 2e-6.
constexpr double kMeanBound = 2e-5;
constexpr double kPixelBound = 1.2e-4;

void expectFigures(double mean, const Image& map, const Figures& expected, const char* name) {
  EXPECT_NEAR(mean, expected.mean, kMeanBound) << name;
  for (std::size_t i = 0; i < kPixels.size(); ++i) {
    EXPECT_NEAR(map.at(kPixels[i].first, kPixels[i].second, 0), expected.pixels[i], kPixelBound) << name << ' ' << i;
  }
}

void expectFlip(const pairs::Pair& pair, double perDegree, const Figures& expected, const char* name) {
  const Result<FlipError> result = flip(pair.reference, pair.test, {perDegree});
  ASSERT_TRUE(result.ok()) << result.error().text();
  expectFigures(result->mean, result->map, expected, name);
}

TEST(Flip, matchesTheAuthorsImplementation) {
  constexpr double k67 = kFlipPixelsPerDegree;
  expectFlip(pairs::noisyRamps(), k67, {0.14465568, {0.055493, 0.306215, 0.089392, 0.049351, 0.088338}}, "ramps");
  expectFlip(pairs::noisyRamps(), 30.0, {0.27153889, {0.052583, 0.359879, 0.259012, 0.066828, 0.236547}}, "ramps, 30");
  expectFlip(pairs::noisyRamps(0.015625f), k67, {0.03219460, {0.009874, 0.068461, 0.018402, 0.011185, 0.014157}},
             "ramps with little noise");
  expectFlip(pairs::shiftedText(), k67, {0.23686114, {0.153914, 0.050218, 0.124667, 0.242005, 0.096041}}, "text");
  expectFlip(pairs::shiftedText(), 30.0, {0.32038807, {0.025492, 0.000000, 0.010878, 0.085056, 0.008098}}, "text, 30");
}

struct HdrFigures {
  FlipToneMapper toneMapper;
  FlipExposures automatic;
  Figures atAutomatic;
  Figures atFive;  ///< exposures -4, -2, 0, 2, 4
};

const HdrFigures kHdrFigures[] = {
    {FlipToneMapper::Aces,
     {-4.307848, 3.914852, 9},
     {0.13007150, {0.029136, 0.238090, 0.083412, 0.043912, 0.220240}},
     {0.12309278, {0.028878, 0.202285, 0.083910, 0.043385, 0.212925}}},
    {FlipToneMapper::Reinhard,
     {-2.888645, 5.334056, 9},
     {0.10008389, {0.022161, 0.181503, 0.064991, 0.033161, 0.161037}},
     {0.10036358, {0.022073, 0.180539, 0.063937, 0.032763, 0.158602}}},
    {FlipToneMapper::Hable,
     {-3.746020, 4.476680, 9},
     {0.10234979, {0.023865, 0.166509, 0.062095, 0.035916, 0.178767}},
     {0.10096251, {0.022880, 0.168323, 0.060484, 0.034275, 0.180252}}},
};

TEST(HdrFlip, matchesTheAuthorsImplementation) {
  const pairs::Pair meadow = pairs::meadow();
  for (const HdrFigures& figures : kHdrFigures) {
    HdrFlipOptions options;
    options.toneMapper = figures.toneMapper;
    const Result<HdrFlipError> automatic = hdrFlip(meadow.reference, meadow.test, options);
    ASSERT_TRUE(automatic.ok()) << automatic.error().text();
    // Hable's curve stands there with coefficients of 6 digits: 1e-5 of a stop.
    EXPECT_NEAR(automatic->exposures.start, figures.automatic.start, 1e-5);
    EXPECT_NEAR(automatic->exposures.stop, figures.automatic.stop, 1e-5);
    EXPECT_EQ(automatic->exposures.count, figures.automatic.count);
    expectFigures(automatic->mean, automatic->map, figures.atAutomatic, "automatic exposures");

    options.exposures = FlipExposures{-4.0, 4.0, 5};
    const Result<HdrFlipError> five = hdrFlip(meadow.reference, meadow.test, options);
    ASSERT_TRUE(five.ok()) << five.error().text();
    expectFigures(five->mean, five->map, figures.atFive, "five exposures");
  }
}

// Where nothing varies the filters change nothing and no feature differs: the error e is the colours' alone. In float
// the detectors' weights cancel to 5e-8; to the power q_f = 0.5 that makes f = 2.2e-4, and e^(1 - f) - e = f e ln(1 /
// e) is 8e-5 at most (e ln(1 / e) is 0.37 at most).
constexpr double kFlatBound = 8e-5;

TEST(Flip, ofFlatImagesIsTheColourErrorOfThePaper) {
  const auto distance = [](const glm::dvec3& first, const glm::dvec3& second) {
    const Lab a = labFromLinear(first);
    const Lab b = labFromLinear(second);
    const double chroma = std::hypot(0.01 * (a.l * a.a - b.l * b.a), 0.01 * (a.l * a.b - b.l * b.b));
    return std::pow(std::abs(a.l - b.l) + chroma, 0.7);
  };
  const double greatest = distance({0.0, 1.0, 0.0}, {0.0, 0.0, 1.0});
  const auto flat = [](const glm::dvec3& encoded) {
    Image image(40, 30, 3);
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
      image.pixels[i] = static_cast<float>(encoded[static_cast<int>(i % 3)]);
    }
    return image;
  };
  EXPECT_NEAR(flip(flat({0.0, 1.0, 0.0}), flat({0.0, 0.0, 1.0}))->mean, 1.0, kFlatBound);
  const double blackToWhite = distance({0.0, 0.0, 0.0}, {1.0, 1.0, 1.0});
  ASSERT_GT(blackToWhite, 0.4 * greatest);
  EXPECT_NEAR(flip(flat(glm::dvec3(0.0)), flat(glm::dvec3(1.0)))->mean,
              0.95 + (blackToWhite - 0.4 * greatest) / (0.6 * greatest) * 0.05, kFlatBound);
  const float grey = linearFromSrgb(0.5f);
  const float light = linearFromSrgb(0.6f);
  EXPECT_NEAR(flip(flat(glm::dvec3(0.5)), flat({0.6, 0.5, 0.5}))->mean,
              distance({grey, grey, grey}, {light, grey, grey}) * 0.95 / (0.4 * greatest), kFlatBound);
}

TEST(Flip, isZeroForEqualImagesSymmetricAndInTheUnitRange) {
  for (const pairs::Pair& pair : {pairs::noisyRamps(), pairs::noisyRamps(1.0f), pairs::shiftedText()}) {
    EXPECT_EQ(flip(pair.test, pair.test)->mean, 0.0);
    const Result<FlipError> forth = flip(pair.reference, pair.test);
    const Result<FlipError> back = flip(pair.test, pair.reference);
    EXPECT_EQ(forth->map.pixels, back->map.pixels);
    EXPECT_EQ(forth->mean, back->mean);
    EXPECT_GT(forth->mean, 0.0);
    const auto [least, greatest] = std::minmax_element(forth->map.pixels.begin(), forth->map.pixels.end());
    EXPECT_GE(*least, 0.0f);
    EXPECT_LE(*greatest, 1.0f);
  }
  EXPECT_EQ(hdrFlip(pairs::meadow().test, pairs::meadow().test)->mean, 0.0);
}

TEST(Flip, growsWithNoise) {
  double last = 0.0;
  for (const float amplitude : {0.01f, 0.03f, 0.1f, 0.3f, 1.0f}) {
    const pairs::Pair pair = pairs::noisyRamps(amplitude);
    const double mean = flip(pair.reference, pair.test)->mean;
    EXPECT_GT(mean, last) << amplitude;
    last = mean;
  }
}

TEST(Flip, closerEyesSeeMoreOfFineNoise) {
  const pairs::Pair pair = pairs::noisyRamps();
  EXPECT_GT(flip(pair.reference, pair.test, {30.0})->mean, flip(pair.reference, pair.test, {90.0})->mean);
  EXPECT_NEAR(pixelsPerDegree(0.7, 0.7, 3840.0), kFlipPixelsPerDegree, 1e-12);
}

// Work is done in ranges of rows: an image on its side has its ranges elsewhere.
TEST(Flip, turnsWithTheImage) {
  const int width = 90;
  const int height = 150;
  Image reference(width, height, 3), test(width, height, 3), referenceTurned(height, width, 3),
      testTurned(height, width, 3);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      for (int c = 0; c < 3; ++c) {
        reference.at(x, y, c) = referenceTurned.at(y, x, c) = pairs::latticeNoise(5, x, y, 7);
        test.at(x, y, c) = testTurned.at(y, x, c) = pairs::latticeNoise(6, x, y, 7);
      }
    }
  }
  const Result<FlipError> upright = flip(reference, test);
  const Result<FlipError> turned = flip(referenceTurned, testTurned);
  EXPECT_NEAR(upright->mean, turned->mean, 1e-6);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x)
      ASSERT_NEAR(upright->map.at(x, y, 0), turned->map.at(y, x, 0), 1e-3) << x << ' ' << y;
  }
}

TEST(Flip, anySizeAndGreyImages) {
  for (const auto& [width, height] : {std::pair{1, 1}, {3, 500}, {500, 3}, {2, 65}}) {
    EXPECT_EQ(flip(Image(width, height, 3, 0.3f), Image(width, height, 3, 0.3f))->mean, 0.0);
    const Result<FlipError> grey = flip(Image(width, height, 1, 0.0f), Image(width, height, 1, 1.0f));
    const Result<FlipError> rgb = flip(Image(width, height, 3, 0.0f), Image(width, height, 3, 1.0f));
    EXPECT_EQ(grey->mean, rgb->mean);
    EXPECT_GT(grey->mean, 0.95);
  }
}

TEST(Flip, sameBytesOnAnyNumberOfThreads) {
  const pairs::Pair pair = pairs::noisyRamps();
  JobContext one, two;
  one.threads = 1;
  two.threads = 2;
  EXPECT_EQ(flip(pair.reference, pair.test, {}, one)->map.pixels, flip(pair.reference, pair.test, {}, two)->map.pixels);
}

TEST(Flip, refusesPixelsPerDegreeOutOfRange) {
  const Image image(4, 4, 3);
  for (const double perDegree : {0.0, -1.0, 0.99, 1001.0, std::nan("")}) {
    EXPECT_FALSE(flip(image, image, {perDegree}).ok()) << perDegree;
  }
  for (const double perDegree : {1.0, 1000.0}) EXPECT_TRUE(flip(image, image, {perDegree}).ok()) << perDegree;
  const pairs::Pair pair = pairs::noisyRamps();
  for (const double perDegree : {1.0, 1000.0}) {
    const double mean = flip(pair.reference, pair.test, {perDegree})->mean;
    EXPECT_GT(mean, 0.0) << perDegree;
    EXPECT_LT(mean, 1.0) << perDegree;
  }
}

TEST(HdrFlip, exposuresFollowTheBrightness) {
  const pairs::Pair meadow = pairs::meadow();
  Image brighter = meadow.reference;
  Image brighterTest = meadow.test;
  for (float& value : brighter.pixels) value *= 4.0f;
  for (float& value : brighterTest.pixels) value *= 4.0f;
  const Result<FlipExposures> plain = flipExposures(meadow.reference);
  const Result<FlipExposures> darker = flipExposures(brighter);
  EXPECT_NEAR(darker->start, plain->start - 2.0, 1e-12);
  EXPECT_NEAR(darker->stop, plain->stop - 2.0, 1e-12);
  EXPECT_EQ(darker->count, plain->count);
  EXPECT_NEAR(hdrFlip(brighter, brighterTest)->mean, hdrFlip(meadow.reference, meadow.test)->mean, 1e-6);
}

TEST(HdrFlip, isTheGreatestOverItsExposuresAndSaysWhich) {
  const pairs::Pair meadow = pairs::meadow();
  HdrFlipOptions options;
  options.exposures = FlipExposures{-2.0, 2.0, 3};
  const Result<HdrFlipError> all = hdrFlip(meadow.reference, meadow.test, options);
  Image greatest(pairs::kWidth, pairs::kHeight, 1);
  Image exposure(pairs::kWidth, pairs::kHeight, 1, -2.0f);
  for (const double stops : {-2.0, 0.0, 2.0}) {
    options.exposures = FlipExposures{stops, stops, 1};
    const Result<HdrFlipError> one = hdrFlip(meadow.reference, meadow.test, options);
    for (std::size_t i = 0; i < greatest.pixels.size(); ++i) {
      if (one->map.pixels[i] <= greatest.pixels[i]) continue;
      greatest.pixels[i] = one->map.pixels[i];
      exposure.pixels[i] = static_cast<float>(stops);
    }
  }
  EXPECT_EQ(all->map.pixels, greatest.pixels);
  EXPECT_EQ(all->exposure.pixels, exposure.pixels);
}

TEST(HdrFlip, oneExposureIsFlipOfTheToneMappedImages) {
  const pairs::Pair meadow = pairs::meadow();
  const auto display = [](const Image& linear) {
    Image encoded = linear;
    for (float& value : encoded.pixels) {
      const float x = 0.6f * value;
      value = srgbFromLinear(std::min(1.0f, (2.51f * x * x + 0.03f * x) / (2.43f * x * x + 0.59f * x + 0.14f)));
    }
    return encoded;
  };
  HdrFlipOptions options;
  options.exposures = FlipExposures{0.0, 0.0, 1};
  EXPECT_NEAR(hdrFlip(meadow.reference, meadow.test, options)->mean,
              flip(display(meadow.reference), display(meadow.test))->mean, kMeanBound);
}

TEST(HdrFlip, refusesReferencesThatGiveNoExposures) {
  const Image black(8, 8, 3);
  const Image grey(8, 8, 3, 0.5f);
  const Result<HdrFlipError> none = hdrFlip(black, grey);
  ASSERT_FALSE(none.ok());
  EXPECT_NE(none.error().what.find("black"), std::string::npos);
  EXPECT_FALSE(none.error().remedy.empty());

  Image spot(8, 8, 3);
  spot.at(3, 3, 1) = 1.0f;
  EXPECT_FALSE(hdrFlip(spot, grey).ok());
  EXPECT_FALSE(flipExposures(Image(8, 8, 3, -1.0f)).ok());

  HdrFlipOptions stated;
  stated.exposures = FlipExposures{0.0, 2.0, 3};
  EXPECT_GT(hdrFlip(black, grey, stated)->mean, 0.0);

  Image wide(8, 8, 3, 1e-30f);  // 200 stops below its brightest pixel
  wide.at(0, 0, 0) = 1e30f;
  EXPECT_FALSE(flipExposures(wide).ok());
}

TEST(HdrFlip, refusesRangesOfExposuresThatAreNone) {
  const Image grey(4, 4, 3, 0.5f);
  const FlipExposures wrong[] = {{1.0, 0.0, 2},   {0.0, 1.0, 0},          {0.0, 1.0, 65},        {-300.0, 0.0, 2},
                                 {0.0, 300.0, 2}, {std::nan(""), 0.0, 2}, {0.0, std::nan(""), 2}};
  for (const FlipExposures& exposures : wrong) {
    HdrFlipOptions options;
    options.exposures = exposures;
    EXPECT_FALSE(hdrFlip(grey, grey, options).ok()) << exposures.start << ' ' << exposures.stop;
  }
}

TEST(HdrFlip, hugeAndNegativeValuesStayInRange) {
  Image reference(20, 20, 3, 1.0f);
  Image test(20, 20, 3, 1.0f);
  for (int i = 0; i < 20; ++i) {
    test.at(i, i, 0) = 3e38f;
    test.at(i, 19 - i, 1) = -3e38f;
  }
  for (const FlipToneMapper mapper : {FlipToneMapper::Aces, FlipToneMapper::Reinhard, FlipToneMapper::Hable}) {
    HdrFlipOptions options;
    options.toneMapper = mapper;
    options.exposures = FlipExposures{-256.0, 256.0, 3};
    const Result<HdrFlipError> result = hdrFlip(reference, test, options);
    ASSERT_TRUE(result.ok()) << result.error().text();
    for (const float value : result->map.pixels) ASSERT_TRUE(value >= 0.0f && value <= 1.0f) << value;
  }
}

}  // namespace
}  // namespace sward::image
