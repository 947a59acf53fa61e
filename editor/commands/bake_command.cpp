#include "commands.h"

#include "choose.h"
#include "bake/memory_size.h"
#include "bake/withering.h"
#include "gpu/context.h"
#include "project/nearest.h"

namespace sward::editor {
namespace {

struct BakeRequest {
  std::string project, view, maxError, device = "auto";
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

/// Only a bound on the error needs to draw, and so a context.
Result<std::optional<report::Choice>> chooseFor(const Program& program, const BakeRequest& request,
                                                project::Project& project) {
  if (project.accuracy.metric == report::ErrorBound::None) return std::optional<report::Choice>();
  SWARD_ASSIGN(const gpu::Device device, gpu::deviceFromName(request.device));
  SWARD_ASSIGN(const auto context, gpu::Context::create(device));
  std::vector<scene::View> views = project.views;
  if (const scene::View* view = project.view(request.view)) views = {*view};
  return chooseBake(program, project, views, *context);
}

Result<int> runBake(Program& program, const BakeRequest& request) {
  SWARD_ASSIGN(project::Project project, loadProject(program, request.project));
  if (!request.maxError.empty()) {
    SWARD_ASSIGN(project.accuracy, report::parseAccuracy(request.maxError));
  }
  SWARD_TRY(checkProject(program, project));
  SWARD_TRY(checkView(project, request.view));
  SWARD_ASSIGN(const auto choice, chooseFor(program, request, project));
  bake::Baker baker = openBaker(program);
  bake::BakeReport report;
  std::uint64_t bytes = 0;
  {
    ProgressBar bar(program);
    SWARD_ASSIGN(const auto ground, baker.ground(project, bar.job(), &report));
    bytes = bake::memoryBytes(*ground);
  }
  for (const std::string& warning : report.warnings) warn(program, warning);
  say(program, bakeText(report) + "; the ground takes " + bytesText(bytes));
  // Texels are two results; the layers' graph has some hundred, which --json lists.
  if (bake::drawnAsTexels(project)) {
    for (const bake::NodeReport& node : report.nodes) say(program, nodeText(node));
  }
  if (program.common.json) {
    Json result = bakeJson(report);
    result["groundBytes"] = bytes;
    if (choice) result["choice"] = choiceJson(*choice);
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
                 "skipped because something made from it was there; with seconds and bytes. A project drawn as\n"
                 "texels has two: the blades at rest as points, and the texels of its weathering degree.\n\n"
                 "Examples:\n"
                 "  sward bake meadow.sward\n"
                 "  sward bake meadow.sward --json --set lights.count=24 > bake.json");
  const auto request = std::make_shared<BakeRequest>();
  command->add_option("PROJECT", request->project, "The project, a .sward file")->required();
  command->add_option("--for", request->view, "Only what this view needs")->type_name("VIEW");
  command
      ->add_option("--max-error", request->maxError,
                   "Bake the cheapest that keeps this error in the project's views (the first three), such as rmse=0.1")
      ->type_name("METRIC=BOUND");
  command->add_option("--device", request->device, "OpenGL for --max-error: auto, egl or osmesa [auto]")
      ->type_name("D");
  command->callback([&program, request] { program.run = [&program, request] { return runBake(program, *request); }; });
}

}  // namespace sward::editor
