#include "tiles/max_flow.h"

#include <algorithm>
#include <limits>

namespace sward::tiles {

namespace {
std::size_t index(int i) {
  return static_cast<std::size_t>(i);
}
}  // namespace

MaxFlow::MaxFlow(int nodes) : m_source(nodes), m_sink(nodes + 1) {
  m_first.assign(index(nodes + 2), -1);
}

void MaxFlow::addEdge(int from, int to, std::int64_t capacity) {
  if (capacity <= 0) return;
  m_arcs.push_back({to, m_first[index(from)], capacity});
  m_first[index(from)] = static_cast<int>(m_arcs.size()) - 1;
  m_arcs.push_back({from, m_first[index(to)], 0});
  m_first[index(to)] = static_cast<int>(m_arcs.size()) - 1;
}

bool MaxFlow::buildLevels() {
  m_level.assign(m_first.size(), -1);
  m_level[index(m_source)] = 0;
  m_queue.assign(1, m_source);
  for (std::size_t head = 0; head < m_queue.size(); ++head) {
    const int node = m_queue[head];
    for (int a = m_first[index(node)]; a >= 0; a = m_arcs[index(a)].next) {
      const Arc& arc = m_arcs[index(a)];
      if (arc.capacity <= 0 || m_level[index(arc.to)] >= 0) continue;
      m_level[index(arc.to)] = m_level[index(node)] + 1;
      m_queue.push_back(arc.to);
    }
  }
  return m_level[index(m_sink)] >= 0;
}

/// Pushes flow along one shortest path; 0 when the levels hold no more. Iterative: paths may be thousands of arcs long.
std::int64_t MaxFlow::augment() {
  m_path.clear();
  int node = m_source;
  while (node != m_sink) {
    int& a = m_current[index(node)];
    while (a >= 0 &&
           (m_arcs[index(a)].capacity <= 0 || m_level[index(m_arcs[index(a)].to)] != m_level[index(node)] + 1)) {
      a = m_arcs[index(a)].next;
    }
    if (a >= 0) {
      m_path.push_back(a);
      node = m_arcs[index(a)].to;
      continue;
    }
    if (m_path.empty()) return 0;
    // A dead end: step back, past the arc that led here.
    const int back = m_path.back();
    m_path.pop_back();
    node = m_arcs[index(back ^ 1)].to;
    m_current[index(node)] = m_arcs[index(back)].next;
  }
  std::int64_t flow = std::numeric_limits<std::int64_t>::max();
  for (const int a : m_path) flow = std::min(flow, m_arcs[index(a)].capacity);
  for (const int a : m_path) {
    m_arcs[index(a)].capacity -= flow;
    m_arcs[index(a ^ 1)].capacity += flow;
  }
  return flow;
}

std::int64_t MaxFlow::solve() {
  std::int64_t total = 0;
  while (buildLevels()) {
    m_current = m_first;
    while (const std::int64_t flow = augment()) total += flow;
  }
  return total;
}

}  // namespace sward::tiles
