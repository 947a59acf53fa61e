#include "app/ui_gl.h"

#include <algorithm>

#include <GL/gl.h>

namespace sward::editor {
namespace {

template <typename Function>
bool resolve(const GlLoader& loader, const char* name, Function*& function, std::string& missing) {
  function = reinterpret_cast<Function*>(loader(name));
  if (function == nullptr) missing += (missing.empty() ? "" : ", ") + std::string(name);
  return function != nullptr;
}

}  // namespace

Result<UiGl> UiGl::load(const GlLoader& loader) {
  UiGl ui;
  std::string missing;
  resolve(loader, "glGenTextures", ui.m_gl.genTextures, missing);
  resolve(loader, "glDeleteTextures", ui.m_gl.deleteTextures, missing);
  resolve(loader, "glBindTexture", ui.m_gl.bindTexture, missing);
  resolve(loader, "glTexImage2D", ui.m_gl.texImage2D, missing);
  resolve(loader, "glTexParameteri", ui.m_gl.texParameteri, missing);
  resolve(loader, "glPixelStorei", ui.m_gl.pixelStorei, missing);
  resolve(loader, "glViewport", ui.m_gl.viewport, missing);
  resolve(loader, "glClearColor", ui.m_gl.clearColor, missing);
  resolve(loader, "glClear", ui.m_gl.clear, missing);
  resolve(loader, "glReadPixels", ui.m_gl.readPixels, missing);
  resolve(loader, "glGetString", ui.m_gl.getString, missing);
  if (!missing.empty()) return Error::failed("the window's OpenGL lacks " + missing, "window", "Update the driver.");
  return ui;
}

std::uint64_t UiGl::upload(std::uint64_t texture, int width, int height, std::span<const std::uint8_t> rgba) const {
  auto name = static_cast<unsigned>(texture);
  if (name == 0) m_gl.genTextures(1, &name);
  m_gl.bindTexture(GL_TEXTURE_2D, name);
  m_gl.texParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  m_gl.texParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  m_gl.texParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  m_gl.texParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  m_gl.pixelStorei(GL_UNPACK_ALIGNMENT, 1);
  m_gl.texImage2D(GL_TEXTURE_2D, 0, GL_RGBA, width, height, 0, GL_RGBA, GL_UNSIGNED_BYTE, rgba.data());
  return name;
}

void UiGl::destroy(std::uint64_t texture) const {
  const auto name = static_cast<unsigned>(texture);
  if (name != 0) m_gl.deleteTextures(1, &name);
}

void UiGl::clear(int width, int height, float r, float g, float b) const {
  m_gl.viewport(0, 0, width, height);
  m_gl.clearColor(r, g, b, 1.0f);
  m_gl.clear(GL_COLOR_BUFFER_BIT);
}

std::vector<std::uint8_t> UiGl::read(int width, int height) const {
  const auto row = static_cast<std::size_t>(width) * 3;
  std::vector<std::uint8_t> out(row * static_cast<std::size_t>(height));
  m_gl.pixelStorei(GL_PACK_ALIGNMENT, 1);
  m_gl.readPixels(0, 0, width, height, GL_RGB, GL_UNSIGNED_BYTE, out.data());
  for (int y = 0; y < height / 2; ++y) {
    const auto top = out.begin() + static_cast<std::ptrdiff_t>(row) * y;
    const auto bottom = out.begin() + static_cast<std::ptrdiff_t>(row) * (height - 1 - y);
    std::swap_ranges(top, top + static_cast<std::ptrdiff_t>(row), bottom);
  }
  return out;
}

std::string UiGl::versionText() const {
  const auto* text = m_gl.getString(GL_VERSION);
  return text == nullptr ? std::string() : reinterpret_cast<const char*>(text);
}

}  // namespace sward::editor
