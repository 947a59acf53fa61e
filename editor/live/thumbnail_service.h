#pragma once

#include "base/result.h"
#include "project/project.h"
#include "trace/thumbnail.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>

namespace sward::editor {

/// A finished picture of a plant, or why there is none.
struct PlantPicture {
  std::uint64_t slot = 0;  ///< of the request
  trace::Thumbnail thumbnail;
  std::optional<Error> error;  ///< such as a missing glTF file; the thumbnail is empty then
};

/// Draws pictures of plants on a thread of low priority. The newest values of a slot win: a request replaces one of the
/// same slot that waits, and one for values that the slot's picture shows already draws nothing. All calls come from
/// one thread, the UI's, and never wait.
class ThumbnailService {
 public:
  struct Options {
    trace::ThumbnailOptions picture;
    std::function<void()> onPicture;  ///< called from the service's thread; may be empty
  };
  explicit ThumbnailService(Options options);
  /// Cancels and joins; within a second.
  ~ThumbnailService();
  ThumbnailService(const ThumbnailService&) = delete;
  ThumbnailService& operator=(const ThumbnailService&) = delete;

  /// `slot` is the caller's name for the place where the picture is shown, such as the plant's stable id; `index` the
  /// plant's place in the list, which decides about its random numbers as in a bake; `folder` where its asset path
  /// starts.
  void request(std::uint64_t slot, const project::Plant& plant, std::size_t index, std::uint64_t seed,
               const std::filesystem::path& folder);
  /// A plant that went: what waits for its slot is dropped.
  void forget(std::uint64_t slot);
  /// The next finished picture that is still wanted, oldest first.
  std::optional<PlantPicture> tryPop();
  /// Whether something is being drawn or waits to be.
  bool busy() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> m_impl;
};

}  // namespace sward::editor
