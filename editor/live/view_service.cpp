#include "live/view_service.h"

#include "live/low_priority.h"
#include "live/view_painter.h"

#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <stop_token>
#include <thread>
#include <utility>

namespace sward::editor {
namespace {

using Clock = std::chrono::steady_clock;

double millisecondsSince(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

/// A growing picture is shown at its 1st, 2nd, 4th, 8th ... sample, where it changes most, and after so long at the
/// latest.
constexpr double kPublishMs = 150.0;

bool isPowerOfTwo(int n) {
  return n > 0 && (n & (n - 1)) == 0;
}

}  // namespace

struct ViewService::Impl {
  Options options;
  mutable std::mutex mutex;
  std::condition_variable_any wake;
  std::optional<ViewRequest> wanted;
  std::optional<ViewPicture> picture;
  std::optional<Error> error;
  std::optional<gpu::DeviceInfo> device;
  double drawMs = 0.0;  ///< the thread's own: of the last sample
  std::jthread thread;  ///< last: it ends before what it uses

  explicit Impl(Options given) : options(std::move(given)) {
    thread = std::jthread([this](std::stop_token stop) { run(std::move(stop)); });
  }

  void run(std::stop_token stop) {
    yieldPriorityOfThisThread();
    ViewPainter painter(options.device, stop);
    while (auto request = next(stop)) {
      Result<void> drawn = drawGuarded(painter, *request, stop);
      if (!drawn.ok()) fail(std::move(drawn).error());
    }
  }

  std::optional<ViewRequest> next(const std::stop_token& stop) {
    std::unique_lock lock(mutex);
    wake.wait(lock, stop, [&] { return wanted.has_value(); });
    if (stop.stop_requested()) return std::nullopt;
    return std::exchange(wanted, std::nullopt);
  }

  bool superseded(const std::stop_token& stop) const {
    std::lock_guard lock(mutex);
    return wanted.has_value() || stop.stop_requested();
  }

  /// Whatever goes wrong in a picture, such as memory for its size, ends that picture and not the program.
  Result<void> drawGuarded(ViewPainter& painter, const ViewRequest& request, const std::stop_token& stop) {
    try {
      return draw(painter, request, stop);
    } catch (const std::exception& exception) {
      return Error::failed(std::string("the picture could not be drawn: ") + exception.what(), "viewport");
    }
  }

  Result<void> draw(ViewPainter& painter, const ViewRequest& request, const std::stop_token& stop) {
    Result<void> begun = painter.begin(request);
    {
      std::lock_guard lock(mutex);
      device = painter.device();
    }
    SWARD_TRY(std::move(begun));
    Clock::time_point published = Clock::now();
    do {
      if (!painter.complete()) {
        const Clock::time_point start = Clock::now();
        SWARD_TRY(painter.addSample());
        drawMs = millisecondsSince(start);
      }
      const int samples = painter.samples();
      if (isPowerOfTwo(samples) || painter.complete() || millisecondsSince(published) >= kPublishMs) {
        SWARD_ASSIGN(image::ByteImage bytes, painter.read());
        publish({request.id, bytes.width, bytes.height, std::move(bytes.rgba), samples,
                 painter.complete() && !request.moving, drawMs, painter.rmse()});
        published = Clock::now();
      }
    } while (!painter.complete() && !superseded(stop));
    return {};
  }

  void publish(ViewPicture made) {
    {
      std::lock_guard lock(mutex);
      picture = std::move(made);
      error.reset();
    }
    if (options.onPicture) options.onPicture();
  }

  void fail(Error what) {
    {
      std::lock_guard lock(mutex);
      error = std::move(what);
    }
    if (options.onPicture) options.onPicture();
  }
};

ViewService::ViewService(Options options) : m_impl(std::make_unique<Impl>(std::move(options))) {}

ViewService::~ViewService() = default;

void ViewService::request(ViewRequest request) {
  {
    std::lock_guard lock(m_impl->mutex);
    m_impl->wanted = std::move(request);
  }
  m_impl->wake.notify_one();
}

std::optional<ViewPicture> ViewService::tryPop() {
  std::lock_guard lock(m_impl->mutex);
  return std::exchange(m_impl->picture, std::nullopt);
}

std::optional<Error> ViewService::error() const {
  std::lock_guard lock(m_impl->mutex);
  return m_impl->error;
}

std::optional<gpu::DeviceInfo> ViewService::device() const {
  std::lock_guard lock(m_impl->mutex);
  return m_impl->device;
}

}  // namespace sward::editor
