#pragma once

#include "bake/ground_bake.h"
#include "bake/inspection.h"
#include "base/result.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include <glm/glm.hpp>

namespace sward::render {

/// What the viewport shows of the ground. All but Shaded are drawn over a plain backdrop instead of the sky, without
/// haze, macro variation and filmic transform: values mean what the legend says.
enum class ViewQuantity : std::uint8_t {
  Shaded,       ///< the picture itself
  Albedo,       ///< reflectance of the layers, unlit
  Luminance,    ///< response to the sun of white leaves in white light: 1 where it falls square on them
  Coverage,     ///< opacity of the ray's way through the shell, grey
  Coefficient,  ///< one coefficient of the fit, blue (negative) over white to red
  Visibility,   ///< of the layers' texels; needs an inspection
  Condition,    ///< log10 of the fit's condition number, false colours; needs an inspection
  Tiles         ///< shaded, with tile borders and a colour an index
};

/// Which side of leaves Luminance and Coefficient show: lpt::kReflected, lpt::kTransmitted.
enum class ResponseChannel : std::uint8_t { Reflected, Transmitted };

struct ViewMode {
  ViewQuantity quantity = ViewQuantity::Shaded;
  int layer = -1;       ///< show this slice layer alone (0 the top), over the backdrop; -1: all
  int coefficient = 9;  ///< 0 to 9 (LPT) or 0 to 5 (PTM), for Coefficient
  ResponseChannel channel = ResponseChannel::Reflected;  ///< for Luminance and Coefficient
  bool operator==(const ViewMode&) const = default;

  /// Whether the picture is just the picture.
  bool plain() const { return quantity == ViewQuantity::Shaded && layer < 0; }
  /// Whether colours stand for a number, along a legend's stops.
  bool scalar() const;
  /// Whether Renderer::setInspection() is needed.
  bool needsInspection() const { return quantity == ViewQuantity::Visibility || quantity == ViewQuantity::Condition; }
};

using ByteColour = std::array<std::uint8_t, 3>;  ///< sRGB

/// How to read a view mode, for the UI to draw.
struct Legend {
  struct Stop {
    double at;  ///< along the bar, 0 to 1
    ByteColour colour;
  };
  struct Tick {
    double at;
    std::string text;
  };
  struct Swatch {
    std::string text;
    ByteColour colour;
  };
  std::string title;             ///< empty for Shaded
  double low = 0.0, high = 1.0;  ///< values at the bar's ends; logarithms for Condition
  std::vector<Stop> stops;       ///< straight lines in sRGB between them, at 0 and 1 the ends; none: no bar
  std::vector<Tick> ticks;
  std::vector<Swatch> swatches;  ///< Tiles: one a tile
};
/// `inspection` gives Condition its range; without one its ends are unnamed.
Legend legendOf(const ViewMode& mode, const bake::GroundBake& ground, const bake::Inspection* inspection = nullptr);

/// What stands where a view mode shows no ground: dark, or mid-grey behind the dark leaves of one layer alone.
ByteColour backdropOf(const ViewMode& mode);

/// Colour of a tile's index, linear; also tileColour() of shaders/include/quantity.glsl.
glm::vec3 tileColour(int tile);

/// What a legend shows of coefficient j of a channel to either side of 0: the absolute value that all but two in a
/// hundred of the grass's coefficients stay within; above 0.
double coefficientRange(const bake::GroundBake& ground, ResponseChannel channel, int coefficient);

/// Errors: a layer or coefficient that the ground does not have.
Result<void> checkMode(const ViewMode& mode, const bake::GroundBake& ground);

}  // namespace sward::render
