// Seams by graph cut: alpha expansion (Boykov, Veksler and Zabih 2001) over the four half-diamonds, each move a minimum
// cut of the texels that the half-diamond may still take.
#include "tiles/max_flow.h"
#include "tiles/seam_problem.h"

#include <algorithm>
#include <cmath>

namespace sward::tiles {

namespace {

/// Costs as integers, so that flows are exact: the largest sum of all costs stays under 2^52.
double capacityScale(const SeamProblem& problem) {
  double sum = 0.0;
  for (const double cost : problem.costs) sum += cost;
  return sum > 0.0 ? 0x1.0p48 / sum : 0.0;
}

/// One expansion: variables are texels that may turn into `alpha`, 0 (keep) on the source's side of the cut.
class Expansion {
 public:
  Expansion(const SeamProblem& problem, const std::vector<std::uint8_t>& owner, Edge alpha, double scale);
  std::vector<std::uint8_t> solve();

 private:
  void addPair(std::size_t p, std::size_t q);
  std::int64_t between(std::size_t p, std::size_t q, std::uint8_t a, std::uint8_t b) const {
    return std::llround(m_problem.between(p, q, a, b) * m_scale);
  }
  /// Cost of turning (positive) or of keeping (negative).
  void addUnary(int variable, std::int64_t turning) { m_unary[static_cast<std::size_t>(variable)] += turning; }

  const SeamProblem& m_problem;
  const std::vector<std::uint8_t>& m_owner;
  Edge m_alpha;
  double m_scale;
  std::vector<int> m_variable;  ///< of each texel, or -1
  std::vector<std::int64_t> m_unary;
  MaxFlow m_flow{0};
};

Expansion::Expansion(const SeamProblem& problem, const std::vector<std::uint8_t>& owner, Edge alpha, double scale)
    : m_problem(problem), m_owner(owner), m_alpha(alpha), m_scale(scale), m_variable(owner.size(), -1) {
  int count = 0;
  for (std::size_t p = 0; p < owner.size(); ++p) {
    if (owner[p] != alpha && problem.permits(p, alpha)) m_variable[p] = count++;
  }
  m_unary.assign(static_cast<std::size_t>(count), 0);
  m_flow = MaxFlow(count);
  const int size = problem.resolution;
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      if (x + 1 < size) addPair(problem.texel(x, y), problem.texel(x + 1, y));
      if (y + 1 < size) addPair(problem.texel(x, y), problem.texel(x, y + 1));
    }
  }
  for (int i = 0; i < count; ++i) {
    const std::int64_t turning = m_unary[static_cast<std::size_t>(i)];
    if (turning > 0) m_flow.addSource(i, turning);
    if (turning < 0) m_flow.addSink(i, -turning);
  }
}

void Expansion::addPair(std::size_t p, std::size_t q) {
  const int i = m_variable[p];
  const int j = m_variable[q];
  if (i < 0 && j < 0) return;
  const std::int64_t keepBoth = between(p, q, m_owner[p], m_owner[q]);
  if (j < 0) return addUnary(i, between(p, q, m_alpha, m_owner[q]) - keepBoth);
  if (i < 0) return addUnary(j, between(p, q, m_owner[p], m_alpha) - keepBoth);
  const std::int64_t turnQ = between(p, q, m_owner[p], m_alpha);
  std::int64_t turnP = between(p, q, m_alpha, m_owner[q]);
  // A squared difference is no metric, so where three half-diamonds meet, this pair may not be submodular: its bound is
  // raised until it is (Rother et al. 2005), and the move's true energy is checked afterwards.
  turnP = std::max(turnP, keepBoth - turnQ);
  // Kolmogorov and Zabih 2004, with turning both costing 0.
  addUnary(i, turnP - keepBoth);
  addUnary(j, -turnP);
  m_flow.addEdge(i, j, turnQ + turnP - keepBoth);
}

std::vector<std::uint8_t> Expansion::solve() {
  m_flow.solve();
  std::vector<std::uint8_t> moved = m_owner;
  for (std::size_t p = 0; p < moved.size(); ++p) {
    if (m_variable[p] >= 0 && !m_flow.onSourceSide(m_variable[p])) moved[p] = m_alpha;
  }
  return moved;
}

}  // namespace

void graphCutSeams(const SeamProblem& problem, std::vector<std::uint8_t>& owner) {
  const double scale = capacityScale(problem);
  if (scale <= 0.0) return;
  constexpr int kRounds = 8;  // it settles in two or three; a bound all the same
  double energy = problem.energy(owner);
  for (int round = 0; round < kRounds; ++round) {
    bool better = false;
    for (const Edge alpha : kEdges) {
      std::vector<std::uint8_t> moved = Expansion(problem, owner, alpha, scale).solve();
      const double movedEnergy = problem.energy(moved);
      if (movedEnergy >= energy) continue;
      owner = std::move(moved);
      energy = movedEnergy;
      better = true;
    }
    if (!better) return;
  }
}

}  // namespace sward::tiles
