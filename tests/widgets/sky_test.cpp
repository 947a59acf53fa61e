#include "widgets/harness.h"
#include "widgets/light_palette.h"
#include "widgets/sky_dome.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace sward::editor {
namespace {

class Maps : public ::testing::TestWithParam<DiscMap> {};

TEST_P(Maps, AnglesGoToPlacesAndBack) {
  const double lowest = GetParam() == DiscMap::Equidistant ? -18.0 : 0.0;
  for (double azimuth = 0.0; azimuth < 360.0; azimuth += 7.3) {
    for (double elevation = lowest; elevation < 89.99; elevation += 3.1) {
      const SkyAngles back = discAngles(discPlace({azimuth, elevation}, GetParam()), GetParam());
      EXPECT_NEAR(back.elevationDeg, elevation, 1e-6);
      EXPECT_NEAR(std::remainder(back.azimuthDeg - azimuth, 360.0), 0.0, 1e-6);
    }
  }
}

TEST_P(Maps, NorthIsUpAndEastIsRight) {
  const glm::dvec2 north = discPlace({0, 0}, GetParam()), east = discPlace({90, 0}, GetParam());
  EXPECT_NEAR(north.x, 0.0, 1e-12);
  EXPECT_NEAR(north.y, 1.0, 1e-12);
  EXPECT_NEAR(east.x, 1.0, 1e-12);
  EXPECT_NEAR(east.y, 0.0, 1e-12);
  EXPECT_EQ(discAngles({0, 0}, GetParam(), 77.0).azimuthDeg, 77.0) << "the zenith keeps the azimuth it had";
  EXPECT_EQ(discAngles({0, 0}, GetParam()).elevationDeg, 90.0);
}

TEST_P(Maps, PlacesBeyondTheEdgeAreHeld) {
  const SkyAngles far = discAngles({50.0, 0.0}, GetParam());
  EXPECT_NEAR(far.elevationDeg, GetParam() == DiscMap::Equidistant ? -18.0 : 0.0, 1e-9);
  EXPECT_NEAR(far.azimuthDeg, 90.0, 1e-9);
  EXPECT_GE(discAngles({-1e-16, 1.0}, GetParam()).azimuthDeg, 0.0);
  EXPECT_LT(discAngles({-1e-16, 1.0}, GetParam()).azimuthDeg, 360.0);
}

INSTANTIATE_TEST_SUITE_P(Both, Maps, ::testing::Values(DiscMap::Equidistant, DiscMap::EqualArea));

TEST(Disc, EqualAreaIsEqualArea) {
  // Directions even over the hemisphere are even over the disc: a chi-square test of 10 rings of one area each.
  std::mt19937 random(5);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::array<int, 10> rings{};
  constexpr int kCount = 20000;
  for (int i = 0; i < kCount; ++i) {
    const double elevation = std::asin(unit(random)) * 180.0 / M_PI;
    const double r = glm::length(discPlace({360.0 * unit(random), elevation}, DiscMap::EqualArea));
    ++rings[std::min<std::size_t>(9, static_cast<std::size_t>(r * r * 10.0))];
  }
  double chi = 0.0;
  for (const int count : rings) chi += (count - kCount / 10.0) * (count - kCount / 10.0) / (kCount / 10.0);
  EXPECT_LT(chi, 27.9);  // 99.9 % for 9 degrees of freedom
}

TEST(Disc, CompassPointsHaveTheirNames) {
  EXPECT_STREQ(compassPoint(0), "N");
  EXPECT_STREQ(compassPoint(359.9), "N");
  EXPECT_STREQ(compassPoint(225), "SW");
  EXPECT_STREQ(compassPoint(-90), "W");
  EXPECT_STREQ(compassPoint(68), "ENE");
}

struct DomeBench {
  Harness ui{400, 420};
  SkyAngles sun{225.0, 35.0};
  SkyDomeOptions options;
  int changes = 0, finishes = 0;

