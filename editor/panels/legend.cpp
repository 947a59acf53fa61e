#include "panels/legend.h"

#include "widgets/theme.h"

#include <algorithm>

namespace sward::editor {
namespace {

constexpr ImU32 kBack = IM_COL32(20, 22, 20, 200);
constexpr ImU32 kText = IM_COL32(235, 238, 232, 255);
constexpr float kBarWidth = 220.0f, kBarHeight = 12.0f, kPad = 10.0f, kSwatch = 14.0f;
/// More swatches than this say no more.
constexpr std::size_t kMostSwatches = 18;

ImU32 colourOf(const render::ByteColour& c) {
  return IM_COL32(c[0], c[1], c[2], 255);
}

void drawBar(ImDrawList* draw, const render::Legend& legend, ImVec2 at) {
  const float width = px(kBarWidth), height = px(kBarHeight);
  for (std::size_t i = 1; i < legend.stops.size(); ++i) {
    const auto& a = legend.stops[i - 1];
    const auto& b = legend.stops[i];
    const ImVec2 from{at.x + width * static_cast<float>(a.at), at.y};
    const ImVec2 to{at.x + width * static_cast<float>(b.at), at.y + height};
    draw->AddRectFilledMultiColor(from, to, colourOf(a.colour), colourOf(b.colour), colourOf(b.colour),
                                  colourOf(a.colour));
  }
  for (const auto& tick : legend.ticks) {
    const float x = at.x + width * static_cast<float>(tick.at);
    const float text = ImGui::CalcTextSize(tick.text.c_str()).x;
    draw->AddLine({x, at.y + height}, {x, at.y + height + px(3.0f)}, kText);
    const float left = std::clamp(x - 0.5f * text, at.x, at.x + width - text);
    draw->AddText({left, at.y + height + px(4.0f)}, kText, tick.text.c_str());
  }
}

}  // namespace

void drawLegend(const render::Legend& legend, ImVec2 corner) {
  if (legend.title.empty()) return;
  const FontScope font(theme().fonts.small);
  ImDrawList* draw = ImGui::GetWindowDrawList();
  const float line = ImGui::GetTextLineHeight();
  const std::size_t swatches = std::min(legend.swatches.size(), kMostSwatches);
  const float pitch = px(kSwatch) + ImGui::CalcTextSize("00").x + px(8.0f);
  const float swatchRows = static_cast<float>((swatches + 5) / 6);
  float height = line + px(2.0f * kPad);
  if (!legend.stops.empty()) height += px(6.0f + kBarHeight + 4.0f) + line;
  if (swatches > 0) height += px(6.0f) + swatchRows * px(kSwatch + 6.0f);
  const float width =
      std::max({px(kBarWidth), swatches > 0 ? 6.0f * pitch : 0.0f, ImGui::CalcTextSize(legend.title.c_str()).x}) +
      px(2.0f * kPad);
  const ImVec2 top{corner.x, corner.y - height};
  draw->AddRectFilled(top, {top.x + width, corner.y}, kBack, px(6.0f));
  draw->AddText({top.x + px(kPad), top.y + px(kPad)}, kText, legend.title.c_str());
  const ImVec2 inner{top.x + px(kPad), top.y + px(kPad + 6.0f) + line};
  if (!legend.stops.empty()) drawBar(draw, legend, inner);
  for (std::size_t i = 0; i < swatches; ++i) {
    const ImVec2 at{inner.x + static_cast<float>(i % 6) * pitch,
                    inner.y + static_cast<float>(i / 6) * px(kSwatch + 6.0f)};
    draw->AddRectFilled(at, {at.x + px(kSwatch), at.y + px(kSwatch)}, colourOf(legend.swatches[i].colour), px(3.0f));
    draw->AddText({at.x + px(kSwatch + 4.0f), at.y}, kText, legend.swatches[i].text.c_str());
  }
}

}  // namespace sward::editor
