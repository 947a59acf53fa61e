#include "document/edits.h"
#include "panels/inspector.h"
#include "widgets/icons.h"
#include "widgets/item_log.h"
#include "widgets/parts.h"
#include "widgets/theme.h"

#include "bake/withering.h"
#include "project/schema.h"
#include "wither/season.h"

#include <array>
#include <cstdio>

#include <imgui.h>

/// The withering of a sward in the inspector: degree, ageing, body, mingling, texel.
namespace sward::editor {
namespace {

/// The ageing as the inspector shows it: with the autumn's curves, and the line that stands for no weathering curve.
wither::AgeingOptions shownAgeing(const wither::AgeingOptions& ageing) {
  wither::AgeingOptions shown = ageing;
  shown.water = wither::waterCurve(ageing);
  shown.chlorophyll = wither::chlorophyllCurve(ageing);
  if (ageing.weathering.points().empty()) {
    shown.weathering = base::Curve::fromPoints({{0.0, 0.0}, {1.0, 1.0}}).value();
  }
  return shown;
}

/// Puts into a project what the fields made of `shown`.
void applyAgeing(project::Project& project, const wither::AgeingOptions& shown, const wither::AgeingOptions& edited) {
  wither::AgeingOptions& ageing = project.wither.ageing;
  if (edited.autumn != shown.autumn) chooseAutumn(project, edited.autumn);
  if (!(edited.water == shown.water)) setWater(project, edited.water);
  if (!(edited.chlorophyll == shown.chlorophyll)) setChlorophyll(project, edited.chlorophyll);
  if (!(edited.weathering == shown.weathering)) ageing.weathering = edited.weathering;
  ageing.tipLead = edited.tipLead;
  ageing.variation = edited.variation;
}

/// The archive that finds what the schema says of one field.
class SpecFinder {
 public:
  template <typename T>
  using Ref = const T&;

  explicit SpecFinder(std::string_view wanted) : m_wanted(wanted) {}
  void version(int) {}
  template <typename T>
  void field(std::string_view name, const T&, const project::Spec& spec = {}) {
    if (name == m_wanted) m_found = spec;
  }
  const project::Spec& found() const { return m_found; }

 private:
  std::string_view m_wanted;
  project::Spec m_found;
};

}  // namespace

void InspectorPanel::withering(PanelContext& context) {
  degree(context);
  heading("Ageing");
  ageing(context);
  heading("Mingling");
  mingling(context);
  heading("Body");
  fields(
      context, "wither.body", [](project::Project & p) -> auto& { return p.wither.body; });
  heading("Texel");
  fields(
      context, "wither.texel", [](project::Project & p) -> auto& { return p.wither.texel; });
  heading("Sequence");
  fields(
      context, "sequence", [](project::Project & p) -> auto& { return p.sequence; });
}

void InspectorPanel::degree(PanelContext& context) {
  const wither::WitherOptions defaults;
  double weathering = context.project->wither.weathering;
  SpecFinder spec("weathering");
  project::describe(spec, defaults);
  const FieldOptions held = options();
  FieldPainter painter("wither", held);
  FieldWalker walker(painter, "wither", {&defaults.weathering});
  walker.field("weathering", weathering, spec.found());
  const FieldEvents events = painter.finish();
  if (events.changed) {
    context.edits.edit(
        events.label, [&](project::Project& p) { p.wither.weathering = weathering; }, events.path);
    context.ui.season.running = false;
    context.ui.season.at.reset();
    m_editing = true;
  }
  answer(context, events);
  ImGui::Dummy({0.0f, px(2.0f)});
  if (ImGui::Button((std::string(icon::kPlay) + "  Show the season").c_str())) {
    context.ui.bottomTab = BottomTab::Season;
    context.ui.showBottom = true;
  }
  logItem("inspector.showSeason");
}

void InspectorPanel::ageing(PanelContext& context) {
  const wither::AgeingOptions& stored = context.project->wither.ageing;
  const wither::AgeingOptions shown = shownAgeing(stored);
  // Curves that come with the autumn are no deviation of their own.
  wither::AgeingOptions defaults;
  const bool own = stored.autumn == wither::Autumn::Custom;
  if (!own || stored.water.points().empty()) defaults.water = shown.water;
  if (!own || stored.chlorophyll.points().empty()) defaults.chlorophyll = shown.chlorophyll;
  if (stored.weathering.points().empty()) defaults.weathering = shown.weathering;
  wither::AgeingOptions edited = shown;
  const FieldEvents events = drawFields("wither.ageing", edited, defaults, options());
  if (events.changed) {
    context.edits.edit(
        events.label, [&](project::Project& p) { applyAgeing(p, shown, edited); }, events.path);
    m_editing = true;
  }
  answer(context, events);
}

void InspectorPanel::mingling(PanelContext& context) {
  const auto& samples = context.project->wither.mingle;
  double shareSum = 0.0;
  for (const wither::MingleSample& sample : samples) shareSum += sample.share;
  if (samples.empty()) hint("All blades age alike. Samples let some stay green while others are straw.");
  for (std::size_t i = 0; i < samples.size(); ++i) mingleSample(context, i, shareSum);
  ImGui::Dummy({0.0f, px(2.0f)});
  if (ImGui::Button((std::string(icon::kAdd) + "  Add sample").c_str()))
    context.edits.edit("add sample", [](project::Project& p) { addMingleSample(p); });
  logItem("mingle.add");
  if (!samples.empty()) return;
  ImGui::SameLine();
  if (ImGui::Button("Green, turning, straw"))
    context.edits.edit("green, turning, straw", [](project::Project& p) { mingleGreenTurningStraw(p); });
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("Three samples to start from: late, with the sward, and early");
  logItem("mingle.three");
}

void InspectorPanel::mingleSample(PanelContext& context, std::size_t index, double shareSum) {
  const wither::MingleSample& sample = context.project->wither.mingle[index];
  ImGui::PushID(static_cast<int>(index));
  ImGui::Dummy({0.0f, px(2.0f)});
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float side = ImGui::GetTextLineHeight();
  ImGui::GetWindowDrawList()->AddRectFilled({at.x + px(2.0f), at.y + px(6.0f)},
                                            {at.x + px(10.0f), at.y + px(2.0f) + side},
                                            theme().colours.series[index % theme().colours.series.size()], px(2.0f));
  ImGui::SetCursorPosX(ImGui::GetCursorPosX() + px(14.0f));
  ImGui::AlignTextToFramePadding();
  std::array<char, 48> part{};
  const double percent = shareSum > 0.0 ? 100.0 * sample.share / shareSum : 0.0;
  std::snprintf(part.data(), part.size(), "%.0f %% of the blades", percent);
  ImGui::TextDisabled("%s", part.data());
  const float button = ImGui::GetFrameHeight() + px(4.0f);
  ImGui::SameLine(ImGui::GetContentRegionMax().x - button);
  if (iconButton("remove", icon::kClose, "Remove this sample"))
    context.edits.edit("remove sample", [index](project::Project& p) { removeMingleSample(p, index); });
  logItem("mingle.remove:", std::to_string(index));
  fields(
      context, "wither.mingle[" + std::to_string(index) + "]", [index](project::Project & p) -> auto& {
        return p.wither.mingle[index];
      });
  ImGui::PopID();
}

}  // namespace sward::editor
