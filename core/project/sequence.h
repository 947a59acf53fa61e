#pragma once

#include "project/project.h"

namespace sward::project {

/// The weathering degree at a moment of the season, both in [0, 1].
double weatheringAt(const wither::AgeingOptions& ageing, double season);

/// Where a frame stands in its sequence: 0 is the first frame, 1 the last; 0 in a sequence of one frame. Frames count
/// from 0 and are clamped to the sequence's.
double shareOf(const Sequence& sequence, int frame);
/// The season's moment at a share of a sequence, both in [0, 1].
double seasonAt(const Sequence& sequence, double share);
/// The earliest share at which the sequence shows a moment of the season; 0 where it never does.
double shareOfSeason(const Sequence& sequence, double season);

/// The project as one frame shows it: what the sequence changes is set, all else stays. The same frame of the same
/// project is the same whatever other frames are drawn.
Project projectAt(const Project& project, int frame);

}  // namespace sward::project
