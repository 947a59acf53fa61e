#include "wither/vein.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>
#include <queue>
#include <utility>

namespace sward::wither {
namespace {

constexpr int kSegments = 12;
constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
constexpr double kWindow = 0.3;       // how far s may be from the share of the way along the mesh
constexpr double kDeepestCut = 0.25;  // of the way: a part that falls apart farther out bends as one
constexpr double kInfinite = std::numeric_limits<double>::infinity();

struct Extent {
  double lowest = 0.0;  ///< z
  double diagonal = 0.0;
};

Extent extentOf(const PlaceGraph& graph, std::span<const std::uint32_t> places) {
  glm::dvec3 low = graph.places[places.front()], high = low;
  for (const std::uint32_t p : places) {
    low = glm::min(low, graph.places[p]);
    high = glm::max(high, graph.places[p]);
  }
  return {low.z, glm::length(high - low)};
}

/// The places that the root is made of: all that lie near its first one and as low. A blade whose tip lies on the
/// ground too, or that lies flat, is rooted where it is nearest to the plant's foot.
std::vector<std::uint32_t> rootPlaces(const PlaceGraph& graph, std::span<const std::uint32_t> places) {
  const Extent extent = extentOf(graph, places);
  const double top = extent.lowest + 0.02 * extent.diagonal;
  std::uint32_t root = places.front();
  double nearest = kInfinite;
  for (const std::uint32_t p : places) {
    const glm::dvec3& place = graph.places[p];
    const double away = std::hypot(place.x, place.y);
    if (place.z <= top && away < nearest) {
      nearest = away;
      root = p;
    }
  }
  std::vector<std::uint32_t> roots;
  for (const std::uint32_t p : places) {
    const bool near = glm::length(graph.places[p] - graph.places[root]) <= 0.05 * extent.diagonal;
    if (p == root || (near && graph.places[p].z <= top)) roots.push_back(p);
  }
  // A cut across the blade's foot: neighbours as low as the root belong to it, however wide a short blade is.
  for (std::uint32_t e = graph.firstEdge[root]; e < graph.firstEdge[root + 1]; ++e) {
    const std::uint32_t p = graph.edges[e];
    const bool level = std::abs(graph.places[p].z - graph.places[root].z) <= 1e-3 * extent.diagonal;
    const bool upright = extent.diagonal > 0.0 && top < extent.lowest + 0.5 * extent.diagonal;
    const bool wide = glm::length(graph.places[p] - graph.places[root]) <= 0.5 * extent.diagonal;
    if (level && upright && wide && std::find(roots.begin(), roots.end(), p) == roots.end()) roots.push_back(p);
  }
  return roots;
}

void walk(const PlaceGraph& graph, std::span<const std::uint32_t> places, std::span<const std::uint32_t> roots,
          std::vector<double>& distances) {
  for (const std::uint32_t p : places) distances[p] = kInfinite;
  using Reached = std::pair<double, std::uint32_t>;
  std::priority_queue<Reached, std::vector<Reached>, std::greater<>> front;
  for (const std::uint32_t p : roots) {
    distances[p] = 0.0;
    front.emplace(0.0, p);
  }
  while (!front.empty()) {
    const auto [distance, p] = front.top();
    front.pop();
    if (distance > distances[p]) continue;
    for (std::uint32_t e = graph.firstEdge[p]; e < graph.firstEdge[p + 1]; ++e) {
      const std::uint32_t q = graph.edges[e];
      const double next = distance + glm::length(graph.places[q] - graph.places[p]);
      if (next < distances[q]) {
        distances[q] = next;
        front.emplace(next, q);
      }
    }
  }
}

glm::dvec3 meanOf(const PlaceGraph& graph, std::span<const std::uint32_t> places) {
  glm::dvec3 sum(0.0);
  for (const std::uint32_t p : places) sum += graph.places[p];
  return sum / static_cast<double>(places.size());
}

/// Some of a part's surface: what a vein is found in.
struct Piece {
  std::vector<std::uint32_t> places;
  std::vector<glm::uvec3> triangles;
};

double farthestOf(std::span<const std::uint32_t> places, const std::vector<double>& distances) {
  double farthest = 0.0;
  for (const std::uint32_t p : places) farthest = std::max(farthest, distances[p]);
  return farthest;
}

/// Centroids of the curves on the surface that lie at a distance of i / kSegments of the largest; levels that no
/// triangle crosses are left out.
std::vector<glm::dvec3> sections(const PlaceGraph& graph, const Piece& piece, std::span<const std::uint32_t> roots,
                                 const std::vector<double>& distances) {
  const double farthest = farthestOf(piece.places, distances);
  std::vector<glm::dvec3> sums(kSegments + 1, glm::dvec3(0.0));
  std::vector<double> weights(kSegments + 1, 0.0);
  const double spacing = farthest / kSegments;
  for (const glm::uvec3& triangle : piece.triangles) {
    std::array<std::uint32_t, 3> p{triangle.x, triangle.y, triangle.z};
    std::sort(p.begin(), p.end(), [&](std::uint32_t a, std::uint32_t b) { return distances[a] < distances[b]; });
    const double low = distances[p[0]], middle = distances[p[1]], high = distances[p[2]];
    const auto cut = [&](std::size_t a, std::size_t b, double level) {
      return glm::mix(graph.places[p[a]], graph.places[p[b]],
                      (level - distances[p[a]]) / (distances[p[b]] - distances[p[a]]));
    };
    for (int i = std::max(static_cast<int>(std::floor(low / spacing)) + 1, 1); i < kSegments; ++i) {
      const double level = i * spacing;
      if (!(level < high)) break;
      if (!(level > low)) continue;
      const glm::dvec3 from = cut(0, 2, level), to = level < middle ? cut(0, 1, level) : cut(1, 2, level);
      const double length = glm::length(to - from) + 1e-9 * spacing;  // a needle counts a little
      sums[static_cast<std::size_t>(i)] += 0.5 * length * (from + to);
      weights[static_cast<std::size_t>(i)] += length;
    }
  }
  std::vector<std::uint32_t> tips;
  for (const std::uint32_t p : piece.places) {
    if (distances[p] >= 0.98 * farthest) tips.push_back(p);
  }
  std::vector<glm::dvec3> line{meanOf(graph, roots)};
  for (std::size_t i = 1; i < kSegments; ++i) {
    if (weights[i] > 0.0) line.push_back(sums[i] / weights[i]);
  }
  line.push_back(meanOf(graph, tips));
  return line;
}

/// One pass of a binomial filter: sections of a coarse or branching mesh waver.
std::vector<glm::dvec3> smoothed(const std::vector<glm::dvec3>& line) {
  std::vector<glm::dvec3> result = line;
  for (std::size_t i = 1; i + 1 < line.size(); ++i) result[i] = 0.25 * (line[i - 1] + 2.0 * line[i] + line[i + 1]);
  return result;
}

double lengthOf(std::span<const glm::dvec3> line) {
  double length = 0.0;
  for (std::size_t i = 1; i < line.size(); ++i) length += glm::length(line[i] - line[i - 1]);
  return length;
}

/// The same line through kSegments + 1 points at even distances along it.
std::vector<glm::dvec3> evenlySpaced(const std::vector<glm::dvec3>& line) {
  const double spacing = lengthOf(line) / kSegments;
  std::vector<glm::dvec3> result{line.front()};
  double before = 0.0;
  std::size_t i = 1;
  for (int k = 1; k < kSegments; ++k) {
    const double wanted = k * spacing;
    double segment = glm::length(line[i] - line[i - 1]);
    while (i + 1 < line.size() && before + segment < wanted) {
      before += segment;
      ++i;
      segment = glm::length(line[i] - line[i - 1]);
    }
    result.push_back(
        glm::mix(line[i - 1], line[i], segment > 0.0 ? std::clamp((wanted - before) / segment, 0.0, 1.0) : 0.0));
  }
  result.push_back(line.back());
  return result;
}

/// The vein of a piece, without what hangs on it.
Vein veinOf(const PlaceGraph& graph, const Piece& piece, std::span<const std::uint32_t> roots,
            const std::vector<double>& distances) {
  Vein vein;
  // Chords between even places of a bent line differ in length; the second pass leaves a tenth of the difference.
  vein.points = evenlySpaced(evenlySpaced(smoothed(evenlySpaced(sections(graph, piece, roots, distances)))));
  vein.lengthM = lengthOf(vein.points);
  return vein;
}

/// Hangs places on a vein whose tip is `farthest` from the root.
void hang(Vein& vein, const PlaceGraph& graph, std::span<const std::uint32_t> places,
          const std::vector<double>& distances, double farthest) {
  for (const std::uint32_t p : places) {
    const double share = distances[p] / farthest;
    vein.places.push_back(p);
    vein.s.push_back(nearestOn(vein.points, graph.places[p], share - kWindow, share + kWindow).s);
  }
}

/// A part's long pieces beyond a cut, and what is left.
struct Limbs {
  std::vector<Piece> pieces;  ///< none, or several
  Piece rest;
};

std::uint32_t leaderOf(std::vector<std::uint32_t>& leaders, std::uint32_t place) {
  while (leaders[place] != place) place = leaders[place] = leaders[leaders[place]];
  return place;
}

/// The piece that each place beyond a distance belongs to, by number; kNone: to none that reaches over a third of the
/// way from the cut to the farthest place. Returns how many there are.
std::uint32_t piecesBeyond(const PlaceGraph& graph, std::uint32_t part, double cut, double farthest,
                           const std::vector<double>& distances, std::vector<std::uint32_t>& numbers) {
  const std::vector<std::uint32_t>& places = graph.ofPart[part];
  std::vector<std::uint32_t> local(places.size());  // leaders, by place in the part
  std::iota(local.begin(), local.end(), 0u);
  const auto indexOf = [&](std::uint32_t p) {
    return static_cast<std::uint32_t>(std::lower_bound(places.begin(), places.end(), p) - places.begin());
  };
  for (std::uint32_t i = 0; i < places.size(); ++i) {
    if (distances[places[i]] < cut) continue;
    for (std::uint32_t e = graph.firstEdge[places[i]]; e < graph.firstEdge[places[i] + 1]; ++e) {
      const std::uint32_t q = graph.edges[e];
      if (q < places[i] && distances[q] >= cut) local[leaderOf(local, i)] = leaderOf(local, indexOf(q));
    }
  }
  std::vector<double> reach(places.size(), 0.0);
  for (std::uint32_t i = 0; i < places.size(); ++i) {
    double& own = reach[leaderOf(local, i)];
    own = std::max(own, distances[places[i]]);
  }
  std::vector<std::uint32_t> numberOf(places.size(), kNone);
  std::uint32_t count = 0;
  numbers.assign(places.size(), kNone);
  for (std::uint32_t i = 0; i < places.size(); ++i) {
    if (distances[places[i]] < cut) continue;
    const std::uint32_t leader = leaderOf(local, i);
    if (reach[leader] - cut < (farthest - cut) / 3.0) continue;
    if (numberOf[leader] == kNone) numberOf[leader] = count++;
    numbers[i] = numberOf[leader];
  }
  return count;
}

Limbs findLimbs(const PlaceGraph& graph, std::uint32_t part, double farthest, const std::vector<double>& distances) {
  constexpr int kCuts = 5;
  const std::vector<std::uint32_t>& places = graph.ofPart[part];
  Limbs limbs;
  std::vector<std::uint32_t> numbers;
  std::uint32_t count = 0;
  for (int i = 1; i <= kCuts && count < 2; ++i) {
    count = piecesBeyond(graph, part, kDeepestCut * farthest * i / kCuts, farthest, distances, numbers);
  }
  if (count < 2) {
    limbs.rest = {places, graph.triangles[part]};
    return limbs;
  }
  limbs.pieces.resize(count);
  for (std::size_t i = 0; i < places.size(); ++i) {
    (numbers[i] == kNone ? limbs.rest : limbs.pieces[numbers[i]]).places.push_back(places[i]);
  }
  for (const glm::uvec3& triangle : graph.triangles[part]) {
    std::uint32_t number = kNone;  // no edge joins two pieces
    for (int i = 0; i < 3; ++i) {
      const auto at = std::lower_bound(places.begin(), places.end(), triangle[i]) - places.begin();
      number = std::min(number, numbers[static_cast<std::size_t>(at)]);
    }
    (number == kNone ? limbs.rest : limbs.pieces[number]).triangles.push_back(triangle);
  }
  return limbs;
}

}  // namespace

PlaceGraph placeGraph(const mesh::Model& model, const mesh::Parts& parts) {
  PlaceGraph graph;
  for (std::size_t i = 0; i < model.positions.size(); ++i) {
    if (parts.welded[i] == graph.places.size()) graph.places.emplace_back(model.positions[i]);
  }
  const std::size_t count = graph.places.size();
  std::vector<std::uint32_t> number(model.positions.size(), PlaceGraph::kNoPart);
  graph.part.assign(count, PlaceGraph::kNoPart);
  graph.firstEdge.assign(count + 1, 0);
  std::uint32_t found = 0;
  for (std::size_t t = 0; t < model.triangles.size(); ++t) {
    std::uint32_t& part = number[parts.ofTriangle[t]];
    if (part == PlaceGraph::kNoPart) part = found++;
    for (int i = 0; i < 3; ++i) {
      const std::uint32_t place = parts.welded[model.triangles[t][i]];
      graph.part[place] = part;
      graph.firstEdge[place + 1] += 2;
    }
  }
  graph.ofPart.resize(found);
  for (std::uint32_t p = 0; p < count; ++p) {
    if (graph.part[p] != PlaceGraph::kNoPart) graph.ofPart[graph.part[p]].push_back(p);
    graph.firstEdge[p + 1] += graph.firstEdge[p];
  }
  std::vector<std::uint32_t> next(graph.firstEdge.begin(), graph.firstEdge.end() - 1);
  graph.edges.resize(graph.firstEdge.back());
  graph.triangles.resize(found);
  for (std::size_t t = 0; t < model.triangles.size(); ++t) {
    const glm::uvec3& triangle = model.triangles[t];
    graph.triangles[number[parts.ofTriangle[t]]].emplace_back(parts.welded[triangle.x], parts.welded[triangle.y],
                                                              parts.welded[triangle.z]);
    for (int i = 0; i < 3; ++i) {
      const std::uint32_t place = parts.welded[triangle[i]];
      graph.edges[next[place]++] = parts.welded[triangle[(i + 1) % 3]];
      graph.edges[next[place]++] = parts.welded[triangle[(i + 2) % 3]];
    }
  }
  return graph;
}

Nearest nearestOn(std::span<const glm::dvec3> vein, const glm::dvec3& place, double from, double to) {
  const std::size_t segments = vein.size() - 1;
  const auto count = static_cast<double>(segments);
  const auto first = static_cast<std::size_t>(std::clamp(std::floor(from * count), 0.0, count - 1.0));
  const auto last =
      static_cast<std::size_t>(std::clamp(std::ceil(to * count), static_cast<double>(first) + 1.0, count));
  Nearest best{0.0, kInfinite};
  for (std::size_t i = first; i < last; ++i) {
    const glm::dvec3 along = vein[i + 1] - vein[i], offset = place - vein[i];
    const double square = glm::dot(along, along);
    const double t = square > 0.0 ? std::clamp(glm::dot(offset, along) / square, 0.0, 1.0) : 0.0;
    const glm::dvec3 away = offset - t * along;
    const double distance = glm::dot(away, away);
    if (distance < best.distance) best = {(static_cast<double>(i) + t) / count, distance};
  }
  best.distance = std::sqrt(best.distance);
  return best;
}

std::vector<Vein> findVeins(const PlaceGraph& graph, std::uint32_t part, std::vector<double>& distances) {
  const std::vector<std::uint32_t>& places = graph.ofPart[part];
  const std::vector<std::uint32_t> roots = rootPlaces(graph, places);
  walk(graph, places, roots, distances);
  const double farthest = farthestOf(places, distances);
  if (!(farthest > 0.0)) {  // all in one place, or all of it is root
    return {{std::vector<glm::dvec3>(2, meanOf(graph, places)), 0.0, places, std::vector<double>(places.size(), 0.0)}};
  }
  Limbs limbs = findLimbs(graph, part, farthest, distances);
  std::vector<Vein> veins;
  for (const Piece& limb : limbs.pieces) {
    Piece whole = limb;
    whole.places.insert(whole.places.end(), limbs.rest.places.begin(), limbs.rest.places.end());
    whole.triangles.insert(whole.triangles.end(), limbs.rest.triangles.begin(), limbs.rest.triangles.end());
    veins.push_back(veinOf(graph, whole, roots, distances));
    hang(veins.back(), graph, limb.places, distances, farthestOf(limb.places, distances));
  }
  if (veins.empty()) {
    veins.push_back(veinOf(graph, limbs.rest, roots, distances));
    hang(veins.back(), graph, limbs.rest.places, distances, farthest);
    return veins;
  }
  for (const std::uint32_t p : limbs.rest.places) {  // on the vein that passes nearest
    Vein* best = &veins.front();
    Nearest nearest{0.0, kInfinite};
    for (Vein& vein : veins) {
      const Nearest found = nearestOn(vein.points, graph.places[p], 0.0, kDeepestCut + kWindow);
      if (found.distance >= nearest.distance) continue;
      nearest = found;
      best = &vein;
    }
    best->places.push_back(p);
    best->s.push_back(nearest.s);
  }
  return veins;
}

}  // namespace sward::wither
