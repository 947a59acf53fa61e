#pragma once

#include "base/result.h"
#include "mesh/model.h"
#include "project/project.h"
#include "wither/season.h"
#include "wither/withered_model.h"

#include <cstddef>
#include <cstdint>

namespace sward::bake {

/// Whether a project's plants differ from how they grew: it has weathered, or samples are mixed.
bool withers(const project::Project& project);
/// Whether its ground is texels, which need no layers (render::GroundMethod::Texels).
bool drawnAsTexels(const project::Project& project);
/// Samples that every plant is grown in: those of the mingling, at least one.
std::size_t sampleCount(const project::Project& project);
/// A sample's part of the plants, times its density.
double samplePart(const project::Project& project, std::size_t sample);

/// The season of a project and how its leaves' colours change. Errors: wither::Season's, leaf::AgeingColours'.
struct Ageing {
  wither::Season season;
  wither::AgeColour colour;
};
Result<Ageing> ageingOf(const project::Project& project);

/// A grown plant as the project's weathering degree leaves it in one sample of the mingling. `seed`: of its blades'
/// differences. Errors: ageingOf's; a mesh with vertices that are not finite.
Result<mesh::Model> witheredModel(const project::Project& project, const mesh::Model& grown, std::size_t sample,
                                  std::uint64_t seed);

}  // namespace sward::bake
