// The reference sees the ground that its plan lays, without cracks.
#include "trace/reference_fixture.h"

#include "base/random.h"
#include "scene/ground_look.h"

#include <algorithm>

namespace sward::trace {
namespace {

using testing::cameraAt;
using testing::kPi;
using testing::meanOf;
using testing::plainPlan;
using testing::smallPicture;
using testing::Stage;
using testing::stageOf;

/// Tiles whose texels belong to edges by lot, laid by lot: a border of pieces at nearly every texel. `shifts` are the
/// offsets that edges choose from.
GroundPlan scrambledPlan(double sideM, int texels, int tileTexels, const std::vector<glm::ivec2>& shifts) {
  GroundPlan plan;
  plan.patchSideM = sideM;
  plan.patchTexels = texels;
  plan.tileTexels = tileTexels;
  base::Random random(5);
  for (int tile = 0; tile < 3; ++tile) {
    auto& offsets = plan.offsets.emplace_back();
    for (glm::ivec2& offset : offsets) offset = shifts[random.index(static_cast<std::uint32_t>(shifts.size()))];
    for (int i = 0; i < tileTexels * tileTexels; ++i) plan.owner.push_back(static_cast<std::uint8_t>(random.index(4)));
  }
  plan.mapWidth = 5;
  plan.mapHeight = 4;
  for (int i = 0; i < 20; ++i) plan.map.push_back(static_cast<std::uint8_t>(random.index(3)));
  return plan;
}

std::vector<glm::ivec2> allShifts(int texels, int many) {
  base::Random random(9);
  std::vector<glm::ivec2> shifts;
  for (int i = 0; i < many; ++i) {
    shifts.emplace_back(random.index(static_cast<std::uint32_t>(texels)),
                        random.index(static_cast<std::uint32_t>(texels)));
  }
  return shifts;
}

/// Patch texel under a point of the world, by the plan alone and in whole numbers.
glm::ivec2 patchTexelAt(const GroundPlan& plan, const glm::dvec2& place) {
  const auto modulo = [](int a, int b) { return (a % b + b) % b; };
  const double texel = plan.patchSideM / plan.patchTexels;
  const glm::ivec2 world(static_cast<int>(std::floor(place.x / texel)), static_cast<int>(std::floor(place.y / texel)));
  const glm::ivec2 within(modulo(world.x, plan.tileTexels), modulo(world.y, plan.tileTexels));
  const glm::ivec2 cell = (world - within) / plan.tileTexels;
  const int column = modulo(cell.x + plan.mapWidth / 2, plan.mapWidth);
  const int row = modulo(cell.y + plan.mapHeight / 2, plan.mapHeight);
  const int tile = plan.map[static_cast<std::size_t>(row * plan.mapWidth + column)];
  const int edge =
      plan.owner[static_cast<std::size_t>((tile * plan.tileTexels + within.y) * plan.tileTexels + within.x)];
  const glm::ivec2 patch = within + plan.offsets[static_cast<std::size_t>(tile)][static_cast<std::size_t>(edge)];
  return {modulo(patch.x, plan.patchTexels), modulo(patch.y, plan.patchTexels)};
}

glm::vec3 colourOf(const glm::ivec2& texel) {
  const auto bits = base::mix64(static_cast<std::uint64_t>(texel.x), static_cast<std::uint64_t>(texel.y), 77);
  return {0.1f + 0.8f * base::unitFloat(bits), 0.1f + 0.8f * base::unitFloat(bits << 20),
          0.1f + 0.8f * base::unitFloat(bits << 40)};
}

/// Counts pixels that show one texel alone, and those of them whose colour is another than the plan says. The camera
/// looks straight down from `eyeM` over (0, 0) at the plane z = planeM.
struct Comparison {
  int compared = 0, wrong = 0;
};
Comparison compareWithPlan(const Stage& stage, const image::Image& picture, double eyeM, double planeM, double tangent,
                           double bendM = 0.0) {
  Comparison out;
  const double scale = stage.daylight.sunIrradiance().y / kPi;
  const double half = tangent * (eyeM - planeM), pixel = 2.0 * half / picture.width;
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      const auto texelAt = [&](double px, double py) {
        glm::dvec2 place(pixel * (px - 0.5 * picture.width), -pixel * (py - 0.5 * picture.height));
        return patchTexelAt(stage.plan, place + scene::gridBend(place, bendM));
      };
      const glm::ivec2 texel = texelAt(x, y);
      if (texelAt(x + 1, y) != texel || texelAt(x, y + 1) != texel || texelAt(x + 1, y + 1) != texel) continue;
      ++out.compared;
      if (std::abs(static_cast<double>(picture.at(x, y, 1)) - scale * static_cast<double>(colourOf(texel).y)) > 1e-5) {
        ++out.wrong;
      }
    }
  }
  return out;
}

