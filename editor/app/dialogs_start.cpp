#include "app/dialogs.h"

#include "widgets/item_log.h"
#include "widgets/theme.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <ctime>

#include <imgui.h>

namespace sward::editor {
namespace {

constexpr double kGibibyte = 1024.0 * 1024.0 * 1024.0;

std::string timeText(std::chrono::system_clock::time_point time) {
  const std::time_t seconds = std::chrono::system_clock::to_time_t(time);
  std::tm parts{};
  localtime_r(&seconds, &parts);
  std::array<char, 64> text{};
  std::strftime(text.data(), text.size(), "%Y-%m-%d %H:%M", &parts);
  return text.data();
}

/// A label on the left; the next item takes the rest of the line.
void labelled(const char* label, const char* help) {
  ImGui::AlignTextToFramePadding();
  ImGui::TextUnformatted(label);
  if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", help);
  ImGui::SameLine(px(170.0f));
  ImGui::SetNextItemWidth(-1.0f);
}

}  // namespace

void Dialogs::drawRecovery(const Input& input) {
  if (!begin("Unsaved work was found", input, 560.0f)) return;
  ImGui::TextWrapped("The editor did not end in peace last time. These copies were kept:");
  std::optional<std::filesystem::path> recovered, dropped;
  for (std::size_t i = 0; i < m_recovery.usable.size(); ++i) {
    const Recoverable& entry = m_recovery.usable[i];
    ImGui::PushID(static_cast<int>(i));
    ImGui::Separator();
    ImGui::TextUnformatted(entry.title.c_str());
    ImGui::SameLine();
    ImGui::TextDisabled("%s%s", timeText(entry.time).c_str(),
                        entry.fileIsNewer ? ", but its file was saved after that" : "");
    if (!entry.file.empty()) ImGui::TextDisabled("%s", entry.file.string().c_str());
    if (button("Recover", ("recover" + std::to_string(i)).c_str(), i == 0)) recovered = entry.autosave;
    ImGui::SameLine();
    if (button("Throw away", ("discard" + std::to_string(i)).c_str())) dropped = entry.autosave;
    ImGui::PopID();
  }
  for (const DamagedAutosave& damaged : m_recovery.damaged) {
    ImGui::Separator();
    ImGui::TextWrapped("A copy is damaged and cannot be used: %s", damaged.problem.text().c_str());
  }
  ImGui::Dummy({0.0f, px(10.0f)});
  if (button("Later", "close")) close();
  if (dropped) {
    (void)discardRecoverable(*dropped);
    std::erase_if(m_recovery.usable, [&](const Recoverable& entry) { return entry.autosave == *dropped; });
    if (m_recovery.usable.empty() && m_recovery.damaged.empty()) close();
  }
  if (recovered) close();
  ImGui::EndPopup();
  if (recovered) input.act.recover(*recovered);
}

void Dialogs::drawPreferences(const Input& input) {
  if (!begin("Preferences", input, 480.0f)) return;
  Preferences& preferences = input.preferences;
  constexpr std::array<std::pair<double, const char*>, 7> kScales{{{0.0, "From the screen"},
                                                                   {0.75, "75 %"},
                                                                   {1.0, "100 %"},
                                                                   {1.25, "125 %"},
                                                                   {1.5, "150 %"},
                                                                   {2.0, "200 %"},
                                                                   {3.0, "300 %"}}};
  const auto scale = std::find_if(kScales.begin(), kScales.end(),
                                  [&](const auto& s) { return std::abs(s.first - preferences.uiScale) < 0.01; });
  labelled("Scale", "Size of text and panels, for high-density screens");
  if (ImGui::BeginCombo("##scale", scale == kScales.end() ? "Own" : scale->second)) {
    for (const auto& [value, label] : kScales) {
      if (!ImGui::Selectable(label, value == preferences.uiScale)) continue;
      preferences.uiScale = value;
      input.act.preferencesChanged();
    }
    ImGui::EndCombo();
  }
  logItem("preferences.scale");
  labelled("Theme", "Dark for evenings and colour work, light for bright rooms");
  int themeIndex = preferences.theme == ThemeChoice::Light ? 1 : 0;
  if (ImGui::Combo("##theme", &themeIndex, "Dark\0Light\0")) {
    preferences.theme = themeIndex == 1 ? ThemeChoice::Light : ThemeChoice::Dark;
    input.act.preferencesChanged();
  }
  logItem("preferences.theme");
  labelled("Cache on disk", "Baked results are kept up to this size; the oldest go first. Used from the next start");
  auto cache = static_cast<float>(static_cast<double>(preferences.cacheLimitBytes) / kGibibyte);
  if (ImGui::SliderFloat("##cache", &cache, 0.25f, 64.0f, "%.2f GiB",
                         ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_AlwaysClamp))
    preferences.cacheLimitBytes = static_cast<std::uint64_t>(static_cast<double>(cache) * kGibibyte);
  labelled("Viewport drawn by", "OpenGL for the viewport's pictures. Used from the next start");
  constexpr std::array<const char*, 3> kDevices{"auto", "egl", "osmesa"};
  if (ImGui::BeginCombo("##device", preferences.device.empty() ? "auto" : preferences.device.c_str())) {
    for (const char* device : kDevices)
      if (ImGui::Selectable(device, preferences.device == device)) preferences.device = device;
    ImGui::EndCombo();
  }
  labelled("Copy for recovery", "Least time between two copies of unsaved work");
  auto autosave = static_cast<float>(preferences.autosaveSeconds);
  if (ImGui::SliderFloat("##autosave", &autosave, 1.0f, 300.0f, "every %.0f s",
                         ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_AlwaysClamp))
    preferences.autosaveSeconds = static_cast<double>(autosave);
  labelled("First steps", "Five things to try, when the editor starts");
  ImGui::Checkbox("##hints", &preferences.showHints);
  ImGui::Dummy({0.0f, px(10.0f)});
  if (button("Close", "close", true)) {
    input.act.rememberPreferences();
    close();
  }
  ImGui::EndPopup();
}

}  // namespace sward::editor
