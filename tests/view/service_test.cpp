#include "view/fixture.h"

#include "image/io.h"
#include "image/metrics.h"
#include "render/frame_plan.h"

#include <gtest/gtest.h>

#include <cmath>
#include <thread>

namespace sward {
namespace {

using editor::Comparison;
using editor::ViewPicture;
using editor::ViewRequest;
using editor::ViewService;
using testing::smallRequest;
using testing::Viewer;

/// What `sward render` would put into its PNG for a request.
image::ByteImage rendered(const ViewRequest& request, gpu::Device device = gpu::Device::Egl) {
  auto stage = testing::makeStage(device);
  const auto daylight = render::daylightOf(*request.project);
  EXPECT_TRUE(daylight.ok());
  EXPECT_TRUE(stage.renderer->setGround(request.ground).ok());
  stage.renderer->setDaylight(*daylight, request.project->sky.hazeKm);
  auto frame = render::planFrame(*request.project, request.view, *daylight);
  EXPECT_TRUE(frame.ok());
  frame->width = request.width;
  frame->height = request.height;
  frame->mode = request.mode;
  const auto picture = stage.renderer->drawDisplay(*frame);
  EXPECT_TRUE(picture.ok());
  const auto png = image::encodePng(*picture);
  EXPECT_TRUE(png.ok());
  const auto read = image::readImage(*png, "picture", image::Encoding::Linear);
  EXPECT_TRUE(read.ok());
  image::ByteImage bytes{read->width, read->height, {}};
  for (std::size_t i = 0; i < read->pixels.size(); i += 3) {
    for (std::size_t c = 0; c < 3; ++c) bytes.rgba.push_back(image::toByte(read->pixels[i + c]));
    bytes.rgba.push_back(255);
  }
  return bytes;
}

/// The same project with something changed.
template <typename Change>
std::shared_ptr<const project::Project> changed(const ViewRequest& request, const Change& change) {
  auto project = std::make_shared<project::Project>(*request.project);
  change(*project);
  return project;
}

class OnDevice : public ::testing::TestWithParam<gpu::Device> {};

TEST_P(OnDevice, TheFinalPictureIsWhatRenderWrites) {
  Viewer viewer(GetParam());
  for (const auto transform : {render::ViewTransform::Filmic, render::ViewTransform::Standard}) {
    ViewRequest request = smallRequest();
    request.project = changed(request, [&](project::Project& p) { p.render.viewTransform = transform; });
    request.view.exposureEv = 0.7;
    const auto picture = viewer.picture(request);
    ASSERT_TRUE(picture.has_value()) << viewer.service().error()->text();
    EXPECT_TRUE(picture->final);
    EXPECT_EQ(picture->samples, 6);
    const image::ByteImage expected = rendered(request, GetParam());
    EXPECT_EQ(picture->width, expected.width);
    EXPECT_EQ(picture->height, expected.height);
    EXPECT_EQ(picture->rgba, expected.rgba);
  }
}

INSTANTIATE_TEST_SUITE_P(Devices, OnDevice, ::testing::Values(gpu::Device::Egl, gpu::Device::OsMesa),
                         [](const auto& device) { return device.param == gpu::Device::Egl ? "egl" : "osmesa"; });

TEST(ViewService, FollowsEverythingThatMayChangeBetweenRequests) {
  Viewer viewer;
  ViewRequest request = smallRequest();
  std::vector<std::uint8_t> last;
  const auto expectParity = [&](const char* what) {
    const auto picture = viewer.picture(request);
    ASSERT_TRUE(picture.has_value()) << what;
    EXPECT_EQ(picture->rgba, rendered(request).rgba) << what;
    EXPECT_NE(picture->rgba, last) << what;
    last = picture->rgba;
  };
  expectParity("first");
  request.project = changed(request, [](project::Project& p) { p.sun.angles = {40.0, 12.0}; });
  expectParity("the sun");
  request.project = changed(request, [](project::Project& p) { p.sky.hazeKm = 0.05; });
  expectParity("haze");
  request.project = changed(request, [](project::Project& p) { p.render.macroVariation = 0.4; });
  expectParity("macro variation");
  request.view.position.x += 0.3;
  expectParity("the view");
  request.mode.quantity = render::ViewQuantity::Tiles;
  expectParity("a view mode");
  request.mode = {};
  auto options = testing::smallOptions();
  options.seed = 9;
  request.ground = testing::makeGround(options);
  expectParity("the ground");
  request.width = 91;
  expectParity("the size");
}

TEST(ViewService, AMovingPictureHasHalfTheSizeAndOneSample) {
  Viewer viewer;
  ViewRequest request = smallRequest();
  request.moving = true;
  request.width = 151;
  const auto picture = viewer.picture(request);
  ASSERT_TRUE(picture.has_value());
  EXPECT_EQ(picture->width, 76);
  EXPECT_EQ(picture->height, 45);
  EXPECT_EQ(picture->samples, 1);
  EXPECT_FALSE(picture->final);
}

TEST(ViewService, PicturesGrowFromTheFirstSampleToTheLast) {
  Viewer viewer;
  ViewRequest request = smallRequest();
  request.project = changed(request, [](project::Project& p) { p.render.samples = 37; });
  request.id = 5;
  viewer.service().request(request);
  std::vector<ViewPicture> seen;
  const auto last = viewer.wait(5, [&](const ViewPicture& picture) {
    seen.push_back(picture);
    return picture.final;
  });
  ASSERT_TRUE(last.has_value());
  EXPECT_EQ(last->samples, 37);
  // A slow reader may miss some, but whatever is seen only grows.
  for (std::size_t i = 1; i < seen.size(); ++i) EXPECT_GT(seen[i].samples, seen[i - 1].samples);
  for (const ViewPicture& picture : seen) EXPECT_EQ(picture.final, picture.samples == 37);
  EXPECT_FALSE(viewer.service().tryPop().has_value()) << "nothing comes after the last";
}

TEST(ViewService, TheNewestRequestWins) {
  Viewer viewer;
  ViewRequest request = smallRequest();
  // Would take minutes if anything waited for it.
  request.project = changed(request, [](project::Project& p) { p.render.samples = 4096; });
  request.width = 640;
  request.height = 480;
  for (std::uint64_t id = 1; id <= 40; ++id) {
    request.id = id;
    request.view.position.x += 0.01;
    viewer.service().request(request);
  }
  ViewRequest newest = smallRequest();
  newest.id = 41;
  viewer.service().request(newest);
  const auto picture = viewer.wait(41, [](const ViewPicture& p) { return p.final; });
  ASSERT_TRUE(picture.has_value());
  EXPECT_EQ(picture->rgba, rendered(newest).rgba);
  std::uint64_t last = 0;
  int before = 0;
  for (const Viewer::Seen& seen : viewer.seen()) {
    EXPECT_GE(seen.id, last) << "no picture of an older request after one of a newer";
    last = seen.id;
    before += seen.id < 41 ? 1 : 0;
  }
  EXPECT_LT(before, 40) << "requests were skipped";
}

TEST(ViewService, EveryBegunRequestOfAStreamGivesAPicture) {
  // Each request comes as soon as the one before was seen to be begun: all of them are superseded at once.
  Viewer viewer;
  ViewRequest request = smallRequest();
  request.moving = true;
  for (std::uint64_t id = 1; id <= 10; ++id) {
    request.id = id;
    request.view.position.y += 0.02;
    viewer.service().request(request);
    ASSERT_TRUE(viewer.wait(id, [](const ViewPicture&) { return true; }).has_value()) << id;
  }
}

TEST(ViewService, DrawsFromOnePixelToFourThousand) {
  Viewer viewer;
  ViewRequest request = smallRequest();
  request.project = changed(request, [](project::Project& p) { p.render.samples = 1; });
  for (const auto& [width, height] : {std::pair{1, 1}, {200, 100}, {1, 300}, {4000, 3000}, {3, 2}}) {
    request.width = width;
    request.height = height;
    for (const bool moving : {false, true}) {
      request.moving = moving;
      const auto picture = viewer.picture(request);
      ASSERT_TRUE(picture.has_value()) << width;
      EXPECT_EQ(picture->width, moving ? (width + 1) / 2 : width);
      EXPECT_EQ(picture->height, moving ? (height + 1) / 2 : height);
      EXPECT_EQ(picture->rgba.size(),
                static_cast<std::size_t>(picture->width) * static_cast<std::size_t>(picture->height) * 4);
    }
  }
}

/// The project's own picture, and the one of the comparison by itself.
struct Pair {
  image::ByteImage own, other;
};
Pair bothOf(const ViewRequest& request) {
  ViewRequest own = request, other = request;
  own.comparison.reset();
  other.comparison.reset();
  other.project = changed(request, [&](project::Project& p) { p.render.method = request.comparison->method; });
  if (request.comparison->ground) other.ground = request.comparison->ground;
  return {rendered(own), rendered(other)};
}

ViewRequest comparing(Comparison::Show show, render::GroundMethod method) {
  ViewRequest request = smallRequest();
  request.comparison.emplace();
  request.comparison->show = show;
  request.comparison->method = method;
  return request;
}

void expectSplit(const ViewRequest& request, const ViewPicture& picture, int column) {
  const Pair pair = bothOf(request);
  ASSERT_NE(pair.own.rgba, pair.other.rgba);
  int differing = 0;
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      const image::ByteImage& expected = x < column ? pair.own : pair.other;
      for (int c = 0; c < 4; ++c) {
        const auto at = static_cast<std::size_t>((y * picture.width + x) * 4 + c);
        ASSERT_EQ(picture.rgba[at], expected.rgba[at]) << x << ' ' << y;
        differing += pair.own.rgba[at] != pair.other.rgba[at] ? 1 : 0;
      }
    }
  }
  EXPECT_GT(differing, 1000);
}