/// Every texel of the soil has its own colour.
void paintSoil(Stage& stage) {
  const int n = stage.plan.patchTexels;
  for (int i = 0; i < n * n; ++i) stage.soil[static_cast<std::size_t>(i)] = colourOf({i % n, i / n});
}

ReferenceOptions sharpPicture(int width, int height) {
  ReferenceOptions options = smallPicture(width, height);
  options.filter = PixelFilter::Box;
  return options;
}

TEST(ReferenceGround, SoilIsThatOfTheTexelsThatThePlanNames) {
  Stage stage = stageOf(testing::patchOf(mesh::Model{}, 1.0, 0.01), 16, glm::vec3(0.0f));
  paintSoil(stage);
  stage.plan = scrambledPlan(1.0, 16, 6, allShifts(16, 12));
  const image::Image picture =
      stage.picture(cameraAt({0.0, 0.0, 10.0}, {0.0, 0.0, 0.0}, 0.2), sharpPicture(330, 280), 4);
  const Comparison found = compareWithPlan(stage, picture, 10.0, 0.0, 0.2);
  EXPECT_GT(found.compared, 50000);
  EXPECT_EQ(found.wrong, 0);
}

TEST(ReferenceGround, BendsAsTheRenderersGridDoes) {
  Stage stage = stageOf(testing::patchOf(mesh::Model{}, 1.0, 0.01), 16, glm::vec3(0.0f));
  paintSoil(stage);
  stage.plan = scrambledPlan(1.0, 16, 6, allShifts(16, 12));
  ReferenceOptions options = sharpPicture(330, 280);
  options.gridBendM = 0.7;
  const image::Image picture = stage.picture(cameraAt({0.0, 0.0, 10.0}, {0.0, 0.0, 0.0}, 0.2), options, 4);
  // The bend is that of where rays enter the shell, 1 cm up, here at most 2 mm away: some pixels at texels' edges.
  const Comparison found = compareWithPlan(stage, picture, 10.0, 0.01, 0.2, 0.7);
  EXPECT_GT(found.compared, 50000);
  EXPECT_LT(found.wrong, 0.02 * found.compared);
  EXPECT_GT(compareWithPlan(stage, picture, 10.0, 0.01, 0.2, 0.0).wrong, 0.8 * found.compared);
}

TEST(ReferenceGround, LeavesAreThoseOfTheColumnsThatThePlanNames) {
  // Over every texel of the patch a leaf of its own colour.
  constexpr int kTexels = 16;
  mesh::Model leaves;
  for (int i = 0; i < kTexels * kTexels; ++i) {
    const glm::ivec2 texel(i % kTexels, i / kTexels);
    testing::addQuad(leaves, glm::vec3(glm::vec2(texel) / 16.0f, 0.1f), {1.0f / 16.0f, 0.0f, 0.0f},
                     {0.0f, 1.0f / 16.0f, 0.0f});
    for (int k = 0; k < 4; ++k)
      leaves.colours[leaves.colours.size() - 1 - static_cast<std::size_t>(k)] = glm::vec4(colourOf(texel), 1.0f);
  }
  leaves.materials[0].baseColour = glm::vec4(1.0f);
  leaves.materials[0].optics.translucency = 0.0;
  Stage stage = stageOf(testing::patchOf(leaves, 1.0, 0.12), kTexels, glm::vec3(0.0f));
  stage.plan = scrambledPlan(1.0, kTexels, 6, allShifts(kTexels, 12));
  const image::Image picture =
      stage.picture(cameraAt({0.0, 0.0, 10.0}, {0.0, 0.0, 0.0}, 0.2), sharpPicture(330, 280), 4);
  const Comparison found = compareWithPlan(stage, picture, 10.0, 0.1, 0.2);
  EXPECT_GT(found.compared, 50000);
  EXPECT_EQ(found.wrong, 0);
}

