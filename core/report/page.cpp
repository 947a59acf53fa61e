#include "report/page.h"

#include "report/assets.h"
#include "report/markup.h"
#include "report/page_table.h"
#include "report/row_table.h"

#include <algorithm>

namespace sward::report {
namespace {

using Pictures = std::map<std::string, PagePicture>;

std::string paragraphs(const std::string& text, const std::string& style) {
  std::string out;
  for (std::size_t start = 0; start < text.size();) {
    const std::size_t end = std::min(text.find("\n\n", start), text.size());
    if (end > start) out += "<p class=\"" + style + "\">" + escaped(text.substr(start, end - start)) + "</p>\n";
    start = end + 2;
  }
  return out;
}

std::string titleOf(const Section& section) {
  return section.title.empty() ? nameAndUnit(section.name).first : section.title;
}

std::string entry(const std::string& name, const std::string& valueHtml) {
  return "<div><dt>" + escaped(name) + "</dt><dd>" + valueHtml + "</dd></div>\n";
}

/// A command whose lines break between words alone: browsers break within "--section" else.
std::string commandHtml(const std::string& command) {
  std::string out;
  for (std::size_t start = 0; start < command.size();) {
    const std::size_t end = std::min(command.find(' ', start), command.size());
    const std::string word = escaped(command.substr(start, end - start));
    out += (out.empty() ? "" : " ") + (word.starts_with('-') ? "<span class=\"word\">" + word + "</span>" : word);
    start = end + 1;
  }
  return "<code>" + out + "</code>";
}

std::string machineHtml(const Machine& machine) {
  std::string out = "<dl>\n";
  if (!machine.cpu.empty()) out += entry("Processor", escaped(machine.cpu));
  if (machine.cores > 0) out += entry("Cores", std::to_string(machine.cores));
  if (machine.memoryBytes > 0) {
    out += entry("Memory", figureText(static_cast<double>(machine.memoryBytes) / (1024.0 * 1024.0 * 1024.0)) + " GiB");
  }
  const gpu::DeviceInfo& device = machine.device;
  if (!device.renderer.empty()) {
    out += entry("OpenGL renderer", escaped(device.renderer) + (device.software ? " (software)" : ""));
    out += entry("OpenGL", escaped(device.version + ", through " + device.api));
  }
  return out + "</dl>\n";
}

std::string settingsHtml(const ReportHead& head, const std::vector<Section>& sections) {
  std::string out = "<dl>\n" + entry("Sward", escaped(head.version));
  if (!head.project.empty()) out += entry("Project", "<code>" + escaped(head.project) + "</code>");
  if (!head.commandLine.empty()) out += entry("Command", commandHtml(head.commandLine));
  out += entry("Effort", head.quick ? "quick: fewer runs, smaller sizes, grounds at half quality" : "full");
  for (const auto& [name, value] : head.settings) out += entry(name, escaped(value));
  std::string seconds;
  double total = 0.0;
  for (const Section& section : sections) {
    if (section.seconds <= 0.0) continue;
    seconds += "<span class=\"share\">" + escaped(section.name) + " " + fixedText(section.seconds, 1) + "</span> ";
    total += section.seconds;
  }
  if (total > 0.0) out += entry("Seconds", seconds + "<span class=\"share\">in all " + fixedText(total, 1) + "</span>");
  return out + "</dl>\n";
}

std::string contentsHtml(const std::vector<Section>& sections) {
  std::string out = "<nav class=\"contents\" aria-label=\"Contents\">\n<p>Contents</p>\n<ol>\n";
  for (const Section& section : sections) {
    out += "<li><a href=\"#" + escaped(section.name) + "\">" + escaped(titleOf(section)) + "</a></li>\n";
  }
  return out + "</ol>\n</nav>\n";
}

std::string plotHtml(const Plot& plot, const SeriesLooks& looks) {
  const PlotText drawn = plotSvg(plot, looks, false);
  std::string caption = plot.caption;
  const auto sentence = [&](const std::string& words) { caption += (caption.empty() ? "" : " ") + words; };
  if (plot.pareto) {
    sentence(
        "Lower left is better. Filled points make the front (dashed): no other is as good in both and better in one. "
        "Each hollow point, in the shaded region, is matched or beaten in both by a filled one.");
  }
  if (drawn.leftOut > 0) {
    sentence(std::to_string(drawn.leftOut) + (drawn.leftOut == 1 ? " point has" : " points have") +
             " no place on these axes (not above 0, or not finite).");
  }
  return "<figure class=\"plot\" id=\"plot-" + escaped(plot.name) + "\">\n<h3>" + escaped(plot.title) + "</h3>\n" +
         drawn.svg + "<figcaption>" + escaped(caption) + "</figcaption>\n</figure>\n";
}

std::string plotsHtml(const Section& section, const SeriesLooks& looks) {
  if (section.plots.empty()) return {};
  std::string out = "<div class=\"plots\">\n";
  for (const Plot& plot : section.plots) out += plotHtml(plot, looks);
  return out + "</div>\n";
}

std::string pictureHtml(const Picture& picture, const PagePicture& shown) {
  const std::string caption = escaped(picture.caption);
  std::string out = "<figure id=\"picture-" + escaped(picture.name) + "\">\n<a class=\"enlarge\" href=\"pictures/" +
                    escaped(picture.name) + ".png\"><img src=\"" + shown.dataUri + "\" width=\"" +
                    std::to_string(shown.width) + "\" height=\"" + std::to_string(shown.height) + "\" alt=\"" +
                    caption + "\" loading=\"lazy\"></a>\n<figcaption>" + caption;
  if (!picture.linear.empty()) {
    out += " <a class=\"data\" href=\"pictures/" + escaped(picture.name) + ".exr\">EXR</a>";
  }
  return out + "</figcaption>\n</figure>\n";
}

std::string stripsHtml(const Section& section, const Pictures& pictures) {
  std::string out;
  for (const Strip& strip : section.strips) {
    out += "<section class=\"strip\">\n<h3>" + escaped(strip.title) + "</h3>\n<div class=\"pictures\">\n";
    for (const Picture& picture : strip.pictures) {
      const auto found = pictures.find(picture.name);
      if (found != pictures.end()) out += pictureHtml(picture, found->second);
    }
    out += "</div>\n</section>\n";
  }
  return out;
}

std::string rowsHtml(const Section& section, const Pictures& pictures) {
  const auto link = [&](const std::string& name) {
    return pictures.contains(name) ? "#picture-" + name : std::string();
  };
  std::string out;
  int index = 0;
  for (const RowTable& table : rowTables(section.rows)) {
    out += tableHtml(table, escaped(section.name) + "-" + std::to_string(++index), link);
  }
  return out;
}

/// Links to what rows were computed from.
std::string dataHtml(const Section& section) {
  std::string links;
  const auto add = [&](const std::string& file, const std::string& about) {
    links += (links.empty() ? "" : ", ") + std::string("<a href=\"") + escaped(file) + "\">" + escaped(file) + "</a>" +
             (about.empty() ? "" : " (" + about + ")");
  };
  for (const Table& table : section.tables) {
    add("tables/" + table.name + ".csv", std::to_string(table.rows.size()) + " rows");
  }
  for (const Array& array : section.arrays) {
    std::string shape;
    for (const std::size_t size : array.shape) shape += (shape.empty() ? "" : " × ") + std::to_string(size);
    add("tables/" + array.name + ".npy", shape);
  }
  for (const Plot& plot : section.plots) add("plots/" + plot.name + ".svg", "");
  return links.empty() ? links : "<p class=\"files\">Measured values and plots as files: " + links + ".</p>\n";
}

std::string sectionHtml(const Section& section, const SeriesLooks& looks, const Pictures& pictures) {
  std::string out = "<section class=\"chapter\" id=\"" + escaped(section.name) + "\">\n<h2>" +
                    escaped(titleOf(section)) + "</h2>\n" + paragraphs(section.summary, "summary");
  if (!section.failure.empty()) {
    return out + "<p class=\"failure\">This section could not be measured: " + escaped(section.failure) +
           "</p>\n</section>\n";
  }
  return out + plotsHtml(section, looks) + stripsHtml(section, pictures) + rowsHtml(section, pictures) +
         dataHtml(section) + "</section>\n";
}

constexpr const char* kHowToRead =
    "Each row holds only what was measured in this run; a dash stands for what was not. Times are medians of repeated "
    "runs. Errors are against the ray-traced reference or held-out data, never against what was fitted. Light data "
    "counts the bytes of lighting alone, total adds albedo, coverage and sky.";

}  // namespace

std::string pageHtml(const ReportHead& head, const std::vector<Section>& sections, const SeriesLooks& looks,
                     const Pictures& pictures) {
  const std::string title = escaped(head.title.empty() ? head.project : head.title);
  std::string out =
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<meta name=\"color-scheme\" content=\"light dark\">\n"
      "<meta name=\"generator\" content=\"Sward " +
      escaped(head.version) + "\">\n<title>" + title + ": speed against error</title>\n<style>\n";
  out += pageStyle();
  out += plotStyle();
  out += "</style>\n</head>\n<body>\n<header>\n<p class=\"kicker\">Sward report</p>\n<h1>" + title +
         ": speed against error</h1>\n<div class=\"settings\">\n<section><h2>Machine</h2>\n" +
         machineHtml(head.machine) + "</section>\n<section><h2>Settings</h2>\n" + settingsHtml(head, sections) +
         "</section>\n</div>\n<p class=\"how\">" + std::string(kHowToRead) + "</p>\n</header>\n<div class=\"body\">\n" +
         contentsHtml(sections) + "<main>\n";
  for (const Section& section : sections) out += sectionHtml(section, looks, pictures);
  out += "</main>\n</div>\n<script>\n";
  out += pageScript();
  out += "</script>\n</body>\n</html>\n";
  return out;
}

}  // namespace sward::report
