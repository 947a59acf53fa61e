#include "commands.h"
#include "report_sections.h"

#include "bake/withering.h"
#include "gpu/context.h"
#include "report/writer.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <numeric>

namespace sward::editor {
namespace {

struct ReportRequest {
  std::string project, folder, device = "auto";
  std::vector<std::string> sections;
  bool quick = false;
};

std::string formatted(const char* format, double value) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), format, value);
  return text.data();
}

/// What tells a row from the others of its method: words and whole numbers that differ, but for measured ones.
std::string distinction(const report::Row& row, const std::vector<report::Row>& rows) {
  constexpr std::size_t kLongest = 24;
  std::string text;
  for (const auto& [name, value] : row.numbersAndNames) {
    const bool measured = name.ends_with("_bytes") || name.ends_with("_ms") || name == "rays";
    const bool plain = value.front() == '"' || value.find_first_not_of("0123456789-") == std::string::npos;
    const auto differs = [&, key = name](const report::Row& other) {
      const auto found = other.numbersAndNames.find(key);
      return other.method == row.method && found != other.numbersAndNames.end() &&
             found->second != row.numbersAndNames.at(key);
    };
    if (measured || !plain || value.size() > kLongest || std::none_of(rows.begin(), rows.end(), differs)) continue;
    const Json json = Json::parse(value);
    text += (text.empty() ? " (" : ", ") + (json.is_string() ? json.get<std::string>() : name + " " + value);
  }
  return text.empty() ? text : text + ")";
}

std::string rowText(const report::Row& row, const std::vector<report::Row>& rows) {
  std::vector<std::string> parts;
  if (row.timeMs) parts.push_back(secondsText(row.timeMs->median / 1000.0));
  if (row.rate) parts.push_back(formatted("%.4g ", *row.rate) + row.rateUnit + "/s");
  if (row.ratio) parts.push_back("ratio " + formatted("%.3g", *row.ratio));
  if (row.bytes) parts.push_back(bytesText(*row.bytes));
  for (const auto& [name, value] : row.error) parts.push_back(name + " " + formatted("%.4g", value));
  std::string text = row.method + distinction(row, rows) + ":";
  for (std::size_t i = 0; i < parts.size(); ++i) text += (i == 0 ? " " : ", ") + parts[i];
  return text;
}

/// One part of a bar that stands for all sections.
class SectionProgress {
 public:
  SectionProgress(const std::vector<SectionEntry>& entries, const JobContext& whole) : m_whole(whole) {
    for (const SectionEntry& entry : entries) m_seconds.push_back(std::max(entry.seconds, 0.1));
  }
  /// For the section of this index.
  JobContext job(std::size_t index, const std::string& name) const {
    JobContext part{m_whole.stop, {}, m_whole.threads};
    if (!m_whole.onProgress) return part;
    const double total = std::accumulate(m_seconds.begin(), m_seconds.end(), 0.0);
    const auto at = m_seconds.begin() + static_cast<std::ptrdiff_t>(index);
    const double before = std::accumulate(m_seconds.begin(), at, 0.0) / total;
    const std::string place = name + " (" + std::to_string(index + 1) + " of " + std::to_string(m_seconds.size()) + ")";
    part.onProgress = [=, share = *at / total, report = m_whole.onProgress](const std::string& stage, double fraction) {
      report(place + (stage.empty() ? "" : ", " + stage), before + share * fraction);
    };
    part.onProgress("", 0.0);
    return part;
  }

 private:
  const JobContext& m_whole;
  std::vector<double> m_seconds;
};

/// All sections that were asked for. One that fails is told and leaves the others their place; when all fail, the
/// first one's error is the command's.
Result<std::vector<report::Section>> measure(Program& program, const std::vector<SectionEntry>& entries,
                                             const report::SectionInput& input, std::vector<Error>& failures) {
  ProgressBar bar(program);
  const JobContext whole = bar.job();
  const SectionProgress progress(entries, whole);
  std::vector<report::Section> sections;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    StopWatch watch;
    Result<report::Section> measured = entries[i].measure(input, progress.job(i, entries[i].name));
    if (whole.cancelled()) return Error::cancelled();
    report::Section section = measured.ok() ? std::move(measured).value() : report::Section{};
    section.name = entries[i].name;
    section.seconds = watch.lap();
    if (!measured.ok()) {
      section.failure = measured.error().text();
      failures.push_back(measured.error());
    }
    sections.push_back(std::move(section));
  }
  if (failures.size() == entries.size()) return failures.front();
  return sections;
}

