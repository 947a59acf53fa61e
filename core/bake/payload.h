#pragma once

#include "bake/ground_bake.h"
#include "lpt/fit.h"
#include "tiles/tile_set.h"
#include "trace/layers.h"

#include <optional>
#include <vector>

namespace sward::bake {

/// Cache payloads of everything that goes to disk.
void save(base::ByteWriter& out, const GroundBake& ground);
/// False on damaged data, also when sizes do not fit one another.
bool load(base::ByteReader& in, GroundBake& ground);

template <typename T>
std::vector<std::byte> payloadOf(const T& value) {
  base::ByteWriter out;
  save(out, value);
  return out.take();
}

template <typename T>
std::optional<T> fromPayload(std::span<const std::byte> payload) {
  base::ByteReader in(payload);
  T value;
  if (!load(in, value) || !in.finished()) return std::nullopt;
  return value;
}

}  // namespace sward::bake
