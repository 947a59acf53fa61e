#include "render_plan.h"

#include "bake/withering.h"
#include "base/file.h"
#include "export/frame_files.h"
#include "export/frame_manifest.h"
#include "gpu/context.h"
#include "project/sequence.h"
#include "render/frame_plan.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

namespace sward::editor {
namespace {

namespace fs = std::filesystem;
using exporting::FrameEntry;

constexpr int kFrameVersion = 1;  ///< raise it when frames of the same settings are to be drawn anew

/// All that a sequence needs, settled before anything is drawn.
struct SequencePlan {
  project::Project project;
  scene::View view;
  double exposureEv = 0.0;
  exporting::FramePattern pattern;
  exporting::FrameRange range;
  exporting::Shard shard;
  std::vector<int> frames;
  std::shared_ptr<const terrain::HeightField> terrain;
  base::Hash128
      common;  ///< of what all frames share beside the project's values: program, terrain's file, kind of file
  std::string settings;  ///< for people and other programs, JSON
};

/// What a frame costs.
struct FrameTimes {
  double bake = 0.0, draw = 0.0, write = 0.0;
};

struct DoneFrame {
  FrameEntry entry;
  bool drawn = false;  ///< else it was there
  FrameTimes seconds;
};

Result<void> checkOptions(const RenderRequest& request, const project::Project& project) {
  if (request.weathering) {
    return Error::badInput("--weathering shows one moment, --frames a whole season", "--weathering",
                           "Leave one of the two out; sequence.season says which moments frames show.");
  }
  if (project.accuracy.metric != report::ErrorBound::None) {
    return Error::badInput("a bound on the error chooses a bake for one picture, not for a sequence",
                           request.maxError.empty() ? "accuracy.metric" : "--max-error",
                           "Choose it for a picture first, or add --set accuracy.metric=none.");
  }
  return {};
}

/// The frame's number must lead to files that can be written.
Result<void> checkFrames(const exporting::FramePattern& pattern, const std::vector<int>& frames) {
  SWARD_TRY(checkOutputFile(pattern.manifest()));
  for (const int frame : frames) SWARD_TRY(checkPicture(pattern.fileOf(frame)));
  return {};
}

/// The running program's own bytes: frames that another build drew may differ, and would flicker between its own.
base::Hash128 hashOfBuild() {
  const auto program = base::readFile("/proc/self/exe");
  return program.ok() ? base::hashBytes(*program) : base::Hash128{};
}

Result<base::Hash128> hashOfCommon(const SequencePlan& plan) {
  base::Hasher hasher;
  hasher.add(std::string_view("frame")).add(kFrameVersion).add(std::string_view(SWARD_VERSION)).add(hashOfBuild());
  hasher.add(isLinear(plan.pattern.fileOf(0)));
  hasher.add(plan.exposureEv);
  if (plan.project.terrain.source == terrain::Source::Heightmap) {
    SWARD_ASSIGN(const auto heights, base::readFile(plan.project.resolve(plan.project.terrain.heightmap.path)));
    hasher.add(base::hashBytes(heights));
  }
  return hasher.finish();
}

std::string settingsText(const SequencePlan& plan) {
  const Json settings{{"sward", SWARD_VERSION},
                      {"files", plan.pattern.name()},
                      {"view", plan.view.name},
                      {"width", plan.project.output.width},
                      {"height", plan.project.output.height},
                      {"addedExposureEv", plan.exposureEv},
                      {"project", Json::parse(project::toJson(plan.project))}};
  return settings.dump();
}

Result<SequencePlan> planSequence(const Program& program, const RenderRequest& request) {
  SequencePlan plan;
  SWARD_ASSIGN(plan.project, requestedProject(program, request));
  SWARD_TRY(checkOptions(request, plan.project));
  SWARD_ASSIGN(plan.pattern, exporting::FramePattern::parse(request.output));
  SWARD_ASSIGN(plan.range, exporting::parseFrames(request.frames, plan.project.sequence.frames));
  if (!request.shard.empty()) {
    SWARD_ASSIGN(plan.shard, exporting::parseShard(request.shard));
  }
  plan.frames = exporting::framesOf(plan.range, plan.shard);
  SWARD_TRY(checkFrames(plan.pattern, exporting::framesOf(plan.range, {})));
  SWARD_ASSIGN(plan.view, chooseView(plan.project, request.view));
  plan.exposureEv = request.exposureEv;
  // Whatever is wrong with the light or the view is said before hours are spent on other frames.
  SWARD_ASSIGN(const scene::Daylight daylight, render::daylightOf(plan.project));
  SWARD_TRY(render::planFrame(plan.project, plan.view, daylight, plan.exposureEv));
  if (!bake::drawnAsTexels(plan.project)) {
    warn(program, "layers are sampled anew for every frame, and shimmer; texels do not (--method texels)");
  }
  SWARD_ASSIGN(plan.terrain, requestedTerrain(program, plan.project));
  SWARD_ASSIGN(plan.common, hashOfCommon(plan));
  plan.settings = settingsText(plan);
  return plan;
}

/// Names everything that decides a frame's picture.
Result<std::string> keyOf(const SequencePlan& plan, project::Project at, bake::Baker& baker) {
  SWARD_ASSIGN(const base::Hash128 ground, baker.key({at, bake::Quality::Full, {}}));
  base::Hasher hasher;
  hasher.add(plan.common).add(ground);
  if (!bake::drawnAsTexels(at)) {  // tiles lie as in the first frame
    const project::Project start = project::projectAt(plan.project, 0);
    SWARD_ASSIGN(const base::Hash128 first, baker.key({start, bake::Quality::Full, {}}));
    hasher.add(first);
  }
  // What other views and frames there are, and the name, show in no picture.
  at.name.clear();
  at.views = {plan.view};
  at.sequence = {};
  hasher.add(std::string_view(project::toJson(at)));
  return hasher.finish().hex();
}

/// A sequence asks for every moment once: finished texels would only push others out of the cache.
bake::Baker::Options bakerOptions() {
  bake::Baker::Options options;
  options.storeTexels = false;
  return options;
}

/// Draws the frames of a plan one after the other, with one renderer and one baker.
class SequencePainter {
 public:
  SequencePainter(Program& program, const SequencePlan& plan, gpu::Context& context)
      : m_program(program),
        m_plan(plan),
        m_context(context),
        m_baker(openBaker(program, bakerOptions())),
        m_bar(program) {}

