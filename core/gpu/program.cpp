#include "gpu/program.h"

#include "base/check.h"

#include <algorithm>
#include <cctype>
#include <set>

namespace sward::gpu {
namespace {

/// Pastes includes into one text.
class Expander {
 public:
  explicit Expander(const ShaderLookup& lookup) : m_lookup(lookup) {}

  Result<void> add(const std::string& file, const std::string& includedFrom) {
    const auto text = m_lookup(file);
    if (!text) return Error::failed("there is no shader file \"" + file + "\"", includedFrom);
    if (!m_seen.insert(file).second) return {};
    const std::size_t number = m_out.files.size();
    m_out.files.push_back(file);
    lineMark(1, number);
    return addLines(*text, file, number);
  }

  ExpandedSource m_out;

 private:
  void lineMark(std::size_t line, std::size_t file) {
    m_out.text += "#line " + std::to_string(line) + ' ' + std::to_string(file) + '\n';
  }

  Result<void> addLines(std::string_view text, const std::string& file, std::size_t number) {
    std::size_t lineNumber = 0;
    while (!text.empty()) {
      ++lineNumber;
      const std::size_t end = std::min(text.find('\n'), text.size());
      const std::string_view line = text.substr(0, end);
      text.remove_prefix(std::min(end + 1, text.size()));
      if (!line.starts_with("#include")) {
        m_out.text.append(line).push_back('\n');
        continue;
      }
      const std::string where = file + ":" + std::to_string(lineNumber);
      const std::size_t open = line.find('"');
      const std::size_t close = line.rfind('"');
      if (open == std::string_view::npos || close <= open + 1)
        return Error::failed("#include names no file", where, "Write #include \"folder/file.glsl\".");
      SWARD_TRY(add(std::string(line.substr(open + 1, close - open - 1)), where));
      lineMark(lineNumber + 1, number);
    }
    return {};
  }

