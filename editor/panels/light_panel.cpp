#include "panels/light_panel.h"

#include "document/edits.h"
#include "panels/view_edits.h"
#include "widgets/icons.h"
#include "widgets/item_log.h"
#include "widgets/parts.h"
#include "widgets/theme.h"

#include "project/words.h"
#include "scene/lights.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include <imgui.h>

namespace sward::editor {
namespace {

constexpr int kGrid = 48;
constexpr float kLegendHeight = 46.0f;  ///< under the hemisphere, design pixels
/// Leverage above 1 is extrapolation; what lies far above looks the same.
constexpr double kMostLeverage = 1.5;
constexpr double kMostGapDeg = 45.0;

void line(const char* label, const std::string& value, const char* help, ImU32 colour) {
  ImGui::TextDisabled("%s", label);
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", help);
  ImGui::SameLine(px(150.0f));
  ImGui::TextColored(ImGui::ColorConvertU32ToFloat4(colour), "%s", value.c_str());
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", help);
}

std::string number(const char* format, double value) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), format, value);
  return text.data();
}

/// The map's rows run from the north down; the widget's from the south up.
HemisphereValues flipped(const std::vector<float>& rows, double high, const char* title, const char* unit) {
  HemisphereValues out;
  out.side = kGrid;
  out.high = high;
  out.title = title;
  out.unit = unit;
  out.values.resize(rows.size());
  for (std::size_t y = 0; y < kGrid; ++y)
    std::copy_n(rows.begin() + static_cast<std::ptrdiff_t>((kGrid - 1 - y) * kGrid), kGrid,
                out.values.begin() + static_cast<std::ptrdiff_t>(y * kGrid));
  return out;
}

std::vector<scene::SunAngles> anglesOf(const std::vector<glm::dvec3>& directions) {
  std::vector<scene::SunAngles> angles;
  for (const glm::dvec3& direction : directions) angles.push_back(scene::anglesFromDirection(direction));
  return angles;
}

}  // namespace

void LightPanel::measure(const scene::LightOptions& options) {
  if (m_quality && m_measured == options) return;
  const auto directions = scene::lightDirections(options);
  m_directions = directions.ok() ? *directions : std::vector<glm::dvec3>{};
  m_measured = options;
  m_quality.emplace(m_directions);
  const lpt::HemisphereMap map = lpt::hemisphereMap(*m_quality, kGrid);
  m_leverage = flipped(map.leverage, kMostLeverage, "Leverage", "");
  m_gap = flipped(map.gapDeg, kMostGapDeg, "Gap", "\xC2\xB0");
}

void LightPanel::draw(PanelContext& context) {
  measure(context.project->lights);
  const float side = std::max(std::min(ImGui::GetContentRegionAvail().y - px(kLegendHeight), px(520.0f)), px(60.0f));
  palette(context, side);
  ImGui::SameLine(0.0f, px(24.0f));
  ImGui::BeginChild("##lightSide");
  patterns(context);
  ImGui::Dummy({0.0f, px(6.0f)});
  figures(context);
  ImGui::EndChild();
}

void LightPanel::palette(PanelContext& context, float side) {
  const bool list = context.project->lights.pattern == scene::LightPattern::List;
  std::vector<scene::SunAngles> lights = list ? context.project->lights.directions : anglesOf(m_directions);
  const scene::SunAngles sun = sunAnglesOf(*context.project);
  const HemisphereValues* values = m_ground == Ground::Leverage ? &m_leverage
                                   : m_ground == Ground::Gap    ? &m_gap
                                                                : nullptr;
  const LightEvents events =
      m_palette.draw("palette", lights, list, side, SkyAngles{sun.azimuthDeg, sun.elevationDeg}, values);
  if (events.changed) {
    context.edits.edit(
        events.label, [&](project::Project& p) { p.lights.directions = lights; }, "lights.directions");
    context.ui.inputActive = context.ui.inputActive || !events.finished;
  }
  if (events.finished) context.edits.closeStep();
}

void LightPanel::patterns(PanelContext& context) {
  const scene::LightPattern now = context.project->lights.pattern;
  ImGui::TextDisabled("Pattern");
  for (const auto& word : project::words(scene::LightPattern{})) {
    ImGui::SameLine();
    const bool chosen = word.value == now;
    if (chosen) ImGui::PushStyleColor(ImGuiCol_Button, theme().colours.accentFill);
    const bool pressed = ImGui::Button(word.label);
    if (chosen) ImGui::PopStyleColor();
    logItem("lights.pattern:", word.text);
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", word.help);
    if (!pressed || chosen) continue;
    if (word.value == scene::LightPattern::List) {
      const std::vector<scene::SunAngles> angles = anglesOf(m_directions);
      context.edits.edit("list of lights", [&](project::Project& p) { convertToList(p, angles); });
    } else {
      context.edits.edit("light pattern", [&](project::Project& p) { p.lights.pattern = word.value; });
    }
    context.ui.selection = {Selection::Kind::Lights, 0, {}};
  }
  if (now != scene::LightPattern::List) {
    hint("The pattern's values are on the right. Make it a list to move, add and remove lights.");
  } else {
    hint("Drag to move, double-click to add, Delete to remove.");
  }
  ImGui::TextDisabled("Colours");
  constexpr std::array<std::pair<Ground, const char*>, 3> kGrounds{
      {{Ground::Leverage, "Certainty"}, {Ground::Gap, "Gaps"}, {Ground::None, "None"}}};
  for (const auto& [ground, label] : kGrounds) {
    ImGui::SameLine();
    if (ImGui::RadioButton(label, m_ground == ground)) m_ground = ground;
  }
}

void LightPanel::figures(PanelContext&) {
  const Palette& colours = theme().colours;
  const lpt::LightSetQuality& q = *m_quality;
  line("Lights", std::to_string(m_directions.size()), "Directions that are traced; time and memory grow with them",
       colours.text);
  line("Rank", std::to_string(q.rank()) + " of 6",
       "How many of the six functions of the light's direction the set tells apart",
       q.rank() < 6 ? colours.error : colours.text);
  const bool bad = !(q.condition() < 100.0);
  line("Condition", std::isfinite(q.condition()) ? number("%.1f", q.condition()) : std::string("infinite"),
       "Largest over smallest singular value: how much the fit amplifies noise. 5 to 10 is good",
       bad ? colours.warning : colours.text);
  line("Covered", number("%.0f %%", 100.0 * q.coverage()),
       "Share of the hemisphere where relighting is no extrapolation (leverage at most 1)",
       q.coverage() < 0.8 ? colours.warning : colours.text);
  line("Largest gap", number("%.0f\xC2\xB0", q.worstGapDeg()), "Largest angle from a direction to its nearest light",
       q.worstGapDeg() > 50.0 ? colours.warning : colours.text);
}

}  // namespace sward::editor
