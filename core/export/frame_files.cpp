#include "export/frame_files.h"

#include "base/two_numbers.h"

#include <array>
#include <cstdio>
#include <optional>
#include <utility>

namespace sward::exporting {
namespace {

namespace fs = std::filesystem;

/// A name taken apart at its conversions.
struct Parts {
  std::string before, after;
  int numbers = 0, width = 0;
  bool wrong = false;  ///< a percent sign that means nothing
};

Parts partsOf(const std::string& name) {
  Parts parts;
  for (std::size_t i = 0; i < name.size(); ++i) {
    std::string& text = parts.numbers == 0 ? parts.before : parts.after;
    if (name[i] != '%') {
      text += name[i];
      continue;
    }
    if (i + 1 < name.size() && name[i + 1] == '%') {
      text += '%';
      ++i;
      continue;
    }
    std::size_t end = i + 1;
    int width = 0;
    if (end + 1 < name.size() && name[end] == '0' && name[end + 1] >= '1' && name[end + 1] <= '9') {
      width = name[end + 1] - '0';
      end += 2;
    }
    if (end >= name.size() || name[end] != 'd') {
      parts.wrong = true;
      return parts;
    }
    ++parts.numbers;
    parts.width = width;
    i = end;
  }
  return parts;
}

}  // namespace

Result<FrameRange> parseFrames(const std::string& text, int frames) {
  const std::string remedy = "Give FIRST:LAST, both included, such as 0:" + std::to_string(frames - 1) +
                             "; the sequence has " + std::to_string(frames) + " frames (sequence.frames).";
  const auto numbers = base::twoNumbers<int>(text, ':');
  if (!numbers) return Error::badInput("\"" + text + "\" is no range of frames", "--frames", remedy);
  const auto [first, last] = *numbers;
  if (first > last) return Error::badInput("the first frame of " + text + " comes after the last", "--frames", remedy);
  if (first < 0 || last >= frames) {
    return Error::badInput("frames " + text + " go beyond the sequence, 0:" + std::to_string(frames - 1), "--frames",
                           remedy);
  }
  return FrameRange{first, last};
}

Result<Shard> parseShard(const std::string& text) {
  const auto numbers = base::twoNumbers<int>(text, '/');
  if (!numbers || numbers->second < 1 || numbers->first < 1 || numbers->first > numbers->second) {
    return Error::badInput("\"" + text + "\" is no shard", "--shard",
                           "Give I/N with I from 1 to N, such as 1/4 for the first of four machines.");
  }
  return Shard{numbers->first, numbers->second};
}

std::vector<int> framesOf(const FrameRange& range, const Shard& shard) {
  std::vector<int> frames;
  const std::int64_t last = range.last;
  for (std::int64_t frame = std::int64_t{range.first} + shard.index - 1; frame <= last; frame += shard.count) {
    frames.push_back(static_cast<int>(frame));
  }
  return frames;
}

Result<FramePattern> FramePattern::parse(const fs::path& path) {
  const std::string remedy = "Give the number's place in the name once, such as autumn_%04d.png.";
  if (path.parent_path().string().find('%') != std::string::npos && isOne(path.parent_path().filename())) {
    return Error::badInput("the number stands in the folder's name", path.string(), remedy);
  }
  FramePattern pattern;
  pattern.m_folder = path.parent_path();
  pattern.m_name = path.filename().string();
  Parts parts = partsOf(pattern.m_name);
  if (parts.wrong) {
    return Error::badInput("a percent sign of the name means nothing", path.string(),
                           remedy + " %% stands for a percent sign.");
  }
  if (parts.numbers == 0) return Error::badInput("the name has no place for the frame's number", path.string(), remedy);
  if (parts.numbers > 1) return Error::badInput("the name has several places for a number", path.string(), remedy);
  pattern.m_before = std::move(parts.before);
  pattern.m_after = std::move(parts.after);
  pattern.m_width = parts.width;
  return pattern;
}

bool FramePattern::isOne(const fs::path& path) {
  const Parts parts = partsOf(path.filename().string());
  return !parts.wrong && parts.numbers > 0;
}

fs::path FramePattern::fileOf(int frame) const {
  std::array<char, 32> number{};
  std::snprintf(number.data(), number.size(), "%0*d", m_width, frame);
  return m_folder / (m_before + number.data() + m_after);
}

fs::path FramePattern::manifest() const {
  const fs::path after(m_after);
  std::string name = m_before + (after.has_extension() ? after.stem().string() : "");
  const std::size_t end = name.find_last_not_of("_-. ");
  name.resize(end == std::string::npos ? 0 : end + 1);
  return m_folder / ((name.empty() ? "sequence" : name) + ".frames.json");
}

}  // namespace sward::exporting
