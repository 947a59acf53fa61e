#pragma once

#include "app/application.h"
#include "base/result.h"

#include <stop_token>

namespace sward::editor {

/// Opens the editor's window and runs it until it is closed, or `stop` is requested (the autosave then stays for the
/// next start). Errors: no display, no OpenGL that can draw a user interface.
Result<int> runWindow(const ApplicationOptions& options, const std::stop_token& stop);

}  // namespace sward::editor
