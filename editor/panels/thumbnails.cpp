#include "panels/thumbnails.h"

#include "widgets/theme.h"

namespace sward::editor {

void drawThumbnail(const PanelContext& context, const project::Plant& plant, std::size_t index, ImVec2 corner,
                   ImVec2 end, const char* icon) {
  ImDrawList* draw = ImGui::GetWindowDrawList();
  (void)context;
  (void)plant;
  (void)index;
  draw->AddRectFilled(corner, end, theme().colours.field, px(4.0f));
  const ImVec2 size = ImGui::CalcTextSize(icon);
  draw->AddText({0.5f * (corner.x + end.x - size.x), 0.5f * (corner.y + end.y - size.y)}, theme().colours.textDim, icon);
}

}  // namespace sward::editor
