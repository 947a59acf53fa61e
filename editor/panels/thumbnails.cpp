#include "panels/thumbnails.h"

#include "widgets/theme.h"

namespace sward::editor {

void drawThumbnail(const PanelContext& context, std::size_t index, ImVec2 corner, ImVec2 end, const char* icon) {
  ImDrawList* draw = ImGui::GetWindowDrawList();
  const Palette& colours = theme().colours;
  draw->AddRectFilled(corner, end, mixed(colours.field, colours.text, 0.22f), px(4.0f));
  const auto& pictures = *context.live.thumbnails;
  const auto found = pictures.find(index);
  if (found != pictures.end() && found->second.texture != 0) {
    // Thin blades cover little of a small picture: drawn three times they can be seen. ImGui's OpenGL backend takes the
    // texture's name for its handle.
    for (int i = 0; i < 3; ++i)
      draw->AddImage(reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(found->second.texture)), corner, end);
    return;
  }
  const ImVec2 size = ImGui::CalcTextSize(icon);
  draw->AddText({0.5f * (corner.x + end.x - size.x), 0.5f * (corner.y + end.y - size.y)}, theme().colours.textDim,
                icon);
}

}  // namespace sward::editor
