#include "panels/season_panel.h"

#include "panels/view_edits.h"
#include "widgets/field_look.h"
#include "widgets/icons.h"
#include "widgets/item_log.h"
#include "widgets/number_field.h"
#include "widgets/parts.h"
#include "widgets/theme.h"

#include "project/schema.h"
#include "project/sequence.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>

#include <imgui.h>

namespace sward::editor {
namespace {

constexpr int kSteps = 160;

struct Line {
  const char* name;
  base::Curve curve;  ///< empty: equal to the season
  ImU32 colour;
  double at(double season) const { return curve.points().empty() ? season : curve(season); }
};

/// The archive that finds what the schema says of the sequence's numbers.
struct SpecsOf {
  template <typename T>
  using Ref = const T&;
  project::Spec frames, rate;
  template <typename T>
  void field(std::string_view name, const T&, const project::Spec& spec = {}) {
    if (name == "frames") frames = spec;
    if (name == "framesPerSecond") rate = spec;
  }
};

std::array<Line, 3> linesOf(const wither::AgeingOptions& ageing) {
  return {{{"Water", wither::waterCurve(ageing), seasonColour("wither.ageing.water")},
           {"Chlorophyll", wither::chlorophyllCurve(ageing), seasonColour("wither.ageing.chlorophyll")},
           {"Weathering", ageing.weathering, seasonColour("wither.ageing.weathering")}}};
}

double lengthOf(const project::Sequence& sequence) {
  return sequence.frames / sequence.framesPerSecond;
}

/// The frame that stands at a time of the sequence.
int frameOf(const project::Sequence& sequence, double seconds) {
  const double frame = std::floor(seconds * sequence.framesPerSecond * (1.0 + 1e-12));
  return static_cast<int>(std::clamp(frame, 0.0, sequence.frames - 1.0));
}

/// Names and values at a moment, half way up the plot between `min` and `max`, where the curves of most autumns leave
/// room, on the side that the head is not on.
void drawLegend(const std::array<Line, 3>& lines, double moment, ImVec2 min, ImVec2 max) {
  const Palette& c = theme().colours;
  const FontScope font(theme().fonts.small);
  ImDrawList* draw = ImGui::GetWindowDrawList();
  std::array<std::string, 3> texts;
  float width = 0.0f;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    std::array<char, 48> text{};
    std::snprintf(text.data(), text.size(), "%s  %.0f %%", lines[i].name, 100.0 * lines[i].at(moment));
    texts[i] = text.data();
    width = std::max(width, ImGui::CalcTextSize(text.data()).x);
  }
  const float line = ImGui::GetTextLineHeight() + px(3.0f);
  const ImVec2 size{width + px(28.0f), 3.0f * line + px(6.0f)};
  const float left = moment > 0.35 ? min.x + px(8.0f) : max.x - px(8.0f) - size.x;
  const float top = 0.5f * (min.y + max.y - size.y);
  draw->AddRectFilled({left, top}, {left + size.x, top + size.y}, faded(c.panel, 0.85f), px(4.0f));
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const float y = top + px(4.0f) + line * static_cast<float>(i);
    const float middle = y + 0.5f * ImGui::GetTextLineHeight();
    draw->AddRectFilled({left + px(6.0f), middle - px(1.5f)}, {left + px(16.0f), middle + px(1.5f)}, lines[i].colour);
    draw->AddText({left + px(21.0f), y}, c.text, texts[i].c_str());
  }
}

/// The next item goes on in the line where it fits, else it begins another.
void besideIfRoom(float gap, float width) {
  const float end = ImGui::GetWindowPos().x + ImGui::GetWindowContentRegionMax().x;
  if (ImGui::GetItemRectMax().x + gap + width <= end) ImGui::SameLine(0.0f, gap);
}

