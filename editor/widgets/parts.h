#pragma once

#include <string>

#include <imgui.h>

/// Small parts that panels are made of. Each logs itself as "action:ID".
namespace sward::editor {

/// A square button with an icon; `tooltip` says what it does, `shortcut` (may be empty) how the keyboard does it.
bool iconButton(const char* id, const char* icon, const char* tooltip, const char* shortcut = "", bool enabled = true);
/// The same that stays pressed while `on`; true when it was clicked (the caller switches).
bool toolToggle(const char* id, const char* icon, bool on, const char* tooltip, const char* shortcut = "",
                bool enabled = true);
/// The button that a dialog is about: filled with the accent. Its width fits the text when 0.
bool primaryButton(const char* id, const char* text, bool enabled = true, float width = 0.0f);
bool plainButton(const char* id, const char* text, bool enabled = true, float width = 0.0f);

/// A box that is ticked or not, as high as a field and as wide as its box; true when it changed.
bool tickBox(const char* id, bool& on);

/// A field with a magnifier and, once it holds text, a cross that empties it; Escape empties it too. True on a change.
bool searchBox(const char* id, std::string& text, float width, const char* hint = "Search");

/// A foldable title over the window's width; remembers in ImGui's storage whether it is open. `count` (may be empty)
/// stands dim behind the title.
bool sectionHeader(const char* id, const char* title, bool openAtFirst = true, const char* count = "");

/// A rounded bar that fills from the left: fraction 0 to 1, or below 0 when it is not known (it then moves). True when
/// its cross was clicked, which is there when `cancellable`.
bool progressPill(const char* id, const char* text, float fraction, float width, bool cancellable = false);

/// "Ctrl+Shift+S" as three key caps in one line.
void keyCaps(const char* shortcut);

/// A cell of a grid of pictures: `texture` null shows `icon`. True when clicked; the name is shortened to the cell.
bool thumbnailCell(const char* id, const char* name, ImTextureID texture, const char* icon, bool selected, float side);

/// A handle between two panes at the cursor, `length` long; upright (drags left and right) or level. Adds the drag to
/// `size`, held in [least, most]. A double-click calls for `usual`. True while it changes.
bool splitHandle(const char* id, bool upright, float length, float& size, float least, float most, float usual);

/// Text of a dim hint, wrapped to the window.
void hint(const char* text);

}  // namespace sward::editor
