#include "commands.h"

#include "project/nearest.h"

#include <cstdlib>
#include <exception>
#include <iostream>
#include <new>

namespace sward::editor {
namespace {

constexpr const char* kFooter =
    "Lengths are metres, angles degrees (azimuth clockwise from north, elevation up from the\n"
    "horizon), colours linear RGB.\n\n"
    "Examples:\n"
    "  sward                                     the editor, on a sample\n"
    "  sward edit field.sward\n"
    "  sward render projects/meadow.sward -o meadow.png\n"
    "  sward render projects/meadow.sward -o evening.png --sun 285,12\n"
    "  sward new field.sward --template meadow --grass my_grass.glb\n\n"
    "Exit codes: 0 done; 1 it failed; 2 the command or the project is wrong; 130 interrupted.\n"
    "`sward COMMAND --help` shows a command's options.\n";

std::vector<std::string> commandNames(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
  return names;
}

/// What CLI11 says, and where it helps, the command that may have been meant.
int wrongCommand(const CLI::App& app, const CLI::ParseError& problem, int argc, char** argv) {
  complain(problem.what());
  const std::vector<std::string> names = commandNames(app);
  const std::string first = argc > 1 ? argv[1] : "";
  const bool known = std::find(names.begin(), names.end(), first) != names.end();
  if (known) {
    complain("`sward " + first + " --help` shows its options.");
  } else {
    const std::string nearest = project::nearestName(first, names);
    complain((nearest.empty() ? "" : "Did you mean `sward " + nearest + "`? ") +
             std::string("`sward --help` lists the commands."));
  }
  return kWrongInput;
}

int reportError(const Program& program, const Error& error) {
  complain(error.text());
  if (program.common.json) print({{"error", toJson(error)}});
  return exitCodeOf(error);
}

int runProgram(int argc, char** argv, Interrupts& interrupts) {
  CLI::App app{"Sward bakes grassland from meshes and draws it under a moving sun.", "sward"};
  app.footer(kFooter);
  app.set_version_flag("--version", std::string("sward ") + SWARD_VERSION);
  app.require_subcommand(0, 1);
  std::vector<std::string> words(argv + std::min(argc, 1), argv + argc);
  words.insert(words.begin(), "sward");
  Program program{interrupts, {}, {}, {}};
  program.commandLine = shellText(words);
  addEditCommand(app, program);
  addRenderCommand(app, program);
  addBakeCommand(app, program);
  addNewCommand(app, program);
  addCheckCommand(app, program);
  addExportCommand(app, program);
  addReportCommand(app, program);
  addInfoCommand(app, program);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& problem) {
    if (problem.get_exit_code() == 0) return app.exit(problem);  // --help and --version
    return wrongCommand(app, problem, argc, argv);
  }
  const Result<int> code = program.run();
  if (interrupts.requested()) return reportError(program, Error::cancelled());
  return code.ok() ? *code : reportError(program, code.error());
}

int guarded(int argc, char** argv) {
  Interrupts interrupts;
  try {
    return runProgram(argc, argv, interrupts);
  } catch (const std::bad_alloc&) {
    complain("there is not enough memory. Use lower resolutions or a smaller patch.");
  } catch (const std::exception& problem) {
    complain(std::string("internal error: ") + problem.what());
  } catch (...) {
    complain("internal error of an unknown kind");
  }
  return kFailed;
}

}  // namespace
}  // namespace sward::editor

int main(int argc, char** argv) {
  return sward::editor::guarded(argc, argv);
}
