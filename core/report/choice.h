#pragma once

#include "base/job.h"
#include "base/result.h"
#include "gpu/context.h"
#include "image/metrics.h"
#include "lpt/representation.h"
#include "project/project.h"
#include "report/options.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

/// The cheapest bake that is good enough: which representation, layers, resolution and lights keep a stated error.
namespace sward::report {

/// Something that a ground may be baked as; the rest is the project's.
struct Candidate {
  lpt::Method method;
  int sliceResolution = 256;
  int slices = 16;
  int lights = 0;  ///< 0: the project's own directions, which are no Fibonacci lattice
  bool operator==(const Candidate& other) const;
};
/// "lpt8, 16 layers of 256 x 256, 15 lights".
std::string candidateText(const Candidate& candidate);
/// Sets it in a project; sizes of tiles and blades follow the resolution, so that tiles stay as large in metres.
void applyCandidate(const Candidate& candidate, project::Project& project);

/// What was measured of one candidate, or of light traced for the very sun (the least error that its layers allow).
struct Trial {
  Candidate candidate;
  bool floor = false;  ///< Basis::Sampled: what layers, texels and drawing cost, without any fit
  double value = 0.0;  ///< of the metric, the worst of the views
  std::string worstView;
  double drawMs = 0.0;     ///< of a frame of the trial's size, the mean of the views
  double relightMs = 0.0;  ///< when the sun moves
  bool meets = false;
};

struct Choice {
  Candidate chosen;
  bool met = false;  ///< otherwise `chosen` is the one of least error
  AccuracyOptions accuracy;
  double noise = 0.0;         ///< of the reference itself, as RMSE of display values, the worst of the views
  std::vector<Trial> trials;  ///< in the order in which they were measured, cheapest first
};
/// Sentences for people: what was chosen, why, and what else was measured.
std::string choiceText(const Choice& choice);

/// The pictures that candidates are judged by.
struct TrialSize {
  int width = 320, height = 180;
  int samples = 32;  ///< of the reference, a pixel
};

struct ChoiceInput {
  const project::Project& project;  ///< valid; its accuracy says the bound
  std::vector<scene::View> views;   ///< at least one; the first three count
  gpu::Context& context;            ///< current on this thread
  /// Remembered choices; nothing else is written there. Empty: none.
  std::filesystem::path cacheFolder;
  TrialSize size = {};
};

/// Measures candidates from the cheapest on until one keeps the bound in every view. For every pair of layers and
/// resolution the floor is measured first: where that misses the bound by more than a twentieth its fits are
/// skipped. Errors are those of the drawn ground against the ray-traced reference of the same tiles, under the
/// project's sun, with slow variation and bent grid left out; RMSE and PSNR have the reference's own noise taken off in
/// quadrature. The same choice again (same values, views, version) comes from the cache. Errors: no view, a bake that
/// fails, Error::cancelled().
Result<Choice> chooseCheapest(const ChoiceInput& input, const JobContext& job);

/// Reads "rmse=0.02" (rmse, psnr, ssim, flip). Errors name what is wrong.
Result<AccuracyOptions> parseAccuracy(const std::string& text);

}  // namespace sward::report
