#include "image/io.h"

#include "image/colour.h"
#include "image/io_common.h"
#include "image/png_check.h"

#include "base/file.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <memory>
#include <string_view>

namespace sward::image {
namespace {

constexpr const char* kDamagedRemedy = "Export the image again; it is damaged or cut short.";

bool startsWith(std::span<const std::byte> data, std::string_view magic) {
  return data.size() >= magic.size() && std::memcmp(data.data(), magic.data(), magic.size()) == 0;
}

/// OpenImageIO's name of the format that the first bytes announce, or nullptr. Only these readers ever see the data.
const char* formatOf(std::span<const std::byte> data) {
  using namespace std::string_view_literals;
  if (startsWith(data, "\x89PNG\r\n\x1a\n"sv)) return "png";
  if (startsWith(data, "\xff\xd8\xff"sv)) return "jpeg";
  if (startsWith(data, "\x76\x2f\x31\x01"sv)) return "openexr";
  if (startsWith(data, "#?RADIANCE"sv) || startsWith(data, "#?RGBE"sv)) return "hdr";
  if (startsWith(data, "II*\0"sv) || startsWith(data, "MM\0*"sv)) return "tiff";
  return nullptr;
}

/// What the unsupported data seems to be, for the message.
std::string unsupportedText(std::span<const std::byte> data) {
  using namespace std::string_view_literals;
  if (data.empty()) return "the image is empty";
  if (startsWith(data, "RIFF"sv)) return "WebP images are not supported";
  if (startsWith(data, "\xabKTX"sv)) return "KTX images are not supported";
  if (startsWith(data, "DDS "sv)) return "DDS images are not supported";
  if (startsWith(data, "GIF8"sv)) return "GIF images are not supported";
  return "this is not an image that can be read";
}

/// Refuses sizes that no image of that many bytes has, before anything is allocated for them. The densest codec used
/// here (deflate) packs 1032 bytes into one; 4096 leaves room for headers that promise more bits than they hold.
Result<void> checkSize(const OIIO::ImageSpec& spec, std::size_t fileBytes, const std::string& name) {
  if (spec.width <= 0 || spec.height <= 0 || spec.nchannels <= 0 || spec.depth > 1) {
    return Error::badInput("the image has no pixels", name, kDamagedRemedy);
  }
  const auto pixels = static_cast<std::uint64_t>(spec.width) * static_cast<std::uint64_t>(spec.height);
  const std::string size = std::to_string(spec.width) + " x " + std::to_string(spec.height);
  if (spec.width > kMaxImageSide || spec.height > kMaxImageSide || pixels > (std::uint64_t{1} << 30)) {
    return Error::badInput("the image is too large (" + size + ")", name,
                           "Use at most " + std::to_string(kMaxImageSide) + " pixels a side and 2^30 in all.");
  }
  if (pixels > (std::uint64_t{64} << 20) + fileBytes * 4096) {
    return Error::badInput("the image claims " + size + " pixels, more than its bytes can hold", name, kDamagedRemedy);
  }
  return {};
}

void decodeSrgb(Image& image, int colourChannels, bool eightBit) {
  std::array<float, 256> table{};
  for (int i = 0; i < 256; ++i) table[static_cast<std::size_t>(i)] = linearFromSrgb(static_cast<float>(i) / 255.0f);
  const auto channels = static_cast<std::size_t>(image.channels);
  for (std::size_t p = 0; p < image.pixels.size(); p += channels) {
    for (std::size_t c = 0; c < static_cast<std::size_t>(colourChannels); ++c) {
      float& value = image.pixels[p + c];
      value = eightBit ? table[static_cast<std::size_t>(std::lround(std::clamp(value, 0.0f, 1.0f) * 255.0f))]
                       : linearFromSrgb(value);
    }
  }
}

void divideByAlpha(Image& image, int colourChannels) {
  const auto channels = static_cast<std::size_t>(image.channels);
  const auto colours = static_cast<std::size_t>(colourChannels);
  for (std::size_t p = 0; p < image.pixels.size(); p += channels) {
    const float alpha = image.pixels[p + colours];
    if (!(alpha > 0.0f) || alpha == 1.0f) continue;
    for (std::size_t c = 0; c < colours; ++c) image.pixels[p + c] /= alpha;
  }
}

/// An image in memory, opened; `memory` and `proxy` outlive the input that reads from them.
struct OpenImage {
  explicit OpenImage(std::span<const std::byte> data) : memory(data.data(), data.size()), proxy(&memory) {}
  OIIO::Filesystem::IOMemReader memory;
  OIIO::Filesystem::IOProxy* proxy;
  std::unique_ptr<OIIO::ImageInput> input;
  OIIO::ImageSpec spec;
};

Result<void> open(OpenImage& image, const char* format, const std::string& name) {
  image.input = OIIO::ImageInput::create(format);
  if (!image.input) {
    return Error::failed(std::string("this OpenImageIO cannot read ") + format + " images: " + OIIO::geterror(), name,
                         "Install the full OpenImageIO package.");
  }
  OIIO::ImageSpec config;
  config.attribute("oiio:UnassociatedAlpha", 1);
  config.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, &image.proxy);
  if (!image.input->open(std::string("memory.") + format, image.spec, config)) {
    return Error::badInput("the image cannot be read: " + image.input->geterror(), name, kDamagedRemedy);
  }
  return {};
}

Result<Image> decode(std::span<const std::byte> data, const char* format, const std::string& name, Encoding encoding) {
  OpenImage opened(data);
  SWARD_TRY(open(opened, format, name));
  const OIIO::ImageSpec& spec = opened.spec;
  SWARD_TRY(checkSize(spec, data.size(), name));

  const int channels = std::min(spec.nchannels, 4);
  Image image(spec.width, spec.height, channels);
  if (!opened.input->read_image(0, 0, 0, channels, OIIO::TypeDesc::FLOAT, image.pixels.data())) {
    return Error::badInput("the image cannot be read: " + opened.input->geterror(), name, kDamagedRemedy);
  }
  const bool alphaLast = spec.alpha_channel == channels - 1 && channels > 1;
  const int colours = alphaLast ? channels - 1 : channels;
  const bool integer = !spec.format.is_floating_point();
  if (alphaLast && spec.get_int_attribute("oiio:UnassociatedAlpha", 0) == 0) divideByAlpha(image, colours);
  if (integer && encoding == Encoding::Srgb) decodeSrgb(image, colours, spec.format == OIIO::TypeDesc::UINT8);
  return image;
}

/// The format that the data announce; PNG files are checked before libpng sees them.
Result<const char*> checkedFormat(std::span<const std::byte> data, const std::string& name) {
  const char* format = formatOf(data);
  if (format == nullptr) {
    return Error::badInput(unsupportedText(data), name, "Convert it to PNG, JPEG, EXR, HDR or TIFF.");
  }
  if (format == std::string_view("png")) SWARD_TRY(checkPng(data, name));
  return format;
}

}  // namespace

Result<Image> readImage(std::span<const std::byte> data, const std::string& name, Encoding encoding) {
  SWARD_ASSIGN(const char* const format, checkedFormat(data, name));
  return withoutExceptions(name, kDamagedRemedy,
                           [&]() -> Result<Image> { return decode(data, format, name, encoding); });
}

Result<ImageFacts> readImageFacts(std::span<const std::byte> data, const std::string& name) {
  SWARD_ASSIGN(const char* const format, checkedFormat(data, name));
  return withoutExceptions(name, kDamagedRemedy, [&]() -> Result<ImageFacts> {
    OpenImage opened(data);
    SWARD_TRY(open(opened, format, name));
    const OIIO::ImageSpec& spec = opened.spec;
    return ImageFacts{spec.width, spec.height, spec.nchannels, !spec.format.is_floating_point(),
                      static_cast<int>(spec.format.basesize()) * 8};
  });
}

Result<Image> readImage(const std::filesystem::path& path, Encoding encoding) {
  SWARD_ASSIGN(const std::vector<std::byte> data, base::readFile(path));
  return readImage(data, path.string(), encoding);
}

}  // namespace sward::image
