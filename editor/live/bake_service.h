#pragma once

#include "bake/bake.h"
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
enum class Quality { Coarse, Half, Full };

/// A ground that became ready.
struct BakedGround {
  std::uint64_t revision = 0;  ///< of the request
  Quality quality = Quality::Coarse;
  std::shared_ptr<const bake::GroundBake> ground;
  bake::BakeReport report;
  double secondsSinceRequest = 0.0;
};

/// What the service is doing, for the status bar.
struct BakeStatus {
  bool running = false;
  Quality quality = Quality::Coarse;  ///< being baked
  std::string stage;
  double fraction = 0.0;              ///< of this quality's bake
  std::optional<double> secondsLeft;  ///< an estimate once enough is known
  std::optional<Error> error;         ///< of the newest request, when it failed
  std::uint64_t revision = 0;
};

/// Bakes grounds on a thread of low priority: coarse first, then half, then full. A newer request cancels the running
/// bake when it needs another ground; one that needs the same ground (another sun, view or exposure) does not disturb
/// it. All calls come from one thread, the UI's, and never wait for a bake.
class BakeService {
 public:
  struct Options {
    std::filesystem::path cacheFolder;  ///< empty: no disk cache
    std::uint64_t cacheLimitBytes = std::uint64_t{4} << 30;
    int threads = 0;                  ///< of a bake; 0: all but one, at least one
    std::function<void()> onChanged;  ///< called from the service's thread when there is something new; may be empty
  };
  explicit BakeService(Options options);
  /// Cancels and joins; within a second.
  ~BakeService();
  BakeService(const BakeService&) = delete;
  BakeService& operator=(const BakeService&) = delete;

  void request(std::shared_ptr<const project::Project> project, std::uint64_t revision);
  /// Stops the running bake and drops what waits; the next request starts afresh.
  void cancel();
  /// The next finished ground that is still wanted, oldest first.
  std::optional<BakedGround> tryPop();
  BakeStatus status() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> m_impl;
};

}  // namespace sward::editor
