#include "trace/voxel_form.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Eigenvalues>

namespace sward::trace {
namespace {

constexpr int kNormalBits = 5;  ///< of each coordinate
constexpr int kShareBits = 6;
constexpr int kDensityBits = 8;

std::uint32_t quantised(float value, int bits) {
  const auto largest = static_cast<float>((1u << bits) - 1u);
  return static_cast<std::uint32_t>(std::lround(std::clamp(value, 0.0f, 1.0f) * largest));
}
float dequantised(std::uint32_t code, int shift, int bits) {
  const std::uint32_t largest = (1u << bits) - 1u;
  return static_cast<float>((code >> shift) & largest) / static_cast<float>(largest);
}

/// Extinctions along the axes times the voxel's size, summed: what a voxel blocks.
float blocks(const DominantVoxel& voxel, const glm::vec3& size) {
  const glm::vec3 n = glm::abs(voxel.normal);
  return voxel.density * glm::dot(voxel.share * n + 0.5f * (1.0f - voxel.share), size);
}

}  // namespace

float DominantVoxel::extinction(const glm::vec3& l) const {
  return density * (share * std::abs(glm::dot(normal, l)) + 0.5f * (1.0f - share));
}

DominantVoxel dominantOf(const std::array<float, 6>& tensor) {
  DominantVoxel voxel;
  voxel.density = tensor[0] + tensor[3] + tensor[5];
  if (!(voxel.density > 0.0f)) return {};
  Eigen::Matrix3d s;
  s << tensor[0], tensor[1], tensor[2], tensor[1], tensor[3], tensor[4], tensor[2], tensor[4], tensor[5];
  s /= static_cast<double>(voxel.density);
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(s);
  const Eigen::Vector3d n = eigen.eigenvectors().col(2);
  voxel.normal = glm::vec3(glm::dvec3(n(0), n(1), n(2)) * (n(2) < 0.0 ? -1.0 : 1.0));
  voxel.share = static_cast<float>(std::clamp(0.5 * (3.0 * eigen.eigenvalues()(2) - 1.0), 0.0, 1.0));
  return voxel;
}

std::array<float, 6> tensorOf(const DominantVoxel& voxel) {
  const glm::vec3 n = voxel.normal;
  const float one = voxel.density * voxel.share, all = voxel.density * (1.0f - voxel.share) / 3.0f;
  return {one * n.x * n.x + all, one * n.x * n.y, one * n.x * n.z,
          one * n.y * n.y + all, one * n.y * n.z, one * n.z * n.z + all};
}

double boundOf(const std::array<float, 6>& tensor, const glm::dvec3& l) {
  const auto s = [&](std::size_t i) { return static_cast<double>(tensor[i]); };
  const double form = l.x * l.x * s(0) + l.y * l.y * s(3) + l.z * l.z * s(5) +
                      2.0 * (l.x * l.y * s(1) + l.x * l.z * s(2) + l.y * l.z * s(4));
  return std::sqrt(std::max(form, 0.0) * (s(0) + s(3) + s(5)));
}

std::uint32_t packPair(const DominantVoxel& lower, const DominantVoxel& upper, float largest) {
  const DominantVoxel& shape = lower.density > 0.0f ? lower : upper;  // both have the same
  const glm::vec2 normal = hemiOctahedral(shape.normal.z < 0.0f ? -shape.normal : shape.normal);
  const auto density = [&](const DominantVoxel& voxel) {
    const std::uint32_t code = quantised(std::sqrt(voxel.density / largest), kDensityBits);
    return code == 0 && voxel.density > 0.0f ? 1u : code;  // what is there stays there
  };
  return density(lower) | (density(upper) << 8) | (quantised(normal.x, kNormalBits) << 16) |
         (quantised(normal.y, kNormalBits) << 21) | (quantised(shape.share, kShareBits) << 26);
}

DominantVoxel unpack(std::uint32_t pair, bool upper, float largest) {
  const float root = dequantised(pair, upper ? 8 : 0, kDensityBits);
  return {fromHemiOctahedral({dequantised(pair, 16, kNormalBits), dequantised(pair, 21, kNormalBits)}),
          dequantised(pair, 26, kShareBits), root * root * largest};
}

std::array<DominantVoxel, 2> paired(const DominantVoxel& lower, const DominantVoxel& upper, const glm::vec3& size) {
  std::array<float, 6> sum = tensorOf(lower);
  const std::array<float, 6> other = tensorOf(upper);
  for (std::size_t i = 0; i < 6; ++i) sum[i] += other[i];
  std::array<DominantVoxel, 2> pair{lower, upper};
  DominantVoxel shape = dominantOf(sum);
  shape.density = 1.0f;
  const float ofUnit = blocks(shape, size);
  for (DominantVoxel& voxel : pair) {
    const float blocked = blocks(voxel, size);
    voxel = shape;
    voxel.density = blocked / ofUnit;
  }
  return pair;
}

glm::vec2 hemiOctahedral(const glm::vec3& direction) {
  const float sum = std::abs(direction.x) + std::abs(direction.y) + direction.z;
  const float x = direction.x / sum, y = direction.y / sum;
  return {0.5f * (x + y) + 0.5f, 0.5f * (x - y) + 0.5f};
}

glm::vec3 fromHemiOctahedral(const glm::vec2& at) {
  const float sum = 2.0f * at.x - 1.0f, difference = 2.0f * at.y - 1.0f;
  const float x = 0.5f * (sum + difference), y = 0.5f * (sum - difference);
  return glm::normalize(glm::vec3(x, y, 1.0f - std::abs(x) - std::abs(y)));
}

}  // namespace sward::trace
