#include "report/example.h"

#include "image/colour.h"

#include <array>
#include <cmath>

namespace sward::report::test {
namespace {

struct Invented {
  const char* name;
  double ms, kib, rmse;
};
constexpr std::array<Invented, 10> kMethods{{{"constant", 0.4, 256, 0.195},
                                             {"ptm8", 6.2, 1536, 0.152},
                                             {"ptm", 6.9, 3072, 0.150},
                                             {"lpt_paper", 4.1, 160, 0.231},
                                             {"lpt8", 4.1, 160, 0.158},
                                             {"lpt16", 4.6, 320, 0.157},
                                             {"lpt_clustered2", 5.2, 320, 0.155},
                                             {"lpt_clustered4", 6.4, 640, 0.153},
                                             {"hsh", 9.8, 4096, 0.151},
                                             {"marched", 41.0, 1024, 0.104}}};

Row methodRow(const Invented& method, const char* sun, double factor) {
  Row row;
  row.method = method.name;
  const double rmse = factor * method.rmse;
  row.numbersAndNames = {{"lights", "32"}, {"sun", "\"" + std::string(sun) + "\""}, {"slices", "16"}};
  row.timeMs = TimeMs{method.ms, 0.95 * method.ms, 1.2 * method.ms, 5};
  row.bytes = static_cast<std::uint64_t>(1024.0 * method.kib);
  row.bytesTotal = *row.bytes + 2u * 1024u * 1024u;
  row.error = {{"rmse", rmse}, {"psnr_db", -20.0 * std::log10(rmse)}, {"bias", -0.01 * rmse}, {"max", 5.0 * rmse}};
  row.reference = "32 held-out lights";
  if (row.method == "marched") row.numbersAndNames["voxels"] = "64";
  if (row.method == "lpt_paper") row.notes = "no ridge: coefficients up to 43, which 8 bits cannot hold";
  return row;
}

Plot methodPlot(const char* name, const char* xLabel, double Invented::*x) {
  Plot plot;
  plot.name = name;
  plot.title = std::string("Error against ") + (x == &Invented::ms ? "time" : "bytes");
  plot.xLabel = xLabel;
  plot.yLabel = "RMSE of held-out luminance";
  plot.logX = plot.logY = plot.pareto = true;
  for (const Invented& method : kMethods) plot.series.push_back({method.name, {{method.*x, method.rmse, ""}}, false});
  return plot;
}

Plot linePlot() {
  Plot plot;
  plot.name = "fit_elevation";
  plot.title = "Error against the sun's elevation";
  plot.caption = "Low suns are harder: shadows are long.";
  plot.xLabel = "sun's elevation, degrees";
  plot.yLabel = "RMSE";
  for (const std::size_t index : {1u, 4u, 9u}) {
    Plot::Series series{kMethods[index].name, {}, true};
    for (int elevation = 10; elevation <= 90; elevation += 20) {
      series.points.push_back({static_cast<double>(elevation), kMethods[index].rmse * (1.5 - elevation / 120.0), ""});
    }
    plot.series.push_back(series);
  }
  return plot;
}

/// A soft pattern, brighter to the right.
Picture picture(const std::string& name, const std::string& caption, float gain) {
  Picture made{name, caption, image::Image(750, 120, 3), image::Image(750, 120, 3)};
  for (int y = 0; y < made.linear.height; ++y) {
    for (int x = 0; x < made.linear.width; ++x) {
      const float wave =
          0.5f + 0.5f * std::sin(0.05f * static_cast<float>(x)) * std::cos(0.04f * static_cast<float>(y));
      const std::array<float, 3> colour{0.3f * wave, 0.5f * wave, 0.1f + 0.1f * wave};
      for (int c = 0; c < 3; ++c) {
        made.linear.at(x, y, c) = gain * colour[static_cast<std::size_t>(c)];
        made.display.at(x, y, c) = image::srgbFromLinear(made.linear.at(x, y, c));
      }
    }
  }
  return made;
}

Section fitSection() {
  Section section;
  section.name = "lpt_fit";
  section.title = "Fitting light responses (invented figures of a test)";
  section.summary = "What each representation keeps of held-out lights.\n\nA second paragraph about how to read it.";
  for (const char* sun : {"all", "low"}) {
    for (const Invented& method : kMethods) section.rows.push_back(methodRow(method, sun, sun[0] == 'a' ? 1.0 : 1.4));
  }
  section.plots = {methodPlot("fit_time", "time to relight, ms", &Invented::ms),
                   methodPlot("fit_bytes", "light data, KiB", &Invented::kib), linePlot()};
  Picture difference = picture("fit_difference", "FLIP, black to pale yellow", 0.2f);
  difference.linear = {};
  section.strips = {{"LPT beside the reference",
                     {picture("fit_lpt8", "lpt8", 0.9f), picture("fit_reference", "reference", 1.0f), difference}}};
  section.tables = {{"lpt_fit_lights", {"light", "squares, sum"}, {{"0", "1.5"}, {"1", "2.25"}}}};
  section.arrays = {{"lpt_fit_truth_0", {2, 3}, {0.0f, 0.5f, 1.0f, 1.5f, 2.0f, 2.5f}}};
  section.seconds = 12.25;
  return section;
}

Section speedSection() {
  Section section;
  section.name = "speed";
  section.title = "Speed (invented figures of a test)";
  section.summary = "A few unlike rows.";
  Row sampling;
  sampling.method = "layer_sampling";
  sampling.numbersAndNames = {{"resolution", "128"}, {"threads", "2"}};
  sampling.timeMs = TimeMs{277.8, 253.5, 374.2, 7};
  sampling.rate = 4552455.0;
  sampling.rateUnit = "rays";
  sampling.ratio = 0.871;
  sampling.against = "a bare loop";
  Row cold;
  cold.method = "render_cold";
  cold.timeMs = TimeMs{8123.0, 8123.0, 8123.0, 1};
  section.rows = {sampling, cold};
  section.seconds = 36.5;
  return section;
}

}  // namespace

const char* const kHostile = "</script><b>\"Gräser\" & 'Blätter'</b>\x01 \xff]]> -->";

ReportHead exampleHead() {
  ReportHead head;
  head.version = "0.0.test";
  head.project = "fields/example.sward";
  head.title = "Example";
  head.commandLine = "sward report fields/example.sward -o report";
  head.machine = {"a processor", 2, std::uint64_t{8} << 30, {"EGL", "Mesa", "llvmpipe", "4.5", true}};
  return head;
}

std::vector<Section> exampleSections() {
  return {speedSection(), fitSection()};
}

std::vector<Section> hostileSections() {
  std::vector<Section> sections = exampleSections();
  for (Section& section : sections) {
    section.title = section.summary = kHostile;
    for (Row& row : section.rows) {
      row.method = row.notes = row.against = row.reference = row.rateUnit = kHostile;
      row.ratio = 1.0;
      row.numbersAndNames["\"quoted\" <name>"] = R"("</script> \"wörter\" & <i>")";
      row.error["<error>"] = 0.5;
    }
    for (Plot& plot : section.plots) {
      plot.title = plot.caption = plot.xLabel = plot.yLabel = kHostile;
      for (Plot::Series& series : plot.series) {
        series.name += kHostile;
        for (Plot::Point& point : series.points) point.label = kHostile;
      }
    }
    for (Strip& strip : section.strips) {
      strip.title = kHostile;
      for (Picture& shown : strip.pictures) shown.caption = kHostile;
    }
  }
  return sections;
}

}  // namespace sward::report::test
