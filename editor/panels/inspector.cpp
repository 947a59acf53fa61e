#include "panels/inspector.h"

#include "panels/thumbnails.h"
#include "panels/view_edits.h"
#include "widgets/icons.h"
#include "widgets/item_log.h"
#include "widgets/sky_dome.h"
#include "widgets/theme.h"

#include "scene/sun_sky.h"

#include <algorithm>

#include <imgui.h>
#include <imgui_stdlib.h>

namespace sward::editor {
namespace {

std::string titleOf(const PanelContext& context) {
  const Selection& selection = context.ui.selection;
  switch (selection.kind) {
    case Selection::Kind::Ground:
      return "Ground";
    case Selection::Kind::Plant:
      return context.project->patch.plants[selection.index].name;
    case Selection::Kind::Lights:
      return "Light directions";
    case Selection::Kind::Tiles:
      return "Tiles";
    case Selection::Kind::Terrain:
      return "Terrain";
    case Selection::Kind::Wither:
      return "Withering";
    case Selection::Kind::Leaf:
      return "Leaf colour";
    case Selection::Kind::SunSky:
      return "Sun and sky";
    case Selection::Kind::View:
      return "View: " + context.project->views[selection.index].name;
    case Selection::Kind::Sampling:
      return "Layers";
    case Selection::Kind::Fit:
      return "Relighting";
    case Selection::Kind::Render:
      return "Picture";
  }
  return {};
}

}  // namespace

void InspectorPanel::heading(const char* text) {
  ImGui::Dummy({0.0f, px(8.0f)});
  const FontScope font(theme().fonts.strong);
  ImGui::TextUnformatted(text);
}

FieldOptions InspectorPanel::options() const {
  FieldOptions options;
  options.filter = m_filter;
  options.advanced = m_advanced;
  options.labelShare = 0.46f;
  options.problems = &m_problems;
  return options;
}

void InspectorPanel::validate(const PanelContext& context) {
  if (m_validated == context.document.revision()) return;
  m_validated = context.document.revision();
  m_problems = project::validate(*context.project);
}

void InspectorPanel::answer(PanelContext& context, const FieldEvents& events) {
  if (events.finished) {
    context.edits.closeStep();
    m_editing = false;
  }
  if (!events.openCurve.empty()) {
    context.ui.activeCurve = events.openCurve;
    context.ui.bottomTab = BottomTab::Curves;
    context.ui.showBottom = true;
  }
  if (!events.browse.empty()) context.edits.browse(events.browse, events.files);
}

void InspectorPanel::draw(PanelContext& context) {
  validate(context);
  head(context);
  ImGui::BeginChild("##fields", {0.0f, 0.0f}, false);
  const Selection selection = context.ui.selection;
  switch (selection.kind) {
    case Selection::Kind::Ground:
      ground(context);
      break;
    case Selection::Kind::Plant:
      plant(context, selection.index);
      break;
    case Selection::Kind::Lights:
      fields(
          context, "lights", [](project::Project & p) -> auto& { return p.lights; });
      ImGui::Dummy({0.0f, px(6.0f)});
      if (ImGui::Button("Show the hemisphere")) {
        context.ui.bottomTab = BottomTab::Lights;
        context.ui.showBottom = true;
      }
      logItem("inspector.showLights");
      break;
    case Selection::Kind::Tiles:
      fields(
          context, "tiles", [](project::Project & p) -> auto& { return p.tiles; });
      break;
    case Selection::Kind::Terrain:
      fields(
          context, "terrain", [](project::Project & p) -> auto& { return p.terrain; });
      break;
    case Selection::Kind::Wither:
      withering(context);
      break;
    case Selection::Kind::Leaf:
      fields(
          context, "leaf", [](project::Project & p) -> auto& { return p.leaf; });
      break;
    case Selection::Kind::SunSky:
      sunAndSky(context);
      break;
    case Selection::Kind::View:
      view(context, selection.index);
      break;
    case Selection::Kind::Sampling:
      fields(
          context, "sampling", [](project::Project & p) -> auto& { return p.sampling; });
      break;
    case Selection::Kind::Fit:
      fields(
          context, "fit", [](project::Project & p) -> auto& { return p.fit; });
      break;
    case Selection::Kind::Render:
      fields(
          context, "render", [](project::Project & p) -> auto& { return p.render; });
      heading("Accuracy");
      fields(
          context, "accuracy", [](project::Project & p) -> auto& { return p.accuracy; });
      heading("Size of the picture");
      fields(
          context, "output", [](project::Project & p) -> auto& { return p.output; });
      break;
  }
  ImGui::EndChild();
  context.ui.inputActive = context.ui.inputActive || m_editing;
}

void InspectorPanel::head(PanelContext& context) {
  {
    const FontScope font(theme().fonts.heading);
    ImGui::TextUnformatted(titleOf(context).c_str());
  }
  const float button = px(30.0f);
  ImGui::SetNextItemWidth(std::max(ImGui::GetContentRegionAvail().x - button - px(8.0f), px(40.0f)));
  ImGui::InputTextWithHint("##filter", "Find a value", &m_filter);
  logItem("inspector.filter");
  ImGui::SameLine();
  const bool advanced = m_advanced;
  if (advanced) ImGui::PushStyleColor(ImGuiCol_Button, theme().colours.accentFill);
  if (ImGui::Button(icon::kTune, {button, 0.0f})) m_advanced = !m_advanced;
  if (advanced) ImGui::PopStyleColor();
  if (ImGui::IsItemHovered()) ImGui::SetTooltip(m_advanced ? "Hide what few need" : "Show what few need, too");
  logItem("inspector.advanced");
  ImGui::Separator();
}

void InspectorPanel::plant(PanelContext& context, std::size_t index) {
  const std::string path = "patch.plants[" + std::to_string(index) + "]";
  fields(
      context, path, [index](project::Project & p) -> auto& { return p.patch.plants[index]; });
}

void InspectorPanel::ground(PanelContext& context) {
  fields(
      context, "patch", [](project::Project & p) -> auto& { return p.patch; });
}

void InspectorPanel::view(PanelContext& context, std::size_t index) {
  const std::string path = "views[" + std::to_string(index) + "]";
  fields(
      context, path, [index](project::Project & p) -> auto& { return p.views[index]; });
  // A view that the camera stands in takes the camera along.
  if (context.ui.boundView == index && index < context.document.project().views.size())
    context.ui.camera = context.document.project().views[index];
  ImGui::Dummy({0.0f, px(6.0f)});
  if (ImGui::Button("Put the camera here")) {
    context.ui.camera = context.project->views[index];
    context.ui.boundView = index;
    context.ui.lastMotion = context.seconds;
  }
  logItem("inspector.viewGo");
  ImGui::SameLine();
  if (ImGui::Button("Update from the camera")) context.edits.run("view.update");
  logItem("inspector.viewUpdate");
  ImGui::SameLine();
  if (ImGui::Button("Remove")) context.edits.run("view.remove");
  logItem("inspector.viewRemove");
}

void InspectorPanel::sunAndSky(PanelContext& context) {
  const scene::SunOptions& sun = context.project->sun;
  const scene::SunAngles angles = sunAnglesOf(*context.project);
  SkyAngles shown{angles.azimuthDeg, angles.elevationDeg};
  std::vector<SkyAngles> path;
  SkyDomeOptions options;
  options.enabled = !sun.byMoment;
  if (sun.byMoment) {
    scene::SunMoment moment = sun.moment;
    for (int quarter = 0; quarter < 96; ++quarter) {
      moment.hourUtc = 0.25 * quarter;
      const scene::SunAngles at = scene::sunAngles(moment);
      path.push_back({at.azimuthDeg, at.elevationDeg});
    }
    options.path = path;
  }
  const float side = std::min(ImGui::GetContentRegionAvail().x - px(24.0f), px(230.0f));
  const EditState dragged = skyDome("sun", shown, std::max(side, px(60.0f)), options);
  if (dragged.changed) {
    context.edits.edit(
        "sun",
        [&](project::Project& p) {
          p.sun.angles = {shown.azimuthDeg, shown.elevationDeg};
        },
        "sun.angles");
    m_editing = true;
  }
  if (dragged.finished) {
    context.edits.closeStep();
    m_editing = false;
  }
  heading("Sun");
  fields(
      context, "sun", [](project::Project & p) -> auto& { return p.sun; });
  heading("Sky");
  fields(
      context, "sky", [](project::Project & p) -> auto& { return p.sky; });
}

}  // namespace sward::editor