TEST(ViewService, ASplitShowsBothPicturesSideBySide) {
  Viewer viewer;
  ViewRequest request = comparing(Comparison::Show::Split, render::GroundMethod::BlendedPaper);
  for (const auto& [at, column] : {std::pair{0.3, 45}, {0.5, 75}, {0.0, 0}, {1.0, 150}, {7.0, 150}, {-1.0, 0}}) {
    request.comparison->splitAt = at;
    const auto picture = viewer.picture(request);
    ASSERT_TRUE(picture.has_value());
    expectSplit(request, *picture, column);
  }
  request.comparison->splitAt = std::nan("");
  EXPECT_TRUE(viewer.picture(request).has_value());
}

TEST(ViewService, ASplitMayHaveAnotherGround) {
  Viewer viewer;
  ViewRequest request = comparing(Comparison::Show::Split, render::GroundMethod::March);
  auto options = testing::smallOptions();
  options.basis = lpt::Basis::Ptm;
  options.seed = 3;
  request.comparison->ground = testing::makeGround(options);
  auto picture = viewer.picture(request);
  ASSERT_TRUE(picture.has_value());
  expectSplit(request, *picture, 75);
  // The second ground follows the sun too.
  request.project = changed(request, [](project::Project& p) { p.sun.angles = {40.0, 12.0}; });
  picture = viewer.picture(request);
  ASSERT_TRUE(picture.has_value());
  expectSplit(request, *picture, 75);
}

