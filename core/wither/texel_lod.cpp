#include "wither/texel_lod.h"

#include "base/parallel.h"
#include "wither/extinction.h"
#include "wither/voxel_mean.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace sward::wither {
namespace {

constexpr int kBrick = TexelGrid::kBrick;
constexpr std::size_t kBricks = 64;  ///< of the coarser texel, made by one task

using Children = std::array<const Voxel*, 8>;  ///< bit 0 of the index x, bit 1 y, bit 2 z; null: empty

/// -ln of the mean of exp(-depth) over four columns; depths of any size: tails of splats are as thin as 1e-30, and the
/// logarithm of what rounds to 1 would call them nothing.
double meanDepth(const std::array<double, 4>& depths) {
  const double least = *std::min_element(depths.begin(), depths.end());
  double hidden = 0.0;
  for (const double depth : depths) hidden -= std::expm1(least - depth);
  return least - std::log1p(-0.25 * hidden);
}

/// extinction() along the three axes.
glm::dvec3 axisExtinctions(const std::array<double, 6>& s) {
  const double trace = 0.625 * (s[0] + s[3] + s[5]);
  return glm::sqrt(glm::dvec3(trace * s[0] + 0.375 * (s[0] * s[0] + s[1] * s[1] + s[2] * s[2]),
                              trace * s[3] + 0.375 * (s[1] * s[1] + s[3] * s[3] + s[4] * s[4]),
                              trace * s[5] + 0.375 * (s[2] * s[2] + s[4] * s[4] + s[5] * s[5])));
}

/// Of the eight children's extinctions along an axis, that of what lets through as much as they do, 1/m.
double extinctionAlong(const std::array<glm::dvec3, 8>& children, int axis, double thicknessM) {
  const std::size_t step = std::size_t{1} << axis;
  std::array<double, 4> depths{};
  std::size_t column = 0;
  for (std::size_t i = 0; i < 8; ++i) {
    if ((i & step) != 0) continue;
    depths[column++] = (children[i][axis] + children[i + step][axis]) * thicknessM;
  }
  return meanDepth(depths) / (2.0 * thicknessM);
}

/// Of x_i (form x)_i = square_i, where `missed` is left at x: the step that would meet it if it were linear. What is 0
/// stays so.
glm::dvec3 newtonStep(const glm::dmat3& form, const glm::dvec3& x, const glm::dvec3& reached, const glm::dvec3& missed,
                      const glm::dvec3& first) {
  glm::dmat3 slope(1.0);  // [column][row]
  glm::dvec3 right(0.0);
  for (int i = 0; i < 3; ++i) {
    if (!(first[i] > 0.0)) continue;
    right[i] = missed[i];
    for (int j = 0; j < 3; ++j) slope[j][i] = x[i] * form[i][j] + (i == j ? reached[i] : 0.0);
  }
  const glm::dvec3 bc = glm::cross(slope[1], slope[2]);
  const double det = glm::dot(slope[0], bc);
  return glm::dvec3(glm::dot(right, bc), glm::dot(right, glm::cross(slope[2], slope[0])),
                    glm::dot(right, glm::cross(slope[0], slope[1]))) /
         det;
}

/// S with rows and columns scaled so that the extinctions along the axes are `sigma`; density its trace.
///
/// With r the correlations of S, its diagonal x has to meet sigma_i^2 = x_i (5 sum_j x_j + 3 sum_j r_ij^2 x_j) / 8. The
/// step x_i <- x_i sigma_i / sigma_i(x) takes log x by half of what the matrix 5 + 3 r^2 (positive, by Schur) lets it
/// miss: the error of log x falls by half each time or faster. Two such steps come near enough for Newton's, whose
/// error is squared each time; should one of them leave the positive numbers, the first kind goes on.
void scaleTo(const std::array<double, 6>& spread, const glm::dvec3& sigma, Voxel& voxel) {
  constexpr std::array<std::array<std::size_t, 3>, 3> kAt{{{0, 1, 2}, {1, 3, 4}, {2, 4, 5}}};
  // An axis along which nothing is to be seen has nothing.
  glm::dvec3 first(spread[0], spread[3], spread[5]);
  for (int i = 0; i < 3; ++i) first[i] = sigma[i] > 0.0 ? first[i] : 0.0;
  glm::dmat3 form(0.0);  // sigma^2 = x (form x)
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const double s = spread[kAt[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)]];
      const bool held = first[i] > 0.0 && first[j] > 0.0;
      form[i][j] = 0.625 + (held ? 0.375 * (s * s / (first[i] * first[j])) : 0.0);
    }
  }
  const glm::dvec3 square = sigma * sigma;  // above 0 where `first` is
  glm::dvec3 x = first;
  for (int step = 0; step < 40; ++step) {
    const glm::dvec3 reached = form * x;
    const glm::dvec3 missed = square - x * reached;
    double most = 0.0;
    for (int i = 0; i < 3; ++i) {
      if (first[i] > 0.0) most = std::max(most, std::abs(missed[i]) / square[i]);
    }
    if (!(most > 1e-8)) break;
    glm::dvec3 next(0.0);
    if (step >= 2) next = x + newtonStep(form, x, reached, missed, first);
    for (int i = 0; i < 3; ++i) {
      if (!(first[i] > 0.0)) next[i] = 0.0;
      if (first[i] > 0.0 && !(next[i] > 0.1 * x[i] && next[i] < 10.0 * x[i])) {
        next[i] = x[i] * sigma[i] / std::sqrt(x[i] * reached[i]);
      }
    }
    x = next;
  }
  glm::dvec3 scale(0.0);
  for (int i = 0; i < 3; ++i) scale[i] = first[i] > 0.0 ? std::sqrt(x[i] / first[i]) : 0.0;
  for (int i = 0; i < 3; ++i) {
    for (int j = i; j < 3; ++j) {
      const std::size_t at = kAt[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
      voxel.spread[at] = static_cast<float>(spread[at] * scale[i] * scale[j]);
    }
  }
  voxel.density = std::max(voxel.spread[0] + voxel.spread[3] + voxel.spread[5], std::numeric_limits<float>::min());
}

