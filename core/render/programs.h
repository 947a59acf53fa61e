#pragma once

#include "base/result.h"
#include "gpu/program.h"

#include <map>
#include <string>
#include <utility>
#include <vector>

namespace sward::render {

using Defines = std::vector<std::pair<std::string, std::string>>;

/// Linked programs of one renderer, built when first asked for.
class ProgramCache {
 public:
  /// A compute program. The pointer stays valid as long as the cache.
  Result<gpu::Program*> compute(const std::string& file, const Defines& defines,
                                const std::vector<std::string>& uniforms);
  /// ground/block.vert with a fragment shader.
  Result<gpu::Program*> blocks(const std::string& file, const Defines& defines,
                               const std::vector<std::string>& uniforms);

  /// Any vertex shader with a fragment shader.
  Result<gpu::Program*> drawing(const std::string& vertexFile, const std::string& file, const Defines& defines,
                                const std::vector<std::string>& uniforms);

 private:
  Result<gpu::Program*> get(const gpu::ProgramSource& source);
  std::map<std::string, gpu::Program> m_programs;
};

/// Sets a uniform that a variant may have lost to the compiler.
template <typename T>
void setIfUsed(gpu::Program& program, const std::string& uniform, const T& value) {
  if (program.has(uniform)) program.set(uniform, value);
}

}  // namespace sward::render
