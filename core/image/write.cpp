#include "image/io.h"

#include "image/bytes.h"
#include "image/io_common.h"

#include "base/file.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <memory>

namespace sward::image {
namespace {

constexpr float kLargestHalf = 65504.0f;

Result<void> checkWritable(const Image& image, const std::string& name) {
  const auto expected = static_cast<std::uint64_t>(std::max(image.width, 0)) *
                        static_cast<std::uint64_t>(std::max(image.height, 0)) *
                        static_cast<std::uint64_t>(std::max(image.channels, 0));
  const std::string size = std::to_string(image.width) + " x " + std::to_string(image.height);
  if (image.width <= 0 || image.height <= 0 || image.width > kMaxImageSide || image.height > kMaxImageSide) {
    return Error::badInput("an image of " + size + " pixels cannot be written", name,
                           "Use 1 to " + std::to_string(kMaxImageSide) + " pixels a side.");
  }
  if (image.channels != 1 && image.channels != 3 && image.channels != 4) {
    return Error::badInput("an image of " + std::to_string(image.channels) + " channels cannot be written", name,
                           "Use 1, 3 or 4 channels.");
  }
  if (image.pixels.size() != expected) {
    return Error::failed("an image of " + size + " pixels holds " + std::to_string(image.pixels.size()) + " values",
                         name);
  }
  return {};
}

/// Encodes `pixels` (type `spec.format`) into memory: a full disk is then found by the one function that writes files.
Result<std::vector<std::byte>> encode(const char* format, OIIO::ImageSpec& spec, const void* pixels,
                                      const std::string& name) {
  const std::unique_ptr<OIIO::ImageOutput> output = OIIO::ImageOutput::create(format);
  if (!output) {
    return Error::failed(std::string("this OpenImageIO cannot write ") + format + " images: " + OIIO::geterror(), name,
                         "Install the full OpenImageIO package.");
  }
  std::vector<unsigned char> bytes;
  OIIO::Filesystem::IOVecOutput sink(bytes);
  OIIO::Filesystem::IOProxy* proxy = &sink;
  spec.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, &proxy);
  const bool written = output->open(std::string("memory.") + format, spec) &&
                       output->write_image(spec.format, pixels) && output->close();
  if (!written) return Error::failed("the image cannot be encoded: " + output->geterror(), name);
  const auto* first = reinterpret_cast<const std::byte*>(bytes.data());
  return std::vector<std::byte>(first, first + bytes.size());
}

std::vector<std::uint8_t> quantise(const Image& encoded) {
  std::vector<std::uint8_t> values(encoded.pixels.size());
  std::transform(encoded.pixels.begin(), encoded.pixels.end(), values.begin(), toByte);
  return values;
}

Result<std::vector<std::byte>> encodePngNamed(const Image& encoded, const std::string& name) {
  SWARD_TRY(checkWritable(encoded, name));
  return withoutExceptions(name, {}, [&]() -> Result<std::vector<std::byte>> {
    const std::vector<std::uint8_t> values = quantise(encoded);
    OIIO::ImageSpec spec(encoded.width, encoded.height, encoded.channels, OIIO::TypeDesc::UINT8);
    spec.attribute("oiio:ColorSpace", "sRGB");
    spec.attribute("oiio:UnassociatedAlpha", 1);
    return encode("png", spec, values.data(), name);
  });
}

/// The values that go into the file: premultiplied, and finite ones within what half floats hold.
std::vector<float> exrValues(const Image& linear) {
  std::vector<float> values = linear.pixels;
  if (linear.channels == 4) {
    for (std::size_t p = 0; p < values.size(); p += 4) {
      for (std::size_t c = 0; c < 3; ++c) values[p + c] *= values[p + 3];
    }
  }
  for (float& value : values) {
    if (std::isfinite(value)) value = std::clamp(value, -kLargestHalf, kLargestHalf);
  }
  return values;
}

Result<std::vector<std::byte>> encodeExr(const Image& linear, const std::string& name) {
  SWARD_TRY(checkWritable(linear, name));
  return withoutExceptions(name, {}, [&]() -> Result<std::vector<std::byte>> {
    const std::vector<float> values = exrValues(linear);
    std::vector<std::uint16_t> halves(values.size());
    OIIO::convert_pixel_values(OIIO::TypeDesc::FLOAT, values.data(), OIIO::TypeDesc::HALF, halves.data(),
                               static_cast<int>(values.size()));
    OIIO::ImageSpec spec(linear.width, linear.height, linear.channels, OIIO::TypeDesc::HALF);
    if (linear.channels == 1) spec.channelnames = {"Y"};
    spec.attribute("compression", "zip");
    spec.attribute("oiio:ColorSpace", "Linear");
    // x and y of red, green, blue and white: Rec. 709 with D65.
    const float chromaticities[8] = {0.64f, 0.33f, 0.30f, 0.60f, 0.15f, 0.06f, 0.3127f, 0.3290f};
    spec.attribute("chromaticities", OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, 8), chromaticities);
    return encode("openexr", spec, halves.data(), name);
  });
}

}  // namespace

Result<std::vector<std::byte>> encodePng(const Image& encoded) {
  return encodePngNamed(encoded, "image");
}

Result<void> writePng(const std::filesystem::path& path, const Image& encoded) {
  SWARD_ASSIGN(const std::vector<std::byte> bytes, encodePngNamed(encoded, path.string()));
  return base::writeFileAtomically(path, bytes);
}

Result<void> writeExr(const std::filesystem::path& path, const Image& linear) {
  SWARD_ASSIGN(const std::vector<std::byte> bytes, encodeExr(linear, path.string()));
  return base::writeFileAtomically(path, bytes);
}

bool canWriteImage(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension == ".png" || extension == ".exr";
}

}  // namespace sward::image
