#include "panels/curve_panel.h"

#include "panels/season_panel.h"
#include "widgets/item_log.h"
#include "widgets/parts.h"
#include "widgets/theme.h"

#include "project/words.h"
#include "wither/season.h"

#include <algorithm>

#include <imgui.h>

namespace sward::editor {
namespace {

/// The curves of the plant that is selected, or of the season, else of the one whose curve was opened last.
std::vector<CurveEntry> curvesToShow(const PanelContext& context) {
  std::vector<CurveEntry> all = curvesOf(*context.project);
  std::string owner;
  const Selection& selection = context.ui.selection;
  if (selection.kind == Selection::Kind::Plant) {
    owner = "patch.plants[" + std::to_string(selection.index) + "]";
  } else if (selection.kind == Selection::Kind::Wither) {
    owner = "wither";
  } else {
    const auto opened = std::find_if(all.begin(), all.end(),
                                     [&](const CurveEntry& entry) { return entry.path == context.ui.activeCurve; });
    if (opened != all.end()) owner = opened->owner;
  }
  std::erase_if(all, [&](const CurveEntry& entry) { return owner.empty() || entry.owner != owner; });
  return all;
}

bool sameAxes(const project::Spec& a, const project::Spec& b) {
  return std::string_view(a.xLabel) == b.xLabel && a.xLow == b.xLow && a.xHigh == b.xHigh && a.low == b.low &&
         a.high == b.high;
}

std::vector<CurvePreset> presetsFor(const CurveEntry& entry) {
  const project::Spec& spec = entry.spec;
  std::vector<CurvePreset> presets;
  const bool water = entry.path == "wither.ageing.water";
  if (water || entry.path == "wither.ageing.chlorophyll") {
    for (const auto& autumn : project::words(wither::Autumn{})) {
      if (autumn.value == wither::Autumn::Custom) continue;
      wither::AgeingOptions ageing;
      ageing.autumn = autumn.value;
      presets.push_back({autumn.label, water ? wither::waterCurve(ageing) : wither::chlorophyllCurve(ageing)});
    }
  } else {
    presets.push_back({"Built in", {}});
  }
  for (const base::CurvePreset& preset : base::curvePresets())
    presets.push_back({preset.name, base::presetCurve(preset, spec.xLow, spec.xHigh, spec.low, spec.high)});
  return presets;
}

}  // namespace

std::size_t CurvePanel::choose(PanelContext& context, const std::vector<CurveEntry>& curves) {
  const auto open = std::find_if(curves.begin(), curves.end(),
                                 [&](const CurveEntry& entry) { return entry.path == context.ui.activeCurve; });
  std::size_t active = open == curves.end() ? 0 : static_cast<std::size_t>(open - curves.begin());
  for (std::size_t i = 0; i < curves.size(); ++i) {
    const std::string& label = curves[i].label;
    const float width = ImGui::CalcTextSize(label.c_str()).x + 2.0f * ImGui::GetStyle().FramePadding.x;
    if (i > 0) ImGui::SameLine();
    if (i > 0 && ImGui::GetContentRegionAvail().x < width) ImGui::NewLine();
    const bool chosen = i == active;
    if (chosen) ImGui::PushStyleColor(ImGuiCol_Button, theme().colours.accentFill);
    if (ImGui::Button((label + "##" + curves[i].path).c_str())) active = i;
    if (chosen) ImGui::PopStyleColor();
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", curves[i].spec.help);
    logItem("curveTab:", curves[i].path);
  }
  context.ui.activeCurve = curves[active].path;
  return active;
}

void CurvePanel::draw(PanelContext& context) {
  std::vector<CurveEntry> curves = curvesToShow(context);
  if (curves.empty()) {
    hint(
        "Choose a grass or Withering in the outliner: blades' outline, colour and heights, and their ageing are "
        "curves.");
    return;
  }
  const std::size_t active = choose(context, curves);
  const project::Spec& spec = curves[active].spec;
  std::vector<CurveLayer> layers;
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < curves.size(); ++i) {
    if (!sameAxes(curves[i].spec, spec)) continue;
    CurveLayer layer;
    layer.name = curves[i].label;
    layer.curve = &curves[i].curve;
    layer.builtIn = &curves[i].builtIn;
    layer.colour = seasonColour(curves[i].path);
    layers.push_back(layer);
    places.push_back(i);
  }
  CurveAxes axes;
  axes.limits = {spec.xLow, spec.xHigh, spec.low, spec.high};
  axes.xLabel = spec.xLabel;
  axes.yLabel = spec.yLabel;
  CurveEditor& editor = m_editors[curves[active].path];
  editor.setActive(static_cast<std::size_t>(std::find(places.begin(), places.end(), active) - places.begin()));
  const std::vector<CurvePreset> presets = presetsFor(curves[active]);
  const CurveEvents events =
      editor.draw(curves[active].path.c_str(), layers, axes, ImGui::GetContentRegionAvail(), presets);
  if (const std::size_t shown = places[std::min(editor.active(), places.size() - 1)]; shown != active)
    context.ui.activeCurve = curves[shown].path;
  context.ui.inputActive = context.ui.inputActive || (events.changed && !events.finished);
  if (events.changed) {
    const CurveEntry& edited = curves[places[events.layer]];
    context.edits.edit(
        events.label, [&](project::Project& project) { setCurve(project, edited.path, edited.curve); },
        edited.path + ":" + events.label);
  }
  if (events.finished) context.edits.closeStep();
}

}  // namespace sward::editor
