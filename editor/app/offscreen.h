#pragma once

#include "app/application.h"
#include "gpu/context.h"
#include "image/image.h"

#include <memory>

namespace sward::editor {

/// The whole editor without a window or a display: drawn by an EGL context, fed with events by its caller. Measures the
/// interface, and takes pictures of it. One at a time in a process, on one thread.
class OffscreenEditor {
 public:
  /// Errors: no EGL context.
  static Result<std::unique_ptr<OffscreenEditor>> create(const ApplicationOptions& options, int width, int height,
                                                         float scale = 1.0f);
  ~OffscreenEditor();
  OffscreenEditor(const OffscreenEditor&) = delete;
  OffscreenEditor& operator=(const OffscreenEditor&) = delete;

  /// One frame as the window's loop makes it: takes what the services have, draws, finishes; returns its milliseconds.
  double frame();
  /// Frames until the newest ground and picture of the project are on screen, or `seconds` passed; false then.
  bool settle(double seconds);
  void moveMouse(float x, float y);
  void mouseButton(int button, bool down);
  /// The window as it was last drawn, sRGB in [0, 1].
  image::Image picture() const;
  Application& application();

 private:
  OffscreenEditor();
  struct Impl;
  std::unique_ptr<Impl> m_impl;
};

}  // namespace sward::editor
