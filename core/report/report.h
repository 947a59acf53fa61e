#pragma once

#include "gpu/context.h"
#include "report/section.h"

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace sward::report {

/// What a report was measured on.
struct Machine {
  std::string cpu;  ///< empty: unknown
  unsigned cores = 0;
  std::uint64_t memoryBytes = 0;  ///< 0: unknown
  gpu::DeviceInfo device;
};
Machine thisMachine(const gpu::DeviceInfo& device);

/// What stands at the top of a report.
struct ReportHead {
  std::string version;      ///< of sward
  std::string project;      ///< its file
  std::string title;        ///< the project's name; empty: the file stands for it
  std::string commandLine;  ///< that makes the report again
  bool quick = false;
  Machine machine;
  std::vector<std::pair<std::string, std::string>> settings;  ///< more names and values, for the page
};

/// report.json as design.md describes it, with the machine's processor, cores, memory and OpenGL renderer. A value that
/// was not measured is absent, and so is one that is not finite: JSON cannot hold it; so is a section that failed.
/// Parameters of a row that are not JSON are an internal error.
std::string reportJson(const ReportHead& head, const std::vector<Section>& sections);

}  // namespace sward::report
