#pragma once

#include "base/result.h"
#include "gpu/context.h"
#include "report/section.h"

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace sward::report {

/// What stands at the top of a report.
struct ReportHead {
  std::string version;  ///< of sward
  std::string project;  ///< its name and file
  gpu::DeviceInfo device;
};

/// report.json as design.md describes it, with the machine's processor, cores, memory and OpenGL renderer. A value that
/// was not measured is absent. Parameters of a row that are not JSON are an internal error.
std::string reportJson(const ReportHead& head, const std::vector<Section>& sections);

/// Writes it as `folder`/report.json; makes the folder when needed.
Result<std::filesystem::path> writeReport(const std::filesystem::path& folder, const ReportHead& head,
                                          const std::vector<Section>& sections);

}  // namespace sward::report
