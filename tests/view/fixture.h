#pragma once

#include "live/view_service.h"

#include "image/bytes.h"
#include "render/fixture.h"

#include <gtest/gtest.h>

#include <chrono>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

namespace sward::testing {

/// A ViewService whose pictures are collected as they come, and a patience that only a hang exceeds.
class Viewer {
 public:
  explicit Viewer(gpu::Device device = gpu::Device::Egl)
      : m_service({device, [this] {
                     std::lock_guard lock(m_mutex);
                     ++m_events;
                     m_changed.notify_all();
                   }}) {}

  editor::ViewService& service() { return m_service; }

  /// Requests a picture, waits until it is whole; nothing after an error.
  std::optional<editor::ViewPicture> picture(editor::ViewRequest request) {
    request.id = ++m_lastId;
    const bool moving = request.moving;
    m_service.request(std::move(request));
    return wait(m_lastId, [&](const editor::ViewPicture& p) { return p.final || moving; });
  }

  /// picture() after an error: that stands until another picture is drawn or fails, so both are waited for.
  std::optional<editor::ViewPicture> recover(editor::ViewRequest request) {
    request.id = ++m_lastId;
    int before = 0;
    {
      std::lock_guard lock(m_mutex);
      before = m_events;
    }
    const std::uint64_t id = request.id;
    m_service.request(std::move(request));
    {
      std::unique_lock lock(m_mutex);
      EXPECT_TRUE(m_changed.wait_for(lock, kPatience, [&] { return m_events != before; }));
    }
    return wait(id, [](const editor::ViewPicture& p) { return p.final; });
  }

  /// The first picture of a request for which `enough` holds; nothing after an error.
  template <typename Enough>
  std::optional<editor::ViewPicture> wait(std::uint64_t id, const Enough& enough) {
    std::unique_lock lock(m_mutex);
    while (true) {
      if (auto popped = m_service.tryPop()) {
        m_seen.push_back({popped->id, popped->samples});
        if (popped->id == id && enough(*popped)) return popped;
        continue;
      }
      if (m_service.error()) return std::nullopt;
      const int events = m_events;
      const bool told = m_changed.wait_for(lock, kPatience, [&] { return m_events != events || m_events > m_taken; });
      m_taken = m_events;
      if (!told) {
        ADD_FAILURE() << "no picture came";
        return std::nullopt;
      }
    }
  }

  struct Seen {
    std::uint64_t id;
    int samples;
  };
  const std::vector<Seen>& seen() const { return m_seen; }

 private:
  static constexpr std::chrono::seconds kPatience{120};
  std::mutex m_mutex;
  std::condition_variable m_changed;
  int m_events = 0, m_taken = 0;
  std::vector<Seen> m_seen;
  std::uint64_t m_lastId = 0;
  editor::ViewService m_service;  ///< last: it calls back until it is gone
};

inline image::ByteImage bytesOf(const editor::ViewPicture& picture) {
  return {picture.width, picture.height, picture.rgba};
}

/// A small project over a small synthetic ground, which no bake made.
inline std::shared_ptr<project::Project> smallProject() {
  auto project = std::make_shared<project::Project>();
  project->render.samples = 6;
  project->sun.angles = {150.0, 40.0};
  return project;
}

inline editor::ViewRequest smallRequest() {
  editor::ViewRequest request;
  request.project = smallProject();
  request.ground = makeGround(smallOptions());
  request.view.position = {0.2, -2.5, 1.1};
  request.view.target = {0.2, 0.5, 0.1};
  request.width = 150;
  request.height = 90;
  return request;
}

}  // namespace sward::testing
