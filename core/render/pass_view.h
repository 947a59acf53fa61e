#pragma once

#include "bake/ground_bake.h"
#include "gpu/program.h"
#include "render/renderer.h"

namespace sward::render {

/// Where in its pixel a sample looks, from the middle, in the picture's [-1, 1].
glm::dvec2 sampleOffset(const Frame& frame, int sample);

/// Sets the rays of one sample of a frame (shaders/ground/view.glsl): the camera, the sample's place in its pixels, and
/// what shifts the pixels' random numbers.
void setView(gpu::Program& program, const Frame& frame, int sample);

/// Sets where the eye stands on the ground's map, and what the map's grid is bent by (shaders/ground/surface.glsl).
/// World origin is the south-west corner of the map's middle cell; cells repeat beyond the map. Shaders count cells
/// from the eye's own, so that floats stay small.
void setPlace(gpu::Program& program, const bake::GroundBake& ground, const Frame& frame);

}  // namespace sward::render
