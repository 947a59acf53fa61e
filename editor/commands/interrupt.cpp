#include "interrupt.h"

#include <chrono>
#include <csignal>
#include <ctime>

#include <pthread.h>
#include <unistd.h>

namespace sward::editor {
namespace {

using std::chrono::milliseconds;

sigset_t interruptSignals() {
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, SIGINT);
  sigaddset(&set, SIGTERM);
  return set;
}

/// True when one of the signals came within that time.
bool signalWithin(milliseconds time) {
  const sigset_t set = interruptSignals();
  const timespec limit{time.count() / 1000, (time.count() % 1000) * 1000000};
  return sigtimedwait(&set, nullptr, &limit) > 0;
}

}  // namespace

Interrupts::Interrupts() {
  const sigset_t set = interruptSignals();
  pthread_sigmask(SIG_BLOCK, &set, nullptr);
  m_thread = std::jthread([this](const std::stop_token& quit) { wait(quit); });
}

Interrupts::~Interrupts() = default;

void Interrupts::wait(const std::stop_token& quit) {
  while (!quit.stop_requested()) {
    if (!signalWithin(milliseconds(50))) continue;
    m_stop.request_stop();
    return endSoon(quit);
  }
}

void Interrupts::endSoon(const std::stop_token& quit) {
  const auto deadline = std::chrono::steady_clock::now() + milliseconds(kGraceMs);
  while (!quit.stop_requested()) {
    if (signalWithin(milliseconds(20))) _exit(kExitCode);
    // Some calls of libraries (a frame of the software renderer) cannot be asked to stop.
    if (std::chrono::steady_clock::now() > deadline && m_writing.try_lock_for(milliseconds(20))) _exit(kExitCode);
  }
}

}  // namespace sward::editor
