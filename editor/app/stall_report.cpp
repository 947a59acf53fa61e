#include "app/stall_report.h"

#include "app/offscreen.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <thread>
#include <vector>

namespace sward::editor {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kWidth = 1280, kHeight = 800;
constexpr double kFirstPictureSeconds = 60.0;
constexpr double kFramePause = 1.0 / 60.0;
constexpr double kSwing = 0.2;  ///< of the height, each way

double since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

void pause(double seconds) {
  std::this_thread::sleep_for(std::chrono::duration<double>(std::max(seconds, 0.0)));
}

}  // namespace

Result<StallMeasurement> measureStalls(const ApplicationOptions& options, double seconds) {
  SWARD_ASSIGN(const auto editor, OffscreenEditor::create(options, kWidth, kHeight));
  Application& application = editor->application();
  const auto& plants = application.document().project().patch.plants;
  const auto grass = std::find_if(plants.begin(), plants.end(),
                                  [](const project::Plant& p) { return p.kind == project::PlantKind::Grass; });
  if (grass == plants.end()) return Error::badInput("there is no procedural grass to drag", "edit_stall");
  const auto index = static_cast<std::size_t>(grass - plants.begin());
  const double height = grass->grass.heightM;

  auto start = Clock::now();
  while (application.live().state().picture.texture == 0) {
    if (since(start) > kFirstPictureSeconds) return Error::failed("no picture came", "edit_stall");
    editor->frame();
    pause(kFramePause);
  }

  StallMeasurement out;
  std::vector<double> times;
  const auto frame = [&] {
    const std::uint64_t before = application.live().pictures();
    const bool baking = application.live().state().bake.running;
    const double milliseconds = editor->frame();
    out.pictures += static_cast<int>(application.live().pictures() - before);
    if (baking) times.push_back(milliseconds);
    pause(kFramePause - milliseconds / 1000.0);
  };
  start = Clock::now();
  while (since(start) < seconds) {
    const double value = height * (1.0 + kSwing * std::sin(3.0 * since(start)));
    application.edit(
        "blade height", [&](project::Project& p) { p.patch.plants[index].grass.heightM = value; }, "edit_stall");
    frame();
  }
  out.dragSeconds = since(start);
  const int dragged = out.pictures;
  application.closeStep();
  start = Clock::now();
  while (!application.live().settled() && since(start) < seconds) frame();
  out.pictures = dragged;

  out.frames = times.size();
  out.histogram = application.stalls().whileBaking();
  if (times.empty()) return out;
  out.leastMs = *std::min_element(times.begin(), times.end());
  out.worstMs = *std::max_element(times.begin(), times.end());
  std::nth_element(times.begin(), times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2), times.end());
  out.medianMs = times[times.size() / 2];
  return out;
}

}  // namespace sward::editor
