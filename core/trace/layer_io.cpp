#include "trace/layers.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sward::trace {
namespace {

static_assert(sizeof(Hit) == 28, "hits are stored as they lie in memory: no padding");

void saveUnorm(base::ByteWriter& out, const std::vector<float>& values) {
  std::vector<std::uint16_t> packed;
  packed.reserve(values.size());
  for (const float x : values) {
    packed.push_back(static_cast<std::uint16_t>(std::lround(std::clamp(x, 0.0f, 1.0f) * 65535.0f)));
  }
  out.array(packed);
}

void loadUnorm(base::ByteReader& in, std::vector<float>& values) {
  std::vector<std::uint16_t> packed;
  in.array(packed);
  values.clear();
  values.reserve(packed.size());
  for (const std::uint16_t x : packed) values.push_back(static_cast<float>(x) * (1.0f / 65535.0f));
}

/// Starts of consecutive ranges over `total` items, each range at least `least` long.
bool areStarts(const std::vector<std::uint32_t>& starts, std::size_t ranges, std::size_t total, std::uint32_t least) {
  if (starts.size() != ranges + 1 || starts.front() != 0 || starts.back() != total) return false;
  for (std::size_t i = 0; i < ranges; ++i) {
    if (starts[i + 1] < starts[i] || starts[i + 1] - starts[i] < least) return false;
  }
  return true;
}

bool areConsistent(const LayerHits& hits) {
  const LayerShape& shape = hits.shape;
  if (static_cast<std::size_t>(hits.set) >= kAllLayerSets.size()) return false;
  if (shape.width < 1 || shape.height < 1 || shape.layers < 1 || shape.layers > 256 || hits.subSamples < 1)
    return false;
  if (std::int64_t{shape.width} * shape.height > std::numeric_limits<std::int32_t>::max()) return false;
  if (!areStarts(hits.columnStart, static_cast<std::size_t>(shape.columns()), hits.layer.size(), 0)) return false;
  if (!areStarts(hits.hitStart, hits.layer.size(), hits.hits.size(), 1)) return false;
  for (std::size_t t = 0; t < hits.layer.size(); ++t) {
    if (hits.layer[t] >= shape.layers) return false;
    if (hits.hitStart[t + 1] - hits.hitStart[t] > static_cast<std::uint32_t>(hits.subSamples)) return false;
  }
  for (std::size_t c = 0; c < static_cast<std::size_t>(shape.columns()); ++c) {
    for (std::uint32_t t = hits.columnStart[c]; t + 1 < hits.columnStart[c + 1]; ++t) {
      if (hits.layer[t] >= hits.layer[t + 1]) return false;
    }
  }
  return std::all_of(hits.hits.begin(), hits.hits.end(), [](const Hit& hit) {
    return std::isfinite(hit.position.x) && std::isfinite(hit.position.y) && std::isfinite(hit.position.z);
  });
}

}  // namespace

void save(base::ByteWriter& out, const LayerHits& hits) {
  out.value(static_cast<std::uint8_t>(hits.set));
  out.value(hits.shape);
  out.value(static_cast<std::int32_t>(hits.subSamples));
  out.array(hits.columnStart);
  out.array(hits.layer);
  out.array(hits.hitStart);
  out.array(hits.hits);
}

bool load(base::ByteReader& in, LayerHits& hits) {
  std::uint8_t set = 0;
  std::int32_t subSamples = 0;
  in.value(set);
  in.value(hits.shape);
  in.value(subSamples);
  in.array(hits.columnStart);
  in.array(hits.layer);
  in.array(hits.hitStart);
  in.array(hits.hits);
  hits.set = static_cast<LayerSet>(set);
  hits.subSamples = subSamples;
  if (in.ok() && areConsistent(hits)) return true;
  hits = {};
  return false;
}

void save(base::ByteWriter& out, const LayerLuminance& luminance) {
  saveUnorm(out, luminance.reflected);
  saveUnorm(out, luminance.transmitted);
}

bool load(base::ByteReader& in, LayerLuminance& luminance) {
  loadUnorm(in, luminance.reflected);
  loadUnorm(in, luminance.transmitted);
  if (in.ok() && luminance.reflected.size() == luminance.transmitted.size()) return true;
  luminance = {};
  return false;
}

void save(base::ByteWriter& out, const LayerVisibility& visibility) {
  saveUnorm(out, visibility.visibility);
  saveUnorm(out, visibility.skyReflected);
  saveUnorm(out, visibility.skyTransmitted);
}

bool load(base::ByteReader& in, LayerVisibility& visibility) {
  loadUnorm(in, visibility.visibility);
  loadUnorm(in, visibility.skyReflected);
  loadUnorm(in, visibility.skyTransmitted);
  const std::size_t size = visibility.visibility.size();
  if (in.ok() && visibility.skyReflected.size() == size && visibility.skyTransmitted.size() == size) return true;
  visibility = {};
  return false;
}

}  // namespace sward::trace
