#pragma once

#include "base/job.h"
#include "base/result.h"
#include "lpt/fit.h"
#include "lpt/options.h"
#include "trace/layers.h"
#include "trace/voxel_density.h"

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include <glm/glm.hpp>

namespace sward::lpt {

/// A representation that the report compares and --method names.
struct Method {
  std::string_view name;  ///< of the report's rows
  Basis basis = Basis::Lpt;
  int bits = 8;  ///< of a stored coefficient
  bool paper = false;
  int clusters = 2;
  bool depth = false;  ///< LayerCoordinate::Depth, whatever the project says

  /// `base` (ridges, clamp) with what the method fixes.
  FitOptions options(FitOptions base) const {
    base.basis = basis;
    base.bits = bits;
    base.paper = paper;
    base.clusters = clusters;
    if (depth) base.coordinate = LayerCoordinate::Depth;
    return base;
  }
};
/// In the order of the report's rows.
inline constexpr std::array kMethods{Method{"constant", Basis::Constant, 8, false, 2},
                                     Method{"ptm8", Basis::Ptm, 8, false, 2},
                                     Method{"ptm", Basis::Ptm, 16, false, 2},
                                     Method{"lpt_paper", Basis::Lpt, 8, true, 2},
                                     Method{"lpt_depth", Basis::Lpt, 8, false, 2, true},
                                     Method{"lpt8", Basis::Lpt, 8, false, 2},
                                     Method{"lpt16", Basis::Lpt, 16, false, 2},
                                     Method{"lpt_clustered2", Basis::Clustered, 8, false, 2},
                                     Method{"lpt_clustered4", Basis::Clustered, 8, false, 4},
                                     Method{"hsh", Basis::Hsh, 8, false, 2},
                                     Method{"marched", Basis::Marched, 8, false, 2}};

/// The method of that name, or null; "ptm16" is another name of "ptm".
const Method* findMethod(std::string_view name);

/// What a representation is made from: the samples of one layer set. All pointers and spans are the caller's and are
/// not kept, but for `density`.
struct RepresentationInput {
  FitInput fit;
  const trace::LayerHits* hits = nullptr;  ///< whose texels `fit` samples; positions for Marched
  /// Of the patch, for Marched alone.
  std::shared_ptr<const trace::VoxelDensity> density;
};

/// One way to keep how the texels of a layer set answer light: fitted, sized, relit, evaluated, all alike. To draw it,
/// relight it and store that as a Constant (bake::responseStack). Immutable, so that threads may share it.
class Representation {
 public:
  virtual ~Representation() = default;
  /// Bytes of the light data as stored (coefficients, indices, voxels), without colours, coverage and sky: dense, one
  /// item for every column or layer texel whether occupied or not, as a texture holds it.
  virtual std::uint64_t lightingBytes() const = 0;
  /// Responses of every sampled texel to a light of unit irradiance: out[channel][texel], in the order of the input's
  /// texels; not clamped at 0. `light` is a unit vector, z >= 0. Errors: Error::cancelled().
  virtual Result<void> relight(const glm::dvec3& light, std::span<const std::span<float>> out,
                               const JobContext& job) const = 0;
  /// The response at any layer of a column, whether or not a texel was sampled there: what filtering reads.
  virtual double evaluate(int column, int layer, int channel, const glm::dvec3& light) const = 0;
};

/// Fits a representation; coefficients are quantised to options.bits with options.clampQuantile, or kept as floats with
/// `quantised` false, so that the two errors can be told apart. Lpt and Ptm are fit() (with fillEmpty over the set's
/// image) and quantise()'s ranges. Errors as fit(), and a Marched without density.
Result<std::unique_ptr<Representation>> represent(const RepresentationInput& input, const FitOptions& options,
                                                  bool quantised, const JobContext& job);

}  // namespace sward::lpt
