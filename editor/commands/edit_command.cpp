#include "commands.h"

#include "app/window.h"

namespace sward::editor {
namespace {

struct EditRequest {
  std::string project, device, itemLog;
};

Result<int> runEdit(Program& program, const EditRequest& request) {
  ApplicationOptions options;
  if (!request.project.empty()) options.project = request.project;
  options.overrides = program.common.overrides;
  options.cacheFolder = cacheFolder(program);
  options.threads = program.common.threads;
  options.itemLog = request.itemLog;
  options.version = SWARD_VERSION;
  if (!request.device.empty()) {
    SWARD_ASSIGN(options.device, gpu::deviceFromName(request.device));
  }
  return runWindow(options, program.interrupts.token());
}

}  // namespace

void addEditCommand(CLI::App& app, Program& program) {
  CLI::App* command =
      addCommand(app, program, "edit", "Author a grassland in a window, live",
                 "Without a project it opens the sample meadow. Edits are baked while you work; nothing\n"
                 "is written but what you save (and a copy for recovery after a crash).\n\n"
                 "Examples:\n"
                 "  sward edit meadow.sward\n"
                 "  sward edit --device osmesa");
  const auto request = std::make_shared<EditRequest>();
  command->add_option("PROJECT", request->project, "The project, a .sward file");
  command
      ->add_option("--device", request->device,
                   "OpenGL that draws the viewport: auto, egl or osmesa [the preferences']")
      ->type_name("D");
  command
      ->add_option("--item-log", request->itemLog,
                   "Write the names and places of all items of the window to this file, for tests")
      ->type_name("FILE")
      ->group("For tests");
  // What runs when no command is given, too.
  const auto run = [&program, request] { return runEdit(program, *request); };
  program.run = run;
  command->callback([&program, run] { program.run = run; });
}

}  // namespace sward::editor
