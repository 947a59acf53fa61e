#include "mesh/gltf_read.h"

#include "mesh/gltf_document.h"
#include "mesh/gltf_material.h"
#include "mesh/gltf_primitive.h"
#include "mesh/gltf_uri.h"

#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <cmath>
#include <exception>
#include <limits>
#include <new>
#include <set>

namespace sward::mesh {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxWarnings = 40;

/// Runs `body`, puts the file's name before the place of its error, and turns whatever the libraries throw into one.
template <typename Body>
auto guarded(const fs::path& path, Body&& body) -> decltype(body()) {
  try {
    auto result = body();
    if (result.ok()) return result;
    Error error = std::move(result).error();
    if (!error.where.starts_with(path.string())) {
      error.where = error.where.empty() ? path.string() : path.string() + ": " + error.where;
    }
    return error;
  } catch (const std::bad_alloc&) {
    return Error::failed("there is not enough memory for the model", path.string(), "Use a simpler model.");
  } catch (const std::exception& problem) {
    return Error::badInput(std::string("the file cannot be read: ") + problem.what(), path.string(),
                           "Export the file again with a glTF 2.0 exporter.");
  }
}

Result<glm::dmat4> localTransform(const tinygltf::Node& node, const std::string& where) {
  glm::dmat4 transform(1.0);
  if (node.matrix.size() == 16) {
    for (int i = 0; i < 16; ++i) transform[i / 4][i % 4] = node.matrix[static_cast<std::size_t>(i)];
    return transform;
  }
  if (node.translation.size() == 3) {
    transform[3] = glm::dvec4(node.translation[0], node.translation[1], node.translation[2], 1.0);
  }
  if (node.rotation.size() == 4) {
    const glm::dquat rotation(node.rotation[3], node.rotation[0], node.rotation[1], node.rotation[2]);
    const double length = glm::length(rotation);
    if (!(length > 1e-6) || !std::isfinite(length)) {
      return Error::badInput("the rotation is not a unit quaternion", where + ".rotation", "Export the file again.");
    }
    transform *= glm::mat4_cast(rotation / length);
  }
  if (node.scale.size() == 3) {
    for (int i = 0; i < 3; ++i) transform[i] *= node.scale[static_cast<std::size_t>(i)];
  }
  return transform;
}

std::string named(const char* array, int index, const std::string& name) {
  std::string text = std::string(array) + "[" + std::to_string(index) + "]";
  return name.empty() ? text : text + " \"" + name.substr(0, 60) + "\"";
}

class SceneWalk {
 public:
  SceneWalk(GltfDocument& document, Gathered& out, MaterialReader& materials)
      : m_document(document), m_out(out), m_materials(materials), m_visited(document.model.nodes.size(), false) {}

  Result<void> run() {
    const tinygltf::Model& model = m_document.model;
    if (model.nodes.empty()) return appendLooseMeshes();
    for (const int root : roots()) m_pending.push_back({root, glm::dmat4(1.0)});
    while (!m_pending.empty()) {
      const Pending next = m_pending.back();
      m_pending.pop_back();
      SWARD_TRY(visit(next.node, next.worldFromParent));
    }
    return {};
  }

 private:
  struct Pending {
    int node = 0;
    glm::dmat4 worldFromParent{1.0};
  };

  /// In reverse, since the walk takes from the end.
  std::vector<int> roots() const {
    const tinygltf::Model& model = m_document.model;
    std::vector<int> result;
    if (!model.scenes.empty()) {
      result = model.scenes[static_cast<std::size_t>(std::max(model.defaultScene, 0))].nodes;
    } else {
      std::vector<bool> isChild(model.nodes.size(), false);
      for (const tinygltf::Node& node : model.nodes) {
        for (const int child : node.children) isChild[static_cast<std::size_t>(child)] = true;
      }
      for (std::size_t i = 0; i < isChild.size(); ++i) {
        if (!isChild[i]) result.push_back(static_cast<int>(i));
      }
      // Without a scene and without a root every node lies on a cycle; start anywhere to find and name it.
      if (result.empty()) result.push_back(0);
    }
    std::reverse(result.begin(), result.end());
    return result;
  }

  Result<void> visit(int index, const glm::dmat4& worldFromParent) {
    const tinygltf::Node& node = m_document.model.nodes[static_cast<std::size_t>(index)];
    const std::string where = named("nodes", index, node.name);
    if (m_visited[static_cast<std::size_t>(index)]) {
      return Error::badInput("the node is reached twice: nodes form a cycle, or one has two parents", where,
                             "Mend the hierarchy and export the file again.");
    }
    m_visited[static_cast<std::size_t>(index)] = true;
    SWARD_ASSIGN(const glm::dmat4 local, localTransform(node, where));
    const glm::dmat4 world = worldFromParent * local;
    if (node.mesh >= 0) {
      if (node.skin >= 0) m_out.model.warnings.push_back(where + ": its skin is left out, the mesh stands as modelled");
      SWARD_TRY(appendMesh(node.mesh, node.name, world, where + ", "));
    }
    for (auto child = node.children.rbegin(); child != node.children.rend(); ++child)
      m_pending.push_back({*child, world});
    return {};
  }

