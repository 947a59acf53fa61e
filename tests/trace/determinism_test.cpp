#include "base/hash.h"
#include "trace/layers.h"

#include "trace/test_patches.h"

#include <cmath>
#include <span>

#include <gtest/gtest.h>

namespace sward::trace {
namespace {

using testing::sceneOf;
using testing::smallMeadow;

SamplingOptions meadowOptions() {
  SamplingOptions options = testing::smallOptions();
  options.sliceResolution = 48;
  options.slices = 6;
  options.bladeWidth = 70;  // no multiple of a tile, a packet or a band
  options.bladeHeight = 37;
  return options;
}

/// Everything that a set's sampling saves.
std::vector<std::byte> bytesOf(const PatchScene& scene, LayerSet set, const SamplingOptions& options, int threads) {
  JobContext job;
  job.threads = threads;
  base::ByteWriter out;
  const auto hits = sampleHits(scene, set, options, job);
  save(out, *hits);
  for (const glm::dvec3 light : {glm::dvec3(0.0, 0.6, 0.8), glm::dvec3(-0.96, 0.0, 0.28)}) {
    save(out, *sampleLuminance(scene, *hits, light, job));
  }
  save(out, *sampleVisibility(scene, *hits, options, job));
  return out.take();
}

TEST(Determinism, TheSameBytesOnAnyNumberOfThreadsAndInAnyScene) {
  const auto patch = smallMeadow();
  const auto scene = sceneOf(patch), again = sceneOf(patch);
  for (const LayerSet set : kAllLayerSets) {
    const std::vector<std::byte> one = bytesOf(*scene, set, meadowOptions(), 1);
    EXPECT_TRUE(one == bytesOf(*scene, set, meadowOptions(), 2)) << layerSetName(set);
    EXPECT_TRUE(one == bytesOf(*again, set, meadowOptions(), 5)) << layerSetName(set);
  }
}

TEST(Determinism, AnotherSeedGivesOtherSamples) {
  const auto scene = sceneOf(smallMeadow());
  SamplingOptions other = meadowOptions();
  other.seed = 2;
  EXPECT_FALSE(bytesOf(*scene, LayerSet::Slices, meadowOptions(), 2) == bytesOf(*scene, LayerSet::Slices, other, 2));
}

TEST(Ranges, EveryTermOfAMeadowIsFiniteAndInItsRange) {
  const auto scene = sceneOf(smallMeadow());
  for (const LayerSet set : kAllLayerSets) {
    const LayerHits hits = testing::hitsOf(*scene, set, meadowOptions());
    ASSERT_GT(hits.texels(), 100u) << layerSetName(set);
    for (const Hit& hit : hits.hits) {
      for (int axis = 0; axis < 2; ++axis) EXPECT_TRUE(hit.position[axis] >= 0.0f && hit.position[axis] <= 1.0f);
      EXPECT_LE(int{hit.barycentric[0]} + int{hit.barycentric[1]}, 65535);
    }
    double reflected = 0.0, transmitted = 0.0;
    const LayerLuminance light = testing::lightOn(*scene, hits, {0.3, 0.5, 0.6});
    for (std::size_t t = 0; t < hits.texels(); ++t) {
      ASSERT_TRUE(light.reflected[t] >= 0.0f && light.reflected[t] <= 1.0f);
      ASSERT_TRUE(light.transmitted[t] >= 0.0f && light.transmitted[t] <= 1.0f);
      reflected += static_cast<double>(light.reflected[t]);
      transmitted += static_cast<double>(light.transmitted[t]);
    }
    EXPECT_GT(reflected, 0.0);
    EXPECT_EQ(transmitted > 0.0, set != LayerSet::Ground);
    const auto visibility = sampleVisibility(*scene, hits, meadowOptions(), {});
    ASSERT_TRUE(visibility.ok());
    for (std::size_t t = 0; t < hits.texels(); ++t) {
      for (const float x : {visibility->visibility[t], visibility->skyReflected[t], visibility->skyTransmitted[t]}) {
        ASSERT_TRUE(x >= 0.0f && x <= 1.0f);
      }
    }
  }
}

TEST(Slabs, EveryHitLiesInItsOwn) {
  const auto patch = smallMeadow();
  const auto scene = sceneOf(patch);
  const auto height = static_cast<float>(patch->heightM);
  for (const LayerSet set : kAllLayerSets) {
    if (set == LayerSet::Ground) continue;
    const LayerHits hits = testing::hitsOf(*scene, set, meadowOptions());
    const auto layers = static_cast<float>(hits.shape.layers);
    for (std::size_t t = 0; t < hits.texels(); ++t) {
      for (std::uint32_t h = hits.hitStart[t]; h < hits.hitStart[t + 1]; ++h) {
        const glm::vec3 p = hits.hits[h].position;
        const float depth = set == LayerSet::Slices       ? 1.0f - p.z / height
                            : set == LayerSet::BladesPosX ? 1.0f - p.x
                            : set == LayerSet::BladesNegX ? p.x
                            : set == LayerSet::BladesPosY ? 1.0f - p.y
                                                          : p.y;
        EXPECT_GE(depth * layers, static_cast<float>(hits.layer[t]) - 1e-4f);
        EXPECT_LE(depth * layers, static_cast<float>(hits.layer[t]) + 1.0f + 1e-4f);
      }
    }
  }
}

TEST(Cancellation, EndsEveryStepPromptly) {
  const auto scene = sceneOf(smallMeadow());
  SamplingOptions options = meadowOptions();
  options.sliceResolution = 1024;
  options.slices = 64;
  const LayerHits hits = testing::hitsOf(*scene, LayerSet::Slices, meadowOptions());
  std::stop_source stop;
  JobContext job;
  job.stop = stop.get_token();
  // Cancelled from the first progress report on.
  job.onProgress = [&](const std::string&, double) { stop.request_stop(); };
  const auto cut = sampleHits(*scene, LayerSet::Slices, options, job);
  ASSERT_FALSE(cut.ok());
  EXPECT_EQ(cut.error().kind, ErrorKind::Cancelled);
  EXPECT_EQ(sampleLuminance(*scene, hits, {0.0, 0.0, 1.0}, job).error().kind, ErrorKind::Cancelled);
  EXPECT_EQ(sampleVisibility(*scene, hits, options, job).error().kind, ErrorKind::Cancelled);
  EXPECT_EQ(shadeSurface(hits, scene->patch(), {}, job).error().kind, ErrorKind::Cancelled);
}

TEST(Progress, RisesToOne) {
  const auto scene = sceneOf(smallMeadow());
  JobContext job;
  double last = 0.0;
  job.onProgress = [&](const std::string& stage, double fraction) {
    EXPECT_FALSE(stage.empty());
    EXPECT_LE(fraction, 1.0);
    last = std::max(last, fraction);
  };
  ASSERT_TRUE(sampleHits(*scene, LayerSet::BladesPosY, meadowOptions(), job).ok());
  EXPECT_DOUBLE_EQ(last, 1.0);
}

/// Loads `bytes` cut to `size`.
template <typename T>
bool loads(const std::vector<std::byte>& bytes, std::size_t size, T& value) {
  base::ByteReader in(std::span<const std::byte>(bytes).first(size));
  return load(in, value) && in.finished();
}

TEST(Payloads, RoundTrip) {
  const auto scene = sceneOf(smallMeadow());
  const LayerHits hits = testing::hitsOf(*scene, LayerSet::BladesNegY, meadowOptions());
  base::ByteWriter out;
  save(out, hits);
  const std::vector<std::byte> bytes = out.take();
  LayerHits back;
  ASSERT_TRUE(loads(bytes, bytes.size(), back));
  EXPECT_EQ(back.set, hits.set);
  EXPECT_EQ(back.shape, hits.shape);
  EXPECT_EQ(back.columnStart, hits.columnStart);
  EXPECT_EQ(back.layer, hits.layer);
  base::ByteWriter second;
  save(second, back);
  EXPECT_TRUE(second.take() == bytes);

  const LayerLuminance light = testing::lightOn(*scene, hits, {0.1, 0.2, 1.0});
  base::ByteWriter lightOut;
  save(lightOut, light);
  const std::vector<std::byte> lightBytes = lightOut.take();
  LayerLuminance lightBack;
  ASSERT_TRUE(loads(lightBytes, lightBytes.size(), lightBack));
  ASSERT_EQ(lightBack.reflected.size(), light.reflected.size());
  for (std::size_t t = 0; t < light.reflected.size(); ++t) {
    EXPECT_NEAR(lightBack.reflected[t], light.reflected[t], 0.51f / 65535.0f);
    EXPECT_NEAR(lightBack.transmitted[t], light.transmitted[t], 0.51f / 65535.0f);
  }
}

TEST(Payloads, TruncatedOnesAreRefusedAndLeaveNothing) {
  const auto scene =
      sceneOf(testing::patchOf(testing::quad({0.2f, 0.2f, 0.5f}, {0.4f, 0.0f, 0.1f}, {0.0f, 0.4f, 0.0f}), 1.0, 1.0));
  const LayerHits hits = testing::hitsOf(*scene, LayerSet::Slices, testing::smallOptions());
  base::ByteWriter hitsOut, lightOut, visibilityOut;
  save(hitsOut, hits);
  save(lightOut, testing::lightOn(*scene, hits, {0.1, 0.2, 1.0}));
  save(visibilityOut, *sampleVisibility(*scene, hits, testing::smallOptions(), {}));
  const auto everyLength = [](const std::vector<std::byte>& bytes, auto value) {
    ASSERT_TRUE(loads(bytes, bytes.size(), value));
    for (std::size_t size = 0; size < bytes.size(); ++size) ASSERT_FALSE(loads(bytes, size, value)) << size;
  };
  everyLength(hitsOut.take(), LayerHits{});
  everyLength(lightOut.take(), LayerLuminance{});
  everyLength(visibilityOut.take(), LayerVisibility{});
}

TEST(Payloads, InconsistentHitsAreRefused) {
  const auto scene = sceneOf(smallMeadow());
  const LayerHits good = testing::hitsOf(*scene, LayerSet::Slices, testing::smallOptions());
  const auto refused = [&](auto damage) {
    LayerHits bad = good;
    damage(bad);
    base::ByteWriter out;
    save(out, bad);
    const std::vector<std::byte> bytes = out.take();
    LayerHits back;
    return !loads(bytes, bytes.size(), back) && back.hits.empty();
  };
  EXPECT_FALSE(refused([](LayerHits&) {}));
  EXPECT_TRUE(refused([](LayerHits& h) { h.shape.width = -1; }));
  EXPECT_TRUE(refused([](LayerHits& h) { h.shape.layers = 1; }));
  EXPECT_TRUE(refused([](LayerHits& h) { h.set = static_cast<LayerSet>(9); }));
  EXPECT_TRUE(refused([](LayerHits& h) { h.columnStart[3] = 1'000'000; }));
  EXPECT_TRUE(refused([](LayerHits& h) { h.hitStart[2] = h.hitStart[1]; }));
  EXPECT_TRUE(refused([](LayerHits& h) { h.subSamples = 1; }));
  EXPECT_TRUE(refused([](LayerHits& h) { h.hits[0].position.y = NAN; }));
}

}  // namespace
}  // namespace sward::trace
