#include "image/io.h"

#include "base/file.h"
#include "base/random.h"
#include "image/colour.h"

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>

#include <cmath>
#include <csignal>
#include <cstring>
#include <limits>
#include <sys/resource.h>
#include <unistd.h>

namespace sward::image {
namespace {

namespace fs = std::filesystem;

/// An empty folder that lives as long as the test.
class ImageIo : public ::testing::Test {
 protected:
  void SetUp() override {
    m_folder = fs::temp_directory_path() / ("sward-image-" + std::to_string(::getpid()) + "-" +
                                            ::testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::create_directories(m_folder);
  }
  void TearDown() override {
    std::error_code code;
    fs::permissions(m_folder, fs::perms::owner_all, code);
    fs::remove_all(m_folder, code);
  }
  std::size_t filesInFolder() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(m_folder), fs::directory_iterator()));
  }
  fs::path m_folder;
};

Image gradient(int width, int height, int channels) {
  Image image(width, height, channels);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      for (int c = 0; c < channels; ++c) {
        image.at(x, y, c) = static_cast<float>((x * 37 + y * 11 + c * 91) % 256) / 255.0f;
      }
    }
  }
  return image;
}

TEST_F(ImageIo, pngRoundTripsEveryCodeValue) {
  for (const int channels : {1, 3, 4}) {
    const fs::path path = m_folder / ("round" + std::to_string(channels) + ".png");
    const Image image = gradient(64, 33, channels);
    ASSERT_TRUE(writePng(path, image).ok());
    const Result<Image> linear = readImage(path, Encoding::Linear);
    ASSERT_TRUE(linear.ok()) << linear.error().text();
    ASSERT_EQ(linear->width, 64);
    ASSERT_EQ(linear->height, 33);
    ASSERT_EQ(linear->channels, channels);
    for (std::size_t i = 0; i < image.pixels.size(); ++i) ASSERT_NEAR(linear->pixels[i], image.pixels[i], 1e-6f) << i;
  }
}

TEST_F(ImageIo, srgbDecodesColourButNeverAlpha) {
  const fs::path path = m_folder / "rgba.png";
  const Image image = gradient(16, 16, 4);
  ASSERT_TRUE(writePng(path, image).ok());
  const Result<Image> decoded = readImage(path, Encoding::Srgb);
  ASSERT_TRUE(decoded.ok()) << decoded.error().text();
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    const float expected = i % 4 == 3 ? image.pixels[i] : linearFromSrgb(image.pixels[i]);
    ASSERT_NEAR(decoded->pixels[i], expected, 1e-6f) << i;
  }
}

TEST_F(ImageIo, pngCarriesAnSrgbTag) {
  const fs::path path = m_folder / "tag.png";
  ASSERT_TRUE(writePng(path, gradient(4, 4, 3)).ok());
  const Result<std::vector<std::byte>> bytes = base::readFile(path);
  ASSERT_TRUE(bytes.ok());
  const std::string text(reinterpret_cast<const char*>(bytes->data()), bytes->size());
  EXPECT_NE(text.find("sRGB"), std::string::npos);
}

TEST_F(ImageIo, pngClampsAndSurvivesNan) {
  Image image(3, 1, 1);
  image.pixels = {-1.0f, 7.0f, std::numeric_limits<float>::quiet_NaN()};
  const Result<std::vector<std::byte>> bytes = encodePng(image);
  ASSERT_TRUE(bytes.ok());
  const Result<Image> back = readImage(*bytes, "clamped", Encoding::Linear);
  ASSERT_TRUE(back.ok()) << back.error().text();
  EXPECT_EQ(back->pixels, (std::vector<float>{0.0f, 1.0f, 0.0f}));
}

TEST_F(ImageIo, exrRoundTripsHalfPrecisionAndStraightAlpha) {
  const fs::path path = m_folder / "values.exr";
  Image image(17, 9, 4);
  base::Random random(3);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    image.pixels[i] = static_cast<float>(i % 4 == 3 ? random.uniform(0.05, 1.0) : random.uniform(0.0, 20.0));
  }
  ASSERT_TRUE(writeExr(path, image).ok());
  const Result<Image> back = readImage(path);
  ASSERT_TRUE(back.ok()) << back.error().text();
  ASSERT_EQ(back->channels, 4);
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    // Two roundings to 11 bits, of the product and of alpha: 2 * 2^-11, and second-order terms.
    ASSERT_NEAR(back->pixels[i], image.pixels[i], 1.01f * 0x1p-10f * image.pixels[i]) << i;
  }
}