TEST(ViewService, TheDifferenceOfEqualPicturesIsBlack) {
  Viewer viewer;
  for (const auto show : {Comparison::Show::Difference, Comparison::Show::SignedDifference}) {
    const auto picture = viewer.picture(comparing(show, smallRequest().project->render.method));
    ASSERT_TRUE(picture.has_value());
    const int expected = show == Comparison::Show::Difference ? 0 : 128;
    for (std::size_t i = 0; i < picture->rgba.size(); ++i)
      ASSERT_EQ(picture->rgba[i], i % 4 == 3 ? 255 : expected) << i;
  }
}

TEST(ViewService, DifferencesAreAmplifiedDisplayValues) {
  Viewer viewer;
  for (const auto show : {Comparison::Show::Difference, Comparison::Show::SignedDifference}) {
    ViewRequest request = comparing(show, render::GroundMethod::BlendedNormalised);
    request.comparison->differenceGain = 3.0;
    const auto picture = viewer.picture(request);
    ASSERT_TRUE(picture.has_value());
    const Pair pair = bothOf(request);
    int differing = 0;
    for (std::size_t i = 0; i < picture->rgba.size(); ++i) {
      if (i % 4 == 3) continue;
      const double difference = static_cast<double>(pair.other.rgba[i]) - pair.own.rgba[i];
      const double shown = show == Comparison::Show::Difference ? 3.0 * std::abs(difference) : 127.5 + 1.5 * difference;
      ASSERT_EQ(picture->rgba[i], std::lround(std::min(std::max(shown, 0.0), 255.0))) << i;
      differing += difference != 0.0 ? 1 : 0;
    }
    EXPECT_GT(differing, 1000);
  }
}

