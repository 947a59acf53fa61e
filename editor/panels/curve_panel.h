#pragma once

#include "panels/curve_list.h"
#include "panels/panel_context.h"
#include "widgets/curve_editor.h"

#include <map>
#include <string>
#include <vector>

namespace sward::editor {

/// The curves of the selected plant in the one curve editor (blade profile, colour along the blade, density by height),
/// or those of the season: water, chlorophyll, weathering and how the mingled samples age.
/// The active one is edited; those with the same axes are drawn beneath it.
class CurvePanel {
 public:
  void draw(PanelContext& context);

 private:
  /// Tabs of the owner's curves; the one to edit.
  std::size_t choose(PanelContext& context, const std::vector<CurveEntry>& curves);

  std::map<std::string, CurveEditor> m_editors;  ///< by path: each keeps its own zoom and selection
};

}  // namespace sward::editor
