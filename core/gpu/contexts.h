#pragma once

#include "gpu/context.h"

namespace sward::gpu {

/// EGL without a surface: hardware devices first, then Mesa's surfaceless platform (which may be software), then any
/// device that is left.
Result<std::unique_ptr<Context>> createEglContext();
/// OSMesa, opened at run time; an error names the libraries that were looked for.
Result<std::unique_ptr<Context>> createOsMesaContext();

}  // namespace sward::gpu
