#include "report/section_grassland.h"

#include "bake/small_project.h"
#include "bake/temporary_folder.h"
#include "base/random.h"
#include "image/metrics.h"
#include "report/ground_truth.h"

#include <cmath>
#include <map>
#include <set>

#include <gtest/gtest.h>

namespace sward::report {
namespace {

image::Image noisy(const image::Image& clean, double deviation, std::uint64_t seed) {
  image::Image out = clean;
  base::Random random(seed);
  for (float& value : out.pixels) value += static_cast<float>(deviation * random.normal());
  return out;
}

TEST(RmseWithoutNoise, SeesTheDifferenceThroughNoiseSixTimesAsLarge) {
  image::Image reference(200, 150, 3, 0.5f), test = reference;
  for (std::size_t i = 0; i < test.pixels.size(); ++i) test.pixels[i] += i % 2 == 0 ? 0.05f : -0.03f;
  const double expected = std::sqrt((0.05 * 0.05 + 0.03 * 0.03) / 2.0);
  constexpr double kNoise = 0.25;
  const image::Image a = noisy(reference, kNoise, 1), b = noisy(reference, kNoise, 2);
  const double found = rmseWithoutNoise({a, test}, {b, test});
  // The mean of n products: deviation sqrt(noise^4 + 2 noise^2 d^2) / sqrt(n); half of that over d as RMSE.
  const auto n = static_cast<double>(test.pixels.size());
  const double deviation =
      std::sqrt(std::pow(kNoise, 4) + 2.0 * kNoise * kNoise * expected * expected) / std::sqrt(n) / (2.0 * expected);
  EXPECT_NEAR(found, expected, 4.0 * deviation);
  EXPECT_LT(4.0 * deviation, 0.5 * expected);
  EXPECT_NEAR(biasOf({a, test}, {b, test}), 0.01, 4.0 * kNoise / std::sqrt(2.0 * n));
  EXPECT_EQ(rmseWithoutNoise({reference, reference}, {reference, reference}), 0.0);
}

TEST(Grassland, RowsAreWhatThePicturesShow) {
  const test::TemporaryFolder folder("grassland");
  const auto context = gpu::Context::create(gpu::Device::Egl);
  ASSERT_TRUE(context.ok()) << context.error().text();
  project::Project project = bake::test::smallProject();
  project.fit.clampQuantile = 0.01;
  const SectionInput input{project, **context, folder.path(), true};
  const GrasslandSizes sizes{64, 36, 8, 2, 1};
  const auto measured = measureGrassland(input, sizes, {});
  ASSERT_TRUE(measured.ok()) << measured.error().text();
  const Section& section = *measured;

  std::map<std::string, const Picture*> pictures;
  for (const Strip& strip : section.strips) {
    for (const Picture& picture : strip.pictures) {
      EXPECT_TRUE(pictures.emplace(picture.name, &picture).second) << picture.name;
      EXPECT_EQ(picture.display.width, 64);
      EXPECT_EQ(picture.display.height, 36);
    }
  }
  std::map<std::string, int> rows;
  for (const Row& row : section.rows) {
    ++rows[row.method];
    for (const auto& [name, value] : row.error) EXPECT_TRUE(std::isfinite(value)) << row.method << ' ' << name;
    EXPECT_FALSE(row.reference.empty()) << row.method;
    EXPECT_TRUE(row.numbersAndNames.contains("view"));
    if (!row.timeMs) continue;
    const auto named = [&](const char* parameter) {
      const std::string text = row.numbersAndNames.at(parameter);
      return pictures.at(text.substr(1, text.size() - 2));
    };
    const auto errors = image::valueErrors(named("reference_picture")->linear, named("picture")->linear);
    ASSERT_TRUE(errors.ok());
    EXPECT_DOUBLE_EQ(row.error.at("rmse"), errors->rmse);
    EXPECT_GT(errors->rmse, 0.0);
  }
  const std::set<std::string> methods{
      "march",        "blended",        "blended_paper", "cause_range_clamp", "cause_quantisation", "cause_fit",
      "cause_layers", "cause_blending", "cause_tiling",  "cause_sky",         "cause_sun_disc",     "cause_bounces"};
  for (const std::string& method : methods) EXPECT_EQ(rows[method], 3) << method;
  EXPECT_EQ(rows.size(), methods.size());
}

TEST(Grassland, ACancelledJobSaysSo) {
  const test::TemporaryFolder folder("grassland");
  const auto context = gpu::Context::create(gpu::Device::Egl);
  ASSERT_TRUE(context.ok());
  const project::Project project = bake::test::smallProject();
  std::stop_source stop;
  JobContext job;
  job.stop = stop.get_token();
  job.onProgress = [&](const std::string& stage, double) {
    if (stage == "view 45") stop.request_stop();
  };
  const auto measured = measureGrassland({project, **context, folder.path(), true}, {64, 36, 4, 2, 1}, job);
  ASSERT_FALSE(measured.ok());
  EXPECT_EQ(measured.error().kind, ErrorKind::Cancelled);
}

}  // namespace
}  // namespace sward::report