  DomeBench() {
    ui.show([this] {
      const EditState state = skyDome("dome", sun, 320, options);
      changes += state.changed ? 1 : 0;
      finishes += state.finished ? 1 : 0;
    });
  }
  /// Where a direction stands on the screen, from the dome's rectangle.
  ImVec2 place(const SkyAngles& angles) const {
    const ItemLog::Item dome = ui.item("sky:dome");
    const float side = dome.max.x - dome.min.x;
    const float radius = std::floor((0.5f * side - 20.0f) / 1.2f);
    return discScreen(dome.centre(), radius, discPlace(angles, DiscMap::Equidistant));
  }
};

TEST(SkyDome, TheSunStandsWhereItsAnglesSay) {
  DomeBench b;
  for (const SkyAngles& angles : {SkyAngles{0, 10}, {90, 0}, {180, 60}, {300, 89}, {45, -12}}) {
    b.sun = angles;
    b.ui.frames(2);
    const ImVec2 expected = b.place(angles), shown = b.ui.at("sky:dome:sun");
    EXPECT_NEAR(shown.x, expected.x, 1.0);
    EXPECT_NEAR(shown.y, expected.y, 1.0);
  }
}

TEST(SkyDome, DraggingTheSunMapsToAngles) {
  DomeBench b;
  b.ui.drag(b.ui.at("sky:dome:sun"), b.place({120.0, 50.0}), 6);
  EXPECT_NEAR(b.sun.azimuthDeg, 120.0, 1.0);
  EXPECT_NEAR(b.sun.elevationDeg, 50.0, 1.0);
  EXPECT_GT(b.changes, 2);
  EXPECT_EQ(b.finishes, 1);
  EXPECT_EQ(b.sun.azimuthDeg, std::round(b.sun.azimuthDeg * 10.0) / 10.0) << "short numbers in files";
}

TEST(SkyDome, APressOnTheSkyBringsTheSunThere) {
  DomeBench b;
  b.ui.clickAt(b.place({10.0, 20.0}));
  EXPECT_NEAR(b.sun.azimuthDeg, 10.0, 1.0);
  EXPECT_NEAR(b.sun.elevationDeg, 20.0, 1.0);
  EXPECT_EQ(b.finishes, 1);
  const SkyAngles before = b.sun;
  b.ui.pause();
  b.ui.clickAt(b.ui.at("sky:dome:sun"));
  EXPECT_EQ(b.sun.azimuthDeg, before.azimuthDeg) << "a click on the sun itself moves nothing";
  EXPECT_EQ(b.finishes, 1);
}

TEST(SkyDome, BelowTheHorizonIsTwilight) {
  DomeBench b;
  b.ui.drag(b.ui.at("sky:dome:sun"), b.place({270.0, -10.0}));
  EXPECT_NEAR(b.sun.elevationDeg, -10.0, 1.0);
  b.ui.drag(b.ui.at("sky:dome:sun"), ImVec2(-900, b.place({270.0, 0.0}).y));
  EXPECT_EQ(b.sun.elevationDeg, -18.0);
}

TEST(SkyDome, ShiftAndCtrlKeepOneAngle) {
  DomeBench b;
  b.ui.hold(false, true, false);
  b.ui.drag(b.ui.at("sky:dome:sun"), b.place({100.0, 70.0}));
  EXPECT_EQ(b.sun.elevationDeg, 35.0);
  EXPECT_NEAR(b.sun.azimuthDeg, 100.0, 2.0);
  b.ui.hold(true, false, false);
  b.ui.drag(b.ui.at("sky:dome:sun"), b.place({200.0, 70.0}));
  EXPECT_NEAR(b.sun.azimuthDeg, 100.0, 2.0);
  EXPECT_NEAR(b.sun.elevationDeg, 70.0, 2.0);
}

TEST(SkyDome, ASunSetByAMomentIsNotDragged) {
  DomeBench b;
  b.options.enabled = false;
  b.ui.drag(b.ui.at("sky:dome:sun"), b.place({120.0, 50.0}));
  EXPECT_EQ(b.sun.azimuthDeg, 225.0);
  EXPECT_EQ(b.changes, 0);
}

TEST(SkyDome, TheSkyIsPaintedAndDarkensAtNight) {
  DomeBench b;
  b.ui.moveTo(ImVec2(1, 1));
  const auto zenith = [&b] {
    b.ui.frames(2);
    const ImVec2 at = b.place({300.0, 75.0});
    return b.ui.picture().rgb(static_cast<int>(at.x), static_cast<int>(at.y));
  };
  b.sun = {180.0, 60.0};
  const glm::vec3 day = zenith();
  EXPECT_GT(day.z, day.x + 0.1f) << "a blue sky";
  b.sun = {180.0, -15.0};
  const glm::vec3 night = zenith();
  EXPECT_LT(night.y, 0.25f);
  b.options.colour = [](const SkyAngles&) { return IM_COL32(255, 0, 0, 255); };
  EXPECT_GT(zenith().x, 0.95f) << "colours that are passed in are shown";
}

struct LightBench {
  Harness ui{460, 480};
  std::vector<scene::SunAngles> lights{{0, 45}, {120, 30}, {240, 60}};
  bool editable = true;
  std::optional<SkyAngles> sun;
  const HemisphereValues* values = nullptr;
  LightPalette palette;
  LightEvents last;
  int changes = 0, finishes = 0;

