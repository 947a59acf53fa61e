#include "wither/withered_model.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>

namespace sward::wither {
namespace {

/// Alpha-weighted mean of a material's texture times its factor.
glm::vec3 meanColour(const mesh::Model& model, const mesh::Material& material) {
  const glm::vec3 factor(material.baseColour);
  if (material.texture < 0) return factor;
  const image::Image& texture = model.textures[static_cast<std::size_t>(material.texture)];
  const bool colour = texture.channels >= 3, alpha = texture.channels == 2 || texture.channels == 4;
  glm::dvec3 sum(0.0);
  double weights = 0.0;
  for (int y = 0; y < texture.height; ++y) {
    for (int x = 0; x < texture.width; ++x) {
      const float* p = texture.pixels.data() + texture.offset(x, y);
      const double weight = alpha ? static_cast<double>(p[texture.channels - 1]) : 1.0;
      sum += weight * (colour ? glm::dvec3(p[0], p[1], p[2]) : glm::dvec3(static_cast<double>(p[0])));
      weights += weight;
    }
  }
  return weights > 0.0 ? factor * glm::vec3(sum / weights) : factor;
}

/// Index of the first material that a vertex is drawn with.
std::vector<std::uint32_t> materialOfVertex(const mesh::Model& model) {
  std::vector<std::uint32_t> result(model.positions.size(), 0);
  for (std::size_t t = model.triangles.size(); t-- > 0;) {
    for (int i = 0; i < 3; ++i) result[model.triangles[t][i]] = model.triangleMaterial[t];
  }
  return result;
}

/// What the vertices of one model share.
struct Palette {
  std::vector<glm::vec3> means;  ///< one a material
  std::vector<std::uint32_t> ofVertex;

  explicit Palette(const mesh::Model& model) : ofVertex(materialOfVertex(model)) {
    for (const mesh::Material& material : model.materials) means.push_back(meanColour(model, material));
  }
};

/// The vertex colour that makes the material's mean reflect what the aged leaf does.
glm::vec4 agedVertex(const mesh::Material& material, const glm::vec3& mean, const glm::vec4& vertex,
                     const Season::Shares& shares, const AgeColour& colour) {
  constexpr float kBlack = 1e-4f;  // a channel that dark cannot be multiplied to any other
  const glm::vec3 rest = glm::clamp(mean * glm::vec3(vertex), 0.0f, 1.0f);
  glm::vec3 diffuse = rest;
  glm::vec3 transmitted =
      rest * glm::vec3(material.optics.transmissionTint) * static_cast<float>(material.optics.translucency);
  colour(diffuse, transmitted, shares);
  glm::vec4 result = vertex;
  for (int c = 0; c < 3; ++c) {
    if (mean[c] > kBlack) result[c] = diffuse[c] / mean[c];
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
          const Season& season, const Palette& palette, const AgeColour& colour,
          std::span<const mesh::Material> materials) {
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
    if (!colour || palette.means.empty()) continue;
    const std::uint32_t material = palette.ofVertex[i];
    glm::vec4& vertex = model.colours[first + i];
    vertex = agedVertex(materials[material], palette.means[material], vertex,
                        season.sharesAt(mover.seasons[k], mover.strands[k].delay, s), colour);
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
  move(model, 0, strands.attachments, mover, season, Palette(plant), colour, plant.materials);
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
    const Palette palette(model);
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
      move(sum, first, own.attachments, mover, season, palette, colour, model.materials);
    }
    if (sum.empty()) continue;
    result.heightM = std::max(result.heightM, static_cast<double>(mesh::bounds(sum).high.z));
    result.instances.push_back({static_cast<std::uint32_t>(result.models.size()), glm::mat4x3(1.0f)});
    result.models.push_back(std::make_shared<const mesh::Model>(std::move(sum)));
  }
  return result;
}

}  // namespace sward::wither
