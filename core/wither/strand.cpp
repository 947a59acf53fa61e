#include "wither/strand.h"

#include "base/random.h"
#include "mesh/parts.h"
#include "mesh/ribbon.h"
#include "wither/vein.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

namespace sward::wither {
namespace {

constexpr std::uint64_t kStream = 0x737472616e64;  // keeps these draws apart from those of other uses of the seed

bool finite(const glm::dvec3& v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

Result<void> check(const mesh::Model& plant) {
  for (std::size_t i = 0; i < plant.positions.size(); ++i) {
    if (finite(glm::dvec3(plant.positions[i]))) continue;
    return Error::badInput("vertex " + std::to_string(i) + " has a place that is not finite", plant.name,
                           "Repair the mesh.");
  }
  for (const glm::uvec3& triangle : plant.triangles) {
    const std::uint32_t largest = std::max({triangle.x, triangle.y, triangle.z});
    if (largest < plant.positions.size()) continue;
    return Error::badInput(
        "a triangle names vertex " + std::to_string(largest) + " of " + std::to_string(plant.positions.size()),
        plant.name, "Repair the mesh.");
  }
  return {};
}

/// What tells a strand from its neighbours; droop stays 0 where it is.
void draw(Strand& strand, const AgeingOptions& ageing, const BodyOptions& body, base::Random& random) {
  strand.delay = ageing.variation * mesh::cutNormal(random);
  const double droop = std::max(1.0 + body.droopVariation * mesh::cutNormal(random), 0.0);
  if (strand.droop > 0.0) strand.droop = droop;
}

/// Toward the tip, where the vein says a direction; else any.
void chooseBend(Strand& strand, base::Random& random) {
  const glm::dvec2 chord(strand.vein.back() - strand.vein.front());
  const double azimuth = 2.0 * std::numbers::pi * random.uniform();
  const double length = glm::length(chord);
  strand.bendTo = length > 1e-3 * strand.lengthM && length > 0.0 ? chord / length
                                                                 : glm::dvec2(std::cos(azimuth), std::sin(azimuth));
}

Strand strandOf(Vein vein, const AgeingOptions& ageing, const BodyOptions& body, base::Random& random) {
  Strand strand;
  strand.vein = std::move(vein.points);
  strand.lengthM = vein.lengthM;
  const auto lower = [](const glm::dvec3& a, const glm::dvec3& b) { return a.z < b.z; };
  const bool hangs = std::max_element(strand.vein.begin(), strand.vein.end(), lower) == strand.vein.begin();
  const bool level = strand.vein.front().z - strand.vein.back().z <= 1e-3 * strand.lengthM;
  strand.droop = hangs && !level ? 0.0 : 1.0;
  chooseBend(strand, random);
  draw(strand, ageing, body, random);
  return strand;
}

double lowestOf(const PlaceGraph& graph, std::uint32_t part) {
  double low = std::numeric_limits<double>::infinity();
  for (const std::uint32_t p : graph.ofPart[part]) low = std::min(low, graph.places[p].z);
  return low;
}

/// By part: whether it is a strand of its own.
std::vector<bool> standing(const PlaceGraph& graph) {
  std::vector<double> lows(graph.ofPart.size());
  double lowest = std::numeric_limits<double>::infinity(), highest = -lowest;
  for (std::uint32_t part = 0; part < lows.size(); ++part) {
    lows[part] = lowestOf(graph, part);
    lowest = std::min(lowest, lows[part]);
  }
  for (const glm::dvec3& place : graph.places) highest = std::max(highest, place.z);
  // Near: within 4 % of the height, or a centimetre for what is small; roots of blades reach into a sheath.
  const double limit =
      std::max(lowest, 0.0) + std::max(0.04 * (highest - lowest), std::min(0.01, 0.2 * (highest - lowest)));
  std::vector<bool> result(lows.size());
  for (std::size_t part = 0; part < lows.size(); ++part) result[part] = lows[part] <= limit;
  return result;
}

/// Where a part hangs as a whole: the place of any strand that is nearest to its lowest point.
Attachment hang(const PlaceGraph& graph, std::uint32_t part, std::span<const Strand> strands) {
  const std::vector<std::uint32_t>& places = graph.ofPart[part];
  const std::uint32_t lowest = *std::min_element(places.begin(), places.end(), [&](std::uint32_t a, std::uint32_t b) {
    return graph.places[a].z < graph.places[b].z;
  });
  const glm::dvec3& place = graph.places[lowest];
  Attachment best;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < strands.size(); ++i) {
    // No point of the vein is farther from its root than it is long.
    if (glm::length(place - strands[i].vein.front()) - strands[i].lengthM >= nearest) continue;
    const Nearest found = nearestOn(strands[i].vein, place);
    if (found.distance >= nearest) continue;
    nearest = found.distance;
    best = {static_cast<std::int32_t>(i), static_cast<float>(found.s)};
  }
  return best;
}

Strand strandAt(const Strand& strand, const glm::mat4x3& worldFromModel, double scale) {
  Strand placed = strand;
  const glm::dmat4x3 transform(worldFromModel);
  for (glm::dvec3& point : placed.vein) point = transform * glm::dvec4(point, 1.0);
  placed.lengthM = strand.lengthM * scale;
  const glm::dvec3 bend = transform * glm::dvec4(strand.bendTo, 0.0, 0.0);
  const glm::dvec2 chord(placed.vein.back() - placed.vein.front());
  const glm::dvec2 turned = glm::length(chord) > 1e-3 * placed.lengthM ? chord : glm::dvec2(bend);
  const double length = glm::length(turned);
  placed.bendTo = length > 0.0 ? turned / length : glm::dvec2(1.0, 0.0);
  return placed;
}

/// Index of the sample that a number in [0, 1) falls on.
int sampleOf(const std::vector<MingleSample>& samples, double u) {
  double sum = 0.0;
  for (const MingleSample& sample : samples) sum += std::max(sample.share, 0.0);
  double left = u * sum;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    left -= std::max(samples[i].share, 0.0);
    if (left < 0.0) return static_cast<int>(i);
  }
  return 0;
}

}  // namespace