  Result<std::vector<DoneFrame>> draw(bool force) {
    SWARD_TRY(findWhole(force));
    if (m_whole > 0) {
      m_bar.line(std::to_string(m_whole) + " of " + std::to_string(m_done.size()) + " frames are there already");
    }
    for (DoneFrame& frame : m_done) {
      if (m_program.interrupts.requested()) return Error::cancelled();
      if (frame.drawn) SWARD_TRY(drawFrame(frame));
    }
    return std::move(m_done);
  }

 private:
  /// Where the tiles of layers lie in all frames: as in the sequence's first, whoever draws it, so that they do not
  /// jump from frame to frame.
  Result<void> findLayout() {
    if (m_first || bake::drawnAsTexels(m_plan.project)) return {};
    SWARD_ASSIGN(m_first, m_baker.ground(project::projectAt(m_plan.project, 0), jobOf(0)));
    m_layout = bake::layoutOf(*m_first);
    return {};
  }

  Result<std::shared_ptr<const bake::GroundBake>> groundOf(int number, const project::Project& at,
                                                           bake::BakeReport& report) {
    SWARD_TRY(findLayout());
    if (number == 0 && m_first) return m_first;
    return m_baker.ground({at, bake::Quality::Full, m_layout}, jobOf(number), &report);
  }

