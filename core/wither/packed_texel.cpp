#include "wither/packed_texel.h"

#include "base/bytes.h"
#include "base/parallel.h"
#include "trace/layers.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace sward::wither {
namespace {

constexpr std::uint32_t kMagic = 0x31545753;  ///< "SWT1"
constexpr double kDensitySteps = 65535.0;
constexpr int kNormalMost = 2047, kTangentMost = 127;  ///< codes go from -most to most; -most - 1 means zero
constexpr std::size_t kVoxels = 4096;                  ///< packed by one task

std::uint8_t unit8(double value) {
  return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0, 1.0) * 255.0));
}

using Colour = std::array<std::uint8_t, 3>;
Colour packColour(const glm::vec3& colour) {
  const auto code = [](float value) { return unit8(std::sqrt(std::max(static_cast<double>(value), 0.0))); };
  return {code(colour.x), code(colour.y), code(colour.z)};
}
glm::vec3 unpackColour(const Colour& code) {
  const glm::vec3 root = glm::vec3(code[0], code[1], code[2]) / 255.0f;
  return root * root;
}

/// Octahedral coordinates, each from -most to most.
std::array<int, 2> packDirection(const glm::vec3& direction, int most) {
  if (direction == glm::vec3(0.0f)) return {-most - 1, 0};
  const std::array<std::int16_t, 2> fine = trace::encodeNormal(direction);
  const auto coarse = [&](std::int16_t code) { return static_cast<int>(std::lround(code * most / 32767.0)); };
  return {coarse(fine[0]), coarse(fine[1])};
}
glm::vec3 unpackDirection(int x, int y, int most) {
  if (x < -most) return glm::vec3(0.0f);
  const auto fine = [&](int code) { return static_cast<std::int16_t>(std::lround(code * 32767.0 / most)); };
  return trace::decodeNormal({fine(x), fine(y)});
}

/// Entries over the density. The diagonal's largest is what the others leave of the trace: so the trace has the error
/// of one code, and none where it is the density.
std::array<std::int8_t, 6> packSpread(const Voxel& voxel) {
  const auto share = [&](std::size_t i) {
    return static_cast<double>(voxel.spread[i]) / static_cast<double>(voxel.density);
  };
  std::array<long, 3> diagonal{};
  constexpr std::array<std::size_t, 3> kDiagonal{0, 3, 5};
  double trace = 0.0;
  std::size_t largest = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    trace += share(kDiagonal[i]);
    diagonal[i] = unit8(share(kDiagonal[i]));
    if (share(kDiagonal[i]) > share(kDiagonal[largest])) largest = i;
  }
  long rest = unit8(trace);
  for (std::size_t i = 0; i < 3; ++i) rest -= i == largest ? 0 : diagonal[i];
  diagonal[largest] = std::clamp(rest, 0l, 255l);
  std::array<std::int8_t, 6> code{};
  for (std::size_t i = 0; i < 3; ++i) code[kDiagonal[i]] = static_cast<std::int8_t>(diagonal[i] - 128);
  // |S_ij| is at most half the trace: the mean of two entries of the diagonal bounds it.
  for (const std::size_t i : {1u, 2u, 4u}) {
    code[i] = static_cast<std::int8_t>(std::lround(std::clamp(2.0 * share(i), -1.0, 1.0) * 127.0));
  }
  return code;
}

std::size_t countOf(const std::array<std::uint64_t, 8>& mask) {
  int count = 0;
  for (const std::uint64_t word : mask) count += std::popcount(word);
  return static_cast<std::size_t>(count);
}

}  // namespace

PackedTexel::Code PackedTexel::codeOf(const Voxel& voxel) const {
  Code code;
  const double place =
      m_logRange > 0.0 ? (std::log(static_cast<double>(voxel.density)) - m_logLeast) / m_logRange : 0.0;
  code.density = static_cast<std::uint16_t>(std::lround(std::clamp(place, 0.0, 1.0) * kDensitySteps));
  const std::array<int, 2> normal = packDirection(voxel.normal, kNormalMost);
  const auto both = static_cast<std::uint32_t>(normal[0] + kNormalMost + 1) |
                    static_cast<std::uint32_t>(normal[1] + kNormalMost + 1) << 12;
  code.normal = {static_cast<std::uint8_t>(both), static_cast<std::uint8_t>(both >> 8),
                 static_cast<std::uint8_t>(both >> 16)};
  const std::array<int, 2> tangent = packDirection(voxel.tangent, kTangentMost);
  code.tangent = {static_cast<std::int8_t>(tangent[0]), static_cast<std::int8_t>(tangent[1])};
  code.diffuse = packColour(voxel.diffuse);
  code.transmitted = packColour(voxel.transmitted);
  code.specular = unit8(static_cast<double>(voxel.specular));
  code.spread = packSpread(voxel);
  return code;
}

