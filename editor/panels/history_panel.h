#pragma once

#include "panels/panel_context.h"

namespace sward::editor {

/// All steps of the document, oldest first; a click goes back or forward to one.
void drawHistory(PanelContext& context);

}  // namespace sward::editor
