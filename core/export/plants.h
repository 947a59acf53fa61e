#pragma once

#include "base/job.h"
#include "base/result.h"
#include "project/project.h"

#include <filesystem>
#include <vector>

namespace sward::exporting {

/// Writes every plant's models into `folder` (made when needed) as binary glTF, named after the plant; a plant with
/// several variants has their number, from 1, in the name. Plants of the same name are told apart by their place in the
/// list. Gives the files written, in order.
Result<std::vector<std::filesystem::path>> exportPlants(const project::Project& project,
                                                        const std::filesystem::path& folder, const JobContext& job);

}  // namespace sward::exporting
