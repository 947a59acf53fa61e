// Of section wither: texels mixed with each other, of several samples and between key frames.

#include "report/section_wither.h"
#include "report/text.h"
#include "wither/key_frames.h"
#include "wither/mingle.h"
#include "wither/packed_texel.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

namespace sward::report {
namespace {

constexpr double kProportion = 6.0;
constexpr double kWeathering = 0.6;
constexpr std::uint64_t kSeed = 1;

/// Sample i of `count` ages the faster the higher its number: green and yellow blades beside each other.
Result<std::vector<wither::MingleSample>> samplesOf(int count) {
  std::vector<wither::MingleSample> samples(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    const double end = static_cast<double>(i + 1) / count;
    SWARD_ASSIGN(samples[static_cast<std::size_t>(i)].ageing, base::Curve::fromPoints({{0.0, 0.0}, {1.0, end}}));
  }
  return samples;
}

Result<Row> mingledRow(const std::vector<const WitherBench*>& parts, const JobContext& job) {
  SWARD_ASSIGN(const auto samples, samplesOf(static_cast<int>(parts.size())));
  std::vector<wither::Texel> texels;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    SWARD_ASSIGN(const wither::Points points, parts[i]->points(kProportion, kSeed, job));
    SWARD_ASSIGN(wither::Texel texel, parts[i]->texel(points, kWeathering, {&samples[i], 1}, job));
    texels.push_back(std::move(texel));
  }
  std::vector<wither::MingleInput> inputs;
  for (const wither::Texel& texel : texels) inputs.push_back({&texel, 1.0});
  SWARD_ASSIGN(const wither::Texel mingled, wither::mingle(inputs, job));
  SWARD_ASSIGN(const WitherBench together, WitherBench::together(parts, job));
  SWARD_ASSIGN(const wither::Points points, together.points(kProportion, kSeed, job));
  SWARD_ASSIGN(const wither::Texel truth, together.texel(points, kWeathering, samples, job));
  SWARD_ASSIGN(const wither::Points otherPoints, together.points(kProportion, kSeed + 1, job));
  SWARD_ASSIGN(const wither::Texel other, together.texel(otherPoints, kWeathering, samples, job));
  const Cover trueCover = coverOf(truth);
  const Cover cover = coverOf(mingled);
  const Cover otherCover = coverOf(other);
  SWARD_ASSIGN(const double look, wither::lookDifference(mingled, truth));
  SWARD_ASSIGN(const double otherLook, wither::lookDifference(other, truth));
  Row row, floor;
  setCoverError(coverError(otherCover, trueCover), trueCover, floor);
  setCoverError(coverError(cover, trueCover), trueCover, row);
  row.method = "mingled";
  row.numbersAndNames.insert({{"samples", std::to_string(parts.size())},
                              {"blades", std::to_string(together.blades())},
                              {"points", std::to_string(points.size())},
                              {"voxels", std::to_string(mingled.size())},
                              {"weathering", numberText(kWeathering)},
                              {"resolution", std::to_string(together.grid().columns)},
                              {"look_difference", numberText(look)},
                              {"look_difference_other_places", numberText(otherLook)},
                              {"rmse_other_places", numberText(floor.error.at("rmse"))}});
  row.reference = "all blades simulated in one block";
  return row;
}

Result<Row> packedRow(const wither::Texel& texel, const JobContext& job) {
  const wither::PackedTexel packed = wither::PackedTexel::pack(texel, job);
  const wither::Texel again = packed.unpack(job);
  if (job.cancelled()) return Error::cancelled();
  Row row;
  row.method = "packed";
  const Cover truth = coverOf(texel);
  const Cover cover = coverOf(again);
  setCoverError(coverError(cover, truth), truth, row);
  SWARD_ASSIGN(const double look, wither::lookDifference(again, texel));
  double density = 0.0;
  for (std::size_t i = 0; i < std::min(texel.size(), again.size()); ++i) {
    const auto a = static_cast<double>(texel.voxels()[i].density), b = static_cast<double>(again.voxels()[i].density);
    density = std::max(density, std::abs(b / a - 1.0));
  }
  row.bytes = packed.bytes();
  row.numbersAndNames.insert({{"voxels", std::to_string(texel.size())},
                              {"resolution", std::to_string(texel.grid().columns)},
                              {"unpacked_bytes", std::to_string(texel.bytes())},
                              {"density_error", numberText(density)},
                              {"look_difference", numberText(look)}});
  row.reference = "the texel before packing";
  return row;
}

/// What interpolated texels differ by at degrees that no frame and no measurement of the choice stood at.
struct HeldOut {
  CoverError interpolated;
  double rmseSimulated = 0.0, lookMax = 0.0, lookMean = 0.0;
  Cover truth;  ///< of the last
};

double bothViews(const CoverError& error) {
  return 0.5 * (error.rmse[0] * error.rmse[0] + error.rmse[1] * error.rmse[1]);
}

Result<HeldOut> heldOut(const wither::KeyFrames& frames, const wither::TexelAt& simulate, const WitherBench& bench,
                        int count, const JobContext& job) {
  HeldOut out;
  for (int i = 0; i < count; ++i) {
    const double degree = (i + 0.6180339887498949) / count;
    SWARD_ASSIGN(const wither::Texel between, frames.at(degree, job));
    SWARD_ASSIGN(const wither::Texel simulated, simulate(degree));
    SWARD_ASSIGN(const wither::Texel direct, bench.direct(degree, job));
    SWARD_ASSIGN(const double look, wither::lookDifference(between, simulated));
    out.lookMax = std::max(out.lookMax, look);
    out.lookMean += look / count;
    out.truth = coverOf(direct);
    const Cover betweenCover = coverOf(between);
    const Cover simulatedCover = coverOf(simulated);
    const CoverError error = coverError(betweenCover, out.truth);
    for (std::size_t view = 0; view < Cover::kViews; ++view) {
      out.interpolated.rmse[view] += error.rmse[view] * error.rmse[view] / count;
      out.interpolated.bias[view] += error.bias[view] / count;
      out.interpolated.max[view] = std::max(out.interpolated.max[view], error.max[view]);
    }
    out.interpolated.area += error.area / count;
    out.interpolated.meanHeightM += error.meanHeightM / count;
    out.rmseSimulated += bothViews(coverError(simulatedCover, out.truth)) / count;
  }
  for (double& rmse : out.interpolated.rmse) rmse = std::sqrt(rmse);
  out.rmseSimulated = std::sqrt(out.rmseSimulated);
  return out;
}

Result<Row> keyFramesRow(const WitherSize& size, const WitherBench& bench, const wither::TexelAt& simulate,
                         double largestError, const JobContext& job) {
  const wither::KeyFrameOptions options{largestError, size.mostFrames, 1.0 / 256};
  SWARD_ASSIGN(const wither::KeyFrames frames, wither::chooseKeyFrames(simulate, options, job));
  SWARD_ASSIGN(const HeldOut held, heldOut(frames, simulate, bench, size.keyHeldOut, job));
  Row row;
  row.method = "key_frames";
  setCoverError(held.interpolated, held.truth, row);
  row.numbersAndNames.erase("relative_rmse");  // degrees differ in what they cover
  std::uint64_t bytes = 0;
  for (const wither::KeyFrame& frame : frames.frames) bytes += wither::PackedTexel::pack(*frame.texel, job).bytes();
  if (job.cancelled()) return Error::cancelled();
  row.bytes = bytes;
  row.numbersAndNames.insert({{"largest_error", numberText(largestError)},
                              {"frames", std::to_string(frames.frames.size())},
                              {"most_frames", std::to_string(size.mostFrames)},
                              {"texels_made", std::to_string(frames.made)},
                              {"measured_error", numberText(frames.error)},
                              {"held_out", std::to_string(size.keyHeldOut)},
                              {"look_difference_max", numberText(held.lookMax)},
                              {"look_difference_mean", numberText(held.lookMean)},
                              {"rmse_simulated", numberText(held.rmseSimulated)},
                              {"resolution", std::to_string(size.keyResolution)},
                              {"blades", std::to_string(bench.blades())}});
  Result<void> outcome;
  row.timeMs = timeRuns(3, [&] {
    const Result<wither::Texel> between = frames.at(0.37, job);
    if (!between.ok()) outcome = between.error();
  });
  SWARD_TRY(std::move(outcome));
  row.reference = "held-out degrees, the blades bent as meshes";
  row.notes = "the time is that of interpolating";
  return row;
}

}  // namespace

