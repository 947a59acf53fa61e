#pragma once

#include "base/job.h"
#include "base/result.h"
#include "image/image.h"
#include "render/options.h"
#include "report/ground_truth.h"
#include "report/row.h"
#include "report/section.h"

#include <string>

/// Private to the sections that compare drawn pictures with traced ones.
namespace sward::report {

/// JSON text of a string that holds nothing to escape.
std::string quotedText(const std::string& text);

/// One view's truth, as rows and pictures need it.
struct PictureReference {
  TruthPicture picture;
  image::Image display;
  std::string name;         ///< of its picture
  std::string description;  ///< Row::reference
};
/// What a frame shows of the truth in `samples` samples a pixel.
Result<PictureReference> pictureReference(const GroundTruth& truth, const render::Frame& frame, std::string name,
                                          int samples, const JobContext& job);
/// The reference as a strip has it.
Picture pictureOf(const PictureReference& reference, std::string caption);

/// A picture that a method drew.
struct DrawnPicture {
  std::string method;  ///< of the row, and the caption
  std::string name;    ///< of the picture; its difference is NAME_flip
  image::Image linear;
};
/// Errors of a drawn picture against its reference, whose noise and what is left of the RMSE without it (in quadrature)
/// stand in the parameters reference_noise_rmse and rmse_without_noise; adds the picture and its difference to the
/// strip. Errors: image::compareImages'.
Result<Row> pictureRow(DrawnPicture drawn, const PictureReference& reference, render::ViewTransform transform,
                       Strip& strip, const JobContext& job);

}  // namespace sward::report
