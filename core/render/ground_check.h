#pragma once

#include "bake/ground_bake.h"
#include "base/result.h"

namespace sward::render {

/// Every size of a ground that shaders rely on. Errors: the first that does not fit.
Result<void> checkGround(const bake::GroundBake& ground);

/// Whether it has blade sets at all: without them slices serve at every angle.
bool bladesPresent(const bake::GroundBake& ground);

}  // namespace sward::render
