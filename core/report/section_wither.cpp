#include "report/section_wither.h"

#include "report/text.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <utility>

namespace sward::report {
namespace {

constexpr std::uint64_t kSeed = 1;

WitherSize quickSize() {
  WitherSize size;
  size.resolution = 128;
  size.weatherings = {0.0, 0.6, 1.0};
  size.draws = 1;
  size.mingled = {1, 7};
  size.keyResolution = 64;
  size.keyErrors = {0.2};
  size.keyHeldOut = 3;
  return size;
}

const char* summary() {
  return "How blades wither in a texel: a hundred thin cones, as in the paper, are voxelised at rest; points at random "
         "places of the voxels are moved with their blades, shrink and change colour, and are splatted into a texel "
         "anew. "
         "The truth is the same blades bent as meshes and voxelised. Both are seen from above and under 45 degrees, in "
         "cells of 8 × 8 columns. More points a voxel (proportion) make less noise and take longer; the paper uses "
         "6.\n\n"
         "The paper's own motion turns each point about the root by its height's inverse square: it stretches blades "
         "and "
         "lays their feet on the ground. Ours bends the blade along its length and keeps it, but for what it "
         "shrinks.\n\n"
         "Steps: the motion's only error is the length of its steps, which falls with their square. Mingled texels are "
         "compared with all blades in one block; what differs is the random places of points, as another draw shows. "
         "Key "
         "frames are chosen by bisection until an interpolated texel looks like the simulated one; degrees that were "
         "not "
         "asked for then are measured.";
}

}  // namespace

void setCoverError(const CoverError& error, const Cover& truth, Row& row) {
  const double rmse = std::sqrt(0.5 * (error.rmse[0] * error.rmse[0] + error.rmse[1] * error.rmse[1]));
  const double opacity = 0.5 * (truth.mean(0) + truth.mean(1));
  row.error = {
      {"rmse", rmse}, {"bias", 0.5 * (error.bias[0] + error.bias[1])}, {"max", std::max(error.max[0], error.max[1])}};
  row.numbersAndNames["rmse_above"] = numberText(error.rmse[0]);
  row.numbersAndNames["rmse_45"] = numberText(error.rmse[1]);
  row.numbersAndNames["opacity_above"] = numberText(truth.mean(0));
  row.numbersAndNames["opacity_45"] = numberText(truth.mean(1));
  if (opacity > 0.0) row.numbersAndNames["relative_rmse"] = numberText(rmse / opacity);
  row.numbersAndNames["area_error"] = numberText(error.area);
  row.numbersAndNames["mean_height_error_mm"] = numberText(1e3 * error.meanHeightM);
}

Result<Section> witherSection(const WitherSize& size, const JobContext& job) {
  Section section;
  section.name = "wither";
  section.title = "Withering";
  section.summary = summary();
  const JobContext quiet{job.stop, {}, job.threads};
  SWARD_ASSIGN(const WitherBench bench, WitherBench::create(size.blades, size.resolution, kSeed, quiet));
  const std::pair<const char*, std::function<Result<void>()>> parts[] = {
      {"points", [&] { return addPointsAgainstMeshes(size, bench, section, quiet); }},
      {"lengths", [&] { return addBladeLengths(size, bench, section, quiet); }},
      {"steps",
       [&] {
         addSeasonSteps(section);
         return addAutumns(section);
       }},
      {"mingling", [&] { return addMingling(size, section, quiet); }},
      {"key frames", [&] { return addKeyFrames(size, section, quiet); }},
      {"pictures", [&] { return addWitherPictures(size, bench, section, quiet); }}};
  double done = 0.0;
  for (const auto& [name, part] : parts) {
    if (job.onProgress) job.onProgress(name, done / static_cast<double>(std::size(parts)));
    SWARD_TRY(part());
    if (job.cancelled()) return Error::cancelled();
    done += 1.0;
  }
  return section;
}

Result<Section> witherSection(const SectionInput& input, const JobContext& job) {
  return witherSection(input.quick ? quickSize() : WitherSize{}, job);
}

}  // namespace sward::report
