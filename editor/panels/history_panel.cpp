#include "panels/history_panel.h"

#include "widgets/item_log.h"
#include "widgets/theme.h"

#include <imgui.h>

namespace sward::editor {

void drawHistory(PanelContext& context) {
  const std::vector<std::string> names = context.document.stepNames();
  const std::size_t position = context.document.position();
  const auto line = [&](std::size_t index, const std::string& name) {
    const bool undone = index > position;
    if (undone) ImGui::PushStyleColor(ImGuiCol_Text, theme().colours.textDim);
    if (ImGui::Selectable((name + "##" + std::to_string(index)).c_str(), index == position)) {
      const std::string action = index < position ? "edit.undo" : "edit.redo";
      const std::size_t steps = index < position ? position - index : index - position;
      for (std::size_t i = 0; i < steps; ++i) context.edits.run(action);
    }
    if (undone) ImGui::PopStyleColor();
    logItem("history:", std::to_string(index));
  };
  line(0, context.document.file().empty() ? "Started" : "Opened " + context.document.file().filename().string());
  for (std::size_t i = 0; i < names.size(); ++i) line(i + 1, names[i]);
}

}  // namespace sward::editor
