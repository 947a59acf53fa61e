#include "image/ssim.h"

#include "metric_images.h"

#include <gtest/gtest.h>

#include <cmath>
#include <tuple>

namespace sward::image {
namespace {

constexpr double kC1 = 1e-4;
constexpr double kC2 = 9e-4;

double meanSsim(const pairs::Pair& pair) {
  const Result<Ssim> result = ssim(pair.reference, pair.test);
  EXPECT_TRUE(result.ok()) << result.error().text();
  return result.ok() ? result->mean : -2.0;
}

// Figures of scikit-image 0.19.3 in double precision, structural_similarity(gaussian_weights=True, sigma=1.5,
// use_sample_covariance=False, data_range=1) on the same luma of the same images. The map is kept in float.
TEST(Ssim, matchesScikitImage) {
  const Result<Ssim> ramps = ssim(pairs::noisyRamps().reference, pairs::noisyRamps().test);
  EXPECT_NEAR(ramps->mean, 0.3388743083, 1e-9);
  const std::tuple<int, int, double> pixels[] = {
      {0, 0, 0.56873725}, {95, 63, 0.63471793}, {48, 32, 0.29911988}, {17, 5, 0.32136747}, {70, 22, 0.28800145}};
  for (const auto& [x, y, expected] : pixels) EXPECT_NEAR(ramps->map.at(x, y, 0), expected, 1e-7) << x << ' ' << y;
  EXPECT_NEAR(meanSsim(pairs::shiftedText()), 0.4598966346, 1e-9);
}

// Wang et al. 2004, equation 13 with sigma_x = sigma_y = 0.
TEST(Ssim, ofFlatImagesIsTheLuminanceTerm) {
  for (const auto& [a, b] : {std::pair{0.0, 1.0}, {0.25, 0.5}, {0.75, 0.75}}) {
    const Result<Ssim> result = ssim(Image(20, 17, 3, static_cast<float>(a)), Image(20, 17, 3, static_cast<float>(b)));
    EXPECT_NEAR(result->mean, (2.0 * a * b + kC1) / (a * a + b * b + kC1), 1e-12);
  }
}

// The one window that fits into 11 x 11 pixels, its moments summed as the paper writes them; y = k x.
TEST(Ssim, ofScaledContrastIsTheClosedForm) {
  const int size = 11;
  Image reference(size, size, 1);
  Image test(size, size, 1);
  const double contrast = 0.5;
  double weights = 0.0, mean = 0.0, square = 0.0;
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      const double value = (x + y) % 2 == 0 ? 0.25 : 0.75;
      reference.at(x, y, 0) = static_cast<float>(value);
      test.at(x, y, 0) = static_cast<float>(contrast * value);
      const double weight = std::exp(-((x - 5) * (x - 5) + (y - 5) * (y - 5)) / (2.0 * 1.5 * 1.5));
      weights += weight;
      mean += weight * value;
      square += weight * value * value;
    }
  }
  mean /= weights;
  const double variance = square / weights - mean * mean;
  const double k = contrast;
  const double expected = (2.0 * k * mean * mean + kC1) * (2.0 * k * variance + kC2) /
                          (((1.0 + k * k) * mean * mean + kC1) * ((1.0 + k * k) * variance + kC2));
  EXPECT_NEAR(ssim(reference, test)->mean, expected, 1e-12);
}

TEST(Ssim, isSymmetricAndOneForEqualImages) {
  for (const pairs::Pair& pair : {pairs::noisyRamps(), pairs::shiftedText(), pairs::meadow()}) {
    EXPECT_EQ(ssim(pair.reference, pair.test)->mean, ssim(pair.test, pair.reference)->mean);
    EXPECT_EQ(ssim(pair.reference, pair.reference)->mean, 1.0);
  }
}

TEST(Ssim, fallsWithNoise) {
  double last = 1.0;
  for (const float amplitude : {0.01f, 0.03f, 0.1f, 0.3f}) {
    const double value = meanSsim(pairs::noisyRamps(amplitude));
    EXPECT_LT(value, last) << amplitude;
    last = value;
  }
}

TEST(Ssim, anySizeHasAMean) {
  for (const auto& [width, height] : {std::pair{1, 1}, {3, 500}, {500, 3}, {11, 11}, {10, 12}, {2, 67}}) {
    const Result<Ssim> same = ssim(Image(width, height, 3, 0.3f), Image(width, height, 3, 0.3f));
    EXPECT_EQ(same->mean, 1.0) << width << " x " << height;
    const Result<Ssim> other = ssim(Image(width, height, 3, 0.25f), Image(width, height, 3, 0.5f));
    EXPECT_NEAR(other->mean, (0.25 + kC1) / (0.3125 + kC1), 1e-12) << width << " x " << height;
    EXPECT_EQ(other->map.width, width);
    EXPECT_EQ(other->map.height, height);
  }
}

TEST(Ssim, clampsAsADisplayDoes) {
  EXPECT_EQ(ssim(Image(12, 12, 1, 1.0f), Image(12, 12, 1, 7.0f))->mean, 1.0);
  EXPECT_EQ(ssim(Image(12, 12, 1, 0.0f), Image(12, 12, 1, -7.0f))->mean, 1.0);
}

}  // namespace
}  // namespace sward::image
