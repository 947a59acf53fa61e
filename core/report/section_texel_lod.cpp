#include "report/section_texel_lod.h"

#include "bake/plants.h"
#include "report/lod_levels.h"
#include "report/text.h"
#include "wither/cones.h"
#include "wither/texel_lod.h"
#include "wither/voxelise.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <utility>

namespace sward::report {
namespace {

constexpr int kBrick = wither::TexelGrid::kBrick;
constexpr std::uint64_t kSeed = 1;

/// Elevation by elevation, the azimuths beside each other; none along an axis of the grid but the zenith's.
std::vector<glm::dvec3> directionsOf(const TexelLodSize& size) {
  std::vector<glm::dvec3> directions;
  for (const double degrees : size.elevationsDeg) {
    const double elevation = degrees * std::numbers::pi / 180.0;
    for (int i = 0; i < size.azimuths; ++i) {
      const double azimuth = 2.0 * std::numbers::pi * (i + 0.3) / size.azimuths;
      directions.emplace_back(std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
                              std::sin(elevation));
    }
  }
  return directions;
}

/// Columns, halved down to `coarsest`, over whole bricks of layers at every level; voxels as nearly cubes as that lets.
wither::TexelGrid gridOf(const scene::Patch& patch, int columns, int coarsest) {
  int whole = kBrick;
  for (int c = columns; c / 2 >= coarsest && c % 2 == 0; c /= 2) whole *= 2;
  const double layers = patch.heightM / patch.sideM * columns;
  wither::TexelGrid grid{columns, whole * std::max(static_cast<int>(std::lround(layers / whole)), 1), 0.0, 0.0};
  grid.sideM = patch.sideM;
  grid.heightM = patch.heightM;
  return grid;
}

struct Subject {
  std::string name;   ///< of its rows
  std::string title;  ///< of its series
  std::shared_ptr<const scene::Patch> patch;
  wither::TexelGrid grid;
};

/// Means over the azimuths, as a JSON array.
std::string byElevation(const std::vector<double>& values, int azimuths) {
  std::string out = "[";
  for (std::size_t i = 0; i < values.size(); i += static_cast<std::size_t>(azimuths)) {
    double mean = 0.0;
    for (int a = 0; a < azimuths; ++a) mean += values[i + static_cast<std::size_t>(a)] / azimuths;
    out += (i > 0 ? ", " : "") + numberText(mean);
  }
  return out + "]";
}

std::string arrayText(const std::vector<double>& values) {
  return byElevation(values, 1);
}

class Levels {
 public:
  Levels(const TexelLodSize& size, const JobContext& job) : m_size(size), m_job(job), m_directions(directionsOf(size)) {
    m_error.name = "texel_lod_error";
    m_error.title = "Levels of detail: error of transmittance";
    m_error.xLabel = "voxels along a side";
    m_error.yLabel = "rmse of transmittance";
    m_error.caption =
        "Against rays through the triangles. Levels that keep opacity stay where the finest is; those that keep the "
        "mean density hide more at every step.";
    m_error.logX = m_error.logY = true;
  }

  Result<void> measure(const Subject& subject, Section& section) {
    m_subject = &subject;
    SWARD_TRY(trace(section));
    m_finest = {};
    SWARD_ASSIGN(const wither::VoxelisedPatch voxels, wither::voxelise(*subject.patch, subject.grid, nullptr, m_job));
    SWARD_ASSIGN(Row raw, rowOf("_as_voxelised", voxels.texel));
    section.rows.push_back(std::move(raw));
    wither::Texel finest;
    const TimeMs time = timed([&]() -> Result<void> {
      SWARD_ASSIGN(finest, wither::opaque(voxels.texel, m_job));
      return {};
    });
    SWARD_TRY(std::move(m_outcome));
    SWARD_TRY(chain(
        "", ", opacity kept", finest, time, [this](const wither::Texel& texel) { return wither::halved(texel, m_job); },
        section));
    SWARD_TRY(chain(
        "_mean_density", ", mean density", finest, time,
        [](const wither::Texel& texel) { return meanDensityHalved(texel); }, section));
    section.plots.push_back(std::move(m_byElevation));
    return {};
  }
  Plot errorPlot() { return std::move(m_error); }