  Result<void> appendMesh(int index, const std::string& node, const glm::dmat4& world, const std::string& where) {
    const tinygltf::Mesh& mesh = m_document.model.meshes[static_cast<std::size_t>(index)];
    for (std::size_t i = 0; i < mesh.primitives.size(); ++i) {
      const std::string place = where + named("meshes", index, mesh.name) + ".primitives[" + std::to_string(i) + "]";
      SWARD_TRY(appendPrimitive(m_out, m_document, m_materials, mesh.primitives[i], node, world, place));
    }
    return {};
  }

  /// A file without nodes is a library of meshes; they are taken as they stand.
  Result<void> appendLooseMeshes() {
    if (m_document.model.meshes.empty()) return {};
    m_out.model.warnings.push_back("no node places the meshes; they are taken where they stand");
    for (std::size_t i = 0; i < m_document.model.meshes.size(); ++i) {
      SWARD_TRY(appendMesh(static_cast<int>(i), m_document.model.meshes[i].name, glm::dmat4(1.0), ""));
    }
    return {};
  }

  GltfDocument& m_document;
  Gathered& m_out;
  MaterialReader& m_materials;
  std::vector<bool> m_visited;
  std::vector<Pending> m_pending;
};

/// Turns y up into z up, (x, y, z) -> (x, -z, y), scales, stands on z = 0 and centres.
Result<void> place(Gathered& gathered, const std::optional<double>& heightM) {
  constexpr double kLimit = std::numeric_limits<double>::max();
  glm::dvec3 low(kLimit), high(-kLimit);
  for (glm::dvec3& p : gathered.positions) {
    p = glm::dvec3(p.x, -p.z, p.y);
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  double scale = 1.0;
  if (heightM) {
    const double height = high.z - low.z;
    if (!(*heightM > 0.0) || !std::isfinite(*heightM)) {
      return Error::badInput("the requested height is " + std::to_string(*heightM) + " m", {},
                             "Ask for a height above 0.");
    }
    if (!(height > 0.0)) {
      return Error::badInput("the model has no height, so it cannot be scaled to " + std::to_string(*heightM) + " m",
                             {}, "Leave the height out, or stand the model upright (glTF has y up).");
    }
    scale = *heightM / height;
  }
  const glm::dvec3 foot(0.5 * (low.x + high.x), 0.5 * (low.y + high.y), low.z);
  Model& model = gathered.model;
  model.positions.reserve(gathered.positions.size());
  for (const glm::dvec3& p : gathered.positions) {
    const glm::vec3 placed((p - foot) * scale);
    if (!std::isfinite(placed.x) || !std::isfinite(placed.y) || !std::isfinite(placed.z)) {
      return Error::badInput("the model is too large for floating-point numbers", {},
                             "Scale it down and export it again.");
    }
    model.positions.push_back(placed);
  }
  for (glm::vec3& n : model.normals) n = glm::vec3(n.x, -n.z, n.y);
  return {};
}

void addSummaries(const Gathered& gathered) {
  std::vector<std::string>& warnings = gathered.model.warnings;
  const auto add = [&](std::uint64_t count, const char* text) {
    if (count > 0) warnings.push_back(std::to_string(count) + text);
  };
  add(gathered.otherPrimitives, " primitives of points or lines were left out");
  add(gathered.degenerate, " triangles without area were left out");
  add(gathered.repairedNormals, " normals of no length were replaced");
  if (warnings.size() > kMaxWarnings) {
    const std::size_t more = warnings.size() - kMaxWarnings;
    warnings.resize(kMaxWarnings);
    warnings.push_back("and " + std::to_string(more) + " more warnings");
  }
}

Result<Model> read(const fs::path& path, const GltfReadOptions& options) {
  SWARD_ASSIGN(GltfDocument document, parseGltf(path));
  SWARD_TRY(loadBuffers(document));
  Model model;
  model.name = path.stem().string();
  model.warnings = document.warnings;
  Gathered gathered{model, {}, 0, 0, 0};
  MaterialReader materials(document, model, options.material);
  SWARD_TRY(SceneWalk(document, gathered, materials).run());
  if (model.triangles.empty()) {
    std::string what = "the scene holds no triangles";
    if (gathered.otherPrimitives > 0) what = "the scene holds points or lines but no triangles";
    if (gathered.degenerate > 0) what = "no triangle of the scene has an area";
    return Error::badInput(what, {}, "Export a mesh with faces.");
  }
  SWARD_TRY(place(gathered, options.heightM));
  addSummaries(gathered);
  return model;
}

Result<std::vector<fs::path>> closure(const fs::path& path) {
  SWARD_ASSIGN(const GltfDocument document, parseGltf(path));
  std::set<fs::path> files = {path};
  for (const std::vector<std::string>* uris : {&document.bufferUris, &document.imageUris}) {
    for (const std::string& uri : *uris) {
      if (uri.empty() || isDataUri(uri)) continue;
      const Result<fs::path> file = resolveUri(document.folder, uri);
      std::error_code code;
      if (file.ok() && fs::is_regular_file(*file, code)) files.insert(*file);
    }
  }
  return std::vector<fs::path>(files.begin(), files.end());
}

}  // namespace

Result<Model> readGltf(const fs::path& path, const GltfReadOptions& options) {
  return guarded(path, [&] { return read(path, options); });
}

Result<std::vector<fs::path>> gltfClosure(const fs::path& path) {
  return guarded(path, [&] { return closure(path); });
}

}  // namespace sward::mesh