TEST(ReferenceGround, APlaneOverAllOfItHasNoCracks) {
  Stage stage = stageOf(testing::slabAt(0.1f, 0.5f, 0.0f), 16, glm::vec3(0.0f));
  stage.plan = scrambledPlan(1.0, 16, 6, allShifts(16, 12));
  const double expected = 0.5 * stage.daylight.sunIrradiance().y / kPi;
  for (const glm::dvec3 target : {glm::dvec3(0.0, 0.0, 0.0), glm::dvec3(3.0, 1.0, 0.0), glm::dvec3(-40.0, -9.0, 0.0)}) {
    const image::Image picture = stage.picture(cameraAt({0.0, 0.0, 1.0}, target, 0.02), smallPicture(64, 48), 32);
    for (int y = 0; y < 48; ++y) {
      for (int x = 0; x < 64; ++x)
        ASSERT_NEAR(static_cast<double>(picture.at(x, y, 1)), expected, 1e-6) << x << ' ' << y;
    }
  }
}

TEST(ReferenceGround, AWallThroughAllPiecesHasNoCracksAndNoDoubles) {
  // A wall along y, so that pieces may be moved along y without breaking it; seen from beside, at a slant, with alpha:
  // a hole would let light through, and a leaf met twice would hide more than it does.
  mesh::Model wall = testing::quad({0.53125f, 0.0f, 0.0f}, {0.0f, 1.0f, 0.0f}, {0.0f, 0.0f, 0.3f});
  wall.materials[0].optics.translucency = 0.0;
  wall.materials[0].baseColour = {0.5f, 0.5f, 0.5f, 0.5f};
  std::vector<glm::ivec2> shifts;
  for (int i = 0; i < 8; ++i) shifts.emplace_back(0, 2 * i + 1);
  for (const bool half : {false, true}) {
    wall.materials[0].alphaMode = half ? mesh::AlphaMode::Blend : mesh::AlphaMode::Opaque;
    Stage stage = stageOf(testing::patchOf(wall, 1.0, 0.3), 16, glm::vec3(0.0f));
    stage.plan = scrambledPlan(1.0, 16, 16, shifts);
    stage.daylight = testing::sunAt(270.0, 30.0);
    const auto reference =
        stage.reference(cameraAt({0.05, 0.3, 0.15}, {0.53125, 0.8, 0.15}, 0.1), smallPicture(64, 40));
    ASSERT_TRUE(reference->addSamples(64, {}).ok());
    // The sun stands behind the eye: light comes to the wall past the walls to the west, of which it clears one in the
    // half-transparent case by its chance. The wall seen is a metre from the next: tan 30 deg x 1 m > 0.3 m, free.
    const double cosine = std::cos(30.0 * kPi / 180.0);
    const double lit = 0.5 * stage.daylight.sunIrradiance().y * cosine / kPi;
    if (!half) {
      const image::Image mean = reference->mean();
      for (int i = 0; i < 64 * 40; ++i)
        ASSERT_NEAR(static_cast<double>(mean.pixels[static_cast<std::size_t>(3 * i)]) /
                        (0.5 * stage.daylight.sunIrradiance().x * cosine / kPi),
                    1.0, 1e-5)
            << i;
      continue;
    }
    // Walls behind the first are seen through it: 1/2 + 1/4 + ..., as far as the ray stays in the shell or meets the
    // soil: within 1e-6 of all at the slopes of this picture, which rise or sink 0.15 m in 1.5 m at most.
    const image::Image mean = reference->mean();
    double middle = 0.0, variance = 0.0;
    for (int x = 0; x < 64; ++x) {
      for (int y = 19; y <= 20; ++y) {
        middle += static_cast<double>(mean.at(x, y, 1)) / 128.0;
        variance += static_cast<double>(reference->variance().at(x, y, 1)) / (128.0 * 128.0);
      }
    }
    EXPECT_NEAR(middle, lit, 5.0 * std::sqrt(variance) + 2e-3 * lit);
  }
}

/// Share of values of two pictures that differ by more than a few roundings: a shadow's or a leaf's edge that fell on
/// the other side.
double differing(const image::Image& a, const image::Image& b) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    const auto one = static_cast<double>(a.pixels[i]), two = static_cast<double>(b.pixels[i]);
    if (std::abs(one - two) > 1e-4 * (one + two)) ++count;
  }
  return static_cast<double>(count) / static_cast<double>(a.pixels.size());
}

std::shared_ptr<scene::Patch> opaqueMeadow() {
  auto patch = std::make_shared<scene::Patch>(*testing::smallMeadow());
  for (auto& model : patch->models) {
    auto opaque = std::make_shared<mesh::Model>(*model);
    for (mesh::Material& material : opaque->materials) material.alphaMode = mesh::AlphaMode::Opaque;
    model = std::move(opaque);
  }
  return patch;
}

