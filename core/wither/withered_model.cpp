#include "wither/withered_model.h"

#include "mesh/parts.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <string>
#include <utility>

namespace sward::wither {
namespace {

/// What a textured part looks like at rest: means over its surface, by coverage.
struct Swatch {
  glm::dvec3 diffuse{0.0}, transmitted{0.0};
  double weight = 0.0;
};

/// What the vertices of one model are coloured by.
struct Palette {
  std::vector<std::uint32_t> material;  ///< one a vertex: the first that it is drawn with
  std::vector<std::uint32_t> swatch;    ///< one a vertex; kPlain: its material has no texture
  std::vector<Swatch> swatches;
  static constexpr std::uint32_t kPlain = 0xffffffffu;

  explicit Palette(const mesh::Model& model);
};

/// Adds a triangle's colours, from a lattice of its points.
void addTo(Swatch& swatch, const mesh::Model& model, std::uint32_t triangle) {
  constexpr int kSide = 3;
  const glm::uvec3& t = model.triangles[triangle];
  const glm::dvec3 a(model.positions[t.x]), b(model.positions[t.y]), c(model.positions[t.z]);
  const double area = glm::length(glm::cross(b - a, c - a)) + 1e-30;
  for (int i = 0; i < kSide; ++i) {
    for (int j = 0; i + j < kSide; ++j) {
      const mesh::SurfaceSample at = mesh::surfaceAt(model, triangle, (static_cast<float>(i) + 1.0f / 3.0f) / kSide,
                                                     (static_cast<float>(j) + 1.0f / 3.0f) / kSide);
      const double weight = area * static_cast<double>(at.alpha);
      swatch.diffuse += weight * glm::dvec3(at.reflectance);
      swatch.transmitted += weight * glm::dvec3(at.transmittance);
      swatch.weight += weight;
    }
  }
}

Palette::Palette(const mesh::Model& model)
    : material(model.positions.size(), 0), swatch(model.positions.size(), kPlain) {
  const mesh::Parts parts = mesh::findParts(model);
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> numbers;  // by part and material
  for (std::size_t t = model.triangles.size(); t-- > 0;) {
    const std::uint32_t own = model.triangleMaterial[t];
    const bool textured = model.materials[own].texture >= 0;
    std::uint32_t number = kPlain;
    if (textured) {
      number =
          numbers.try_emplace({parts.ofTriangle[t], own}, static_cast<std::uint32_t>(swatches.size())).first->second;
      if (number == swatches.size()) swatches.emplace_back();
      addTo(swatches[number], model, static_cast<std::uint32_t>(t));
    }
    for (int i = 0; i < 3; ++i) {
      material[model.triangles[t][i]] = own;
      swatch[model.triangles[t][i]] = number;
    }
  }
  for (Swatch& mean : swatches) {
    if (!(mean.weight > 0.0)) continue;
    mean.diffuse /= mean.weight;
    mean.transmitted /= mean.weight;
  }
}

constexpr float kBlack = 1e-4f;  // a channel that dark cannot be multiplied to any other

/// The vertex colour with which a textured part's mean reflects what the aged leaf does.
glm::vec4 agedTextured(const Swatch& rest, const glm::vec4& vertex, const Season::Shares& shares,
                       const AgeColour& colour) {
  glm::vec3 diffuse(rest.diffuse), transmitted(rest.transmitted);
  colour(diffuse, transmitted, shares);
  glm::vec4 result = vertex;
  for (int c = 0; c < 3; ++c) {
    if (rest.diffuse[c] > static_cast<double>(kBlack)) result[c] *= diffuse[c] / static_cast<float>(rest.diffuse[c]);
  }
  return result;
}

/// The same where the material has one colour: this very vertex reflects it.
glm::vec4 agedPlain(const mesh::Material& material, const glm::vec4& vertex, const Season::Shares& shares,
                    const AgeColour& colour) {
  const glm::vec3 factor(material.baseColour);
  glm::vec3 diffuse = glm::clamp(factor * glm::vec3(vertex), 0.0f, 1.0f);
  glm::vec3 transmitted =
      diffuse * glm::vec3(material.optics.transmissionTint) * static_cast<float>(material.optics.translucency);
  colour(diffuse, transmitted, shares);
  glm::vec4 result = vertex;
  for (int c = 0; c < 3; ++c) {
    if (factor[c] > kBlack) result[c] = diffuse[c] / factor[c];
  }
  return result;
}

/// Everything that the vertices of one plant are moved by.
struct Mover {
  std::span<const Strand> strands;
  std::vector<BentStrand> bent;
  std::vector<double> seasons;  ///< by strand

