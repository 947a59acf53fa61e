#pragma once

#include <map>
#include <string>
#include <string_view>

#include <imgui.h>

namespace sward::editor {

/// Where each named item of the user interface stands on the screen: ImGui has no accessibility tree, so this is what
/// tests that click and drag find things by. Names say kind and place: "field:patch.plants[0].grass.heightM",
/// "action:file.save", "curve:profile:point:1".
class ItemLog {
 public:
  struct Item {
    ImVec2 min, max;       ///< pixels of the window, clipped to what is visible
    bool visible = false;  ///< false: scrolled or folded out of sight; min and max are then unclipped
    ImVec2 centre() const { return ImVec2(0.5f * (min.x + max.x), 0.5f * (min.y + max.y)); }
  };

  /// Forgets the last frame; call before the first widget.
  void beginFrame() { m_items.clear(); }
  void add(std::string_view name, ImVec2 min, ImVec2 max, bool visible);

  const std::map<std::string, Item, std::less<>>& items() const { return m_items; }
  /// Null when no item of this name was drawn in this frame.
  const Item* find(std::string_view name) const;
  /// {"items": {NAME: {"x":, "y":, "width":, "height":, "visible":}, ...}}, names in order, one a line.
  std::string toJson() const;

 private:
  std::map<std::string, Item, std::less<>> m_items;
};

/// The log that widgets write to from now on; null (as at the start) turns logging off. Like ImGui's context it is one
/// for the UI thread, and the caller owns it.
void setItemLog(ItemLog* log);
bool loggingItems();

/// Records ImGui's last item under `prefix` + `name`. Costs one comparison while logging is off.
void logItem(std::string_view prefix, std::string_view name = {});
/// Records a rectangle that is no item of ImGui's, such as a point in a plot.
void logRect(std::string_view prefix, std::string_view name, ImVec2 min, ImVec2 max);

}  // namespace sward::editor
