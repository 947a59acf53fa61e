#pragma once

#include "base/result.h"

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace sward::editor {

/// Address of an OpenGL function by its name.
using GlLoader = std::function<void*(const char* name)>;

/// The few functions of OpenGL 3 that showing pictures in the user interface needs, resolved through the loader of the
/// context that draws it. The interface so starts where the renderer (4.5) cannot, and can say so.
class UiGl {
 public:
  /// For the context that is current. Errors: a function is missing.
  static Result<UiGl> load(const GlLoader& loader);

  /// A texture of straight RGBA bytes, rows from the top, linear filtering; 0 makes a new one. Returns its name.
  std::uint64_t upload(std::uint64_t texture, int width, int height, std::span<const std::uint8_t> rgba) const;
  void destroy(std::uint64_t texture) const;
  /// Clears the bound framebuffer to a colour (display values).
  void clear(int width, int height, float r, float g, float b) const;
  /// The bound framebuffer's RGB bytes, rows from the top.
  std::vector<std::uint8_t> read(int width, int height) const;
  std::string versionText() const;

 private:
  struct Functions {
    void (*genTextures)(int, unsigned*);
    void (*deleteTextures)(int, const unsigned*);
    void (*bindTexture)(unsigned, unsigned);
    void (*texImage2D)(unsigned, int, int, int, int, int, unsigned, unsigned, const void*);
    void (*texParameteri)(unsigned, unsigned, int);
    void (*pixelStorei)(unsigned, int);
    void (*viewport)(int, int, int, int);
    void (*clearColor)(float, float, float, float);
    void (*clear)(unsigned);
    void (*readPixels)(int, int, int, int, unsigned, unsigned, void*);
    const unsigned char* (*getString)(unsigned);
  } m_gl{};
};

}  // namespace sward::editor
