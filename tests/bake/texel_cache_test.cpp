#include "bake/texel_payload.h"

#include "bake/bake.h"
#include "bake/payload.h"
#include "bake/small_project.h"
#include "bake/temporary_folder.h"
#include "base/file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <string>
#include <vector>

namespace sward::bake {
namespace {

namespace fs = std::filesystem;
using State = NodeReport::State;

project::Project texelProject(double weathering) {
  project::Project project = test::smallProject();
  project.render.method = render::GroundMethod::Texels;
  project.wither.texel.resolution = 32;
  project.wither.weathering = weathering;
  wither::MingleSample late, early;
  late.share = 0.4;
  late.ageing = base::Curve::fromPoints({{0.0, 0.0}, {1.0, 0.6}}).value();
  early.density = 0.8;
  project.wither.mingle = {late, early};
  return project;
}

/// Grounds through a cache in a folder, by a baker that knows nothing of earlier ones.
class TexelCache : public testing::Test {
 protected:
  TexelCache() : m_folder("texel-cache") {}
  fs::path folder() const { return m_folder.path(); }
  std::shared_ptr<const GroundBake> bake(const project::Project& project, bool storeTexels = true) {
    Baker::Options options;
    options.storeTexels = storeTexels;
    Baker baker(DiskCache::open(folder()).value(), options);
    auto ground = baker.ground(project, {}, &m_report);
    EXPECT_TRUE(ground.ok()) << ground.error().text();
    return *ground;
  }
  State rest() const { return m_report.nodes.at(0).state; }
  State texels() const { return m_report.nodes.at(1).state; }
  const BakeReport& report() const { return m_report; }

  std::vector<fs::path> entries(const char* kind) const {
    std::vector<fs::path> files;
    if (!fs::exists(folder() / kind)) return files;
    for (const auto& item : fs::recursive_directory_iterator(folder() / kind)) {
      if (item.is_regular_file()) files.push_back(item.path());
    }
    return files;
  }

 private:
  sward::test::TemporaryFolder m_folder;
  BakeReport m_report;
};

template <typename T>
bool sameBytes(std::span<const T> a, std::span<const T> b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size_bytes()) == 0);
}
template <typename T>
bool sameBytes(const std::vector<T>& a, const std::vector<T>& b) {
  return sameBytes(std::span<const T>(a), std::span<const T>(b));
}

void expectEqual(const TexelBake& a, const TexelBake& b) {
  EXPECT_EQ(a.weathering, b.weathering);
  EXPECT_TRUE(sameBytes(a.soil, b.soil));
  ASSERT_EQ(a.levels.size(), b.levels.size());
  for (std::size_t i = 0; i < a.levels.size(); ++i) {
    const wither::Texel &x = *a.levels[i].texel, &y = *b.levels[i].texel;
    EXPECT_EQ(x.grid(), y.grid());
    EXPECT_TRUE(sameBytes(x.voxels(), y.voxels())) << i;
    EXPECT_TRUE(sameBytes(x.places(), y.places())) << i;
    EXPECT_TRUE(sameBytes(a.levels[i].sky.front, b.levels[i].sky.front)) << i;
    EXPECT_TRUE(sameBytes(a.levels[i].sky.back, b.levels[i].sky.back)) << i;
    EXPECT_TRUE(sameBytes(a.levels[i].sky.ground, b.levels[i].sky.ground)) << i;
  }
}

TEST_F(TexelCache, WarmIsColdToTheLastBit) {
  const project::Project project = texelProject(0.45);
  const auto cold = bake(project);
  EXPECT_EQ(rest(), State::Baked);
  EXPECT_EQ(texels(), State::Baked);
  EXPECT_GT(report().nodes[0].bytes, 0u);
  const std::uint64_t stored = report().nodes[1].bytes;
  const auto warm = bake(project);
  EXPECT_EQ(rest(), State::Skipped);
  EXPECT_EQ(texels(), State::FromDisk);
  EXPECT_EQ(report().nodes[1].bytes, stored);
  expectEqual(*cold->texels, *warm->texels);
  // Nor does it matter that there is no cache at all.
  Baker none;
  expectEqual(*cold->texels, *none.ground(project, {}).value()->texels);
}

TEST_F(TexelCache, AnotherMomentIsAgedFromTheStoredRest) {
  bake(texelProject(0.0));
  const auto aged = bake(texelProject(0.7));
  EXPECT_EQ(rest(), State::FromDisk);
  EXPECT_EQ(texels(), State::Baked);
  Baker fresh;
  expectEqual(*aged->texels, *fresh.ground(texelProject(0.7), {}).value()->texels);
  // Other shares are other blades in the samples; another proportion is other points.
  project::Project other = texelProject(0.7);
  other.wither.mingle[0].share = 0.5;
  bake(other);
  EXPECT_EQ(rest(), State::Baked);
  other = texelProject(0.7);
  other.wither.texel.proportion = 4.0;
  bake(other);
  EXPECT_EQ(rest(), State::Baked);
  // How dense a sample is, how it ages and how blades fall is no part of the rest.
  other = texelProject(0.7);
  other.wither.mingle[1].density = 0.5;
  other.wither.body.droopDeg = 60.0;
  bake(other);
  EXPECT_EQ(rest(), State::FromDisk);
  EXPECT_EQ(texels(), State::Baked);
}

