#include "image/metrics.h"

#include "image/ciede2000.h"
#include "image/error_colours.h"
#include "image/ssim.h"
#include "metric_images.h"

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <vector>

namespace sward::image {
namespace {

OIIO::ImageBuf wrapped(Image& image) {
  return OIIO::ImageBuf(OIIO::ImageSpec(image.width, image.height, image.channels, OIIO::TypeDesc::FLOAT),
                        image.pixels.data());
}

// OpenImageIO sums in another order: a few roundings of doubles (18 432 terms) apart.
TEST(ValueErrors, matchOpenImageIo) {
  for (pairs::Pair pair : {pairs::noisyRamps(), pairs::shiftedText()}) {
    const OIIO::ImageBufAlgo::CompareResults expected =
        OIIO::ImageBufAlgo::compare(wrapped(pair.reference), wrapped(pair.test), 1.0f, 1.0f);
    const Result<ValueErrors> errors = valueErrors(pair.reference, pair.test);
    ASSERT_TRUE(errors.ok()) << errors.error().text();
    EXPECT_NEAR(errors->rmse, expected.rms_error, 1e-7);
    EXPECT_NEAR(errors->max, expected.maxerror, 1e-7);
    EXPECT_NEAR(*errors->psnrDb, expected.PSNR, 1e-5);
  }
}

// numpy and scikit-image 0.19.3 (peak_signal_noise_ratio) in double precision.
TEST(ValueErrors, matchNumpy) {
  const pairs::Pair pair = pairs::noisyRamps();
  const Result<ValueErrors> errors = valueErrors(pair.reference, pair.test);
  EXPECT_NEAR(errors->rmse, 0.0709589458, 1e-10);
  EXPECT_NEAR(errors->bias, -0.0001385064, 1e-10);
  EXPECT_NEAR(errors->max, 0.1254902184, 1e-10);
  EXPECT_NEAR(*errors->psnrDb, 22.97985691, 1e-8);
}

TEST(ValueErrors, closedForms) {
  Image reference(4, 2, 2, 1.0f);
  Image test(4, 2, 2, 1.5f);
  test.at(3, 1, 1) = -1.0f;
  const Result<ValueErrors> errors = valueErrors(reference, test, 2.0);
  EXPECT_DOUBLE_EQ(errors->rmse, std::sqrt((15 * 0.25 + 4.0) / 16.0));
  EXPECT_DOUBLE_EQ(errors->bias, (15 * 0.5 - 2.0) / 16.0);
  EXPECT_DOUBLE_EQ(errors->max, 2.0);
  EXPECT_DOUBLE_EQ(*errors->psnrDb, 20.0 * std::log10(2.0 / errors->rmse));

  const Result<ValueErrors> back = valueErrors(test, reference, 2.0);
  EXPECT_EQ(back->rmse, errors->rmse);
  EXPECT_EQ(back->bias, -errors->bias);
}

TEST(ValueErrors, ofEqualImagesAreZeroAndTheirPsnrHasNoNumber) {
  const Image image = pairs::meadow().reference;
  const Result<ValueErrors> errors = valueErrors(image, image);
  EXPECT_EQ(errors->rmse, 0.0);
  EXPECT_EQ(errors->bias, 0.0);
  EXPECT_EQ(errors->max, 0.0);
  EXPECT_FALSE(errors->psnrDb.has_value());
}

TEST(ValueErrors, hugeValuesDoNotOverflow) {
  const Result<ValueErrors> errors = valueErrors(Image(2, 2, 1, -3e38f), Image(2, 2, 1, 3e38f));
  EXPECT_NEAR(errors->rmse / 6e38, 1.0, 1e-6);
}

TEST(ValueErrors, refuseAPeakThatIsNone) {
  const Image image(2, 2, 1);
  for (const double peak : {0.0, -1.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
    EXPECT_FALSE(valueErrors(image, image, peak).ok()) << peak;
  }
}

/// Every metric of two images, with nothing but its success.
using Metric = std::function<Result<void>(const Image&, const Image&, const JobContext&)>;

template <typename T>
Result<void> outcome(const Result<T>& result) {
  if (result.ok()) return {};
  return result.error();
}

std::vector<Metric> metrics() {
  return {[](const Image& a, const Image& b, const JobContext& job) { return outcome(valueErrors(a, b, 1.0, job)); },
          [](const Image& a, const Image& b, const JobContext& job) { return outcome(ssim(a, b, job)); },
          [](const Image& a, const Image& b, const JobContext& job) { return outcome(flip(a, b, {}, job)); },
          [](const Image& a, const Image& b, const JobContext& job) { return outcome(hdrFlip(a, b, {}, job)); },
          [](const Image& a, const Image& b, const JobContext& job) { return outcome(colourDifference(a, b, job)); },
          [](const Image& a, const Image& b, const JobContext& job) {
            return outcome(compareImages({a, b}, {a, b}, {}, job));
          },
          [](const Image& a, const Image& b, const JobContext& job) {
            return outcome(compareDisplayImages({a, b}, {}, job));
          }};
}

TEST(AllMetrics, refuseWhatCannotBeCompared) {
  const Image good(5, 4, 3, 0.5f);
  Image halfFilled = good;
  halfFilled.pixels.resize(30);
  Image nan = good;
  nan.at(2, 3, 1) = std::nanf("");
  Image infinite = good;
  infinite.at(4, 0, 2) = -std::numeric_limits<float>::infinity();
  const Image bad[] = {Image(),
                       Image(0, 0, 3),
                       Image(5, 0, 3),
                       Image(4, 5, 3, 0.5f),
                       Image(5, 4, 1, 0.5f),
                       Image(5, 3, 3, 1.0f),
                       halfFilled,
                       nan,
                       infinite};
  for (const Metric& metric : metrics()) {
    EXPECT_TRUE(metric(good, good, {}).ok());
    for (const Image& image : bad) {
      for (const bool asTest : {false, true}) {
        const Result<void> result = asTest ? metric(good, image, {}) : metric(image, good, {});
        ASSERT_FALSE(result.ok());
        EXPECT_EQ(result.error().kind, ErrorKind::BadInput);
        EXPECT_FALSE(result.error().what.empty());
        EXPECT_FALSE(result.error().where.empty());
        EXPECT_FALSE(result.error().remedy.empty());
      }
    }
    EXPECT_FALSE(metric(Image(), Image(), {}).ok());
  }
}

TEST(AllMetrics, nameTheFirstPixelThatIsNotFinite) {
  const Image good(5, 4, 3, 0.5f);
  Image nan = good;
  nan.at(2, 3, 1) = std::nanf("");
  nan.at(4, 3, 1) = std::nanf("");
  EXPECT_EQ(flip(good, nan).error().where, "test image, pixel (2, 3), channel 1");
}

TEST(AllMetrics, stopWhenCancelled) {
  std::stop_source source;
  source.request_stop();
  JobContext job;
  job.stop = source.get_token();
  const Image image(64, 64, 3, 0.5f);
  for (const Metric& metric : metrics()) {
    const Result<void> result = metric(image, image, job);
    ASSERT_FALSE(result.ok());
    EXPECT_EQ(result.error().kind, ErrorKind::Cancelled);
  }
}

TEST(AllMetrics, sameBitsOnAnyNumberOfThreads) {
  const pairs::Pair pair = pairs::noisyRamps();
  const auto figures = [&](int threads) {
    JobContext job;
    job.threads = threads;
    return *compareDisplayImages({pair.reference, pair.test}, {}, job);
  };
  const ErrorFigures one = figures(1);
  for (const int threads : {2, 3}) {
    const ErrorFigures more = figures(threads);
    EXPECT_EQ(one.rmse, more.rmse);
    EXPECT_EQ(one.psnrDb, more.psnrDb);
    EXPECT_EQ(one.ssim, more.ssim);
    EXPECT_EQ(one.flip, more.flip);
    EXPECT_EQ(one.bias, more.bias);
  }
}

TEST(CompareImages, takesLinearErrorsFromLinearImagesAndTheOthersFromTheDisplay) {
  const pairs::Pair linear = pairs::meadow();
  const pairs::Pair display = pairs::noisyRamps();
  CompareOptions options;
  options.hdrFlip = HdrFlipOptions{};
  const Result<ErrorFigures> figures =
      compareImages({linear.reference, linear.test}, {display.reference, display.test}, options);
  ASSERT_TRUE(figures.ok()) << figures.error().text();
  const Result<ValueErrors> ofLinear = valueErrors(linear.reference, linear.test);
  EXPECT_EQ(figures->rmse, ofLinear->rmse);
  EXPECT_EQ(figures->bias, ofLinear->bias);
  EXPECT_EQ(figures->max, ofLinear->max);
  EXPECT_EQ(figures->psnrDb, valueErrors(display.reference, display.test)->psnrDb);
  EXPECT_EQ(figures->ssim, ssim(display.reference, display.test)->mean);
  EXPECT_EQ(figures->flip, flip(display.reference, display.test)->mean);
  EXPECT_EQ(figures->hdrFlip, hdrFlip(linear.reference, linear.test)->mean);
}

TEST(CompareImages, displayAloneIsClampedAndEqualImagesAreEqual) {
  const Image white(16, 12, 3, 1.0f);
  const Result<ErrorFigures> figures = compareDisplayImages({white, Image(16, 12, 3, 1.5f)});
  ASSERT_TRUE(figures.ok()) << figures.error().text();
  EXPECT_EQ(figures->rmse, 0.0);
  EXPECT_FALSE(figures->psnrDb.has_value());
  EXPECT_EQ(figures->ssim, 1.0);
  EXPECT_EQ(figures->flip, 0.0);
  EXPECT_EQ(figures->max, 0.0);
  EXPECT_FALSE(figures->hdrFlip.has_value());
}

TEST(CompareImages, refusesSizesThatDifferAndHdrFlipWithoutLinearImages) {
  const Image large(8, 8, 3, 0.5f);
  const Image small(4, 4, 3, 0.5f);
  EXPECT_FALSE(compareImages({large, large}, {small, small}).ok());
  CompareOptions options;
  options.hdrFlip = HdrFlipOptions{};
  EXPECT_FALSE(compareDisplayImages({large, large}, options).ok());
  EXPECT_FALSE(compareImages({Image(8, 8, 3), large}, {large, large}, options).ok());  // a black reference
}

// Colours of matplotlib's magma between the ones kept.
TEST(ErrorColours, areMagma) {
  const auto near = [](const glm::vec3& a, const glm::vec3& b) {
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(a[c], b[c], 0.011f);
  };
  near(errorColour(0.0f), {0.001462f, 0.000466f, 0.013866f});
  near(errorColour(137.0f / 255.0f), {0.773695f, 0.236249f, 0.455289f});
  near(errorColour(66.0f / 255.0f), {0.329114f, 0.075972f, 0.489287f});
  near(errorColour(1.0f), {0.987053f, 0.991438f, 0.749504f});
  EXPECT_EQ(errorColour(std::nanf("")), errorColour(0.0f));
  EXPECT_EQ(errorColour(7.0f), errorColour(1.0f));
  EXPECT_EQ(errorColour(-7.0f), errorColour(0.0f));
}

TEST(ErrorColours, growLighter) {
  const auto lightness = [](float error) { return labFromSrgb(glm::dvec3(errorColour(error))).l; };
  for (int i = 1; i <= 255; ++i) {
    EXPECT_GT(lightness(static_cast<float>(i) / 255.0f), lightness(static_cast<float>(i - 1) / 255.0f)) << i;
  }
}

TEST(ErrorColours, pictureOfAMap) {
  Image map(2, 1, 1);
  map.at(1, 0, 0) = 1.0f;
  const Result<Image> picture = colourErrors(map);
  ASSERT_TRUE(picture.ok());
  EXPECT_EQ(picture->channels, 3);
  EXPECT_EQ(picture->rgb(0, 0), errorColour(0.0f));
  EXPECT_EQ(picture->rgb(1, 0), errorColour(1.0f));
  EXPECT_FALSE(colourErrors(Image()).ok());
  EXPECT_FALSE(colourErrors(Image(2, 2, 3)).ok());
}

}  // namespace
}  // namespace sward::image
