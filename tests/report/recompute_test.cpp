// Whether tests/report/recompute.py finds the figures that are right, and those that are not: on pictures of one
// colour, whose errors have closed forms.

#include "report/recompute.h"

#include "bake/temporary_folder.h"
#include "image/colour.h"
#include "report/csv.h"
#include "report/example.h"
#include "report/writer.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace sward::report {
namespace {

using testing::HasSubstr;

// Both are half floats.
constexpr double kTest = 0.5, kReference = 0.25;

double encoded(double linear) {
  return static_cast<double>(image::srgbFromLinear(static_cast<float>(linear)));
}

/// Equation 13 of Wang et al. 2004 without variances.
double ssimOfConstants(double a, double b) {
  constexpr double kC1 = 0.01 * 0.01;
  return (2.0 * a * b + kC1) / (a * a + b * b + kC1);
}

/// Andersson et al. 2020 for greys: no chroma, no features; the greatest difference is that of green and blue.
double flipOfGreys(double a, double b) {
  constexpr double kGreatest = 41.276570;  // |L* 87.7355 - 32.3009| + hypot(a, b) of 0.01 L* (a*, b*), to the power 0.7
  const auto lightness = [](double y) { return 116.0 * std::cbrt(y) - 16.0; };
  const double distance = std::pow(std::abs(lightness(a) - lightness(b)), 0.7);
  const double knee = 0.4 * kGreatest;
  return distance < knee ? 0.95 * distance / knee : 0.95 + 0.05 * (distance - knee) / (kGreatest - knee);
}

Picture flat(const std::string& name, double linear) {
  return {name, name, image::Image(32, 24, 3, static_cast<float>(linear)),
          image::Image(32, 24, 3, static_cast<float>(encoded(linear)))};
}

std::vector<Section> flatSections() {
  Section section;
  section.name = "grassland";
  section.strips = {{"flat", {flat("flat_test", kTest), flat("flat_reference", kReference)}}};
  Row row;
  row.method = "march";
  row.numbersAndNames = {
      {"picture", "\"flat_test\""}, {"reference_picture", "\"flat_reference\""}, {"display", "\"standard\""}};
  row.timeMs = TimeMs{2.0, 1.0, 3.0, 3};
  const double difference = kTest - kReference;
  row.error = {{"rmse", difference},
               {"bias", difference},
               {"max", difference},
               {"psnr_db", -20.0 * std::log10(encoded(kTest) - encoded(kReference))},
               {"ssim", ssimOfConstants(encoded(kTest), encoded(kReference))},
               {"flip", flipOfGreys(kTest, kReference)}};
  section.rows = {row};
  return {section};
}

class Recompute : public testing::Test {
 protected:
  Recompute() : m_folder("recompute") {}
  std::pair<int, std::string> of(const std::vector<Section>& sections) const {
    auto staged = StagedReport::stage(m_folder.path(), test::exampleHead(), sections);
    EXPECT_TRUE(staged.ok());
    EXPECT_TRUE(staged->commit().ok());
    return test::recompute(m_folder.path());
  }
  std::filesystem::path folder() const { return m_folder.path(); }