TEST_F(ImageIo, exrIsHalfFloatZipWithRec709Primaries) {
  const fs::path path = m_folder / "header.exr";
  Image image(8, 8, 1, 1e9f);
  ASSERT_TRUE(writeExr(path, image).ok());
  const auto input = OIIO::ImageInput::open(path.string());
  ASSERT_TRUE(input) << OIIO::geterror();
  EXPECT_EQ(input->spec().format, OIIO::TypeDesc::HALF);
  EXPECT_EQ(input->spec().get_string_attribute("compression"), "zip");
  EXPECT_EQ(input->spec().channelnames.at(0), "Y");
  EXPECT_NE(input->spec().find_attribute("chromaticities"), nullptr);
  const Result<Image> back = readImage(path);
  ASSERT_TRUE(back.ok());
  EXPECT_EQ(back->pixels[0], 65504.0f);  // clamped, not infinite
}

TEST_F(ImageIo, writersRefuseWhatTheyCannotWrite) {
  EXPECT_FALSE(writePng(m_folder / "none.png", Image()).ok());
  EXPECT_FALSE(writePng(m_folder / "two.png", Image(4, 4, 2)).ok());
  EXPECT_FALSE(writeExr(m_folder / "two.exr", Image(4, 4, 2)).ok());
  Image wrong(4, 4, 3);
  wrong.pixels.pop_back();
  EXPECT_FALSE(writePng(m_folder / "short.png", wrong).ok());
  EXPECT_EQ(filesInFolder(), 0u);
}

TEST_F(ImageIo, aMissingFolderIsNamed) {
  const Result<void> missing = writePng(m_folder / "nowhere" / "a.png", gradient(4, 4, 3));
  ASSERT_FALSE(missing.ok());
  EXPECT_NE(missing.error().text().find("nowhere"), std::string::npos);
  EXPECT_FALSE(missing.error().remedy.empty());
  EXPECT_EQ(filesInFolder(), 0u);
}

TEST_F(ImageIo, aWriteThatRunsOutOfRoomKeepsTheOldFile) {
  const fs::path path = m_folder / "kept.png";
  ASSERT_TRUE(writePng(path, gradient(4, 4, 3)).ok());
  const auto before = fs::file_size(path);
  // A limit on file sizes stands in for a full disk: write(2) fails part of the way.
  rlimit old{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &old), 0);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small{200, old.rlim_max};
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
  const Result<void> written = writePng(path, gradient(256, 256, 3));
  ::setrlimit(RLIMIT_FSIZE, &old);
  std::signal(SIGXFSZ, handler);
  ASSERT_FALSE(written.ok());
  EXPECT_EQ(written.error().kind, ErrorKind::Failed);
  EXPECT_EQ(fs::file_size(path), before);
  EXPECT_EQ(filesInFolder(), 1u);
}

TEST_F(ImageIo, aReadOnlyFolderIsAClearError) {
  if (::geteuid() == 0) GTEST_SKIP() << "root may write everywhere";
  fs::permissions(m_folder, fs::perms::owner_read | fs::perms::owner_exec);
  const Result<void> written = writeExr(m_folder / "a.exr", gradient(4, 4, 3));
  fs::permissions(m_folder, fs::perms::owner_all);
  ASSERT_FALSE(written.ok());
  EXPECT_EQ(written.error().kind, ErrorKind::Failed);
  EXPECT_FALSE(written.error().remedy.empty());
  EXPECT_EQ(filesInFolder(), 0u);
}

TEST_F(ImageIo, missingAndForeignFilesAreErrors) {
  const Result<Image> missing = readImage(m_folder / "missing.png");
  ASSERT_FALSE(missing.ok());
  EXPECT_NE(missing.error().text().find("missing.png"), std::string::npos);
  const std::string webp = "RIFF....WEBPVP8 ";
  const Result<Image> foreign = readImage(std::as_bytes(std::span(webp)), "leaf.webp");
  ASSERT_FALSE(foreign.ok());
  EXPECT_NE(foreign.error().text().find("WebP"), std::string::npos);
  EXPECT_FALSE(readImage(std::span<const std::byte>(), "nothing").ok());
}