TEST_F(TexelCache, FinishedTexelsAreLeftOutWhereTheyAreAskedForOnce) {
  const auto first = bake(texelProject(0.3), false);
  EXPECT_TRUE(entries("texels").empty());
  EXPECT_EQ(entries("rest").size(), 1u);
  const auto stored = bake(texelProject(0.3));
  expectEqual(*first->texels, *stored->texels);
  EXPECT_EQ(entries("texels").size(), 1u);
  bake(texelProject(0.3), false);
  EXPECT_EQ(texels(), State::FromDisk);  // what is there is read all the same
}

TEST_F(TexelCache, CoarseTexelsAreNotKept) {
  Baker baker(DiskCache::open(folder()).value());
  const project::Project project = texelProject(0.3);
  ASSERT_TRUE(baker.ground({project, Quality::Coarse, {}}, {}).ok());
  EXPECT_TRUE(entries("texels").empty());
  EXPECT_TRUE(entries("rest").empty());
}

TEST_F(TexelCache, DamagedEntriesAreMadeAnew) {
  const project::Project project = texelProject(0.45);
  const auto cold = bake(project);
  for (const char* kind : {"texels", "rest"}) {
    for (const fs::path& file : entries(kind)) {
      auto bytes = base::readFile(file).value();
      bytes[bytes.size() / 2] ^= std::byte{16};
      ASSERT_TRUE(base::writeFileAtomically(file, bytes).ok());
    }
  }
  expectEqual(*cold->texels, *bake(project)->texels);
  EXPECT_EQ(rest(), State::Baked);
  EXPECT_EQ(texels(), State::Baked);
  bake(project);
  EXPECT_EQ(texels(), State::FromDisk);
}

TEST_F(TexelCache, EntriesThatAreWholeButWrongAreMadeAnew) {
  const project::Project project = texelProject(0.45);
  const auto cold = bake(project);
  const std::string key = entries("texels").front().stem().string();
  base::Hash128 hash;
  hash.high = std::stoull(key.substr(0, 16), nullptr, 16);
  hash.low = std::stoull(key.substr(16), nullptr, 16);
  auto disk = DiskCache::open(folder()).value();
  ASSERT_EQ(hash.hex(), key);
  const std::vector<std::byte> payload = disk.get("texels", hash).value();
  for (const std::size_t cut : {std::size_t{0}, std::size_t{9}, payload.size() / 2, payload.size() - 1}) {
    ASSERT_TRUE(disk.put("texels", hash, std::span(payload).first(cut)).ok());
    expectEqual(*cold->texels, *bake(project)->texels);
    EXPECT_EQ(texels(), State::Baked) << cut;
  }
}

TEST_F(TexelCache, NoCutPayloadIsTakenAndNoByteReadBeyondIt) {
  bake(texelProject(0.45));
  auto disk = DiskCache::open(folder()).value();
  const auto keyOf = [](const fs::path& file) {
    const std::string name = file.stem().string();
    return base::Hash128{std::stoull(name.substr(0, 16), nullptr, 16), std::stoull(name.substr(16), nullptr, 16)};
  };
  const auto rest = disk.get("rest", keyOf(entries("rest").front())).value();
  const auto texels = disk.get("texels", keyOf(entries("texels").front())).value();
  for (std::size_t i = 0; i < 60; ++i) {
    EXPECT_FALSE(fromPayload<TexelRest>(std::span(rest).first(rest.size() * i / 60)).has_value());
    EXPECT_FALSE(fromPayload<TexelBake>(std::span(texels).first(texels.size() * i / 60)).has_value());
  }
  ASSERT_TRUE(fromPayload<TexelRest>(rest).has_value());
  TexelRest wrong = *fromPayload<TexelRest>(rest);
  wrong.attachments.front().strand = static_cast<std::int32_t>(wrong.strands.size());
  EXPECT_FALSE(fromPayload<TexelRest>(payloadOf(wrong)).has_value());
  wrong = *fromPayload<TexelRest>(rest);
  wrong.strands.front().vein.resize(1);
  EXPECT_FALSE(fromPayload<TexelRest>(payloadOf(wrong)).has_value());
}

TEST_F(TexelCache, SkylightIsKeptToAStepOf65535) {
  const auto made = bake(texelProject(0.2));
  auto again = fromPayload<TexelBake>(payloadOf(*made->texels));
  ASSERT_TRUE(again.has_value());
  for (std::size_t level = 0; level < again->levels.size(); ++level) {
    const std::vector<float>&a = made->texels->levels[level].sky.front, &b = again->levels[level].sky.front;
    ASSERT_EQ(a.size(), b.size());
    // Shares are at most 1: half a step of the largest, and the rounding of a float.
    for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], 0.5 / 65535.0 + 1e-7);
  }
}

TEST_F(TexelCache, ABarePatchIsKeptToo) {
  project::Project bare = texelProject(0.5);
  bare.patch.plants.clear();
  const auto cold = bake(bare), warm = bake(bare);
  EXPECT_EQ(texels(), State::FromDisk);
  expectEqual(*cold->texels, *warm->texels);
}

}  // namespace
}  // namespace sward::bake
