#pragma once

#include "panels/panel_context.h"

#include <string>

namespace sward::editor {

/// The line at the bottom: what is baking with progress and time left, frames a second, memory, the renderer.
/// `stalls` is the tooltip of the interface's own times.
void drawStatusBar(PanelContext& context, const std::string& stalls);

/// Resident memory of this process in bytes; 0 where the system does not say.
std::uint64_t residentBytes();

}  // namespace sward::editor
