#pragma once

#include "gpu/objects.h"
#include "scene/sun_sky.h"

namespace sward::render {

/// The sky as shaders/ground/sky.glsl reads it: columns by the azimuth's diamond angle, rows by the square root of the
/// direction's height, row 0 the horizon.
gpu::Texture makeSkyTexture(const scene::Daylight& daylight);

/// 256 x 256 random pairs for the macro variation, repeating, linearly filtered.
gpu::Texture makeNoiseTexture();

}  // namespace sward::render