report::ReportHead headOf(const Program& program, const ReportRequest& request, const report::SectionInput& input) {
  report::ReportHead head;
  head.version = SWARD_VERSION;
  head.project = request.project;
  head.title = input.project.name;
  head.commandLine = program.commandLine;
  head.quick = request.quick;
  head.machine = report::thisMachine(input.context.info());
  if (program.common.threads > 0) head.settings.emplace_back("Threads", std::to_string(program.common.threads));
  return head;
}

void sayRows(const Program& program, const std::vector<report::Section>& sections) {
  std::string seconds;
  double total = 0.0;
  for (const report::Section& section : sections) {
    if (sections.size() > 1) say(program, section.name);
    for (const report::Row& row : section.rows)
      say(program, (sections.size() > 1 ? "  " : "") + rowText(row, section.rows));
    seconds += section.name + " " + formatted("%.1f", section.seconds) + ", ";
    total += section.seconds;
  }
  say(program, "seconds: " + seconds + "in all " + formatted("%.1f", total));
}

Result<int> runReport(Program& program, const ReportRequest& request) {
  SWARD_ASSIGN(const std::vector<SectionEntry> entries,
               chooseSections(reportSections(program, request.project), request.sections));
  SWARD_ASSIGN(const gpu::Device device, gpu::deviceFromName(request.device));
  SWARD_ASSIGN(project::Project project, loadProject(program, request.project));
  SWARD_TRY(checkProject(program, project));
  if (bake::drawnAsTexels(project)) {
    project.render.method = render::GroundMethod::March;
    warn(program,
         "the project is drawn as texels; its layers are measured, and its texels by the sections wither, texel_lod "
         "and texel_render");
  }
  SWARD_TRY(report::checkReportFolder(request.folder));
  SWARD_ASSIGN(const auto context, gpu::Context::create(device));
  const report::SectionInput input{project, *context, cacheFolder(program), request.quick};
  std::vector<Error> failures;
  SWARD_ASSIGN(const std::vector<report::Section> sections, measure(program, entries, input, failures));
  const report::ReportHead head = headOf(program, request, input);
  report::WrittenReport written;
  {
    ProgressBar bar(program);
    SWARD_ASSIGN(report::StagedReport staged, report::StagedReport::stage(request.folder, head, sections, bar.job()));
    const auto writing = program.interrupts.writing();
    SWARD_ASSIGN(written, staged.commit());
  }
  sayRows(program, sections);
  say(program, "wrote " + written.page.string() + " and " + std::to_string(written.files - 1) + " files beside it, " +
                   bytesText(written.bytes));
  for (const Error& failure : failures) complain(failure.text());
  if (program.common.json) print(Json::parse(report::reportJson(head, sections)));
  return failures.empty() ? kDone : exitCodeOf(failures.front());
}

std::string helpText(const std::vector<SectionEntry>& entries) {
  std::string text =
      "Writes a report of one project on this machine to DIR: report.html (one file that needs\n"
      "nothing beside it), report.json (the same rows for programs), plots/*.svg, pictures/*.png\n"
      "and *.exr, tables/*.csv and *.npy (what the rows were computed from). It takes the place of\n"
      "the report before it in DIR; other files there are left alone. Times are medians on this\n"
      "machine: let nothing else run.\n\nSections:\n";
  for (const SectionEntry& entry : entries) {
    text +=
        "  " + entry.name + std::string(entry.name.size() < 14 ? 14 - entry.name.size() : 1, ' ') + entry.about + "\n";
  }
  return text +
         "\nExamples:\n"
         "  sward report projects/meadow.sward -o report\n"
         "  sward report meadow.sward -o report --quick --section speed\n"
         "  sward report meadow.sward -o report --json --quiet > rows.json\n"
         "  sward report meadow.sward -o more --set lights.count=32";
}

}  // namespace

void addReportCommand(CLI::App& app, Program& program) {
  const std::vector<SectionEntry> entries = reportSections(program, {});
  CLI::App* command =
      addCommand(app, program, "report", "Measure speed against error on this machine", helpText(entries));
  const auto request = std::make_shared<ReportRequest>();
  command->add_option("PROJECT", request->project, "The project, a .sward file")->required();
  command->add_option("-o,--output", request->folder, "Folder to write to; made when needed")
      ->required()
      ->type_name("DIR");
  command->add_option("--section", request->sections, "What to measure, see below [all] (repeatable)")
      ->type_name("NAME")
      ->delimiter(',')
      ->allow_extra_args(false);
  command->add_flag("--quick", request->quick, "Fewer runs, smaller sizes, grounds at half quality; in under a minute");
  command->add_option("--device", request->device, "OpenGL: auto, egl or osmesa [auto]")->type_name("D");
  command->callback(
      [&program, request] { program.run = [&program, request] { return runReport(program, *request); }; });
}

}  // namespace sward::editor
