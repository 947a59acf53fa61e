#include "report/choice.h"

#include "bake/bake.h"
#include "bake/quality.h"
#include "report/choice_trial.h"
#include "report/text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <utility>

#include <nlohmann/json.hpp>

namespace sward::report {
namespace {

using Json = nlohmann::json;

constexpr int kVersion = 1;
constexpr std::size_t kViews = 3;
constexpr std::array<std::string_view, 4> kMetricNames{"rmse", "psnr", "ssim", "flip"};
/// What renderers relight themselves, from the cheapest on: what changes every frame must not wait for the processor.
constexpr std::array<std::string_view, 4> kFits{"constant", "lpt8", "ptm8", "ptm"};
constexpr int kFewLights = 8, kManyLights = 31;

/// Layers and resolution: what the floor depends on.
struct Layering {
  int resolution, slices;
};

/// From the cheapest to draw on: fetches grow with layers, memory and relighting with texels times layers.
std::vector<Layering> layerings(const project::Project& project) {
  std::vector<Layering> out;
  const int resolution = project.sampling.sliceResolution, slices = project.sampling.slices;
  for (const int n : {slices / 2, slices, slices * 2}) {
    for (const int r : {resolution / 4, resolution / 2, resolution, resolution * 2}) {
      project::Project tried = project;
      if (n < 2 || n > 64 || r < 32 || r > 1024 || !bake::setSliceResolution(tried, r)) continue;
      out.push_back({r, n});
    }
  }
  const auto cost = [](const Layering& l) { return static_cast<double>(l.slices) * l.resolution * l.resolution; };
  std::stable_sort(out.begin(), out.end(), [&](const Layering& a, const Layering& b) { return cost(a) < cost(b); });
  return out;
}

/// Fits of one layering from the cheapest on.
std::vector<Candidate> candidatesOf(const Layering& layering, const project::Project& project) {
  std::vector<Candidate> out;
  const bool lattice = project.lights.pattern == scene::LightPattern::Fibonacci;
  for (const std::string_view fit : kFits) {
    const lpt::Method& method = *lpt::findMethod(fit);
    std::vector<int> lights{0};
    if (lattice && fit == "constant")
      lights = {kFewLights};
    else if (lattice)
      lights = {kFewLights, std::max(project.lights.count, kFewLights + 1)};
    if (lattice && fit == "ptm" && project.lights.count < kManyLights) lights.push_back(kManyLights);
    for (const int count : lights) out.push_back({method, layering.resolution, layering.slices, count});
  }
  return out;
}

bool likeness(ErrorBound metric) {
  return metric == ErrorBound::Psnr || metric == ErrorBound::Ssim;
}

/// Whether a is the better value of the metric.
bool better(ErrorBound metric, double a, double b) {
  return likeness(metric) ? a > b : a < b;
}

bool keeps(const AccuracyOptions& accuracy, double value) {
  return likeness(accuracy.metric) ? value >= accuracy.bound : value <= accuracy.bound;
}

/// Whether a fit may keep a bound that light traced for the very sun misses: a smoother response sometimes hides what
/// layers get wrong (seen: by 1 %).
bool nearly(const AccuracyOptions& accuracy, double value) {
  constexpr double kMargin = 1.05;
  return likeness(accuracy.metric) ? value * kMargin >= accuracy.bound : value <= accuracy.bound * kMargin;
}

std::string_view metricName(ErrorBound metric) {
  return kMetricNames[static_cast<std::size_t>(metric) - 1];
}

class Search {
 public:
  Search(const ChoiceInput& input, const JobContext& job) : m_input(input), m_job(job) {
    m_choice.accuracy = input.project.accuracy;
  }

  Result<Choice> run() {
    const std::vector<Layering> all = layerings(m_input.project);
    for (std::size_t i = 0; i < all.size() && !m_choice.met; ++i) {
      m_from = static_cast<double>(i) / static_cast<double>(all.size());
      SWARD_TRY(tryLayering(all[i]));
    }
    if (m_choice.trials.empty())
      return Error::failed("there is nothing that this ground could be baked as", "accuracy");
    if (!m_choice.met) takeBest();
    return std::move(m_choice);
  }

 private:
  Result<void> tryLayering(const Layering& layering) {
    const Candidate floor{*lpt::findMethod("lpt8"), layering.resolution, layering.slices, kFewLights};
    SWARD_ASSIGN(const Trial least, measure(floor, true));
    if (!nearly(m_choice.accuracy, least.value)) return {};
    for (const Candidate& candidate : candidatesOf(layering, m_input.project)) {
      SWARD_ASSIGN(const Trial trial, measure(candidate, false));
      if (!trial.meets) continue;
      m_choice.chosen = candidate;
      m_choice.met = true;
      return {};
    }
    return {};
  }

