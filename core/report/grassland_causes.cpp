#include "report/grassland_causes.h"

#include "report/truth_causes.h"

#include <array>
#include <string>
#include <utility>

namespace sward::report {
namespace {

/// Of a cause's two references.
Result<Twins> twins(const CauseInput& input, const TruthVariant& variant, const JobContext& job) {
  return truthTwins(input.truth, input.frame, variant, input.samples, job);
}

Result<image::Image> draw(const CauseInput& input, const std::shared_ptr<const bake::GroundBake>& ground,
                          render::GroundMethod method) {
  SWARD_TRY(input.renderer.setGround(ground));
  render::Frame frame = input.frame;
  frame.options.method = method;
  return input.renderer.drawLinear(frame);
}

/// Rows of drawn pictures, by the march.
Result<std::vector<Row>> drawnRows(const CauseInput& input, const JobContext& job) {
  const CauseGrounds& grounds = input.grounds;
  std::vector<Row> rows;
  constexpr auto kMarch = render::GroundMethod::March;
  const auto compare = [&](const std::string& method, const image::Image& reference, const image::Image& test,
                           std::string notes, std::string against) {
    const PicturePair pair{reference, test};
    Row row = causeRow(method, pair, pair, std::move(notes));
    row.reference = std::move(against);
    rows.push_back(std::move(row));
  };
  SWARD_ASSIGN(image::Image stored, draw(input, grounds.project, kMarch));
  if (grounds.whole) {
    SWARD_ASSIGN(image::Image whole, draw(input, grounds.whole, kMarch));
    compare("range_clamp", whole, stored, "coefficients cut off at the project's quantile against none cut off",
            "drawn with the whole range");
    stored = std::move(whole);
  }
  image::Image fine;
  if (grounds.fine) {
    SWARD_ASSIGN(fine, draw(input, grounds.fine, kMarch));
    compare("quantisation", fine, stored, "the project's bits against 16", "drawn with 16 bits");
  }
  if (!grounds.exact) return rows;
  SWARD_ASSIGN(const image::Image exact, draw(input, grounds.exact, kMarch));
  if (grounds.fine)
    compare("fit", exact, fine, "the fit against light traced for the sun itself", "drawn, light traced");
  SWARD_ASSIGN(const image::Image blended, draw(input, grounds.exact, render::GroundMethod::BlendedNormalised));
  compare("blending", exact, blended, "blended planes (normalised weights) against the march of the same light",
          "drawn by the march");
  SWARD_ASSIGN(const Twins asBaked, twins(input, {true, true, true, 0}, job));
  Row layers = causeRow("layers", {asBaked[0], exact}, {asBaked[1], exact},
                        "layers, texels, mips and march, with light traced for the sun itself");
  layers.reference = "ray-traced, with shadows, even sky and point sun as bakes have them";
  rows.push_back(std::move(layers));
  return rows;
}

constexpr std::array kTruthCauses{
    TruthCause{"tiling", {true, false, false, 0}, "shadows through the periodic patch instead of the tiled ground"},
    kSkyCause, kSunDiscCause, kBouncesCause};

}  // namespace

Result<CauseGrounds> bakeCauseGrounds(const project::Project& project, std::shared_ptr<const bake::GroundBake> ground,
                                      bake::Baker& baker, const JobContext& job) {
  CauseGrounds out;
  project::Project whole = project;
  whole.fit.clampQuantile = 0.0;
  project::Project fine = whole;
  fine.fit.bits = 16;
  project::Project exact = fine;
  if (project.fit.clampQuantile > 0.0) {
    SWARD_ASSIGN(out.whole, baker.ground(whole, job));
  }
  exact.fit.basis = lpt::Basis::Sampled;
  SWARD_ASSIGN(out.fine, baker.ground(fine, job));
  SWARD_ASSIGN(out.exact, baker.ground(exact, job));
  out.project = std::move(ground);
  return out;
}

Result<std::vector<Row>> causeRows(const CauseInput& input, const JobContext& job) {
  CauseGrounds grounds = input.grounds;
  if (grounds.whole && !input.truth.laysSame(*grounds.whole)) grounds.whole = nullptr;
  if (grounds.fine && !input.truth.laysSame(*grounds.fine)) grounds.fine = nullptr;
  if (grounds.exact && !input.truth.laysSame(*grounds.exact)) grounds.exact = nullptr;
  const CauseInput checked{input.renderer, input.truth, grounds, input.frame, input.samples};
  SWARD_ASSIGN(std::vector<Row> rows, drawnRows(checked, job));
  SWARD_TRY(input.renderer.setGround(input.grounds.project));
  SWARD_ASSIGN(std::vector<Row> more, truthCauseRows(input.truth, input.frame, kTruthCauses, input.samples, job));
  for (Row& row : more) rows.push_back(std::move(row));
  for (Row& row : rows) row.numbersAndNames["reference_samples"] = std::to_string(2 * input.samples);
  return rows;
}

}  // namespace sward::report