/// Labels under the timeline: its ends, and as many tenths between them as have room.
void drawMoments(ImDrawList& draw, const ImVec2& origin, float width, float top) {
  const FontScope font(theme().fonts.small);
  const ImU32 colour = theme().colours.textDim;
  const std::string first = "Season's beginning", last = "end";
  float taken = origin.x + ImGui::CalcTextSize(first.c_str()).x;
  const float end = origin.x + width - ImGui::CalcTextSize(last.c_str()).x;
  draw.AddText({origin.x, top}, colour, first.c_str());
  draw.AddText({end, top}, colour, last.c_str());
  for (int tenth = 1; tenth < 10; ++tenth) {
    const std::string label = std::to_string(10 * tenth) + " %";
    const float wide = ImGui::CalcTextSize(label.c_str()).x;
    const float left = origin.x + 0.1f * static_cast<float>(tenth) * width - 0.5f * wide;
    if (left < taken + px(8.0f) || left + wide > end - px(8.0f)) continue;
    draw.AddText({left, top}, colour, label.c_str());
    taken = left + wide;
  }
}

}  // namespace

std::uint32_t seasonColour(std::string_view path) {
  const Palette& c = theme().colours;
  if (path == "wither.ageing.water") return c.info;
  if (path == "wither.ageing.chlorophyll") return c.accent;
  return path == "wither.ageing.weathering" ? c.sun : 0;
}

double shownMoment(const UiState& ui, const project::Project& project) {
  if (ui.season.at) return *ui.season.at;
  const double wanted = std::clamp(project.wither.weathering, 0.0, 1.0);
  const wither::AgeingOptions& ageing = project.wither.ageing;
  if (ageing.weathering.points().empty()) return wanted;
  // As wither::Season::seasonOf, without the season's bodies: the earliest moment of the degree.
  if (project::weatheringAt(ageing, 0.0) >= wanted) return 0.0;
  const double reached = std::min(wanted, project::weatheringAt(ageing, 1.0));
  double low = 0.0, high = 1.0;
  for (int i = 0; i < 40; ++i) {
    const double middle = 0.5 * (low + high);
    (project::weatheringAt(ageing, middle) >= reached ? high : low) = middle;
  }
  return high;
}

void togglePlay(UiState& ui, const project::Project& project) {
  SeasonPlay& play = ui.season;
  if (play.running) {
    play.running = false;
    return;
  }
  const double length = lengthOf(project.sequence);
  // A pause goes on where it was; a sequence may show one moment several times.
  if (!play.at) play.seconds = length * project::shareOfSeason(project.sequence, shownMoment(ui, project));
  const bool ended = play.seconds >= length || (play.at && *play.at >= 1.0 && project.sequence.season.points().empty());
  if (ended) {
    play.seconds = 0.0;
    play.at = project::seasonAt(project.sequence, 0.0);
  } else {
    play.at = shownMoment(ui, project);
  }
  play.weathering = project::weatheringAt(project.wither.ageing, *play.at);
  play.running = true;
}

void advancePlay(SeasonPlay& play, const project::Project& project, double seconds) {
  const project::Sequence& sequence = project.sequence;
  const double length = lengthOf(sequence);
  play.seconds = std::max(play.seconds + seconds, 0.0);
  if (play.seconds >= length) {
    play.running = play.loop;
    play.seconds = play.loop ? std::fmod(play.seconds, length) : length;
  }
  play.at = project::seasonAt(sequence, project::shareOf(sequence, frameOf(sequence, play.seconds)));
  play.weathering = project::weatheringAt(project.wither.ageing, *play.at);
}

void SeasonPanel::draw(PanelContext& context) {
  controls(context);
  timeline(context);
}

void SeasonPanel::set(PanelContext& context, double weathering) {
  const double value = std::clamp(weathering, 0.0, 1.0);
  context.ui.season.running = false;
  context.ui.season.at.reset();
  context.edits.edit(
      "weathering degree", [value](project::Project& p) { p.wither.weathering = value; }, "wither.weathering");
  context.ui.inputActive = true;
}

