#pragma once

#include "report/section.h"

namespace sward::report {

/// Section `grassland`: the drawn ground against the ray-traced one, at the view angles down, 45 degrees and grazing of
/// section speed, under the project's sun, sky and haze; the slow variation and the bend of the grid are left out.
/// - march, blended, blended_paper, one row a view: time of a frame of one sample; errors of pictures of as many
///   samples as the project asks for, filtered alike by the same tent. The reference's own noise stands in the
///   parameters, with the RMSE that is left without it (rmse_without_noise, in quadrature).
/// - causes, one row a view, at half the size: what one step costs, all others left as they are (method cause_...):
///   layers (light traced for the very sun, 16 bits, drawn by the march, against the reference with a bake's own
///   light), blending (the blended picture of the same against the march), fit, range_clamp and
///   quantisation (RMSE between two drawn
///   pictures), tiling, sky, sun_disc, bounces (RMSE between two references). Their rmse is freed of noise by the
///   product of two independent differences; they do not add up, since steps also mend each other's errors.
Result<Section> grasslandSection(const SectionInput& input, const JobContext& job);

struct GrasslandSizes {
  int width = 480, height = 270;  ///< pixels
  int samples = 32;               ///< of the reference
  int causeSamples = 6;           ///< of each of two references of the causes, which are half as wide
  int runs = 7;                   ///< timed
};
/// The same at any size; quick is 240 x 136 of 16 samples.
Result<Section> measureGrassland(const SectionInput& input, const GrasslandSizes& sizes, const JobContext& job);

}  // namespace sward::report