/// A picture that is given to be compared with: bands that no meadow has.
std::shared_ptr<const image::ByteImage> bands(int width, int height) {
  image::Image out(width, height, 3);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) out.at(x, y, (x + y) % 3) = 1.0f;
  }
  return std::make_shared<const image::ByteImage>(image::toBytes(out));
}

ViewRequest comparingGiven(std::shared_ptr<const image::ByteImage> other) {
  ViewRequest request = comparing(Comparison::Show::Split, render::GroundMethod::March);
  request.project = changed(request, [](project::Project& p) { p.render.macroVariation = 0.4; });
  request.comparison->given = true;
  request.comparison->other = std::move(other);
  return request;
}

/// The project's own picture beside a given one: without macro variation.
image::ByteImage ownBeside(const ViewRequest& request) {
  ViewRequest own = request;
  own.comparison.reset();
  own.project = changed(own, [](project::Project& p) { p.render.macroVariation = 0.0; });
  return rendered(own);
}

TEST(ViewService, AGivenPictureStandsRightOfTheSplitAndTheErrorIsSaid) {
  Viewer viewer;
  const auto other = bands(150, 90);
  ViewRequest request = comparingGiven(other);
  const image::ByteImage own = ownBeside(request);
  for (const auto& [at, column] : {std::pair{0.5, 75}, {0.2, 30}}) {
    request.comparison->splitAt = at;
    const auto picture = viewer.picture(request);
    ASSERT_TRUE(picture.has_value()) << viewer.service().error()->text();
    for (int i = 0; i < 150 * 90 * 4; ++i) {
      const auto index = static_cast<std::size_t>(i);
      ASSERT_EQ(picture->rgba[index], (i / 4 % 150 < column ? own : *other).rgba[index]) << i;
    }
    const auto errors = image::valueErrors(image::fromBytes(*other), image::fromBytes(own));
    ASSERT_TRUE(errors.ok());
    ASSERT_TRUE(picture->rmse.has_value());
    EXPECT_EQ(*picture->rmse, errors->rmse);
  }
  request.comparison->show = Comparison::Show::Difference;
  const auto difference = viewer.picture(request);
  ASSERT_TRUE(difference.has_value());
  EXPECT_EQ(difference->rgba[1], std::min(4 * std::abs(own.rgba[1] - other->rgba[1]), 255));
}

TEST(ViewService, AnotherGivenPictureKeepsTheSamplesThatAreDrawn) {
  Viewer viewer;
  ViewRequest request = comparingGiven(bands(150, 90));
  ASSERT_TRUE(viewer.picture(request).has_value());
  const std::size_t before = viewer.seen().size();
  request.comparison->other = bands(75, 45);  // half the size, as the first of a reference
  request.comparison->splitAt = 0.0;
  const auto picture = viewer.picture(request);
  ASSERT_TRUE(picture.has_value());
  EXPECT_EQ(viewer.seen().size() - before, 1u) << "complete at once";
  EXPECT_FALSE(picture->rmse.has_value()) << "it is not as large";
  const image::ByteImage& half = *request.comparison->other;
  for (int c = 0; c < 3; ++c) {
    EXPECT_EQ(picture->rgba[static_cast<std::size_t>((89 * 150 + 149) * 4 + c)], half.at(74, 44)[c]);
    EXPECT_EQ(picture->rgba[static_cast<std::size_t>((89 * 150 + 148) * 4 + c)], half.at(74, 44)[c]);
  }
}

