#include "report/speed_wither.h"

#include "report/text.h"
#include "report/wither_bench.h"
#include "wither/mingle.h"
#include "wither/packed_texel.h"
#include "wither/pose.h"

#include <cstring>
#include <functional>
#include <string>
#include <tuple>
#include <utility>

namespace sward::report {
namespace {

constexpr double kWeathering = 0.6;  ///< everything moves and changes colour
constexpr double kKeyFrameLimitBytes = 12e6;
constexpr double kDensePaperBytes = 200e6;
constexpr double kMingleLimitMs = 150.0;
constexpr std::uint64_t kSeed = 1;

/// One of the three steps of a texel that withers.
struct Step {
  const char* method;
  double limitMs, paperMs;
  const char* notes;
};
constexpr Step kToPoints{"wither_to_points", 10.0, 220.0, "from the texel at rest, once a proportion"};
constexpr Step kStep{"wither_step", 1.0, 6300.0, "positions, normals, tangents, areas and colours at one moment"};
constexpr Step kToTexel{"wither_to_texel", 60.0, 2610.0, "splatted over 3 x 3 x 3 voxels each"};

std::uint64_t bytesOf(const wither::Points& points) {
  constexpr std::uint64_t kPoint =
      5 * sizeof(glm::vec3) + 6 * sizeof(float) + 2 * sizeof(float) + sizeof(wither::Attachment);
  return points.size() * kPoint;
}

std::uint64_t bytesOf(const wither::Texel& texel) {
  return texel.size() * (sizeof(wither::Voxel) + sizeof(glm::u16vec3));
}

/// What a step took, read and wrote.
struct Timed {
  TimeMs time;
  std::uint64_t bytesMoved = 0;
};

/// A copy on one thread that reads and writes `moved` bytes in all.
TimeMs copyTime(int runs, std::uint64_t moved) {
  const std::vector<char> from(moved / 2 + 1, 1);
  std::vector<char> to(from.size());
  return timeRuns(runs, [&] {
    std::memcpy(to.data(), from.data(), from.size());
    *static_cast<volatile char*>(to.data()) = to.back();  // so that the copy is not optimised away
  });
}

/// Blades at one proportion, ready for each of the steps.
struct Prepared {
  const WitherBench* bench = nullptr;
  double proportion = 0.0;
  wither::Points points, moved;
  wither::Texel texel;
  JobContext job;

  static Result<Prepared> create(const WitherBench& bench, double proportion, const JobContext& job) {
    Prepared p;
    p.bench = &bench;
    p.proportion = proportion;
    p.job = job;
    SWARD_ASSIGN(p.points, bench.points(proportion, kSeed, job));
    SWARD_TRY(p.pose());
    SWARD_ASSIGN(p.texel, p.splat());
    return p;
  }
  Result<void> pose() {
    return wither::pose(points, bench->strands().strands, bench->season(), {}, kWeathering, bench->colour(), moved,
                        job);
  }
  Result<wither::Texel> splat() const {
    return wither::pointsToTexel(moved, bench->grid(), wither::TexelOptions{}.splatVoxels, job);
  }
};

/// The steps of some blades.
struct Measured {
  int blades = 0;
  double proportion = 0.0;
  std::size_t points = 0, restVoxels = 0, voxels = 0;
  Timed toPoints, step, toTexel;

