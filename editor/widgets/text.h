#pragma once

#include <string>
#include <string_view>

#include <imgui.h>

namespace sward::editor {

/// Draws text from `at` that ends in an ellipsis where it would pass `right` (screen x).
void textEllipsis(ImVec2 at, float right, ImU32 colour, std::string_view text);

/// Every word of `words` stands in `text`, whatever the case. No words match everything.
bool holdsWords(std::string_view text, std::string_view words);

/// The last item has been under the resting mouse long enough for a tooltip.
bool hoveredForAWhile();
/// A tooltip of the last item, wrapped; `shortcut` (may be empty) stands dim beside the text.
void hoverText(const char* text, const char* shortcut = "");

/// A text field that takes its value over once, when it is left (Escape leaves it as it was): true in that frame.
/// Items drawn over many frames need nothing else; `hint` shows while it is empty.
bool commitText(const char* id, std::string& value, float width, const char* hint = "");

}  // namespace sward::editor
