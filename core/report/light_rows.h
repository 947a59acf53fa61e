#pragma once

#include "lpt/representation.h"
#include "report/light_errors.h"
#include "report/row.h"

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace sward::report {

/// The methods that can be fitted to these samples: all, but for marched where there is no density.
std::vector<lpt::Method> fittedMethods(const LightSamples& samples);

/// A method fitted to the training lights, quantised as the method says.
struct FittedMethod {
  std::unique_ptr<lpt::Representation> representation;
  double seconds = 0.0;
};
Result<FittedMethod> fitMethod(const lpt::Method& method, const lpt::FitOptions& base, const LightSamples& samples,
                               const JobContext& job);

/// Row::error of a sum: rmse, psnr_db, bias and max.
std::map<std::string, double> figuresOf(const ErrorSum& sum);

/// Parameters that say what was sampled: size, layers, sub-samples, lights.
std::map<std::string, std::string> sampleParameters(const LightSamples& samples);
/// The same in words, with how errors are weighted.
std::string sampleSummary(const LightSamples& samples);
inline constexpr const char* kHeldOutReference = "ray-traced samples under 32 lights that no method was fitted to";

/// Bytes of colour, coverage and sky that every method needs beside its light data: ten a layer texel.
std::uint64_t surfaceBytes(const LightSamples& samples);

/// An empty plot of held-out RMSE against bytes or time: logarithmic in x, with its front.
Plot errorPlot(const std::string& name, const std::string& title, const std::string& xLabel);

/// A number as JSON has it.
std::string jsonNumber(double value);

}  // namespace sward::report