 private:
  /// Runs a step that may fail, whose outcome is m_outcome then.
  TimeMs timed(const std::function<Result<void>()>& step) {
    m_outcome = {};
    return timeRuns(1, [&] {
      if (m_outcome.ok()) m_outcome = step();
    });
  }

  Result<void> trace(Section& section) {
    SWARD_ASSIGN(const auto scene, trace::PatchScene::create(m_subject->patch, m_job));
    const auto start = std::chrono::steady_clock::now();
    SWARD_ASSIGN(m_truth, tracedThrough(*scene, m_directions, m_size.rays, m_job));
    const double ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    const double rays = static_cast<double>(m_directions.size()) * m_size.rays * m_size.rays;
    Row row;
    row.method = m_subject->name + "_traced";
    row.timeMs = TimeMs{ms, ms, ms, 1};
    row.rate = rays / (ms * 1e-3);
    row.rateUnit = "rays";
    row.numbersAndNames = {{"elevations_deg", arrayText(m_size.elevationsDeg)},
                           {"true_transmittance", byElevation(m_truth.mean, m_size.azimuths)},
                           {"rays", std::to_string(static_cast<std::uint64_t>(rays))},
                           {"azimuths", std::to_string(m_size.azimuths)}};
    row.notes = "once; what the levels are compared with";
    section.rows.push_back(std::move(row));
    m_byElevation = Plot{};
    m_byElevation.name = "texel_lod_" + m_subject->name;
    m_byElevation.title = "Transmittance by elevation, " + m_subject->title;
    m_byElevation.xLabel = "elevation, degrees";
    m_byElevation.yLabel = "mean transmittance from everywhere upward";
    m_byElevation.caption = "Means over the azimuths; a level that keeps opacity lies on the traced line.";
    addByElevation("traced", m_truth);
    return {};
  }

  void addByElevation(const std::string& name, const LetThrough& through) {
    Plot::Series series{name, {}, true};
    const auto azimuths = static_cast<std::size_t>(m_size.azimuths);
    for (std::size_t e = 0; e < m_size.elevationsDeg.size(); ++e) {
      double mean = 0.0;
      for (std::size_t a = 0; a < azimuths; ++a) {
        mean += through.mean[e * azimuths + a] / static_cast<double>(azimuths);
      }
      series.points.push_back({m_size.elevationsDeg[e], mean, ""});
    }
    m_byElevation.series.push_back(std::move(series));
  }

  Result<Row> rowOf(const std::string& suffix, const wither::Texel& texel) {
    SWARD_ASSIGN(m_through, marchedThrough(texel, m_directions, m_size.marches, m_job));
    double squares = 0.0, sum = 0.0, max = 0.0, noise = 0.0;
    for (std::size_t i = 0; i < m_directions.size(); ++i) {
      const double error = m_through.mean[i] - m_truth.mean[i];
      squares += error * error;
      sum += error;
      max = std::max(max, std::abs(error));
      noise = std::max(noise, std::hypot(m_through.error[i], m_truth.error[i]));
    }
    const auto count = static_cast<double>(m_directions.size());
    Row row;
    row.method = m_subject->name + suffix;
    row.error = {{"rmse", std::sqrt(squares / count)}, {"bias", sum / count}, {"max", max}};
    row.bytes = texel.bytes();
    row.numbersAndNames = {{"columns", std::to_string(texel.grid().columns)},
                           {"layers", std::to_string(texel.grid().layers)},
                           {"voxels", std::to_string(texel.size())},
                           {"elevations_deg", arrayText(m_size.elevationsDeg)},
                           {"transmittance", byElevation(m_through.mean, m_size.azimuths)},
                           {"true_transmittance", byElevation(m_truth.mean, m_size.azimuths)},
                           {"noise", numberText(noise)}};
    row.reference = "rays through the triangles";
    if (!m_finest.mean.empty()) setChange(row);
    return row;
  }

  void setChange(Row& row) const {
    double squares = 0.0, sum = 0.0;
    for (std::size_t i = 0; i < m_directions.size(); ++i) {
      const double change = m_through.mean[i] - m_finest.mean[i];
      squares += change * change;
      sum += change;
    }
    const auto count = static_cast<double>(m_directions.size());
    row.numbersAndNames["change_rmse"] = numberText(std::sqrt(squares / count));
    row.numbersAndNames["change_bias"] = numberText(sum / count);
  }

