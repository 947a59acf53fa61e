#pragma once

#include "base/result.h"
#include "mesh/model.h"
#include "scene/patch.h"
#include "wither/season.h"
#include "wither/strand.h"

#include <functional>
#include <span>
#include <vector>

#include <glm/glm.hpp>

namespace sward::wither {

/// Turns the colours of a leaf at rest (reflectance and transmittance, linear RGB) into those it has at these shares.
/// Empty: colours stay. Called from several threads at once.
using AgeColour = std::function<void(glm::vec3& diffuse, glm::vec3& transmitted, const Season::Shares& shares)>;

/// The moment of the season at which each mingle sample is when the sward has a weathering degree: its own ageing curve
/// (cut to [0, 1]) first, then the sward's. At least one entry, of all blades where nothing is mingled.
class SampleSeasons {
 public:
  SampleSeasons(const Season& season, std::span<const MingleSample> samples, double weathering);
  /// Samples that are not there count as the first.
  double operator[](int sample) const;

 private:
  std::vector<double> m_seasons;
};

/// The mesh at a weathering degree: vertices moved with their strands, normals turned, colours aged vertex by vertex.
/// Vertex colours multiply textures and factors, so a textured part is aged as its mean colour would be, and
/// reflectance and transmittance change alike, as LeafOptics ties them. At a moment of 0 the mesh is returned as it is.
/// Errors: strands of another mesh.
Result<mesh::Model> withered(const mesh::Model& plant, const Strands& strands, const Season& season,
                             std::span<const MingleSample> samples, double weathering, const AgeColour& colour);

/// A patch whose every blade has withered in its own way: each model becomes one mesh of all its plants, in the patch's
/// space, placed once. heightM is the new top. For references; a patch of models that wither each in one way is
/// smaller. Errors: strands of another patch.
Result<scene::Patch> withered(const scene::Patch& patch, const PatchStrands& strands, const Season& season,
                              std::span<const MingleSample> samples, double weathering, const AgeColour& colour);

}  // namespace sward::wither