TEST(ViewService, WhereNoPictureIsGivenYetTheOwnDarkens) {
  Viewer viewer;
  const ViewRequest request = comparingGiven(nullptr);
  const auto picture = viewer.picture(request);
  ASSERT_TRUE(picture.has_value());
  const image::ByteImage own = ownBeside(request);
  for (int x : {0, 74, 75, 149}) {
    const int expected = own.at(x, 60)[1] / (x < 75 ? 1 : 3);
    EXPECT_EQ(picture->rgba[static_cast<std::size_t>((60 * 150 + x) * 4 + 1)], expected) << x;
  }
  EXPECT_FALSE(picture->rmse.has_value());
}

TEST(ViewService, ErrorsAreSaidAndTheNextPictureIsDrawn) {
  Viewer viewer;
  const auto expectError = [&](const ViewRequest& request, const char* words) {
    EXPECT_FALSE(viewer.picture(request).has_value()) << words;
    ASSERT_TRUE(viewer.service().error().has_value()) << words;
    EXPECT_NE(viewer.service().error()->text().find(words), std::string::npos) << viewer.service().error()->text();
    EXPECT_TRUE(viewer.recover(smallRequest()).has_value()) << words;
    EXPECT_FALSE(viewer.service().error().has_value()) << words;
  };
  ViewRequest request = smallRequest();
  request.ground.reset();
  expectError(request, "no ground");
  request = smallRequest();
  request.project.reset();
  expectError(request, "no project");
  request = smallRequest();
  request.view.target = request.view.position;
  expectError(request, "view");
  request = smallRequest();
  request.width = 0;
  expectError(request, "0 x 90");
  request = smallRequest();
  request.width = 20000;
  expectError(request, "20000 x 90");
  request = smallRequest();
  request.mode.quantity = render::ViewQuantity::Condition;
  expectError(request, "inspection");
  request = smallRequest();
  auto broken = testing::syntheticGround(testing::smallOptions());
  broken.map.tiles.pop_back();
  request.ground = std::make_shared<const bake::GroundBake>(broken);
  expectError(request, "tile map");
  request = smallRequest();
  request.project = changed(request, [](project::Project& p) {
    p.sun.byMoment = true;
    p.sun.moment.month = 13;
  });
  expectError(request, "month");
}

TEST(ViewService, WithoutAContextItSaysSoAndKeepsAnswering) {
  Viewer viewer(gpu::Device::Window);  // made by the editor, never here
  for (int i = 0; i < 3; ++i) {
    EXPECT_FALSE(viewer.recover(smallRequest()).has_value());
    ASSERT_TRUE(viewer.service().error().has_value());
    EXPECT_NE(viewer.service().error()->text().find("window"), std::string::npos);
    EXPECT_FALSE(viewer.service().device().has_value());
  }
}

TEST(ViewService, SaysWhatDraws) {
  Viewer viewer;
  EXPECT_TRUE(viewer.picture(smallRequest()).has_value());
  const auto device = viewer.service().device();
  ASSERT_TRUE(device.has_value());
  EXPECT_EQ(device->api, "EGL");
  EXPECT_FALSE(device->renderer.empty());
}

TEST(ViewService, EndsInTheMiddleOfAPicture) {
  ViewRequest request = smallRequest();
  request.project = changed(request, [](project::Project& p) { p.render.samples = 4096; });
  request.width = 1280;
  request.height = 800;
  {
    // Without a picture ever having been taken, and with one.
    ViewService idle({gpu::Device::Egl, {}});
    ViewService busy({gpu::Device::Egl, {}});
    busy.request(request);
    while (!busy.tryPop()) std::this_thread::yield();
  }
  SUCCEED() << "no join waited for 4096 samples";
}

}  // namespace
}  // namespace sward
