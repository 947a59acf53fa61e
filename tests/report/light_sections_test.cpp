#include "report/light_errors.h"
#include "report/light_rows.h"
#include "report/section_fit.h"
#include "report/section_quantisation.h"
#include "report/section_relight.h"

#include "bake/small_project.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>

#include <gtest/gtest.h>

namespace sward::report {
namespace {

/// The light sections draw nothing.
struct NoContext final : gpu::Context {
  bool bind() override { return false; }
  void unbind() override {}
};

/// A small patch, sampled and measured once for all tests.
class LightSections : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    s_project = new project::Project(bake::test::smallProject());
    s_source = new LightSampleSource;
    s_samples = new std::shared_ptr<const LightSamples>(get());
    auto made = lptFitSection(input(), *s_source, {});
    ASSERT_TRUE(made.ok()) << made.error().text();
    s_fit = new Section(std::move(made).value());
  }
  static void TearDownTestSuite() {
    delete s_fit;
    delete s_samples;
    delete s_source;
    delete s_project;
  }

  static SectionInput input() {
    static NoContext context;
    return {*s_project, context, {}, true};
  }
  static std::shared_ptr<const LightSamples> get() {
    auto result = s_source->get(input(), {});
    if (!result) throw std::runtime_error(result.error().text());
    return *result;
  }
  static const LightSamples& samples() { return **s_samples; }
  static const Row& row(const Section& section, const std::string& method) {
    return *std::find_if(section.rows.begin(), section.rows.end(), [&](const Row& r) { return r.method == method; });
  }

  static project::Project* s_project;
  static LightSampleSource* s_source;
  static std::shared_ptr<const LightSamples>* s_samples;
  static Section* s_fit;
};
project::Project* LightSections::s_project = nullptr;
LightSampleSource* LightSections::s_source = nullptr;
std::shared_ptr<const LightSamples>* LightSections::s_samples = nullptr;
Section* LightSections::s_fit = nullptr;

TEST(ErrorSum, IsWeighted) {
  ErrorSum sum;
  sum.add(1.0, 0.5);
  sum.add(3.0, -0.1);
  sum.add(0.0, 7.0);  // nothing to compare with
  EXPECT_EQ(sum.count, 2u);
  EXPECT_DOUBLE_EQ(sum.mse(), (0.25 + 3.0 * 0.01) / 4.0);
  EXPECT_DOUBLE_EQ(sum.bias(), (0.5 - 0.3) / 4.0);
  EXPECT_DOUBLE_EQ(sum.max, 0.5);
  EXPECT_DOUBLE_EQ(sum.psnrDb(), -20.0 * std::log10(sum.rmse()));
  ErrorSum both = sum;
  both.add(sum);
  EXPECT_DOUBLE_EQ(both.rmse(), sum.rmse());
}

TEST_F(LightSections, HeldOutLightsAreNoTrainingLights) {
  ASSERT_EQ(samples().heldOut.size(), 32u);
  std::set<Elevation> seen;
  for (const glm::dvec3& light : samples().heldOut) {
    EXPECT_NEAR(glm::length(light), 1.0, 1e-12);
    EXPECT_GT(light.z, 0.0);
    seen.insert(elevationOf(light));
    for (const glm::dvec3& other : samples().training) {
      EXPECT_GE(std::acos(std::min(glm::dot(light, other), 1.0)) * 180.0 / M_PI, samples().nearestDeg - 1e-6);
    }
  }
  EXPECT_EQ(seen.size(), 3u);
  EXPECT_GT(samples().nearestDeg, 1.0);
}

TEST_F(LightSections, SamplesAreMadeOnce) {
  EXPECT_EQ(get(), *s_samples);
  SectionInput other = input();
  project::Project changed = *s_project;
  changed.patch.seed += 1;
  auto again = s_source->get(SectionInput{changed, other.context, {}, true}, {});
  ASSERT_TRUE(again.ok());
  EXPECT_NE(*again, *s_samples);
  s_source->get(input(), {}).ok();  // the first project's again, for the tests that follow
}

TEST_F(LightSections, LeavingALightOutLeavesItsSamplesOut) {
  const lpt::RepresentationInput in = samples().input(1);
  const std::size_t lights = samples().training.size();
  ASSERT_EQ(in.fit.lights.size(), lights - 1);
  ASSERT_EQ(in.fit.samples.size(), 2 * (lights - 1));
  EXPECT_EQ(in.fit.lights[1], samples().training[2]);
  EXPECT_EQ(in.fit.samples[1].data(), samples().train.response[2].reflected.data());
  EXPECT_EQ(in.fit.samples[lights - 1 + 1].data(), samples().train.response[2].transmitted.data());
}