  Result<void> chain(const std::string& suffix, const std::string& how, wither::Texel level, TimeMs time,
                     const std::function<Result<wither::Texel>(const wither::Texel&)>& half, Section& section) {
    Plot::Series series{m_subject->title + how, {}, true};
    m_finest = {};
    for (bool finest = true;; finest = false) {
      SWARD_ASSIGN(Row row, rowOf(suffix, level));
      if (finest) m_finest = m_through;
      row.timeMs = time;
      row.notes = finest ? "the time is that of making voxels hide what their leaves cover"
                         : "the time is that of making it from the level before";
      const int columns = level.grid().columns;
      series.points.push_back({static_cast<double>(columns), row.error.at("rmse"), ""});
      const bool last = columns / 2 < m_size.coarsest;
      // The finest is the same in both chains.
      if (!finest || suffix.empty()) section.rows.push_back(std::move(row));
      if ((finest && suffix.empty()) || last) addByElevation(std::to_string(columns) + how, m_through);
      if (last) break;
      wither::Texel next;
      time = timed([&]() -> Result<void> {
        SWARD_ASSIGN(next, half(level));
        return {};
      });
      SWARD_TRY(std::move(m_outcome));
      level = std::move(next);
    }
    m_error.series.push_back(std::move(series));
    return {};
  }

  const TexelLodSize& m_size;
  const JobContext& m_job;
  std::vector<glm::dvec3> m_directions;
  const Subject* m_subject = nullptr;
  LetThrough m_truth, m_through, m_finest;
  Result<void> m_outcome;
  Plot m_error, m_byElevation;
};

TexelLodSize quickSize() {
  TexelLodSize size;
  size.conesColumns = 128;
  size.patchColumns = 64;
  size.patchSideM = 0.25;
  size.azimuths = 2;
  size.coarsest = 16;
  return size;
}

const char* summary() {
  return "How much light the levels of detail of a texel let through, from everywhere in the block upward at several "
         "elevations, "
         "against rays traced through the triangles that it was made of: of the paper's cones, and of the project's "
         "plants.\n\n"
         "A voxelised mesh counts leaves as if they were spread evenly over their voxel and lets exp(-f) through where "
         "a leaf covers f; made opaque, it lets 1 - f through. Each level then keeps what its children let through "
         "along the axes. Keeping the mean density instead, as is common, spreads leaves evenly over ever larger "
         "voxels, which hide ever more.";
}

}  // namespace

Result<Section> texelLodSection(const TexelLodSize& size, const project::Project& project, const JobContext& job) {
  Section section;
  section.name = "texel_lod";
  section.title = "Texel levels of detail";
  section.summary = summary();
  const JobContext quiet{job.stop, {}, job.threads};
  wither::ConeOptions cones;
  cones.count = size.cones;
  cones.sides = 16;  // so that what a cone hides does not depend on the azimuth
  std::vector<Subject> subjects{
      {"cones", "cones", std::make_shared<const scene::Patch>(wither::growCones(cones, kSeed)), {}}};
  subjects.front().grid = {size.conesColumns, size.conesColumns, cones.sideM, cones.heightM};
  project::Project smaller = project;
  smaller.patch.sideM = std::min(project.patch.sideM, size.patchSideM);
  SWARD_ASSIGN(scene::Patch grown, bake::growPatch(smaller));
  if (!grown.instances.empty()) {
    const wither::TexelGrid grid = gridOf(grown, size.patchColumns, size.coarsest);
    subjects.push_back({"patch", "the project", std::make_shared<const scene::Patch>(std::move(grown)), grid});
  }
  Levels levels(size, quiet);
  for (std::size_t i = 0; i < subjects.size(); ++i) {
    if (job.onProgress) job.onProgress(subjects[i].name, static_cast<double>(i) / static_cast<double>(subjects.size()));
    SWARD_TRY(levels.measure(subjects[i], section));
    if (job.cancelled()) return Error::cancelled();
  }
  section.plots.insert(section.plots.begin(), levels.errorPlot());
  return section;
}

Result<Section> texelLodSection(const SectionInput& input, const JobContext& job) {
  return texelLodSection(input.quick ? quickSize() : TexelLodSize{}, input.project, job);
}

}  // namespace sward::report
