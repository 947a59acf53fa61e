#include "live/thumbnail_service.h"

#include "bake/plants.h"
#include "live/low_priority.h"

#include <algorithm>
#include <condition_variable>
#include <deque>
#include <exception>
#include <map>
#include <mutex>
#include <stop_token>
#include <thread>
#include <utility>

namespace sward::editor {
namespace {

/// All that a plant's picture depends on, but for the bytes of its asset.
struct Values {
  project::Plant plant;
  std::size_t index = 0;
  std::uint64_t seed = 0;
  std::filesystem::path folder;

  bool operator==(const Values& other) const {
    // Names and how plants are strewn do not show on one of them.
    project::Plant a = plant, b = other.plant;
    for (project::Plant* p : {&a, &b}) {
      p->name.clear();
      p->densityPerM2 = p->share = p->sizeVariation = p->tiltDeg = p->clumping = 0.0;
      p->variants = 1;
    }
    return a == b && index == other.index && seed == other.seed && folder == other.folder;
  }
};

/// A project of this plant alone at its place in the list, for bake::plantModel.
Result<mesh::Model> modelOf(const Values& values) {
  project::Project project;
  project.folder = values.folder;
  project.patch.seed = values.seed;
  project.patch.plants.resize(values.index + 1);
  project.patch.plants[values.index] = values.plant;
  return bake::plantModel(project, values.index, 0);
}

PlantPicture draw(std::uint64_t slot, const Values& values, const trace::ThumbnailOptions& options,
                  const JobContext& job) {
  PlantPicture picture;
  picture.slot = slot;
  try {
    const auto model = modelOf(values);
    if (!model.ok()) {
      picture.error = model.error();
      return picture;
    }
    auto drawn = trace::drawThumbnail(*model, options, job);
    if (drawn.ok()) {
      picture.thumbnail = std::move(drawn).value();
    } else {
      picture.error = std::move(drawn).error();
    }
  } catch (const std::exception& exception) {
    picture.error = Error::failed(std::string("the picture broke off: ") + exception.what(), values.plant.name,
                                  "Use a simpler mesh, or close other programs.");
  }
  return picture;
}

}  // namespace

struct ThumbnailService::Impl {
  explicit Impl(Options given) : options(std::move(given)) {
    worker = std::jthread([this](std::stop_token stop) { run(stop); });
  }

  void run(const std::stop_token& stop);
  /// Drops finished pictures of a slot and what waits for it.
  void drop(std::uint64_t slot);

  const Options options;
  mutable std::mutex mutex;
  std::condition_variable_any changed;
  std::deque<std::pair<std::uint64_t, Values>> waiting;
  std::map<std::uint64_t, Values> newest;  ///< of each slot: asked for, drawn or being drawn
  std::deque<PlantPicture> finished;
  bool drawing = false;
  std::jthread worker;  ///< last: joins before the rest goes
};

void ThumbnailService::Impl::drop(std::uint64_t slot) {
  std::erase_if(waiting, [&](const auto& entry) { return entry.first == slot; });
  std::erase_if(finished, [&](const PlantPicture& picture) { return picture.slot == slot; });
}

void ThumbnailService::Impl::run(const std::stop_token& stop) {
  lowerPriorityOfThisThread();
  const JobContext job{stop, {}, 1};
  for (;;) {
    std::pair<std::uint64_t, Values> next;
    {
      std::unique_lock lock(mutex);
      drawing = false;
      if (!changed.wait(lock, stop, [&] { return !waiting.empty(); })) return;
      next = std::move(waiting.front());
      waiting.pop_front();
      drawing = true;
    }
    PlantPicture picture = draw(next.first, next.second, options.picture, job);
    if (stop.stop_requested()) return;
    {
      const std::scoped_lock lock(mutex);
      const auto wanted = newest.find(next.first);
      if (wanted == newest.end() || !(wanted->second == next.second)) continue;
      finished.push_back(std::move(picture));
    }
    if (options.onPicture) options.onPicture();
  }
}

ThumbnailService::ThumbnailService(Options options) : m_impl(std::make_unique<Impl>(std::move(options))) {}
ThumbnailService::~ThumbnailService() = default;

void ThumbnailService::request(std::uint64_t slot, const project::Plant& plant, std::size_t index, std::uint64_t seed,
                               const std::filesystem::path& folder) {
  Values values{plant, index, seed, folder};
  {
    const std::scoped_lock lock(m_impl->mutex);
    const auto known = m_impl->newest.find(slot);
    if (known != m_impl->newest.end() && known->second == values) return;
    m_impl->drop(slot);
    m_impl->newest[slot] = values;
    m_impl->waiting.emplace_back(slot, std::move(values));
  }
  m_impl->changed.notify_all();
}

void ThumbnailService::forget(std::uint64_t slot) {
  const std::scoped_lock lock(m_impl->mutex);
  m_impl->drop(slot);
  m_impl->newest.erase(slot);
}

std::optional<PlantPicture> ThumbnailService::tryPop() {
  const std::scoped_lock lock(m_impl->mutex);
  if (m_impl->finished.empty()) return std::nullopt;
  PlantPicture picture = std::move(m_impl->finished.front());
  m_impl->finished.pop_front();
  return picture;
}

bool ThumbnailService::busy() const {
  const std::scoped_lock lock(m_impl->mutex);
  return m_impl->drawing || !m_impl->waiting.empty();
}

}  // namespace sward::editor
