#pragma once

#include "base/job.h"
#include "base/result.h"
#include "image/image.h"
#include "render/renderer.h"
#include "report/ground_truth.h"
#include "report/row.h"

#include <array>
#include <span>
#include <string>
#include <vector>

/// Private to the sections that measure what single steps cost: rows cause_...
namespace sward::report {

/// Two pictures of the same truth with independent noise.
using Twins = std::array<image::Image, 2>;
/// The same seeds for all variants: what they have in common has the same noise and leaves the difference.
Result<Twins> truthTwins(const GroundTruth& truth, const render::Frame& frame, const TruthVariant& variant, int samples,
                         const JobContext& job);

/// Row cause_METHOD of two differences whose noise is independent (rmseWithoutNoise, biasOf).
Row causeRow(const std::string& method, const PicturePair& one, const PicturePair& other, std::string notes);

/// A step that the truth itself can leave out.
struct TruthCause {
  const char* method;
  TruthVariant variant;
  const char* notes;
};
inline constexpr TruthCause kSkyCause{
    "sky", {false, true, false, 0}, "the sky's mean radiance from everywhere instead of its own"};
inline constexpr TruthCause kSunDiscCause{"sun_disc", {false, false, true, 0}, "a point instead of the sun's disc"};
inline constexpr TruthCause kBouncesCause{
    "bounces", {false, false, false, 2}, "two bounces between leaves and soil, which are left out elsewhere"};

/// Rows of two references each, of `samples` samples.
Result<std::vector<Row>> truthCauseRows(const GroundTruth& truth, const render::Frame& frame,
                                        std::span<const TruthCause> causes, int samples, const JobContext& job);

}  // namespace sward::report
