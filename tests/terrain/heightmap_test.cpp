#include "terrain/heightmap.h"

#include "base/file.h"
#include "base/random.h"
#include "image/io.h"
#include "terrain/files.h"

#include <algorithm>
#include <clocale>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>

#include <unistd.h>

#include <gtest/gtest.h>

namespace sward::terrain {
namespace {

namespace fs = std::filesystem;

std::span<const std::byte> bytesOf(const std::string& text) {
  return std::as_bytes(std::span(text.data(), text.size()));
}

fs::path asset(const std::string& name) {
  return fs::path(SWARD_SHARED_DIR) / "assets" / "terrain" / name;
}

std::string errorOf(const Result<RawHeights>& result) {
  return result.ok() ? "no error" : result.error().text();
}

#define EXPECT_SAYS(result, words)                                             \
  do {                                                                         \
    const std::string text_ = errorOf(result);                                 \
    EXPECT_NE(text_.find(words), text_.npos) << text_ << "\nlacks: " << words; \
  } while (false)

std::string gridText(const std::string& header, const std::string& rows) {
  return "ncols 3\nnrows 2\nxllcorner 10\nyllcorner 20\n" + header + rows;
}

TEST(EsriGrid, ReadsRowsFromTheNorth) {
  const RawHeights raw = readEsriGrid(gridText("cellsize 2.5\n", "1 2 3\n4 5.5 +6e0\n"), "a.asc").value();
  EXPECT_EQ(raw.columns, 3);
  EXPECT_EQ(raw.rows, 2);
  EXPECT_EQ(raw.cell, glm::dvec2(2.5));
  EXPECT_FALSE(raw.degrees);
  EXPECT_EQ(raw.values, (std::vector<float>{4.0f, 5.5f, 6.0f, 1.0f, 2.0f, 3.0f}));
  EXPECT_EQ(raw.missing, 0u);
}

TEST(EsriGrid, HeadersInAnyFormAndLineEnds) {
  const RawHeights raw =
      readEsriGrid(
          "\xef\xbb\xbfNROWS 2\r\nNCOLS\t3\r\nXLLCENTER -1e1\r\nYLLCENTER 2\r\nDX 2\r\nDY 3\r\nnodata_VALUE -1\r\n1 2 "
          "-1\r\n\r\n-1.0 nan 6",
          "a.asc")
          .value();
  EXPECT_EQ(raw.cell, glm::dvec2(2.0, 3.0));
  EXPECT_EQ(raw.missing, 3u);
  EXPECT_EQ(raw.known, (std::vector<float>{0, 0, 1, 1, 1, 0}));
}

TEST(EsriGrid, TheLocaleDoesNotMatter) {
  const char* const set = std::setlocale(LC_ALL, "de_DE.UTF-8");
  const RawHeights raw = readEsriGrid(gridText("cellsize 2.5\n", "1.5 2 3 4 5 6"), "a.asc").value();
  if (set != nullptr) std::setlocale(LC_ALL, "C");
  EXPECT_EQ(raw.values[3], 1.5f);
  EXPECT_SAYS(readEsriGrid(gridText("cellsize 1\n", "1,5 2 3 4 5 6"), "a.asc"), "a.asc:6: \"1,5\" is no number");
}

TEST(EsriGrid, MissingWithoutAHeaderLineIsMinus9999) {
  const RawHeights raw = readEsriGrid(gridText("cellsize 1\n", "-9999 2 3\n-9.999e3 5 6"), "a.asc").value();
  EXPECT_EQ(raw.missing, 2u);
  // With a line of its own, -9999 is a height like any other.
  EXPECT_EQ(readEsriGrid(gridText("cellsize 1\nNODATA_value -1\n", "-9999 2 3 4 5 6"), "a.asc").value().missing, 0u);
}

TEST(EsriGrid, BadFilesSayWhatWhereAndHow) {
  const auto read = [](const std::string& text) { return readEsriGrid(text, "a.asc"); };
  EXPECT_SAYS(read(""), "the header has no ncols");
  EXPECT_SAYS(read("ncols 3\n1 2 3"), "the header has no nrows");
  EXPECT_SAYS(read(gridText("cellsize -5\n", "1 2 3 4 5 6")), "a.asc:5: the cell size (cellsize) is not above 0");
  EXPECT_SAYS(read(gridText("cellsize 0\n", "1 2 3 4 5 6")), "is not above 0");
  EXPECT_SAYS(read(gridText("cellsize nan\n", "1 2 3 4 5 6")), "is not above 0");
  EXPECT_SAYS(read(gridText("cellsize x\n", "1 2 3 4 5 6")), "a.asc:5: the value of cellsize is no number: \"x\"");
  EXPECT_SAYS(read(gridText("cellsize 1\ncellsize 1\n", "1 2 3 4 5 6")), "a.asc:6: the header names cellsize twice");
  EXPECT_SAYS(read(gridText("cellsise 1\n", "1 2 3 4 5 6")), "a.asc:5: \"cellsise\" is no line");
  EXPECT_SAYS(read(gridText("cellsize 1\n", "1 2 3\n4 nan 6")), "a.asc:7: a height is not a number (nan)");
  EXPECT_SAYS(read(gridText("cellsize 1\n", "1 2 3\n4 inf 6")), "a.asc:7: a height is infinite");
  EXPECT_SAYS(read(gridText("cellsize 1\n", "1 2 3\n4 -1e999 6")), "a.asc:7: a height is infinite");
  EXPECT_TRUE(read(gridText("cellsize 1\n", "1 2 3\n4 1e-999 6")).ok());
  EXPECT_SAYS(read(gridText("cellsize 1\n", "1 2 3\n4 5m 6")), "a.asc:7: \"5m\" is no number");
  EXPECT_SAYS(read(gridText("cellsize 1\n", "1 2 3\n4 5555555")), "a.asc:7: the grid ends after 5 of 6 values");
  EXPECT_SAYS(read(gridText("cellsize 1\n", "1 2")), "a.asc:6: the grid ends after 2 of 6 values");
  EXPECT_SAYS(read("ncols 30\nnrows 20\ncellsize 1\n1 2"), "too short for 600 values");
  EXPECT_SAYS(read(gridText("cellsize 1\n", "1 2 3\n4 5 6\n7")), "a.asc:8: the grid has more than 6 values");
  EXPECT_SAYS(read(gridText("cellsize 1\nNODATA_value 7\n", "7 7 7\n7 7 7")), "no data anywhere");
  EXPECT_SAYS(read("ncols 1\nnrows 1\ncellsize 1\n5"), "1 x 1 has no surface");
  EXPECT_SAYS(read("ncols 1\nnrows 5\ncellsize 1\n5 5 5 5 5"), "1 x 5 has no surface");
  EXPECT_SAYS(read("ncols 100000\nnrows 2\ncellsize 1\n5"), "a.asc:1: a heightmap of 100000 x 2 is too large");
  EXPECT_SAYS(read("ncols 1e300\nnrows 2\ncellsize 1\n5"), "is too large");
  EXPECT_SAYS(read("ncols -3\nnrows 2\ncellsize 1\n5"), "a.asc:1: ncols is not a whole number above 0");
  EXPECT_SAYS(read("ncols 2.5\nnrows 2\ncellsize 1\n5"), "ncols is not a whole number above 0");
  EXPECT_SAYS(read("ncols 16000\nnrows 2000\ncellsize 1\n5"), "too short for 32000000 values");
}

TEST(EsriGrid, EveryTruncationIsAnErrorOrWhole) {
  const std::string text = gridText("cellsize 1\nNODATA_value -9999\n", "100 200 300\n400 500 600\n");
  for (std::size_t n = 0; n < text.size(); ++n) {
    const auto result = readEsriGrid(std::string_view(text).substr(0, n), "a.asc");
    // Only the last value may lose digits and stay a number.
    EXPECT_TRUE(!result.ok() || n + 3 >= text.size()) << n;
  }
}

TEST(HeightImage, SixteenBitsKeepTheirPrecision) {
  const std::vector<std::uint32_t> samples{0, 1, 2, 32767, 32768, 65535};
  for (const std::string& file : {files::greyPng(3, 2, 16, samples), files::greyTiff(3, 2, 16, samples)}) {
    const RawHeights raw = readHeightImage(bytesOf(file), "a").value();
    ASSERT_TRUE(raw.integer);
    EXPECT_EQ(raw.bits, 16);
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const std::size_t at = (1 - i / 3) * 3 + i % 3;
      EXPECT_NEAR(static_cast<double>(raw.values[at]) * 65535.0, samples[i], 0.01);
    }
  }
}

TEST(HeightImage, FloatsAreHeightsAndKeepMissingOnes) {
  std::vector<std::uint32_t> samples;
  for (const float h : {1771.25f, -9999.0f, 3.0f, -3.4028235e38f, 5.0f, 6.0f}) samples.push_back(files::floatBits(h));
  const RawHeights raw = readHeightImage(bytesOf(files::greyTiff(3, 2, 32, samples)), "a").value();
  EXPECT_FALSE(raw.integer);
  EXPECT_EQ(raw.missing, 2u);
  EXPECT_EQ(raw.values[3], 1771.25f);
  EXPECT_EQ(raw.known, (std::vector<float>{0, 1, 1, 1, 0, 1}));
}

TEST(HeightImage, ExrIsRead) {
  const fs::path path = fs::temp_directory_path() / ("sward_heights_" + std::to_string(::getpid()) + ".exr");
  image::Image picture(4, 3, 1);
  for (std::size_t i = 0; i < 12; ++i) picture.pixels[i] = static_cast<float>(i) * 8.0f;
  ASSERT_TRUE(image::writeExr(path, picture).ok());
  const auto raw = readHeights(path);
  fs::remove(path);
  ASSERT_TRUE(raw.ok()) << raw.error().text();
  EXPECT_FALSE(raw->integer);
  EXPECT_EQ(raw->values[0], 64.0f);  // the south-west is the last row's first
  EXPECT_EQ(raw->values[11], 24.0f);
}

TEST(HeightImage, BadImagesAreRefused) {
  const auto read = [](const std::string& file) { return readHeightImage(bytesOf(file), "a.png"); };
  EXPECT_SAYS(read(files::greyPng(1, 1, 8, {7})), "1 x 1 has no surface");
  EXPECT_SAYS(read(files::greyPng(100000, 2, 8, {7})), "a heightmap of 100000 x 2 is too large");
  EXPECT_SAYS(read(files::greyPng(16000, 16000, 8, {7})), "a heightmap of 16000 x 16000 is too large");
  EXPECT_SAYS(read(""), "the image is empty");
  EXPECT_SAYS(read("GIF89a"), "GIF images are not supported");
  const std::string whole = files::greyPng(3, 2, 8, {1, 2, 3, 4, 5, 6});
  EXPECT_TRUE(read(whole).ok());
  for (std::size_t n = 0; n < whole.size(); ++n) EXPECT_FALSE(read(whole.substr(0, n)).ok()) << n;
  const auto tiff = [&](float odd) {
    std::vector<std::uint32_t> samples(4, files::floatBits(1.0f));
    samples[2] = files::floatBits(odd);
    return read(files::greyTiff(2, 2, 32, samples));
  };
  EXPECT_SAYS(tiff(std::nanf("")), "a height is not a number, in column 0 of row 1");
  EXPECT_SAYS(tiff(std::numeric_limits<float>::infinity()), "a height is not a number");
  EXPECT_SAYS(read(files::greyTiff(2, 2, 32, std::vector<std::uint32_t>(4, files::floatBits(-9999.0f)))),
              "no data anywhere");
  EXPECT_SAYS(readHeights("/nowhere/heights.png"), "/nowhere/heights.png");
}

RawHeights rawOf(int columns, int rows, float value) {
  RawHeights raw;
  raw.columns = columns;
  raw.rows = rows;
  raw.values.assign(static_cast<std::size_t>(columns * rows), value);
  return raw;
}

TEST(Heightmap, ExtentsScalesAndPlace) {
  RawHeights raw = rawOf(11, 6, 0.5f);
  raw.integer = true;
  raw.bits = 16;
  HeightmapOptions options;
  options.extentXM = 100.0;
  options.heightLowM = 10.0;
  options.heightHighM = 30.0;
  options.position = {7.0, -2.0, 100.0};
  const auto field = HeightField::create(makeHeightmap(raw, options).value().grid).value();
  EXPECT_EQ(field->grid().cellM, glm::dvec2(10.0));
  EXPECT_NEAR(field->height({7.0, -2.0}), 120.0, 1e-4);
  // The map's corner: 50 m west and 25 m south of the middle is a sample.
  const glm::dvec2 samples = (glm::dvec2(-43.0, -27.0) - field->grid().origin) / field->grid().cellM;
  EXPECT_NEAR(samples.x, std::round(samples.x), 1e-9);
  EXPECT_NEAR(samples.y, std::round(samples.y), 1e-9);

  raw = rawOf(3, 3, 4.0f);
  options = {};
  options.verticalScale = 0.5;
  raw.cell = {3.0, 4.0};
  const auto floats = makeHeightmap(raw, options).value();
  EXPECT_EQ(floats.grid.cellM, glm::dvec2(3.0, 4.0));
  EXPECT_EQ(floats.grid.heights[0], 2.0f);
  EXPECT_TRUE(floats.warnings.empty());
  // A width given, cells keep their form.
  options.extentXM = 12.0;
  EXPECT_EQ(makeHeightmap(raw, options).value().grid.cellM, glm::dvec2(6.0, 8.0));
}

TEST(Heightmap, MissingHeightsAreFilledAndCounted) {
  RawHeights raw = rawOf(9, 9, 5.0f);
  raw.known.assign(81, 1.0f);
  for (const std::size_t i : {40u, 41u, 0u}) {
    raw.known[i] = 0.0f;
    raw.values[i] = -9999.0f;
    ++raw.missing;
  }
  const Heightmap map = makeHeightmap(raw, {}).value();
  for (const float h : map.grid.heights) EXPECT_NEAR(h, 5.0f, 1e-5f);
  ASSERT_FALSE(map.warnings.empty());
  EXPECT_EQ(map.warnings.back().find("3 of 81 heights are missing"), 0u) << map.warnings.back();
}

TEST(Heightmap, RunsOutToALevelPlain) {
  RawHeights raw = rawOf(40, 24, 0.0f);
  base::Random random(8);
  for (float& h : raw.values) h = static_cast<float>(random.uniform(0.0, 10.0));
  const auto field = HeightField::create(makeHeightmap(raw, {}).value().grid).value();
  const double far = field->height({1e5, 1e5});
  for (int i = 0; i < 64; ++i) {
    const glm::dvec2 away(std::cos(i * 0.1), std::sin(i * 0.1));
    EXPECT_NEAR(field->height(away * 200.0), far, 1e-5);
    EXPECT_LT(glm::length(field->sample(away * 200.0).gradient), 1e-6);
  }
  EXPECT_NEAR(far, 5.0, 1.0);
}

TEST(Heightmap, SmoothingKeepsTheMeanAndLowersTheNoise) {
  RawHeights raw = rawOf(64, 64, 0.0f);
  raw.cell = glm::dvec2(1.0);
  base::Random random(9);
  for (float& h : raw.values) h = static_cast<float>(random.uniform(-1.0, 1.0));
  HeightmapOptions options;
  const auto rms = [](const HeightGrid& grid) {
    double sum = 0.0;
    for (int y = 24; y < 56; ++y)
      for (int x = 24; x < 56; ++x) sum += static_cast<double>(grid.at(x, y) * grid.at(x, y));
    return std::sqrt(sum / 1024.0);
  };
  const double rough = rms(makeHeightmap(raw, options).value().grid);
  options.smoothM = 2.0;
  // A Gaussian of deviation s leaves white noise 1 / (2 sqrt(pi) s) of its deviation: 0.141; a sample of some 40
  // independent values scatters by a tenth of that.
  EXPECT_NEAR(rms(makeHeightmap(raw, options).value().grid) / rough, 0.141, 0.05);
}

TEST(Heightmap, BadValuesAreRefused) {
  HeightmapOptions options;
  options.extentXM = -5.0;
  EXPECT_FALSE(makeHeightmap(rawOf(3, 3, 1.0f), options).ok());
  options.extentXM = std::nan("");
  EXPECT_FALSE(makeHeightmap(rawOf(3, 3, 1.0f), options).ok());
  EXPECT_FALSE(makeHeightmap(rawOf(3, 3, 1e7f), {}).ok());
  TerrainOptions terrain;
  terrain.source = Source::Heightmap;
  EXPECT_FALSE(makeTerrain(terrain, "/").ok());
  terrain.heightmap.path = "nowhere.png";
  const auto missing = makeTerrain(terrain, "/");
  ASSERT_FALSE(missing.ok());
  EXPECT_NE(missing.error().text().find("nowhere.png"), std::string::npos);
  terrain.source = Source::Flat;
  EXPECT_EQ(makeTerrain(terrain, "/").value().field, nullptr);
}

/// Every value of a map is near the metres that are expected of it.
struct Expected {
  const char* file;
  int columns, rows;
  double low, high;
  std::size_t missing;
};

TEST(Assets, AllOfThemAreRead) {
  if (!fs::exists(asset(""))) GTEST_SKIP() << "no shared assets";
  // 8-bit images run from 0 to 60 m; the mask is a half-float image of 0 to 1.
  const Expected all[] = {{"quickgrass_terrain_1024.png", 1024, 1024, 0.0, 60.0, 0},
                          {"threeterrain_heightmap_64.png", 64, 64, 0.0, 60.0, 0},
                          {"west_bijou_escarpment_129x67.asc", 129, 67, 1650.0, 1830.0, 0},
                          {"bruno_terrainGrass_512.exr", 512, 512, 0.0, 1.0, 0}};
  for (const Expected& e : all) {
    const auto raw = readHeights(asset(e.file));
    ASSERT_TRUE(raw.ok()) << raw.error().text();
    EXPECT_EQ(raw->columns, e.columns) << e.file;
    EXPECT_EQ(raw->rows, e.rows) << e.file;
    EXPECT_EQ(raw->missing, e.missing) << e.file;
    TerrainOptions options;
    options.source = Source::Heightmap;
    options.heightmap.path = e.file;
    const auto terrain = makeTerrain(options, asset(""));
    ASSERT_TRUE(terrain.ok()) << terrain.error().text();
    const HeightRange range = terrain->field->range();
    // Bezier points overshoot by a sixth of the range along one axis, by a sixth of 4/3 more along the other.
    const double over = (1.0 / 6.0 + 4.0 / 18.0) * (e.high - e.low) + 1e-5;
    EXPECT_GE(range.low, e.low - over) << e.file;
    EXPECT_LE(range.high, e.high + over) << e.file;
    EXPECT_GT(range.high - range.low, 0.2 * (e.high - e.low)) << e.file;
  }
}

TEST(Assets, DegreesBecomeMetresAndTheRingIsMissing) {
  if (!fs::exists(asset(""))) GTEST_SKIP() << "no shared assets";
  const RawHeights bijou = readHeights(asset("west_bijou_escarpment_129x67.asc")).value();
  EXPECT_TRUE(bijou.degrees);
  const Heightmap map = makeHeightmap(bijou, {}).value();
  // One arc second: 30.9 m north-south; times cos(39.5 degrees) = 0.7716 east-west.
  EXPECT_NEAR(map.grid.cellM.y, 30.92, 0.01);
  EXPECT_NEAR(map.grid.cellM.x, 30.92 * 0.7716, 0.02);
  EXPECT_EQ(bijou.values[static_cast<std::size_t>(66 * 129)],
            1771.0f);  // the north-west corner comes first in the file
  ASSERT_EQ(map.warnings.size(), 1u);

  const RawHeights hugo = readHeights(asset("hugo_site_filled_76x55.asc")).value();
  EXPECT_EQ(hugo.cell, glm::dvec2(10.0));
  // The ring alone is 2 * 76 + 2 * 53 cells.
  EXPECT_GE(hugo.missing, 258u);
  const Heightmap filled = makeHeightmap(hugo, {}).value();
  ASSERT_EQ(filled.warnings.size(), 1u);
  const auto [low, high] = std::minmax_element(filled.grid.heights.begin(), filled.grid.heights.end());
  float knownLow = 1e9f, knownHigh = -1e9f;
  for (std::size_t i = 0; i < hugo.values.size(); ++i) {
    if (hugo.known[i] == 0.0f) continue;
    knownLow = std::min(knownLow, hugo.values[i]);
    knownHigh = std::max(knownHigh, hugo.values[i]);
  }
  EXPECT_GE(*low, knownLow - 1e-3f);
  EXPECT_LE(*high, knownHigh + 1e-3f);
}

}  // namespace
}  // namespace sward::terrain
