#pragma once

#include "base/result.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>

namespace sward::exporting {

/// What is known of a frame that was written.
struct FrameEntry {
  int frame = 0;
  std::string file;         ///< its name, without the folder
  double weathering = 0.0;  ///< that it shows
  std::string key;          ///< names all that decided the picture: project, view, assets, versions
  std::string hash;         ///< of the file's bytes
  std::uint64_t bytes = 0;
  std::string device;  ///< that drew it
  bool operator==(const FrameEntry&) const = default;
};

/// Account of a sequence's frames, a JSON file beside them. Several processes may write to one at a time: each change
/// is made under a lock, and the file is renamed into place whole.
struct FrameManifest {
  std::string settings;  ///< a JSON object, as given to record(): what the frames were made from
  std::map<int, FrameEntry> frames;
};

/// Nothing recorded where there is no such file, or it is damaged (its frames are drawn anew then).
FrameManifest readManifest(const std::filesystem::path& file);

/// Whether the frame's file is there with the very bytes that were recorded.
bool isWhole(const std::filesystem::path& folder, const FrameEntry& entry);

/// An entry for a file that was just written. Errors: it cannot be read.
Result<FrameEntry> entryOf(const std::filesystem::path& file, int frame, double weathering, const std::string& key,
                           const std::string& device);

/// Puts an entry into the manifest, in the place of an older one of the same frame; `settings`, a JSON object, replaces
/// those that stood there. Errors: the file cannot be written.
Result<void> record(const std::filesystem::path& file, const std::string& settings, const FrameEntry& entry);

}  // namespace sward::exporting
