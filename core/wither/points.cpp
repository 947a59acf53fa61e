#include "wither/points.h"

#include "base/parallel.h"
#include "base/random.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>
#include <string>

namespace sward::wither {
namespace {

constexpr std::size_t kGrain = 4096;

/// Points of each voxel and the leaf area of one.
struct Shares {
  std::vector<std::uint32_t> first;  ///< one a voxel and one more: running number of points
  std::vector<float> areaM2;
};

std::uint64_t randomOf(std::uint64_t seed, const glm::u16vec3& place, std::uint64_t draw) {
  const std::uint64_t at = std::uint64_t{place.x} | std::uint64_t{place.y} << 16 | std::uint64_t{place.z} << 32;
  return base::mix64(seed, at, draw);
}

/// Voxels strand by strand, from root to tip; those on none first, in their own order.
std::vector<std::uint32_t> alongStrands(std::size_t voxels, std::span<const Attachment> attachments) {
  std::vector<std::uint32_t> order(voxels);
  std::iota(order.begin(), order.end(), 0u);
  if (attachments.empty()) return order;
  std::vector<std::uint64_t> keys(voxels);
  for (std::size_t i = 0; i < voxels; ++i) {
    const Attachment& at = attachments[i];
    const float s = at.strand < 0 || !(at.s > 0.0f) ? 0.0f : at.s;  // bits of what is not below 0 are in its order
    keys[i] = static_cast<std::uint64_t>(at.strand + 1) << 32 | std::bit_cast<std::uint32_t>(s);
  }
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return keys[a] < keys[b]; });
  return order;
}

/// Numbers of points, one a voxel. The fractions that whole points leave over are summed along each strand from a
/// random start, and each time that they pass a whole number there is a point: every voxel has it with the chance of
/// its fraction, and a blade's points are as evenly spaced as its voxels allow (systematic sampling).
std::vector<std::uint32_t> countPoints(const Texel& texel, std::span<const Attachment> attachments,
                                       std::span<const double> wanted, std::uint64_t seed) {
  std::vector<std::uint32_t> counts(texel.size());
  double sum = 0.0;
  std::int64_t strand = -2;
  for (const std::uint32_t i : alongStrands(texel.size(), attachments)) {
    const std::int64_t own = attachments.empty() ? -1 : attachments[i].strand;
    if (own != strand) sum = base::unitDouble(base::mix64(seed, 0x706f696e7473, static_cast<std::uint64_t>(own + 1)));
    strand = own;
    const double whole = std::floor(wanted[i]);
    sum += wanted[i] - whole;
    counts[i] = static_cast<std::uint32_t>(whole);
    if (sum < 1.0) continue;
    sum -= 1.0;
    ++counts[i];
  }
  return counts;
}

Shares shareOut(const Texel& texel, std::span<const Attachment> attachments, double proportion, std::uint64_t seed) {
  const std::span<const Voxel> voxels = texel.voxels();
  const double volume = texel.grid().voxelVolumeM3(), edge = std::cbrt(volume);
  std::vector<double> wanted(voxels.size());
  for (std::size_t i = 0; i < voxels.size(); ++i) {
    wanted[i] = std::min(proportion * static_cast<double>(voxels[i].density) * edge, 1e6);
  }
  const std::vector<std::uint32_t> counts = countPoints(texel, attachments, wanted, seed);
  Shares shares{std::vector<std::uint32_t>(voxels.size() + 1, 0), std::vector<float>(voxels.size(), 0.0f)};
  double sparse = 0.0, drawn = 0.0;  // leaf area of voxels with less than a point, and of the points they got
  std::vector<std::size_t> few;
  for (std::size_t i = 0; i < voxels.size(); ++i) {
    const double area = static_cast<double>(voxels[i].density) * volume;
    const bool whole = wanted[i] >= 1.0;
    shares.first[i + 1] = shares.first[i] + counts[i];
    if (counts[i] > 0)
      shares.areaM2[i] = static_cast<float>(area / (whole ? static_cast<double>(counts[i]) : wanted[i]));
    if (whole) continue;
    sparse += area;
    if (counts[i] == 0) continue;
    drawn += area / wanted[i];
    few.push_back(i);
  }
  if (drawn > 0.0) {
    for (const std::size_t i : few) shares.areaM2[i] = static_cast<float>(shares.areaM2[i] * (sparse / drawn));
    return shares;
  }
  if (!(sparse > 0.0)) return shares;
  const double total = texel.areaM2();
  if (shares.first.back() > 0) {  // no point for what is sparse: the others stand for it
    const double factor = total / (total - sparse);
    for (float& area : shares.areaM2) area = static_cast<float>(area * factor);
    return shares;
  }
  const auto denser = [](const Voxel& a, const Voxel& b) { return a.density < b.density; };
  const auto most = static_cast<std::size_t>(std::max_element(voxels.begin(), voxels.end(), denser) - voxels.begin());
  for (std::size_t i = most; i < voxels.size(); ++i) shares.first[i + 1] = 1;
  shares.areaM2[most] = static_cast<float>(total);
  return shares;
}

