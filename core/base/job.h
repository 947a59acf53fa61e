#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <mutex>
#include <stop_token>
#include <string>

namespace sward::base {

/// What a running job may ask and tell: whether it should stop, how far it is, how many threads it may use.
/// Copies share the same stop token; the callback may be called from any worker, one call at a time.
struct JobContext {
  std::stop_token stop;  ///< a request ends the job with Error::cancelled()
  std::function<void(const std::string& stage, double fraction)> onProgress;  ///< fraction in [0, 1]; may be empty
  int threads = 0;                                                            ///< 0: as many as the machine has

  bool cancelled() const { return stop.stop_requested(); }
};

/// Counts finished steps from many threads and reports at most a hundred times per stage.
class ProgressCounter {
 public:
  ProgressCounter(const JobContext& job, std::string stage, std::uint64_t total);
  void add(std::uint64_t steps = 1);

 private:
  const JobContext& m_job;
  std::string m_stage;
  std::uint64_t m_total;
  std::atomic<std::uint64_t> m_done{0};
  std::atomic<int> m_lastPercent{-1};
  std::mutex m_mutex;
};

}  // namespace sward::base

namespace sward {
using base::JobContext;
}