  Result<Trial> measure(const Candidate& candidate, bool floor) {
    if (m_job.cancelled()) return Error::cancelled();
    if (m_job.onProgress) m_job.onProgress("measuring " + candidateText(candidate), m_from);
    SWARD_ASSIGN(const TrialMeasurement measured, measureTrial(m_input, candidate, floor, m_references, m_job));
    Trial trial;
    trial.candidate = candidate;
    trial.floor = floor;
    trial.value = likeness(m_choice.accuracy.metric) ? std::numeric_limits<double>::max() : -1.0;
    for (const ViewError& view : measured.views) {
      const double value = view.value(m_choice.accuracy.metric);
      m_choice.noise = std::max(m_choice.noise, view.noise);
      if (!better(m_choice.accuracy.metric, trial.value, value)) continue;
      trial.value = value;
      trial.worstView = view.name;
    }
    trial.drawMs = measured.drawMs;
    trial.relightMs = measured.relightMs;
    trial.meets = keeps(m_choice.accuracy, trial.value);
    m_choice.trials.push_back(trial);
    return trial;
  }

  /// Nothing keeps the bound: what comes nearest, fitted for the layering of the least floor.
  void takeBest() {
    const Trial* best = nullptr;
    for (const Trial& trial : m_choice.trials) {
      if (best == nullptr || better(m_choice.accuracy.metric, trial.value, best->value)) best = &trial;
    }
    m_choice.chosen = best->candidate;
    if (best->floor)
      m_choice.chosen = candidatesOf({best->candidate.sliceResolution, best->candidate.slices}, m_input.project).back();
  }

