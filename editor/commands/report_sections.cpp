#include "report_sections.h"

#include "app/stall_report.h"
#include "project/nearest.h"
#include "report/section_fit.h"
#include "report/section_grassland.h"
#include "report/section_leaf_colour.h"
#include "report/section_quantisation.h"
#include "report/section_relight.h"
#include "report/section_stability.h"
#include "report/section_texel_lod.h"
#include "report/section_texel_render.h"
#include "report/section_tiles.h"
#include "report/section_wither.h"
#include "report/speed.h"

#include <algorithm>
#include <memory>

namespace sward::editor {
namespace {

using report::Section;
using report::SectionInput;

/// The row edit_stall: what the window's thread is kept from while an author drags a blade's height and bakes run.
Result<report::Row> stallRow(const Program& program, const std::string& projectFile, const SectionInput& input) {
  constexpr double kLimitMs = 100.0, kSeconds = 6.0, kQuickSeconds = 2.0;
  ApplicationOptions options;
  options.project = projectFile;
  options.overrides = program.common.overrides;
  options.cacheFolder = input.cacheFolder;
  options.unattended = true;
  SWARD_ASSIGN(const StallMeasurement measured, measureStalls(options, input.quick ? kQuickSeconds : kSeconds));
  report::Row row;
  row.method = "edit_stall";
  row.timeMs = report::TimeMs{measured.medianMs, measured.leastMs, measured.worstMs, static_cast<int>(measured.frames)};
  if (measured.worstMs > 0.0) row.ratio = kLimitMs / measured.worstMs;
  row.against = "a stall of 100 ms, over the longest frame";
  Json ends = Json::array(), counts = Json::array();
  for (const double end : StallMeter::kEndsMs) ends.push_back(end);
  for (const std::size_t count : measured.histogram) counts.push_back(count);
  row.numbersAndNames = {{"width", "1280"},
                         {"height", "800"},
                         {"histogram_ends_ms", ends.dump()},
                         {"histogram_frames", counts.dump()},
                         {"drag_s", Json(measured.dragSeconds).dump()},
                         {"pictures_during_drag", Json(measured.pictures).dump()}};
  row.notes = "frames of the interface while a height is dragged and baked; drawn through EGL without a window";
  return row;
}

Result<Section> speedSection(const Program& program, const std::string& projectFile, const SectionInput& input,
                             const JobContext& job) {
  Section section;
  section.title = "Speed";
  section.summary =
      "How fast each step is, in one row for every target that was set: sampling layers, fitting, relighting, drawing "
      "at "
      "1280 × 720, whole renders, edits until they are seen, and the bytes that light data takes. A ratio is this over "
      "a "
      "limit, or over the fastest known way to do the same, measured in the same run.";
  const report::SpeedInput speed{input.project, input.context, input.cacheFolder, input.quick};
  SWARD_ASSIGN(section.rows, report::speedRows(speed, job));
  if (job.cancelled()) return Error::cancelled();
  SWARD_ASSIGN(report::Row stalls, stallRow(program, projectFile, input));
  // The editor had its own context.
  SWARD_TRY(input.context.makeCurrent());
  section.rows.push_back(std::move(stalls));
  return section;
}

}  // namespace

std::vector<SectionEntry> reportSections(const Program& program, const std::string& projectFile) {
  const auto speed = [&program, projectFile](const SectionInput& input, const JobContext& job) {
    return speedSection(program, projectFile, input, job);
  };
  // Three sections look at one sampling; whichever runs first makes it.
  const auto source = std::make_shared<report::LightSampleSource>();
  const auto sharing = [source](auto section) {
    return [source, section](const SectionInput& input, const JobContext& job) { return section(input, *source, job); };
  };
  return {
      {"speed", "every step's rate, time and bytes against its limit or yardstick", speed, 60.0},
      {"lpt_fit", "how well each representation predicts light that it was not fitted to",
       sharing(report::lptFitSection), 60.0},
      {"lpt_relight", "how fast each is relit, with its error beside", sharing(report::lptRelightSection), 15.0},
      {"quantisation", "what bits and clamped ranges add to the error", sharing(report::quantisationSection), 20.0},
      {"tiles", "what seams cost, and how much maps and pictures repeat", report::tilesSection, 15.0},
      {"grassland", "drawing methods against the ray-traced meadow, and what each step costs", report::grasslandSection,
       80.0},
      {"leaf_colour", "leaves that age: two models against measured leaves", report::leafColourSection, 3.0},
      {"wither", "texels of withering blades against bent meshes, and what their steps cost",
       [](const SectionInput& input, const JobContext& job) { return report::witherSection(input, job); }, 8.0},
      {"texel_lod", "what levels of detail of texels let through, against traced rays",
       [](const SectionInput& input, const JobContext& job) { return report::texelLodSection(input, job); }, 8.0},
      {"texel_render", "texels and layers at one weathering degree, drawn, against ray-traced withered blades",
       report::texelRenderSection, 40.0},
      {"stability", "fits of degenerate input against a long-double oracle", report::stabilitySection, 3.0},
  };
}

Result<std::vector<SectionEntry>> chooseSections(std::vector<SectionEntry> all, const std::vector<std::string>& names) {
  std::vector<std::string> known;
  std::string list;
  for (const SectionEntry& entry : all) {
    known.push_back(entry.name);
    list += (list.empty() ? "" : ", ") + entry.name;
  }
  for (const std::string& name : names) {
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    const std::string nearest = project::nearestName(name, known);
    return Error::badInput("there is no section \"" + name + "\"", "--section",
                           (nearest.empty() ? "" : "Did you mean \"" + nearest + "\"? ") + "Sections: " + list + ".");
  }
  if (names.empty()) return all;
  std::erase_if(
      all, [&](const SectionEntry& entry) { return std::find(names.begin(), names.end(), entry.name) == names.end(); });
  return all;
}

}  // namespace sward::editor
