#include "gpu/contexts.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <array>
#include <cstring>
#include <string>
#include <vector>

namespace sward::gpu {
namespace {

void* loadProc(const char* name) {
  return reinterpret_cast<void*>(eglGetProcAddress(name));
}

bool hasExtension(const char* list, const char* name) {
  if (list == nullptr) return false;
  const std::size_t length = std::strlen(name);
  for (const char* at = std::strstr(list, name); at != nullptr; at = std::strstr(at + length, name)) {
    const bool starts = at == list || at[-1] == ' ';
    const bool ends = at[length] == ' ' || at[length] == '\0';
    if (starts && ends) return true;
  }
  return false;
}

struct Platform {
  std::string name;
  EGLenum platform = 0;
  void* native = nullptr;
};

/// Where a display may come from, best first.
std::vector<Platform> platforms() {
  std::vector<Platform> hardware, software;
  const char* client = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
  const auto queryDevices = reinterpret_cast<PFNEGLQUERYDEVICESEXTPROC>(eglGetProcAddress("eglQueryDevicesEXT"));
  const auto queryString =
      reinterpret_cast<PFNEGLQUERYDEVICESTRINGEXTPROC>(eglGetProcAddress("eglQueryDeviceStringEXT"));
  if (hasExtension(client, "EGL_EXT_platform_device") && queryDevices != nullptr && queryString != nullptr) {
    std::array<EGLDeviceEXT, 16> devices{};
    EGLint count = 0;
    if (queryDevices(static_cast<EGLint>(devices.size()), devices.data(), &count) == EGL_FALSE) count = 0;
    for (EGLint i = 0; i < count; ++i) {
      const EGLDeviceEXT device = devices[static_cast<std::size_t>(i)];
      const bool soft = hasExtension(queryString(device, EGL_EXTENSIONS), "EGL_MESA_device_software");
      (soft ? software : hardware).push_back({"device " + std::to_string(i), EGL_PLATFORM_DEVICE_EXT, device});
    }
  }
  if (hasExtension(client, "EGL_MESA_platform_surfaceless"))
    hardware.push_back({"surfaceless", EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY});
  hardware.insert(hardware.end(), software.begin(), software.end());
  return hardware;
}

class EglContext final : public Context {
 public:
  ~EglContext() override {
    leave();
    if (m_context != EGL_NO_CONTEXT) eglDestroyContext(m_display, m_context);
  }

  Result<void> open(const Platform& platform) {
    const auto getDisplay =
        reinterpret_cast<PFNEGLGETPLATFORMDISPLAYEXTPROC>(eglGetProcAddress("eglGetPlatformDisplayEXT"));
    if (getDisplay == nullptr) return Error::failed("EGL has no platform displays", "EGL");
    m_display = getDisplay(platform.platform, platform.native, nullptr);
    if (m_display == EGL_NO_DISPLAY || eglInitialize(m_display, nullptr, nullptr) == EGL_FALSE)
      return Error::failed("EGL display does not start", "EGL " + platform.name);
    if (!hasExtension(eglQueryString(m_display, EGL_EXTENSIONS), "EGL_KHR_surfaceless_context"))
      return Error::failed("EGL cannot draw without a surface", "EGL " + platform.name);
    if (eglBindAPI(EGL_OPENGL_API) == EGL_FALSE)
      return Error::failed("EGL offers no desktop OpenGL", "EGL " + platform.name);
    constexpr std::array<EGLint, 7> attributes{
        EGL_CONTEXT_MAJOR_VERSION,           4,       EGL_CONTEXT_MINOR_VERSION, 5, EGL_CONTEXT_OPENGL_PROFILE_MASK,
        EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
    m_context = eglCreateContext(m_display, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes.data());
    if (m_context == EGL_NO_CONTEXT) return Error::failed("no OpenGL 4.5 core context", "EGL " + platform.name);
    SWARD_TRY(makeCurrent());
    return loadFunctions(loadProc, "EGL");
  }

 protected:
  bool bind() override {
    eglBindAPI(EGL_OPENGL_API);
    return eglMakeCurrent(m_display, EGL_NO_SURFACE, EGL_NO_SURFACE, m_context) == EGL_TRUE;
  }
  void unbind() override {
    // Displays are the process's, not ours: they are never terminated, another context may use the same one.
    if (m_display != EGL_NO_DISPLAY) eglMakeCurrent(m_display, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
  }

 private:
  EGLDisplay m_display = EGL_NO_DISPLAY;
  EGLContext m_context = EGL_NO_CONTEXT;
};

}  // namespace

Result<std::unique_ptr<Context>> createEglContext() {
  std::string reasons;
  for (const Platform& platform : platforms()) {
    auto context = std::make_unique<EglContext>();
    const auto opened = context->open(platform);
    if (opened.ok()) return std::unique_ptr<Context>(std::move(context));
    reasons += (reasons.empty() ? "" : "; ") + opened.error().text();
  }
  return Error::failed(reasons.empty() ? "EGL has no platform without a display" : reasons, "EGL",
                       "Use --device osmesa, or install libegl1 and a driver.");
}

}  // namespace sward::gpu
