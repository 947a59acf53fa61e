#pragma once

#include "base/result.h"
#include "mesh/model.h"
#include "project/project.h"
#include "scene/patch.h"

#include <functional>
#include <memory>
#include <vector>

namespace sward::bake {

/// How many different models a plant grows in: its variants when procedural, one from a file.
int variantCount(const project::Plant& plant);

/// Model `variant` of plant `plant` of the project as it grew: procedural, or read from its glTF file. Procedural seeds
/// come from the patch's seed, the plant's place in the list and the variant.
Result<mesh::Model> plantModel(const project::Project& project, std::size_t plant, int variant);

/// A plant as it stands on the patch, which has its variants once in every sample of the mingling: variant index %
/// variants, withered as sample index / variants is (bake/withering.h).
Result<mesh::Model> patchModel(const project::Project& project, std::size_t plant, int index);

/// Gives model `index` of a plant: patchModel, or what is remembered of it.
using ModelSource = std::function<Result<std::shared_ptr<const mesh::Model>>(std::size_t plant, int index)>;

/// The patch as it is traced: every plant's models and all instances; heightM is at least kMinHeightM.
Result<scene::Patch> growPatch(const project::Project& project);
Result<scene::Patch> growPatch(const project::Project& project, const ModelSource& models);

/// Layers of a bare or very low patch still have a thickness (metres).
inline constexpr double kMinHeightM = 0.01;

/// Plants of one kind on the whole patch: density times area, times its part of the shares.
double plantCount(const project::Project& project, std::size_t plant);

}  // namespace sward::bake
