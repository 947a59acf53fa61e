#include "leaf/simplex.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sward::leaf {
namespace {

struct Vertex {
  std::vector<double> at;
  double value = 0.0;
};

class Simplex {
 public:
  Simplex(const std::function<double(const std::vector<double>&)>& f, const std::vector<double>& start, double step)
      : m_f(f) {
    m_vertices.push_back(evaluated(start));
    for (std::size_t i = 0; i < start.size(); ++i) {
      std::vector<double> at = start;
      at[i] += step;
      m_vertices.push_back(evaluated(at));
    }
    sort();
  }

  void advance() {
    Vertex& worst = m_vertices.back();
    const Vertex reflected = evaluated(along(1.0));
    if (reflected.value < m_vertices.front().value) {
      const Vertex expanded = evaluated(along(2.0));
      worst = expanded.value < reflected.value ? expanded : reflected;
    } else if (reflected.value < m_vertices[m_vertices.size() - 2].value) {
      worst = reflected;
    } else {
      const Vertex contracted = evaluated(along(reflected.value < worst.value ? 0.5 : -0.5));
      if (contracted.value < std::min(worst.value, reflected.value)) {
        worst = contracted;
      } else {
        shrink();
      }
    }
    sort();
  }

  const Vertex& best() const { return m_vertices.front(); }
  int evaluations() const { return m_evaluations; }
  double spread() const { return m_vertices.back().value - m_vertices.front().value; }

 private:
  Vertex evaluated(std::vector<double> at) {
    ++m_evaluations;
    const double value = m_f(at);
    return {std::move(at), std::isnan(value) ? std::numeric_limits<double>::infinity() : value};
  }

  /// From the middle of all but the worst, away from the worst, by `factor` of their distance.
  std::vector<double> along(double factor) const {
    const std::vector<double>& worst = m_vertices.back().at;
    std::vector<double> at(worst.size());
    for (std::size_t i = 0; i < at.size(); ++i) {
      double middle = 0.0;
      for (std::size_t v = 0; v + 1 < m_vertices.size(); ++v) middle += m_vertices[v].at[i];
      middle /= static_cast<double>(at.size());
      at[i] = middle + factor * (middle - worst[i]);
    }
    return at;
  }

  void shrink() {
    for (std::size_t v = 1; v < m_vertices.size(); ++v) {
      std::vector<double> at = m_vertices[v].at;
      for (std::size_t i = 0; i < at.size(); ++i) at[i] = 0.5 * (at[i] + m_vertices.front().at[i]);
      m_vertices[v] = evaluated(std::move(at));
    }
  }

  void sort() {
    std::stable_sort(m_vertices.begin(), m_vertices.end(),
                     [](const Vertex& a, const Vertex& b) { return a.value < b.value; });
  }

  const std::function<double(const std::vector<double>&)>& m_f;
  std::vector<Vertex> m_vertices;
  int m_evaluations = 0;
};

}  // namespace

std::vector<double> minimumOf(const std::function<double(const std::vector<double>&)>& f, std::vector<double> start,
                              double step, int evaluations) {
  constexpr int kRounds = 3;
  for (int round = 0; round < kRounds; ++round) {
    Simplex simplex(f, start, step);
    while (simplex.evaluations() < evaluations / kRounds && simplex.spread() > 0.0) simplex.advance();
    start = simplex.best().at;
  }
  return start;
}

}  // namespace sward::leaf
