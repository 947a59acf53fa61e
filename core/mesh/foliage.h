#pragma once

#include "mesh/model.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace sward::mesh {

/// What a part of a tree is.
enum class TreePart : std::uint8_t { Wood, Leaves };

/// Which materials of a tree are wood and which are leaves, and why: for people, who may say otherwise.
struct MaterialPart {
  TreePart part = TreePart::Leaves;
  std::string reason;
};
/// One for each of the model's materials, by the first of these that decides:
///   its name (bark, trunk, wood, branch; leaf, leaves, foliage, needles and their like, in English, German, French and
///   Latin), whose words are told apart at capitals, digits and punctuation;
///   a cut-out or blended alpha: leaves;
///   open surfaces alone, several of them or above the foot: leaves on cards (trunks are open too, at their end);
///   where its triangles begin: wood reaches down to the foot, within kFootShare of the height;
///   a grey colour (birch bark above the foot): wood; else leaves.
std::vector<MaterialPart> treeParts(const Model& model);
inline constexpr double kFootShare = 0.06;

/// The same for every triangle.
std::vector<TreePart> triangleParts(const Model& model, const std::vector<MaterialPart>& parts);

}  // namespace sward::mesh
