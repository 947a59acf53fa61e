#pragma once

#include "base/result.h"
#include "gpu/objects.h"
#include "render/programs.h"
#include "render/renderer.h"
#include "terrain/lod_tree.h"

#include <memory>

namespace sward::render {

/// The chunks of a terrain that a camera sees, on the GPU: vertices relative to the eye.
struct TerrainMesh {
  gpu::Buffer vertices, indices;
  gpu::Texture view;  ///< of the vertices
  int indexCount = 0;
  int chunks = 0;
  glm::dvec3 eye{0.0};        ///< the frame's, raised to stand on the ground where it lay below
  double eyeOverGroundM = 0;  ///< above 0
};

/// Finds where the rays of a picture enter the shell over a terrain: rasterises the levels of detail, lifted by the
/// shell's height, into distances; and once more into those of the next entry behind, for rays that leave the shell
/// over a crest. ground/terrain.glsl marches from there.
class TerrainPass {
 public:
  static Result<TerrainPass> create(std::shared_ptr<const terrain::HeightField> field);

  const terrain::HeightField& field() const { return m_tree->field(); }
  /// The shadows of the hills under another sun; uploads them with the slopes.
  void setSun(const glm::dvec3& toSun);

  /// The mesh ends where haze hides it, 32 km away at most.
  TerrainMesh plan(const Frame& frame, double heightM, double hazePerM) const;
  /// Draws the distances of one sample; leaves another framebuffer bound. `jitter`: the sample's place in its pixel, in
  /// [-1, 1] over the picture. The caller's scissor holds.
  Result<void> drawEntries(ProgramCache& programs, const Frame& frame, const TerrainMesh& mesh, double heightM,
                           glm::dvec2 jitter);
  /// Uniforms and textures (from unit 5 on) of ground/terrain.glsl.
  void bind(gpu::Program& program, const TerrainMesh& mesh) const;

 private:
  Result<void> makeTargets(int width, int height);
  Result<void> drawEntry(ProgramCache& programs, const Frame& frame, const TerrainMesh& mesh, double heightM,
                         glm::dvec2 jitter, bool second);

  std::shared_ptr<const terrain::LodTree> m_tree;
  gpu::VertexArray m_vertices;
  gpu::Texture m_ground;  ///< gradient x, y, share of the sun
  int m_step = 1;         ///< samples of the field a texel of m_ground
  struct Entry {
    gpu::Texture distance, depth;
    gpu::Framebuffer framebuffer;
  };
  Entry m_first, m_second;
};

}  // namespace sward::render
