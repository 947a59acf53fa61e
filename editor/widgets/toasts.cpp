#include "widgets/toasts.h"

#include "widgets/icons.h"
#include "widgets/item_log.h"
#include "widgets/parts.h"
#include "widgets/theme.h"

#include <algorithm>

namespace sward::editor {
namespace {

struct Sign {
  const char* icon;
  ImU32 colour;
};

Sign signOf(Severity severity) {
  const Palette& c = theme().colours;
  switch (severity) {
    case Severity::Done:
      return {icon::kDone, c.accent};
    case Severity::Warning:
      return {icon::kAlert, c.warning};
    case Severity::Error:
      return {icon::kError, c.error};
    case Severity::Info:
      break;
  }
  return {icon::kInfo, c.info};
}

}  // namespace

int Toasts::add(Severity severity, std::string text, std::string action, double lastsS) {
  for (Toast& toast : m_toasts) {
    if (toast.text != text || toast.severity != severity) continue;
    toast.leftS = toast.lastsS = lastsS;
    return toast.number;
  }
  m_toasts.push_back({m_next, severity, std::move(text), std::move(action), lastsS, lastsS});
  return m_next++;
}

void Toasts::remove(int number) {
  std::erase_if(m_toasts, [number](const Toast& toast) { return toast.number == number; });
}

bool Toasts::needFrames() const {
  return std::any_of(m_toasts.begin(), m_toasts.end(), [](const Toast& toast) { return toast.lastsS >= 0.0; });
}

Toasts::Drawn Toasts::drawOne(Toast& toast, ImVec2 corner, float width) {
  const Palette& c = theme().colours;
  const Sign sign = signOf(toast.severity);
  const std::string name = "toast " + std::to_string(toast.number);
  Drawn drawn;
  // The last half second fades.
  const float alpha = toast.lastsS < 0.0 ? 1.0f : std::clamp(static_cast<float>(toast.leftS) * 2.0f, 0.0f, 1.0f);
  ImGui::PushStyleVar(ImGuiStyleVar_Alpha, std::max(alpha, 0.02f));
  ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(px(12), px(10)));
  ImGui::PushStyleColor(ImGuiCol_WindowBg, c.raised);
  ImGui::SetNextWindowPos(corner, ImGuiCond_Always, ImVec2(1.0f, 1.0f));
  ImGui::SetNextWindowSize(ImVec2(width, 0.0f));
  constexpr ImGuiWindowFlags kFlags = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoNav |
                                      ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoSavedSettings |
                                      ImGuiWindowFlags_AlwaysAutoResize;
  ImGui::Begin(name.c_str(), nullptr, kFlags);
  const ImVec2 min = ImGui::GetWindowPos();
  drawn.height = ImGui::GetWindowSize().y;
  ImGui::PushClipRect(min, ImVec2(min.x + width, min.y + drawn.height), false);
  ImGui::GetWindowDrawList()->AddRectFilled(min, ImVec2(min.x + px(4), min.y + drawn.height), faded(sign.colour, alpha),
                                            px(6), ImDrawFlags_RoundCornersLeft);
  ImGui::PopClipRect();
  ImGui::AlignTextToFramePadding();
  ImGui::TextColored(ImGui::ColorConvertU32ToFloat4(sign.colour), "%s", sign.icon);
  ImGui::SameLine();
  const float room = ImGui::GetFrameHeight() + px(8);
  ImGui::PushTextWrapPos(width - px(12) - room);
  ImGui::TextUnformatted(toast.text.c_str());
  ImGui::PopTextWrapPos();
  logRect("toast:", std::to_string(toast.number), min, ImVec2(min.x + width, min.y + drawn.height));
  ImGui::SameLine(width - px(8) - room);
  drawn.closed = iconButton((name + " close").c_str(), icon::kClose, "Dismiss");
  if (!toast.action.empty()) {
    ImGui::SetCursorPosX(px(12) + ImGui::GetFontSize() + ImGui::GetStyle().ItemSpacing.x);
    drawn.acted = plainButton((name + " act").c_str(), toast.action.c_str());
  }
  const bool rests = ImGui::IsWindowHovered(ImGuiHoveredFlags_AllowWhenBlockedByActiveItem);
  if (toast.lastsS >= 0.0)
    toast.leftS = rests ? toast.lastsS : toast.leftS - static_cast<double>(ImGui::GetIO().DeltaTime);
  ImGui::End();
  ImGui::PopStyleColor();
  ImGui::PopStyleVar(2);
  return drawn;
}

int Toasts::draw(ImVec2 areaMin, ImVec2 areaMax) {
  const float margin = px(12);
  const float width = std::min(px(380), areaMax.x - areaMin.x - 2 * margin);
  if (width < px(80)) return 0;
  int acted = 0;
  ImVec2 corner(areaMax.x - margin, areaMax.y - margin);
  std::vector<int> gone;
  for (auto toast = m_toasts.rbegin(); toast != m_toasts.rend(); ++toast) {
    const Drawn drawn = drawOne(*toast, corner, width);
    if (drawn.acted) acted = toast->number;
    const bool over = toast->lastsS >= 0.0 && toast->leftS <= 0.0;
    if (drawn.closed || drawn.acted || over) gone.push_back(toast->number);
    corner.y -= drawn.height + px(8);
  }
  for (const int number : gone) remove(number);
  return acted;
}

}  // namespace sward::editor