/// The image of a point of the periodic block that is nearest to its strand's vein.
glm::vec3 beside(const Strand& strand, double s, glm::vec3 point, double side) {
  const double place = std::clamp(s, 0.0, 1.0) * static_cast<double>(strand.vein.size() - 1);
  const auto i = std::min(static_cast<std::size_t>(place), strand.vein.size() - 2);
  const glm::dvec3 vein = glm::mix(strand.vein[i], strand.vein[i + 1], place - static_cast<double>(i));
  point.x += static_cast<float>(side * std::round((vein.x - static_cast<double>(point.x)) / side));
  point.y += static_cast<float>(side * std::round((vein.y - static_cast<double>(point.y)) / side));
  return point;
}

/// Where each voxel's points go so that those of a strand stand together: first place of each voxel.
std::vector<std::uint32_t> placesByStrand(const Shares& shares, std::span<const Attachment> attachments,
                                          std::size_t strands) {
  std::vector<std::uint32_t> place(shares.first.begin(), shares.first.end() - 1);
  if (attachments.empty()) return place;
  std::vector<std::uint32_t> next(strands + 2, 0);  // the first for points on no strand
  const auto slot = [&](std::size_t i) { return static_cast<std::size_t>(attachments[i].strand + 1); };
  for (std::size_t i = 0; i < place.size(); ++i) next[slot(i) + 1] += shares.first[i + 1] - shares.first[i];
  for (std::size_t i = 1; i < next.size(); ++i) next[i] += next[i - 1];
  for (std::size_t i = 0; i < place.size(); ++i) {
    place[i] = next[slot(i)];
    next[slot(i)] += shares.first[i + 1] - shares.first[i];
  }
  return place;
}

Result<void> check(const Texel& texel, std::span<const Attachment> attachments, std::span<const Strand> strands,
                   double proportion) {
  if (!(proportion > 0.0 && proportion <= 1000.0)) {
    return Error::badInput("the proportion of points is " + std::to_string(proportion), "texel.proportion",
                           "Give a number above 0 and up to 1000.");
  }
  if (!attachments.empty() && attachments.size() != texel.size()) {
    return Error::badInput(
        std::to_string(attachments.size()) + " attachments for " + std::to_string(texel.size()) + " voxels", "texel",
        "Give one to each voxel, or none.");
  }
  for (const Attachment& at : attachments) {
    if (at.strand < 0) continue;
    const auto k = static_cast<std::size_t>(at.strand);
    if (k < strands.size() && strands[k].vein.size() >= 2) continue;
    return Error::badInput(
        "a voxel hangs on strand " + std::to_string(at.strand) + " of " + std::to_string(strands.size()), "texel",
        "Give the strands that it was voxelised with.");
  }
  return {};
}

}  // namespace

void Points::resize(std::size_t count) {
  positions.resize(count);
  normals.resize(count);
  tangents.resize(count);
  spread.resize(count);
  diffuse.resize(count);
  transmitted.resize(count);
  specular.resize(count);
  areaM2.resize(count);
  attachments.resize(count);
}

double Points::totalAreaM2() const {
  double sum = 0.0;
  for (const float area : areaM2) sum += static_cast<double>(area);
  return sum;
}

Result<Points> texelToPoints(const Texel& texel, std::span<const Attachment> attachments,
                             std::span<const Strand> strands, double proportion, std::uint64_t seed,
                             const JobContext& job) {
  SWARD_TRY(check(texel, attachments, strands, proportion));
  const Shares shares = shareOut(texel, attachments, proportion, seed);
  const std::vector<std::uint32_t> place = placesByStrand(shares, attachments, strands.size());
  const glm::dvec3 edge = texel.grid().voxelM();
  Points points;
  points.resize(shares.first.back());
  base::parallelFor(job, texel.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Voxel& voxel = texel.voxels()[i];
      const glm::u16vec3& at = texel.places()[i];
      const Attachment hung = attachments.empty() ? Attachment{} : attachments[i];
      for (std::uint32_t k = 0; k < shares.first[i + 1] - shares.first[i]; ++k) {
        const std::size_t p = place[i] + k;
        glm::dvec3 inside;
        for (int c = 0; c < 3; ++c) inside[c] = base::unitDouble(randomOf(seed, at, 3 * k + static_cast<unsigned>(c)));
        const glm::vec3 position((glm::dvec3(at) + inside) * edge);
        points.positions[p] = hung.strand < 0 ? position
                                              : beside(strands[static_cast<std::size_t>(hung.strand)],
                                                       static_cast<double>(hung.s), position, texel.grid().sideM);
        points.normals[p] = voxel.normal;
        points.tangents[p] = voxel.tangent;
        for (std::size_t c = 0; c < 6; ++c) points.spread[p][c] = voxel.spread[c] / voxel.density;
        points.diffuse[p] = voxel.diffuse;
        points.transmitted[p] = voxel.transmitted;
        points.specular[p] = voxel.specular;
        points.areaM2[p] = shares.areaM2[i];
        points.attachments[p] = hung;
      }
    }
  });
  if (job.cancelled()) return Error::cancelled();
  return points;
}

}  // namespace sward::wither
