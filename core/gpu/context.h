#pragma once

#include "base/result.h"

#include <memory>
#include <string>

namespace sward::gpu {

enum class Device { Auto, Window, Egl, OsMesa };

struct DeviceInfo {
  std::string api;  ///< "EGL", "OSMesa", "window"
  std::string vendor, renderer, version;
  bool software = false;  ///< llvmpipe, softpipe or swrast
};

/// An OpenGL 4.5 core context, current on the thread that made it. All functions of gl.h work on the current context.
class Context {
 public:
  /// Auto tries EGL, then OSMesa. Window is the editor's and made there. Errors say which was tried and why each
  /// failed.
  static Result<std::unique_ptr<Context>> create(Device device);
  virtual ~Context() = default;

  virtual void makeCurrent() = 0;
  const DeviceInfo& info() const { return m_info; }

 protected:
  /// Resolves every function of gl.h through `getProcAddress` and reads the info; an error when one is missing or the
  /// context is older than 4.5.
  Result<void> loadFunctions(void* (*getProcAddress)(const char*), std::string api);
  DeviceInfo m_info;
};

Result<Device> deviceFromName(const std::string& name);

}  // namespace sward::gpu
