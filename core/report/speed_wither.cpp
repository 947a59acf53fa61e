#include "report/speed_wither.h"

#include "report/text.h"
#include "report/wither_bench.h"
#include "wither/mingle.h"
#include "wither/packed_texel.h"
#include "wither/pose.h"

#include <cstring>
#include <functional>
#include <string>
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

/// What a step read and wrote, and how fast a copy of half of that many bytes is.
struct Timed {
  TimeMs time, copy;
  std::uint64_t bytesMoved = 0;
};

/// `body` in turn with a copy that reads and writes `moved` bytes in all.
Timed timed(int runs, std::uint64_t moved, const std::function<void()>& body) {
  const std::vector<char> from(moved / 2 + 1, 1);
  std::vector<char> to(from.size());
  Timed result;
  result.bytesMoved = moved;
  std::tie(result.time, result.copy) = timePairs(runs, body, [&] {
    std::memcpy(to.data(), from.data(), from.size());
    *static_cast<volatile char*>(to.data()) = to.back();  // so that the copy is not optimised away
  });
  return result;
}

/// The three steps at one number of blades and proportion.
struct Measured {
  int blades = 0;
  double proportion = 0.0;
  std::size_t points = 0, restVoxels = 0, voxels = 0;
  Timed toPoints, step, toTexel;
};

Result<Measured> measure(const WitherBench& bench, double proportion, int runs, const JobContext& job) {
  Measured m;
  m.blades = bench.blades();
  m.proportion = proportion;
  SWARD_ASSIGN(wither::Points points, bench.points(proportion, kSeed, job));
  wither::Points moved;
  const auto pose = [&] {
    return wither::pose(points, bench.strands().strands, bench.season(), {}, kWeathering, bench.colour(), moved, job);
  };
  SWARD_TRY(pose());
  const auto splat = [&] {
    return wither::pointsToTexel(moved, bench.grid(), wither::TexelOptions{}.splatVoxels, job);
  };
  SWARD_ASSIGN(const wither::Texel texel, splat());
  m.points = points.size();
  m.restVoxels = bench.rest().texel.size();
  m.voxels = texel.size();
  bool ok = true;
  m.toPoints = timed(runs, bytesOf(bench.rest().texel) + bytesOf(points),
                     [&] { ok = bench.points(proportion, kSeed, job).ok() && ok; });
  m.step = timed(runs, 2 * bytesOf(points), [&] { ok = pose().ok() && ok; });
  m.toTexel = timed(runs, bytesOf(moved) + bytesOf(texel), [&] { ok = splat().ok() && ok; });
  if (!ok || job.cancelled()) return Error::cancelled();
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

/// All blades at both proportions, then half of them.
void addRows(const Step& step, Timed Measured::*part, const std::vector<Measured>& all,
             const std::vector<Measured>& half, int resolution, std::vector<Row>& rows) {
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Timed& timed = all[i].*part;
    Row row = rowOf(step, all[i], timed, resolution);
    if (i == 0) {
      row.ratio = step.limitMs / timed.time.median;
      row.against = "limit of " + numberText(step.limitMs) + " ms, over the time";
      row.numbersAndNames["over_paper"] = numberText(step.paperMs / timed.time.median);
    } else {
      row.ratio = timed.copy.median / timed.time.median;
      row.against = "a copy of the bytes that are read and written, over the time";
    }
    rows.push_back(std::move(row));
    Row fewer = rowOf(step, half[i], half[i].*part, resolution);
    fewer.ratio = timed.time.median / (half[i].*part).time.median;
    fewer.against = "all blades, over the time of half of them: 2 is proportional";
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
  const Timed time = timed(size.runs, voxels * sizeof(wither::Voxel) + bytesOf(mixed),
                           [&] { ok = wither::mingle(inputs, job).ok() && ok; });
  if (!ok || job.cancelled()) return Error::cancelled();
  Row row;
  row.method = "mingle_" + std::to_string(size.samples);
  row.numbersAndNames = {{"blades", std::to_string(blades)},
                         {"points", std::to_string(points)},
                         {"voxels", std::to_string(mixed.size())},
                         {"resolution", std::to_string(size.resolution)},
                         {"samples", std::to_string(size.samples)},
                         {"bytes_moved", std::to_string(time.bytesMoved)},
                         {"over_copy", numberText(time.copy.median / time.time.median)}};
  row.timeMs = time.time;
  row.ratio = kMingleLimitMs / time.time.median;
  row.against = "limit of 150 ms, over the time";
  row.notes = "over_copy: a copy of the bytes that are read and written, over the time";
  return row;
}

}  // namespace

Result<std::vector<Row>> witherSpeedRows(const WitherSpeedSize& size, const JobContext& job) {
  const JobContext quiet{job.stop, {}, job.threads};
  SWARD_ASSIGN(const WitherBench bench, WitherBench::create(size.blades, size.resolution, kSeed, quiet));
  SWARD_ASSIGN(const WitherBench halfBench, WitherBench::create(size.blades / 2, size.resolution, kSeed, quiet));
  std::vector<Measured> all, half;
  for (const double proportion : size.proportions) {
    SWARD_ASSIGN(Measured whole, measure(bench, proportion, size.runs, quiet));
    all.push_back(std::move(whole));
    SWARD_ASSIGN(Measured fewer, measure(halfBench, proportion, size.runs, quiet));
    half.push_back(std::move(fewer));
  }
  std::vector<Row> rows;
  addRows(kToPoints, &Measured::toPoints, all, half, size.resolution, rows);
  addRows(kStep, &Measured::step, all, half, size.resolution, rows);
  addRows(kToTexel, &Measured::toTexel, all, half, size.resolution, rows);
  for (const double proportion : size.proportions) {
    SWARD_ASSIGN(Row row, keyFrameRow(bench, proportion, size.runs, quiet));
    rows.push_back(std::move(row));
  }
  SWARD_ASSIGN(Row mingled, mingleRow(size, quiet));
  rows.push_back(std::move(mingled));
  return rows;
}

}  // namespace sward::report
