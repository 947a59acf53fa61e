#pragma once

#include <cstdint>
#include <vector>

namespace sward::tiles {

/// Maximum flow and minimum cut with integer capacities (Dinic 1970), for the sparse graphs of a seam's band.
class MaxFlow {
 public:
  /// Nodes 0 .. nodes - 1, besides a source and a sink.
  explicit MaxFlow(int nodes);
  void addEdge(int from, int to, std::int64_t capacity);
  void addSource(int node, std::int64_t capacity) { addEdge(m_source, node, capacity); }
  void addSink(int node, std::int64_t capacity) { addEdge(node, m_sink, capacity); }
  /// The flow's value, which is the minimum cut's. Call once.
  std::int64_t solve();
  /// After solve: whether the node is on the source's side of the minimum cut.
  bool onSourceSide(int node) const { return m_level[static_cast<std::size_t>(node)] >= 0; }

 private:
  struct Arc {
    int to;
    int next;               ///< of the same tail, or -1
    std::int64_t capacity;  ///< left over; the reverse arc is at index ^ 1
  };
  bool buildLevels();
  std::int64_t augment();

  int m_source, m_sink;
  std::vector<Arc> m_arcs;
  std::vector<int> m_first, m_current, m_level;
  std::vector<int> m_path;  ///< arcs of the path being grown
  std::vector<int> m_queue;
};

}  // namespace sward::tiles