  const ChoiceInput& m_input;
  const JobContext& m_job;
  Choice m_choice;
  ReferenceStore m_references;
  double m_from = 0.0;
};

Json candidateJson(const Candidate& c) {
  return {{"method", c.method.name}, {"resolution", c.sliceResolution}, {"slices", c.slices}, {"lights", c.lights}};
}

std::optional<Candidate> candidateFrom(const Json& json) {
  const lpt::Method* method = lpt::findMethod(json.at("method").get<std::string>());
  if (method == nullptr) return std::nullopt;
  return Candidate{*method, json.at("resolution"), json.at("slices"), json.at("lights")};
}

std::string choiceJson(const Choice& choice) {
  Json trials = Json::array();
  for (const Trial& t : choice.trials) {
    trials.push_back({{"candidate", candidateJson(t.candidate)},
                      {"floor", t.floor},
                      {"value", t.value},
                      {"view", t.worstView},
                      {"draw_ms", t.drawMs},
                      {"relight_ms", t.relightMs},
                      {"meets", t.meets}});
  }
  return Json{
      {"chosen", candidateJson(choice.chosen)}, {"met", choice.met}, {"noise", choice.noise}, {"trials", trials}}
      .dump();
}

std::optional<Choice> choiceFrom(const std::string& text, const AccuracyOptions& accuracy) {
  const Json json = Json::parse(text, nullptr, false);
  if (json.is_discarded()) return std::nullopt;
  try {
    Choice choice;
    choice.accuracy = accuracy;
    const auto chosen = candidateFrom(json.at("chosen"));
    if (!chosen) return std::nullopt;
    choice.chosen = *chosen;
    choice.met = json.at("met");
    choice.noise = json.at("noise");
    for (const Json& t : json.at("trials")) {
      const auto candidate = candidateFrom(t.at("candidate"));
      if (!candidate) return std::nullopt;
      choice.trials.push_back(
          {*candidate, t.at("floor"), t.at("value"), t.at("view"), t.at("draw_ms"), t.at("relight_ms"), t.at("meets")});
    }
    return choice;
  } catch (const Json::exception&) {
    return std::nullopt;  // of another version, or damaged: measured anew
  }
}

Result<base::Hash128> choiceKey(const ChoiceInput& input) {
  bake::Baker baker;
  SWARD_ASSIGN(const base::Hash128 ground, baker.key({input.project}));
  base::Hasher hasher;
  hasher.add(std::string_view("choice")).add(kVersion).add(ground);
  hasher.add(std::string_view(project::toJson(input.project)));
  for (const scene::View& view : input.views) hasher.add(std::string_view(view.name));
  hasher.add(std::string_view(input.context.info().renderer));
  hasher.add(input.size.width).add(input.size.height).add(input.size.samples);
  return hasher.finish();
}

}  // namespace

bool Candidate::operator==(const Candidate& other) const {
  return method.name == other.method.name && sliceResolution == other.sliceResolution && slices == other.slices &&
         lights == other.lights;
}

std::string candidateText(const Candidate& candidate) {
  const std::string side = std::to_string(candidate.sliceResolution);
  return std::string(candidate.method.name) + ", " + std::to_string(candidate.slices) + " layers of " + side + " x " +
         side + (candidate.lights > 0 ? ", " + std::to_string(candidate.lights) + " lights" : "");
}

void applyCandidate(const Candidate& candidate, project::Project& project) {
  project.fit = candidate.method.options(project.fit);
  bake::setSliceResolution(project, candidate.sliceResolution);
  project.sampling.slices = candidate.slices;
  if (candidate.lights > 0) project.lights.count = candidate.lights;
}

std::string choiceText(const Choice& choice) {
  const std::string metric(metricName(choice.accuracy.metric));
  std::string text = "chose " + candidateText(choice.chosen) + ": ";
  text += choice.met ? "the cheapest of " + std::to_string(choice.trials.size()) + " measured that keeps "
                     : "nothing measured keeps ";
  text += metric + (likeness(choice.accuracy.metric) ? " >= " : " <= ") + numberText(choice.accuracy.bound);
  if (!choice.met) text += "; it comes nearest";
  for (const Trial& trial : choice.trials) {
    text += "\n  " + (trial.floor ? std::to_string(trial.candidate.slices) + " layers of " +
                                        std::to_string(trial.candidate.sliceResolution) + " x " +
                                        std::to_string(trial.candidate.sliceResolution) + ", light traced for this sun"
                                  : candidateText(trial.candidate));
    text += ": " + metric + " " + numberText(trial.value) + " in view \"" + trial.worstView + "\", draws in " +
            numberText(trial.drawMs) + " ms";
    if (!trial.floor) text += ", relights in " + numberText(trial.relightMs) + " ms";
    text += trial.meets ? (trial.floor ? "; fits may keep it" : "; keeps it") : (trial.floor ? "; misses it" : "");
  }
  return text;
}

Result<Choice> chooseCheapest(const ChoiceInput& input, const JobContext& job) {
  if (input.views.empty()) {
    return Error::badInput("there is no view to measure errors in", "views", "Add a view to the project.");
  }
  ChoiceInput few{input.project, input.views, input.context, input.cacheFolder, input.size};
  if (few.views.size() > kViews) few.views.resize(kViews);
  SWARD_ASSIGN(const base::Hash128 key, choiceKey(few));
  std::optional<bake::DiskCache> cache;
  if (!input.cacheFolder.empty()) {
    auto opened = bake::DiskCache::open(input.cacheFolder);
    if (opened.ok()) cache.emplace(std::move(opened).value());
  }
  if (cache) {
    if (const auto stored = cache->get("choice", key)) {
      const std::string text(reinterpret_cast<const char*>(stored->data()), stored->size());
      if (auto known = choiceFrom(text, input.project.accuracy)) return std::move(*known);
    }
  }
  SWARD_ASSIGN(Choice choice, Search(few, job).run());
  const std::string text = choiceJson(choice);
  // A full disk only means that it is measured again.
  if (cache) (void)cache->put("choice", key, std::as_bytes(std::span(text)));
  return choice;
}

Result<AccuracyOptions> parseAccuracy(const std::string& text) {
  const std::string remedy = "Give METRIC=BOUND, such as rmse=0.1, psnr=20, ssim=0.5 or flip=0.3.";
  const std::size_t equals = text.find('=');
  const auto name = std::find(kMetricNames.begin(), kMetricNames.end(), text.substr(0, equals));
  if (equals == std::string::npos || name == kMetricNames.end()) {
    return Error::badInput("\"" + text + "\" names no error", "--max-error", remedy);
  }
  AccuracyOptions accuracy;
  accuracy.metric = static_cast<ErrorBound>(name - kMetricNames.begin() + 1);
  const char* end = text.data() + text.size();
  const auto read = std::from_chars(text.data() + equals + 1, end, accuracy.bound);
  if (read.ec != std::errc{} || read.ptr != end || !std::isfinite(accuracy.bound) || accuracy.bound < 0.0) {
    return Error::badInput("\"" + text.substr(equals + 1) + "\" is no bound", "--max-error", remedy);
  }
  return accuracy;
}

}  // namespace sward::report
