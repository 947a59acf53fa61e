// Of section wither: texels from points against the blades bent as meshes, and what the paper's motion does to blades.

#include "report/section_wither.h"
#include "report/text.h"
#include "wither/key_frames.h"
#include "wither/pose.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <utility>

namespace sward::report {
namespace {

constexpr double kPaperProportion = 6.0;
constexpr int kRuns = 2;

using MakeTexel = std::function<Result<wither::Texel>(const wither::Points& points)>;

struct Truth {
  wither::Texel texel;
  Cover cover;
};

/// Errors of some draws of points, taken together: rmse over all of their cells.
Result<Row> drawnRow(const WitherSize& size, const WitherBench& bench, double proportion, const Truth& truth,
                     const MakeTexel& make, const JobContext& job) {
  Row row;
  CoverError all;
  double look = 0.0;
  std::size_t points = 0, voxels = 0;
  for (int draw = 0; draw < size.draws; ++draw) {
    SWARD_ASSIGN(const wither::Points drawn, bench.points(proportion, static_cast<std::uint64_t>(draw + 1), job));
    wither::Texel texel;
    Result<void> outcome;
    const auto run = [&]() -> Result<void> {
      SWARD_ASSIGN(texel, make(drawn));
      return {};
    };
    if (draw == 0) {
      row.timeMs = timeRuns(kRuns, [&] {
        if (outcome.ok()) outcome = run();
      });
    } else {
      outcome = run();
    }
    SWARD_TRY(std::move(outcome));
    const Cover cover = coverOf(texel);
    const CoverError error = coverError(cover, truth.cover);
    for (std::size_t view = 0; view < Cover::kViews; ++view) {
      all.rmse[view] += error.rmse[view] * error.rmse[view] / size.draws;
      all.bias[view] += error.bias[view] / size.draws;
      all.max[view] = std::max(all.max[view], error.max[view]);
    }
    all.area += error.area / size.draws;
    all.meanHeightM += error.meanHeightM / size.draws;
    SWARD_ASSIGN(const double difference, wither::lookDifference(texel, truth.texel));
    look += difference / size.draws;
    points = drawn.size();
    voxels = texel.size();
  }
  for (double& rmse : all.rmse) rmse = std::sqrt(rmse);
  setCoverError(all, truth.cover, row);
  row.numbersAndNames.insert({{"proportion", numberText(proportion)},
                              {"points", std::to_string(points)},
                              {"voxels", std::to_string(voxels)},
                              {"blades", std::to_string(bench.blades())},
                              {"resolution", std::to_string(bench.grid().columns)},
                              {"draws", std::to_string(size.draws)},
                              {"look_difference", numberText(look)}});
  row.reference = "the same blades bent as meshes, voxelised";
  return row;
}

Plot::Point pointOf(double x, const Row& row, std::string label) {
  const auto relative = row.numbersAndNames.find("relative_rmse");
  return {x, relative == row.numbersAndNames.end() ? 0.0 : std::stod(relative->second), std::move(label)};
}

Plot::Series& seriesOf(Plot& plot, const std::string& name) {
  for (Plot::Series& series : plot.series) {
    if (series.name == name) return series;
  }
  plot.series.push_back({name, {}, true});
  return plot.series.back();
}

Plot speedPlot() {
  Plot plot;
  plot.name = "wither_speed_error";
  plot.title = "Points: time against error";
  plot.xLabel = "posing and splatting, ms";
  plot.yLabel = "rmse of opacity over its mean";
  plot.caption =
      "Each line is one weathering degree; labels are the proportion, points a voxel whose leaf covers its face.";
  plot.logX = plot.logY = true;
  return plot;
}

Plot degreePlot() {
  Plot plot;
  plot.name = "wither_motion_error";
  plot.title = "Error over the weathering degree";
  plot.xLabel = "weathering degree";
  plot.yLabel = "rmse of opacity over its mean";
  plot.caption = "Points against the blades bent as meshes; the paper's motion moves the same points.";
  plot.logY = true;
  return plot;
}

/// Points on the veins themselves, evenly along each strand, strand by strand.
wither::Points onVeins(const std::vector<wither::Strand>& strands, std::size_t perStrand) {
  wither::Points points;
  points.resize(strands.size() * perStrand);
  for (std::size_t k = 0; k < strands.size(); ++k) {
    const std::vector<glm::dvec3>& vein = strands[k].vein;
    for (std::size_t i = 0; i < perStrand; ++i) {
      const double s = static_cast<double>(i) / static_cast<double>(perStrand - 1);
      const double place = s * static_cast<double>(vein.size() - 1);
      const std::size_t n = std::min(static_cast<std::size_t>(place), vein.size() - 2);
      const std::size_t at = k * perStrand + i;
      points.positions[at] = glm::mix(vein[n], vein[n + 1], place - static_cast<double>(n));
      points.tangents[at] = {0.0f, 0.0f, 1.0f};
      points.attachments[at] = {static_cast<std::int32_t>(k), static_cast<float>(s)};
    }
  }
  return points;
}

double lengthOf(const wither::Points& points, std::size_t first, std::size_t count) {
  double length = 0.0;
  for (std::size_t i = first + 1; i < first + count; ++i) {
    length += glm::length(glm::dvec3(points.positions[i]) - glm::dvec3(points.positions[i - 1]));
  }
  return length;
}

}  // namespace

Result<void> addPointsAgainstMeshes(const WitherSize& size, const WitherBench& bench, Section& section,
                                    const JobContext& job) {
  Plot speed = speedPlot(), degrees = degreePlot();
  for (const double weathering : size.weatherings) {
    Truth truth;
    SWARD_ASSIGN(truth.texel, bench.direct(weathering, job));
    truth.cover = coverOf(truth.texel);
    const auto named = [&](Row row, const char* method) {
      row.method = method;
      row.numbersAndNames["weathering"] = numberText(weathering);
      section.rows.push_back(std::move(row));
      return &section.rows.back();
    };
    for (const double proportion : size.proportions) {
      const MakeTexel make = [&](const wither::Points& points) { return bench.texel(points, weathering, {}, job); };
      SWARD_ASSIGN(Row row, drawnRow(size, bench, proportion, truth, make, job));
      const Row* points = named(std::move(row), "points");
      const std::string label = numberText(proportion);
      seriesOf(speed, "weathering " + numberText(weathering))
          .points.push_back(pointOf(points->timeMs->median, *points, label));
      seriesOf(degrees, "proportion " + label).points.push_back(pointOf(weathering, *points, ""));
    }
    const MakeTexel make = [&](const wither::Points& points) { return bench.paperTexel(points, weathering, job); };
    SWARD_ASSIGN(Row row, drawnRow(size, bench, kPaperProportion, truth, make, job));
    row.notes = "neither shrinks nor changes colour";
    const Row* paper = named(std::move(row), "paper_motion");
    seriesOf(degrees, "the paper's motion, 6").points.push_back(pointOf(weathering, *paper, ""));
  }
  section.plots.push_back(std::move(speed));
  section.plots.push_back(std::move(degrees));
  return {};
}

Result<void> addBladeLengths(const WitherSize& size, const WitherBench& bench, Section& section,
                             const JobContext& job) {
  constexpr std::size_t kPerStrand = 1025;
  const std::vector<wither::Strand>& strands = bench.strands().strands;
  const wither::Points rest = onVeins(strands, kPerStrand);
  for (const double weathering : size.weatherings) {
    for (const bool ours : {true, false}) {
      wither::Points moved;
      SWARD_TRY(ours ? wither::pose(rest, strands, bench.season(), {}, weathering, {}, moved, job)
                     : wither::paperPose(rest, strands, bench.season(), {}, weathering, moved, job));
      double sum = 0.0, squares = 0.0, max = 0.0;
      for (std::size_t k = 0; k < strands.size(); ++k) {
        const wither::BladeState state = bench.season().state(weathering, strands[k].delay, strands[k].droop);
        const double expected = lengthOf(rest, k * kPerStrand, kPerStrand) * (ours ? 1.0 - state.strainAlong : 1.0);
        const double error = lengthOf(moved, k * kPerStrand, kPerStrand) / expected - 1.0;
        sum += error;
        squares += error * error;
        max = std::max(max, std::abs(error));
      }
      const auto count = static_cast<double>(strands.size());
      Row row;
      row.method = "blade_length";
      row.numbersAndNames = {{"motion", ours ? "\"ours\"" : "\"paper\""},
                             {"weathering", numberText(weathering)},
                             {"blades", std::to_string(strands.size())}};
      row.error = {{"bias", sum / count}, {"rmse", std::sqrt(squares / count)}, {"max", max}};
      row.reference = ours ? "the length at rest, less the vein's strain" : "the length at rest: it does not shrink";
      row.notes = "relative; along the vein, in 1,024 pieces";
      section.rows.push_back(std::move(row));
    }
  }
  return {};
}

}  // namespace sward::report
