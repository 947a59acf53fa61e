#include "base/curve_sampler.h"

#include <algorithm>
#include <cmath>

namespace sward::base {
namespace {

constexpr int kGridCells = 256;

}  // namespace

CurveSampler::CurveSampler(const Curve& density, double low, double high) {
  std::vector<double> places;
  for (int i = 0; i <= kGridCells; ++i) places.push_back(low + (high - low) * i / kGridCells);
  for (const CurvePoint& point : density.points()) {
    if (point.x > low && point.x < high) places.push_back(point.x);
  }
  std::sort(places.begin(), places.end());
  places.erase(std::unique(places.begin(), places.end()), places.end());
  for (const double x : places) {
    Node node{x, std::max(density(x), 0.0), m_total};
    if (!m_nodes.empty()) {
      const Node& before = m_nodes.back();
      m_total += 0.5 * (before.density + node.density) * (x - before.x);
      node.below = m_total;
    }
    m_nodes.push_back(node);
  }
}

double CurveSampler::operator()(double u) const {
  if (!possible()) return 0.5 * (m_nodes.front().x + m_nodes.back().x);
  const double area = std::clamp(u, 0.0, 1.0) * m_total;
  // The first node with as much or more below it ends the cell; cells without density are so passed over.
  auto above = std::lower_bound(m_nodes.begin() + 1, m_nodes.end() - 1, area,
                                [](const Node& node, double value) { return node.below < value; });
  // The lowest draw is where the density begins.
  while (above + 1 != m_nodes.end() && above->below <= 0.0) ++above;
  const Node& b = *above;
  const Node& a = *(above - 1);
  const double width = b.x - a.x;
  const double rest = std::max(area - a.below, 0.0);
  // Integral of the linear density from a.x to a.x + t: a t + (b - a) t^2 / (2 width) = rest, in the form of the
  // quadratic's solution that does not cancel.
  const double slope = (b.density - a.density) / width;
  const double root = std::sqrt(std::max(a.density * a.density + 2.0 * slope * rest, 0.0));
  const double divisor = a.density + root;
  return divisor > 0.0 ? std::clamp(a.x + 2.0 * rest / divisor, a.x, b.x) : a.x;
}

double CurveSampler::mean() const {
  if (!possible()) return 0.5 * (m_nodes.front().x + m_nodes.back().x);
  double sum = 0.0;
  for (std::size_t i = 1; i < m_nodes.size(); ++i) {
    const Node& a = m_nodes[i - 1];
    const Node& b = m_nodes[i];
    // Exact for a linear density: integral of x times it.
    sum += (b.x - a.x) * (a.density * (2.0 * a.x + b.x) + b.density * (a.x + 2.0 * b.x)) / 6.0;
  }
  return sum / m_total;
}

}  // namespace sward::base
