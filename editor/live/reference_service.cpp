#include "live/reference_service.h"

#include "live/low_priority.h"
#include "live/reference_tracer.h"

#include <condition_variable>
#include <exception>
#include <mutex>
#include <new>
#include <stop_token>
#include <thread>
#include <utility>

namespace sward::editor {
namespace {

using PicturePtr = std::shared_ptr<const ReferencePicture>;

}  // namespace

struct ReferenceService::Impl {
  explicit Impl(Options given) : options(std::move(given)) {
    worker = std::jthread([this](const std::stop_token& stop) { run(stop); });
  }
  ~Impl() {
    {
      const std::scoped_lock lock(mutex);
      worker.request_stop();
      batch.request_stop();
    }
    changed.notify_all();
  }

  // On the UI's thread.
  void request(ReferenceRequest next);
  void close();

  // On the worker.
  struct Step {
    ReferenceRequest request;
    std::stop_token stop;
  };
  void run(const std::stop_token& stop);
  std::optional<Step> next(const std::stop_token& stop, ReferenceTracer& tracer);
  void serve(const Step& step, ReferenceTracer& tracer);
  Result<PicturePtr> traceGuarded(const Step& step, ReferenceTracer& tracer) const;

  bool hasWork() const { return wanted && !wanted->held && !rests; }

  const Options options;
  mutable std::mutex mutex;
  std::condition_variable_any changed;
  std::optional<ReferenceRequest> wanted;
  bool closing = false;  ///< the worker is to let go of what it keeps
  bool rests = false;    ///< nothing is left to do for `wanted`
  std::stop_source batch;
  PicturePtr picture;
  std::optional<Error> error;
  int trees = 0;

  std::jthread worker;  ///< last: joins before the rest goes
};

void ReferenceService::Impl::request(ReferenceRequest next) {
  {
    const std::scoped_lock lock(mutex);
    const bool same = wanted && sameReference(*wanted, next);
    if (same && wanted->moving == next.moving && wanted->held == next.held) return;
    if (!same || next.held) batch.request_stop();
    if (!same) {
      picture.reset();
      error.reset();
    }
    rests = same && error.has_value();  // what failed fails again
    wanted = std::move(next);
  }
  changed.notify_all();
}

void ReferenceService::Impl::close() {
  {
    const std::scoped_lock lock(mutex);
    if (!wanted) return;
    batch.request_stop();
    wanted.reset();
    picture.reset();
    error.reset();
    closing = true;
  }
  changed.notify_all();
}

void ReferenceService::Impl::run(const std::stop_token& stop) {
  lowerPriorityOfThisThread();
  ReferenceTracer tracer(options.samples);
  while (const auto step = next(stop, tracer)) serve(*step, tracer);
}

std::optional<ReferenceService::Impl::Step> ReferenceService::Impl::next(const std::stop_token& stop,
                                                                         ReferenceTracer& tracer) {
  std::unique_lock lock(mutex);
  while (changed.wait(lock, stop, [&] { return closing || hasWork(); })) {
    if (std::exchange(closing, false)) {
      lock.unlock();
      tracer.clear();
      lock.lock();
    } else if (tracer.complete(*wanted)) {
      rests = true;
    } else if (!stop.stop_requested()) {
      // A stop source of its own for each batch, so that a stop of the last one does not reach it.
      batch = std::stop_source();
      return Step{*wanted, batch.get_token()};
    }
    if (stop.stop_requested()) break;
  }
  return std::nullopt;
}

void ReferenceService::Impl::serve(const Step& step, ReferenceTracer& tracer) {
  Result<PicturePtr> traced = traceGuarded(step, tracer);
  {
    const std::scoped_lock lock(mutex);
    trees = tracer.trees();
    // A batch that was stopped may have come to its end all the same.
    if (!wanted || !sameReference(*wanted, step.request)) return;
    if (!traced.ok() && traced.error().kind == ErrorKind::Cancelled) return;
    rests = !traced.ok() || tracer.complete(*wanted);
    if (traced.ok()) {
      picture = std::move(traced).value();
    } else {
      error = std::move(traced).error();
    }
  }
  if (options.onChanged) options.onChanged();
}

Result<PicturePtr> ReferenceService::Impl::traceGuarded(const Step& step, ReferenceTracer& tracer) const {
  const JobContext job{step.stop, {}, options.threads};
  try {
    return tracer.addBatch(step.request, job);
  } catch (const std::bad_alloc&) {
    tracer.clear();
    return Error::failed("there is not enough memory for the reference", "reference",
                         "Make the window smaller, lower the number of plants, or close other programs.");
  } catch (const std::exception& exception) {
    tracer.clear();
    return Error::failed(std::string("the reference broke off: ") + exception.what(), "reference",
                         "Compare with something else, and report it: this is a fault of the program.");
  }
}

ReferenceService::ReferenceService(Options options) : m_impl(std::make_unique<Impl>(std::move(options))) {}
ReferenceService::~ReferenceService() = default;

void ReferenceService::request(ReferenceRequest request) {
  m_impl->request(std::move(request));
}
void ReferenceService::close() {
  m_impl->close();
}
std::shared_ptr<const ReferencePicture> ReferenceService::picture() const {
  const std::scoped_lock lock(m_impl->mutex);
  return m_impl->picture;
}
ReferenceService::Status ReferenceService::status() const {
  const std::scoped_lock lock(m_impl->mutex);
  return {m_impl->hasWork(), m_impl->error, m_impl->trees};
}

}  // namespace sward::editor