Voxel PackedTexel::voxelOf(const Code& code) const {
  Voxel voxel;
  const double density = std::exp(m_logLeast + code.density / kDensitySteps * m_logRange);
  voxel.density = static_cast<float>(
      std::clamp(density, double{std::numeric_limits<float>::min()}, double{std::numeric_limits<float>::max()}));
  const std::uint32_t both = code.normal[0] | std::uint32_t{code.normal[1]} << 8 | std::uint32_t{code.normal[2]} << 16;
  voxel.normal = unpackDirection(static_cast<int>(both & 0xfff) - kNormalMost - 1,
                                 static_cast<int>(both >> 12) - kNormalMost - 1, kNormalMost);
  voxel.tangent = unpackDirection(code.tangent[0], code.tangent[1], kTangentMost);
  voxel.diffuse = unpackColour(code.diffuse);
  voxel.transmitted = unpackColour(code.transmitted);
  voxel.specular = code.specular / 255.0f;
  for (const std::size_t i : {0u, 3u, 5u}) voxel.spread[i] = voxel.density * ((code.spread[i] + 128) / 255.0f);
  for (const std::size_t i : {1u, 2u, 4u}) voxel.spread[i] = voxel.density * (code.spread[i] / 254.0f);
  return voxel;
}

PackedTexel PackedTexel::pack(const Texel& texel, const JobContext& job) {
  PackedTexel packed;
  packed.m_grid = texel.grid();
  const auto bricks = texel.bricks();
  for (std::size_t i = 0; i < bricks.size(); ++i) {
    if (bricks[i] < 0) continue;
    packed.m_bricks.push_back(static_cast<std::uint32_t>(i));
    packed.m_masks.push_back(texel.stored()[static_cast<std::size_t>(bricks[i])].mask);
  }
  if (texel.empty()) return packed;
  float least = std::numeric_limits<float>::max(), largest = 0.0f;
  for (const Voxel& voxel : texel.voxels()) {
    least = std::min(least, voxel.density);
    largest = std::max(largest, voxel.density);
  }
  packed.m_logLeast = std::log(static_cast<double>(least));
  packed.m_logRange = std::log(static_cast<double>(largest)) - packed.m_logLeast;
  packed.m_codes.resize(texel.size());
  base::parallelFor(job, texel.size(), kVoxels, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) packed.m_codes[i] = packed.codeOf(texel.voxels()[i]);
  });
  return packed;
}

Texel PackedTexel::unpack(const JobContext& job) const {
  std::vector<std::size_t> first;
  first.reserve(m_masks.size());
  std::size_t next = 0;
  for (const auto& mask : m_masks) {
    first.push_back(next);
    next += countOf(mask);
  }
  return Texel::fromMasks(
      m_grid, m_bricks, m_masks,
      [&](std::size_t i, std::span<Voxel> voxels) {
        for (std::size_t v = 0; v < voxels.size(); ++v) voxels[v] = voxelOf(m_codes[first[i] + v]);
      },
      job);
}

std::uint64_t PackedTexel::bytes() const {
  return m_bricks.size() * sizeof(m_bricks[0]) + m_masks.size() * sizeof(m_masks[0]) + m_codes.size() * sizeof(Code);
}

std::vector<std::byte> PackedTexel::serialised() const {
  base::ByteWriter writer;
  writer.value(kMagic);
  writer.value(m_grid.columns);
  writer.value(m_grid.layers);
  writer.value(m_grid.sideM);
  writer.value(m_grid.heightM);
  writer.value(m_logLeast);
  writer.value(m_logRange);
  writer.array(m_bricks);
  writer.array(m_masks);
  writer.array(m_codes);
  return writer.take();
}

Result<PackedTexel> PackedTexel::parse(std::span<const std::byte> bytes) {
  base::ByteReader reader(bytes);
  PackedTexel packed;
  std::uint32_t magic = 0;
  reader.value(magic);
  reader.value(packed.m_grid.columns);
  reader.value(packed.m_grid.layers);
  reader.value(packed.m_grid.sideM);
  reader.value(packed.m_grid.heightM);
  reader.value(packed.m_logLeast);
  reader.value(packed.m_logRange);
  reader.array(packed.m_bricks);
  reader.array(packed.m_masks);
  reader.array(packed.m_codes);
  if (magic != kMagic || !reader.finished()) {
    return Error::failed("a key frame's bytes are damaged", "texel", "It is made anew from its project.");
  }
  SWARD_TRY(packed.check());
  return packed;
}

Result<void> PackedTexel::check() const {
  // A texel that was never given a grid packs to one without bricks.
  const bool none = m_grid.columns == 0 && m_grid.layers == 0 && m_bricks.empty();
  if (!none) SWARD_TRY(checkGrid(m_grid));
  const bool logs = std::isfinite(m_logLeast) && std::isfinite(m_logRange) && m_logRange >= 0.0;
  const bool ascending = std::adjacent_find(m_bricks.begin(), m_bricks.end(), std::greater_equal<>()) == m_bricks.end();
  const bool inside = m_bricks.empty() || m_bricks.back() < m_grid.brickCount();
  std::size_t voxels = 0;
  bool filled = true;
  for (const auto& mask : m_masks) {
    const std::size_t count = countOf(mask);
    filled = filled && count > 0;
    voxels += count;
  }
  if (logs && ascending && inside && filled && m_masks.size() == m_bricks.size() && voxels == m_codes.size()) return {};
  return Error::failed("a key frame's bytes contradict each other", "texel", "It is made anew from its project.");
}

}  // namespace sward::wither