Result<void> addMingling(const WitherSize& size, Section& section, const JobContext& job) {
  std::vector<WitherBench> benches;
  const int most = size.mingled.empty() ? 0 : *std::max_element(size.mingled.begin(), size.mingled.end());
  for (int i = 0; i < most; ++i) {
    SWARD_ASSIGN(WitherBench bench,
                 WitherBench::create(size.blades, size.resolution, kSeed + static_cast<std::uint64_t>(i), job));
    benches.push_back(std::move(bench));
  }
  for (const int count : size.mingled) {
    std::vector<const WitherBench*> parts;
    for (int i = 0; i < count; ++i) parts.push_back(&benches[static_cast<std::size_t>(i)]);
    SWARD_ASSIGN(Row row, mingledRow(parts, job));
    section.rows.push_back(std::move(row));
  }
  return {};
}

Result<void> addKeyFrames(const WitherSize& size, Section& section, const JobContext& job) {
  SWARD_ASSIGN(const WitherBench bench, WitherBench::create(size.blades, size.keyResolution, kSeed, job));
  SWARD_ASSIGN(const wither::Points points, bench.points(kProportion, kSeed, job));
  const wither::TexelAt simulate = [&](double degree) { return bench.texel(points, degree, {}, job); };
  SWARD_ASSIGN(const wither::Texel middle, simulate(kWeathering));
  SWARD_ASSIGN(Row packed, packedRow(middle, job));
  section.rows.push_back(std::move(packed));
  Plot plot;
  plot.name = "wither_key_frames";
  plot.title = "Key frames: bytes against error";
  plot.xLabel = "bytes of all frames, packed";
  plot.yLabel = "look difference at held-out degrees";
  plot.caption = "Labels are numbers of frames. Thin blades that move by more than their width need many.";
  plot.logX = plot.logY = true;
  Plot::Series largest{"largest", {}, true}, mean{"mean", {}, true};
  for (const double error : size.keyErrors) {
    SWARD_ASSIGN(Row row, keyFramesRow(size, bench, simulate, error, job));
    const auto number = [&](const char* name) { return std::stod(row.numbersAndNames.at(name)); };
    const auto bytes = static_cast<double>(*row.bytes);
    largest.points.push_back({bytes, number("look_difference_max"), row.numbersAndNames.at("frames")});
    mean.points.push_back({bytes, number("look_difference_mean"), row.numbersAndNames.at("frames")});
    section.rows.push_back(std::move(row));
  }
  plot.series = {std::move(largest), std::move(mean)};
  section.plots.push_back(std::move(plot));
  return {};
}

}  // namespace sward::report
