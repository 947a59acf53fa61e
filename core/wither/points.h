#pragma once

#include "base/job.h"
#include "base/result.h"
#include "wither/season.h"
#include "wither/strand.h"
#include "wither/texel.h"

#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

namespace sward::wither {

/// The point based structure (TVT paper, section 2.3): points that stand for a texel's leaves. Arrays of one length.
struct Points {
  std::vector<glm::vec3> positions;  ///< metres, in the texel's block, may leave it sideways
  std::vector<glm::vec3> normals;    ///< unit; zero: a vein
  std::vector<glm::vec3> tangents;   ///< unit or zero
  std::vector<glm::vec3> diffuse;
  std::vector<glm::vec3> transmitted;
  std::vector<float> specular;
  std::vector<float> areaM2;  ///< the leaf area a point stands for: its mass
  std::vector<Attachment> attachments;

  std::size_t size() const { return positions.size(); }
  bool empty() const { return positions.empty(); }
};

}  // namespace sward::wither