 private:
  sward::test::TemporaryFolder m_folder;
};

TEST_F(Recompute, AgreesWithClosedForms) {
  const auto [code, said] = of(flatSections());
  EXPECT_EQ(code, 0) << said;
  EXPECT_THAT(said, HasSubstr(" 0 do not agree"));
}

TEST_F(Recompute, FindsEveryFigureThatIsOff) {
  auto sections = flatSections();
  // Per cent by which a figure is off: more than half floats explain (0.05 %, through the display's curves).
  sections[0].rows[0].error["rmse"] *= 1.002;
  sections[0].rows[0].error["bias"] *= 0.998;
  sections[0].rows[0].error["max"] *= 1.004;
  sections[0].rows[0].error["psnr_db"] += 0.05;
  sections[0].rows[0].error["ssim"] -= 0.001;
  sections[0].rows[0].error["flip"] *= 1.03;  // noise in a flat picture makes features where there are none
  sections[0].rows[0].timeMs->median = 4.0;
  const auto [code, said] = of(sections);
  EXPECT_EQ(code, 1);
  for (const char* name : {"rmse is", "bias is", "max is", "psnr_db is", "ssim is", "flip is", "times are not"}) {
    EXPECT_THAT(said, HasSubstr(std::string("grassland[0] march: ") + name));
  }
  EXPECT_THAT(said, HasSubstr(" 7 do not agree"));
}

/// Two methods under two lights, at places "on" and "between"; the values of light 1 are kept.
std::vector<Section> lightSections() {
  const std::vector<float> weight{0.5f, 1.0f, 0.0f}, truth{0.25f, 0.5f, 0.0f};
  Section section;
  section.name = "lpt_fit";
  section.arrays = {{"lpt_fit_weight", {3}, weight}, {"lpt_fit_truth_1", {3}, truth}};
  Table lights{"lpt_fit_lights", {"method", "place", "light", "weight", "squares", "sum", "max"}, {}};
  for (const char* method : {"ptm", "lpt8"}) {
    const double off = method[0] == 'p' ? 0.125 : 0.25;
    // Errors: off, -off, and one without weight.
    section.arrays.push_back({std::string("lpt_fit_") + method + "_1",
                              {3},
                              {0.25f + static_cast<float>(off), 0.5f - static_cast<float>(off), 9.0f}});
    for (const char* place : {"on", "between"}) {
      for (const char* light : {"0", "1"}) {
        lights.rows.push_back(
            {method, place, light, "1.5", csvNumber(1.5 * off * off), csvNumber(-0.5 * off), csvNumber(off)});
      }
    }
    for (const char* place : {"all", "on", "between"}) {
      Row row;
      row.method = method;
      row.numbersAndNames = {{"place", "\"" + std::string(place) + "\""},
                             {"rmse_over_ptm", method[0] == 'p' ? "1.0" : "2.0"}};
      row.error = {{"rmse", off}, {"bias", -off / 3.0}, {"max", off}, {"psnr_db", -20.0 * std::log10(off)}};
      section.rows.push_back(row);
    }
  }
  section.tables = {lights};
  return {section};
}

TEST_F(Recompute, SumsOverLightsGiveTheirRows) {
  const auto [code, said] = of(lightSections());
  EXPECT_EQ(code, 0) << said;
  auto sections = lightSections();
  sections[0].tables[0].rows[0][4] = "0.0235";  // of ptm, on, light 0: its rows "all" and "on"
  sections[0].rows[5].error["rmse"] = 0.2501;   // and so its PSNR, and its ratio
  sections[0].arrays[1].values[1] = 0.51f;      // the truth of light 1: squares, sum and max of both methods
  const std::string wrong = of(sections).second;
  for (const char* place :
       {"lpt_fit[0] ptm: rmse is", "lpt_fit[1] ptm: rmse is", "lpt_fit[5] lpt8: rmse is", "lpt_fit[5] lpt8: psnr_db is",
        "lpt_fit[5] lpt8: rmse_over_ptm is", "lpt_fit_ptm_1.npy: squares is", "lpt_fit_ptm_1.npy: sum is",
        "lpt_fit_lpt8_1.npy: squares is", "lpt_fit_lpt8_1.npy: max is"}) {
    EXPECT_THAT(wrong, HasSubstr(place));
  }
}

TEST_F(Recompute, FindsFilesThatAreMissing) {
  auto staged = StagedReport::stage(folder(), test::exampleHead(), flatSections());
  ASSERT_TRUE(staged.ok() && staged->commit().ok());
  std::filesystem::remove(folder() / "pictures" / "flat_reference.exr");
  EXPECT_THAT(test::recompute(folder()).second, HasSubstr("flat_reference.exr is missing"));
  std::filesystem::remove(folder() / "report.json");
  EXPECT_EQ(test::recompute(folder()).first, 2);
}

}  // namespace
}  // namespace sward::report
