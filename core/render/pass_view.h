#pragma once

#include "gpu/program.h"
#include "render/renderer.h"

namespace sward::render {

/// Where in its pixel a sample looks, from the middle, in the picture's [-1, 1].
glm::dvec2 sampleOffset(const Frame& frame, int sample);

/// Sets the rays of one sample of a frame (shaders/ground/view.glsl): the camera, the sample's place in its pixels, and
/// what shifts the pixels' random numbers.
void setView(gpu::Program& program, const Frame& frame, int sample);

}  // namespace sward::render