void SeasonPanel::release(PanelContext& context) {
  context.edits.closeStep();
}

void SeasonPanel::controls(PanelContext& context) {
  playControls(context);
  besideIfRoom(px(10.0f), px(216.0f));
  sequence(context);
  besideIfRoom(px(16.0f), px(120.0f));
  degree(context);
  layersNote(context);
}

void SeasonPanel::playControls(PanelContext& context) {
  SeasonPlay& play = context.ui.season;
  const wither::AgeingOptions& ageing = context.project->wither.ageing;
  if (iconButton("season.start", icon::kPrevious, "Show the beginning of the season")) {
    play.seconds = 0.0;
    play.at = project::seasonAt(context.project->sequence, 0.0);
    play.weathering = project::weatheringAt(ageing, *play.at);
    context.ui.lastMotion = context.seconds;
  }
  ImGui::SameLine(0.0f, px(4.0f));
  if (ImGui::Button(
          (std::string(play.running ? icon::kPause : icon::kPlay) + (play.running ? "  Pause" : "  Play")).c_str(),
          {px(84.0f), 0.0f}))
    context.edits.run("season.play");
  logItem("season.play");
  ImGui::SameLine(0.0f, px(4.0f));
  if (iconButton("season.stop", icon::kStop, "Back to the project's own weathering degree", "", play.at.has_value()))
    context.edits.run("season.stop");
  ImGui::SameLine(0.0f, px(4.0f));
  if (toolToggle("season.loop", icon::kRefresh, play.loop, "Begin again at the end")) play.loop = !play.loop;
}

/// How many frames the sequence has and how fast they play: fields of the project, in the panel that plays them.
void SeasonPanel::sequence(PanelContext& context) {
  SpecsOf specs;
  project::Sequence edited = context.project->sequence;
  project::describe(specs, edited);
  double frames = edited.frames;
  NumberStyle count = fieldLook("frames", specs.frames, frames).number;
  const EditState framesEdited = numberField("frames", frames, count, px(96.0f));
  logItem("season.frames");
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", specs.frames.help);
  const bool framesActive = ImGui::IsItemActive();
  ImGui::SameLine(0.0f, px(4.0f));
  NumberStyle rate = fieldLook("framesPerSecond", specs.rate, edited.framesPerSecond).number;
  const EditState rateEdited = numberField("rate", edited.framesPerSecond, rate, px(116.0f));
  logItem("season.rate");
  if (ImGui::IsItemHovered())
    ImGui::SetTooltip("%s\nThe sequence lasts %.1f s.", specs.rate.help, lengthOf(context.project->sequence));
  if (framesEdited.changed) {
    const int wanted = static_cast<int>(std::lround(frames));
    context.edits.edit(
        "frames", [wanted](project::Project& p) { p.sequence.frames = wanted; }, "sequence.frames");
  }
  if (rateEdited.changed) {
    const double wanted = edited.framesPerSecond;
    context.edits.edit(
        "frame rate", [wanted](project::Project& p) { p.sequence.framesPerSecond = wanted; },
        "sequence.framesPerSecond");
  }
  if (framesActive || ImGui::IsItemActive()) context.ui.inputActive = true;
  if (framesEdited.finished || rateEdited.finished) release(context);
}

void SeasonPanel::degree(PanelContext& context) {
  const SeasonPlay& play = context.ui.season;
  // Play stops anywhere between two whole per cent: nobody wants to read or keep more.
  const double paused = std::round(100.0 * play.weathering) / 100.0;
  const double shown = play.at ? paused : context.project->wither.weathering;
  double value = shown;
  NumberStyle style = fieldLook("weathering", project::percent(0.0, 1.0), shown).number;
  style.caption = "Weathering";
  const float width = std::clamp(ImGui::GetContentRegionAvail().x - px(64.0f), px(120.0f), px(260.0f));
  const EditState edited = numberField("degree", value, style, width);
  if (edited.changed) set(context, value);
  if (ImGui::IsItemActive()) context.ui.inputActive = true;
  if (edited.finished) release(context);
  logItem("season.degree");
  if (ImGui::IsItemHovered())
    ImGui::SetTooltip("%s", play.at ? "What is shown; moving it sets the project's weathering degree"
                                    : "The project's weathering degree");
  if (!play.at) return;
  ImGui::SameLine(0.0f, px(6.0f));
  if (ImGui::Button("Keep")) {
    set(context, paused);
    release(context);
  }
  logItem("season.keep");
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("Give the project the weathering degree that is shown");
}

