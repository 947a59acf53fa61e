#pragma once

#include "common.h"

#include "report/choice.h"

#include <optional>
#include <vector>

namespace sward::editor {

/// Where a project bounds its error: chooses the cheapest bake that keeps it in the views, sets it in the project, and
/// says what was chosen and why. Nothing where it does not. A bound that nothing keeps is a warning.
Result<std::optional<report::Choice>> chooseBake(const Program& program, project::Project& project,
                                                 const std::vector<scene::View>& views, gpu::Context& context);
Json choiceJson(const report::Choice& choice);

}  // namespace sward::editor
