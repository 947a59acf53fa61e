// From meshes to withered texels, against the withered meshes themselves.

#include "wither/cones.h"
#include "wither/key_frames.h"
#include "wither/pose.h"
#include "wither/voxelise.h"
#include "wither/withered_model.h"

#include "mesh/gltf_read.h"
#include "mesh/procedural.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <memory>

namespace sward::wither {
namespace {

namespace fs = std::filesystem;

void toStraw(glm::vec3& diffuse, glm::vec3& transmitted, const Season::Shares& shares) {
  diffuse = glm::mix(glm::vec3(0.5f, 0.4f, 0.2f), diffuse, static_cast<float>(shares.chlorophyll));
  transmitted = glm::mix(glm::vec3(0.2f, 0.15f, 0.05f), transmitted, static_cast<float>(shares.chlorophyll));
}

struct Sward {
  scene::Patch patch;
  TexelGrid grid;
  PatchStrands strands;
  VoxelisedPatch rest;
  Points points;
  Season season = Season::create({}, {}).value();

  Sward(scene::Patch given, int resolution)
      : patch(std::move(given)),
        grid{resolution, resolution, patch.sideM, patch.heightM},
        strands(strandsOf(patch, WitherOptions{}, 1).value()),
        rest(voxelise(patch, grid, &strands, {}).value()),
        points(texelToPoints(rest.texel, rest.attachments, strands.strands, 6.0, 1, {}).value()) {}

  Points moved(double weathering) const {
    Points result;
    EXPECT_TRUE(pose(points, strands.strands, season, {}, weathering, toStraw, result, {}).ok());
    return result;
  }
  Texel texel(double weathering) const { return pointsToTexel(moved(weathering), grid, 0.6, {}).value(); }
  /// The bent meshes, voxelised.
  Texel truth(double weathering) const {
    const scene::Patch bent = withered(patch, strands, season, {}, weathering, toStraw).value();
    return voxelise(bent, grid, nullptr, {}).value().texel;
  }
};

Sward meadow() {
  std::vector<std::shared_ptr<const mesh::Model>> models;
  for (std::uint64_t seed = 0; seed < 3; ++seed) {
    models.push_back(std::make_shared<mesh::Model>(mesh::growGrass({}, seed)));
  }
  scene::PlantScatter plants;
  plants.count = 40;
  plants.models = {0, 1, 2};
  return Sward(scene::scatter(1.0, models, {plants}, 3), 64);
}

/// What a texel's area stands at: its mean place, and its colour.
struct Mean {
  double height = 0.0;
  glm::dvec3 diffuse{0.0};
  explicit Mean(const Texel& texel) {
    double weights = 0.0;
    for (std::size_t i = 0; i < texel.size(); ++i) {
      const Voxel& voxel = texel.voxels()[i];
      const auto weight = static_cast<double>(voxel.density);
      height += weight * (texel.places()[i].z + 0.5) * texel.grid().voxelM().z;
      diffuse += weight * glm::dvec3(voxel.diffuse);
      weights += weight;
    }
    height /= weights;
    diffuse /= weights;
  }
};

TEST(Chain, TexelsWitherAsTheMeshesDo) {
  const Sward sward = meadow();
  for (const double degree : {0.0, 0.4, 0.7, 1.0}) {
    const Texel texel = sward.texel(degree), truth = sward.truth(degree);
    // Areas shrink by the blade's strains in both; a mesh's bent blade is cut by the ground, and its triangles' areas
    // follow the chords of its segments: 1 %.
    EXPECT_NEAR(texel.areaM2() / truth.areaM2(), 1.0, degree > 0.0 ? 0.01 : 1e-5) << degree;
    const Mean mean(texel), exact(truth);
    // A voxel is 12 mm high. Points are random within theirs, 10,000 of them: what is left is how blades that cross
    // share a voxel's attachment.
    EXPECT_NEAR(mean.height, exact.height, 0.5 * sward.grid.voxelM().z) << degree;
    EXPECT_LT(glm::length(mean.diffuse - exact.diffuse), 0.02) << degree;
    EXPECT_LT(lookDifference(texel, truth).value(), 0.2) << degree;
  }
}

TEST(Chain, OursIsNearerToTheMeshesThanThePapersMotion) {
  const Sward sward = meadow();
  Points paper;
  ASSERT_TRUE(paperPose(sward.points, sward.strands.strands, sward.season, {}, 1.0, paper, {}).ok());
  const Texel truth = sward.truth(1.0);
  const double ours = lookDifference(sward.texel(1.0), truth).value();
  const double theirs = lookDifference(pointsToTexel(paper, sward.grid, 0.6, {}).value(), truth).value();
  EXPECT_LT(ours, 0.5 * theirs);
}

TEST(Chain, KeyFramesOfAMeadow) {
  const Sward sward = meadow();
  const TexelAt texelAt = [&](double degree) -> Result<Texel> { return sward.texel(degree); };
  const KeyFrames frames = chooseKeyFrames(texelAt, {0.05, 17, 1.0 / 64}, {}).value();
  EXPECT_LE(frames.error, 0.05);
  EXPECT_LE(frames.frames.size(), 17u);
}

TEST(Chain, ConesOfThePaper) {
  ConeOptions options;
  options.count = 40;
  const Sward sward(growCones(options, 1), 64);
  EXPECT_EQ(sward.strands.strands.size(), 40u);
  for (const double degree : {0.0, 0.5, 1.0}) {
    const Points points = sward.moved(degree);
    for (const glm::vec3& p : points.positions) {
      ASSERT_TRUE(std::isfinite(p.x));
      EXPECT_GE(p.z, 0.0f);
    }
    EXPECT_NEAR(sward.texel(degree).areaM2() / points.totalAreaM2(), 1.0, 1e-5);
  }
}

/// Any mesh at all: every vertex that is used hangs somewhere, and withers to something finite above the ground.
TEST(Chain, AssetsWither) {
  const fs::path folder = fs::path(SWARD_SHARED_DIR) / "assets";
  if (!fs::exists(folder)) GTEST_SKIP() << "no shared assets";
  const Season season = Season::create({}, {}).value();
  int read = 0;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const std::string extension = entry.path().extension().string();
    if (extension != ".glb" && extension != ".gltf") continue;
    const Result<mesh::Model> model = mesh::readGltf(entry.path().string());
    if (!model.ok() || model->empty()) continue;
    ++read;
    const Strands strands = strandsOf(*model, AgeingOptions{}, BodyOptions{}, 1).value();
    ASSERT_FALSE(strands.strands.empty()) << entry.path();
    for (const glm::uvec3& triangle : model->triangles) {
      ASSERT_GE(strands.attachments[triangle.x].strand, 0) << entry.path();
    }
    const float lowest = std::min(mesh::bounds(*model).low.z, 0.0f);
    const mesh::Model dry = withered(*model, strands, season, {}, 1.0, toStraw).value();
    for (std::size_t i = 0; i < dry.positions.size(); ++i) {
      ASSERT_TRUE(std::isfinite(dry.positions[i].x) && std::isfinite(dry.normals[i].x)) << entry.path();
      ASSERT_TRUE(dry.positions[i].z >= lowest) << entry.path();
    }
    EXPECT_EQ(withered(*model, strands, season, {}, 0.0, toStraw)->positions, model->positions);
  }
  if (read == 0) GTEST_SKIP() << "no mesh among the shared assets";
}

}  // namespace
}  // namespace sward::wither
