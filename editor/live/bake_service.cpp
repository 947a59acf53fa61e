#include "live/bake_service.h"

#include "bake/keys.h"
#include "live/low_priority.h"

#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <stop_token>
#include <thread>
#include <utility>
#include <vector>

namespace sward::editor {
namespace {

using Clock = std::chrono::steady_clock;
using ProjectPtr = std::shared_ptr<const project::Project>;

double secondsSince(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

struct Request {
  ProjectPtr project;
  std::uint64_t revision = 0;
  Clock::time_point when;
};

}  // namespace

struct BakeService::Impl {
  explicit Impl(Options given) : options(std::move(given)) {
    worker = std::jthread([this](std::stop_token stop) { run(stop); });
  }
  ~Impl() {
    {
      const std::scoped_lock lock(mutex);
      worker.request_stop();
      bakeStop.request_stop();
    }
    changed.notify_all();
  }

  // On the UI's thread.
  void request(ProjectPtr project, std::uint64_t revision);
  void cancel();

  // On the worker.
  void run(const std::stop_token& stop);
  void serve(bake::Baker& baker, const Request& request);
  Result<void> bakeQualities(bake::Baker& baker, const Request& request);
  Result<bool> bakeOne(bake::Baker& baker, const Request& request, Quality quality);
  Result<Quality> firstQuality(bake::Baker& baker, const Request& request, const base::Hash128& fullKey);
  bake::GroundRequest wanted(const Request& request, Quality quality) const;
  void keepLayout(const Request& request, const BakedGround& baked);
  std::stop_source begin(Quality quality);
  void finish(BakedGround baked, const base::Hash128& key);
  void fail(Error error);
  void showProgress(const std::string& stage, double fraction);
  bool inspects() const;
  bool superseded(const Request& request) const;
  bool followsSlider() const;
  void tell() const {
    if (options.onChanged) options.onChanged();
  }

  const Options options;
  mutable std::mutex mutex;
  std::condition_variable_any changed;
  std::optional<Request> waiting;      ///< the newest request that was not begun
  std::optional<Request> active;       ///< being baked; its revision is that of the newest request for this ground
  std::uint64_t generation = 0;        ///< of cancel(): what was begun before is dropped
  std::uint64_t activeGeneration = 0;  ///< when `active` was begun
  std::stop_source bakeStop;
  Quality first = Quality::Coarse;  ///< that the active request begins with
  BakeStatus status;
  Clock::time_point begun;     ///< of the running quality
  Clock::time_point lastTold;  ///< when progress was last passed on
  std::optional<BakedGround> finished;
  std::optional<base::Hash128> handedOut;  ///< key of the ground that was finished last
  bool inspecting = false;

  // The worker's own.
  std::vector<glm::ivec2> layout;  ///< of the tiles on screen, and what it was made for:
  tiles::TileOptions layoutTiles;
  int layoutBlades = 0;
  double halfColourSeconds = 0.0;  ///< that the last half bake took which traced nothing

