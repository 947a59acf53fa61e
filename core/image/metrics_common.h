#pragma once

#include "base/job.h"
#include "base/result.h"
#include "image/image.h"

#include <functional>

namespace sward::image {

/// Which channel counts a metric takes.
enum class ChannelNeed {
  Any,    ///< every channel is a value like the others
  Colour  ///< 1 (grey) or 3 (RGB): alpha has no meaning to the eye until it is composited
};

/// An error unless the images have pixels, the same size and channels that fit `need`, and hold only finite values.
/// A reason to refuse names the image and, for a value, its pixel and channel.
Result<void> checkComparable(const Image& reference, const Image& test, ChannelNeed need, const JobContext& job);

/// The RGB of a pixel of 1 or 3 channels; grey is three times its value.
inline glm::vec3 colourAt(const Image& image, int x, int y) {
  return image.channels == 3 ? image.rgb(x, y) : glm::vec3(image.at(x, y, 0));
}

/// Calls body(y) for every row of an image on the job's threads.
void forEachRow(const JobContext& job, int height, const std::function<void(int y)>& body);

/// Sum of the values of a map of one channel in double precision: each row from the left, then the rows from the top,
/// so that the bits of the sum do not depend on the number of threads.
double sumOf(const Image& map);

}  // namespace sward::image
