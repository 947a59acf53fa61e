#pragma once

#include "panels/panel_context.h"

#include <optional>
#include <string>

namespace sward::editor {

/// Everything that the project holds, as a list to choose from: the patch's plants with pictures, shares and their own
/// menu, then lights, tiles, light of the day, cameras and how the picture is made.
class OutlinerPanel {
 public:
  void draw(PanelContext& context);

 private:
  void plants(PanelContext& context);
  void plantRow(PanelContext& context, std::size_t index, double shareSum);
  void plantMenu(PanelContext& context, std::size_t index);
  void cameras(PanelContext& context);
  bool row(PanelContext& context, const char* icon, const std::string& label, const Selection& selection,
           const std::string& hint);
  void renameField(PanelContext& context, const std::string& name, bool plant, std::size_t index);

  struct Renaming {
    bool plant = true;
    std::size_t index = 0;
    std::string text;
    bool focused = false;
  };
  std::optional<Renaming> m_renaming;
};

}  // namespace sward::editor
