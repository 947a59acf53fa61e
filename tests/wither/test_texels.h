#pragma once

#include "base/random.h"
#include "wither/points.h"
#include "wither/strand.h"
#include "wither/texel.h"

#include <cmath>
#include <vector>

namespace sward::wither {

/// Upright blades one voxel wide at random places, with what they hang on.
struct Blades {
  Texel texel;
  std::vector<Attachment> attachments;
  std::vector<Strand> strands;
};

inline Voxel leafVoxel(double density) {
  Voxel voxel;
  voxel.density = static_cast<float>(density);
  voxel.normal = {1.0f, 0.0f, 0.0f};
  voxel.tangent = {0.0f, 0.0f, 1.0f};
  voxel.diffuse = {0.1f, 0.2f, 0.05f};
  voxel.transmitted = {0.06f, 0.15f, 0.01f};
  voxel.specular = 0.04f;
  voxel.spread = {voxel.density, 0, 0, 0, 0, 0};
  return voxel;
}

/// `share`: leaf area of a voxel over its face.
inline Blades uprightBlades(int count, int resolution, double share, double heightShare = 0.6) {
  TexelGrid grid{resolution, resolution, 1.0, 0.5};
  const glm::dvec3 edge = grid.voxelM();
  const double density = share / std::cbrt(grid.voxelVolumeM3());
  const int layers = static_cast<int>(heightShare * resolution);
  base::Random random(77);
  Blades blades;
  std::vector<Texel::Entry> entries;
  std::vector<Attachment> byPlace(static_cast<std::size_t>(resolution) * resolution);
  for (int k = 0; k < count; ++k) {
    const glm::ivec2 foot(random.index(static_cast<std::uint32_t>(resolution)),
                          random.index(static_cast<std::uint32_t>(resolution)));
    Attachment& at = byPlace[static_cast<std::size_t>(foot.y) * resolution + foot.x];
    if (at.strand >= 0) continue;
    at.strand = static_cast<std::int32_t>(blades.strands.size());
    Strand strand;
    strand.lengthM = layers * edge.z;
    for (int i = 0; i <= 12; ++i) {
      strand.vein.emplace_back((foot.x + 0.5) * edge.x, (foot.y + 0.5) * edge.y, strand.lengthM * i / 12.0);
    }
    const double angle = random.uniform(0.0, 6.28);
    strand.bendTo = {std::cos(angle), std::sin(angle)};
    blades.strands.push_back(strand);
    for (int z = 0; z < layers; ++z) entries.push_back({{foot.x, foot.y, z}, leafVoxel(density)});
  }
  blades.texel = Texel::fromEntries(grid, std::move(entries)).value();
  for (const glm::u16vec3& place : blades.texel.places()) {
    Attachment at = byPlace[static_cast<std::size_t>(place.y) * resolution + place.x];
    at.s = static_cast<float>((place.z + 0.5) / layers);
    blades.attachments.push_back(at);
  }
  return blades;
}

inline Points pointAt(const glm::vec3& position, float area = 1.0f) {
  Points points;
  points.resize(1);
  points.positions[0] = position;
  points.normals[0] = {0.0f, 1.0f, 0.0f};
  points.tangents[0] = {0.0f, 0.0f, 1.0f};
  points.diffuse[0] = {0.1f, 0.2f, 0.3f};
  points.transmitted[0] = {0.3f, 0.2f, 0.1f};
  points.specular[0] = 0.5f;
  points.spread[0] = {0, 0, 0, 1, 0, 0};
  points.areaM2[0] = area;
  return points;
}

inline void add(Points& points, const Points more) {  // a copy: it may be the same
  const std::size_t count = points.size();
  points.resize(count + more.size());
  for (std::size_t i = 0; i < more.size(); ++i) {
    points.positions[count + i] = more.positions[i];
    points.normals[count + i] = more.normals[i];
    points.tangents[count + i] = more.tangents[i];
    points.spread[count + i] = more.spread[i];
    points.diffuse[count + i] = more.diffuse[i];
    points.transmitted[count + i] = more.transmitted[i];
    points.specular[count + i] = more.specular[i];
    points.areaM2[count + i] = more.areaM2[i];
    points.attachments[count + i] = more.attachments[i];
  }
}

inline bool sameBytes(const Texel& a, const Texel& b) {
  if (a.size() != b.size()) return false;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Voxel &v = a.voxels()[i], &w = b.voxels()[i];
    const bool same = a.places()[i] == b.places()[i] && v.density == w.density && v.normal == w.normal &&
                      v.tangent == w.tangent && v.diffuse == w.diffuse && v.transmitted == w.transmitted &&
                      v.specular == w.specular && v.spread == w.spread;
    if (!same) return false;
  }
  return true;
}

}  // namespace sward::wither
