#pragma once

#include "base/job.h"
#include "base/result.h"
#include "image/image.h"

#include <optional>

namespace sward::image {

/// Pixels that one degree of the visual field holds for someone at `distanceM` from a screen.
double pixelsPerDegree(double distanceM, double screenWidthM, double screenWidthPixels);

/// The papers' default: 0.7 m from a screen of 3840 pixels over 0.7 m.
inline constexpr double kFlipPixelsPerDegree = 67.02064327658225;

/// FLIP, the difference that a person sees who alternates between two images, in [0, 1] (0: none), as Andersson,
/// Nilsson, Akenine-Moller, Oskarsson, Astrom and Fairchild 2020 define it, with the constants they publish.
struct FlipError {
  double mean = 0.0;
  Image map;  ///< one channel
};

struct FlipOptions {
  /// In [1, 1000]: below, a pixel is wider than every filter; above, the filters' radii grow past any image.
  double pixelsPerDegree = kFlipPixelsPerDegree;
};

/// FLIP of two sRGB-encoded display images, grey or RGB. Values are clamped to [0, 1], as a display clamps them.
/// Filters see the image's edge repeated beyond it. Computed in float: equal pixels give exactly 0, and rounding moves
/// the other values by up to about 1e-4 (small differences are raised to powers below 1), means by far less.
/// Errors: sizes or channels that differ, an empty image, a value that is not finite, options outside their range.
Result<FlipError> flip(const Image& referenceDisplay, const Image& testDisplay, const FlipOptions& options = {},
                       const JobContext& job = {});

/// How HDR-FLIP brings exposed linear values to the display: ACES as Narkowicz 2016 fits it (less its exposure of 0.6),
/// Reinhard's of luminance without white point, or Hable's with white at 11.2.
enum class FlipToneMapper { Aces, Reinhard, Hable };

/// `count` exposures in equal steps from `start` to `stop`, both included, in stops (factors 2^e).
struct FlipExposures {
  double start = 0.0;
  double stop = 0.0;
  int count = 2;

  bool operator==(const FlipExposures&) const = default;
};

/// Each exposure costs one FLIP; more than these would run for minutes.
inline constexpr int kMaxFlipExposures = 64;
/// Stops within which the tone mappers of any float stay finite in double precision.
inline constexpr double kMaxFlipExposure = 256.0;

struct HdrFlipOptions {
  double pixelsPerDegree = kFlipPixelsPerDegree;
  FlipToneMapper toneMapper = FlipToneMapper::Aces;
  std::optional<FlipExposures> exposures;  ///< none: flipExposures() of the reference
};

struct HdrFlipError {
  double mean = 0.0;
  Image map;                ///< one channel: the greatest FLIP of all exposures
  Image exposure;           ///< one channel: the stops at which the map's value was found first
  FlipExposures exposures;  ///< those that were used
};

/// The exposures that Andersson, Nilsson, Shirley and Akenine-Moller 2021 derive from a linear reference: from the one
/// that brings its brightest luminance to 0.85 on the display, to the one that brings its median there, in steps of at
/// most one stop, at least two. The median is the upper one when the number of pixels is even.
/// Errors: an image that is empty or not finite; a reference that is black, or whose median is black, from which no
/// exposure follows; more than kMaxFlipExposures.
Result<FlipExposures> flipExposures(const Image& referenceLinear, FlipToneMapper toneMapper = FlipToneMapper::Aces,
                                    const JobContext& job = {});

/// HDR-FLIP (Andersson, Nilsson, Shirley and Akenine-Moller 2021) of two images of linear Rec. 709 radiance, grey or
/// RGB: the greatest FLIP at each pixel over a range of exposures. Negative values count as 0, as on a display.
/// Errors: those of flip(); those of flipExposures() where the options leave the exposures to it.
Result<HdrFlipError> hdrFlip(const Image& referenceLinear, const Image& testLinear, const HdrFlipOptions& options = {},
                             const JobContext& job = {});

}  // namespace sward::image
