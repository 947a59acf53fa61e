#include "image/metrics_common.h"

#include "base/parallel.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace sward::image {

namespace {

constexpr std::size_t kRowsAtOnce = 16;

std::string shape(const Image& image) {
  return std::to_string(image.width) + " x " + std::to_string(image.height) + " with " +
         std::to_string(image.channels) + " channels";
}

std::string place(const Image& image, const char* name, std::size_t index) {
  const std::size_t channels = static_cast<std::size_t>(image.channels);
  const std::size_t pixel = index / channels;
  const std::size_t width = static_cast<std::size_t>(image.width);
  return std::string(name) + ", pixel (" + std::to_string(pixel % width) + ", " + std::to_string(pixel / width) +
         "), channel " + std::to_string(index % channels);
}

Result<void> checkShape(const Image& image, const char* name) {
  if (image.width <= 0 || image.height <= 0 || image.channels <= 0) {
    return Error::badInput("the image is empty (" + shape(image) + ")", name, "Compare images that have pixels.");
  }
  const std::size_t needed = image.offset(0, image.height);
  if (image.pixels.size() != needed) {
    return Error::badInput("the image of " + shape(image) + " holds " + std::to_string(image.pixels.size()) +
                               " values where " + std::to_string(needed) + " belong",
                           name, "Fill the whole image.");
  }
  return {};
}

Result<void> checkFinite(const Image& image, const char* name, const JobContext& job) {
  const std::size_t none = image.pixels.size();
  std::vector<std::size_t> firstOfRow(static_cast<std::size_t>(image.height), none);
  forEachRow(job, image.height, [&](int y) {
    for (std::size_t i = image.offset(0, y); i < image.offset(0, y + 1); ++i) {
      if (std::isfinite(image.pixels[i])) continue;
      firstOfRow[static_cast<std::size_t>(y)] = i;
      return;
    }
  });
  const std::size_t first = *std::min_element(firstOfRow.begin(), firstOfRow.end());
  if (first == none) return {};
  return Error::badInput(std::string("a value is ") + (std::isnan(image.pixels[first]) ? "not a number" : "infinite"),
                         place(image, name, first), "Mend what made it, or leave the pixel out before comparing.");
}

}  // namespace

void forEachRow(const JobContext& job, int height, const std::function<void(int y)>& body) {
  base::parallelFor(job, static_cast<std::size_t>(height), kRowsAtOnce, [&](std::size_t begin, std::size_t end) {
    for (std::size_t y = begin; y < end; ++y) body(static_cast<int>(y));
  });
}

double sumOf(const Image& map) {
  double sum = 0.0;
  for (int y = 0; y < map.height; ++y) {
    double row = 0.0;
    for (int x = 0; x < map.width; ++x) row += static_cast<double>(map.at(x, y, 0));
    sum += row;
  }
  return sum;
}

Result<void> checkComparable(const Image& reference, const Image& test, ChannelNeed need, const JobContext& job) {
  SWARD_TRY(checkShape(reference, "reference image"));
  SWARD_TRY(checkShape(test, "test image"));
  if (reference.width != test.width || reference.height != test.height || reference.channels != test.channels) {
    return Error::badInput(
        "the reference is " + shape(reference) + " and the test image is " + shape(test) + ": they cannot be compared",
        "test image", "Render both in the same size and with the same channels.");
  }
  if (need == ChannelNeed::Colour && reference.channels != 1 && reference.channels != 3) {
    return Error::badInput("this metric takes grey or RGB, not " + std::to_string(reference.channels) + " channels",
                           "reference image", "Composite over a background, or drop the channels that are not colour.");
  }
  SWARD_TRY(checkFinite(reference, "reference image", job));
  SWARD_TRY(checkFinite(test, "test image", job));
  if (job.cancelled()) return Error::cancelled();
  return {};
}

}  // namespace sward::image
