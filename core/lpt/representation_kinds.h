#pragma once

#include "lpt/representation.h"
#include "lpt/stored_sets.h"
#include "lpt/texel_fit.h"

#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

/// The kinds that represent() dispatches to; not for other folders.
namespace sward::lpt::detail {

using Represented = Result<std::unique_ptr<Representation>>;

/// Lpt: one set of ten coefficients a column.
Represented representLpt(const RepresentationInput& input, const FitOptions& options, bool quantised,
                         const JobContext& job);

/// The same of a fit that has a common response.
Represented storeResponse(const RepresentationInput& input, Fit fit, const FitOptions& options, bool quantised,
                          const JobContext& job);

/// How the layers of a column are put into the groups of Clustered.
enum class LayerGroups : std::uint8_t {
  Equal,    ///< the same for every column, equally thick
  Adaptive  ///< the contiguous groups of least summed objective, a column's own; one byte a column and inner border
};
/// Clustered: sets of ten a group of layers, each fitted by itself as an LPT (weights, centring, ridges).
Represented representClustered(const RepresentationInput& input, const FitOptions& options, LayerGroups groups,
                               bool quantised, const JobContext& job);

/// Ptm: six coefficients a layer texel.
Represented representPtm(const RepresentationInput& input, const FitOptions& options, bool quantised,
                         const JobContext& job);
/// Constant: one number a layer texel, the mean of its samples (all of a texel's rows weigh the same).
Represented representConstant(const RepresentationInput& input, const FitOptions& options, bool quantised,
                              const JobContext& job);
/// Hsh: bands^2 coefficients a layer texel, bands 1 to 3, by least squares with the ridge of PTM on all but the
/// constant. Two bands are four coefficients against PTM's six; three are nine.
Represented representHsh(const RepresentationInput& input, const FitOptions& options, int bands, bool quantised,
                         const JobContext& job);

/// Which texels a representation was made for; a copy, so that it stands alone.
struct Texels {
  int columns = 0, layers = 0;
  std::vector<std::uint32_t> columnStart;
  std::vector<std::uint8_t> layer;

  explicit Texels(const FitInput& in)
      : columns(in.columns),
        layers(in.layers),
        columnStart(in.columnStart.begin(), in.columnStart.end()),
        layer(in.layer.begin(), in.layer.end()) {}
};

/// Throws ContractError unless there is a span for every channel, as long as the texels.
void checkRelight(const Texels& texels, std::size_t channels, std::span<const std::span<float>> out);

/// f = sum_j b_j g_j(l), a set of coefficients for every layer texel, set = column * layers + layer.
class TexelFunctions final : public Representation {
 public:
  TexelFunctions(Texels texels, StoredSets sets, LightFunctions functions)
      : m_texels(std::move(texels)), m_sets(std::move(sets)), m_functions(functions) {}

  std::uint64_t lightingBytes() const override { return m_sets.bytes(); }
  Result<void> relight(const glm::dvec3& light, std::span<const std::span<float>> out,
                       const JobContext& job) const override;
  double evaluate(int column, int layer, int channel, const glm::dvec3& light) const override;

 private:
  Texels m_texels;
  StoredSets m_sets;
  LightFunctions m_functions;
};

/// Biquadratics in (lx, ly, u), `groups` sets for every column, set = column * groups + group of the layer.
class ColumnPolynomials final : public Representation {
 public:
  /// groupStart: the first layer of groups 1, 2 ... ascending, [column][groups - 1], or [groups - 1] for all columns.
  ColumnPolynomials(Texels texels, StoredSets sets, int groups, std::vector<std::uint16_t> groupStart,
                    std::uint64_t indexBytes)
      : m_texels(std::move(texels)),
        m_sets(std::move(sets)),
        m_groups(static_cast<std::size_t>(groups)),
        m_groupStart(std::move(groupStart)),
        m_indexBytes(indexBytes) {}

  std::uint64_t lightingBytes() const override { return m_sets.bytes() + m_indexBytes; }
  Result<void> relight(const glm::dvec3& light, std::span<const std::span<float>> out,
                       const JobContext& job) const override;
  double evaluate(int column, int layer, int channel, const glm::dvec3& light) const override;

 private:
  std::span<const std::uint16_t> groupStart(std::size_t column) const;

  Texels m_texels;
  StoredSets m_sets;
  std::size_t m_groups;
  std::vector<std::uint16_t> m_groupStart;
  std::uint64_t m_indexBytes;
};

/// A common response, and what each column differs from it: ten coefficients of responseBasis a column.
class ResponsePolynomials final : public Representation {
 public:
  /// features: one a texel of `texels`.
  ResponsePolynomials(Texels texels, StoredSets sets, CommonResponse common, std::vector<TexelFeatures> features);

  std::uint64_t lightingBytes() const override { return m_sets.bytes() + m_common.bytes(); }
  Result<void> relight(const glm::dvec3& light, std::span<const std::span<float>> out,
                       const JobContext& job) const override;
  /// Where no texel was sampled: under the sky of its layer's mean texel.
  double evaluate(int column, int layer, int channel, const glm::dvec3& light) const override;

 private:
  TexelFeatures featuresAt(std::size_t column, std::size_t layer) const;

  Texels m_texels;
  StoredSets m_sets;
  CommonResponse m_common;
  std::vector<TexelFeatures> m_features;    ///< [texel]
  std::vector<std::array<float, 2>> m_sky;  ///< [layer]: mean, by coverage
};

/// First layer of groups 1, 2 ... of every column, [column][groups - 1]: the contiguous groups whose separate LPT fits
/// have the least sum over groups and channels of summed weight times minimised objective, by dynamic programming over
/// the occupied layers. A border lies half-way between the occupied layers that it parts; groups that a column does not
/// need start at `layers`. Columns without a complete sample get equal groups.
std::vector<std::uint16_t> bestGroups(const FitInput& input, const FitOptions& options, int groups,
                                      const JobContext& job);
/// The same for equally thick groups, [groups - 1].
std::vector<std::uint16_t> equalGroups(int layers, int groups);

}  // namespace sward::lpt::detail
