// Seams by dynamic programming. A seam runs on the lattice of texel corners: a step along u between lattice points
// (i, j) and (i + 1, j) parts texel (i, j), on the vertical edge's side, from (i, j - 1), on the horizontal edge's; a
// step along v from (i, j) to (i, j + 1) parts (i - 1, j) from (i, j). Seams are monotone in the corner's local
// coordinates, so the four of a tile stay in the four quadrants about their meeting point and never cross.
#include "tiles/seam_problem.h"

#include <algorithm>
#include <cstdlib>

namespace sward::tiles {

namespace {

enum class Step : std::uint8_t { AlongU, AlongV };

Step other(Step step) {
  return step == Step::AlongU ? Step::AlongV : Step::AlongU;
}

/// Least costs of all monotone seams from one corner.
class CornerSeams {
 public:
  CornerSeams(const SeamProblem& problem, const Corner& corner);

  /// Least cost of a seam that reaches the lattice point (i, j) with the given last step.
  double cost(int i, int j, Step last) const { return m_costs[at(i, j)][static_cast<std::size_t>(last)]; }
  double cost(int i, int j) const { return std::min(cost(i, j, Step::AlongU), cost(i, j, Step::AlongV)); }
  /// Writes the owners of the texels between the corner and (i, j).
  void cut(int i, int j, Step last, std::vector<std::uint8_t>& owner) const;
  /// The lattice point of the tile in this corner's coordinates.
  glm::ivec2 local(int x, int y) const {
    return {m_corner.flipX ? m_problem.resolution - x : x, m_corner.flipY ? m_problem.resolution - y : y};
  }

 private:
  std::size_t at(int i, int j) const {
    return static_cast<std::size_t>(j) * static_cast<std::size_t>(m_points) + static_cast<std::size_t>(i);
  }
  std::size_t texel(int u, int v) const {
    return m_problem.texel(m_corner.flipX ? m_problem.resolution - 1 - u : u,
                           m_corner.flipY ? m_problem.resolution - 1 - v : v);
  }
  /// Cost of parting texel (hu, hv) of the horizontal edge from (vu, vv) of the vertical one; texels outside the tile,
  /// at the very corner, have no say.
  double part(int hu, int hv, int vu, int vv) const;
  Step lastStep(int i, int j) const;

  const SeamProblem& m_problem;
  const Corner& m_corner;
  int m_points;
  std::vector<std::array<double, 2>> m_costs;  ///< [j][i][Step]
};

double CornerSeams::part(int hu, int hv, int vu, int vv) const {
  const bool horizontalInside = hv >= 0;
  const bool verticalInside = vu >= 0;
  if (horizontalInside && !m_problem.permits(texel(hu, hv), m_corner.horizontal)) return SeamProblem::kForbidden;
  if (verticalInside && !m_problem.permits(texel(vu, vv), m_corner.vertical)) return SeamProblem::kForbidden;
  if (!horizontalInside || !verticalInside) return 0.0;
  return m_problem.between(texel(hu, hv), texel(vu, vv), m_corner.horizontal, m_corner.vertical);
}

CornerSeams::CornerSeams(const SeamProblem& problem, const Corner& corner)
    : m_problem(problem), m_corner(corner), m_points(problem.resolution / 2 + std::max(problem.overlap, 1) + 1) {
  m_points = std::min(m_points, problem.resolution);
  m_costs.resize(static_cast<std::size_t>(m_points) * static_cast<std::size_t>(m_points));
  m_costs[0] = {0.0, 0.0};
  for (int j = 0; j < m_points; ++j) {
    for (int i = 0; i < m_points; ++i) {
      if (i == 0 && j == 0) continue;
      double alongU = SeamProblem::kForbidden;
      double alongV = SeamProblem::kForbidden;
      if (i > 0 && cost(i - 1, j) < SeamProblem::kForbidden) alongU = cost(i - 1, j) + part(i - 1, j - 1, i - 1, j);
      if (j > 0 && cost(i, j - 1) < SeamProblem::kForbidden) alongV = cost(i, j - 1) + part(i, j - 1, i - 1, j - 1);
      m_costs[at(i, j)] = {alongU, alongV};
    }
  }
}

Step CornerSeams::lastStep(int i, int j) const {
  const double alongU = cost(i, j, Step::AlongU);
  const double alongV = cost(i, j, Step::AlongV);
  if (alongU != alongV) return alongU < alongV ? Step::AlongU : Step::AlongV;
  // Equal costs: keep to the diagonal.
  if (i != j) return i > j ? Step::AlongU : Step::AlongV;
  return isHorizontal(m_corner.diagonal) ? Step::AlongU : Step::AlongV;
}

void CornerSeams::cut(int i, int j, Step last, std::vector<std::uint8_t>& owner) const {
  const int top = j;
  Step step = last;
  while (i > 0 || j > 0) {
    if (step == Step::AlongU) {
      --i;
      for (int v = 0; v < top; ++v) owner[texel(i, v)] = v < j ? m_corner.horizontal : m_corner.vertical;
    } else {
      --j;
    }
    if (i > 0 || j > 0) step = i == 0 ? Step::AlongV : j == 0 ? Step::AlongU : lastStep(i, j);
  }
}

struct Meeting {
  glm::ivec2 point{0};
  Step firstArrival = Step::AlongU;  ///< of the south-west seam; the others alternate
  double cost = SeamProblem::kForbidden;
};

Step arrival(Step first, std::size_t corner) {
  return corner % 2 == 0 ? first : other(first);
}

/// The cheapest meeting point of four seams that arrive from the four sides, each from another. (Two that arrived from
/// the same side would share a piece there, which the sum of their costs does not price.)
Meeting cheapestMeeting(const SeamProblem& problem, std::span<const CornerSeams, 4> seams) {
  const int reach = std::max(problem.overlap - 1, 0);
  const int middle = problem.resolution / 2;
  Meeting best;
  best.point = glm::ivec2(middle);
  // From the middle outward, so that the middle wins among equal costs.
  for (int distance = 0; distance <= reach; ++distance) {
    for (int dy = -distance; dy <= distance; ++dy) {
      for (int dx = -distance; dx <= distance; ++dx) {
        if (std::abs(dx) + std::abs(dy) != distance) continue;
        for (const Step first : {Step::AlongU, Step::AlongV}) {
          double sum = 0.0;
          for (std::size_t corner = 0; corner < 4; ++corner) {
            const glm::ivec2 p = seams[corner].local(middle + dx, middle + dy);
            sum += seams[corner].cost(p.x, p.y, arrival(first, corner));
          }
          if (sum < best.cost) best = {glm::ivec2(middle + dx, middle + dy), first, sum};
        }
      }
    }
  }
  return best;
}

}  // namespace

std::vector<std::uint8_t> dynamicProgrammingSeams(const SeamProblem& problem) {
  const std::array<CornerSeams, 4> seams{CornerSeams(problem, kCorners[0]), CornerSeams(problem, kCorners[1]),
                                         CornerSeams(problem, kCorners[2]), CornerSeams(problem, kCorners[3])};
  const Meeting meeting = cheapestMeeting(problem, seams);
  std::vector<std::uint8_t> owner(problem.permitted.size(), kSouth);
  for (std::size_t corner = 0; corner < 4; ++corner) {
    const glm::ivec2 p = seams[corner].local(meeting.point.x, meeting.point.y);
    seams[corner].cut(p.x, p.y, arrival(meeting.firstArrival, corner), owner);
  }
  return owner;
}

}  // namespace sward::tiles
