#include "report/speed_sampling.h"

#include "base/parallel.h"
#include "scene/lights.h"
#include "trace/layers.h"
#include "trace/patch_scene_impl.h"

#include <algorithm>
#include <cstdio>

namespace sward::report {
namespace {

constexpr int kRuns = 7;
constexpr double kMaxRays = 128.0 * 128.0 * 16.0 * 4.0;  ///< of nearest hits; some 80 MB of packets

/// A sun of middle height.
glm::dvec3 testLight() {
  return scene::directionFromAngles({225.0, 35.0});
}

trace::SamplingOptions limited(trace::SamplingOptions options) {
  const double perColumn = 1.0 * options.slices * options.sliceSubSamples;
  while (options.sliceResolution > 16 && perColumn * options.sliceResolution * options.sliceResolution > kMaxRays) {
    options.sliceResolution /= 2;
  }
  return options;
}

Result<void> sampleAndLight(const trace::PatchScene& scene, const trace::SamplingOptions& options,
                            const JobContext& job) {
  SWARD_ASSIGN(const trace::LayerHits hits, trace::sampleHits(scene, trace::LayerSet::Slices, options, job));
  SWARD_ASSIGN(const trace::LayerLuminance light, trace::sampleLuminance(scene, hits, testLight(), job));
  return {};
}

/// The packets of one sampling, in the order of a single thread.
Result<void> recordRays(const trace::PatchScene& scene, const trace::SamplingOptions& options, JobContext job,
                        trace::RayRecord& record) {
  job.threads = 1;
  job.onProgress = nullptr;
  scene.impl().record = &record;
  Result<void> result = sampleAndLight(scene, options, job);
  scene.impl().record = nullptr;
  return result;
}

/// Hands every packet to Embree again and does nothing else; a copy each, since Embree writes its answer into it.
void traceBare(RTCScene top, const trace::RayRecord& record, const JobContext& job) {
  alignas(64) int valid[16];
  std::fill(std::begin(valid), std::end(valid), -1);
  constexpr std::size_t kGrain = 1024;
  base::parallelFor(job, record.nearest.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    RTCIntersectContext context = trace::packetContext(RTC_INTERSECT_CONTEXT_FLAG_COHERENT);
    for (std::size_t i = begin; i < end; ++i) {
      RTCRayHit16 packet = record.nearest[i];
      rtcIntersect16(valid, top, &context, &packet);
    }
  });
  base::parallelFor(job, record.occlusion.size(), kGrain, [&](std::size_t begin, std::size_t end) {
    RTCIntersectContext context = trace::packetContext(RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT);
    for (std::size_t i = begin; i < end; ++i) {
      RTCRay16 packet = record.occlusion[i];
      rtcOccluded16(valid, top, &context, &packet);
    }
  });
}

std::string describe(const trace::RayCounts& rays, double bareRate) {
  char text[160];
  std::snprintf(text, sizeof(text), "%llu nearest and %llu occlusion rays; the bare loop traces %.2f million a second",
                static_cast<unsigned long long>(rays.nearest), static_cast<unsigned long long>(rays.occlusion),
                bareRate * 1e-6);
  return text;
}

}  // namespace

Result<Row> layerSamplingRow(const trace::PatchScene& scene, const trace::SamplingOptions& options,
                             const JobContext& job) {
  const trace::SamplingOptions sampled = limited(options);
  trace::RayRecord record;
  const trace::RayCounts before = scene.rayCounts();
  SWARD_TRY(recordRays(scene, sampled, job, record));
  const trace::RayCounts after = scene.rayCounts();
  const trace::RayCounts rays{after.nearest - before.nearest, after.occlusion - before.occlusion};
  const auto total = static_cast<double>(rays.nearest + rays.occlusion);
  if (total <= 0.0) {
    return Error::badInput("the patch has nothing to trace", "report section speed", "Give the patch some plants.");
  }
  JobContext quiet = job;
  quiet.onProgress = nullptr;
  bool ok = true;
  const auto [ours, bare] = timePairs(
      kRuns, [&] { ok = sampleAndLight(scene, sampled, quiet).ok() && ok; },
      [&] { traceBare(scene.impl().top.get(), record, quiet); });
  if (!ok || job.cancelled()) return Error::cancelled();
  Row row;
  row.method = "layer_sampling";
  row.numbersAndNames["resolution"] = std::to_string(sampled.sliceResolution);
  row.numbersAndNames["slices"] = std::to_string(sampled.slices);
  row.numbersAndNames["sub_samples"] = std::to_string(sampled.sliceSubSamples);
  row.numbersAndNames["threads"] = std::to_string(base::threadCount(job));
  row.timeMs = ours;
  row.rate = total / (ours.median * 1e-3);
  row.rateUnit = "rays";
  row.ratio = bare.median / ours.median;
  row.against = "bare Embree loop over the same packets";
  row.notes = describe(rays, total / (bare.median * 1e-3));
  return row;
}

}  // namespace sward::report
