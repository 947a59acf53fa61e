#include "project/sequence.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace sward::project {
namespace {

/// The date so many days later. A date that does not exist (validate() says so) stays as it is.
scene::SunMoment later(scene::SunMoment moment, int days) {
  namespace chr = std::chrono;
  const chr::year_month_day date{chr::year(moment.year), chr::month(static_cast<unsigned>(moment.month)),
                                 chr::day(static_cast<unsigned>(moment.day))};
  if (!date.ok() || days == 0) return moment;
  const chr::year_month_day then{chr::sys_days(date) + chr::days(days)};
  moment.year = static_cast<int>(then.year());
  moment.month = static_cast<int>(static_cast<unsigned>(then.month()));
  moment.day = static_cast<int>(static_cast<unsigned>(then.day()));
  return moment;
}

}  // namespace

double weatheringAt(const wither::AgeingOptions& ageing, double season) {
  const double at = std::clamp(season, 0.0, 1.0);
  return ageing.weathering.points().empty() ? at : std::clamp(ageing.weathering(at), 0.0, 1.0);
}

double shareOf(const Sequence& sequence, int frame) {
  if (sequence.frames < 2) return 0.0;
  return static_cast<double>(std::clamp(frame, 0, sequence.frames - 1)) / (sequence.frames - 1);
}

double seasonAt(const Sequence& sequence, double share) {
  const double at = std::clamp(share, 0.0, 1.0);
  return sequence.season.points().empty() ? at : std::clamp(sequence.season(at), 0.0, 1.0);
}

double shareOfSeason(const Sequence& sequence, double season) {
  const double wanted = std::clamp(season, 0.0, 1.0);
  if (sequence.season.points().empty()) return wanted;
  constexpr int kSteps = 256;  // curves have a few points; between two steps the first crossing is bisected
  double before = 0.0;
  if (seasonAt(sequence, 0.0) >= wanted) return 0.0;
  for (int i = 1; i <= kSteps; ++i) {
    const double at = static_cast<double>(i) / kSteps;
    if (seasonAt(sequence, at) >= wanted) {
      double low = before, high = at;
      for (int step = 0; step < 40; ++step) {
        const double middle = 0.5 * (low + high);
        (seasonAt(sequence, middle) >= wanted ? high : low) = middle;
      }
      return high;
    }
    before = at;
  }
  return 0.0;
}

Project projectAt(const Project& project, int frame) {
  Project at = project;
  const Sequence& sequence = project.sequence;
  const double share = shareOf(sequence, frame);
  at.wither.weathering = weatheringAt(project.wither.ageing, seasonAt(sequence, share));
  if (!project.sun.byMoment) return at;
  if (!sequence.hourUtc.points().empty()) at.sun.moment.hourUtc = sequence.hourUtc(share);
  at.sun.moment = later(at.sun.moment, static_cast<int>(std::floor(share * sequence.days)));
  return at;
}

}  // namespace sward::project
