#pragma once

#include "image/image.h"

#include <imgui.h>

namespace sward::editor {

/// Draws ImGui's triangles on the CPU: the font's texture alone, straight alpha blended in encoded values, as the
/// OpenGL backend does. Returns RGB display values in [0, 1].
image::Image rasterised(const ImDrawData& data, ImFontAtlas& fonts, ImU32 background);

}  // namespace sward::editor
