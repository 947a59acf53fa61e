#include "choose.h"
#include "commands.h"
#include "methods.h"
#include "render_plan.h"

#include "export/frame_files.h"
#include "gpu/context.h"
#include "render/frame_plan.h"

namespace sward::editor {
namespace {

namespace fs = std::filesystem;

/// Everything a picture needs, settled before anything is baked.
struct RenderPlan {
  project::Project project;
  scene::View view;
  scene::Daylight daylight;
  render::Frame frame;
  std::shared_ptr<const terrain::HeightField> terrain;  ///< nothing: level ground
  fs::path output;
};

Result<RenderPlan> planRender(const Program& program, const RenderRequest& request) {
  SWARD_ASSIGN(project::Project project, requestedProject(program, request));
  if (exporting::FramePattern::isOne(request.output)) {
    return Error::badInput("the name is one of a sequence's frames", request.output,
                           "Add --frames FIRST:LAST, or give the picture another name.");
  }
  SWARD_TRY(checkPicture(request.output));
  SWARD_ASSIGN(const scene::View view, chooseView(project, request.view));
  SWARD_ASSIGN(const scene::Daylight daylight, render::daylightOf(project));
  SWARD_ASSIGN(const render::Frame frame, render::planFrame(project, view, daylight, request.exposureEv));
  SWARD_ASSIGN(auto terrain, requestedTerrain(program, project));
  return RenderPlan{std::move(project), view, daylight, frame, std::move(terrain), request.output};
}

struct RenderTimes {
  double start = 0.0, bake = 0.0, upload = 0.0, draw = 0.0, write = 0.0;
};

Result<image::Image> drawWithNew(Program& program, const RenderPlan& plan, gpu::Context& context,
                                 std::shared_ptr<const bake::GroundBake> ground, RenderTimes& times) {
  StopWatch watch;
  SWARD_ASSIGN(const auto renderer, render::Renderer::create(context));
  renderer->setStop(program.interrupts.token());
  SWARD_TRY(renderer->setGround(std::move(ground)));
  if (plan.terrain) SWARD_TRY(renderer->setTerrain(plan.terrain));
  times.upload = watch.lap();
  SWARD_ASSIGN(image::Image picture,
               drawPicture(program, *renderer, plan.project, plan.daylight, plan.frame, isLinear(plan.output)));
  times.draw = watch.lap();
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

/// Options of sequences that stand alone.
Result<void> checkAlone(const RenderRequest& request) {
  if (!request.shard.empty()) return Error::badInput("--shard is for sequences", "--shard", "Add --frames FIRST:LAST.");
  if (request.force) return Error::badInput("--force is for sequences", "--force", "Add --frames FIRST:LAST.");
  return {};
}

Result<int> runRender(Program& program, const RenderRequest& request) {
  if (!request.frames.empty()) return renderSequence(program, request);
  SWARD_TRY(checkAlone(request));
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
  SWARD_ASSIGN(const image::Image picture, drawWithNew(program, plan, *context, std::move(ground), times));
  watch.lap();
  SWARD_TRY(writePicture(program, plan.output, picture));
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
                 "With --frames it draws the project's sequence, in which the season passes; %04d in FILE is\n"
                 "the frame's number. An account of them stands beside the frames (NAME.frames.json): a later run\n"
                 "skips those that are whole and were made from the same project, view, settings and program.\n\n"
                 "Examples:\n"
                 "  sward render meadow.sward -o meadow.png --view low --size 1920x1080\n"
                 "  sward render meadow.sward -o noon.exr --sun 180,62 --spp 64 --exposure -0.5\n"
                 "  sward render meadow.sward -o cheap.png --view top --max-error rmse=0.12\n"
                 "  sward render meadow.sward -o paper.png --method blended_paper,lpt_paper --set tiles.seed=2\n"
                 "  sward render autumn.sward -o out/autumn_%04d.png --frames 0:119 --shard 1/4");
  const auto request = std::make_shared<RenderRequest>();
  command->add_option("PROJECT", request->project, "The project, a .sward file")->required();
  command
      ->add_option("-o,--output", request->output,
                   "The picture: .png (sRGB) or .exr (linear); with --frames a name such as f_%04d.png")
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
  command
      ->add_option("--frames", request->frames,
                   "Draw these frames of the project's sequence, both included, such as 0:119")
      ->type_name("A:B");
  command
      ->add_option("--shard", request->shard,
                   "Of those frames every Nth from the Ith on, such as 2/4 on the second of four machines")
      ->type_name("I/N");
  command->add_flag("--force", request->force, "Draw frames anew that are there already");
  command->callback(
      [&program, request] { program.run = [&program, request] { return runRender(program, *request); }; });
}

}  // namespace sward::editor
