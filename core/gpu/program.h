#pragma once

#include "base/result.h"
#include "gpu/objects.h"

#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <glm/glm.hpp>

namespace sward::gpu {

/// Text of a shader file by its name, such as "ground/march.frag"; nothing when there is no such file.
using ShaderLookup = std::function<std::optional<std::string_view>(std::string_view name)>;

struct ShaderStage {
  GLenum type = GL_VERTEX_SHADER;
  std::string file;
};

/// What a program is made of. Files carry no #version: "#version 450 core" and the defines come first.
struct ProgramSource {
  std::vector<ShaderStage> stages;
  std::vector<std::pair<std::string, std::string>> defines;
  /// Uniforms (or samplers) that the calling code will set: a missing one fails the build, unless the compiler removed
  /// it in a variant that names it in `optionalUniforms`.
  std::vector<std::string> uniforms;
};

/// The text that is compiled: includes pasted (each file once, "#include "name"" from the root), #line kept, with the
/// files that its source numbers stand for. Errors: a missing file, an include that names no file; with file and line.
struct ExpandedSource {
  std::string text;
  std::vector<std::string> files;
};
Result<ExpandedSource> expandSource(const ShaderLookup& lookup, const std::string& file,
                                    std::span<const std::pair<std::string, std::string>> defines);

void destroyProgram(GLuint name);

/// A linked program. set() writes a uniform of exactly that name; unknown names are a broken contract unless the name
/// was declared when the program was built and then removed by the compiler.
class Program {
 public:
  Program() = default;
  /// Errors hold the whole log, with the files' own names and line numbers.
  static Result<Program> build(const ShaderLookup& lookup, const ProgramSource& source);

  void use() const;
  bool has(const std::string& uniform) const { return m_locations.contains(uniform); }
  void set(const std::string& uniform, int value);
  void set(const std::string& uniform, unsigned value);
  void set(const std::string& uniform, float value);
  void set(const std::string& uniform, const glm::vec2& value);
  void set(const std::string& uniform, const glm::vec3& value);
  void set(const std::string& uniform, const glm::vec4& value);
  void set(const std::string& uniform, const glm::ivec2& value);
  void set(const std::string& uniform, std::span<const float> values);
  void set(const std::string& uniform, std::span<const unsigned> values);

 private:
  GLint location(const std::string& uniform) const;
  Handle<destroyProgram> m_handle;
  std::map<std::string, GLint> m_locations;  ///< -1: declared, but removed by the compiler
};

}  // namespace sward::gpu