  std::jthread worker;  ///< last: joins before the rest goes
};

void BakeService::Impl::request(ProjectPtr project, std::uint64_t revision) {
  {
    const std::scoped_lock lock(mutex);
    Request next{std::move(project), revision, Clock::now()};
    status.revision = revision;
    status.running = true;
    if (active && bake::sameGroundValues(*active->project, *next.project)) {
      // The running bake answers this request too. It waits all the same: an asset file may have changed meanwhile.
      active->revision = revision;
    } else if (active && !followsSlider()) {
      bakeStop.request_stop();
    }
    waiting = std::move(next);
  }
  changed.notify_all();
}

void BakeService::Impl::cancel() {
  {
    const std::scoped_lock lock(mutex);
    ++generation;
    bakeStop.request_stop();
    waiting.reset();
    finished.reset();
    handedOut.reset();
    status.running = false;
    status.error.reset();
  }
  changed.notify_all();
}

void BakeService::Impl::run(const std::stop_token& stop) {
  lowerPriorityOfThisThread();
  startSchedulerThreads();
  std::optional<bake::DiskCache> disk;
  if (!options.cacheFolder.empty()) {
    auto opened = bake::DiskCache::open(options.cacheFolder, options.cacheLimitBytes);
    if (opened.ok()) disk = std::move(opened).value();
  }
  bake::Baker baker(std::move(disk), {options.memoryLimitBytes, true});
  while (!stop.stop_requested()) {
    Request next;
    {
      std::unique_lock lock(mutex);
      if (!changed.wait(lock, stop, [&] { return waiting.has_value(); })) return;
      next = *std::exchange(waiting, std::nullopt);
      active = next;
      activeGeneration = generation;
    }
    serve(baker, next);
    {
      const std::scoped_lock lock(mutex);
      active.reset();
      status.running = waiting.has_value();
    }
    tell();
  }
}

void BakeService::Impl::serve(bake::Baker& baker, const Request& request) {
  try {
    if (Result<void> outcome = bakeQualities(baker, request); !outcome.ok()) fail(std::move(outcome).error());
  } catch (const std::bad_alloc&) {
    fail(Error::failed("there is not enough memory for the bake", "bake",
                       "Lower the sampling or the number of plants, or close other programs."));
  } catch (const std::exception& exception) {
    fail(Error::failed(std::string("the bake broke off: ") + exception.what(), "bake",
                       "This is a fault of the program; undo the last edit and report it."));
  }
}

Result<void> BakeService::Impl::bakeQualities(bake::Baker& baker, const Request& request) {
  SWARD_ASSIGN(const base::Hash128 fullKey, baker.key({*request.project, Quality::Full}));
  {
    const std::scoped_lock lock(mutex);
    status.error.reset();
    if (handedOut == fullKey) return {};
  }
  SWARD_ASSIGN(const Quality begin, firstQuality(baker, request, fullKey));
  {
    const std::scoped_lock lock(mutex);
    first = begin;
    status.quality = begin;
  }
  for (const Quality quality : {Quality::Coarse, Quality::Half, Quality::Full}) {
    if (quality < begin) continue;
    SWARD_ASSIGN(const bool goOn, bakeOne(baker, request, quality));
    if (!goOn) return {};
  }
  return {};
}

Result<Quality> BakeService::Impl::firstQuality(bake::Baker& baker, const Request& request,
                                                const base::Hash128& fullKey) {
  constexpr double kSoonSeconds = 0.15;
  if (baker.holds(fullKey)) return Quality::Full;
  const bake::GroundRequest half = wanted(request, Quality::Half);
  SWARD_ASSIGN(const base::Hash128 halfKey, baker.key(half));
  if (baker.holds(halfKey)) return Quality::Half;
  SWARD_ASSIGN(const bool coloursAlone, baker.tracesNothing(half));
  return coloursAlone && halfColourSeconds < kSoonSeconds ? Quality::Half : Quality::Coarse;
}

bake::GroundRequest BakeService::Impl::wanted(const Request& request, Quality quality) const {
  bake::GroundRequest wanted{*request.project, quality, {}};
  const bool same = request.project->tiles == layoutTiles && request.project->sampling.blades == layoutBlades;
  if (quality != Quality::Full && same) wanted.layout = layout;
  return wanted;
}

void BakeService::Impl::keepLayout(const Request& request, const BakedGround& baked) {
  layout = bake::layoutOf(*baked.ground);
  layoutTiles = request.project->tiles;
  layoutBlades = request.project->sampling.blades;
}

/// False when a newer request wants another ground.
Result<bool> BakeService::Impl::bakeOne(bake::Baker& baker, const Request& request, Quality quality) {
  const bake::GroundRequest asked = wanted(request, quality);
  SWARD_ASSIGN(const base::Hash128 key, baker.key(asked));
  {
    const std::scoped_lock lock(mutex);
    if (handedOut == key) return true;  // no coarser than the one before it: this project cannot be divided further
  }
  const std::stop_source stop = begin(quality);
  if (superseded(request)) return false;
  JobContext job{stop.get_token(), [this](const std::string& stage, double fraction) { showProgress(stage, fraction); },
                 options.threads};
  BakedGround baked;
  const bool held = baker.holds(key);
  const auto start = Clock::now();
  auto ground = baker.ground(asked, job, &baked.report);
  if (!ground.ok()) {
    if (ground.error().kind == ErrorKind::Cancelled) return false;
    return std::move(ground).error();
  }
  baked.ground = std::move(ground).value();
  if (inspects()) {
    SWARD_ASSIGN(baked.inspection, baker.inspection(asked, job));
  }
  baked.project = request.project;
  baked.quality = quality;
  keepLayout(request, baked);
  const bool traced = baked.report.raysNearest + baked.report.raysOcclusion > 0;
  if (quality == Quality::Half && !traced && !held) halfColourSeconds = secondsSince(start);
  baked.secondsSinceRequest = secondsSince(request.when);
  finish(std::move(baked), key);
  return !superseded(request);
}

bool BakeService::Impl::inspects() const {
  const std::scoped_lock lock(mutex);
  return inspecting;
}

/// A stop source of its own for each quality, so that a stop of the last one does not reach it.
std::stop_source BakeService::Impl::begin(Quality quality) {
  std::stop_source stop;
  {
    const std::scoped_lock lock(mutex);
    bakeStop = stop;
    if (worker.get_stop_token().stop_requested() || generation != activeGeneration) stop.request_stop();
    status.quality = quality;
    status.stage.clear();
    status.fraction = 0.0;
    status.secondsLeft.reset();
    begun = Clock::now();
  }
  tell();
  return stop;
}

void BakeService::Impl::finish(BakedGround baked, const base::Hash128& key) {
  {
    const std::scoped_lock lock(mutex);
    if (generation != activeGeneration) return;
    baked.revision = active->revision;
    finished = std::move(baked);
    handedOut = key;
  }
  tell();
}

void BakeService::Impl::fail(Error error) {
  {
    const std::scoped_lock lock(mutex);
    // The newest request says what is wrong, not one that was replaced meanwhile.
    if (generation != activeGeneration || error.kind == ErrorKind::Cancelled) return;
    if (waiting && !bake::sameGroundValues(*waiting->project, *active->project)) return;
    status.error = std::move(error);
  }
  tell();
}

/// Whether the running bake is one that is finished whatever comes. A full one is begun with only when it is in a
/// cache, but an entry may turn out damaged.
bool BakeService::Impl::followsSlider() const {
  constexpr double kReadSeconds = 0.5;
  return status.quality == first && (first != Quality::Full || secondsSince(begun) < kReadSeconds);
}

bool BakeService::Impl::superseded(const Request& request) const {
  const std::scoped_lock lock(mutex);
  if (generation != activeGeneration || worker.get_stop_token().stop_requested()) return true;
  return waiting && !bake::sameGroundValues(*waiting->project, *request.project);
}

void BakeService::Impl::showProgress(const std::string& stage, double fraction) {
  constexpr double kSureAfterSeconds = 1.0, kSureAfter = 0.02;
  constexpr std::chrono::milliseconds kBetween{100};  // a window need not be drawn more often for a number
  {
    const std::scoped_lock lock(mutex);
    status.stage = stage;
    status.fraction = std::max(status.fraction, fraction);
    const double spent = secondsSince(begun);
    if (spent > kSureAfterSeconds && status.fraction > kSureAfter) {
      status.secondsLeft = spent / status.fraction - spent;
    }
    const auto now = Clock::now();
    if (now - lastTold < kBetween) return;
    lastTold = now;
  }
  tell();
}

BakeService::BakeService(Options options) : m_impl(std::make_unique<Impl>(std::move(options))) {}
BakeService::~BakeService() = default;

void BakeService::request(std::shared_ptr<const project::Project> project, std::uint64_t revision) {
  m_impl->request(std::move(project), revision);
}
void BakeService::inspect(bool on) {
  const std::scoped_lock lock(m_impl->mutex);
  if (on && !m_impl->inspecting) m_impl->handedOut.reset();
  m_impl->inspecting = on;
}
void BakeService::cancel() {
  m_impl->cancel();
}
std::optional<BakedGround> BakeService::tryPop() {
  const std::scoped_lock lock(m_impl->mutex);
  return std::exchange(m_impl->finished, std::nullopt);
}
BakeStatus BakeService::status() const {
  const std::scoped_lock lock(m_impl->mutex);
  return m_impl->status;
}

}  // namespace sward::editor
