#include "commands.h"

#include "app/stall_report.h"
#include "gpu/context.h"
#include "report/report.h"
#include "report/speed.h"

#include <array>
#include <cstdio>

namespace sward::editor {
namespace {

struct ReportRequest {
  std::string project, folder, device = "auto";
  std::vector<std::string> sections{"speed"};
  bool quick = false;
};

std::string rowText(const report::Row& row) {
  std::string text = row.method + ":";
  if (row.timeMs) text += " " + secondsText(row.timeMs->median / 1000.0);
  std::array<char, 64> number{};
  if (row.rate) {
    std::snprintf(number.data(), number.size(), " %.4g %s/s", *row.rate, row.rateUnit.c_str());
    text += number.data();
  }
  if (row.ratio) {
    std::snprintf(number.data(), number.size(), ", ratio %.3g", *row.ratio);
    text += number.data();
  }
  if (row.bytes) text += " " + bytesText(*row.bytes);
  return text;
}

/// The row edit_stall: what the window's thread is kept from while an author drags a blade's height and bakes run.
Result<report::Row> stallRow(const Program& program, const ReportRequest& request) {
  constexpr double kLimitMs = 100.0, kSeconds = 6.0, kQuickSeconds = 3.0;
  ApplicationOptions options;
  options.project = request.project;
  options.overrides = program.common.overrides;
  options.cacheFolder = cacheFolder(program);
  options.unattended = true;
  SWARD_ASSIGN(const StallMeasurement measured, measureStalls(options, request.quick ? kQuickSeconds : kSeconds));
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

Result<int> runReport(Program& program, const ReportRequest& request) {
  for (const std::string& section : request.sections) {
    if (section != "speed") {
      return Error::badInput("there is no section \"" + section + "\"", "--section", "Sections: speed.");
    }
  }
  SWARD_ASSIGN(const gpu::Device device, gpu::deviceFromName(request.device));
  SWARD_ASSIGN(const project::Project project, loadProject(program, request.project));
  SWARD_TRY(checkProject(program, project));
  std::error_code code;
  if (std::filesystem::exists(request.folder, code) && !std::filesystem::is_directory(request.folder, code)) {
    return Error::badInput("this is not a folder", request.folder, "Choose another with -o.");
  }
  SWARD_ASSIGN(const auto context, gpu::Context::create(device));
  std::vector<report::Row> rows;
  {
    ProgressBar bar(program);
    const report::SpeedInput input{project, *context, cacheFolder(program), request.quick};
    SWARD_ASSIGN(rows, report::speedRows(input, bar.job()));
  }
  SWARD_ASSIGN(report::Row stalls, stallRow(program, request));
  rows.push_back(std::move(stalls));
  for (const report::Row& row : rows) say(program, rowText(row));
  const report::ReportHead head{SWARD_VERSION, request.project, context->info()};
  std::vector<report::Section> sections(1);
  sections[0].name = "speed";
  sections[0].rows = rows;
  std::filesystem::path file;
  {
    const auto writing = program.interrupts.writing();
    SWARD_ASSIGN(file, report::writeReport(request.folder, head, sections));
  }
  say(program, "wrote " + file.string());
  if (program.common.json) print(Json::parse(report::reportJson(head, sections)));
  return kDone;
}

}  // namespace

void addReportCommand(CLI::App& app, Program& program) {
  CLI::App* command =
      addCommand(app, program, "report", "Measure speed against error on this machine",
                 "Writes DIR/report.json. Section speed: sampling, fitting, relighting, drawing and\n"
                 "whole renders, each with its rate or time and the ratio to its limit or yardstick.\n\n"
                 "Example:\n  sward report meadow.sward -o report --section speed --quick");
  const auto request = std::make_shared<ReportRequest>();
  command->add_option("PROJECT", request->project, "The project, a .sward file")->required();
  command->add_option("-o,--output", request->folder, "Folder to write to; made when needed")
      ->required()
      ->type_name("DIR");
  command->add_option("--section", request->sections, "What to measure: speed [speed] (repeatable)")
      ->type_name("NAME")
      ->delimiter(',')
      ->allow_extra_args(false);
  command->add_flag("--quick", request->quick, "Fewer runs and smaller sizes; no cold bake");
  command->add_option("--device", request->device, "OpenGL: auto, egl or osmesa [auto]")->type_name("D");
  command->callback(
      [&program, request] { program.run = [&program, request] { return runReport(program, *request); }; });
}

}  // namespace sward::editor
