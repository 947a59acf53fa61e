#pragma once

#include "render/view_mode.h"

#include <imgui.h>

namespace sward::editor {

/// Draws how to read a view mode: a bar of colours with its values, or the colours of what is counted. `corner` is the
/// lower left one; nothing for a mode without a legend.
void drawLegend(const render::Legend& legend, ImVec2 corner);

}  // namespace sward::editor
