#pragma once

#include "gpu/objects.h"
#include "scene/sun_sky.h"

namespace sward::render {

/// The sky as shaders/ground/sky.glsl reads it: columns by the azimuth's diamond angle, rows by the square root of the
/// direction's height, row 0 the horizon.
gpu::Texture makeSkyTexture(const scene::Daylight& daylight);

/// The horizon's radiance by the azimuth's diamond angle from -1/4 on, RGBA floats, for the haze.
gpu::Buffer makeHorizonBuffer(const scene::Daylight& daylight);

}  // namespace sward::render
