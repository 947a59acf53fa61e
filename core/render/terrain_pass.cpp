#include "render/terrain_pass.h"

#include "terrain/sun_shadow.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

namespace sward::render {
namespace {

constexpr double kNearM = 0.05;
constexpr double kErrorPixels = 5.0;  ///< of the levels of detail; bounds are some three times the real errors
constexpr double kHazeDepths = 6.0;   ///< of haze that hide all but a four hundredth
constexpr double kLeastFarM = 2000.0;
constexpr int kMaxGroundTexels = 2048;  ///< along a side of the texture of slopes
constexpr double kLeastOverGroundM = 1e-3;
constexpr GLuint kFirstUnit = 5;  ///< below are those of the ground pass

double pixelAngle(const Frame& frame) {
  return 2.0 * frame.camera.tanHalfWidth / frame.width;
}

/// The sides of the view's pyramid, and what lies before the eye.
std::vector<glm::dvec4> viewPlanes(const Frame& frame, const glm::dvec3& eye) {
  const scene::Camera& camera = frame.camera;
  // Samples lie up to a pixel beyond the picture.
  const double wide = camera.tanHalfWidth * (1.0 + 4.0 / frame.width);
  const double high = camera.tanHalfWidth * frame.height / frame.width * (1.0 + 4.0 / frame.height);
  std::vector<glm::dvec4> planes;
  const auto add = [&](const glm::dvec3& normal) { planes.emplace_back(normal, -glm::dot(normal, eye)); };
  for (const double side : {-1.0, 1.0}) {
    add(camera.forward * wide + camera.right * side);
    add(camera.forward * high + camera.up * side);
  }
  add(camera.forward);
  return planes;
}

}  // namespace

Result<TerrainPass> TerrainPass::create(std::shared_ptr<const terrain::HeightField> field) {
  TerrainPass pass;
  const terrain::HeightGrid& grid = field->grid();
  while (std::max(grid.columns, grid.rows) / pass.m_step > kMaxGroundTexels) pass.m_step *= 2;
  const bool repeats = grid.border == terrain::Border::Repeat;
  pass.m_ground = gpu::Texture::make2d(GL_RGBA16F, grid.columns / pass.m_step, grid.rows / pass.m_step);
  pass.m_ground.setLinear(repeats, repeats);
  pass.m_vertices = gpu::VertexArray::make();
  pass.m_tree = std::make_shared<terrain::LodTree>(std::move(field));
  pass.setSun({0.0, 0.0, 1.0});
  return pass;
}

void TerrainPass::setSun(const glm::dvec3& toSun) {
  const terrain::HeightGrid& grid = field().grid();
  const std::vector<float> seen = terrain::sunVisibility(field(), toSun);
  std::vector<float> texels;
  texels.reserve(seen.size() * 4 / static_cast<std::size_t>(m_step * m_step) + 4);
  for (int y = 0; y < m_ground.height(); ++y) {
    for (int x = 0; x < m_ground.width(); ++x) {
      // At the samples a Catmull-Rom spline's slope is the neighbours' difference.
      const long column = static_cast<long>(x) * m_step, row = static_cast<long>(y) * m_step;
      const auto h = [&](long dx, long dy) { return field().latticeHeight(column + dx, row + dy); };
      texels.push_back(static_cast<float>((h(1, 0) - h(-1, 0)) / (2.0 * grid.cellM.x)));
      texels.push_back(static_cast<float>((h(0, 1) - h(0, -1)) / (2.0 * grid.cellM.y)));
      texels.push_back(seen[grid.offset(static_cast<int>(column), static_cast<int>(row))]);
      texels.push_back(1.0f);
    }
  }
  m_ground.write(GL_RGBA, GL_FLOAT, texels.data());
}

TerrainMesh TerrainPass::plan(const Frame& frame, double heightM, double hazePerM) const {
  TerrainMesh mesh;
  mesh.eye = frame.camera.position;
  const double ground = field().height(glm::dvec2(mesh.eye));
  mesh.eyeOverGroundM = std::max(mesh.eye.z - ground, kLeastOverGroundM);
  mesh.eye.z = ground + mesh.eyeOverGroundM;
  terrain::LodView view;
  view.eye = mesh.eye;
  view.planes = viewPlanes(frame, mesh.eye);
  view.errorAngle = kErrorPixels * pixelAngle(frame);
  view.liftM = heightM;
  if (hazePerM > 0.0) view.farM = std::clamp(kHazeDepths / hazePerM, kLeastFarM, view.farM);
  std::vector<glm::vec3> vertices;
  std::vector<std::uint32_t> indices;
  for (const terrain::LodChunk& chunk : m_tree->select(view)) {
    if (!chunk.visible) continue;
    const std::size_t base = vertices.size();
    vertices.resize(base + terrain::kChunkVertices);
    m_tree->vertices(chunk.node, mesh.eye,
                     std::span<glm::vec3, terrain::kChunkVertices>(vertices.data() + base, terrain::kChunkVertices));
    for (const std::uint16_t index : terrain::LodTree::indices(chunk.coarserSides))
      indices.push_back(static_cast<std::uint32_t>(base + index));
    ++mesh.chunks;
  }
  mesh.indexCount = static_cast<int>(indices.size());
  mesh.vertices = gpu::Buffer(std::as_bytes(std::span(vertices)));
  mesh.indices = gpu::Buffer(std::as_bytes(std::span(indices)));
  mesh.view = gpu::Texture::ofBuffer(GL_RGB32F, mesh.vertices);
  return mesh;
}

Result<void> TerrainPass::makeTargets(int width, int height) {
  if (m_first.distance.width() == width && m_first.distance.height() == height) return {};
  for (Entry* entry : {&m_first, &m_second}) {
    entry->distance = gpu::Texture::make2d(GL_R32F, width, height);
    entry->depth = gpu::Texture::make2d(GL_DEPTH_COMPONENT32F, width, height);
    entry->framebuffer = gpu::Framebuffer(entry->distance, entry->depth);
    if (!entry->framebuffer.complete()) return Error::failed("the driver cannot draw into depths", "framebuffer");
  }
  return {};
}

Result<void> TerrainPass::drawEntry(ProgramCache& programs, const Frame& frame, const TerrainMesh& mesh, double heightM,
                                    glm::dvec2 jitter, bool second) {
  SWARD_ASSIGN(gpu::Program * program,
               programs.drawing("ground/terrain_mesh.vert", "ground/terrain_entry.frag",
                                {{"SWARD_SECOND", second ? "1" : "0"}}, {"t_vertices", "u_right", "u_liftM"}));
  const scene::Camera& camera = frame.camera;
  const double aspect = static_cast<double>(frame.width) / frame.height;
  program->use();
  program->set("t_vertices", 0);
  mesh.view.bind(0);
  if (second) {
    setIfUsed(*program, "t_first", 1);
    m_first.distance.bind(1);
  }
  program->set("u_right", glm::vec3(camera.right / camera.tanHalfWidth));
  program->set("u_up", glm::vec3(camera.up * (aspect / camera.tanHalfWidth)));
  program->set("u_forward", glm::vec3(camera.forward));
  program->set("u_jitter", glm::vec2(jitter));
  program->set("u_liftM", static_cast<float>(heightM));
  program->set("u_nearM", static_cast<float>(kNearM));
  const Entry& entry = second ? m_second : m_first;
  constexpr float kNothing[4] = {};
  gpu::gl().ClearNamedFramebufferfv(entry.framebuffer.name(), GL_COLOR, 0, kNothing);
  gpu::gl().ClearNamedFramebufferfv(entry.framebuffer.name(), GL_DEPTH, 0, kNothing);
  entry.framebuffer.bind();
  gpu::gl().DrawElements(GL_TRIANGLES, mesh.indexCount, GL_UNSIGNED_INT, nullptr);
  return {};
}

Result<void> TerrainPass::drawEntries(ProgramCache& programs, const Frame& frame, const TerrainMesh& mesh,
                                      double heightM, glm::dvec2 jitter) {
  SWARD_TRY(makeTargets(frame.width, frame.height));
  const gpu::Functions& gl = gpu::gl();
  gl.Viewport(0, 0, frame.width, frame.height);
  m_vertices.setElements(mesh.indices);
  m_vertices.bind();
  gl.Disable(GL_BLEND);
  gl.Enable(GL_DEPTH_TEST);
  gl.Enable(GL_CULL_FACE);
  gl.DepthFunc(GL_GREATER);
  gl.ClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
  Result<void> drawn = drawEntry(programs, frame, mesh, heightM, jitter, false);
  if (drawn) drawn = drawEntry(programs, frame, mesh, heightM, jitter, true);
  gl.ClipControl(GL_LOWER_LEFT, GL_NEGATIVE_ONE_TO_ONE);
  gl.DepthFunc(GL_LESS);
  gl.Disable(GL_CULL_FACE);
  gl.Disable(GL_DEPTH_TEST);
  return drawn;
}

void TerrainPass::bind(gpu::Program& program, const TerrainMesh& mesh) const {
  const terrain::HeightGrid& grid = field().grid();
  const glm::dvec2 texelM = grid.cellM * static_cast<double>(m_step);
  const glm::dvec2 extent = texelM * glm::dvec2(m_ground.width(), m_ground.height());
  glm::dvec2 eye = (glm::dvec2(mesh.eye) - grid.origin + 0.5 * texelM) / extent;
  if (grid.border == terrain::Border::Repeat) eye -= glm::floor(eye);
  setIfUsed(program, "t_first", static_cast<int>(kFirstUnit));
  setIfUsed(program, "t_second", static_cast<int>(kFirstUnit + 1));
  setIfUsed(program, "t_terrain", static_cast<int>(kFirstUnit + 2));
  m_first.distance.bind(kFirstUnit);
  m_second.distance.bind(kFirstUnit + 1);
  m_ground.bind(kFirstUnit + 2);
  setIfUsed(program, "u_terrainEye", glm::vec2(eye));
  setIfUsed(program, "u_terrainPerM", glm::vec2(1.0 / extent));
  setIfUsed(program, "u_eyeOverGroundM", static_cast<float>(mesh.eyeOverGroundM));
  setIfUsed(program, "u_lookAheadM", static_cast<float>(0.5 * std::min(texelM.x, texelM.y)));
}

}  // namespace sward::render
