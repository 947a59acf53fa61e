#pragma once

#include "base/bytes.h"
#include "lpt/common_response.h"
#include "lpt/fit.h"
#include "lpt/options.h"
#include "lpt/quantisation.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

namespace sward::lpt {

/// Response channels of a stack: what leaves reflect and what they transmit.
inline constexpr int kReflected = 0;
inline constexpr int kTransmitted = 1;

/// Quantised layers, dense and ready to relight: `images` images (the tiles of a set, or 1) of width x height columns
/// with `layers` layers. This is what is cached on disk, uploaded to the GPU, and counted in the report. Index of a
/// column: column = (image * height + y) * width + x; of a layer texel: texel = ((image * layers + layer) * height + y)
/// * width + x.
struct LayerStack {
  Basis basis = Basis::Lpt;
  int width = 0, height = 0, images = 0, layers = 0;
  int channels = 2;
  int bits = 8;
  /// Ranges, one per channel and coefficient: [channel][perColumn()], for PTM and Constant shared by all layers.
  std::vector<CoefficientRange> ranges;
  /// LPT: [column][channel][10]; PTM: [texel][channel][6]; Constant: [texel][channel]. One byte each, or two
  /// (little-endian) for 16 bits.
  std::vector<std::uint8_t> coefficients;
  /// RGBA8 per texel: square root of the linear reflectance (straight), coverage (linear).
  std::vector<std::uint8_t> surface;
  /// RGBA8 per texel: square root of the linear transmittance; alpha unused (255). Empty for opaque stacks (soil).
  std::vector<std::uint8_t> transmission;
  /// RG8 per texel: skyReflected, skyTransmitted, linear.
  std::vector<std::uint8_t> sky;
  /// Of an LPT: what its columns share (Fit::common); empty: coefficients are those of lptBasis.
  CommonResponse common;

  std::size_t columnCount() const {
    return static_cast<std::size_t>(images) * static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  }
  std::size_t texelCount() const { return columnCount() * static_cast<std::size_t>(layers); }
  int perColumn() const { return stackCoefficients(basis); }
  /// Of what coefficients belong to: columns (LPT) or texels (PTM, Constant).
  std::size_t itemCount() const { return basis == Basis::Lpt ? columnCount() : texelCount(); }
  std::size_t lightingBytes() const { return coefficients.size() + common.bytes(); }
  std::size_t totalBytes() const { return lightingBytes() + surface.size() + transmission.size() + sky.size(); }
};

/// Unquantised layers in the same order, as a bake assembles them.
struct LayerStackInput {
  Basis basis = Basis::Lpt;
  int width = 0, height = 0, images = 1, layers = 0, channels = 2;
  std::vector<float> coefficients;       ///< [column][channel][10], [texel][channel][6] or [texel][channel]
  std::vector<float> coverage;           ///< per texel
  std::vector<glm::vec3> reflectance;    ///< per texel; anything where coverage is 0
  std::vector<glm::vec3> transmittance;  ///< per texel, or empty
  std::vector<glm::vec2> sky;            ///< per texel
  CommonResponse common;                 ///< of an LPT, or empty
};

/// Ranges from the data (with options.clampQuantile cut off; values that are not finite count for nothing), rounding to
/// nearest. Throws ContractError when sizes do not match. Where coverage is 0, colour and sky
/// are filled from covered neighbours of the same layer image (pull-push; across `periodic` borders), so that filtering
/// does not darken outlines.
LayerStack quantise(const LayerStackInput& input, const FitOptions& options, bool periodic, const JobContext& job);

/// Coefficients of a column (LPT) or texel (PTM) as floats again; out has perColumn() values.
void dequantise(const LayerStack& stack, std::size_t columnOrTexel, int channel, std::span<float> out);

/// Light that falls on a stack: sun and sky as the renderer passes them.
struct Illumination {
  glm::dvec3 sunDirection{0.0, 0.0, 1.0};  ///< unit, toward the sun
  glm::dvec3 sunIrradiance{3.14159265};    ///< on a plane facing the sun
  glm::dvec3 skyRadiance{0.0};             ///< mean sky radiance
};

/// The CPU's relighting of one texel, the same as shaders/relight: radiance =
/// (r max(f_r, 0) + t max(f_t, 0)) E_sun / pi + (r s_r + t s_t) L_sky, and straight coverage in alpha. A sun below the
/// horizon (z < 0) gives no sun term. Arithmetic in float, in this order: f_c = A + u (B + u C) with u = layer /
/// layers, A, B and C as atLight has them (PTM: A alone); with a common response, that plus A + g (B + g C), g the
/// texel's coordinate and A, B, C by their power in responseBasis. Colours decoded as (byte / 255)^2.
glm::vec4 relitTexel(const LayerStack& stack, int image, int layer, int x, int y, const Illumination& light);

/// Cache payload. load returns false on damaged data and leaves `stack` as it was.
void save(base::ByteWriter& out, const LayerStack& stack);
bool load(base::ByteReader& in, LayerStack& stack);

}  // namespace sward::lpt