  LightBench() {
    ui.show([this] {
      const LightEvents events = palette.draw("p", lights, editable, 400, sun, values);
      if (events.changed || events.finished) last = events;
      changes += events.changed ? 1 : 0;
      finishes += events.finished ? 1 : 0;
    });
  }
  ImVec2 light(int i) const { return ui.at("light:p:" + std::to_string(i)); }
  ImVec2 place(double azimuth, double elevation) const {
    const ItemLog::Item item = ui.item("lights:p");
    const float radius = std::floor(0.5f * (item.max.x - item.min.x) - 22.0f);
    return discScreen(item.centre(), radius, discPlace({azimuth, elevation}, DiscMap::EqualArea));
  }
};

TEST(LightPalette, DragsMoveALightInOneStep) {
  LightBench b;
  b.ui.drag(b.light(1), b.place(80, 50), 6);
  EXPECT_NEAR(b.lights[1].azimuthDeg, 80.0, 0.7);
  EXPECT_NEAR(b.lights[1].elevationDeg, 50.0, 0.7);
  EXPECT_EQ(b.finishes, 1);
  EXPECT_EQ(b.last.label, "move light");
  EXPECT_EQ(b.palette.selection(), PointSelection{1});
  b.ui.drag(b.light(1), ImVec2(2000, b.place(90, 0).y));
  EXPECT_EQ(b.lights[1].elevationDeg, 0.0) << "lights stay above the horizon";
}

TEST(LightPalette, DoubleClickAddsAndDeleteRemoves) {
  LightBench b;
  b.ui.doubleClickAt(b.place(300, 20));
  ASSERT_EQ(b.lights.size(), 4u);
  EXPECT_NEAR(b.lights[3].azimuthDeg, 300.0, 0.7);
  EXPECT_NEAR(b.lights[3].elevationDeg, 20.0, 0.7);
  EXPECT_EQ(b.finishes, 1);
  b.ui.key(ImGuiKey_Delete);
  EXPECT_EQ(b.lights.size(), 3u);
  EXPECT_EQ(b.last.label, "delete light");
  const ItemLog::Item item = b.ui.item("lights:p");
  b.ui.doubleClickAt(ImVec2(item.min.x + 4, item.min.y + 4));
  EXPECT_EQ(b.lights.size(), 3u) << "the corner is no direction";
}

TEST(LightPalette, SeveralAreSelectedAndMoved) {
  LightBench b;
  b.ui.clickAt(b.light(0));
  b.ui.hold(false, true, false);
  b.ui.clickAt(b.light(2));
  b.ui.hold(false, false, false);
  EXPECT_EQ(b.palette.selection(), (PointSelection{0, 2}));
  const ImVec2 from = b.light(0), other = b.light(2);
  b.ui.drag(from, ImVec2(from.x + 20, from.y + 15));
  EXPECT_NEAR(b.light(2).x, other.x + 20, 1.5);
  EXPECT_NEAR(b.light(2).y, other.y + 15, 1.5);
  EXPECT_EQ(b.finishes, 1);
  EXPECT_EQ(b.last.label, "move lights");
  const ItemLog::Item item = b.ui.item("lights:p");
  b.ui.drag(ImVec2(item.min.x + 3, item.min.y + 3), ImVec2(item.max.x - 3, item.max.y - 3));
  EXPECT_EQ(b.palette.selection().size(), 3u);
}

TEST(LightPalette, APatternIsOnlyShown) {
  LightBench b;
  b.editable = false;
  const auto before = b.lights;
  b.ui.drag(b.light(1), b.place(80, 50));
  b.ui.doubleClickAt(b.place(300, 20));
  b.ui.clickAt(b.light(0));
  b.ui.key(ImGuiKey_Delete);
  EXPECT_EQ(b.lights, before);
  EXPECT_EQ(b.changes + b.finishes, 0);
  EXPECT_EQ(b.palette.selection(), PointSelection{0});
}

TEST(LightPalette, ValuesArePaintedWhereTheyBelong) {
  LightBench b;
  b.ui.moveTo(ImVec2(1, 1));
  HemisphereValues values;
  values.side = 32;
  values.title = "Coverage";
  for (int row = 0; row < 32; ++row) {
    for (int column = 0; column < 32; ++column) {
      // Light in the north-east, dark in the south-west.
      const glm::dvec2 place = HemisphereValues::place(32, column, row);
      values.values.push_back(place.x > 0 && place.y > 0 ? 1.0f : 0.0f);
    }
  }
  b.values = &values;
  b.ui.frames(2);
  const image::Image picture = b.ui.picture();
  const auto at = [&](double azimuth) {
    const ImVec2 p = b.place(azimuth, 20);
    return picture.rgb(static_cast<int>(p.x), static_cast<int>(p.y));
  };
  const auto ramp = [](double t) {
    const ImVec4 c = ImGui::ColorConvertU32ToFloat4(rampColour(t));
    return glm::vec3(c.x, c.y, c.z);
  };
  EXPECT_LT(glm::distance(at(50), ramp(1.0)), 0.05f);
  EXPECT_LT(glm::distance(at(230), ramp(0.0)), 0.05f);
}

TEST(LightPalette, TheRampGetsLighterAllTheWay) {
  double before = 0.0;
  for (int i = 0; i <= 20; ++i) {
    const double light = contrast(rampColour(i / 20.0), IM_COL32_BLACK);
    EXPECT_GT(light, before) << i;
    before = light;
  }
}

TEST(LightPalette, TheSunIsShownWhileItIsUp) {
  LightBench b;
  EXPECT_FALSE(b.ui.has("lights:p:sun"));
  b.sun = SkyAngles{200, 30};
  b.ui.frames(2);
  ASSERT_TRUE(b.ui.has("lights:p:sun"));
  EXPECT_NEAR(b.ui.at("lights:p:sun").x, b.place(200, 30).x, 1.0);
  b.sun = SkyAngles{200, -3};
  b.ui.frames(2);
  EXPECT_FALSE(b.ui.has("lights:p:sun"));
}

}  // namespace
}  // namespace sward::editor
