#pragma once

#include "common.h"

#include "report/section.h"

#include <string>
#include <vector>

namespace sward::editor {

/// A section that `sward report` can measure.
struct SectionEntry {
  std::string name;   ///< as design.md lists it
  std::string about;  ///< one line of --help
  report::MeasureSection measure;
  double seconds = 10.0;  ///< about how long it takes on two cores, for the progress bar
};

/// All that exist, in the order of the report. `projectFile` is what section speed opens in the editor.
std::vector<SectionEntry> reportSections(const Program& program, const std::string& projectFile);

/// Those with these names, in the order of the report; all for no names. Errors: a name that none has.
Result<std::vector<SectionEntry>> chooseSections(std::vector<SectionEntry> all, const std::vector<std::string>& names);

}  // namespace sward::editor
