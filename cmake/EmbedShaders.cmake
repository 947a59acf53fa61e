# Writes ${OUT}: a table of every shader file, as raw string literals. Run by sward_embed_shaders.
set(text "// Generated from shaders/ by cmake/EmbedShaders.cmake.\n#include \"render/shader_files.h\"\nnamespace sward::render {\n")
string(APPEND text "std::span<const ShaderFile> embeddedShaders() {\n  static const ShaderFile files[] = {\n")
foreach(file IN LISTS FILES)
  file(READ ${ROOT}/${file} body)
  string(APPEND text "    {\"${file}\", R\"sward_glsl(${body})sward_glsl\"},\n")
endforeach()
string(APPEND text "  };\n  return files;\n}\n}  // namespace sward::render\n")
file(WRITE ${OUT} "${text}")
