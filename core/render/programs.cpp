#include "render/programs.h"

#include "render/shader_files.h"

#include <optional>
#include <string_view>

namespace sward::render {
namespace {

std::optional<std::string_view> embedded(std::string_view name) {
  for (const ShaderFile& file : embeddedShaders())
    if (file.name == name) return file.text;
  return std::nullopt;
}

}  // namespace

Result<gpu::Program*> ProgramCache::compute(const std::string& file, const Defines& defines,
                                            const std::vector<std::string>& uniforms) {
  return get({{{GL_COMPUTE_SHADER, file}}, defines, uniforms});
}

Result<gpu::Program*> ProgramCache::blocks(const std::string& file, const Defines& defines,
                                           const std::vector<std::string>& uniforms) {
  return drawing("ground/block.vert", file, defines, uniforms);
}

Result<gpu::Program*> ProgramCache::drawing(const std::string& vertexFile, const std::string& file,
                                            const Defines& defines, const std::vector<std::string>& uniforms) {
  return get({{{GL_VERTEX_SHADER, vertexFile}, {GL_FRAGMENT_SHADER, file}}, defines, uniforms});
}

Result<gpu::Program*> ProgramCache::get(const gpu::ProgramSource& source) {
  std::string key;
  for (const auto& stage : source.stages) key += stage.file + '\n';
  for (const auto& [name, value] : source.defines) key += name + '=' + value + '\n';
  const auto found = m_programs.find(key);
  if (found != m_programs.end()) return &found->second;
  SWARD_ASSIGN(gpu::Program program, gpu::Program::build(embedded, source));
  return &m_programs.emplace(key, std::move(program)).first->second;
}

}  // namespace sward::render
