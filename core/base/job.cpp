#include "base/job.h"

namespace sward::base {

ProgressCounter::ProgressCounter(const JobContext& job, std::string stage, std::uint64_t total)
    : m_job(job), m_stage(std::move(stage)), m_total(total == 0 ? 1 : total) {}

void ProgressCounter::add(std::uint64_t steps) {
  const std::uint64_t done = m_done.fetch_add(steps) + steps;
  if (!m_job.onProgress) return;
  const int percent = static_cast<int>(100 * done / m_total);
  int last = m_lastPercent.load();
  while (percent > last) {
    if (m_lastPercent.compare_exchange_weak(last, percent)) {
      const std::scoped_lock lock(m_mutex);
      m_job.onProgress(m_stage, static_cast<double>(done) / static_cast<double>(m_total));
      return;
    }
  }
}

}  // namespace sward::base
