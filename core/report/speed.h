#pragma once

#include "base/job.h"
#include "base/result.h"
#include "gpu/context.h"
#include "project/project.h"
#include "report/row.h"

#include <filesystem>
#include <vector>

namespace sward::report {

struct SpeedInput {
  const project::Project& project;
  gpu::Context& context;              ///< current on this thread
  std::filesystem::path cacheFolder;  ///< of baked results; used and filled
  bool quick = false;                 ///< fewer runs and smaller sizes; no cold bake
};

/// Section `speed`: every target of the first step, one row each, measured in this run on the project's ground at
/// 1280x720. Progress counts rows.
Result<std::vector<Row>> speedRows(const SpeedInput& input, const JobContext& job);

}  // namespace sward::report
