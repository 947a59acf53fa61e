#include "report/texel_causes.h"

#include "report/texel_truth.h"
#include "report/truth_causes.h"

#include <array>
#include <string>
#include <utility>

namespace sward::report {
namespace {

/// As texels are lit: a point for the sun, an even sky.
constexpr TruthVariant kTexelLight{false, true, true, 0};
constexpr std::array kTruthCauses{TruthCause{"light", kTexelLight, "point sun and even sky, as texels are lit"},
                                  kSkyCause, kSunDiscCause, kBouncesCause};

Result<std::vector<image::Image>> drawAll(const TexelCauseInput& input,
                                          const std::shared_ptr<const bake::GroundBake>& ground) {
  SWARD_TRY(input.renderer.setGround(ground));
  std::vector<image::Image> pictures;
  for (const render::Frame& frame : input.frames) {
    SWARD_ASSIGN(image::Image picture, input.renderer.drawLinear(frame));
    pictures.push_back(std::move(picture));
  }
  return pictures;
}

Row voxelRow(const char* method, const Twins& truth, const image::Image& picture, const char* notes) {
  Row row = causeRow(method, {truth[0], picture}, {truth[1], picture}, notes);
  row.reference = "ray-traced, with even sky and point sun as texels have them";
  return row;
}

Row drawnRow(const char* method, const image::Image& reference, const image::Image& picture, const char* notes,
             const char* against) {
  Row row = causeRow(method, {reference, picture}, {reference, picture}, notes);
  row.reference = against;
  return row;
}

}  // namespace

Result<TexelCauseGrounds> texelCauseGrounds(const project::Project& project,
                                            std::shared_ptr<const bake::GroundBake> ground, const JobContext& job) {
  SWARD_ASSIGN(const scene::Patch blades, witheredBlades(project));
  TexelCauseGrounds grounds;
  SWARD_ASSIGN(grounds.voxelised, voxelisedGround(*ground, blades, job));
  grounds.dull = dullGround(*ground, job);
  grounds.project = std::move(ground);
  if (job.cancelled()) return Error::cancelled();
  return grounds;
}

Result<std::vector<std::vector<Row>>> texelCauseRows(const TexelCauseInput& input, const JobContext& job) {
  SWARD_ASSIGN(const std::vector<image::Image> pictures, drawAll(input, input.grounds.project));
  SWARD_ASSIGN(const std::vector<image::Image> dull, drawAll(input, input.grounds.dull));
  SWARD_ASSIGN(const std::vector<image::Image> voxelised, drawAll(input, input.grounds.voxelised));
  std::vector<std::vector<Row>> all;
  for (std::size_t i = 0; i < input.frames.size(); ++i) {
    SWARD_ASSIGN(const Twins truth, truthTwins(input.truth, input.frames[i], kTexelLight, input.samples, job));
    std::vector<Row>& rows = all.emplace_back();
    rows.push_back(
        voxelRow("voxels", truth, pictures[i], "the picture in the texels' own light: voxels and their march"));
    rows.push_back(voxelRow("voxels_without_points", truth, voxelised[i],
                            "the same of texels voxelised from the blades, without points between"));
    rows.push_back(drawnRow("points", voxelised[i], pictures[i],
                            "texels of points against texels voxelised from the blades", "drawn, voxelised blades"));
    rows.push_back(drawnRow("highlight", dull[i], pictures[i],
                            "the highlight, which the reference's leaves do not have", "drawn without highlight"));
    SWARD_ASSIGN(std::vector<Row> more, truthCauseRows(input.truth, input.frames[i], kTruthCauses, input.samples, job));
    for (Row& row : more) rows.push_back(std::move(row));
    for (Row& row : rows) row.numbersAndNames["reference_samples"] = std::to_string(2 * input.samples);
  }
  return all;
}

}  // namespace sward::report
