#pragma once

#include "base/job.h"

#include <cstddef>
#include <functional>

namespace sward::base {

/// Calls body(begin, end) over disjoint ranges that cover [0, count), each at most `grain` long, on job.threads threads
/// (0: all). Ranges are always [i * grain, min((i + 1) * grain, count)), whatever the number of threads, so a body that
/// writes only its own range gives the same bytes on any number of threads. Stops early, with ranges left out, once the
/// job is cancelled: ask job.cancelled() afterwards. Exceptions of the body reach the caller.
void parallelFor(const JobContext& job, std::size_t count, std::size_t grain,
                 const std::function<void(std::size_t begin, std::size_t end)>& body);

/// The number of threads that a job runs on: job.threads, or the machine's when that is 0.
int threadCount(const JobContext& job);

}  // namespace sward::base
