#include "terrain/lod_tree.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>
#include <unordered_map>

namespace sward::terrain {
namespace {

constexpr double kSideShare = 4.0;  ///< of the distance: no triangle near the eye is so large that floats lose it
constexpr double kNearestSideM = 16.0;
constexpr int kTopLevel = 30;
constexpr int kMaxLeaves = 200000;  ///< protects against views that ask for more than any machine draws

struct NodeHash {
  std::size_t operator()(const LodNode& n) const {
    const auto mix = [](std::uint64_t a, std::uint64_t b) {
      return (a ^ (b + 0x9e3779b97f4a7c15ULL + (a << 6) + (a >> 2))) * 0xbf58476d1ce4e5b9ULL;
    };
    return mix(mix(static_cast<std::uint64_t>(n.level + 64), static_cast<std::uint64_t>(n.x)),
               static_cast<std::uint64_t>(n.y));
  }
};

LodNode parentOf(const LodNode& n) {
  return {n.level + 1, n.x >> 1, n.y >> 1};
}

LodNode childOf(const LodNode& n, long child) {
  return {n.level - 1, 2 * n.x + (child & 1), 2 * n.y + (child >> 1)};
}

struct Box {
  glm::dvec3 low{0.0}, high{0.0};
};

struct Leaf {
  bool visible = true;
  unsigned coarser = 0;
};

struct Side {
  unsigned bit;
  long dx, dy;
};
constexpr std::array<Side, 4> kSides{{{kWest, -1, 0}, {kEast, 1, 0}, {kSouth, 0, -1}, {kNorth, 0, 1}}};

/// One selection in the making.
class Selection {
 public:
  Selection(const LodTree& tree, const LodView& view) : m_tree(tree), m_view(view) {}

  std::vector<LodChunk> run() {
    plantRoots();
    balance();
    return chunks();
  }

 private:
  glm::dvec2 cell() const { return m_tree.field().grid().cellM; }

  Box boxOf(const LodNode& n) const {
    const HeightGrid& grid = m_tree.field().grid();
    const glm::dvec2 side = cell() * std::ldexp(static_cast<double>(kChunkQuads), n.level);
    const glm::dvec2 low = grid.origin + side * glm::dvec2(n.x, n.y);
    // A level between the samples shares its cells with neighbours: bounds of the very rectangle.
    const HeightRange range = m_tree.field().range(low, low + side);
    return {{low, range.low}, {low + side, range.high}};
  }

  bool visible(const Box& box) const {
    return std::all_of(m_view.planes.begin(), m_view.planes.end(), [&](const glm::dvec4& plane) {
      const glm::dvec3 corner(plane.x > 0.0 ? box.high.x : box.low.x, plane.y > 0.0 ? box.high.y : box.low.y,
                              (plane.z > 0.0 ? box.high.z : box.low.z) + m_view.liftM);
      return glm::dot(glm::dvec3(plane), corner) + plane.w >= 0.0;
    });
  }

  double distanceTo(const Box& box) const {
    return glm::length(glm::max(glm::max(box.low - m_view.eye, m_view.eye - box.high), 0.0));
  }

  bool fine(const LodNode& n, const Box& box) const {
    if (n.level <= m_view.finestLevel) return true;
    const double distance = distanceTo(box);
    const glm::dvec2 side(box.high - box.low);
    if (std::max(side.x, side.y) > std::max(kSideShare * distance, kNearestSideM)) return false;
    return m_tree.errorM(n) <= m_view.errorAngle * distance;
  }

  void grow(const LodNode& n) {
    const Box box = boxOf(n);
    const bool seen = visible(box);
    if (!seen || fine(n, box) || std::ssize(m_leaves) > kMaxLeaves) {
      m_leaves[n] = {seen, 0};
      return;
    }
    for (long child = 0; child < 4; ++child) grow(childOf(n, child));
  }

  /// The two by two nodes that reach at least farM from the eye.
  void plantRoots() {
    const glm::dvec2 first = cell() * static_cast<double>(kChunkQuads);
    const double reach = 2.0 * std::max(m_view.farM, 1.0) / std::min(first.x, first.y);
    m_root = std::clamp(static_cast<int>(std::ceil(std::log2(std::max(reach, 1e-9)))), m_view.finestLevel, kTopLevel);
    const glm::dvec2 side = first * std::ldexp(1.0, m_root);
    const glm::dvec2 eye = (glm::dvec2(m_view.eye) - m_tree.field().grid().origin) / side;
    m_rootX = static_cast<long>(std::floor(eye.x - 0.5));
    m_rootY = static_cast<long>(std::floor(eye.y - 0.5));
    for (long i = 0; i < 4; ++i) grow({m_root, m_rootX + (i & 1), m_rootY + (i >> 1)});
  }

  /// The leaf that covers a node of its own or a coarser level; nothing where it is divided further or beyond the
  /// roots.
  std::optional<LodNode> leafOver(LodNode n) const {
    for (; n.level <= m_root; n = parentOf(n))
      if (m_leaves.contains(n)) return n;
    return std::nullopt;
  }

  /// Divides leaves until neighbours differ by one level at most (the restricted quadtree of Von Herzen and Barr 1987).
  void balance() {
    std::vector<LodNode> open;
    for (const auto& [node, leaf] : m_leaves) open.push_back(node);
    while (!open.empty()) {
      const LodNode n = open.back();
      open.pop_back();
      if (!m_leaves.contains(n)) continue;
      for (const Side& side : kSides) {
        const auto over = leafOver({n.level, n.x + side.dx, n.y + side.dy});
        if (!over || over->level <= n.level + 1) continue;
        m_leaves.erase(*over);
        for (long child = 0; child < 4; ++child) {
          const LodNode part = childOf(*over, child);
          m_leaves[part] = {visible(boxOf(part)), 0};
          open.push_back(part);
        }
        open.push_back(n);
        break;
      }
    }
  }

  std::vector<LodChunk> chunks() const {
    std::vector<LodChunk> out;
    out.reserve(m_leaves.size());
    for (const auto& [node, leaf] : m_leaves) {
      LodChunk chunk{node, 0, leaf.visible, m_tree.errorM(node)};
      double stitches = 0.0;
      for (const Side& side : kSides) {
        const auto over = leafOver({node.level, node.x + side.dx, node.y + side.dy});
        if (!over || over->level == node.level) continue;
        chunk.coarserSides |= side.bit;
        stitches = std::max(stitches, m_tree.errorM(*over));
      }
      chunk.errorM += stitches;
      out.push_back(chunk);
    }
    // An order of their own: hash tables have none that lasts.
    std::sort(out.begin(), out.end(), [](const LodChunk& a, const LodChunk& b) {
      return std::tie(a.node.level, a.node.y, a.node.x) < std::tie(b.node.level, b.node.y, b.node.x);
    });
    return out;
  }

  const LodTree& m_tree;
  const LodView& m_view;
  int m_root = 0;
  long m_rootX = 0, m_rootY = 0;
  std::unordered_map<LodNode, Leaf, NodeHash> m_leaves;
};

}  // namespace

std::vector<LodChunk> LodTree::select(const LodView& view) const {
  return Selection(*this, view).run();
}

}  // namespace sward::terrain
