#include "report/picture_row.h"

#include "image/error_colours.h"
#include "image/metrics.h"
#include "render/display.h"
#include "report/text.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace sward::report {
namespace {

void addErrors(Row& row, const image::ErrorFigures& figures, const PictureReference& reference) {
  row.error = {{"rmse", figures.rmse},
               {"bias", figures.bias},
               {"max", figures.max},
               {"ssim", figures.ssim},
               {"flip", figures.flip}};
  if (figures.psnrDb) row.error["psnr_db"] = *figures.psnrDb;
  const double noise = reference.picture.noiseRmse;
  row.numbersAndNames["reference_noise_rmse"] = numberText(noise);
  row.numbersAndNames["rmse_without_noise"] =
      numberText(std::sqrt(std::max(figures.rmse * figures.rmse - noise * noise, 0.0)));
  row.reference = reference.description;
}

}  // namespace

std::string quotedText(const std::string& text) {
  return '"' + text + '"';
}

Result<PictureReference> pictureReference(const GroundTruth& truth, const render::Frame& frame, std::string name,
                                          int samples, const JobContext& job) {
  PictureReference reference;
  reference.name = std::move(name);
  reference.description = "ray-traced tiled geometry, sun and sky, " + std::to_string(samples) + " samples a pixel";
  SWARD_ASSIGN(reference.picture, truth.picture(frame, {}, samples, 1, job));
  reference.display = render::toDisplay(reference.picture.linear, frame.options.viewTransform);
  return reference;
}

Picture pictureOf(const PictureReference& reference, std::string caption) {
  return {reference.name, std::move(caption), reference.picture.linear, reference.display};
}

Result<Row> pictureRow(DrawnPicture drawn, const PictureReference& reference, render::ViewTransform transform,
                       Strip& strip, const JobContext& job) {
  image::Image display = render::toDisplay(drawn.linear, transform);
  SWARD_ASSIGN(const image::ErrorFigures figures,
               image::compareImages({reference.picture.linear, drawn.linear}, {reference.display, display}, {}, job));
  SWARD_ASSIGN(const image::FlipError flip, image::flip(reference.display, display, {}, job));
  SWARD_ASSIGN(image::Image coloured, image::colourErrors(flip.map));
  Row row;
  row.method = drawn.method;
  row.numbersAndNames["picture"] = quotedText(drawn.name);
  row.numbersAndNames["reference_picture"] = quotedText(reference.name);
  row.numbersAndNames["display"] = quotedText(transform == render::ViewTransform::Filmic ? "filmic" : "standard");
  addErrors(row, figures, reference);
  strip.pictures.push_back({drawn.name, drawn.method, std::move(drawn.linear), std::move(display)});
  strip.pictures.push_back(
      {drawn.name + "_flip", drawn.method + ": difference (FLIP, bright is worse)", {}, std::move(coloured)});
  return row;
}

}  // namespace sward::report
