#pragma once

#include "base/result.h"
#include "gpu/context.h"
#include "project/project.h"
#include "scene/options.h"

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace sward::editor {

/// A picture at full quality to a file, as `sward render` makes it: baked (from the cache where it is there), drawn and
/// written on a thread of its own, which ends with the job.
class PictureJob {
 public:
  struct Request {
    std::shared_ptr<const project::Project> project;
    scene::View view;
    std::filesystem::path output;  ///< .png or .exr
    std::filesystem::path cacheFolder;
    std::uint64_t cacheLimitBytes = std::uint64_t{4} << 30;
    int threads = 0;
    gpu::Device device = gpu::Device::Auto;
    std::function<void()> onChanged;  ///< called from the job's thread; may be empty
  };
  explicit PictureJob(Request request);
  /// Cancels and joins.
  ~PictureJob();
  PictureJob(const PictureJob&) = delete;
  PictureJob& operator=(const PictureJob&) = delete;

  struct Status {
    std::string stage;
    double fraction = 0.0;
    bool finished = false;
    std::optional<Error> error;  ///< set when it finished without a picture
  };
  Status status() const;
  const std::filesystem::path& output() const;
  void cancel();

 private:
  struct Impl;
  std::unique_ptr<Impl> m_impl;
};

}  // namespace sward::editor
