#include "panels/day_panel.h"

#include "widgets/icons.h"
#include "widgets/item_log.h"
#include "widgets/parts.h"
#include "widgets/theme.h"

#include "scene/sun_sky.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include <imgui.h>

namespace sward::editor {
namespace {

constexpr double kHours = 24.0;
constexpr double kLastHour = 23.999;
constexpr double kHoursPerSecond = 1.0;  ///< of playing
constexpr int kSteps = 192;

double elevationAt(scene::SunMoment moment, double hour) {
  moment.hourUtc = std::clamp(hour, 0.0, kLastHour);
  return scene::sunAngles(moment).elevationDeg;
}

}  // namespace

void DayPanel::draw(PanelContext& context) {
  controls(context);
  if (context.project->sun.byMoment) {
    timeline(context);
  } else {
    ImGui::Dummy({0.0f, px(8.0f)});
    hint("The sun stands where its angles say. By date and place, its day can be scrubbed and played here.");
    if (ImGui::Button("Use date and place"))
      context.edits.edit("sun by date and place", [](project::Project& p) { p.sun.byMoment = true; });
    logItem("day.useMoment");
  }
  m_lastSeconds = context.seconds;
}

void DayPanel::setHour(PanelContext& context, double hourUtc) {
  const double hour = std::clamp(hourUtc, 0.0, kLastHour);
  context.edits.edit(
      "time of day", [hour](project::Project& p) { p.sun.moment.hourUtc = hour; }, "sun.moment.hourUtc");
}

void DayPanel::controls(PanelContext& context) {
  UiState& ui = context.ui;
  if (!context.project->sun.byMoment) return;
  const scene::SunMoment& moment = context.project->sun.moment;
  const bool playing = ui.playingDay;
  if (ImGui::Button((std::string(playing ? icon::kPause : icon::kPlay) + (playing ? "  Pause" : "  Play")).c_str())) {
    ui.playingDay = !playing;
    context.edits.closeStep();
  }
  logItem("day.play");
  ImGui::SameLine();
  std::array<char, 160> text{};
  const int minutes = static_cast<int>(std::lround(moment.hourUtc * 60.0));
  std::snprintf(text.data(), text.size(),
                "%04d-%02d-%02d   %02d:%02d UTC   sun %.1f\xC2\xB0 high   %.2f\xC2\xB0 N %.2f\xC2\xB0 E", moment.year,
                moment.month, moment.day, minutes / 60 % 24, minutes % 60, elevationAt(moment, moment.hourUtc),
                moment.latitudeDeg, moment.longitudeDeg);
  ImGui::TextDisabled("%s", text.data());
  if (!playing) return;
  const double elapsed = std::clamp(context.seconds - m_lastSeconds, 0.0, 0.1);
  setHour(context, std::fmod(moment.hourUtc + elapsed * kHoursPerSecond, kLastHour));
  ui.lastMotion = context.seconds;
}

void DayPanel::timeline(PanelContext& context) {
  const Palette& colours = theme().colours;
  const scene::SunMoment& moment = context.project->sun.moment;
  const ImVec2 origin = ImGui::GetCursorScreenPos();
  const ImVec2 room = ImGui::GetContentRegionAvail();
  const ImVec2 size{std::max(room.x, px(60.0f)), std::max(room.y - px(4.0f), px(60.0f))};
  ImGui::InvisibleButton("##day", size);
  logItem("day.timeline");
  const float base = size.y - px(20.0f);
  const auto x = [&](double hour) { return origin.x + static_cast<float>(hour / kHours) * size.x; };
  const auto y = [&](double elevation) {
    return origin.y + base * (0.62f - 0.58f * static_cast<float>(elevation / 90.0));
  };
  ImDrawList* draw = ImGui::GetWindowDrawList();
  draw->PushClipRect(origin, {origin.x + size.x, origin.y + size.y}, true);
  draw->AddRectFilled(origin, {origin.x + size.x, origin.y + base}, colours.plot, px(4.0f));
  // Neighbouring pieces would show a seam each if their edges were smoothed.
  const ImDrawListFlags flags = draw->Flags;
  draw->Flags &= ~ImDrawListFlags_AntiAliasedFill;
  ImVec2 last{x(0.0), y(elevationAt(moment, 0.0))};
  for (int i = 1; i <= kSteps; ++i) {
    const double hour = kHours * i / kSteps;
    const double elevation = elevationAt(moment, hour);
    const ImVec2 point{x(hour), y(elevation)};
    const ImU32 fill = faded(elevation > 0.0 ? colours.sun : colours.info, elevation > 0.0 ? 0.22f : 0.10f);
    draw->AddQuadFilled({last.x, y(0.0)}, last, point, {point.x, y(0.0)}, fill);
    draw->AddLine(last, point, elevation > 0.0 ? colours.sun : colours.textDim, px(1.5f));
    last = point;
  }
  draw->Flags = flags;
  draw->AddLine({origin.x, y(0.0)}, {origin.x + size.x, y(0.0)}, colours.plotGridMajor);
  for (int hour = 0; hour <= 24; hour += size.x > px(600.0f) ? 1 : 3) {
    draw->AddLine({x(hour), origin.y}, {x(hour), origin.y + base}, colours.plotGrid);
    const std::string label = std::to_string(hour);
    const float width = ImGui::CalcTextSize(label.c_str()).x;
    const float left = std::clamp(x(hour) - 0.5f * width, origin.x, origin.x + size.x - width);
    draw->AddText({left, origin.y + base + px(3.0f)}, colours.textDim, label.c_str());
  }
  const ImVec2 head{x(moment.hourUtc), y(elevationAt(moment, moment.hourUtc))};
  draw->AddLine({head.x, origin.y}, {head.x, origin.y + base}, colours.accent, px(1.5f));
  draw->AddCircleFilled(head, px(6.0f), colours.sun);
  draw->PopClipRect();
  if (ImGui::IsItemActive()) {
    m_dragging = true;
    context.ui.playingDay = false;
    setHour(context, (ImGui::GetIO().MousePos.x - origin.x) / size.x * kHours);
  } else if (m_dragging) {
    m_dragging = false;
    context.edits.closeStep();
  }
}

}  // namespace sward::editor
