#include "choose.h"
#include "commands.h"
#include "methods.h"

#include "gpu/context.h"
#include "image/io.h"
#include "project/limits.h"
#include "project/nearest.h"
#include "render/frame_plan.h"
#include "render/renderer.h"

#include <charconv>
#include <cmath>
#include <sstream>

namespace sward::editor {
namespace {

namespace fs = std::filesystem;

struct RenderRequest {
  std::string project, output, view, size, sun, maxError, device = "auto";
  std::vector<std::string> methods;
  std::optional<int> samples;
  std::optional<double> weathering;
  double exposureEv = 0.0;
};

/// Two numbers parted by `separator`, nothing else around them.
template <typename T>
std::optional<std::pair<T, T>> twoNumbers(const std::string& text, char separator) {
  std::pair<T, T> numbers;
  const char* end = text.data() + text.size();
  const auto first = std::from_chars(text.data(), end, numbers.first);
  if (first.ec != std::errc{} || first.ptr == end || *first.ptr != separator) return std::nullopt;
  const auto second = std::from_chars(first.ptr + 1, end, numbers.second);
  if (second.ec != std::errc{} || second.ptr != end) return std::nullopt;
  return numbers;
}

Result<void> applySize(const std::string& text, project::Project& project) {
  if (text.empty()) return {};
  const auto size = twoNumbers<std::int64_t>(text, 'x');
  const std::string remedy = "Give WIDTHxHEIGHT in pixels, such as 1280x720: 1 to 16384 each.";
  if (!size) return Error::badInput("\"" + text + "\" is not a size", "--size", remedy);
  const auto [width, height] = *size;
  if (width < 1 || height < 1 || width > 16384 || height > 16384 || width * height > project::kMaxPixels) {
    return Error::badInput("a picture of " + text + " pixels cannot be drawn", "--size", remedy);
  }
  project.output.width = static_cast<int>(width);
  project.output.height = static_cast<int>(height);
  return {};
}

Result<void> applySun(const std::string& text, project::Project& project) {
  if (text.empty()) return {};
  const auto angles = twoNumbers<double>(text, ',');
  const std::string remedy = "Give AZIMUTH,ELEVATION in degrees, such as 225,35 (clockwise from north, up).";
  if (!angles || !std::isfinite(angles->first) || !std::isfinite(angles->second)) {
    return Error::badInput("\"" + text + "\" is not a sun position", "--sun", remedy);
  }
  if (std::abs(angles->first) > 360.0 || std::abs(angles->second) > 90.0) {
    return Error::badInput("the sun cannot stand at " + text + " degrees", "--sun", remedy);
  }
  const double azimuth = std::fmod(angles->first + 360.0, 360.0);
  project.sun.byMoment = false;
  project.sun.angles = {azimuth, angles->second};
  return {};
}

Result<scene::View> chooseView(const project::Project& project, const std::string& name) {
  if (name.empty()) {
    if (const scene::View* main = project.view("main")) return *main;
    return project.views.empty() ? scene::View{} : project.views.front();
  }
  if (const scene::View* view = project.view(name)) return *view;
  std::vector<std::string> names;
  std::string all;
  for (const scene::View& view : project.views) {
    names.push_back(view.name);
    all += (all.empty() ? "" : ", ") + view.name;
  }
  const std::string nearest = project::nearestName(name, names);
  return Error::badInput("there is no view \"" + name + "\"", "--view",
                         (nearest.empty() ? "" : "Did you mean \"" + nearest + "\"? ") +
                             (all.empty() ? "The project has no views." : "Views: " + all + "."));
}

Result<void> checkPicture(const fs::path& file) {
  if (!image::canWriteImage(file)) {
    return Error::badInput("\"" + file.extension().string() + "\" is not a kind of picture that can be written",
                           file.string(), "Use .png (sRGB, 8 bits) or .exr (linear).");
  }
  return checkOutputFile(file);
}

/// Everything a picture needs, settled before anything is baked.
struct RenderPlan {
  project::Project project;
  scene::View view;
  scene::Daylight daylight;
  render::Frame frame;
  std::shared_ptr<const terrain::HeightField> terrain;  ///< nothing: level ground
  fs::path output;
  bool linear = false;
};

Result<RenderPlan> planRender(const Program& program, const RenderRequest& request) {
  SWARD_ASSIGN(project::Project project, loadProject(program, request.project));
  SWARD_TRY(applyMethods(request.methods, project));
  SWARD_TRY(applySize(request.size, project));
  SWARD_TRY(applySun(request.sun, project));
  if (request.weathering) project.wither.weathering = *request.weathering;
  if (request.samples) project.render.samples = *request.samples;
  if (!request.maxError.empty()) {
    SWARD_ASSIGN(project.accuracy, report::parseAccuracy(request.maxError));
  }
  SWARD_TRY(checkProject(program, project));
  SWARD_TRY(checkPicture(request.output));
  SWARD_ASSIGN(const scene::View view, chooseView(project, request.view));
  SWARD_ASSIGN(const scene::Daylight daylight, render::daylightOf(project));
  SWARD_ASSIGN(const render::Frame frame, render::planFrame(project, view, daylight, request.exposureEv));
  SWARD_ASSIGN(const terrain::Terrain terrain, render::terrainOf(project));
  for (const std::string& warning : terrain.warnings) warn(program, "terrain: " + warning);
  std::string extension = fs::path(request.output).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return RenderPlan{std::move(project), view, daylight, frame, terrain.field, request.output, extension == ".exr"};
}

struct RenderTimes {
  double start = 0.0, bake = 0.0, upload = 0.0, draw = 0.0, write = 0.0;
};

Result<image::Image> drawPicture(Program& program, const RenderPlan& plan, gpu::Context& context,
                                 std::shared_ptr<const bake::GroundBake> ground, RenderTimes& times) {
  StopWatch watch;
  SWARD_ASSIGN(const auto renderer, render::Renderer::create(context));
  renderer->setStop(program.interrupts.token());
  SWARD_TRY(renderer->setGround(std::move(ground)));
  if (plan.terrain) SWARD_TRY(renderer->setTerrain(plan.terrain));
  times.upload = watch.lap();
  renderer->setDaylight(plan.daylight, plan.project.sky.hazeKm);
  if (program.interrupts.requested()) return Error::cancelled();
  SWARD_ASSIGN(image::Image picture,
               plan.linear ? renderer->drawLinear(plan.frame) : renderer->drawDisplay(plan.frame));
  times.draw = watch.lap();
  if (program.interrupts.requested()) return Error::cancelled();
  return picture;
}

Json resultJson(const RenderPlan& plan, const gpu::DeviceInfo& device, const RenderTimes& times,
                const bake::BakeReport& baked) {
  return {{"file", plan.output.string()},
          {"view", plan.view.name},
          {"width", plan.frame.width},
          {"height", plan.frame.height},
          {"exposure", plan.frame.exposure},
          {"device", device.api + ", " + device.renderer},
          {"seconds",
           {{"start", times.start},
            {"bake", times.bake},
            {"upload", times.upload},
            {"draw", times.draw},
            {"write", times.write}}},
          {"bake", bakeJson(baked)}};
}

Result<int> runRender(Program& program, const RenderRequest& request) {
  StopWatch watch;
  RenderTimes times;
  SWARD_ASSIGN(const gpu::Device device, gpu::deviceFromName(request.device));
  SWARD_ASSIGN(RenderPlan plan, planRender(program, request));
  SWARD_ASSIGN(const auto context, gpu::Context::create(device));
  SWARD_ASSIGN(const auto choice, chooseBake(program, plan.project, {plan.view}, *context));
  times.start = watch.lap();
  bake::BakeReport baked;
  std::shared_ptr<const bake::GroundBake> ground;
  {
    // The baker goes before the picture is drawn: its memory cache is of no more use.
    bake::Baker baker = openBaker(program);
    ProgressBar bar(program);
    SWARD_ASSIGN(ground, baker.ground(plan.project, bar.job(), &baked));
  }
  times.bake = watch.lap();
  for (const std::string& warning : baked.warnings) warn(program, warning);
  say(program, bakeText(baked));
  SWARD_ASSIGN(const image::Image picture, drawPicture(program, plan, *context, std::move(ground), times));
  watch.lap();
  {
    const auto writing = program.interrupts.writing();
    SWARD_TRY(plan.linear ? image::writeExr(plan.output, picture) : image::writePng(plan.output, picture));
  }
  times.write = watch.lap();
  say(program, "drew view \"" + plan.view.name + "\" on " + context->info().api + " (" + context->info().renderer +
                   "): relit, and " + std::to_string(plan.project.render.samples) + " samples, in " +
                   secondsText(times.draw));
  say(program, "wrote " + plan.output.string());
  if (program.common.json) {
    Json result = resultJson(plan, context->info(), times, baked);
    if (choice) result["choice"] = choiceJson(*choice);
    print(result);
  }
  return kDone;
}

}  // namespace

void addRenderCommand(CLI::App& app, Program& program) {
  CLI::App* command =
      addCommand(app, program, "render", "Draw one view of a project to a picture",
                 "Bakes what is missing, relights and draws. Nothing but the view is baked again when only the\n"
                 "sun, the view, the size or the way to draw changes.\n\n"
                 "Examples:\n"
                 "  sward render meadow.sward -o meadow.png --view low --size 1920x1080\n"
                 "  sward render meadow.sward -o noon.exr --sun 180,62 --spp 64 --exposure -0.5\n"
                 "  sward render meadow.sward -o cheap.png --view top --max-error rmse=0.12\n"
                 "  sward render meadow.sward -o paper.png --method blended_paper,lpt_paper --set tiles.seed=2");
  const auto request = std::make_shared<RenderRequest>();
  command->add_option("PROJECT", request->project, "The project, a .sward file")->required();
  command->add_option("-o,--output", request->output, "The picture: .png (sRGB) or .exr (linear)")
      ->required()
      ->type_name("FILE");
  command->add_option("--view", request->view, "A view of the project [main, else the first]")->type_name("NAME");
  command->add_option("--size", request->size, "Pixels, such as 1280x720 [the project's]")->type_name("WxH");
  command->add_option("--sun", request->sun, "Sun's azimuth and elevation in degrees, such as 225,35 [the project's]")
      ->type_name("AZ,EL");
  command->add_option("--method", request->methods, "How to draw and what to fit, one of each: " + methodNames())
      ->type_name("M")
      ->delimiter(',')
      ->allow_extra_args(false);
  command
      ->add_option("--max-error", request->maxError,
                   "Bake the cheapest that keeps this error in the view: rmse, psnr, ssim or flip, such as rmse=0.1")
      ->type_name("METRIC=BOUND");
  command
      ->add_option("--weathering", request->weathering,
                   "How far the autumn has gone, 0 (green) to 1 (straw) [the project's]")
      ->type_name("W")
      ->check(CLI::Range(0.0, 1.0));
  command->add_option("--device", request->device, "OpenGL: auto, egl or osmesa [auto]")->type_name("D");
  command->add_option("--spp", request->samples, "Samples a pixel [the project's]")
      ->type_name("N")
      ->check(CLI::Range(1, 4096));
  command->add_option("--exposure", request->exposureEv, "Stops added to the view's exposure [0]")
      ->type_name("EV")
      ->check(CLI::Range(-20.0, 20.0));
  command->callback(
      [&program, request] { program.run = [&program, request] { return runRender(program, *request); }; });
}

}  // namespace sward::editor
