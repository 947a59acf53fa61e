#include "panels/viewport.h"

#include "panels/camera_control.h"
#include "panels/legend.h"
#include "panels/view_edits.h"
#include "widgets/icons.h"
#include "widgets/item_log.h"

#include "scene/camera.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include <imgui.h>

namespace sward::editor {
namespace {

constexpr float kHeaderHeight = 34.0f;  ///< design pixels
constexpr double kSunDegreesPerHeight = 90.0;
constexpr double kFlySpeed = 1.2;  ///< metres a second at eye height 1 m; grows with the eye's height
constexpr float kSplitGrab = 6.0f;
constexpr ImU32 kBusy = IM_COL32(230, 180, 70, 255), kFailed = IM_COL32(230, 90, 70, 255),
                kDone = IM_COL32(120, 190, 90, 255);

ImVec2 operator+(const ImVec2& a, const ImVec2& b) {
  return {a.x + b.x, a.y + b.y};
}

struct Choice {
  render::ViewQuantity quantity;
  const char* label;
  const char* help;
};
constexpr std::array<Choice, 8> kQuantities{{
    {render::ViewQuantity::Shaded, "Shaded", "The picture itself"},
    {render::ViewQuantity::Albedo, "Albedo", "Colour of leaves and soil without any light"},
    {render::ViewQuantity::Luminance, "Luminance", "Answer to the sun with white leaves: shadow and shading alone"},
    {render::ViewQuantity::Coverage, "Coverage", "How much of the ray the grass stops"},
    {render::ViewQuantity::Coefficient, "Coefficient", "One coefficient of the fitted light response"},
    {render::ViewQuantity::Visibility, "Visibility", "Share of the directions that see a texel: its weight in the fit"},
    {render::ViewQuantity::Condition, "Condition", "Condition number of the fit, logarithmic"},
    {render::ViewQuantity::Tiles, "Tiles", "Tile borders, and a colour for every tile"},
}};

const Choice& choiceOf(render::ViewQuantity quantity) {
  return *std::find_if(kQuantities.begin(), kQuantities.end(), [&](const Choice& c) { return c.quantity == quantity; });
}

}  // namespace

void ViewportPanel::draw(PanelContext& context) {
  header(context);
  picture(context);
}

void ViewportPanel::header(PanelContext& context) {
  UiState& ui = context.ui;
  const float scale = context.scale;
  ImGui::SetCursorPos({8.0f * scale, 5.0f * scale});
  ImGui::SetNextItemWidth(150.0f * scale);
  const auto& views = context.project->views;
  const std::string current =
      ui.boundView && *ui.boundView < views.size() ? views[*ui.boundView].name : std::string("Free camera");
  if (ImGui::BeginCombo("##view", (std::string(icon::kCamera) + "  " + current).c_str())) {
    for (std::size_t i = 0; i < views.size(); ++i) {
      if (ImGui::Selectable((views[i].name + "##" + std::to_string(i)).c_str(), ui.boundView == i)) {
        ui.camera = views[i];
        ui.boundView = i;
        ui.lastMotion = context.seconds;
      }
      logItem("view:" + views[i].name);
    }
    ImGui::Separator();
    if (ImGui::Selectable("Save the camera as a new view")) context.edits.run("view.save");
    ImGui::EndCombo();
  }
  logItem("viewport.view");
  ImGui::SameLine();
  modes(context);
}

void ViewportPanel::modes(PanelContext& context) {
  UiState& ui = context.ui;
  const float scale = context.scale;
  const render::ViewMode mode = shownMode(ui, *context.project);
  // Texels know no layers: the choice stays for the time when layers are drawn again.
  const bool texels = drawsTexels(*context.project);
  const auto onlyLayers = [texels](const char* help) {
    if (!ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) return;
    ImGui::SetTooltip("%s", texels ? "Texels are shown as the picture alone; layers can be looked into" : help);
  };
  ImGui::BeginDisabled(texels);
  ImGui::SetNextItemWidth(140.0f * scale);
  if (ImGui::BeginCombo("##quantity", choiceOf(mode.quantity).label)) {
    for (const Choice& choice : kQuantities) {
      if (ImGui::Selectable(choice.label, ui.mode.quantity == choice.quantity)) ui.mode.quantity = choice.quantity;
      if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", choice.help);
      logItem(std::string("quantity:") + choice.label);
    }
    ImGui::EndCombo();
  }
  onlyLayers("What the picture shows");
  logItem("viewport.quantity");
  if (mode.quantity == render::ViewQuantity::Coefficient) {
    ImGui::SameLine();
    ImGui::SetNextItemWidth(90.0f * scale);
    ImGui::SliderInt("##coefficient", &ui.mode.coefficient, 0, context.project->fit.basis == lpt::Basis::Ptm ? 5 : 9,
                     "b%d", ImGuiSliderFlags_AlwaysClamp);
  }
  const bool response =
      mode.quantity == render::ViewQuantity::Coefficient || mode.quantity == render::ViewQuantity::Luminance;
  if (response) {
    ImGui::SameLine();
    ImGui::SetNextItemWidth(120.0f * scale);
    int channel = ui.mode.channel == render::ResponseChannel::Transmitted ? 1 : 0;
    if (ImGui::Combo("##channel", &channel, "Reflected\0Transmitted\0"))
      ui.mode.channel = channel == 1 ? render::ResponseChannel::Transmitted : render::ResponseChannel::Reflected;
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("What leaves reflect, or what they let through");
  }
  ImGui::SameLine();
  ImGui::SetNextItemWidth(110.0f * scale);
  const std::string layer = mode.layer < 0 ? "All layers" : "Layer %d";
  int shownLayer = mode.layer;
  if (ImGui::SliderInt("##layer", &shownLayer, -1, context.project->sampling.slices - 1, layer.c_str(),
                       ImGuiSliderFlags_AlwaysClamp))
    ui.mode.layer = shownLayer;
  ImGui::EndDisabled();
  onlyLayers("Show one slice layer alone (0 is the top); leftmost: all");
  logItem("viewport.layer");
}

void ViewportPanel::picture(PanelContext& context) {
  const float top = kHeaderHeight * context.scale;
  const ImVec2 origin = ImGui::GetWindowPos() + ImVec2(0.0f, top);
  const ImVec2 size{std::max(ImGui::GetWindowSize().x, 1.0f), std::max(ImGui::GetWindowSize().y - top, 1.0f)};
  m_left = origin.x;
  m_top = origin.y;
  m_width = static_cast<int>(size.x);
  m_height = static_cast<int>(size.y);
  ImGui::SetCursorScreenPos(origin);
  ImGui::InvisibleButton(
      "##picture", size,
      ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight | ImGuiButtonFlags_MouseButtonMiddle);
  logItem("viewport.picture");
  const bool hovered = ImGui::IsItemHovered();
  ImDrawList* draw = ImGui::GetWindowDrawList();
  const PanelPicture& shown = context.live.picture;
  if (shown.texture != 0) {
    // NOLINTNEXTLINE: ImGui's OpenGL backend takes the texture's name for its handle.
    draw->AddImage(reinterpret_cast<ImTextureID>(static_cast<std::uintptr_t>(shown.texture)), origin, origin + size);
  } else {
    draw->AddRectFilled(origin, origin + size, ImGui::GetColorU32(ImGuiCol_FrameBg));
  }
  if (!dragSplit(context)) navigate(context, hovered);
  overlays(context);
  m_lastSeconds = context.seconds;
}

void ViewportPanel::moved(PanelContext& context) {
  // Looking through a view of the project does not edit it: the camera is free from here on, until it is saved.
  context.ui.lastMotion = context.seconds;
  context.ui.boundView.reset();
}

void ViewportPanel::dragSun(PanelContext& context) {
  const ImGuiIO& io = ImGui::GetIO();
  if (io.MouseDelta.x == 0.0f && io.MouseDelta.y == 0.0f) return;
  const double degrees = kSunDegreesPerHeight / std::max(m_height, 1);
  const double azimuth = io.MouseDelta.x * degrees, elevation = -io.MouseDelta.y * degrees;
  context.edits.edit(
      "sun", [=](project::Project& p) { turnSun(p, azimuth, elevation); }, "viewport.sun");
}

bool ViewportPanel::dragSplit(PanelContext& context) {
  CompareState& compare = context.ui.compare;
  if (!compare.on || compare.show != Comparison::Show::Split) return false;
  const ImGuiIO& io = ImGui::GetIO();
  const float x = m_left + static_cast<float>(compare.splitAt) * static_cast<float>(m_width);
  const bool over = ImGui::IsItemHovered() && std::abs(io.MousePos.x - x) < kSplitGrab * context.scale;
  if (over || m_drag == Drag::Split) ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
  if (over && ImGui::IsMouseClicked(ImGuiMouseButton_Left)) m_drag = Drag::Split;
  if (m_drag != Drag::Split) return false;
  if (!ImGui::IsMouseDown(ImGuiMouseButton_Left)) m_drag = Drag::None;
  compare.splitAt = std::clamp((io.MousePos.x - m_left) / static_cast<float>(std::max(m_width, 1)), 0.02f, 0.98f);
  return true;
}

void ViewportPanel::navigate(PanelContext& context, bool hovered) {
  UiState& ui = context.ui;
  const ImGuiIO& io = ImGui::GetIO();
  if (hovered && m_drag == Drag::None) {
    const bool sun = ui.tool == ViewportTool::Sun || ImGui::IsKeyDown('L');
    if (ImGui::IsMouseClicked(ImGuiMouseButton_Left)) {
      m_drag = sun ? Drag::Sun : io.KeyShift ? Drag::Pan : io.KeyAlt ? Drag::Look : Drag::Orbit;
    } else if (ImGui::IsMouseClicked(ImGuiMouseButton_Middle)) {
      m_drag = Drag::Pan;
    } else if (ImGui::IsMouseClicked(ImGuiMouseButton_Right)) {
      m_drag = Drag::Look;
    }
    if (io.MouseWheel != 0.0f) {
      dolly(ui.camera, io.MouseWheel);
      moved(context);
    }
  }
  const bool held = ImGui::IsMouseDown(ImGuiMouseButton_Left) || ImGui::IsMouseDown(ImGuiMouseButton_Middle) ||
                    ImGui::IsMouseDown(ImGuiMouseButton_Right);
  if (m_drag != Drag::None && !held) {
    if (m_drag == Drag::Sun) context.edits.closeStep();
    m_drag = Drag::None;
  }
  const double h = std::max(m_height, 1);
  const double dx = io.MouseDelta.x / h, dy = io.MouseDelta.y / h;
  const bool drags = dx != 0.0 || dy != 0.0;
  if (m_drag == Drag::Sun) dragSun(context);
  if (m_drag == Drag::Orbit && drags) orbit(ui.camera, dx, dy);
  if (m_drag == Drag::Pan && drags) pan(ui.camera, dx, dy, m_width / h);
  if (m_drag == Drag::Look && drags) lookAround(ui.camera, dx * 0.5, -dy * 0.5);
  if (drags && (m_drag == Drag::Orbit || m_drag == Drag::Pan || m_drag == Drag::Look)) moved(context);

  m_flying = false;
  const bool canFly = (m_drag == Drag::Look || hovered) && !io.WantTextInput && !io.KeyCtrl;
  if (!canFly) return;
  const auto key = [](int code) { return ImGui::IsKeyDown(code) ? 1.0 : 0.0; };
  const double ahead = key('W') - key('S'), aside = key('D') - key('A'), rise = key('E') - key('Q');
  if (ahead == 0.0 && aside == 0.0 && rise == 0.0) return;
  m_flying = true;
  const double elapsed = std::clamp(context.seconds - m_lastSeconds, 0.0, 0.1);
  const double way = kFlySpeed * (0.3 + std::abs(ui.camera.position.z)) * (io.KeyShift ? 4.0 : 1.0) * elapsed;
  fly(ui.camera, ahead * way, aside * way, rise * way);
  moved(context);
}

void ViewportPanel::pill(const Pill& shown, float scale) const {
  const ImVec2 pad{10.0f * scale, 5.0f * scale};
  const float dotWidth = 14.0f * scale, margin = 12.0f * scale;
  const float room = std::max(static_cast<float>(m_width) - 2.0f * (margin + pad.x) - dotWidth, 40.0f * scale);
  const ImVec2 text = ImGui::CalcTextSize(shown.text.c_str(), nullptr, false, room);
  const ImVec2 size{text.x + 2.0f * pad.x + dotWidth, text.y + 2.0f * pad.y};
  const ImVec2 at{shown.right ? m_left + static_cast<float>(m_width) - margin - size.x : m_left + margin,
                  shown.bottom ? m_top + static_cast<float>(m_height) - margin - size.y : m_top + margin};
  ImDrawList* draw = ImGui::GetWindowDrawList();
  draw->AddRectFilled(at, at + size, IM_COL32(20, 22, 20, 190), 10.0f * scale);
  draw->AddCircleFilled(at + ImVec2(pad.x + 3.0f * scale, pad.y + 0.5f * ImGui::GetTextLineHeight()), 4.0f * scale,
                        shown.dot);
  logRect("viewport.", shown.right ? "caption" : "message", at, at + size);
  draw->AddText(ImGui::GetFont(), ImGui::GetFontSize(), at + ImVec2(pad.x + dotWidth, pad.y),
                IM_COL32(235, 238, 232, 255), shown.text.c_str(), nullptr, room);
}

void ViewportPanel::overlays(PanelContext& context) {
  const float scale = context.scale;
  const LiveState& live = context.live;
  if (live.viewError) {
    pill({live.viewError->text(), kFailed}, scale);
  } else if (live.bake.error) {
    pill({live.bake.error->text(), kFailed}, scale);
  } else if (!live.ground) {
    pill({"Baking the first picture", kBusy}, scale);
  } else if (live.stale && !context.ui.season.running) {
    constexpr std::array<const char*, 3> kNames{"coarse", "half", "full"};
    const auto quality = static_cast<std::size_t>(live.bake.quality);
    std::string text = std::string("Updating, ") + kNames[quality];
    if (live.bake.running) text += " " + std::to_string(static_cast<int>(live.bake.fraction * 100.0)) + " %";
    pill({text, kBusy}, scale);
  }
  const render::ViewMode mode = shownMode(context.ui, *context.project);
  if (live.ground && !mode.plain()) {
    const render::Legend legend = render::legendOf(mode, *live.ground, live.inspection.get());
    drawLegend(legend, ImVec2(m_left + 12.0f * scale, m_top + static_cast<float>(m_height) - 12.0f * scale));
  }
  compareOverlay(context);
}

void ViewportPanel::compareOverlay(PanelContext& context) const {
  const CompareState compare = shownComparison(context.ui, *context.project);
  if (!compare.on) return;
  const float scale = context.scale;
  const bool reference = compare.other == CompareState::Other::Reference;
  if (compare.show == Comparison::Show::Split && (!reference || context.live.reference)) {
    ImDrawList* draw = ImGui::GetWindowDrawList();
    const float x = m_left + static_cast<float>(compare.splitAt) * static_cast<float>(m_width);
    const float bottom = m_top + static_cast<float>(m_height);
    draw->AddLine({x, m_top}, {x, bottom}, IM_COL32(255, 255, 255, 200), 1.5f * scale);
    draw->AddCircleFilled({x, 0.5f * (m_top + bottom)}, 7.0f * scale, IM_COL32(255, 255, 255, 230));
  }
  if (reference) pill(captionOf(context.live.reference), scale);
}

ViewportPanel::Pill ViewportPanel::captionOf(const std::optional<ReferenceState>& reference) {
  const auto say = [](std::string text, std::uint32_t dot) { return Pill{std::move(text), dot, true, true}; };
  if (!reference) return say("The reference is a shaded picture of all layers: choose Shaded, All layers", kBusy);
  if (reference->error) return say(reference->error->text(), kFailed);
  if (!reference->picture)
    return say(reference->waitsForBake ? "reference, once the ground is baked in full" : "reference, first samples",
               kBusy);
  const ReferencePicture& picture = *reference->picture;
  std::array<char, 96> text{};
  std::snprintf(text.data(), text.size(), "reference, %s%d samples, noise %.3f", picture.half ? "half size, " : "",
                picture.samples, picture.noise);
  std::string caption = text.data();
  if (reference->rmse) {
    std::snprintf(text.data(), text.size(), "\nRMSE %.3f", *reference->rmse);
    caption += text.data();
  }
  return say(std::move(caption), reference->running ? kBusy : kDone);
}

}  // namespace sward::editor
