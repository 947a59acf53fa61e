#include "wither/strand.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace sward::wither {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kLowest = 175.0 * kPi / 180.0;  // inclination from upright of what hangs
constexpr std::size_t kLeastSegments = 24;       // the turn changes by less than 15 degrees over each

/// v turned by an angle about a unit axis (Rodrigues).
glm::dvec3 rotated(const glm::dvec3& v, const glm::dvec3& axis, double cosine, double sine) {
  return v * cosine + glm::cross(axis, v) * sine + axis * (glm::dot(axis, v) * (1.0 - cosine));
}

/// How far a tangent of this inclination toward bendTo may turn: to kLowest, and less where it leans the other way, for
/// turning would lift what hangs there.
double room(double inclination) {
  if (inclination >= 0.0) return std::max(kLowest - inclination, 0.0);
  return kLowest * std::max(1.0 + inclination / (0.5 * kPi), 0.0);
}

/// `step` from `from`, kept above the ground with its length: it lands there and runs on along it.
glm::dvec3 aboveGround(const glm::dvec3& from, glm::dvec3 step, double floor, const glm::dvec3& bendTo) {
  const double length = glm::length(step);
  const double down = std::min(from.z - floor, length);  // at least 0
  const double flat = std::hypot(step.x, step.y);
  const double run = std::sqrt(std::max(length * length - down * down, 0.0));
  const glm::dvec3 outward = flat > 1e-9 * length ? glm::dvec3(step.x, step.y, 0.0) / flat : bendTo;
  step = outward * run;
  step.z = -down;
  return step;
}

}  // namespace

BentStrand::BentStrand(const Strand& strand, const BladeState& state) : m_across(1.0 - state.strainAcross) {
  const std::size_t given = strand.vein.size() < 2 ? 1 : strand.vein.size() - 1;
  const std::size_t split = (kLeastSegments + given - 1) / given;
  const std::size_t segments = given * split;
  m_nodes.resize(segments + 1);
  for (std::size_t i = 0; i <= segments && !strand.vein.empty(); ++i) {
    const std::size_t from = std::min(i / split, strand.vein.size() - 1);
    const std::size_t to = std::min(from + 1, strand.vein.size() - 1);
    m_nodes[i].rest =
        glm::mix(strand.vein[from], strand.vein[to], static_cast<double>(i % split) / static_cast<double>(split));
    m_nodes[i].now = m_nodes[i].rest;
  }
  const glm::dvec3 bendTo(strand.bendTo, 0.0);
  m_axis = glm::dvec3(-bendTo.y, bendTo.x, 0.0);                    // turns up toward bendTo
  if (!(state.tipRad > 0.0) && !(state.strainAlong > 0.0)) return;  // at rest to the last bit

  const auto inclinationOf = [&](const glm::dvec3& v) { return std::atan2(glm::dot(v, bendTo), v.z); };
  std::vector<double> turns(segments);
  for (std::size_t i = 0; i < segments; ++i) {
    const double s = (static_cast<double>(i) + 0.5) / static_cast<double>(segments);
    const glm::dvec3 rest = m_nodes[i + 1].rest - m_nodes[i].rest;
    const double inclination = inclinationOf(rest);
    turns[i] = std::min(state.tipRad * s * s, room(inclination));
    glm::dvec3 step = rotated(rest, m_axis, std::cos(turns[i]), std::sin(turns[i])) * (1.0 - state.strainAlong);
    const double floor = std::min(0.0, m_nodes[i + 1].rest.z);
    if (m_nodes[i].now.z + step.z < floor) {
      step = aboveGround(m_nodes[i].now, step, std::min(floor, m_nodes[i].now.z), bendTo);
      turns[i] = std::clamp(inclinationOf(step) - inclination, 0.0, turns[i]);
    }
    m_nodes[i + 1].now = m_nodes[i].now + step;
  }
  // The turn at a node is the mean of its neighbours'; the ends go on in the same way.
  for (std::size_t i = 0; i <= segments; ++i) {
    const double below = i > 0 ? turns[i - 1] : 0.0;
    const double above = i < segments ? turns[i] : turns[i - 1] + 0.5 * (turns[i - 1] - turns[i - 2]);
    const double turn = i == 0 ? 0.0 : i == segments ? std::max(above, 0.0) : 0.5 * (below + above);
    m_nodes[i].cosine = std::cos(turn);
    m_nodes[i].sine = std::sin(turn);
  }
}

BentStrand::Place BentStrand::placeOf(double s) const {
  const auto segments = static_cast<double>(m_nodes.size() - 1);
  const double place = (s > 0.0 ? std::min(s, 1.0) : 0.0) * segments;
  const auto node = std::min(static_cast<std::size_t>(place), m_nodes.size() - 2);
  return {node, place - static_cast<double>(node)};
}

glm::dvec3 BentStrand::turned(const glm::dvec3& v, const Place& at) const {
  const Node &a = m_nodes[at.node], &b = m_nodes[at.node + 1];
  const double cosine = a.cosine + (b.cosine - a.cosine) * at.t, sine = a.sine + (b.sine - a.sine) * at.t;
  const double length = std::hypot(cosine, sine);  // neighbours turn alike, so it is near 1
  return rotated(v, m_axis, cosine / length, sine / length);
}

glm::dvec3 BentStrand::position(const glm::dvec3& rest, double s) const {
  const Place at = placeOf(s);
  const Node &a = m_nodes[at.node], &b = m_nodes[at.node + 1];
  const glm::dvec3 offset = rest - (a.rest + (b.rest - a.rest) * at.t);
  glm::dvec3 now = a.now + (b.now - a.now) * at.t + turned(offset, at) * m_across;
  now.z = std::max(now.z, std::min(0.0, rest.z));
  return now;
}

glm::dvec3 BentStrand::direction(const glm::dvec3& rest, double s) const {
  return turned(rest, placeOf(s));
}

glm::dvec3 BentStrand::tangent(double s) const {
  // Between the middles of segments, from one chord to the next.
  const auto segments = static_cast<double>(m_nodes.size() - 1);
  const double place = std::clamp((s > 0.0 ? std::min(s, 1.0) : 0.0) * segments - 0.5, 0.0, segments - 1.0);
  const auto i = std::min(static_cast<std::size_t>(place), m_nodes.size() - 3);
  const auto chord = [this](std::size_t k) {
    const glm::dvec3 step = m_nodes[k + 1].now - m_nodes[k].now;
    const double length = glm::length(step);
    return length > 0.0 ? step / length : glm::dvec3(0.0, 0.0, 1.0);
  };
  const glm::dvec3 mixed = glm::mix(chord(i), chord(i + 1), place - static_cast<double>(i));
  const double length = glm::length(mixed);
  return length > 1e-12 ? mixed / length : chord(i);
}

}  // namespace sward::wither
