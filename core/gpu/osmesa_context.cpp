#include "gpu/contexts.h"

#include <dlfcn.h>

#include <array>
#include <cstdint>
#include <string>

namespace sward::gpu {
namespace {

// OSMesa's C interface (GL/osmesa.h includes the desktop gl.h, which clashes with glcorearb.h).
using OsMesaHandle = void*;
using CreateContextAttribs = OsMesaHandle (*)(const int* attributes, OsMesaHandle share);
using MakeCurrent = unsigned char (*)(OsMesaHandle, void* buffer, unsigned type, int width, int height);
using DestroyContext = void (*)(OsMesaHandle);
using GetProcAddress = void* (*)(const char*);
constexpr int kFormat = 0x22, kDepthBits = 0x30, kStencilBits = 0x31, kProfile = 0x33, kCoreProfile = 0x34,
              kMajor = 0x36, kMinor = 0x37, kRgba = 0x1908;
constexpr unsigned kUnsignedByte = 0x1401;

struct Library {
  void* handle = nullptr;
  CreateContextAttribs createContext = nullptr;
  MakeCurrent makeCurrent = nullptr;
  DestroyContext destroyContext = nullptr;
  GetProcAddress getProcAddress = nullptr;
};

template <typename F>
F symbol(void* handle, const char* name) {
  return reinterpret_cast<F>(dlsym(handle, name));
}

/// The library stays open for the life of the process: drivers do not survive being unloaded.
Result<Library> openLibrary() {
  constexpr std::array names{"libOSMesa.so.8", "libOSMesa.so.6", "libOSMesa.so"};
  Library library;
  std::string reasons;
  for (const char* name : names) {
    library.handle = dlopen(name, RTLD_NOW | RTLD_LOCAL);
    if (library.handle != nullptr) break;
    const char* reason = dlerror();
    reasons += (reasons.empty() ? "" : "; ") + std::string(reason == nullptr ? name : reason);
  }
  if (library.handle == nullptr) return Error::failed(reasons, "OSMesa", "Install libosmesa6.");
  library.createContext = symbol<CreateContextAttribs>(library.handle, "OSMesaCreateContextAttribs");
  library.makeCurrent = symbol<MakeCurrent>(library.handle, "OSMesaMakeCurrent");
  library.destroyContext = symbol<DestroyContext>(library.handle, "OSMesaDestroyContext");
  library.getProcAddress = symbol<GetProcAddress>(library.handle, "OSMesaGetProcAddress");
  if (library.createContext == nullptr || library.makeCurrent == nullptr || library.destroyContext == nullptr ||
      library.getProcAddress == nullptr)
    return Error::failed("libOSMesa is too old (no OSMesaCreateContextAttribs)", "OSMesa",
                         "Install libosmesa6 12.0 or newer.");
  return library;
}

class OsMesaContext final : public Context {
 public:
  ~OsMesaContext() override {
    leave();
    if (m_context != nullptr) m_library.destroyContext(m_context);
  }

  Result<void> open() {
    SWARD_ASSIGN(m_library, openLibrary());
    constexpr std::array attributes{kFormat, kRgba,  kDepthBits, 0, kStencilBits, 0, kProfile, kCoreProfile, kMajor,
                                    4,       kMinor, 5,          0};
    m_context = m_library.createContext(attributes.data(), nullptr);
    if (m_context == nullptr) return Error::failed("no OpenGL 4.5 core context", "OSMesa", "Install a newer Mesa.");
    SWARD_TRY(makeCurrent());
    return loadFunctions(m_library.getProcAddress, "OSMesa");
  }

 protected:
  bool bind() override { return m_library.makeCurrent(m_context, m_pixels.data(), kUnsignedByte, kSide, kSide) != 0; }
  void unbind() override {
    if (m_library.makeCurrent != nullptr) m_library.makeCurrent(nullptr, nullptr, kUnsignedByte, 0, 0);
  }

 private:
  static constexpr int kSide = 16;  ///< of the window buffer that OSMesa insists on; nothing is drawn into it
  Library m_library;
  OsMesaHandle m_context = nullptr;
  std::array<std::uint8_t, kSide * kSide * 4> m_pixels{};
};

}  // namespace

Result<std::unique_ptr<Context>> createOsMesaContext() {
  auto context = std::make_unique<OsMesaContext>();
  SWARD_TRY(context->open());
  return std::unique_ptr<Context>(std::move(context));
}

}  // namespace sward::gpu
