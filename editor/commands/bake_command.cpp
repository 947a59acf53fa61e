#include "commands.h"

#include "project/nearest.h"

namespace sward::editor {
namespace {

struct BakeRequest {
  std::string project, view;
};

/// Every view draws the whole ground, so a view decides nothing yet but must exist.
Result<void> checkView(const project::Project& project, const std::string& name) {
  if (name.empty() || project.view(name) != nullptr) return {};
  std::vector<std::string> names;
  for (const scene::View& view : project.views) names.push_back(view.name);
  const std::string nearest = project::nearestName(name, names);
  return Error::badInput("there is no view \"" + name + "\"", "--for",
                         nearest.empty() ? "Choose a view of the project." : "Did you mean \"" + nearest + "\"?");
}

Result<int> runBake(Program& program, const BakeRequest& request) {
  SWARD_ASSIGN(const project::Project project, loadProject(program, request.project));
  SWARD_TRY(checkProject(program, project));
  SWARD_TRY(checkView(project, request.view));
  bake::Baker baker = openBaker(program);
  bake::BakeReport report;
  std::uint64_t bytes = 0;
  {
    ProgressBar bar(program);
    SWARD_ASSIGN(const auto ground, baker.ground(project, bar.job(), &report));
    bytes = ground->slices.totalBytes() + ground->soil.totalBytes();
    for (const auto& blade : ground->blades) bytes += blade.totalBytes();
  }
  for (const std::string& warning : report.warnings) warn(program, warning);
  say(program, bakeText(report) + "; the ground takes " + bytesText(bytes));
  if (program.common.json) {
    Json result = bakeJson(report);
    result["groundBytes"] = bytes;
    result["cache"] = cacheFolder(program).string();
    print(result);
  }
  return kDone;
}

}  // namespace

void addBakeCommand(CLI::App& app, Program& program) {
  CLI::App* command =
      addCommand(app, program, "bake", "Fill the cache, so that rendering only has to draw",
                 "With --json, stdout lists every node of the bake graph: baked, from memory or disk, or\n"
                 "skipped because something made from it was there; with seconds and bytes.\n\n"
                 "Examples:\n"
                 "  sward bake meadow.sward\n"
                 "  sward bake meadow.sward --json --set lights.count=24 > bake.json");
  const auto request = std::make_shared<BakeRequest>();
  command->add_option("PROJECT", request->project, "The project, a .sward file")->required();
  command->add_option("--for", request->view, "Only what this view needs")->type_name("VIEW");
  command->callback([&program, request] { program.run = [&program, request] { return runBake(program, *request); }; });
}

}  // namespace sward::editor
