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

struct Functions;

/// An OpenGL 4.5 core context, current on the thread that made it. All functions of gl.h work on the current context;
/// several contexts may live on one thread, one of them current.
class Context {
 public:
  /// Auto tries EGL, then OSMesa. Window is the editor's and made there. Errors say which was tried and why each
  /// failed.
  static Result<std::unique_ptr<Context>> create(Device device);
  Context();
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;
  virtual ~Context();

  /// Makes this the thread's current context; the one before is released first.
  Result<void> makeCurrent();
  const DeviceInfo& info() const { return m_info; }

  /// An error with the driver's own words when OpenGL has reported any since the last call; `where` names the work.
  Result<void> checkErrors(const std::string& where);

 protected:
  using Loader = void* (*)(const char*);
  /// Resolves every function of gl.h through `getProcAddress` and reads the info; an error when one is missing or the
  /// context is older than 4.5. The context must be bound.
  Result<void> loadFunctions(Loader getProcAddress, std::string api);
  /// Binds or releases the context of the window system. A derived destructor calls leave() before it destroys.
  virtual bool bind() = 0;
  virtual void unbind() = 0;
  void leave();

  DeviceInfo m_info;

 private:
  friend const Functions& gl();
  struct State;
  std::unique_ptr<State> m_state;
};

Result<Device> deviceFromName(const std::string& name);

}  // namespace sward::gpu
