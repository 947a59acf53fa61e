#include "report/light_rows.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>

namespace sward::report {
namespace {

std::string text(const char* format, double value) {
  char buffer[64];
  std::snprintf(buffer, sizeof(buffer), format, value);
  return buffer;
}

}  // namespace

std::vector<lpt::Method> fittedMethods(const LightSamples& samples) {
  std::vector<lpt::Method> methods(lpt::kMethods.begin(), lpt::kMethods.end());
  if (!samples.density) std::erase_if(methods, [](const auto& method) { return method.basis == lpt::Basis::Marched; });
  return methods;
}

Result<FittedMethod> fitMethod(const lpt::Method& method, const lpt::FitOptions& base, const LightSamples& samples,
                               const JobContext& job) {
  FittedMethod fitted;
  const auto start = std::chrono::steady_clock::now();
  SWARD_ASSIGN(fitted.representation, lpt::represent(samples.input(), method.options(base), true, job));
  fitted.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return fitted;
}

std::map<std::string, double> figuresOf(const ErrorSum& sum) {
  return {{"rmse", sum.rmse()}, {"psnr_db", sum.psnrDb()}, {"bias", sum.bias()}, {"max", sum.max}};
}

std::map<std::string, std::string> sampleParameters(const LightSamples& samples) {
  return {{"resolution", std::to_string(samples.shape().width)},
          {"layers", std::to_string(samples.shape().layers)},
          {"sub_samples", std::to_string(samples.subSamples)},
          {"training_lights", std::to_string(samples.training.size())},
          {"layer_texels", std::to_string(samples.texels())}};
}

std::string sampleSummary(const LightSamples& samples) {
  std::size_t occupied = 0;
  const auto& start = samples.train.hits.columnStart;
  for (std::size_t c = 0; c + 1 < start.size(); ++c) occupied += start[c + 1] > start[c] ? 1 : 0;
  return "Slices of the project's patch, " + std::to_string(samples.shape().width) + " x " +
         std::to_string(samples.shape().height) + " texels x " + std::to_string(samples.shape().layers) + " layers, " +
         std::to_string(samples.subSamples) + " rays a layer texel: " + std::to_string(samples.texels()) +
         " layer texels hold something, " +
         text("%.1f", static_cast<double>(samples.texels()) / static_cast<double>(std::max<std::size_t>(occupied, 1))) +
         " in each occupied column. Fitted to the project's " + std::to_string(samples.training.size()) +
         " lights, compared under " + std::to_string(samples.heldOut.size()) +
         " others: a Fibonacci lattice turned by one radian, whose nearest light is " +
         text("%.1f", samples.nearestDeg) +
         " degrees from a training light. Errors are of the response to a light of unit irradiance (reflected and "
         "transmitted alike, negative predictions drawn as 0), weighted by the coverage of each layer texel. The truth "
         "has rays of its own, " +
         std::to_string(kTruthFactor * samples.subSamples) +
         " a layer texel in every second block of columns, so that no method is compared with the very leaves that it "
         "was fitted to. It is noisy "
         "itself: "
         "its two halves put the standard deviation of one value at " +
         text("%.4f", std::sqrt(samples.noiseVariance)) +
         ", which is part of every error here; take its square from the squares to see a method alone.";
}

std::uint64_t surfaceBytes(const LightSamples& samples) {
  // Reflectance and coverage 4, transmittance 4, sky 2, as LayerStack has them.
  return 10u * static_cast<std::uint64_t>(samples.shape().columns()) *
         static_cast<std::uint64_t>(samples.shape().layers);
}

Plot errorPlot(const std::string& name, const std::string& title, const std::string& xLabel) {
  Plot plot;
  plot.name = name;
  plot.title = title;
  plot.xLabel = xLabel;
  plot.yLabel = "RMSE on held-out lights";
  plot.logX = true;
  plot.pareto = true;
  return plot;
}

std::string jsonNumber(double value) {
  return text("%.6g", value);
}

}  // namespace sward::report
