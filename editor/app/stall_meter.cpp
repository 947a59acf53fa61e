#include "app/stall_meter.h"

#include <algorithm>
#include <cmath>

namespace sward::editor {

void StallMeter::add(double milliseconds, bool baking) {
  if (!baking) return;
  const auto bin = std::upper_bound(kEndsMs.begin(), kEndsMs.end(), milliseconds) - kEndsMs.begin();
  ++m_bins[static_cast<std::size_t>(bin)];
  ++m_frames;
  m_worstMs = std::max(m_worstMs, milliseconds);
}

double StallMeter::medianMs() const {
  std::size_t seen = 0;
  for (std::size_t i = 0; i < m_bins.size(); ++i) {
    seen += m_bins[i];
    if (2 * seen >= m_frames && m_frames > 0) return i < kEndsMs.size() ? kEndsMs[i] : m_worstMs;
  }
  return 0.0;
}

std::string StallMeter::text() const {
  if (m_frames == 0) return "No frame was drawn while baking yet.";
  std::string out;
  for (std::size_t i = 0; i < m_bins.size(); ++i) {
    if (m_bins[i] == 0) continue;
    const double end = kEndsMs[std::min(i, kEndsMs.size() - 1)];
    out += (i < kEndsMs.size() ? "under " : "over ") + std::to_string(static_cast<int>(end)) +
           " ms: " + std::to_string(m_bins[i]) + "\n";
  }
  return out + "longest: " + std::to_string(static_cast<int>(std::lround(m_worstMs))) + " ms";
}

}  // namespace sward::editor
