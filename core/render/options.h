#pragma once

#include <cstdint>
#include <string>

namespace sward::render {

enum class GroundMethod : std::uint8_t {
  March,              ///< front to back through the layers in one pass, parallax, early out
  BlendedNormalised,  ///< slices and blades blended as planes, weights that sum to 1
  BlendedPaper,       ///< the same with the paper's weights
  Texels              ///< voxels that age, marched front to back, in place of the layers
};
enum class ViewTransform : std::uint8_t { Filmic, Standard };

struct RenderOptions {
  GroundMethod method = GroundMethod::March;
  ViewTransform viewTransform = ViewTransform::Filmic;
  double bladeAngleDeg = 30.0;  ///< theta0: blades fade out where the view is steeper than 90 - theta0 from the horizon
  int samples = 16;             ///< sub-pixel samples of a picture
  double macroVariation = 0.12;  ///< relative brightness variation over metres; 0: none
  double macroScaleM = 6.0;
  /// Largest shift of the tiles' grid by slow waves, so that its rows run to no vanishing point; 0: none. A ray takes
  /// the shift of the place where it enters the shell.
  double gridBendM = 0.7;
  bool operator==(const RenderOptions&) const = default;
};

}  // namespace sward::render
