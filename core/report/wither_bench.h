#pragma once

#include "base/job.h"
#include "base/result.h"
#include "wither/points.h"
#include "wither/season.h"
#include "wither/strand.h"
#include "wither/texel.h"
#include "wither/voxelise.h"
#include "wither/withered_model.h"

#include <array>
#include <cstdint>
#include <vector>

namespace sward::report {

/// The paper's cones of a seed, from the mesh to the texel at rest: what speed and errors of withering are measured on.
/// In a cube of voxels over 1 m x 1 m x 0.3 m; the season, body and leaf colours are the defaults.
class WitherBench {
 public:
  /// Errors: those of core/wither; Error::cancelled().
  static Result<WitherBench> create(int blades, int resolution, std::uint64_t seed, const JobContext& job);
  /// The blades of several in one block, blade by blade as they were there: delays, droops and bending directions are
  /// kept, and sample i of the mingling is what parts[i] holds.
  static Result<WitherBench> together(const std::vector<const WitherBench*>& parts, const JobContext& job);

  const wither::TexelGrid& grid() const { return m_grid; }
  const wither::PatchStrands& strands() const { return m_strands; }
  const wither::VoxelisedPatch& rest() const { return m_rest; }
  const wither::Season& season() const { return m_season; }
  const wither::AgeColour& colour() const { return m_colour; }
  int blades() const { return static_cast<int>(m_strands.strands.size()); }

  /// Random places follow from the seed.
  Result<wither::Points> points(double proportion, std::uint64_t seed, const JobContext& job) const;
  /// Posed and splatted at the default sigma. `samples`: of the mingling, or none.
  Result<wither::Texel> texel(const wither::Points& points, double weathering,
                              std::span<const wither::MingleSample> samples, const JobContext& job) const;
  /// By the paper's own motion; colours stay.
  Result<wither::Texel> paperTexel(const wither::Points& points, double weathering, const JobContext& job) const;
  /// Every blade bent as a mesh, then voxelised: what the points' way is compared with.
  Result<wither::Texel> direct(double weathering, const JobContext& job) const;

 private:
  scene::Patch m_patch;
  wither::TexelGrid m_grid;
  wither::PatchStrands m_strands;
  wither::VoxelisedPatch m_rest;
  wither::Season m_season;
  wither::AgeColour m_colour;
};

/// What a texel covers, seen from above and under 45 degrees: opacity (1 - transmittance) of square cells of the
/// ground, each the mean of parallel rays on an even grid.
struct Cover {
  static constexpr std::size_t kViews = 2;
  int cells = 0;                                    ///< along a side
  std::array<std::vector<double>, kViews> opacity;  ///< [y][x], 0 to 1
  double areaM2 = 0.0;
  double meanHeightM = 0.0;  ///< of the leaf area
  double mean(std::size_t view) const;
};
/// Cells of 8 x 8 columns; a ray a column from above, four along (1, 0, 1). Time follows the voxels.
Cover coverOf(const wither::Texel& texel);

/// How a cover differs from the true one.
struct CoverError {
  std::array<double, Cover::kViews> rmse{}, bias{}, max{};  ///< of the cells' opacity
  double area = 0.0;                                        ///< relative
  double meanHeightM = 0.0;
};
CoverError coverError(const Cover& cover, const Cover& truth);

}  // namespace sward::report
