#pragma once

#include "common.h"

namespace sward::editor {

/// Each adds one command to the application and sets program.run when it is the one given.
void addEditCommand(CLI::App& app, Program& program);
void addRenderCommand(CLI::App& app, Program& program);
void addBakeCommand(CLI::App& app, Program& program);
void addReportCommand(CLI::App& app, Program& program);
void addExportCommand(CLI::App& app, Program& program);
void addNewCommand(CLI::App& app, Program& program);
void addCheckCommand(CLI::App& app, Program& program);
void addInfoCommand(CLI::App& app, Program& program);

}  // namespace sward::editor
