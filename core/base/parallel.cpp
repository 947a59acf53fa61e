#include "base/parallel.h"

#include <algorithm>

#include <tbb/blocked_range.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>
#include <tbb/task_arena.h>

namespace sward::base {

int threadCount(const JobContext& job) {
  return job.threads > 0 ? job.threads : tbb::info::default_concurrency();
}

void parallelFor(const JobContext& job, std::size_t count, std::size_t grain,
                 const std::function<void(std::size_t, std::size_t)>& body) {
  if (count == 0) return;
  grain = std::max<std::size_t>(grain, 1);
  const std::size_t blocks = (count + grain - 1) / grain;
  const auto runBlock = [&](std::size_t block) {
    if (job.cancelled()) return;
    body(block * grain, std::min((block + 1) * grain, count));
  };
  if (threadCount(job) == 1) {
    for (std::size_t block = 0; block < blocks; ++block) runBlock(block);
    return;
  }
  // More threads than cores would only make TBB complain: results do not depend on their number.
  tbb::task_arena arena(std::min(threadCount(job), tbb::info::default_concurrency()));
  arena.execute([&] {
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, blocks, 1),
        [&](const tbb::blocked_range<std::size_t>& range) {
          for (std::size_t block = range.begin(); block != range.end(); ++block) runBlock(block);
        },
        tbb::simple_partitioner{});
  });
}

}  // namespace sward::base
