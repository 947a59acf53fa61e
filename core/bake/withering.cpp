#include "bake/withering.h"

#include "leaf/ageing.h"
#include "wither/leaf_ageing.h"
#include "wither/strand.h"

#include <algorithm>
#include <utility>

namespace sward::bake {

bool withers(const project::Project& project) {
  return project.wither.weathering > 0.0 || !project.wither.mingle.empty();
}

bool drawnAsTexels(const project::Project& project) {
  return project.render.method == render::GroundMethod::Texels;
}

std::size_t sampleCount(const project::Project& project) {
  return std::max<std::size_t>(project.wither.mingle.size(), 1);
}

double samplePart(const project::Project& project, std::size_t sample) {
  const auto& samples = project.wither.mingle;
  if (samples.empty()) return 1.0;
  double shares = 0.0;
  for (const wither::MingleSample& other : samples) shares += other.share;
  return shares > 0.0 ? samples[sample].share / shares * samples[sample].density : 0.0;
}

Result<Ageing> ageingOf(const project::Project& project) {
  SWARD_ASSIGN(wither::Season season, wither::Season::create(project.wither.ageing, project.wither.body));
  SWARD_ASSIGN(const leaf::AgeingColours colours, leaf::AgeingColours::build(project.leaf));
  return Ageing{std::move(season), wither::ageColour(colours)};
}

Result<mesh::Model> witheredModel(const project::Project& project, const mesh::Model& grown, std::size_t sample,
                                  std::uint64_t seed) {
  SWARD_ASSIGN(const Ageing ageing, ageingOf(project));
  SWARD_ASSIGN(wither::Strands strands, wither::strandsOf(grown, project.wither.ageing, project.wither.body, seed));
  for (wither::Strand& strand : strands.strands) strand.sample = static_cast<int>(sample);
  return wither::withered(grown, strands, ageing.season, project.wither.mingle, project.wither.weathering,
                          ageing.colour);
}

}  // namespace sward::bake
