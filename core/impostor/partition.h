#pragma once

#include "base/result.h"
#include "impostor/picture_error.h"
#include "mesh/model.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace sward::impostor {

/// Number of parts that the 2008 paper cuts a tree into.
inline constexpr int kDefaultParts = 14;

/// A model cut into parts, each of which is drawn on a plane of its own (2008 paper).
struct Partition {
  std::vector<std::uint32_t> ofTriangle;  ///< [triangle] -> part
  std::vector<Box> boxes;                 ///< [part], about its triangles
  /// Mean over the model's surface of the squared distance to its part's centre, m^2: what displacement errors grow
  /// with.
  double spreadM2 = 0.0;
};

/// Cuts a model so that parts are compact: k-means over the triangles' middles, weighted by area, seeded by k-means++
/// (Arthur and Vassilvitskii 2007), Lloyd's steps until nothing moves, at most 60. Triangles that hang together and are
/// small (a leaf, a card: under a tenth of the model across) stay together. No part is empty: a model of fewer pieces
/// than `parts` has as many parts as pieces. The same seed gives the same cut. Errors: parts not in [1, 4096].
Result<Partition> partition(const mesh::Model& model, int parts, std::uint64_t seed);

}  // namespace sward::impostor
