#pragma once

#include <cstdint>

namespace sward::render {

/// What the viewport shows of the ground.
enum class ViewQuantity : std::uint8_t {
  Shaded,       ///< the picture itself
  Albedo,       ///< reflectance of the layers, unlit
  Luminance,    ///< response to the sun with white albedo
  Coverage,     ///< opacity of the ray's way through the shell, grey
  Coefficient,  ///< one coefficient of the fit, blue (negative) over white to red
  Visibility,   ///< of the layers' texels
  Condition,    ///< log10 of the fit's condition number, false colours
  Tiles         ///< shaded, with tile borders and a colour an index
};

struct ViewMode {
  ViewQuantity quantity = ViewQuantity::Shaded;
  int layer = -1;       ///< show this slice layer alone; -1: all
  int coefficient = 9;  ///< 0 to 9 (LPT) or 0 to 5 (PTM), for Coefficient
  bool operator==(const ViewMode&) const = default;
};

}  // namespace sward::render
