#pragma once

#include "bake/bake.h"
#include "bake/quality.h"
#include "base/result.h"
#include "project/project.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace sward::editor {

/// How finely an edit is shown: at once, soon, and as it will be rendered.
using Quality = bake::Quality;

/// A ground that became ready.
struct BakedGround {
  std::uint64_t revision = 0;  ///< of the newest request that this ground answers
  Quality quality = Quality::Coarse;
  std::shared_ptr<const bake::GroundBake> ground;
  std::shared_ptr<const project::Project> project;     ///< that `ground` was baked from, at `quality`
  std::shared_ptr<const bake::Inspection> inspection;  ///< of `ground`, while inspect(true) holds; else null
  bake::BakeReport report;
  double secondsSinceRequest = 0.0;  ///< since the request that began the bake
};

/// What the service is doing, for the status bar.
struct BakeStatus {
  bool running = false;               ///< something is being baked or waits to be
  Quality quality = Quality::Coarse;  ///< being baked
  std::string stage;
  double fraction = 0.0;              ///< of this quality's bake
  std::optional<double> secondsLeft;  ///< of this quality's bake, an estimate once enough is known
  std::optional<Error> error;         ///< of the newest request, when it failed
  std::uint64_t revision = 0;         ///< of the newest request
};

/// Bakes grounds on a thread of low priority: coarse first, then half, then full. It begins with a finer one that is
/// cached already, and with half when only colours changed and that takes no longer than a coarse picture may. All
/// calls come from one thread, the UI's, and never wait for a bake.
///
/// What a newer request does: when it needs the same ground (another sun, view or exposure), the running bake goes on
/// and answers both, and a ground that was handed out at full quality is not handed out again. When it needs another
/// ground, the running bake is cancelled, except the first one of a request: that is finished and handed out, so that a
/// picture follows a slider that moves faster than bakes do. Only the newest ground is kept for tryPop.
///
/// Coarse and half grounds keep the places of the tiles' diamonds of the full ground before them as long as the
/// project's tiles are set the same, so that the meadow changes under a slider without its tiles jumping.
class BakeService {
 public:
  struct Options {
    std::filesystem::path cacheFolder;  ///< empty: no disk cache
    std::uint64_t cacheLimitBytes = std::uint64_t{4} << 30;
    /// Of results held in memory: enough for a meadow's hits and fits at full quality, so that colours trace nothing.
    std::uint64_t memoryLimitBytes = std::uint64_t{1} << 30;
    int threads = 0;                  ///< of a bake; 0: all of them, at the lowest priority
    std::function<void()> onChanged;  ///< called from the service's threads when there is something new; may be empty
  };
  explicit BakeService(Options options);
  /// Cancels and joins; within a second.
  ~BakeService();
  BakeService(const BakeService&) = delete;
  BakeService& operator=(const BakeService&) = delete;

  void request(std::shared_ptr<const project::Project> project, std::uint64_t revision);
  /// Whether grounds come with an inspection (for the view modes that show one). Turned on, the next request hands its
  /// ground out again, with one.
  void inspect(bool on);
  /// Stops the running bake and drops what waits, also finished grounds; the next request starts afresh and hands its
  /// ground out even if it is the one that was handed out last. For another document, or files changed on disk.
  void cancel();
  /// The finished ground that was not taken yet, if there is one.
  std::optional<BakedGround> tryPop();
  BakeStatus status() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> m_impl;
};

}  // namespace sward::editor
