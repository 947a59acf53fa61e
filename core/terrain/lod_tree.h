#pragma once

#include "base/job.h"
#include "terrain/height_field.h"

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include <glm/glm.hpp>

namespace sward::terrain {

/// Quads along a chunk's side. Every two by two of them are a fan of eight triangles around their middle, so that the
/// edges of a coarser level are made of those of the finer ones, and an edge's midpoint belongs to two triangles alone.
inline constexpr int kChunkQuads = 8;
inline constexpr int kChunkVertices = (kChunkQuads + 1) * (kChunkQuads + 1);

/// A square of the plane: chunk (x, y) of a level covers samples [8 x 2^level, 8 (x + 1) 2^level]. Levels below 0 lie
/// between the samples.
struct LodNode {
  int level = 0;
  long x = 0, y = 0;
  bool operator==(const LodNode&) const = default;
};

/// Sides whose neighbour is one level coarser: bits of LodChunk::coarserSides.
enum LodSide : unsigned { kWest = 1, kEast = 2, kSouth = 4, kNorth = 8 };

struct LodChunk {
  LodNode node;
  unsigned coarserSides = 0;
  bool visible = true;  ///< some of it may lie in the view
  double errorM =
      0.0;  ///< bound of the vertical distance between the chunk's triangles, stitches included, and the field
};

struct LodView {
  glm::dvec3 eye{0.0};
  /// Half-spaces dot(plane, (p, 1)) >= 0 that hold what is seen; none: all is seen.
  std::vector<glm::dvec4> planes;
  double errorAngle = 1e-3;  ///< largest error over distance; smaller is finer
  double farM = 32000.0;     ///< the mesh reaches at least so far from the eye along both axes
  int finestLevel = -3;
  double liftM = 0.0;  ///< the surface is drawn so much higher, which what is visible takes into account
};

/// Levels of detail of a height field over the whole plane: which chunks draw it for a view, without cracks.
class LodTree {
 public:
  /// Measures the errors of all levels: some 60 ns a sample.
  LodTree(std::shared_ptr<const HeightField> field, const JobContext& job = {});

  const HeightField& field() const { return *m_field; }

  /// The leaves of a quadtree round the eye: each chunk's own error is at most errorAngle times its distance, or it is
  /// of the finest level; sides are at most four times the distance (or 16 m); neighbours differ by one level at most.
  std::vector<LodChunk> select(const LodView& view) const;

  /// Bound of the vertical distance between a node's triangles (without stitches) and the field: never too small, and
  /// never smaller than that of a finer node within. Level 0: h^2 / 4 times the curvature's bound (linear interpolation
  /// in a right triangle with legs h); each further level adds the distance between the two triangulations, which is
  /// largest at a vertex.
  double errorM(const LodNode& node) const;

  /// World places of a chunk's vertices relative to `anchor`, row by row from the south-west. Vertices that chunks
  /// share have the same bits.
  void vertices(const LodNode& node, const glm::dvec3& anchor, std::span<glm::vec3, kChunkVertices> out) const;

  /// Triangles of a chunk, counter-clockwise from above: three vertices each. Sides named leave out every other vertex
  /// of their border, and meet a neighbour of the next coarser level.
  static const std::vector<std::uint16_t>& indices(unsigned coarserSides);

 private:
  struct ErrorLevel {
    long columns = 0, rows = 0;
    std::vector<float> errors;
  };
  long firstNode() const { return m_field->grid().border == Border::Repeat ? 0 : -1; }
  void measureCells(const JobContext& job);
  void measureLevel(int level, const JobContext& job);
  double stepError(int level, long x, long y) const;

  std::shared_ptr<const HeightField> m_field;
  std::vector<ErrorLevel> m_levels;
};

}  // namespace sward::terrain
