// Of section wither: the season itself, its steps and presets.

#include "report/section_wither.h"
#include "report/text.h"
#include "wither/season.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

namespace sward::report {
namespace {

constexpr int kFinest = 8192;
constexpr int kSteps[] = {1, 4, 16, 64, 256, 1024};  ///< a season
constexpr const char* kQuantities[] = {"tip_rad", "strain_along", "strain_across"};

using State = std::array<double, 3>;

/// The states at the ends of `steps` steps, and at the beginning.
std::vector<State> seasonInSteps(int steps) {
  const base::Curve water = wither::waterCurve({});
  const auto left = [&](int i) {
    return 1.0 - std::max(water(0.0) - water(static_cast<double>(i) / static_cast<double>(steps)), 0.0);
  };
  wither::BodyMotion motion;
  std::vector<State> states{State{}};
  for (int i = 0; i < steps; ++i) {
    motion.advance((i + 0.5) / steps, 1.0 / steps, left(i), left(i + 1), {});
    states.push_back({motion.state.tipRad, motion.state.strainAlong, motion.state.strainAcross});
  }
  return states;
}

struct Preset {
  wither::Autumn autumn;
  const char* name;
};
constexpr Preset kPresets[] = {{wither::Autumn::Normal, "normal"},
                               {wither::Autumn::AmpleWater, "ample water"},
                               {wither::Autumn::LowTemperature, "low temperature"}};

double tipDeg(const wither::Season& season, double moment) {
  return season.stateAt(moment, 0.0, 1.0).tipRad * 180.0 / std::numbers::pi;
}

/// The first moment at which the tip has turned half as far as at the end.
double halfTurn(const wither::Season& season) {
  constexpr int kMoments = 1000;
  for (int i = 0; i <= kMoments; ++i) {
    const double moment = static_cast<double>(i) / kMoments;
    if (tipDeg(season, moment) >= 0.5 * tipDeg(season, 1.0)) return moment;
  }
  return 1.0;
}

}  // namespace

void addSeasonSteps(Section& section) {
  Plot plot;
  plot.name = "wither_steps";
  plot.title = "Step size against error";
  plot.xLabel = "step, of the season";
  plot.yLabel = "largest error at a step's end";
  plot.caption = "Tip in radians, strains of 1. Halving the step divides the error by four.";
  plot.logX = plot.logY = true;
  const std::vector<State> truth = seasonInSteps(kFinest);
  for (std::size_t q = 0; q < std::size(kQuantities); ++q) {
    Plot::Series series{kQuantities[q], {}, true};
    double before = 0.0;
    for (const int steps : kSteps) {
      const std::vector<State> states = seasonInSteps(steps);
      double max = 0.0;
      for (std::size_t i = 0; i < states.size(); ++i) {
        max = std::max(max, std::abs(states[i][q] - truth[i * static_cast<std::size_t>(kFinest / steps)][q]));
      }
      Row row;
      row.method = "season_step";
      row.numbersAndNames = {{"quantity", '"' + std::string(kQuantities[q]) + '"'},
                             {"step", numberText(1.0 / steps)},
                             {"steps", std::to_string(steps)}};
      if (before > 0.0 && max > 0.0) row.numbersAndNames["order"] = numberText(0.5 * std::log2(before / max));
      row.error = {{"max", max}};
      row.reference = "steps of 1/8192 of the season";
      section.rows.push_back(std::move(row));
      series.points.push_back({1.0 / steps, max, ""});
      before = max;
    }
    plot.series.push_back(std::move(series));
  }
  section.plots.push_back(std::move(plot));
}

Result<void> addAutumns(Section& section) {
  constexpr int kMoments = 40;
  Plot turn;
  turn.name = "wither_autumn_tip";
  turn.title = "The tip of a blade over the season";
  turn.xLabel = "season, of 1";
  turn.yLabel = "turn of the tip, degrees";
  turn.caption = "A mean blade in each of the autumns: with ample water it stays upright.";
  Plot shares = turn;
  shares.name = "wither_autumn_shares";
  shares.title = "Water and chlorophyll over the season";
  shares.yLabel = "share of what there was";
  shares.caption =
      "What drives withering: turgor and length follow water, colour follows both. With ample water chlorophyll falls "
      "as in the normal autumn.";
  for (const Preset& preset : kPresets) {
    wither::AgeingOptions ageing;
    ageing.autumn = preset.autumn;
    SWARD_ASSIGN(const wither::Season season, wither::Season::create(ageing, {}));
    Plot::Series tip{preset.name, {}, true};
    Plot::Series water{std::string("water, ") + preset.name, {}, true};
    Plot::Series green{std::string("chlorophyll, ") + preset.name, {}, true};
    for (int i = 0; i <= kMoments; ++i) {
      const double moment = static_cast<double>(i) / kMoments;
      tip.points.push_back({moment, tipDeg(season, moment), ""});
      water.points.push_back({moment, season.water(moment), ""});
      green.points.push_back({moment, season.chlorophyll(moment), ""});
    }
    turn.series.push_back(std::move(tip));
    shares.series.push_back(std::move(water));
    if (preset.autumn != wither::Autumn::AmpleWater) shares.series.push_back(std::move(green));
    Row row;
    row.method = "autumn";
    row.numbersAndNames = {{"autumn", '"' + std::string(preset.name) + '"'},
                           {"tip_deg", numberText(tipDeg(season, 1.0))},
                           {"strain_along", numberText(season.stateAt(1.0, 0.0, 1.0).strainAlong)},
                           {"strain_across", numberText(season.stateAt(1.0, 0.0, 1.0).strainAcross)},
                           {"water", numberText(season.water(1.0))},
                           {"chlorophyll", numberText(season.chlorophyll(1.0))},
                           {"half_turn", numberText(halfTurn(season))}};
    section.rows.push_back(std::move(row));
  }
  section.plots.push_back(std::move(turn));
  section.plots.push_back(std::move(shares));
  return {};
}

}  // namespace sward::report
