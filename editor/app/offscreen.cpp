#include "app/offscreen.h"

#include "widgets/theme.h"

#include "gpu/gl.h"
#include "gpu/objects.h"

#include <atomic>
#include <chrono>
#include <thread>

#include <EGL/egl.h>
#include <imgui.h>
#include <imgui_impl_opengl3.h>

namespace sward::editor {
namespace {

constexpr double kFrameSeconds = 1.0 / 60.0;

double secondsNow() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace

struct OffscreenEditor::Impl {
  std::unique_ptr<gpu::Context> context;
  UiGl gl;
  gpu::Texture target;
  gpu::Framebuffer framebuffer;
  ImGuiContext* imgui = nullptr;
  std::unique_ptr<Application> application;
  int width = 0, height = 0;
  float scale = 1.0f;
  double last = 0.0;

  ~Impl() {
    if (context) (void)context->makeCurrent();
    application.reset();
    if (imgui != nullptr) {
      ImGui_ImplOpenGL3_Shutdown();
      ImGui::DestroyContext(imgui);
    }
  }

  Result<void> open(const ApplicationOptions& options) {
    SWARD_ASSIGN(context, gpu::Context::create(gpu::Device::Egl));
    SWARD_TRY(context->makeCurrent());
    SWARD_ASSIGN(gl, UiGl::load([](const char* name) { return reinterpret_cast<void*>(eglGetProcAddress(name)); }));
    target = gpu::Texture::make2d(GL_RGBA8, width, height);
    framebuffer = gpu::Framebuffer(target);
    imgui = ImGui::CreateContext();
    ImGui::GetIO().IniFilename = nullptr;
    ImGui::GetIO().DisplaySize = {static_cast<float>(width), static_cast<float>(height)};
    if (!ImGui_ImplOpenGL3_Init("#version 330 core")) return Error::failed("ImGui cannot draw through EGL", "editor");
    application = std::make_unique<Application>(options, LoadedPreferences{}, gl, [] {});
    return {};
  }

  double frame() {
    const double start = secondsNow();
    (void)context->makeCurrent();
    application->poll(start);
    application->refreshStyle(scale);
    ImGui::GetIO().DeltaTime = last > 0.0 ? static_cast<float>(std::max(start - last, 1e-3)) : 0.016f;
    last = start;
    framebuffer.bind();
    ImGui_ImplOpenGL3_NewFrame();
    ImGui::NewFrame();
    application->frame(start, width, height);
    ImGui::Render();
    framebuffer.bind();
    const ImVec4 back = ImGui::ColorConvertU32ToFloat4(theme().colours.backdrop);
    gl.clear(width, height, back.x, back.y, back.z);
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
    gpu::gl().Finish();
    const double milliseconds = (secondsNow() - start) * 1000.0;
    application->frameShown(milliseconds);
    return milliseconds;
  }
};

OffscreenEditor::OffscreenEditor() : m_impl(std::make_unique<Impl>()) {}
OffscreenEditor::~OffscreenEditor() = default;

Result<std::unique_ptr<OffscreenEditor>> OffscreenEditor::create(const ApplicationOptions& options, int width,
                                                                 int height, float scale) {
  std::unique_ptr<OffscreenEditor> editor(new OffscreenEditor());
  editor->m_impl->width = width;
  editor->m_impl->height = height;
  editor->m_impl->scale = scale;
  SWARD_TRY(editor->m_impl->open(options));
  return editor;
}

double OffscreenEditor::frame() {
  return m_impl->frame();
}

bool OffscreenEditor::settle(double seconds) {
  const double end = secondsNow() + seconds;
  do {
    m_impl->frame();
    if (m_impl->application->live().settled()) return true;
    std::this_thread::sleep_for(std::chrono::duration<double>(kFrameSeconds));
  } while (secondsNow() < end);
  return false;
}

void OffscreenEditor::moveMouse(float x, float y) {
  ImGui::GetIO().MousePos = {x, y};
}

void OffscreenEditor::mouseButton(int button, bool down) {
  ImGui::GetIO().MouseDown[button] = down;
}

image::Image OffscreenEditor::picture() const {
  m_impl->framebuffer.bind();
  const auto bytes = m_impl->gl.read(m_impl->width, m_impl->height);
  image::Image out(m_impl->width, m_impl->height, 3);
  for (std::size_t i = 0; i < bytes.size(); ++i) out.pixels[i] = static_cast<float>(bytes[i]) / 255.0f;
  return out;
}

Application& OffscreenEditor::application() {
  return *m_impl->application;
}

}  // namespace sward::editor
