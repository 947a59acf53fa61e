#pragma once

#include "report/section.h"
#include "report/wither_bench.h"

#include <vector>

namespace sward::report {

/// What section `wither` is measured on.
struct WitherSize {
  int resolution = 256;
  int blades = 100;
  std::vector<double> weatherings{0.0, 0.3, 0.6, 0.917, 1.0};  ///< the paper's three pictures among them
  std::vector<double> proportions{1.0, 6.0, 30.0};
  int draws = 2;                      ///< of points' random places, over which errors are taken
  std::vector<int> mingled{1, 4, 7};  ///< samples of `blades` each
  int keyResolution = 128;            ///< of key frames
  std::vector<double> keyErrors{0.1, 0.05, 0.02};
  int keyHeldOut = 6;  ///< degrees between frames that are compared
  int mostFrames = 33;
};

/// Section `wither`. It needs neither project nor graphics. Errors rmse, bias and max are of the opacity of cells of
/// 8 x 8 columns, both views of Cover together, against the blades bent as meshes unless said otherwise; parameters
/// rmse_above, rmse_45, opacity_above and opacity_45 (true means), relative_rmse (over the mean opacity), area_error
/// (relative), mean_height_error_mm, look_difference (wither::lookDifference). Rows:
/// - points: texels from points, `weathering` and `proportion`; the time of posing and splatting;
/// - paper_motion: the same points moved as the paper prints it;
/// - blade_length: `motion` ours or paper: relative errors of blades' lengths, bias their mean;
/// - season_step: a season in steps of `step`, `quantity` tip_rad, strain_along or strain_across: the greatest error at
///   the steps' ends against steps of 1/8192; `order` from the row before;
/// - mingled: `samples` mixed, against all of their blades simulated in one block; rmse_other_places: that block
///   against itself with other random places of its points;
/// - packed: a key frame packed and unpacked, against itself; density_error: relative, largest;
/// - key_frames: chosen for `largest_error`: `frames`, bytes of all packed; held-out degrees interpolated, against
///   the meshes; look_difference_max and _mean of them, against the points' way; rmse_simulated: of the points' way,
///   without interpolation;
/// - autumn: `autumn` with `tip_deg`, `water` and `chlorophyll` at its end and `half_turn`, when the tip has turned
///   half as far.
Result<Section> witherSection(const WitherSize& size, const JobContext& job);
Result<Section> witherSection(const SectionInput& input, const JobContext& job);

/// Its parts. Each adds rows and plots, and a picture.
Result<void> addPointsAgainstMeshes(const WitherSize& size, const WitherBench& bench, Section& section,
                                    const JobContext& job);
Result<void> addBladeLengths(const WitherSize& size, const WitherBench& bench, Section& section, const JobContext& job);
void addSeasonSteps(Section& section);
Result<void> addAutumns(Section& section);
Result<void> addMingling(const WitherSize& size, Section& section, const JobContext& job);
Result<void> addKeyFrames(const WitherSize& size, Section& section, const JobContext& job);
Result<void> addWitherPictures(const WitherSize& size, const WitherBench& bench, Section& section,
                               const JobContext& job);

/// Errors of both views into a row, as the section has them.
void setCoverError(const CoverError& error, const Cover& truth, Row& row);

}  // namespace sward::report
