#pragma once

#include "bake/ground_bake.h"
#include "bake/inspection.h"
#include "lpt/fit.h"
#include "lpt/layer_stack.h"
#include "lpt/representation.h"
#include "mesh/model.h"
#include "scene/patch.h"
#include "tiles/tile_set.h"
#include "trace/layers.h"

#include <cstdint>
#include <memory>

namespace sward::bake {

/// A representation as a node's result.
struct HeldRepresentation {
  std::unique_ptr<const lpt::Representation> value;
};

/// Bytes that a result takes in memory, about: what the memory cache counts.
std::uint64_t memoryBytes(const trace::LayerSurface& surface);
std::uint64_t memoryBytes(const trace::LayerHits& hits);
std::uint64_t memoryBytes(const trace::LayerLuminance& luminance);
std::uint64_t memoryBytes(const trace::LayerVisibility& visibility);
std::uint64_t memoryBytes(const lpt::Fit& fit);
std::uint64_t memoryBytes(const lpt::LayerStack& stack);
std::uint64_t memoryBytes(const Inspection& inspection);
std::uint64_t memoryBytes(const tiles::TileSet& set);
std::uint64_t memoryBytes(const tiles::TileMap& map);
std::uint64_t memoryBytes(const mesh::Model& model);
std::uint64_t memoryBytes(const scene::Patch& patch);
std::uint64_t memoryBytes(const GroundBake& ground);
std::uint64_t memoryBytes(const HeldRepresentation& representation);

}  // namespace sward::bake
