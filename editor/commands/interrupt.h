#pragma once

#include <atomic>
#include <mutex>
#include <stop_token>
#include <thread>

namespace sward::editor {

/// Turns Ctrl-C (SIGINT) and SIGTERM into a stop request. Make it first of all in main: threads made later inherit the
/// blocked signals, and one thread of its own waits for them. A second signal ends the process at once; so does the
/// first one when the work has not ended within kGraceMs, except that a file being written is finished first.
class Interrupts {
 public:
  static constexpr int kExitCode = 130;
  static constexpr int kGraceMs = 700;

  Interrupts();
  ~Interrupts();
  Interrupts(const Interrupts&) = delete;
  Interrupts& operator=(const Interrupts&) = delete;

  std::stop_token token() const { return m_stop.get_token(); }
  bool requested() const { return m_stop.stop_requested(); }

  /// Held while an output file is written.
  std::unique_lock<std::timed_mutex> writing() { return std::unique_lock(m_writing); }

 private:
  void wait(const std::stop_token& quit);
  void endSoon(const std::stop_token& quit);

  std::stop_source m_stop;
  std::timed_mutex m_writing;
  std::jthread m_thread;
};

}  // namespace sward::editor