Result<Strands> strandsOf(const mesh::Model& plant, const AgeingOptions& ageing, const BodyOptions& body,
                          std::uint64_t seed) {
  SWARD_TRY(check(plant));
  Strands result;
  result.attachments.resize(plant.positions.size());
  if (plant.triangles.empty()) return result;
  const mesh::Parts parts = mesh::findParts(plant);
  const PlaceGraph graph = placeGraph(plant, parts);
  const std::vector<bool> stands = standing(graph);
  std::vector<Attachment> ofPlace(graph.places.size());
  std::vector<double> distances(graph.places.size());
  for (std::uint32_t part = 0; part < graph.ofPart.size(); ++part) {
    if (!stands[part]) continue;
    for (Vein& vein : findVeins(graph, part, distances)) {
      const auto index = static_cast<std::int32_t>(result.strands.size());
      for (std::size_t i = 0; i < vein.s.size(); ++i) ofPlace[vein.places[i]] = {index, static_cast<float>(vein.s[i])};
      base::Random random(base::mix64(seed, kStream, static_cast<std::uint64_t>(index)));
      result.strands.push_back(strandOf(std::move(vein), ageing, body, random));
    }
  }
  for (std::uint32_t part = 0; part < graph.ofPart.size(); ++part) {
    if (stands[part]) continue;
    const Attachment at = hang(graph, part, result.strands);
    for (const std::uint32_t place : graph.ofPart[part]) ofPlace[place] = at;
  }
  for (std::size_t i = 0; i < plant.positions.size(); ++i) result.attachments[i] = ofPlace[parts.welded[i]];
  return result;
}

Result<PatchStrands> strandsOf(const scene::Patch& patch, const WitherOptions& options, std::uint64_t seed) {
  PatchStrands result;
  result.models.reserve(patch.models.size());
  for (std::size_t i = 0; i < patch.models.size(); ++i) {
    Strands strands;
    if (patch.models[i] != nullptr) {
      SWARD_ASSIGN(strands, strandsOf(*patch.models[i], options.ageing, options.body, base::mix64(seed, i)));
    }
    result.models.push_back(std::move(strands));
  }
  for (std::size_t i = 0; i < patch.instances.size(); ++i) {
    const scene::Instance& instance = patch.instances[i];
    const glm::mat4x3& transform = instance.worldFromModel;
    for (int c = 0; c < 4; ++c) {
      if (finite(glm::dvec3(transform[c])) && instance.model < patch.models.size()) continue;
      return Error::badInput("plant " + std::to_string(i) + " stands nowhere or is of no model", "patch",
                             "Give it finite numbers and a model of the patch.");
    }
    result.firstStrand.push_back(static_cast<std::uint32_t>(result.strands.size()));
    const double scale = std::cbrt(std::abs(glm::determinant(glm::dmat3(transform[0], transform[1], transform[2]))));
    const std::vector<Strand>& strands = result.models[instance.model].strands;
    for (std::size_t k = 0; k < strands.size(); ++k) {
      Strand strand = strandAt(strands[k], transform, scale);
      base::Random random(base::mix64(seed, kStream, i + 1, k));
      draw(strand, options.ageing, options.body, random);
      strand.sample = sampleOf(options.mingle, random.uniform());
      result.strands.push_back(std::move(strand));
    }
  }
  return result;
}

}  // namespace sward::wither
