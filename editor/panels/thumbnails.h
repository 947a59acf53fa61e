#pragma once

#include "panels/panel_context.h"

#include <imgui.h>

namespace sward::editor {

/// A plant's thumbnail in a rounded frame; its icon until the picture is there.
void drawThumbnail(const PanelContext& context, std::size_t index, ImVec2 corner, ImVec2 end, const char* icon);

}  // namespace sward::editor