ReferenceOptions meadowPicture() {
  ReferenceOptions options = smallPicture(48, 32);
  options.sky = true;
  options.sunRadiusDeg = 0.2666;
  options.bounces = 1;
  return options;
}
const scene::Camera& meadowCamera() {
  static const scene::Camera camera = cameraAt({0.7, -2.5, 1.2}, {0.4, 0.3, 0.1}, 0.5);
  return camera;
}

TEST(ReferenceGround, OneTileOfOnePieceIsThePeriodicPatchLaidOut) {
  // The oracle is a patch three times as wide with nine copies of every plant: the same ground, cut elsewhere.
  const auto small = opaqueMeadow();
  auto wide = std::make_shared<scene::Patch>(*small);
  wide->sideM = 3.0 * small->sideM;
  wide->instances.clear();
  for (int i = 0; i < 9; ++i) {
    for (scene::Instance instance : small->instances) {
      instance.worldFromModel[3] += glm::vec3(static_cast<float>(i % 3), static_cast<float>(i / 3), 0.0f);
      wide->instances.push_back(instance);
    }
  }
  Stage one = stageOf(small, 16, {0.2f, 0.15f, 0.1f}), nine = stageOf(wide, 48, {0.2f, 0.15f, 0.1f});
  one.daylight = nine.daylight = testing::sunAt(240.0, 25.0);
  const image::Image expected = nine.picture(meadowCamera(), meadowPicture(), 4);
  EXPECT_LT(differing(one.picture(meadowCamera(), meadowPicture(), 4), expected), 2e-3);
  ReferenceOptions patchShadows = meadowPicture();
  patchShadows.shadows = ShadowGround::Patch;
  EXPECT_LT(differing(one.picture(meadowCamera(), patchShadows, 4), expected), 2e-3);
  // Cut into tiles of five texels that show their own place of the patch: the same ground again.
  Stage cut = stageOf(small, 15, {0.2f, 0.15f, 0.1f});
  cut.daylight = one.daylight;
  cut.plan.tileTexels = 5;
  cut.plan.offsets.clear();
  cut.plan.owner.clear();
  cut.plan.map.clear();
  cut.plan.mapWidth = cut.plan.mapHeight = 3;
  for (int tile = 0; tile < 9; ++tile) {
    // The world's origin is the corner of the middle cell (1, 1).
    const glm::ivec2 offset(5 * ((tile % 3) - 1), 5 * ((tile / 3) - 1));
    cut.plan.offsets.push_back({offset, offset, offset, offset});
    for (int i = 0; i < 25; ++i) cut.plan.owner.push_back(static_cast<std::uint8_t>((i + tile) % 4));
    cut.plan.map.push_back(static_cast<std::uint8_t>(tile));
  }
  EXPECT_LT(differing(cut.picture(meadowCamera(), meadowPicture(), 4), expected), 2e-3);
  // And a ground that is laid otherwise is another.
  cut.plan.offsets[4] = {glm::ivec2(3, 2), glm::ivec2(3, 2), glm::ivec2(3, 2), glm::ivec2(3, 2)};
  EXPECT_GT(differing(cut.picture(meadowCamera(), meadowPicture(), 4), expected), 0.02);
}

TEST(ReferenceGround, ShadowsFallAsTheGroundIsTiledOrAsThePatchWasBaked) {
  // A post on the patch at x = 0.25 casts its shadow east over the soil at x = 0.5 to 0.75. The tile shows the western
  // half of the patch as it is and in its eastern half another place without a post.
  mesh::Model post = testing::quad({0.25f, 0.0f, 0.0f}, {0.0f, 1.0f, 0.0f}, {0.0f, 0.0f, 0.2f});
  Stage stage = stageOf(testing::patchOf(post, 1.0, 0.2), 16, glm::vec3(0.5f));
  stage.daylight = testing::sunAt(270.0, 20.0);
  // West: patch x in [0.5, 1); east: the same half, where no post stands. A hit cut from there still has, on the patch,
  // the post to the west.
  stage.plan.offsets[0] = {glm::ivec2(8, 0), glm::ivec2(0, 0), glm::ivec2(0), glm::ivec2(0)};
  for (int y = 0; y < 16; ++y) {
    for (int x = 0; x < 16; ++x) stage.plan.owner[static_cast<std::size_t>(y * 16 + x)] = x < 8 ? 0 : 1;
  }
  const scene::Camera camera = cameraAt({0.25, 0.5, 8.0}, {0.25, 0.5, 0.0}, 0.01);  // x from 0.17 to 0.33
  ReferenceOptions options = smallPicture(16, 4);
  const double lit = 0.5 * stage.daylight.sunIrradiance().y * std::sin(20.0 * kPi / 180.0) / kPi;
  EXPECT_NEAR(meanOf(stage.picture(camera, options, 4)), lit, 1e-6);
  options.shadows = ShadowGround::Patch;  // patch x from 0.67 to 0.83: the post's shadow ends at 0.25 + 0.2 / tan 20
  const image::Image baked = stage.picture(camera, options, 4);
  for (int x = 0; x < 16; ++x) {
    if (x == 12 || x == 13) continue;  // the shadow's end
    EXPECT_NEAR(static_cast<double>(baked.at(x, 2, 1)), x < 12 ? 0.0 : lit, 1e-6) << x;
  }
}