/// What is not fitted to lights is not the better for one of them.
bool readsNoLight(const lpt::Method& method, const std::string& key) {
  return method.basis == lpt::Basis::Marched && key == "rmse_leave_one_out";
}

TEST_F(LightSections, ThereIsARowForEveryMethodThatCanBeFitted) {
  std::vector<std::string> names;
  for (const Row& r : s_fit->rows) names.push_back(r.method);
  std::vector<std::string> expected;
  for (const lpt::Method& method : fittedMethods(samples())) expected.emplace_back(method.name);
  expected.emplace_back("samples");
  EXPECT_EQ(names, expected);
  for (const lpt::Method& method : fittedMethods(samples())) {
    const Row& r = row(*s_fit, std::string(method.name));
    for (const char* key : {"rmse", "psnr_db", "bias", "max", "rmse_low", "rmse_middle", "rmse_high", "rmse_between",
                            "rmse_between_filled", "rmse_leave_one_out", "rmse_seen"}) {
      if (readsNoLight(method, key)) continue;
      ASSERT_TRUE(r.error.contains(key)) << method.name << ' ' << key;
      EXPECT_TRUE(std::isfinite(r.error.at(key)));
    }
    EXPECT_GT(*r.bytes, 0u);
    EXPECT_EQ(*r.bytesTotal - *r.bytes, surfaceBytes(samples()));
  }
  // What one number a texel cannot follow, six can.
  EXPECT_LT(row(*s_fit, "ptm").error.at("rmse"), row(*s_fit, "constant").error.at("rmse"));
  // And what is known of a texel anyway tells more of it than its depth.
  EXPECT_LT(row(*s_fit, "lpt8").error.at("rmse"), row(*s_fit, "lpt_depth").error.at("rmse"));
  EXPECT_LT(row(*s_fit, "lpt8").error.at("rmse_between"), row(*s_fit, "lpt_depth").error.at("rmse_between"));
}

/// Sums of the table for a method and protocol.
struct Sums {
  double weights = 0.0, squares = 0.0, errors = 0.0, max = 0.0;
};
Sums sumsOf(const Section& section, const std::string& method, const std::string& protocol,
            const std::string& light = "") {
  const Table& table = section.tables.at(0);
  const auto column = [&](const char* name) {
    return static_cast<std::size_t>(std::find(table.columns.begin(), table.columns.end(), name) -
                                    table.columns.begin());
  };
  Sums sums;
  for (const auto& r : table.rows) {
    if (r[column("method")] != method || r[column("protocol")] != protocol) continue;
    if (!light.empty() && r[column("light")] != light) continue;
    sums.weights += std::stod(r[column("weights")]);
    sums.squares += std::stod(r[column("squares")]);
    sums.errors += std::stod(r[column("errors")]);
    sums.max = std::max(sums.max, std::stod(r[column("max")]));
  }
  return sums;
}

TEST_F(LightSections, RowsFollowFromTheTable) {
  ASSERT_EQ(s_fit->tables.at(0).name, "lpt_fit_lights");
  for (const lpt::Method& method : fittedMethods(samples())) {
    const std::string name(method.name);
    const Row& r = row(*s_fit, name);
    const std::map<std::string, std::string> protocols{{"rmse", "held_out"},
                                                       {"rmse_seen", "held_out_seen"},
                                                       {"rmse_leave_one_out", "leave_one_out"},
                                                       {"rmse_between", "between"},
                                                       {"rmse_between_filled", "between_filled"}};
    for (const auto& [key, protocol] : protocols) {
      if (readsNoLight(method, key)) continue;
      const Sums sums = sumsOf(*s_fit, name, protocol);
      // The table has twelve digits.
      EXPECT_NEAR(std::sqrt(sums.squares / sums.weights), r.error.at(key), 1e-10 * r.error.at(key)) << name << key;
    }
    const Sums sums = sumsOf(*s_fit, name, "held_out");
    EXPECT_NEAR(sums.errors / sums.weights, r.error.at("bias"), 1e-10);
    EXPECT_NEAR(sums.max, r.error.at("max"), 1e-10);
  }
}

