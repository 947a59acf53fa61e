#pragma once

#include "common.h"

namespace sward::editor {

/// Each adds one command to the application and sets program.run when it is the one given; addEditCommand, called
/// first, sets it at once: the editor is also what runs when no command is given.
void addEditCommand(CLI::App& app, Program& program);
void addRenderCommand(CLI::App& app, Program& program);
void addBakeCommand(CLI::App& app, Program& program);
void addReportCommand(CLI::App& app, Program& program);
void addExportCommand(CLI::App& app, Program& program);
void addNewCommand(CLI::App& app, Program& program);
void addCheckCommand(CLI::App& app, Program& program);
void addInfoCommand(CLI::App& app, Program& program);

}  // namespace sward::editor
