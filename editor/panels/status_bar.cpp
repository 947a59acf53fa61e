#include "panels/status_bar.h"

#include "widgets/icons.h"
#include "widgets/item_log.h"
#include "widgets/theme.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>

#include <imgui.h>
#include <unistd.h>

namespace sward::editor {
namespace {

constexpr std::array<const char*, 3> kQualityNames{"coarse", "half", "full"};

std::string format(const char* pattern, double value) {
  std::array<char, 96> text{};
  std::snprintf(text.data(), text.size(), pattern, value);
  return text.data();
}

std::string timeLeftText(double seconds) {
  if (seconds < 1.0) return "under a second left";
  if (seconds < 90.0) return format("%.0f s left", seconds);
  return format("%.0f min left", seconds / 60.0);
}

/// What runs, or what is on screen.
void bakePart(const PanelContext& context) {
  const LiveState& live = context.live;
  const Palette& colours = theme().colours;
  if (live.bake.running) {
    const std::string quality = kQualityNames[static_cast<std::size_t>(live.bake.quality)];
    ImGui::PushStyleColor(ImGuiCol_PlotHistogram, colours.accent);
    ImGui::SetCursorPosY(ImGui::GetCursorPosY() + px(5.0f));
    ImGui::ProgressBar(static_cast<float>(live.bake.fraction), ImVec2(px(120.0f), px(8.0f)), "");
    ImGui::PopStyleColor();
    ImGui::SameLine();
    ImGui::SetCursorPosY(ImGui::GetCursorPosY() - px(5.0f));
    std::string text = "Baking " + quality + ": " + live.bake.stage;
    if (live.bake.secondsLeft) text += ", " + timeLeftText(*live.bake.secondsLeft);
    ImGui::TextUnformatted(text.c_str());
    ImGui::SameLine();
    if (ImGui::SmallButton(icon::kClose)) context.edits.run("bake.cancel");
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("Stop baking; the next edit starts again");
    logItem("status.cancelBake");
    return;
  }
  if (!live.ground) {
    ImGui::TextDisabled("Nothing baked yet");
    return;
  }
  const std::string quality = kQualityNames[static_cast<std::size_t>(live.quality)];
  ImGui::TextDisabled("%s", (quality + " quality, " + std::to_string(live.samples) +
                             (live.samples == 1 ? " sample" : " samples") + (live.pictureFinal ? ", final" : ""))
                                .c_str());
}

}  // namespace

std::uint64_t residentBytes() {
  std::ifstream file("/proc/self/statm");
  std::uint64_t total = 0, resident = 0;
  if (!(file >> total >> resident)) return 0;
  return resident * static_cast<std::uint64_t>(std::max(sysconf(_SC_PAGESIZE), 0L));
}

void drawStatusBar(PanelContext& context, const std::string& stalls) {
  const LiveState& live = context.live;
  ImGui::SetCursorPos({px(10.0f), px(4.0f)});
  bakePart(context);
  logItem("status.bake");

  const std::string renderer = live.device ? live.device->api + ", " + live.device->renderer : "no renderer";
  const std::string right = format("%.0f ms", live.drawMs) +
                            (live.framesPerSecond > 0.0 ? format("  |  %.1f frames/s", live.framesPerSecond) : "") +
                            format("  |  %.0f MiB", static_cast<double>(residentBytes()) / (1024.0 * 1024.0)) +
                            "  |  " + renderer;
  const float width = ImGui::CalcTextSize(right.c_str()).x;
  ImGui::SameLine(std::max(ImGui::GetWindowWidth() - width - px(12.0f), px(320.0f)));
  ImGui::SetCursorPosY(px(4.0f));
  ImGui::TextDisabled("%s", right.c_str());
  logItem("status.numbers");
  if (ImGui::IsItemHovered()) {
    ImGui::SetTooltip(
        "Time of the last sample, pictures a second, memory in use, and what draws the viewport.\n\n"
        "Frames of the interface while baking:\n%s",
        stalls.c_str());
  }
}

}  // namespace sward::editor
