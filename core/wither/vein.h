#pragma once

#include "mesh/model.h"
#include "mesh/parts.h"

#include <cstdint>
#include <span>
#include <vector>

#include <glm/glm.hpp>

namespace sward::wither {

/// The places of a mesh's vertices and the edges between them, part by part.
struct PlaceGraph {
  std::vector<glm::dvec3> places;
  std::vector<std::uint32_t> part;                 ///< one a place: index of its part; kNoPart: in no triangle
  std::vector<std::vector<std::uint32_t>> ofPart;  ///< places, rising
  std::vector<std::vector<glm::uvec3>> triangles;  ///< by part, of places
  std::vector<std::uint32_t> firstEdge, edges;     ///< neighbours of place p: edges[firstEdge[p] .. firstEdge[p + 1])
  static constexpr std::uint32_t kNoPart = 0xffffffffu;
};
PlaceGraph placeGraph(const mesh::Model& model, const mesh::Parts& parts);

/// A line from a root to a tip, and what hangs on it.
struct Vein {
  std::vector<glm::dvec3> points;  ///< evenly spaced
  double lengthM = 0.0;
  std::vector<std::uint32_t> places;
  /// One a place: s of the nearest place of the vein, among those that are about as far from the root.
  std::vector<double> s;
};
/// The veins of a part, between which its places are shared out: middles of the sections that lie equally far from the
/// root along the mesh's edges (Dijkstra). One, unless what is farther than some distance of up to a quarter of the
/// whole falls apart into several long pieces: a tuft or rosette in one mesh, of which each leaf has its own vein from
/// the root. `distances` is room for one number a place of the graph; its content does not matter.
std::vector<Vein> findVeins(const PlaceGraph& graph, std::uint32_t part, std::vector<double>& distances);

/// The nearest place of a polyline of evenly spaced points.
struct Nearest {
  double s = 0.0, distance = 0.0;
};
/// Only places with s in [from, to] are looked at, rounded out to whole segments.
Nearest nearestOn(std::span<const glm::dvec3> vein, const glm::dvec3& place, double from = 0.0, double to = 1.0);

}  // namespace sward::wither