  const ShaderLookup& m_lookup;
  std::set<std::string> m_seen;
};

/// Replaces the source numbers that start a log's lines ("0:12(5): error") by file names.
std::string readableLog(const std::string& log, const std::vector<std::string>& files) {
  std::string out;
  std::size_t at = 0;
  while (at < log.size()) {
    const std::size_t end = std::min(log.find('\n', at), log.size());
    const std::string line = log.substr(at, end - at);
    std::size_t digits = 0;
    while (digits < line.size() && std::isdigit(static_cast<unsigned char>(line[digits])) != 0) ++digits;
    const bool numbered =
        digits > 0 && digits < 6 && digits < line.size() && (line[digits] == ':' || line[digits] == '(');
    const std::size_t file = numbered ? std::stoul(line.substr(0, digits)) : files.size();
    out += file < files.size() ? files[file] + line.substr(digits) : line;
    out += '\n';
    at = end + 1;
  }
  while (!out.empty() && (out.back() == '\n' || out.back() == '\0')) out.pop_back();
  return out;
}

std::string shaderLog(GLuint shader) {
  GLint length = 0;
  gl().GetShaderiv(shader, GL_INFO_LOG_LENGTH, &length);
  std::string log(static_cast<std::size_t>(std::max(length, 1)), '\0');
  gl().GetShaderInfoLog(shader, length, nullptr, log.data());
  return log.substr(0, log.find('\0'));
}

std::string programLog(GLuint program) {
  GLint length = 0;
  gl().GetProgramiv(program, GL_INFO_LOG_LENGTH, &length);
  std::string log(static_cast<std::size_t>(std::max(length, 1)), '\0');
  gl().GetProgramInfoLog(program, length, nullptr, log.data());
  return log.substr(0, log.find('\0'));
}

void destroyShader(GLuint name) {
  gl().DeleteShader(name);
}

Result<void> attach(GLuint program, const ShaderLookup& lookup, const ShaderStage& stage, const ProgramSource& source) {
  SWARD_ASSIGN(const ExpandedSource expanded, expandSource(lookup, stage.file, source.defines));
  const Handle<destroyShader> shader(gl().CreateShader(stage.type));
  const char* text = expanded.text.c_str();
  gl().ShaderSource(shader.name(), 1, &text, nullptr);
  gl().CompileShader(shader.name());
  GLint compiled = GL_FALSE;
  gl().GetShaderiv(shader.name(), GL_COMPILE_STATUS, &compiled);
  if (compiled == GL_FALSE)
    return Error::failed("the shader does not compile:\n" + readableLog(shaderLog(shader.name()), expanded.files),
                         stage.file);
  gl().AttachShader(program, shader.name());
  return {};
}

std::set<std::string> activeUniforms(GLuint program) {
  GLint count = 0;
  gl().GetProgramiv(program, GL_ACTIVE_UNIFORMS, &count);
  std::set<std::string> names;
  for (GLint i = 0; i < count; ++i) {
    char name[256] = {};
    GLint size = 0;
    GLenum type = 0;
    gl().GetActiveUniform(program, static_cast<GLuint>(i), sizeof(name), nullptr, &size, &type, name);
    const std::string text(name);
    names.insert(text.substr(0, text.find('[')));
  }
  return names;
}

}  // namespace

void destroyProgram(GLuint name) {
  gl().DeleteProgram(name);
}

Result<ExpandedSource> expandSource(const ShaderLookup& lookup, const std::string& file,
                                    std::span<const std::pair<std::string, std::string>> defines) {
  Expander expander(lookup);
  expander.m_out.text = "#version 450 core\n";
  for (const auto& [name, value] : defines) expander.m_out.text += "#define " + name + ' ' + value + '\n';
  SWARD_TRY(expander.add(file, "program"));
  return std::move(expander.m_out);
}

Result<Program> Program::build(const ShaderLookup& lookup, const ProgramSource& source) {
  Program program;
  program.m_handle = Handle<destroyProgram>(gl().CreateProgram());
  const GLuint name = program.m_handle.name();
  std::string files;
  for (const ShaderStage& stage : source.stages) {
    files += (files.empty() ? "" : " + ") + stage.file;
    SWARD_TRY(attach(name, lookup, stage, source));
  }
  gl().LinkProgram(name);
  GLint linked = GL_FALSE;
  gl().GetProgramiv(name, GL_LINK_STATUS, &linked);
  if (linked == GL_FALSE) return Error::failed("the shaders do not link:\n" + programLog(name), files);
  const auto active = activeUniforms(name);
  for (const std::string& uniform : active)
    program.m_locations[uniform] = gl().GetUniformLocation(name, uniform.c_str());
  for (const std::string& uniform : source.uniforms)
    if (!active.contains(uniform))
      return Error::failed("the program has no active uniform " + uniform, files, "Declare and use it in the shader.");
  return program;
}

void Program::use() const {
  gl().UseProgram(m_handle.name());
}

GLint Program::location(const std::string& uniform) const {
  const auto found = m_locations.find(uniform);
  if (found == m_locations.end()) base::failCheck("uniform exists", uniform, "no such uniform", __FILE__, __LINE__);
  return found->second;
}

void Program::set(const std::string& uniform, int value) {
  gl().ProgramUniform1i(m_handle.name(), location(uniform), value);
}
void Program::set(const std::string& uniform, unsigned value) {
  gl().ProgramUniform1ui(m_handle.name(), location(uniform), value);
}
void Program::set(const std::string& uniform, float value) {
  gl().ProgramUniform1f(m_handle.name(), location(uniform), value);
}
void Program::set(const std::string& uniform, const glm::vec2& value) {
  gl().ProgramUniform2fv(m_handle.name(), location(uniform), 1, &value.x);
}
void Program::set(const std::string& uniform, const glm::vec3& value) {
  gl().ProgramUniform3fv(m_handle.name(), location(uniform), 1, &value.x);
}
void Program::set(const std::string& uniform, const glm::vec4& value) {
  gl().ProgramUniform4fv(m_handle.name(), location(uniform), 1, &value.x);
}
void Program::set(const std::string& uniform, const glm::ivec2& value) {
  gl().ProgramUniform2iv(m_handle.name(), location(uniform), 1, &value.x);
}
void Program::set(const std::string& uniform, std::span<const float> values) {
  gl().ProgramUniform1fv(m_handle.name(), location(uniform), static_cast<GLsizei>(values.size()), values.data());
}
void Program::set(const std::string& uniform, std::span<const unsigned> values) {
  gl().ProgramUniform1uiv(m_handle.name(), location(uniform), static_cast<GLsizei>(values.size()), values.data());
}

}  // namespace sward::gpu
