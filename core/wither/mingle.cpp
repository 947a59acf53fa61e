#include "wither/mingle.h"

#include "base/check.h"
#include "base/parallel.h"
#include "wither/voxel_mean.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace sward::wither {
namespace {

float toFloat(double value) {
  constexpr double kMost = std::numeric_limits<float>::max();
  return static_cast<float>(std::clamp(value, -kMost, kMost));
}

/// A sample's voxels of the brick at hand, in their order.
struct Source {
  const Voxel* next = nullptr;
  const std::array<std::uint64_t, 8>* mask = nullptr;
  double density = 1.0;
};

/// What a sample alone fills.
Voxel scaled(const Voxel& voxel, double density) {
  Voxel out = voxel;
  if (density == 1.0) return out;
  out.density = toFloat(static_cast<double>(voxel.density) * density);
  for (float& s : out.spread) s = toFloat(static_cast<double>(s) * density);
  return out;
}

/// What several samples fill, each with what its next voxel holds.
Voxel mixed(std::span<const Source* const> sources) {
  LeafSums sums;
  for (const Source* source : sources) {
    const Voxel& voxel = *source->next;
    sums.add(voxel, source->density * static_cast<double>(voxel.density));
    for (std::size_t i = 0; i < 6; ++i) sums.spread[i] += source->density * static_cast<double>(voxel.spread[i]);
  }
  if (!(sums.weight > 0.0)) return {};  // densities too small for the product
  Voxel out = sums.means();
  out.density = toFloat(sums.weight);
  for (std::size_t i = 0; i < 6; ++i) out.spread[i] = toFloat(sums.spread[i]);
  return out;
}

using Mask = std::array<std::uint64_t, 8>;

/// Of the samples that have the brick at hand, in order of the mask of all of them.
void mixBrick(std::vector<Source>& sources, const Mask& all, std::span<Voxel> voxels) {
  std::vector<const Source*> here;
  here.reserve(sources.size());
  auto out = voxels.begin();
  for (std::size_t word = 0; word < 8; ++word) {
    for (std::uint64_t rest = all[word]; rest != 0; rest &= rest - 1) {
      const std::uint64_t bit = rest & (~rest + 1);
      here.clear();
      for (const Source& source : sources) {
        if (((*source.mask)[word] & bit) != 0) here.push_back(&source);
      }
      *out = here.size() == 1 ? scaled(*here[0]->next, here[0]->density) : mixed(here);
      // Too small a product for a float still is no empty voxel.
      out->density = std::max(out->density, std::numeric_limits<float>::min());
      ++out;
      for (Source& source : sources) source.next += ((*source.mask)[word] & bit) != 0 ? 1 : 0;
    }
  }
}

/// The samples that have a brick.
void sourcesOf(std::span<const MingleInput> samples, std::size_t brick, std::vector<Source>& sources) {
  sources.clear();
  for (const MingleInput& sample : samples) {
    const std::int32_t stored = sample.texel->bricks()[brick];
    if (stored < 0 || sample.density == 0.0) continue;
    const Texel::Brick& at = sample.texel->stored()[static_cast<std::size_t>(stored)];
    sources.push_back({sample.texel->voxels().data() + at.first, &at.mask, sample.density});
  }
}

Result<void> checkSamples(std::span<const MingleInput> samples) {
  if (samples.empty()) return Error::badInput("there are no samples", "mingling", "Give one at least.");
  for (std::size_t i = 0; i < samples.size(); ++i) {
    SWARD_CHECK(samples[i].texel != nullptr);
    if (!(samples[i].texel->grid() == samples[0].texel->grid())) {
      return Error::badInput("sample " + std::to_string(i) + " has another grid than the first", "mingling",
                             "Make all samples with one side, height and resolution.");
    }
    if (!std::isfinite(samples[i].density) || samples[i].density < 0.0) {
      return Error::badInput("sample " + std::to_string(i) + " has a density of " + std::to_string(samples[i].density),
                             "mingling", "Densities are at least 0.");
    }
  }
  return {};
}

}  // namespace

Result<Texel> mingle(std::span<const MingleInput> samples, const JobContext& job) {
  SWARD_TRY(checkSamples(samples));
  const TexelGrid& grid = samples[0].texel->grid();
  if (grid.columns == 0) return Texel();
  std::vector<std::uint32_t> bricks;
  std::vector<Mask> masks;
  std::vector<Source> sources;
  for (std::size_t brick = 0; brick < grid.brickCount(); ++brick) {
    sourcesOf(samples, brick, sources);
    if (sources.empty()) continue;
    bricks.push_back(static_cast<std::uint32_t>(brick));
    masks.emplace_back();
    for (const Source& source : sources) {
      for (std::size_t word = 0; word < 8; ++word) masks.back()[word] |= (*source.mask)[word];
    }
  }
  Texel texel = Texel::fromMasks(
      grid, bricks, masks,
      [&](std::size_t i, std::span<Voxel> voxels) {
        std::vector<Source> here;
        sourcesOf(samples, bricks[i], here);
        mixBrick(here, masks[i], voxels);
      },
      job);
  if (job.cancelled()) return Error::cancelled();
  return texel;
}

Result<Texel> lerp(const Texel& a, const Texel& b, double t, const JobContext& job) {
  const double share = std::isfinite(t) ? std::clamp(t, 0.0, 1.0) : 0.0;
  const std::array<MingleInput, 2> samples{MingleInput{&a, 1.0 - share}, MingleInput{&b, share}};
  return mingle(samples, job);
}

}  // namespace sward::wither