/// A PNG whose header claims another size, with the checksum put right.
std::vector<std::byte> pngClaiming(std::uint32_t width, std::uint32_t height) {
  Result<std::vector<std::byte>> bytes = encodePng(gradient(8, 8, 3));
  std::vector<std::byte> png = std::move(bytes).value();
  const auto put = [&](std::size_t at, std::uint32_t value) {
    for (int i = 0; i < 4; ++i) png[at + static_cast<std::size_t>(i)] = static_cast<std::byte>(value >> (24 - 8 * i));
  };
  put(16, width);
  put(20, height);
  std::uint32_t crc = 0xffffffffu;
  for (std::size_t i = 12; i < 29; ++i) {
    crc ^= static_cast<std::uint32_t>(png[i]);
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ ((crc & 1u) != 0 ? 0xedb88320u : 0u);
  }
  put(29, ~crc);
  return png;
}

TEST_F(ImageIo, hostileSizesAreRefused) {
  for (const auto& [width, height] : {std::pair{40000u, 8u}, {8u, 1000000u}, {32768u, 32768u}, {0u, 8u}}) {
    const Result<Image> read = readImage(pngClaiming(width, height), "hostile.png");
    ASSERT_FALSE(read.ok()) << width << " x " << height;
    EXPECT_NE(read.error().text().find("hostile.png"), std::string::npos);
  }
}

TEST_F(ImageIo, everyTruncatedLengthEndsWithoutACrash) {
  const Result<std::vector<std::byte>> png = encodePng(gradient(24, 24, 4));
  ASSERT_TRUE(png.ok());
  const fs::path path = m_folder / "whole.exr";
  ASSERT_TRUE(writeExr(path, gradient(24, 24, 4)).ok());
  const Result<std::vector<std::byte>> exr = base::readFile(path);
  ASSERT_TRUE(exr.ok());
  for (const std::vector<std::byte>* whole : {&*png, &*exr}) {
    int refused = 0;
    for (std::size_t length = 0; length < whole->size(); length += 1 + length / 64) {
      refused += readImage(std::span(whole->data(), length), "cut").ok() ? 0 : 1;
    }
    EXPECT_GT(refused, 20);
  }
}

TEST_F(ImageIo, flippedBytesEndWithoutACrash) {
  const Result<std::vector<std::byte>> png = encodePng(gradient(24, 24, 3));
  ASSERT_TRUE(png.ok());
  const fs::path path = m_folder / "whole.exr";
  ASSERT_TRUE(writeExr(path, gradient(16, 16, 3)).ok());
  const Result<std::vector<std::byte>> exr = base::readFile(path);
  ASSERT_TRUE(exr.ok());
  base::Random random(17);
  int refused = 0;
  for (int trial = 0; trial < 600; ++trial) {
    std::vector<std::byte> bytes = trial % 2 == 0 ? *png : *exr;
    for (int flips = 0; flips < 3; ++flips) {
      bytes[random.index(static_cast<std::uint32_t>(bytes.size()))] = static_cast<std::byte>(random.index(256));
    }
    refused += readImage(bytes, "flipped").ok() ? 0 : 1;
  }
  EXPECT_GT(refused, 0);
}

TEST_F(ImageIo, readsRadianceFiles) {
  const fs::path path = fs::path(SWARD_SHARED_DIR) / "assets/env/venice_sunset_1k.hdr";
  if (!fs::exists(path)) GTEST_SKIP() << path << " is absent";
  const Result<Image> sky = readImage(path);
  ASSERT_TRUE(sky.ok()) << sky.error().text();
  EXPECT_EQ(sky->width, 1024);
  EXPECT_EQ(sky->height, 512);
  float brightest = 0.0f;
  for (const float value : sky->pixels) brightest = std::max(brightest, value);
  EXPECT_GT(brightest, 1.0f);
}

TEST_F(ImageIo, knowsWhatItWrites) {
  EXPECT_TRUE(canWriteImage("a/b.PNG"));
  EXPECT_TRUE(canWriteImage("x.exr"));
  EXPECT_FALSE(canWriteImage("x.jpg"));
  EXPECT_FALSE(canWriteImage("png"));
}

}  // namespace
}  // namespace sward::image
