#pragma once

#include "base/result.h"

#include <filesystem>
#include <string>
#include <vector>

namespace sward::exporting {

/// Frames of a sequence, both included.
struct FrameRange {
  int first = 0, last = 0;
  bool operator==(const FrameRange&) const = default;
};
/// Reads "A:B". Errors: not two whole numbers, A > B, frames outside 0 to `frames` - 1.
Result<FrameRange> parseFrames(const std::string& text, int frames);

/// One part of the work on a range of frames: of the frames A, A + 1, ... those A + index - 1, A + index - 1 + count,
/// ... (interleaved, so that parts take about as long as one another wherever the costly frames lie).
struct Shard {
  int index = 1, count = 1;
  bool operator==(const Shard&) const = default;
};
/// Reads "I/N". Errors: not two whole numbers, I outside 1 to N.
Result<Shard> parseShard(const std::string& text);
/// The frames of a shard, rising; none where there are more shards than frames.
std::vector<int> framesOf(const FrameRange& range, const Shard& shard);

/// Names of numbered files: one %d, or %04d with any width from 1 to 9, in the name of the file; %% is a percent sign.
class FramePattern {
 public:
  /// Errors: no number in the name, more than one, other conversions, a number in the folder's name.
  static Result<FramePattern> parse(const std::filesystem::path& path);
  /// Whether a name holds such a number, so that it can only have been meant for several files.
  static bool isOne(const std::filesystem::path& path);

  std::filesystem::path fileOf(int frame) const;
  /// What keeps account of the frames, beside them: "out/autumn_%04d.png" -> "out/autumn.frames.json".
  std::filesystem::path manifest() const;
  /// The pattern without its folder.
  std::string name() const { return m_name; }

 private:
  std::filesystem::path m_folder;
  std::string m_name, m_before, m_after;
  int m_width = 0;
};

}  // namespace sward::exporting