  Mover(std::span<const Strand> all, const Season& season, const SampleSeasons& moments) : strands(all) {
    bent.reserve(all.size());
    for (const Strand& strand : all) {
      seasons.push_back(moments[strand.sample]);
      bent.emplace_back(strand, season.stateAt(seasons.back(), strand.delay, strand.droop));
    }
  }
};

/// Moves the vertices of `model` from `first` on, which hang on the mover's strands in the order of `attachments`.
void move(mesh::Model& model, std::size_t first, std::span<const Attachment> attachments, const Mover& mover,
          const Season& season, const Palette& palette, const AgeColour& colour) {
  for (std::size_t i = 0; i < attachments.size(); ++i) {
    const Attachment& at = attachments[i];
    if (at.strand < 0) continue;
    const auto k = static_cast<std::size_t>(at.strand);
    if (!(mover.seasons[k] > 0.0)) continue;
    const auto s = static_cast<double>(at.s);
    const BentStrand& bent = mover.bent[k];
    glm::vec3& position = model.positions[first + i];
    position = glm::vec3(bent.position(glm::dvec3(position), s));
    glm::vec3& normal = model.normals[first + i];
    normal = glm::vec3(bent.direction(glm::dvec3(normal), s));
    if (!colour) continue;
    const Season::Shares shares = season.sharesAt(mover.seasons[k], mover.strands[k].delay, s);
    glm::vec4& vertex = model.colours[first + i];
    const std::uint32_t swatch = palette.swatch[i];
    vertex = swatch == Palette::kPlain ? agedPlain(model.materials[palette.material[i]], vertex, shares, colour)
                                       : agedTextured(palette.swatches[swatch], vertex, shares, colour);
  }
}

/// A copy of a model's vertices and triangles in another space, added to `sum`.
void addPlaced(mesh::Model& sum, const mesh::Model& model, const glm::mat4x3& transform) {
  const auto first = static_cast<std::uint32_t>(sum.positions.size());
  const glm::dmat3 turn(transform[0], transform[1], transform[2]);
  for (const glm::vec3& p : model.positions) sum.positions.push_back(transform * glm::vec4(p, 1.0f));
  for (const glm::vec3& n : model.normals) {
    const glm::dvec3 turned = turn * glm::dvec3(n);
    const double length = glm::length(turned);
    sum.normals.emplace_back(length > 0.0 ? turned / length : glm::dvec3(n));
  }
  sum.uvs.insert(sum.uvs.end(), model.uvs.begin(), model.uvs.end());
  sum.colours.insert(sum.colours.end(), model.colours.begin(), model.colours.end());
  for (const glm::uvec3& t : model.triangles) sum.triangles.push_back(t + first);
  sum.triangleMaterial.insert(sum.triangleMaterial.end(), model.triangleMaterial.begin(), model.triangleMaterial.end());
}

Error otherStrands(const std::string& where) {
  return Error::badInput("the strands are not those of this mesh", where, "Find the strands of the mesh itself.");
}

}  // namespace

SampleSeasons::SampleSeasons(const Season& season, std::span<const MingleSample> samples, double weathering) {
  for (const MingleSample& sample : samples) {
    const bool own = !sample.ageing.points().empty();
    m_seasons.push_back(season.seasonOf(own ? sample.ageing(std::clamp(weathering, 0.0, 1.0)) : weathering));
  }
  if (m_seasons.empty()) m_seasons.push_back(season.seasonOf(weathering));
}

double SampleSeasons::operator[](int sample) const {
  const auto index = static_cast<std::size_t>(std::max(sample, 0));
  return m_seasons[index < m_seasons.size() ? index : 0];
}

Result<mesh::Model> withered(const mesh::Model& plant, const Strands& strands, const Season& season,
                             std::span<const MingleSample> samples, double weathering, const AgeColour& colour) {
  if (strands.attachments.size() != plant.positions.size()) return otherStrands(plant.name);
  mesh::Model model = plant;
  const Mover mover(strands.strands, season, SampleSeasons(season, samples, weathering));
  move(model, 0, strands.attachments, mover, season, colour ? Palette(plant) : Palette({}), colour);
  return model;
}

Result<scene::Patch> withered(const scene::Patch& patch, const PatchStrands& strands, const Season& season,
                              std::span<const MingleSample> samples, double weathering, const AgeColour& colour) {
  if (strands.models.size() != patch.models.size() || strands.firstStrand.size() != patch.instances.size()) {
    return otherStrands("patch");
  }
  scene::Patch result{patch.sideM, 0.0, {}, {}};
  const SampleSeasons moments(season, samples, weathering);
  for (std::uint32_t m = 0; m < patch.models.size(); ++m) {
    if (patch.models[m] == nullptr || patch.models[m]->empty()) continue;
    const mesh::Model& model = *patch.models[m];
    const Strands& own = strands.models[m];
    if (own.attachments.size() != model.positions.size()) return otherStrands(model.name);
    const Palette palette = colour ? Palette(model) : Palette({});
    mesh::Model sum;
    sum.name = model.name;
    sum.materials = model.materials;
    sum.textures = model.textures;
    for (std::size_t i = 0; i < patch.instances.size(); ++i) {
      if (patch.instances[i].model != m) continue;
      const std::size_t first = sum.positions.size();
      addPlaced(sum, model, patch.instances[i].worldFromModel);
      const std::span all(strands.strands);
      if (strands.firstStrand[i] + own.strands.size() > all.size()) return otherStrands("patch");
      const Mover mover(all.subspan(strands.firstStrand[i], own.strands.size()), season, moments);
      move(sum, first, own.attachments, mover, season, palette, colour);
    }
    if (sum.empty()) continue;
    result.heightM = std::max(result.heightM, static_cast<double>(mesh::bounds(sum).high.z));
    result.instances.push_back({static_cast<std::uint32_t>(result.models.size()), glm::mat4x3(1.0f)});
    result.models.push_back(std::make_shared<const mesh::Model>(std::move(sum)));
  }
  return result;
}

}  // namespace sward::wither
