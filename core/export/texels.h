#pragma once

#include "base/job.h"
#include "base/result.h"
#include "project/project.h"

#include <filesystem>
#include <string>
#include <vector>

namespace sward::exporting {

/// Writes the texel of a project into `folder` (made when needed) as an OpenVDB file (export/vdb.h): NAME.vdb at the
/// project's weathering degree, or for more than one of `frames` NAME.0001.vdb and so on, at degrees evenly from 0
/// to 1. Gives the files written, in order. Errors: the folder, a missing asset, a full disk; Error::cancelled() leaves
/// whole files alone.
Result<std::vector<std::filesystem::path>> exportTexels(const project::Project& project, const std::string& name,
                                                        const std::filesystem::path& folder, int frames,
                                                        const JobContext& job);

}  // namespace sward::exporting
