#pragma once

#include "bake/ground_bake.h"
#include "trace/ground_plan.h"

namespace sward::bake {

/// The tiles and map of a ground as the reference traces them.
trace::GroundPlan groundPlan(const GroundBake& ground);

}  // namespace sward::bake