  /// Lists all frames with their keys; those that need drawing are marked so.
  Result<void> findWhole(bool force) {
    const exporting::FrameManifest known = exporting::readManifest(m_plan.pattern.manifest());
    for (const int number : m_plan.frames) {
      if (m_program.interrupts.requested()) return Error::cancelled();
      DoneFrame& frame = m_done.emplace_back();
      const project::Project at = project::projectAt(m_plan.project, number);
      frame.entry.frame = number;
      frame.entry.weathering = at.wither.weathering;
      frame.entry.file = m_plan.pattern.fileOf(number).filename().string();
      SWARD_ASSIGN(frame.entry.key, keyOf(m_plan, at, m_baker));
      const auto found = known.frames.find(number);
      const bool whole = !force && found != known.frames.end() && found->second.key == frame.entry.key &&
                         found->second.file == frame.entry.file &&
                         exporting::isWhole(m_plan.pattern.manifest().parent_path(), found->second);
      frame.drawn = !whole;
      if (whole) frame.entry = found->second;
      m_whole += whole ? 1 : 0;
    }
    return {};
  }

  /// Made with the first frame that is drawn: a finished sequence needs none.
  Result<void> makeRenderer() {
    if (m_renderer) return {};
    SWARD_ASSIGN(m_renderer, render::Renderer::create(m_context));
    m_renderer->setStop(m_program.interrupts.token());
    if (m_plan.terrain) SWARD_TRY(m_renderer->setTerrain(m_plan.terrain));
    return {};
  }

  Result<void> drawFrame(DoneFrame& done) {
    SWARD_TRY(makeRenderer());
    StopWatch watch;
    const project::Project at = project::projectAt(m_plan.project, done.entry.frame);
    const fs::path file = m_plan.pattern.fileOf(done.entry.frame);
    SWARD_ASSIGN(const scene::Daylight daylight, render::daylightOf(at));
    SWARD_ASSIGN(const render::Frame frame, render::planFrame(at, m_plan.view, daylight, m_plan.exposureEv));
    bake::BakeReport baked;
    SWARD_ASSIGN(auto ground, groundOf(done.entry.frame, at, baked));
    SWARD_TRY(m_renderer->setGround(std::move(ground)));
    done.seconds.bake = watch.lap();
    for (const std::string& warning : baked.warnings) warnOnce(warning);
    progress("frame " + std::to_string(done.entry.frame) + ": drawing", kBakePart);
    SWARD_ASSIGN(const image::Image picture, drawPicture(m_program, *m_renderer, at, daylight, frame, isLinear(file)));
    done.seconds.draw = watch.lap();
    SWARD_TRY(writePicture(m_program, file, picture));
    SWARD_TRY(keepAccount(done, file));
    done.seconds.write = watch.lap();
    ++m_drawn;
    progress("frame " + std::to_string(done.entry.frame), 0.0);
    say(done);
    return {};
  }

  Result<void> keepAccount(DoneFrame& done, const fs::path& file) {
    const auto writing = m_program.interrupts.writing();
    const gpu::DeviceInfo& device = m_context.info();
    SWARD_ASSIGN(done.entry, exporting::entryOf(file, done.entry.frame, done.entry.weathering, done.entry.key,
                                                device.api + ", " + device.renderer));
    return exporting::record(m_plan.pattern.manifest(), m_plan.settings, done.entry);
  }

  void say(const DoneFrame& done) {
    char text[160];
    std::snprintf(text, sizeof(text), "frame %d (%zu of %zu): weathering %.3f, baked in %s, drawn in %s; wrote %s",
                  done.entry.frame, m_drawn, m_done.size() - m_whole, done.entry.weathering,
                  secondsText(done.seconds.bake).c_str(), secondsText(done.seconds.draw).c_str(),
                  done.entry.file.c_str());
    const std::size_t left = m_done.size() - m_whole - m_drawn;
    const double each = m_watch.total() / static_cast<double>(m_drawn);
    m_bar.line(left == 0 ? std::string(text)
                         : std::string(text) + "; about " + leftText(each * static_cast<double>(left)) + " left");
  }

