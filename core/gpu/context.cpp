#include "gpu/context.h"

#include "gpu/contexts.h"
#include "gpu/gl.h"

#include "base/check.h"

#include <array>
#include <cstdlib>

namespace sward::gpu {
namespace {

thread_local Context* currentContext = nullptr;

std::string textOf(const GLubyte* text) {
  return text == nullptr ? std::string() : std::string(reinterpret_cast<const char*>(text));
}

/// "4.5 (Core Profile) Mesa" -> 45; 0 when there is no number.
int versionNumber(const std::string& version) {
  const std::size_t dot = version.find('.');
  if (dot == std::string::npos || dot == 0) return 0;
  return std::atoi(version.c_str()) * 10 + std::atoi(version.c_str() + dot + 1);
}

const char* errorName(GLenum error) {
  switch (error) {
    case GL_INVALID_ENUM:
      return "GL_INVALID_ENUM";
    case GL_INVALID_VALUE:
      return "GL_INVALID_VALUE";
    case GL_INVALID_OPERATION:
      return "GL_INVALID_OPERATION";
    case GL_INVALID_FRAMEBUFFER_OPERATION:
      return "GL_INVALID_FRAMEBUFFER_OPERATION";
    case GL_OUT_OF_MEMORY:
      return "GL_OUT_OF_MEMORY";
    default:
      return "an unknown OpenGL error";
  }
}

void APIENTRY keepMessage(GLenum, GLenum type, GLuint, GLenum, GLsizei length, const GLchar* text, const void* user) {
  if (type != GL_DEBUG_TYPE_ERROR && type != GL_DEBUG_TYPE_UNDEFINED_BEHAVIOR) return;
  auto& message = *static_cast<std::string*>(const_cast<void*>(user));
  message.assign(text, length < 0 ? std::char_traits<char>::length(text) : static_cast<std::size_t>(length));
}

}  // namespace

struct Context::State {
  Functions functions;
  std::string lastMessage;  ///< newest error of the debug output
};

const Functions& gl() {
  SWARD_CHECK(currentContext != nullptr);
  return currentContext->m_state->functions;
}

Context::Context() : m_state(std::make_unique<State>()) {}

Context::~Context() {
  if (currentContext == this) currentContext = nullptr;
}

Result<void> Context::makeCurrent() {
  if (currentContext == this) return {};
  // Two software contexts may share one dispatch table of Mesa: the old one has to let go before the new one binds.
  if (currentContext != nullptr) currentContext->leave();
  if (!bind()) return Error::failed("the OpenGL context could not be made current", m_info.api);
  currentContext = this;
  return {};
}

void Context::leave() {
  unbind();
  if (currentContext == this) currentContext = nullptr;
}

Result<void> Context::loadFunctions(Loader getProcAddress, std::string api) {
  m_info.api = std::move(api);
  const auto getString = reinterpret_cast<PFNGLGETSTRINGPROC>(getProcAddress("glGetString"));
  if (getString == nullptr) return Error::failed("the OpenGL loader knows no glGetString", m_info.api);
  m_info.vendor = textOf(getString(GL_VENDOR));
  m_info.renderer = textOf(getString(GL_RENDERER));
  m_info.version = textOf(getString(GL_VERSION));
  for (const char* name : {"llvmpipe", "softpipe", "swrast", "Software Rasterizer"})
    if (m_info.renderer.find(name) != std::string::npos) m_info.software = true;
  if (versionNumber(m_info.version) < 45)
    return Error::failed("OpenGL 4.5 is needed, the driver offers " + m_info.version + " (" + m_info.renderer + ")",
                         m_info.api, "Choose another --device, such as osmesa.");
#define SWARD_GL_LOAD(type, name)                                                            \
  m_state->functions.name = reinterpret_cast<PFNGL##type##PROC>(getProcAddress("gl" #name)); \
  if (m_state->functions.name == nullptr)                                                    \
    return Error::failed("the driver claims OpenGL 4.5 but has no gl" #name, m_info.api, "Choose another --device.");
  SWARD_GL_FUNCTIONS(SWARD_GL_LOAD)
#undef SWARD_GL_LOAD
  m_state->functions.Enable(GL_DEBUG_OUTPUT);
  m_state->functions.DebugMessageCallback(keepMessage, &m_state->lastMessage);
  return {};
}

Result<void> Context::checkErrors(const std::string& where) {
  GLenum first = GL_NO_ERROR;
  // A lost context repeats its error for ever; sixteen are more than there are kinds.
  for (int i = 0; i < 16; ++i) {
    const GLenum error = m_state->functions.GetError();
    if (error == GL_NO_ERROR) break;
    if (first == GL_NO_ERROR) first = error;
  }
  if (first == GL_NO_ERROR) return {};
  std::string what = errorName(first);
  if (!m_state->lastMessage.empty()) what += ": " + m_state->lastMessage;
  m_state->lastMessage.clear();
  return Error::failed(what, where,
                       first == GL_OUT_OF_MEMORY ? "Make the picture, the tile set or the map smaller." : "");
}

Result<std::unique_ptr<Context>> Context::create(Device device) {
  switch (device) {
    case Device::Egl:
      return createEglContext();
    case Device::OsMesa:
      return createOsMesaContext();
    case Device::Window:
      return Error::failed("a window's context is made by the editor", "device", "Use auto, egl or osmesa here.");
    case Device::Auto:
      break;
  }
  auto egl = createEglContext();
  if (egl.ok()) return egl;
  auto osMesa = createOsMesaContext();
  if (osMesa.ok()) return osMesa;
  return Error::failed("no OpenGL 4.5 context: " + egl.error().text() + "; " + osMesa.error().text(), "device",
                       "Install Mesa (libegl1, libosmesa6).");
}

Result<Device> deviceFromName(const std::string& name) {
  if (name == "auto") return Device::Auto;
  if (name == "window") return Device::Window;
  if (name == "egl") return Device::Egl;
  if (name == "osmesa") return Device::OsMesa;
  return Error::badInput("unknown device \"" + name + "\"", "--device", "Use auto, window, egl or osmesa.");
}

}  // namespace sward::gpu