  explicit Measured(const Prepared& p)
      : blades(p.bench->blades()),
        proportion(p.proportion),
        points(p.points.size()),
        restVoxels(p.bench->rest().texel.size()),
        voxels(p.texel.size()) {
    toPoints.bytesMoved = bytesOf(p.bench->rest().texel) + bytesOf(p.points);
    step.bytesMoved = 2 * bytesOf(p.points);
    toTexel.bytesMoved = bytesOf(p.moved) + bytesOf(p.texel);
  }
};

/// All blades and half of them in turn, so that the machine's moods and its memory's state hit both alike.
Result<std::pair<Measured, Measured>> measure(Prepared all, Prepared half, int runs) {
  std::pair<Measured, Measured> m{Measured(all), Measured(half)};
  bool ok = true;
  const auto both = [&](Timed Measured::*part, const std::function<bool(Prepared&)>& body) {
    std::tie((m.first.*part).time, (m.second.*part).time) = timePairs(
        runs, [&] { ok = body(all) && ok; }, [&] { ok = body(half) && ok; });
  };
  both(&Measured::toPoints, [](Prepared& p) { return p.bench->points(p.proportion, kSeed, p.job).ok(); });
  both(&Measured::step, [](Prepared& p) { return p.pose().ok(); });
  both(&Measured::toTexel, [](Prepared& p) { return p.splat().ok(); });
  if (!ok || all.job.cancelled()) return Error::cancelled();
  return m;
}

Row rowOf(const Step& step, const Measured& m, const Timed& timed, int resolution) {
  Row row;
  row.method = step.method;
  row.numbersAndNames = {{"blades", std::to_string(m.blades)},
                         {"points", std::to_string(m.points)},
                         {"voxels", std::to_string(&step == &kToPoints ? m.restVoxels : m.voxels)},
                         {"resolution", std::to_string(resolution)},
                         {"proportion", numberText(m.proportion)},
                         {"bytes_moved", std::to_string(timed.bytesMoved)}};
  row.timeMs = timed.time;
  row.rate = static_cast<double>(m.points) / (timed.time.median * 1e-3);
  row.rateUnit = "points";
  row.notes = step.notes;
  return row;
}

/// All blades at each proportion, and half of them.
void addRows(const Step& step, Timed Measured::*part, const std::vector<std::pair<Measured, Measured>>& measured,
             const WitherSpeedSize& size, std::vector<Row>& rows) {
  for (std::size_t i = 0; i < measured.size(); ++i) {
    const Timed &all = measured[i].first.*part, &half = measured[i].second.*part;
    Row row = rowOf(step, measured[i].first, all, size.resolution);
    if (i == 0) {
      row.ratio = step.limitMs / all.time.median;
      row.against = "limit of " + numberText(step.limitMs) + " ms, over the time";
      row.numbersAndNames["over_paper"] = numberText(step.paperMs / all.time.median);
    } else {
      row.ratio = copyTime(size.runs, all.bytesMoved).median / all.time.median;
      row.against = "a copy of the bytes that are read and written, over the time";
    }
    rows.push_back(std::move(row));
    Row fewer = rowOf(step, measured[i].second, half, size.resolution);
    fewer.ratio = all.time.median / half.time.median;
    fewer.against = "all blades, over the time of half of them: the ratio of points is proportional";
    fewer.numbersAndNames["ratio_of_points"] =
        numberText(static_cast<double>(measured[i].first.points) / static_cast<double>(measured[i].second.points));
    rows.push_back(std::move(fewer));
  }
}

Result<Row> keyFrameRow(const WitherBench& bench, double proportion, int runs, const JobContext& job) {
  SWARD_ASSIGN(const wither::Points points, bench.points(proportion, kSeed, job));
  SWARD_ASSIGN(const wither::Texel texel, bench.texel(points, kWeathering, {}, job));
  wither::PackedTexel packed;
  Row row;
  row.method = "wither_key_frame_bytes";
  row.timeMs = timeRuns(runs, [&] { packed = wither::PackedTexel::pack(texel, job); });
  if (job.cancelled()) return Error::cancelled();
  row.bytes = packed.bytes();
  row.numbersAndNames = {{"blades", std::to_string(bench.blades())},
                         {"points", std::to_string(points.size())},
                         {"voxels", std::to_string(texel.size())},
                         {"resolution", std::to_string(bench.grid().columns)},
                         {"proportion", numberText(proportion)},
                         {"unpacked_bytes", std::to_string(texel.bytes())},
                         {"over_paper", numberText(kDensePaperBytes / static_cast<double>(packed.bytes()))}};
  row.ratio = kKeyFrameLimitBytes / static_cast<double>(packed.bytes());
  row.against = "limit of 12 MB, over the bytes";
  row.notes = "the time is that of packing; over_paper is against the paper's dense block of 200 MB";
  return row;
}

Result<Row> mingleRow(const WitherSpeedSize& size, const JobContext& job) {
  std::vector<wither::Texel> texels;
  int blades = 0;
  std::size_t points = 0, voxels = 0;
  for (int i = 0; i < size.samples; ++i) {
    SWARD_ASSIGN(const WitherBench bench,
                 WitherBench::create(size.blades, size.resolution, kSeed + static_cast<std::uint64_t>(i), job));
    SWARD_ASSIGN(const wither::Points sample, bench.points(size.proportions[0], kSeed, job));
    SWARD_ASSIGN(wither::Texel texel, bench.texel(sample, static_cast<double>(i) / size.samples, {}, job));
    blades += bench.blades();
    points += sample.size();
    voxels += texel.size();
    texels.push_back(std::move(texel));
  }
  std::vector<wither::MingleInput> inputs;
  for (const wither::Texel& texel : texels) inputs.push_back({&texel, 1.0});
  SWARD_ASSIGN(const wither::Texel mixed, wither::mingle(inputs, job));
  bool ok = true;
  const std::uint64_t moved = voxels * sizeof(wither::Voxel) + bytesOf(mixed);
  const TimeMs time = timeRuns(size.runs, [&] { ok = wither::mingle(inputs, job).ok() && ok; });
  if (!ok || job.cancelled()) return Error::cancelled();
  Row row;
  row.method = "mingle_" + std::to_string(size.samples);
  row.numbersAndNames = {{"blades", std::to_string(blades)},
                         {"points", std::to_string(points)},
                         {"voxels", std::to_string(mixed.size())},
                         {"resolution", std::to_string(size.resolution)},
                         {"samples", std::to_string(size.samples)},
                         {"bytes_moved", std::to_string(moved)},
                         {"over_copy", numberText(copyTime(size.runs, moved).median / time.median)}};
  row.timeMs = time;
  row.ratio = kMingleLimitMs / time.median;
  row.against = "limit of 150 ms, over the time";
  row.notes = "over_copy: a copy of the bytes that are read and written, over the time";
  return row;
}

}  // namespace

Result<std::vector<Row>> witherSpeedRows(const WitherSpeedSize& size, const JobContext& job) {
  const JobContext quiet{job.stop, {}, job.threads};
  SWARD_ASSIGN(const WitherBench bench, WitherBench::create(size.blades, size.resolution, kSeed, quiet));
  SWARD_ASSIGN(const WitherBench halfBench, WitherBench::create(size.blades / 2, size.resolution, kSeed, quiet));
  std::vector<std::pair<Measured, Measured>> measured;
  for (const double proportion : size.proportions) {
    SWARD_ASSIGN(Prepared all, Prepared::create(bench, proportion, quiet));
    SWARD_ASSIGN(Prepared half, Prepared::create(halfBench, proportion, quiet));
    SWARD_ASSIGN(auto pair, measure(std::move(all), std::move(half), size.runs));
    measured.push_back(std::move(pair));
  }
  std::vector<Row> rows;
  addRows(kToPoints, &Measured::toPoints, measured, size, rows);
  addRows(kStep, &Measured::step, measured, size, rows);
  addRows(kToTexel, &Measured::toTexel, measured, size, rows);
  for (const double proportion : size.proportions) {
    SWARD_ASSIGN(Row row, keyFrameRow(bench, proportion, size.runs, quiet));
    rows.push_back(std::move(row));
  }
  SWARD_ASSIGN(Row mingled, mingleRow(size, quiet));
  rows.push_back(std::move(mingled));
  return rows;
}

}  // namespace sward::report
