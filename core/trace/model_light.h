#pragma once

#include "base/job.h"
#include "base/result.h"
#include "trace/model_scene.h"

#include <vector>

#include <glm/glm.hpp>

namespace sward::trace {

/// What a free-standing model's vertices see of the light, traced from them: what a tree is lit by that casts no shadow
/// map. A renderer interpolates between vertices, of which leaves have four each and bark a few to the decimetre.

/// Part of a sun without a size that each vertex sees, 0 or 1, or between where leaves have alpha (kAlphaRays rays
/// then). Vertices start a little along the light, so that their own surface does not hide it. `toSun`: unit; a sun at
/// or under the horizon lights nothing. Errors: Error::cancelled().
Result<std::vector<float>> sunOnVertices(const ModelScene& scene, const glm::dvec3& toSun, const JobContext& job);
inline constexpr int kAlphaRays = 4;

/// Cosine-weighted shares of the upper hemisphere that the two sides of a vertex see, as in wither::TexelSky: of a
/// level leaf in the open 1 and 0. The model alone hides it, not the ground.
struct VertexSky {
  std::vector<float> front, back;
};
/// `directions` of the sky a vertex, 1 to 1024: Fibonacci's lattice of equal solid angles, turned anew for every vertex
/// (base/random.h), so that no direction of it shows. Errors: Error::cancelled().
Result<VertexSky> skyOnVertices(const ModelScene& scene, int directions, const JobContext& job);

}  // namespace sward::trace