TEST_F(LightSections, ArraysGiveTheSumsOfTheTable) {
  std::map<std::string, const Array*> arrays;
  for (const Array& array : s_fit->arrays) {
    std::size_t count = 1;
    for (const std::size_t n : array.shape) count *= n;
    EXPECT_EQ(array.values.size(), count) << array.name;
    arrays[array.name] = &array;
  }
  const std::vector<float>& weight = arrays.at("lpt_fit_weight")->values;
  int lights = 0;
  for (const auto& [name, array] : arrays) {
    const std::string prefix = "lpt_fit_truth_";
    if (name.rfind(prefix, 0) != 0) continue;
    ++lights;
    const std::string k = name.substr(prefix.size());
    for (const lpt::Method& method : fittedMethods(samples())) {
      const std::string methodName(method.name);
      const std::vector<float>& predicted = arrays.at("lpt_fit_" + methodName + "_" + k)->values;
      double squares = 0.0;
      for (std::size_t i = 0; i < predicted.size(); ++i) {
        const double d = static_cast<double>(predicted[i]) - static_cast<double>(array->values[i]);
        squares += static_cast<double>(weight[i % weight.size()]) * d * d;
      }
      const Sums sums = sumsOf(*s_fit, methodName, "held_out", k);
      EXPECT_NEAR(squares, sums.squares, 1e-9 * sums.squares) << methodName;
    }
  }
  EXPECT_EQ(lights, 2);
}

TEST_F(LightSections, APerfectPredictionHasOnlyTheErrorOfInterpolationBetweenTexels) {
  /// Gives the samples themselves at the texels.
  struct Truth final : lpt::Representation {
    const LightSamples& all;
    explicit Truth(const LightSamples& s) : all(s) {}
    std::uint64_t lightingBytes() const override { return 0; }
    Result<void> relight(const glm::dvec3& light, std::span<const std::span<float>> out,
                         const JobContext&) const override {
      const auto k =
          static_cast<std::size_t>(std::find(all.heldOut.begin(), all.heldOut.end(), light) - all.heldOut.begin());
      std::copy(all.truth[k].reflected.begin(), all.truth[k].reflected.end(), out[0].begin());
      std::copy(all.truth[k].transmitted.begin(), all.truth[k].transmitted.end(), out[1].begin());
      return {};
    }
    double evaluate(int, int, int, const glm::dvec3&) const override { return 0.0; }
  };
  const Truth truth(samples());
  const auto errors = heldOutErrors(truth, samples(), {});
  ASSERT_TRUE(errors.ok());
  EXPECT_EQ(total(errors->covered).squares, 0.0);
  const auto between = betweenErrors(truth, samples(), {});
  ASSERT_TRUE(between.ok());
  // Texels with nothing around them read what was filled in, zero here, against a truth in [0, 1]; betweenSamples
  // leaves them out.
  const ErrorSum drawn = total(between->drawn), covered = betweenSamples(samples());
  EXPECT_GT(covered.squares, 0.0);
  EXPECT_LT(covered.weights, drawn.weights * (1.0 + 1e-12));
  // Of 8 x 8 columns with a truth 7 x 7 places between lie between four of them.
  EXPECT_GT(covered.weights, 0.6 * drawn.weights);
  const double rounding = 1e-6 * drawn.weights;  // of predictions kept in float
  EXPECT_GE(drawn.squares, covered.squares - rounding);
  EXPECT_LE(drawn.squares, covered.squares + (drawn.weights - covered.weights) + rounding);
}

TEST_F(LightSections, RelightRowsHaveTimesAndTheSameErrors) {
  const auto section = lptRelightSection(input(), *s_source, {});
  ASSERT_TRUE(section.ok());
  for (const Row& r : section->rows) {
    EXPECT_GT(r.timeMs->median, 0.0);
    EXPECT_DOUBLE_EQ(r.error.at("rmse"), row(*s_fit, r.method).error.at("rmse")) << r.method;
  }
  EXPECT_EQ(section->rows.size() + 1, s_fit->rows.size());
}

TEST_F(LightSections, QuantisationIsSplitByCause) {
  const auto section = quantisationSection(input(), *s_source, {});
  ASSERT_TRUE(section.ok());
  ASSERT_EQ(section->rows.size(), 12u);
  for (const Row& r : section->rows) {
    const double sum = r.error.at("mse_fit") + r.error.at("mse_quantisation") + r.error.at("mse_clamp");
    EXPECT_NEAR(sum, r.error.at("rmse") * r.error.at("rmse"), 1e-12);
    if (r.numbersAndNames.at("clamp_quantile") == "0") {
      EXPECT_EQ(r.error.at("mse_clamp"), 0.0);
      EXPECT_DOUBLE_EQ(r.error.at("rmse"), row(*s_fit, r.method).error.at("rmse"));
    }
  }
}

TEST_F(LightSections, CancelledJobsSaySo) {
  std::stop_source stop;
  stop.request_stop();
  JobContext job;
  job.stop = stop.get_token();
  LightSampleSource fresh;
  const auto section = lptFitSection(input(), fresh, job);
  ASSERT_FALSE(section.ok());
  EXPECT_EQ(section.error().kind, ErrorKind::Cancelled);
}

}  // namespace
}  // namespace sward::report
