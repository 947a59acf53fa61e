#include "trace/triangle_field.h"

#include "base/check.h"
#include "base/parallel.h"
#include "trace/scene_builder.h"

#include <algorithm>
#include <limits>

namespace sward::trace {

Result<std::unique_ptr<TriangleField>> TriangleField::create(std::shared_ptr<const scene::Patch> patch,
                                                             const JobContext& job) {
  SWARD_CHECK(patch != nullptr);
  SWARD_TRY(requireTraceable(*patch));
  auto field = std::make_unique<TriangleField>();
  field->m_patch = std::move(patch);
  std::size_t vertices = 0;
  for (std::size_t i = 0; i < field->m_patch->instances.size(); ++i) {
    const auto& model = field->m_patch->models[field->m_patch->instances[i].model];
    if (!model || model->empty()) continue;
    field->m_parts.push_back({static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(field->m_triangles), vertices,
                              model.get(), mesh::hasAlpha(*model)});
    vertices += model->positions.size();
    field->m_triangles += model->triangles.size();
  }
  if (field->m_triangles > std::numeric_limits<std::uint32_t>::max()) {
    return Error::failed("there are too many triangles", "layer sampling", "Use fewer plants, or simpler ones.");
  }
  field->m_positions.resize(vertices);
  base::parallelFor(job, field->m_parts.size(), 64, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Part& part = field->m_parts[i];
      const glm::mat4x3& worldFromModel = field->m_patch->instances[part.instance].worldFromModel;
      glm::vec3* out = field->m_positions.data() + part.firstVertex;
      for (const glm::vec3& position : part.model->positions) *out++ = worldFromModel * glm::vec4(position, 1.0f);
    }
  });
  if (job.cancelled()) return Error::cancelled();
  return field;
}

const TriangleField::Part& TriangleField::partOf(std::uint32_t triangle) const {
  const auto after = std::upper_bound(m_parts.begin(), m_parts.end(), triangle,
                                      [](std::uint32_t t, const Part& part) { return t < part.firstTriangle; });
  return *std::prev(after);
}

}  // namespace sward::trace
