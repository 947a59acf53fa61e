#pragma once

#include <span>
#include <string_view>

namespace sward::render {

struct ShaderFile {
  std::string_view name;  ///< relative to shaders/, such as "ground/march.frag"
  std::string_view text;
};
/// All files of shaders/, compiled in.
std::span<const ShaderFile> embeddedShaders();

}  // namespace sward::render