TEST(ReferenceGround, RaysThatHardlySinkEnd) {
  // One small plate: most rays meet nothing, ever.
  Stage stage =
      stageOf(testing::patchOf(testing::quad({0.5f, 0.5f, 0.2f}, {0.05f, 0.0f, 0.0f}, {0.0f, 0.05f, 0.1f}), 1.0, 0.5),
              16, glm::vec3(0.2f));
  stage.daylight = testing::sunAt(10.0, 0.001);
  ReferenceOptions options = meadowPicture();
  options.width = 24;
  options.height = 16;
  for (const glm::dvec3 eye : {glm::dvec3(0.3, 0.2, 0.3), glm::dvec3(0.3, 0.2, 1.7), glm::dvec3(0.3, 0.2, 0.5)}) {
    for (const glm::dvec3 look : {glm::dvec3(1, 0, 0), glm::dvec3(0, -1, 0), glm::dvec3(0.7, 0.7, 1e-7),
                                  glm::dvec3(-0.3, 0.2, -1e-9), glm::dvec3(1, 1e-30, -1e-5)}) {
      const image::Image picture = stage.picture(cameraAt(eye, eye + look, 1e-4), options, 1);
      for (const float value : picture.pixels) ASSERT_TRUE(std::isfinite(value) && value >= 0.0f);
    }
  }
}

TEST(ReferenceGround, TheFarGroundEndsInTheHorizonsSky) {
  Stage stage = stageOf(testing::patchOf(mesh::Model{}, 1.0, 0.01), 8, glm::vec3(0.3f));
  const glm::dvec3 eye(0.0, 0.0, 1.7), along(0.0, 1.0, -1e-5);  // meets the ground after 169 km
  const image::Image picture = stage.picture(cameraAt(eye, eye + along, 1e-8), smallPicture(2, 2), 1);
  EXPECT_NEAR(meanOf(picture), stage.daylight.skyRadiance({0.0, 1.0, 0.0}).y, 1e-5);
}

TEST(ReferenceCreate, RefusesWhatDoesNotFit) {
  const auto patch = testing::slabAt(0.1f, 0.5f, 0.0f);
  const Stage good = stageOf(patch, 8, glm::vec3(0.2f));
  const scene::Camera camera = meadowCamera();
  const auto fails = [&](const Stage& stage, const ReferenceOptions& options = smallPicture()) {
    const auto made =
        Reference::create({stage.traced.get(), &stage.plan, stage.soil, stage.daylight, 0.0, {}, {}}, camera, options);
    return !made.ok() && made.error().kind == ErrorKind::BadInput;
  };
  EXPECT_FALSE(fails(good));
  const auto broken = [&](auto change) {
    Stage stage = stageOf(patch, 8, glm::vec3(0.2f));
    change(stage);
    return fails(stage);
  };
  EXPECT_TRUE(broken([](Stage& s) { s.soil.pop_back(); }));
  EXPECT_TRUE(broken([](Stage& s) { s.plan.owner[3] = 4; }));
  EXPECT_TRUE(broken([](Stage& s) { s.plan.owner.pop_back(); }));
  EXPECT_TRUE(broken([](Stage& s) { s.plan.map[0] = 1; }));
  EXPECT_TRUE(broken([](Stage& s) { s.plan.map.clear(); }));
  EXPECT_TRUE(broken([](Stage& s) { s.plan.patchSideM = 2.0; }));
  EXPECT_TRUE(broken([](Stage& s) { s.plan.tileTexels = 0; }));
  EXPECT_TRUE(broken([](Stage& s) { s.plan.mapWidth = -1; }));
  EXPECT_TRUE(fails(good, smallPicture(0, 4)));
  ReferenceOptions options = smallPicture();
  options.bounces = -1;
  EXPECT_TRUE(fails(good, options));
  options = smallPicture();
  options.exposure = NAN;
  EXPECT_TRUE(fails(good, options));
}

}  // namespace
}  // namespace sward::trace