/// S of a voxel with the leaves without a normal in it.
std::array<double, 6> wholeSpread(const Voxel& voxel) {
  std::array<double, 6> spread{};
  for (std::size_t i = 0; i < 6; ++i) spread[i] = static_cast<double>(voxel.spread[i]);
  const double around = std::max(static_cast<double>(voxel.density) - (spread[0] + spread[3] + spread[5]), 0.0) / 3.0;
  for (const std::size_t i : {0u, 3u, 5u}) spread[i] += around;
  return spread;
}

/// A voxel whose leaves stand side by side.
Voxel hiding(const Voxel& voxel, const glm::dvec3& size) {
  constexpr double kMost = 0.99;  // of what is seen along an axis: no voxel is wholly opaque
  const glm::dvec3 extinctions = axisExtinctions(wholeSpread(voxel));
  glm::dvec3 sigma(0.0);
  for (int axis = 0; axis < 3; ++axis) {
    const double depth = extinctions[axis] * size[axis];
    sigma[axis] = std::max(-std::log1p(-std::min(depth, kMost)), depth) / size[axis];
  }
  Voxel out = voxel;
  scaleTo(wholeSpread(voxel), sigma, out);
  return out;
}

Voxel merged(const Children& children, const glm::dvec3& voxelM) {
  LeafSums sums;
  std::array<glm::dvec3, 8> extinctions;
  for (std::size_t c = 0; c < 8; ++c) {
    extinctions[c] = glm::dvec3(0.0);
    if (children[c] == nullptr) continue;
    sums.add(*children[c], static_cast<double>(children[c]->density));
    const std::array<double, 6> spread = wholeSpread(*children[c]);
    for (std::size_t i = 0; i < 6; ++i) sums.spread[i] += spread[i] / 8.0;
    extinctions[c] = axisExtinctions(spread);
  }
  Voxel voxel = sums.means();
  scaleTo(sums.spread,
          {extinctionAlong(extinctions, 0, voxelM.x), extinctionAlong(extinctions, 1, voxelM.y),
           extinctionAlong(extinctions, 2, voxelM.z)},
          voxel);
  return voxel;
}

class Halving {
 public:
  Halving(const Texel& texel, const TexelGrid& grid) : m_texel(texel), m_grid(grid) {}