  void warnOnce(const std::string& warning) {
    if (std::find(m_warned.begin(), m_warned.end(), warning) != m_warned.end()) return;
    m_warned.push_back(warning);
    warn(m_program, warning);
  }

  /// The share of a frame's work that is done, of all frames that are drawn.
  void progress(const std::string& stage, double within) {
    const auto frames = static_cast<double>(m_done.size() - m_whole);
    if (const JobContext job = m_bar.job(); job.onProgress) {
      job.onProgress(stage, std::min((static_cast<double>(m_drawn) + within) / frames, 1.0));
    }
  }

  JobContext jobOf(int frame) {
    JobContext job = m_bar.job();
    if (!job.onProgress) return job;
    job.onProgress = [this, frame](const std::string& stage, double fraction) {
      progress("frame " + std::to_string(frame) + ": " + stage, kBakePart * std::clamp(fraction, 0.0, 1.0));
    };
    return job;
  }

  static constexpr double kBakePart = 0.5;  ///< of a frame's time, for the bar alone

  Program& m_program;
  const SequencePlan& m_plan;
  gpu::Context& m_context;
  bake::Baker m_baker;
  ProgressBar m_bar;
  std::shared_ptr<const bake::GroundBake> m_first;  ///< of layers: the sequence's first frame
  std::vector<glm::ivec2> m_layout;
  std::unique_ptr<render::Renderer> m_renderer;
  std::vector<DoneFrame> m_done;
  std::size_t m_whole = 0, m_drawn = 0;
  StopWatch m_watch;
  std::vector<std::string> m_warned;
};

Json frameJson(const DoneFrame& done) {
  Json json{{"frame", done.entry.frame},
            {"file", done.entry.file},
            {"weathering", done.entry.weathering},
            {"state", done.drawn ? "drawn" : "kept"},
            {"hash", done.entry.hash},
            {"bytes", done.entry.bytes}};
  if (done.drawn) {
    json["seconds"] = {{"bake", done.seconds.bake}, {"draw", done.seconds.draw}, {"write", done.seconds.write}};
  }
  return json;
}

Json resultJson(const SequencePlan& plan, const gpu::DeviceInfo& device, const std::vector<DoneFrame>& frames,
                double seconds) {
  Json list = Json::array();
  for (const DoneFrame& done : frames) list.push_back(frameJson(done));
  return {{"files", plan.pattern.name()},
          {"folder", plan.pattern.manifest().parent_path().string()},
          {"manifest", plan.pattern.manifest().string()},
          {"range", {plan.range.first, plan.range.last}},
          {"shard", {{"index", plan.shard.index}, {"count", plan.shard.count}}},
          {"view", plan.view.name},
          {"width", plan.project.output.width},
          {"height", plan.project.output.height},
          {"device", device.api + ", " + device.renderer},
          {"seconds", seconds},
          {"frames", list}};
}

}  // namespace

Result<int> renderSequence(Program& program, const RenderRequest& request) {
  StopWatch watch;
  SWARD_ASSIGN(const gpu::Device device, gpu::deviceFromName(request.device));
  SWARD_ASSIGN(const SequencePlan plan, planSequence(program, request));
  SWARD_ASSIGN(const auto context, gpu::Context::create(device));
  std::vector<DoneFrame> frames;
  {
    SequencePainter painter(program, plan, *context);
    SWARD_ASSIGN(frames, painter.draw(request.force));
  }
  const auto drawn = std::count_if(frames.begin(), frames.end(), [](const DoneFrame& frame) { return frame.drawn; });
  const double seconds = watch.lap();
  say(program, "drew " + std::to_string(drawn) + " of " + std::to_string(frames.size()) + " frames of view \"" +
                   plan.view.name + "\" in " + secondsText(seconds) + "; " + plan.pattern.manifest().string() +
                   " keeps account of them");
  if (program.common.json) print(resultJson(plan, context->info(), frames, seconds));
  return kDone;
}

}  // namespace sward::editor
