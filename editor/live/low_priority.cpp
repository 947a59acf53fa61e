#include "live/low_priority.h"

#include <atomic>

#include <sys/resource.h>
#include <sys/syscall.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <unistd.h>

namespace sward::editor {
namespace {

/// On Linux a priority belongs to a thread, and a new thread inherits its maker's (setpriority(2), "Linux/C library
/// differences").
void setNiceOfThisThread(int nice) {
  static_cast<void>(::setpriority(PRIO_PROCESS, static_cast<id_t>(::syscall(SYS_gettid)), nice));
}

}  // namespace

void lowerPriorityOfThisThread() {
  constexpr int kLowest = 19;
  setNiceOfThisThread(kLowest);
}

void yieldPriorityOfThisThread() {
  constexpr int kYielding = 5;
  setNiceOfThisThread(kYielding);
}

void startSchedulerThreads() {
  std::atomic<int> sum{0};
  tbb::parallel_for(0, 64 * tbb::info::default_concurrency(), [&](int i) { sum.fetch_add(i); });
}

}  // namespace sward::editor
