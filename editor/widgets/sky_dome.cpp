#include "widgets/sky_dome.h"

#include "widgets/item_log.h"
#include "widgets/text.h"
#include "widgets/theme.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include <imgui_internal.h>

namespace sward::editor {
namespace {

constexpr double kReach = 1.2;  ///< the rim: 18 degrees below the horizon

/// The sun that is being dragged, and where the mouse holds it.
struct Grip {
  ImGuiID id = 0;
  glm::dvec2 offset{0.0};
  SkyAngles start;
  bool edited = false;
};

Grip& grip() {
  static Grip current;
  return current;
}

double smooth(double low, double high, double x) {
  const double t = std::clamp((x - low) / (high - low), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

glm::dvec3 direction(const SkyAngles& a) {
  const double az = glm::radians(a.azimuthDeg), el = glm::radians(a.elevationDeg);
  return {std::sin(az) * std::cos(el), std::cos(az) * std::cos(el), std::sin(el)};
}

ImU32 packed(const glm::dvec3& encoded) {
  const glm::dvec3 c = glm::clamp(encoded, 0.0, 1.0);
  return ImGui::ColorConvertFloat4ToU32(
      ImVec4(static_cast<float>(c.x), static_cast<float>(c.y), static_cast<float>(c.z), 1.0f));
}

double tenth(double degrees) {
  return cleaned(std::round(degrees * 10.0) / 10.0);
}

bool move(SkyAngles& sun, glm::dvec2 place) {
  const ImGuiIO& io = ImGui::GetIO();
  const Grip& g = grip();
  SkyAngles next = discAngles(place + g.offset, DiscMap::Equidistant, sun.azimuthDeg);
  next.azimuthDeg = std::fmod(tenth(next.azimuthDeg), 360.0);
  next.elevationDeg = tenth(next.elevationDeg);
  if (io.KeyShift) next.elevationDeg = g.start.elevationDeg;
  if (io.KeyCtrl) next.azimuthDeg = g.start.azimuthDeg;
  const bool changed = next.azimuthDeg != sun.azimuthDeg || next.elevationDeg != sun.elevationDeg;
  sun = next;
  return changed;
}

EditState interact(ImGuiID id, SkyAngles& sun, ImVec2 centre, float radius) {
  Grip& g = grip();
  EditState state;
  const glm::dvec2 mouse = discFromScreen(centre, radius, ImGui::GetIO().MousePos);
  if (ImGui::IsItemActivated()) {
    const glm::dvec2 at = discPlace(sun, DiscMap::Equidistant);
    const bool onSun = glm::length(at - mouse) * static_cast<double>(radius) < static_cast<double>(px(12));
    // Pressing the sun itself does not move it; pressing the sky brings it there.
    g = {id, onSun ? at - mouse : glm::dvec2(0.0), sun, false};
    if (!onSun) state.changed = move(sun, mouse);
  } else if (ImGui::IsItemActive() && g.id == id && ImGui::IsMouseDragging(0, px(2))) {
    state.changed = move(sun, mouse);
  }
  if (g.id != id) return state;
  g.edited |= state.changed;
  if (ImGui::IsItemDeactivated()) {
    state.finished = g.edited;
    g.id = 0;
  }
  return state;
}

void paintRings(ImVec2 centre, float radius, bool night) {
  ImDrawList* draw = ImGui::GetWindowDrawList();
  const ImU32 ink = night ? IM_COL32(255, 255, 255, 60) : IM_COL32(0, 0, 0, 55);
  const ImU32 text = night ? IM_COL32(255, 255, 255, 150) : IM_COL32(0, 0, 0, 150);
  FontScope small(theme().fonts.small);
  for (const int elevation : {30, 60}) {
    const float r = radius * static_cast<float>(90 - elevation) / 90.0f;
    draw->AddCircle(centre, r, ink, 0, std::max(1.0f, px(1)));
    const std::string label = std::to_string(elevation) + "\u00B0";
    draw->AddText(ImVec2(centre.x + px(3), centre.y - r + px(1)), text, label.c_str());
  }
  draw->AddCircle(centre, radius, night ? IM_COL32(255, 255, 255, 110) : IM_COL32(0, 0, 0, 110), 0,
                  std::max(1.0f, px(1.5f)));
  for (int i = 0; i < 12; ++i) {
    const double a = glm::radians(30.0 * i);
    const glm::dvec2 along(std::sin(a), std::cos(a));
    const double inner = i % 3 == 0 ? 0.0 : 0.95;
    draw->AddLine(discScreen(centre, radius, along * inner), discScreen(centre, radius, along), faded(ink, 0.7f));
  }
}

void paintCompass(ImVec2 centre, float radius) {
  const Palette& c = theme().colours;
  ImDrawList* draw = ImGui::GetWindowDrawList();
  FontScope strong(theme().fonts.strong);
  constexpr std::array kNames{"N", "E", "S", "W"};
  for (int i = 0; i < 4; ++i) {
    const double a = glm::radians(90.0 * i);
    const ImVec2 size = ImGui::CalcTextSize(kNames[static_cast<std::size_t>(i)]);
    const ImVec2 at = discScreen(centre, radius * static_cast<float>(kReach) + px(11), {std::sin(a), std::cos(a)});
    draw->AddText(ImVec2(std::round(at.x - 0.5f * size.x), std::round(at.y - 0.5f * size.y)),
                  i == 0 ? c.text : c.textDim, kNames[static_cast<std::size_t>(i)]);
  }
}

void paintSun(const char* id, const SkyAngles& sun, ImVec2 centre, float radius, const SkyDomeOptions& options) {
  const Palette& c = theme().colours;
  ImDrawList* draw = ImGui::GetWindowDrawList();
  if (options.path.size() > 1) {
    std::vector<ImVec2> line;
    for (const SkyAngles& a : options.path) {
      line.push_back(discScreen(centre, radius, discPlace(a, DiscMap::Equidistant)));
    }
    draw->AddPolyline(line.data(), static_cast<int>(line.size()), faded(c.sun, 0.75f), 0, std::max(1.0f, px(1.5f)));
  }
  const ImVec2 at = discScreen(centre, radius, discPlace(sun, DiscMap::Equidistant));
  draw->AddLine(centre, at, faded(c.sun, 0.5f), std::max(1.0f, px(1)));
  const bool hot = ImGui::IsItemHovered() || ImGui::IsItemActive();
  const float r = px(hot && options.enabled ? 8.0f : 7.0f);
  const bool up = sun.elevationDeg >= 0.0;
  if (up) draw->AddCircleFilled(at, r + px(5), faded(c.sun, 0.30f));
  draw->AddCircleFilled(at, r, up ? c.sun : IM_COL32(22, 26, 36, 255));
  draw->AddCircle(at, r, up ? IM_COL32(255, 255, 255, 230) : c.sun, 0, std::max(1.5f, px(1.5f)));
  logRect("sky:", std::string(id) + ":sun", ImVec2(at.x - r, at.y - r), ImVec2(at.x + r, at.y + r));
}

void readout(const SkyAngles& sun, float side) {
  std::array<char, 96> text{};
  if (sun.elevationDeg >= 0.0) {
    std::snprintf(text.data(), text.size(), "%.1f\u00B0 %s   \u00B7   %.1f\u00B0 up", sun.azimuthDeg,
                  compassPoint(sun.azimuthDeg), sun.elevationDeg);
  } else {
    std::snprintf(text.data(), text.size(), "%.1f\u00B0 %s   \u00B7   %.1f\u00B0 below the horizon", sun.azimuthDeg,
                  compassPoint(sun.azimuthDeg), -sun.elevationDeg);
  }
  const float wide = ImGui::CalcTextSize(text.data()).x;
  ImGui::SetCursorPosX(ImGui::GetCursorPosX() + std::max(0.0f, 0.5f * (side - wide)));
  ImGui::TextDisabled("%s", text.data());
}

}  // namespace

ImU32 suggestedSky(const SkyAngles& toward, const SkyAngles& sun) {
  const double day = smooth(-8.0, 10.0, sun.elevationDeg);
  const double low = smooth(-9.0, 0.0, sun.elevationDeg) * (1.0 - smooth(4.0, 24.0, sun.elevationDeg));
  const double height = std::clamp(toward.elevationDeg / 90.0, 0.0, 1.0);
  const double up = std::sqrt(height);
  const glm::dvec3 dayColour = glm::mix(glm::dvec3(0.72, 0.83, 0.90), glm::dvec3(0.28, 0.50, 0.76), up);
  const glm::dvec3 nightColour = glm::mix(glm::dvec3(0.12, 0.15, 0.23), glm::dvec3(0.05, 0.065, 0.12), up);
  glm::dvec3 colour = glm::mix(nightColour, dayColour, day);
  const double cosine = glm::dot(direction(toward), direction(sun));
  const double apartDeg = glm::degrees(std::acos(std::clamp(cosine, -1.0, 1.0)));
  const double warm = low * std::exp(-apartDeg / 55.0) * (1.0 - 0.6 * up);
  colour = glm::mix(colour, glm::dvec3(0.96, 0.62, 0.36), std::clamp(1.1 * warm, 0.0, 0.9));
  const double glow = day * std::exp(-apartDeg / 14.0);
  colour = glm::mix(colour, glm::dvec3(1.0, 0.96, 0.86), 0.75 * glow);
  // Ground, where nothing of the sky is seen.
  if (toward.elevationDeg < -0.5) colour = glm::mix(glm::dvec3(0.07, 0.08, 0.08), colour, 0.35);
  return packed(colour);
}

EditState skyDome(const char* id, SkyAngles& sun, float side, const SkyDomeOptions& options) {
  const float line = ImGui::GetTextLineHeight();
  side = std::max(side, px(60));
  const float radius = std::floor((0.5f * side - px(20)) / static_cast<float>(kReach));
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  const ImVec2 centre(std::round(corner.x + 0.5f * side), std::round(corner.y + 0.5f * side));
  ImGui::BeginGroup();
  ImGui::InvisibleButton(id, ImVec2(side, side));
  logItem("sky:", id);
  EditState state;
  if (options.enabled) {
    state = interact(ImGui::GetItemID(), sun, centre, radius);
    if (ImGui::IsItemHovered()) ImGui::SetMouseCursor(ImGuiMouseCursor_Hand);
  }
  ImDrawList* draw = ImGui::GetWindowDrawList();
  // The ground first and the sky over it: a net across the horizon would blend the two.
  paintDisc(draw, centre, radius, kReach, [&sun](glm::dvec2 place) {
    return suggestedSky({discAngles(place, DiscMap::Equidistant).azimuthDeg, -1.0}, sun);
  });
  paintDisc(draw, centre, radius, 1.0, [&](glm::dvec2 place) {
    SkyAngles toward = discAngles(place, DiscMap::Equidistant);
    toward.elevationDeg = std::max(0.0, toward.elevationDeg);
    return options.colour ? options.colour(toward) : suggestedSky(toward, sun);
  });
  draw->AddCircle(centre, radius * static_cast<float>(kReach), theme().colours.border, 0, std::max(1.0f, px(1)));
  paintRings(centre, radius, sun.elevationDeg < 2.0);
  paintCompass(centre, radius);
  paintSun(id, sun, centre, radius, options);
  ImGui::SetCursorScreenPos(ImVec2(corner.x, corner.y + side + px(2)));
  readout(sun, side);
  ImGui::Dummy(ImVec2(side, std::max(0.0f, px(2) - line)));
  ImGui::EndGroup();
  return state;
}

}  // namespace sward::editor
