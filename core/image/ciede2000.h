#pragma once

#include "base/job.h"
#include "base/result.h"
#include "image/colour.h"
#include "image/image.h"

namespace sward::image {

/// The CIEDE2000 colour difference with kL = kC = kH = 1 (CIE 142-2001), computed as Sharma, Wu and Dalal 2005 set
/// down, including their rules for hues of greys and for the mean of hues. 1 is about a just noticeable difference.
double ciede2000(const Lab& first, const Lab& second);

struct ColourDifference {
  double mean = 0.0;
  double max = 0.0;
};

/// CIEDE2000 over the pixels of two images of linear Rec. 709 values (grey or RGB), where 1 is the white that the eye
/// is adapted to. Errors: sizes or channels that differ, an empty image, a value that is not finite.
Result<ColourDifference> colourDifference(const Image& referenceLinear, const Image& testLinear,
                                          const JobContext& job = {});

}  // namespace sward::image