  /// The coarser texel's brick, when it holds something.
  void brick(std::uint32_t index, Texel::Chunk& chunk) const {
    const int row = m_grid.brickRow();
    const auto at = static_cast<int>(index);
    const glm::ivec3 corner = glm::ivec3(at % row, at / row % row, at / row / row) * kBrick;
    if (!holds(corner)) return;
    std::array<std::uint64_t, 8> mask{};
    for (int i = 0; i < kBrick * kBrick * kBrick; ++i) {
      const glm::ivec3 place = 2 * (corner + glm::ivec3(i % kBrick, i / kBrick % kBrick, i / kBrick / kBrick));
      Children children{};
      bool any = false;
      for (int c = 0; c < 8; ++c) {
        const Voxel* child = m_texel.at(place + glm::ivec3(c & 1, (c >> 1) & 1, c >> 2));
        children[static_cast<std::size_t>(c)] = child;
        any = any || child != nullptr;
      }
      if (!any) continue;
      mask[static_cast<std::size_t>(i / 64)] |= std::uint64_t{1} << (i % 64);
      chunk.voxels.push_back(merged(children, m_texel.grid().voxelM()));
    }
    chunk.bricks.push_back(index);
    chunk.masks.push_back(mask);
  }

 private:
  /// Whether some of the eight bricks under a coarser brick holds something.
  bool holds(const glm::ivec3& corner) const {
    const int row = m_texel.grid().brickRow();
    for (int c = 0; c < 8; ++c) {
      const glm::ivec3 brick = 2 * corner / kBrick + glm::ivec3(c & 1, (c >> 1) & 1, c >> 2);
      if (m_texel.bricks()[static_cast<std::size_t>((brick.z * row + brick.y) * row + brick.x)] >= 0) return true;
    }
    return false;
  }

  const Texel& m_texel;
  TexelGrid m_grid;
};

}  // namespace

Result<Texel> opaque(const Texel& texel, const JobContext& job) {
  const auto bricks = texel.bricks();
  std::vector<std::uint32_t> filled;
  std::vector<std::array<std::uint64_t, 8>> masks;
  for (std::size_t i = 0; i < bricks.size(); ++i) {
    if (bricks[i] < 0) continue;
    filled.push_back(static_cast<std::uint32_t>(i));
    masks.push_back(texel.stored()[static_cast<std::size_t>(bricks[i])].mask);
  }
  const glm::dvec3 size = texel.grid().voxelM();
  Texel out = Texel::fromMasks(
      texel.grid(), filled, masks,
      [&](std::size_t i, std::span<Voxel> voxels) {
        const Voxel* from = texel.voxels().data() + texel.stored()[i].first;
        for (Voxel& voxel : voxels) voxel = hiding(*from++, size);
      },
      job);
  if (job.cancelled()) return Error::cancelled();
  return out;
}

Result<Texel> halved(const Texel& texel, const JobContext& job) {
  TexelGrid grid = texel.grid();
  grid.columns /= 2;
  grid.layers /= 2;
  if (texel.grid().columns % (2 * kBrick) != 0 || texel.grid().layers % (2 * kBrick) != 0) {
    return Error::badInput("half of " + std::to_string(texel.grid().columns) + " columns and " +
                               std::to_string(texel.grid().layers) + " layers is not of whole bricks",
                           "level of detail", "Both must be multiples of 16.");
  }
  const Halving halving(texel, grid);
  const std::size_t count = grid.brickCount();
  std::vector<Texel::Chunk> chunks((count + kBricks - 1) / kBricks);
  base::parallelFor(job, count, kBricks, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) halving.brick(static_cast<std::uint32_t>(i), chunks[begin / kBricks]);
  });
  Texel half = Texel::fromChunks(grid, chunks, job);
  if (job.cancelled()) return Error::cancelled();
  return half;
}

Result<std::vector<Texel>> levels(const Texel& texel, int coarsest, const JobContext& job) {
  std::vector<Texel> out{texel};
  const auto whole = [](int size) { return size % (2 * kBrick) == 0; };
  while (whole(out.back().grid().columns) && whole(out.back().grid().layers) &&
         out.back().grid().columns / 2 >= coarsest) {
    SWARD_ASSIGN(Texel half, halved(out.back(), job));
    out.push_back(std::move(half));
  }
  return out;
}

}  // namespace sward::wither
