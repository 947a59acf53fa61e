#pragma once

#include <array>
#include <cstddef>
#include <string>

namespace sward::editor {

/// How long the interface took for its frames while something was baking: what an author feels as a stall.
class StallMeter {
 public:
  /// Upper ends of the histogram's bins in milliseconds; the last bin has none.
  static constexpr std::array<double, 7> kEndsMs{8, 16, 33, 50, 100, 200, 500};

  /// One frame, from the event that asked for it to the end of drawing it.
  void add(double milliseconds, bool baking);

  const std::array<std::size_t, kEndsMs.size() + 1>& whileBaking() const { return m_bins; }
  std::size_t frames() const { return m_frames; }
  double worstMs() const { return m_worstMs; }
  double medianMs() const;
  /// One line a bin: "under 16 ms: 120".
  std::string text() const;

 private:
  std::array<std::size_t, kEndsMs.size() + 1> m_bins{};
  std::size_t m_frames = 0;
  double m_worstMs = 0.0;
};

}  // namespace sward::editor
