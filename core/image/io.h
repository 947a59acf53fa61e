#pragma once

#include "base/result.h"
#include "image/image.h"

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace sward::image {

/// Colour encoding of 8 and 16-bit integer files; float files (EXR, HDR) are always linear.
enum class Encoding { Srgb, Linear };

/// Largest width or height that is read or written; protects against hostile headers (2^30 pixels at most in all).
inline constexpr int kMaxImageSide = 32768;

/// Reads PNG, JPEG, EXR, HDR or TIFF into linear values; colour channels decode from `encoding` when the file is
/// integer, alpha never does. Keeps the file's 1 to 4 channels (more are dropped). Premultiplied files (EXR) are
/// divided by their alpha where it is not 0.
Result<Image> readImage(const std::filesystem::path& path, Encoding encoding = Encoding::Srgb);
/// The same from memory; `name` stands in messages, its extension does not matter.
Result<Image> readImage(std::span<const std::byte> data, const std::string& name, Encoding encoding = Encoding::Srgb);

/// What the header of an image says.
struct ImageFacts {
  int width = 0, height = 0, channels = 0;
  bool integer = true;  ///< false: floats
  int bits = 8;         ///< of a value in the file
};
/// Reads no pixels, and judges no size: callers with limits of their own refuse an image before it is decoded.
Result<ImageFacts> readImageFacts(std::span<const std::byte> data, const std::string& name);

/// Writes display values in [0, 1] (already sRGB-encoded) as 8-bit PNG with an sRGB tag; 1, 3 or 4 channels.
/// Written to a temporary and renamed.
Result<void> writePng(const std::filesystem::path& path, const Image& encoded);
/// The same PNG as bytes.
Result<std::vector<std::byte>> encodePng(const Image& encoded);
/// Writes linear values as half-float EXR (ZIP), Rec. 709 primaries, channels Y, RGB or RGBA; colour is multiplied by
/// alpha on the way, as the format has it. Values beyond what half floats hold are clamped.
Result<void> writeExr(const std::filesystem::path& path, const Image& linear);

/// True when the extension (any case) is one that the writers above know: .png or .exr.
bool canWriteImage(const std::filesystem::path& path);

}  // namespace sward::image
