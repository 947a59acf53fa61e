#include "terrain/heightmap.h"
#include "terrain/map_size.h"

#include "base/file.h"
#include "image/io.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>

namespace sward::terrain {
namespace {

/// Values that float rasters use for missing heights: ESRI's, SRTM's two and GDAL's lowest float.
bool isNoData(float value) {
  return value == -9999.0f || value == -32767.0f || value == -32768.0f || value < -1e30f;
}

std::string sizeText(double columns, double rows) {
  const auto whole = [](double n) { return std::to_string(static_cast<std::int64_t>(std::min(n, 9e15))); };
  return whole(columns) + " x " + whole(rows);
}

/// Whether a text begins as an ESRI ASCII grid does.
bool looksLikeGrid(std::span<const std::byte> data, const std::filesystem::path& file) {
  std::string start;
  for (std::size_t i = 0; i < std::min<std::size_t>(data.size(), 512); ++i)
    start += static_cast<char>(std::tolower(std::to_integer<unsigned char>(data[i])));
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  return start.find("ncols") != start.npos || start.find("nrows") != start.npos || extension == ".asc";
}

}  // namespace

Result<void> checkMapSize(double columns, double rows, const std::string& place) {
  if (columns < 2.0 || rows < 2.0)
    return Error::badInput("a heightmap of " + sizeText(columns, rows) + " has no surface", place,
                           "Use at least 2 x 2 heights.");
  if (columns > kMaxMapSide || rows > kMaxMapSide || columns * rows > static_cast<double>(kMaxMapSamples))
    return Error::badInput("a heightmap of " + sizeText(columns, rows) + " is too large", place,
                           "Use at most " + std::to_string(kMaxMapSide) + " a side and " +
                               std::to_string(kMaxMapSamples) + " in all: resample it, or cut a part out.");
  return {};
}

Result<void> checkKnown(const RawHeights& raw, const std::string& name) {
  if (raw.missing < raw.values.size()) return {};
  return Error::badInput("the heightmap has no data anywhere", name,
                         "All of its values stand for a missing height; export the area again.");
}

Result<RawHeights> readHeightImage(std::span<const std::byte> data, const std::string& name) {
  SWARD_ASSIGN(const image::ImageFacts facts, image::readImageFacts(data, name));
  SWARD_TRY(checkMapSize(facts.width, facts.height, name));
  SWARD_ASSIGN(const image::Image picture, image::readImage(data, name, image::Encoding::Linear));
  RawHeights raw;
  raw.columns = picture.width;
  raw.rows = picture.height;
  raw.integer = facts.integer;
  raw.bits = facts.bits;
  const auto width = static_cast<std::size_t>(raw.columns), height = static_cast<std::size_t>(raw.rows);
  raw.values.resize(width * height);
  for (std::size_t i = 0; i < raw.values.size(); ++i) {
    const float value = picture.pixels[i * static_cast<std::size_t>(picture.channels)];
    const std::size_t at = (height - 1 - i / width) * width + i % width;
    raw.values[at] = value;
    if (raw.integer) continue;
    const bool missing = isNoData(value);
    if (!missing && !std::isfinite(value))
      return Error::badInput(
          "a height is not a number, in column " + std::to_string(i % width) + " of row " + std::to_string(i / width),
          name, "Write -9999 where heights are missing.");
    if (!missing) continue;
    if (raw.known.empty()) raw.known.assign(raw.values.size(), 1.0f);
    raw.known[at] = 0.0f;
    ++raw.missing;
  }
  SWARD_TRY(checkKnown(raw, name));
  return raw;
}

Result<RawHeights> readHeights(const std::filesystem::path& file) {
  constexpr std::uint64_t kLimitBytes = std::uint64_t{2} << 30;
  SWARD_ASSIGN(const std::vector<std::byte> data, base::readFile(file, kLimitBytes));
  if (!looksLikeGrid(data, file)) return readHeightImage(data, file.string());
  return readEsriGrid({reinterpret_cast<const char*>(data.data()), data.size()}, file.string());
}

}  // namespace sward::terrain
