#pragma once

#include "base/result.h"
#include "lpt/options.h"
#include "project/project.h"
#include "render/options.h"

#include <string>
#include <vector>

namespace sward::editor {

/// Sets what --method names in a project: how the ground is drawn (march, blended, blended_paper) and what its light
/// response is kept as (lpt::kMethods; ptm16 is another name of ptm). One of each kind at most, in any order, repeated
/// or separated by commas.
Result<void> applyMethods(const std::vector<std::string>& methods, project::Project& project);

/// "march, blended, ..." for help.
std::string methodNames();

}  // namespace sward::editor