void SeasonPanel::layersNote(PanelContext& context) {
  if (drawsTexels(*context.project)) return;
  ImGui::AlignTextToFramePadding();
  ImGui::TextDisabled("%s  Layers are baked anew at every moment; texels follow at once.", icon::kInfo);
  ImGui::SameLine();
  if (ImGui::Button("Draw as texels"))
    context.edits.edit("draw as texels", [](project::Project& p) { p.render.method = render::GroundMethod::Texels; });
  logItem("season.texels");
}

void SeasonPanel::timeline(PanelContext& context) {
  const Palette& colours = theme().colours;
  const wither::AgeingOptions& ageing = context.project->wither.ageing;
  const ImVec2 origin = ImGui::GetCursorScreenPos();
  const ImVec2 room = ImGui::GetContentRegionAvail();
  const ImVec2 size{std::max(room.x, px(60.0f)), std::max(room.y - px(4.0f), px(60.0f))};
  ImGui::InvisibleButton("##season", size);
  logItem("season.timeline");
  const float base = size.y - px(18.0f);
  const auto x = [&](double season) { return origin.x + static_cast<float>(season) * size.x; };
  const auto y = [&](double value) {
    return origin.y + px(6.0f) + (base - px(12.0f)) * (1.0f - static_cast<float>(std::clamp(value, 0.0, 1.0)));
  };
  ImDrawList* draw = ImGui::GetWindowDrawList();
  draw->PushClipRect(origin, {origin.x + size.x, origin.y + size.y}, true);
  draw->AddRectFilled(origin, {origin.x + size.x, origin.y + base}, colours.plot, px(4.0f));
  for (const double value : {0.0, 0.5, 1.0}) draw->AddLine({x(0.0), y(value)}, {x(1.0), y(value)}, colours.plotGrid);
  for (int tenth = 0; tenth <= 10; ++tenth) {
    draw->AddLine({x(0.1 * tenth), origin.y}, {x(0.1 * tenth), origin.y + base}, colours.plotGrid);
  }
  drawMoments(*draw, origin, size.x, origin.y + base + px(2.0f));
  const std::array<Line, 3> lines = linesOf(ageing);
  for (const Line& line : lines) {
    std::array<ImVec2, kSteps + 1> points;
    for (int i = 0; i <= kSteps; ++i) {
      const double season = static_cast<double>(i) / kSteps;
      points[static_cast<std::size_t>(i)] = {x(season), y(line.at(season))};
    }
    draw->AddPolyline(points.data(), kSteps + 1, line.colour, 0, px(1.5f));
  }
  const double moment = shownMoment(context.ui, *context.project);
  draw->AddLine({x(moment), origin.y}, {x(moment), origin.y + base}, colours.text, px(1.5f));
  for (const Line& line : lines) draw->AddCircleFilled({x(moment), y(line.at(moment))}, px(4.0f), line.colour);
  drawLegend(lines, moment, origin, {origin.x + size.x, origin.y + base});
  draw->PopClipRect();
  if (ImGui::IsItemActive()) {
    m_dragging = true;
    set(context, project::weatheringAt(ageing, (ImGui::GetIO().MousePos.x - origin.x) / size.x));
  } else if (m_dragging) {
    m_dragging = false;
    release(context);
  }
}

}  // namespace sward::editor
