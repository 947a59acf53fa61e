#pragma once

#include "report/section.h"

#include <string>
#include <vector>

namespace sward::report {

/// Section `texel_render`: the ground drawn as texels against the ray-traced blades that they stand for, on level
/// ground, at the view angles of section grassland, under the project's sun, sky and haze; the slow variation and the
/// bend of the grid are left out. Beside them the march through the layers of the same project at the same weathering
/// degree, against blades that withered as its bake's did (a few models, each many times; a texel's blades are all
/// their own). Measured at the project's weathering degree, or where it has not withered at TexelRenderSizes's.
/// - texels, one row a view and `columns` (the finest level that is drawn): as in section grassland; time of a frame of
///   one sample, in turn with the march's, whose share is `ratio`; `bytes` what the levels see of the sky,
///   `bytes_total` all of their levels; `relight_ms` once, for another sun; `reference_mean` of the reference and
///   `relative_bias`, the bias over it.
/// - march: the same of the layers (levels `layers`).
/// - causes, one row a view, at half the size, at the last degree and the most columns: what one step costs (method
///   cause_...). voxels: the picture against the reference with a point sun and an even sky, as texels are lit, which
///   leaves what is not light; voxels_without_points: the same of texels voxelised from the withered blades; points:
///   the one picture against the other; highlight: with and without; light: that light of the reference against its
///   own; sky, sun_disc and bounces as in section grassland.
/// - texels_sun_behind, _across, _against and march_sun_...: view 45 at half the size with the sun elsewhere
///   (texel_suns.h), at the last degree and the most columns.
Result<Section> texelRenderSection(const SectionInput& input, const JobContext& job);

struct TexelRenderSizes {
  int width = 256, height = 144;              ///< pixels
  int samples = 16;                           ///< of the references
  int causeSamples = 6;                       ///< of each of two references of the causes, which are half as wide
  int runs = 5;                               ///< timed
  std::vector<int> columns{128, 64, 32};      ///< falling, each a half of one before
  std::vector<double> weatherings{0.0};  ///< where the project has not withered
  std::vector<std::string> views{"down", "45", "grazing"};  ///< of the last degree
  std::vector<std::string> otherViews{"45"};                ///< of those before
  bool causes = true;
};
/// The same at any size.
Result<Section> measureTexelRender(const SectionInput& input, const TexelRenderSizes& sizes, const JobContext& job);

}  // namespace sward::report
