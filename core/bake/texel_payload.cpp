#include "bake/texel_payload.h"

#include "wither/packed_texel.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

namespace sward::bake {
namespace {

constexpr double kSteps = std::numeric_limits<std::uint16_t>::max();

/// Values from 0 to the largest of them, in steps of a 65535th of it.
void saveShares(base::ByteWriter& out, const std::vector<float>& shares) {
  const float most = shares.empty() ? 0.0f : std::max(*std::max_element(shares.begin(), shares.end()), 0.0f);
  std::vector<std::uint16_t> codes(shares.size(), 0);
  if (most > 0.0f) {
    for (std::size_t i = 0; i < shares.size(); ++i) {
      codes[i] = static_cast<std::uint16_t>(
          std::lround(std::clamp(static_cast<double>(shares[i]) / static_cast<double>(most), 0.0, 1.0) * kSteps));
    }
  }
  out.value(most);
  out.array(codes);
}

bool loadShares(base::ByteReader& in, std::vector<float>& shares) {
  float most = 0.0f;
  std::vector<std::uint16_t> codes;
  in.value(most);
  in.array(codes);
  shares.resize(codes.size());
  for (std::size_t i = 0; i < codes.size(); ++i) {
    shares[i] = static_cast<float>(static_cast<double>(most) * codes[i] / kSteps);
  }
  return in.ok() && std::isfinite(most) && most >= 0.0f;
}

std::size_t columnsOf(const wither::TexelGrid& grid) {
  return static_cast<std::size_t>(grid.columns) * static_cast<std::size_t>(grid.columns);
}

/// What a strand holds beside its vein.
struct StrandValues {
  double lengthM = 0.0, bendX = 0.0, bendY = 0.0, delay = 0.0, droop = 0.0;
  std::int64_t sample = 0;
};

void saveStrands(base::ByteWriter& out, const std::vector<wither::Strand>& strands) {
  std::vector<StrandValues> values;
  std::vector<std::uint32_t> lengths;
  std::vector<glm::dvec3> veins;
  for (const wither::Strand& strand : strands) {
    values.push_back({strand.lengthM, strand.bendTo.x, strand.bendTo.y, strand.delay, strand.droop, strand.sample});
    lengths.push_back(static_cast<std::uint32_t>(strand.vein.size()));
    veins.insert(veins.end(), strand.vein.begin(), strand.vein.end());
  }
  out.array(values);
  out.array(lengths);
  out.array(veins);
}

bool loadStrands(base::ByteReader& in, std::vector<wither::Strand>& strands) {
  std::vector<StrandValues> values;
  std::vector<std::uint32_t> lengths;
  std::vector<glm::dvec3> veins;
  in.array(values);
  in.array(lengths);
  in.array(veins);
  if (!in.ok() || values.size() != lengths.size()) return false;
  strands.clear();
  strands.reserve(values.size());
  std::size_t first = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const StrandValues& v = values[i];
    const std::size_t length = lengths[i];
    if (length < 2 || length > veins.size() - first || v.sample < 0 || v.sample > 64) return false;
    wither::Strand& strand = strands.emplace_back();
    const auto begin = veins.begin() + static_cast<std::ptrdiff_t>(first);
    strand.vein.assign(begin, begin + static_cast<std::ptrdiff_t>(length));
    strand.lengthM = v.lengthM;
    strand.bendTo = {v.bendX, v.bendY};
    strand.delay = v.delay;
    strand.droop = v.droop;
    strand.sample = static_cast<int>(v.sample);
    first += length;
  }
  return first == veins.size();
}

bool consistent(const TexelRest& rest) {
  const auto strands = static_cast<std::int64_t>(rest.strands.size());
  return (rest.attachments.empty() || rest.attachments.size() == rest.texel.size()) &&
         rest.soil.size() == columnsOf(rest.texel.grid()) &&
         std::all_of(rest.attachments.begin(), rest.attachments.end(), [&](const wither::Attachment& attachment) {
           return attachment.strand >= -1 && attachment.strand < strands && std::isfinite(attachment.s);
         });
}

bool loadTexel(base::ByteReader& in, wither::Texel& texel) {
  std::vector<std::byte> packed;
  in.array(packed);
  const auto parsed = wither::PackedTexel::parse(packed);
  if (!in.ok() || !parsed.ok()) return false;
  texel = parsed->unpack({});
  return true;
}

bool loadLevel(base::ByteReader& in, TexelBake::Level& level) {
  wither::Texel texel;
  if (!loadTexel(in, texel)) return false;
  level.texel = std::make_shared<const wither::Texel>(std::move(texel));
  const bool sky =
      loadShares(in, level.sky.front) && loadShares(in, level.sky.back) && loadShares(in, level.sky.ground);
  return sky && level.sky.front.size() == level.texel->size() && level.sky.back.size() == level.texel->size() &&
         level.sky.ground.size() == columnsOf(level.texel->grid());
}

}  // namespace

void save(base::ByteWriter& out, const TexelRest& rest) {
  out.array(wither::PackedTexel::pack(rest.texel, {}).serialised());
  out.array(rest.attachments);
  saveStrands(out, rest.strands);
  out.array(rest.soil);
}

bool load(base::ByteReader& in, TexelRest& rest) {
  if (!loadTexel(in, rest.texel)) return false;
  in.array(rest.attachments);
  if (!loadStrands(in, rest.strands)) return false;
  in.array(rest.soil);
  return in.ok() && consistent(rest);
}

void save(base::ByteWriter& out, const TexelBake& bake) {
  out.value(bake.weathering);
  out.array(bake.soil);
  out.value(static_cast<std::uint32_t>(bake.levels.size()));
  for (const TexelBake::Level& level : bake.levels) {
    out.array(wither::PackedTexel::pack(*level.texel, {}).serialised());
    saveShares(out, level.sky.front);
    saveShares(out, level.sky.back);
    saveShares(out, level.sky.ground);
  }
}

bool load(base::ByteReader& in, TexelBake& bake) {
  std::uint32_t levels = 0;
  in.value(bake.weathering);
  in.array(bake.soil);
  in.value(levels);
  if (!in.ok() || levels == 0 || levels > 16) return false;
  bake.levels.resize(levels);
  for (TexelBake::Level& level : bake.levels) {
    if (!loadLevel(in, level)) return false;
  }
  // Each level is half of the one before, down to bricks that cannot be halved.
  for (std::size_t i = 1; i < bake.levels.size(); ++i) {
    const wither::TexelGrid &fine = bake.levels[i - 1].texel->grid(), &coarse = bake.levels[i].texel->grid();
    if (coarse.columns * 2 != fine.columns || coarse.layers * 2 != fine.layers) return false;
  }
  return bake.soil.size() == columnsOf(bake.grid());
}

}  // namespace sward::bake
