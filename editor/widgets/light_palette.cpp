#include "widgets/light_palette.h"

#include "widgets/item_log.h"
#include "widgets/text.h"
#include "widgets/theme.h"
#include "widgets/units.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include <imgui_internal.h>

namespace sward::editor {
namespace {

std::string counted(const char* verb, std::size_t count) {
  return std::string(verb) + (count == 1 ? " light" : " lights");
}

glm::dvec2 placeOf(const scene::SunAngles& light) {
  return discPlace({light.azimuthDeg, light.elevationDeg}, DiscMap::EqualArea);
}

scene::SunAngles lightFrom(glm::dvec2 place, double azimuthAtZenith) {
  const SkyAngles angles = discAngles(place, DiscMap::EqualArea, azimuthAtZenith);
  const auto tenth = [](double degrees) { return cleaned(std::round(degrees * 10.0) / 10.0); };
  return {std::fmod(tenth(angles.azimuthDeg), 360.0), tenth(angles.elevationDeg)};
}

/// Bilinear, the edge's cells going on outward; nothing without a grid.
std::optional<double> valueAt(const HemisphereValues& grid, glm::dvec2 place) {
  const auto count = static_cast<std::size_t>(std::max(grid.side, 0));
  if (count == 0 || grid.values.size() < count * count) return std::nullopt;
  const auto cell = [&](double x, double& t) {
    const double at = std::clamp((x + 1.0) * 0.5 * grid.side - 0.5, 0.0, grid.side - 1.0);
    const double low = std::floor(at);
    t = at - low;
    return static_cast<std::size_t>(low);
  };
  double tx = 0.0, ty = 0.0;
  const std::size_t x = cell(place.x, tx), y = cell(place.y, ty);
  const std::size_t x1 = std::min(x + 1, count - 1), y1 = std::min(y + 1, count - 1);
  const auto v = [&](std::size_t column, std::size_t row) {
    return static_cast<double>(grid.values[row * count + column]);
  };
  return glm::mix(glm::mix(v(x, y), v(x1, y), tx), glm::mix(v(x, y1), v(x1, y1), tx), ty);
}

std::string number(double value) {
  std::array<char, 40> text{};
  std::snprintf(text.data(), text.size(), "%.3g", value);
  return text.data();
}

void paintLegend(const HemisphereValues& values, ImVec2 at, float width) {
  const Palette& c = theme().colours;
  ImDrawList* draw = ImGui::GetWindowDrawList();
  FontScope small(theme().fonts.small);
  const float line = ImGui::GetFontSize(), bar = px(8);
  draw->AddText(at, c.textDim, values.title.c_str());
  const std::string low = number(values.low),
                    high = number(values.high) + (values.unit.empty() ? "" : " " + values.unit);
  const float lowWide = ImGui::CalcTextSize(low.c_str()).x, highWide = ImGui::CalcTextSize(high.c_str()).x;
  const float title = ImGui::CalcTextSize(values.title.c_str()).x;
  const float x0 = at.x + title + px(12) + lowWide + px(6), x1 = at.x + width - highWide - px(6);
  if (x1 - x0 < px(20)) return;
  const float y = std::round(at.y + 0.5f * (line - bar));
  constexpr int kParts = 24;
  for (int i = 0; i < kParts; ++i) {
    const float a = x0 + (x1 - x0) * static_cast<float>(i) / kParts,
                b = x0 + (x1 - x0) * static_cast<float>(i + 1) / kParts;
    const ImU32 from = rampColour(static_cast<double>(i) / kParts), to = rampColour((i + 1.0) / kParts);
    draw->AddRectFilledMultiColor(ImVec2(a, y), ImVec2(b, y + bar), from, to, to, from);
  }
  draw->AddText(ImVec2(x0 - px(6) - lowWide, at.y), c.textDim, low.c_str());
  draw->AddText(ImVec2(x1 + px(6), at.y), c.textDim, high.c_str());
}

}  // namespace

glm::dvec2 HemisphereValues::place(int side, int column, int row) {
  return {(2.0 * column + 1.0) / side - 1.0, (2.0 * row + 1.0) / side - 1.0};
}

ImU32 rampColour(double t) {
  constexpr std::array<glm::dvec3, 5> kStops{
      {{0.12, 0.14, 0.28}, {0.10, 0.36, 0.45}, {0.22, 0.56, 0.42}, {0.58, 0.74, 0.30}, {0.97, 0.90, 0.48}}};
  const double at = std::clamp(std::isfinite(t) ? t : 0.0, 0.0, 1.0) * (kStops.size() - 1);
  const auto i = std::min(static_cast<std::size_t>(at), kStops.size() - 2);
  const glm::dvec3 c = glm::mix(kStops[i], kStops[i + 1], at - static_cast<double>(i));
  return ImGui::ColorConvertFloat4ToU32(
      ImVec4(static_cast<float>(c.x), static_cast<float>(c.y), static_cast<float>(c.z), 1.0f));
}

int LightPalette::lightAt(const Frame& f, ImVec2 mouse) const {
  int nearest = -1;
  float best = px(9) * px(9);
  for (std::size_t i = 0; i < f.lights.size(); ++i) {
    const ImVec2 at = discScreen(f.centre, f.radius, placeOf(f.lights[i]));
    const float distance = ImLengthSqr(ImVec2(at.x - mouse.x, at.y - mouse.y));
    if (distance > best) continue;
    best = distance;
    nearest = static_cast<int>(i);
  }
  return nearest;
}

void LightPalette::pressed(Frame& f) {
  const ImGuiIO& io = ImGui::GetIO();
  m_pressedAt = io.MousePos;
  m_moved = m_edited = false;
  m_gesture = Gesture::None;
  const glm::dvec2 place = discFromScreen(f.centre, f.radius, io.MousePos);
  const int hit = lightAt(f, io.MousePos);
  const bool adds = hit < 0 && (io.KeyCtrl || io.MouseClickedCount[0] == 2);
  if (adds && f.editable && glm::length(place) <= 1.0 && f.lights.size() < kMostLights) {
    f.lights.push_back(lightFrom(place, 0.0));
    m_selection = {f.lights.size() - 1};
    f.events.changed = m_edited = true;
    f.events.label = m_label = "add light";
    m_gesture = Gesture::Move;
    m_before = f.lights;
    return;
  }
  if (hit < 0) {
    m_gesture = Gesture::Band;
    m_bandBase = io.KeyShift ? m_selection : PointSelection{};
    m_selection = m_bandBase;
    return;
  }
  const auto index = static_cast<std::size_t>(hit);
  if (io.KeyShift) {
    if (!m_selection.erase(index)) m_selection.insert(index);
  } else if (!m_selection.contains(index)) {
    m_selection = {index};
  }
  if (!f.editable || !m_selection.contains(index)) return;
  m_gesture = Gesture::Move;
  m_before = f.lights;
  m_label = counted("move", m_selection.size());
}

void LightPalette::dragged(Frame& f) {
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  const ImVec2 delta(mouse.x - m_pressedAt.x, mouse.y - m_pressedAt.y);
  if (!m_moved && ImLengthSqr(delta) < px(3) * px(3)) return;
  m_moved = true;
  if (m_gesture == Gesture::Band) {
    const ImRect band(ImMin(m_pressedAt, mouse), ImMax(m_pressedAt, mouse));
    m_selection = m_bandBase;
    for (std::size_t i = 0; i < f.lights.size(); ++i) {
      if (band.Contains(discScreen(f.centre, f.radius, placeOf(f.lights[i])))) m_selection.insert(i);
    }
    return;
  }
  if (m_before.size() != f.lights.size()) return;
  const auto radius = static_cast<double>(f.radius);
  const glm::dvec2 by(static_cast<double>(delta.x) / radius, static_cast<double>(-delta.y) / radius);
  for (const std::size_t i : m_selection) {
    if (i >= f.lights.size()) continue;
    const scene::SunAngles next = lightFrom(placeOf(m_before[i]) + by, m_before[i].azimuthDeg);
    if (next == f.lights[i]) continue;
    f.lights[i] = next;
    f.events.changed = m_edited = true;
  }
  f.events.label = m_label;
}

void LightPalette::released(Frame& f) {
  if (m_gesture == Gesture::Move && m_edited) {
    f.events.finished = true;
    f.events.label = m_label;
  }
  m_gesture = Gesture::None;
}

void LightPalette::keys(Frame& f) {
  const ImGuiIO& io = ImGui::GetIO();
  if (!ImGui::IsItemFocused() || io.WantTextInput) return;
  const auto hit = [](ImGuiKey key) { return ImGui::IsKeyPressed(ImGui::GetKeyIndex(key), false); };
  if (io.KeyCtrl && hit(ImGuiKey_A)) {
    for (std::size_t i = 0; i < f.lights.size(); ++i) m_selection.insert(i);
  }
  if (hit(ImGuiKey_Escape)) m_selection.clear();
  if (!f.editable || m_selection.empty() || !(hit(ImGuiKey_Delete) || hit(ImGuiKey_Backspace))) return;
  std::vector<scene::SunAngles> left;
  for (std::size_t i = 0; i < f.lights.size(); ++i) {
    if (!m_selection.contains(i)) left.push_back(f.lights[i]);
  }
  f.events = {true, true, counted("delete", m_selection.size())};
  f.lights = std::move(left);
  m_selection.clear();
}

void LightPalette::paintLights(const Frame& f) const {
  const Palette& c = theme().colours;
  ImDrawList* draw = ImGui::GetWindowDrawList();
  const int hot = ImGui::IsItemHovered() && m_gesture == Gesture::None ? lightAt(f, ImGui::GetIO().MousePos) : -1;
  // Many lights are drawn smaller, so that the values between them stay in sight.
  const float base = px(f.lights.size() > 120 ? 3.0f : 4.5f);
  for (std::size_t i = 0; i < f.lights.size(); ++i) {
    const ImVec2 at = discScreen(f.centre, f.radius, placeOf(f.lights[i]));
    const bool chosen = m_selection.contains(i);
    const float r = base + (static_cast<int>(i) == hot ? px(1.5f) : 0.0f);
    if (chosen) draw->AddCircleFilled(at, r + px(4), faded(c.accent, 0.45f));
    draw->AddCircleFilled(at, r + px(1), IM_COL32(0, 0, 0, 150));
    draw->AddCircleFilled(at, r, chosen ? c.accentStrong : IM_COL32(250, 250, 245, f.editable ? 255 : 200));
    logRect("light:", std::string(f.id) + ":" + std::to_string(i), ImVec2(at.x - r, at.y - r),
            ImVec2(at.x + r, at.y + r));
  }
}

void LightPalette::tooltip(const Frame& f, const HemisphereValues* values) const {
  if (!ImGui::IsItemHovered() || m_gesture == Gesture::Band) return;
  const ImVec2 mouse = ImGui::GetIO().MousePos;
  const glm::dvec2 place = discFromScreen(f.centre, f.radius, mouse);
  const int hit =
      m_gesture == Gesture::Move && !m_selection.empty() ? static_cast<int>(*m_selection.begin()) : lightAt(f, mouse);
  if (hit < 0 && glm::length(place) > 1.0) return;
  const bool light = hit >= 0 && static_cast<std::size_t>(hit) < f.lights.size();
  const SkyAngles angles = light ? SkyAngles{f.lights[static_cast<std::size_t>(hit)].azimuthDeg,
                                             f.lights[static_cast<std::size_t>(hit)].elevationDeg}
                                 : discAngles(place, DiscMap::EqualArea);
  const auto value = values != nullptr ? valueAt(*values, discPlace(angles, DiscMap::EqualArea)) : std::nullopt;
  if (!light && !value) return;
  ImGui::BeginTooltip();
  if (light) ImGui::Text("Light %d", hit + 1);
  ImGui::Text("%.1f\u00B0 %s, %.1f\u00B0 up", angles.azimuthDeg, compassPoint(angles.azimuthDeg), angles.elevationDeg);
  if (value) ImGui::TextDisabled("%s %s %s", values->title.c_str(), number(*value).c_str(), values->unit.c_str());
  ImGui::EndTooltip();
}

void LightPalette::paint(const Frame& f, const std::optional<SkyAngles>& sun, const HemisphereValues* values) const {
  const Palette& c = theme().colours;
  ImDrawList* draw = ImGui::GetWindowDrawList();
  const bool painted = values != nullptr && valueAt(*values, {0.0, 0.0}).has_value();
  const ImU32 plain = mixed(c.plot, c.text, 0.06f);
  paintDisc(draw, f.centre, f.radius, 1.0, [&](glm::dvec2 place) {
    if (!painted) return mixed(plain, c.plot, static_cast<float>(glm::length(place)));
    const double span = values->high > values->low ? values->high - values->low : 1.0;
    return rampColour((valueAt(*values, place).value_or(values->low) - values->low) / span);
  });
  const ImU32 ink = painted ? IM_COL32(255, 255, 255, 55) : c.plotGridMajor;
  for (const double elevation : {30.0, 60.0}) {
    const auto r = static_cast<float>(discPlace({0.0, elevation}, DiscMap::EqualArea).y);
    draw->AddCircle(f.centre, r * f.radius, ink, 0, std::max(1.0f, px(1)));
  }
  for (int i = 0; i < 4; ++i) {
    const double a = glm::radians(45.0 * i);
    const glm::dvec2 along(std::sin(a), std::cos(a));
    draw->AddLine(discScreen(f.centre, f.radius, -along), discScreen(f.centre, f.radius, along), faded(ink, 0.6f));
  }
  draw->AddCircle(f.centre, f.radius, c.border, 0, std::max(1.5f, px(1.5f)));
  constexpr std::array kNames{"N", "E", "S", "W"};
  for (int i = 0; i < 4; ++i) {
    const double a = glm::radians(90.0 * i);
    const char* name = kNames[static_cast<std::size_t>(i)];
    const ImVec2 size = ImGui::CalcTextSize(name);
    const ImVec2 at = discScreen(f.centre, f.radius + px(12), {std::sin(a), std::cos(a)});
    draw->AddText(ImVec2(std::round(at.x - 0.5f * size.x), std::round(at.y - 0.5f * size.y)),
                  i == 0 ? c.text : c.textDim, name);
  }
  paintLights(f);
  if (sun && sun->elevationDeg >= 0.0) {
    const ImVec2 at = discScreen(f.centre, f.radius, discPlace(*sun, DiscMap::EqualArea));
    draw->AddCircle(at, px(9), IM_COL32(0, 0, 0, 140), 0, px(4));
    draw->AddCircle(at, px(9), c.sun, 0, px(2));
    draw->AddCircleFilled(at, px(2.5f), c.sun);
    logRect("lights:", std::string(f.id) + ":sun", ImVec2(at.x - px(9), at.y - px(9)),
            ImVec2(at.x + px(9), at.y + px(9)));
  }
  if (m_gesture == Gesture::Band && m_moved) {
    const ImVec2 a = ImMin(m_pressedAt, ImGui::GetIO().MousePos), b = ImMax(m_pressedAt, ImGui::GetIO().MousePos);
    draw->AddRectFilled(a, b, faded(c.accent, 0.15f), px(2));
    draw->AddRect(a, b, faded(c.accent, 0.8f), px(2));
  }
}

LightEvents LightPalette::draw(const char* id, std::vector<scene::SunAngles>& lights, bool editable, float side,
                               const std::optional<SkyAngles>& sun, const HemisphereValues* values) {
  side = std::max(side, px(80));
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  Frame f{id,
          lights,
          editable,
          ImVec2(std::round(corner.x + 0.5f * side), std::round(corner.y + 0.5f * side)),
          std::floor(0.5f * side - px(22)),
          {}};
  ImGui::BeginGroup();
  ImGui::InvisibleButton(id, ImVec2(side, side));
  logItem("lights:", id);
  const ImGuiIO& io = ImGui::GetIO();
  if (ImGui::IsItemHovered() && ImGui::IsMouseClicked(0)) pressed(f);
  if (m_gesture != Gesture::None && io.MouseDown[0]) dragged(f);
  if (m_gesture != Gesture::None && !io.MouseDown[0]) released(f);
  keys(f);
  while (!m_selection.empty() && *m_selection.rbegin() >= lights.size()) m_selection.erase(*m_selection.rbegin());
  paint(f, sun, values);
  tooltip(f, values);
  if (values != nullptr) {
    const ImVec2 at = ImGui::GetCursorScreenPos();
    paintLegend(*values, at, side);
    ImGui::Dummy(ImVec2(side, ImGui::GetTextLineHeight()));
  }
  ImGui::EndGroup();
  return f.events;
}

}  // namespace sward::editor
