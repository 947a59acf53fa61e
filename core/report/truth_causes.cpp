#include "report/truth_causes.h"

#include <utility>

namespace sward::report {

Result<Twins> truthTwins(const GroundTruth& truth, const render::Frame& frame, const TruthVariant& variant, int samples,
                         const JobContext& job) {
  Twins out;
  for (std::size_t i = 0; i < out.size(); ++i) {
    SWARD_ASSIGN(TruthPicture picture, truth.picture(frame, variant, samples, 11 + i, job));
    out[i] = std::move(picture.linear);
  }
  return out;
}

Row causeRow(const std::string& method, const PicturePair& one, const PicturePair& other, std::string notes) {
  Row row;
  row.method = "cause_" + method;
  row.error = {{"rmse", rmseWithoutNoise(one, other)}, {"bias", biasOf(one, other)}};
  row.notes = std::move(notes);
  return row;
}

Result<std::vector<Row>> truthCauseRows(const GroundTruth& truth, const render::Frame& frame,
                                        std::span<const TruthCause> causes, int samples, const JobContext& job) {
  SWARD_ASSIGN(const Twins whole, truthTwins(truth, frame, {}, samples, job));
  std::vector<Row> rows;
  for (const TruthCause& cause : causes) {
    SWARD_ASSIGN(const Twins varied, truthTwins(truth, frame, cause.variant, samples, job));
    // Light that is left out is an error of what leaves it out.
    const bool truer = cause.variant.bounces > 0;
    const auto pair = [&](std::size_t i) {
      return truer ? PicturePair{varied[i], whole[i]} : PicturePair{whole[i], varied[i]};
    };
    Row row = causeRow(cause.method, pair(0), pair(1), cause.notes);
    row.reference = "ray-traced";
    rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace sward::report
