#include "live/picture_job.h"

#include "bake/bake.h"
#include "image/io.h"
#include "render/frame_plan.h"
#include "render/renderer.h"

#include <algorithm>
#include <exception>
#include <mutex>
#include <thread>

namespace sward::editor {
namespace {

/// Part of the progress bar that baking takes; drawing has the rest.
constexpr double kBakeShare = 0.85;

bool isExr(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension == ".exr";
}

}  // namespace

struct PictureJob::Impl {
  explicit Impl(Request r) : request(std::move(r)) {
    thread = std::jthread([this](const std::stop_token& stop) { run(stop); });
  }

  void tell(const std::string& stage, double fraction) {
    {
      const std::lock_guard lock(mutex);
      status.stage = stage;
      status.fraction = fraction;
    }
    if (request.onChanged) request.onChanged();
  }

  /// The job's boundary: whatever goes wrong ends in the status.
  void run(const std::stop_token& stop) {
    Result<void> drawn;
    try {
      drawn = draw(stop);
    } catch (const std::exception& problem) {
      drawn = Error::failed(problem.what(), "render");
    }
    {
      const std::lock_guard lock(mutex);
      status.finished = true;
      if (!drawn.ok()) status.error = drawn.error();
    }
    if (request.onChanged) request.onChanged();
  }

  Result<void> draw(const std::stop_token& stop) {
    if (!image::canWriteImage(request.output))
      return Error::badInput("this is no kind of picture that can be written", request.output.string(),
                             "Use .png (sRGB, 8 bits) or .exr (linear).");
    SWARD_ASSIGN(const auto ground, bakeGround(stop));
    tell("Drawing", kBakeShare);
    SWARD_ASSIGN(const scene::Daylight daylight, render::daylightOf(*request.project));
    SWARD_ASSIGN(const render::Frame frame, render::planFrame(*request.project, request.view, daylight));
    SWARD_ASSIGN(const auto context, gpu::Context::create(request.device));
    SWARD_ASSIGN(const auto renderer, render::Renderer::create(*context));
    renderer->setStop(stop);
    SWARD_TRY(renderer->setGround(ground));
    SWARD_ASSIGN(const terrain::Terrain terrain, render::terrainOf(*request.project));
    SWARD_TRY(renderer->setTerrain(terrain.field));
    renderer->setDaylight(daylight, request.project->sky.hazeKm);
    render::Drawing drawing;
    SWARD_TRY(renderer->begin(drawing, frame));
    while (!drawing.complete()) {
      if (stop.stop_requested()) return Error::cancelled();
      SWARD_TRY(renderer->addSample(drawing));
      SWARD_TRY(renderer->finish());
      tell("Drawing", kBakeShare + (1.0 - kBakeShare) * drawing.samples() / frame.options.samples);
    }
    SWARD_ASSIGN(const image::Image linear, renderer->readLinear(drawing));
    if (isExr(request.output)) return image::writeExr(request.output, linear);
    return image::writePng(request.output, render::toDisplay(linear, frame.options.viewTransform));
  }

  Result<std::shared_ptr<const bake::GroundBake>> bakeGround(const std::stop_token& stop) {
    std::optional<bake::DiskCache> disk;
    if (!request.cacheFolder.empty()) {
      auto opened = bake::DiskCache::open(request.cacheFolder, request.cacheLimitBytes);
      if (opened.ok()) disk = std::move(*opened);
    }
    bake::Baker baker(std::move(disk));
    JobContext job;
    job.stop = stop;
    job.threads = request.threads;
    job.onProgress = [this](const std::string& stage, double fraction) {
      tell("Baking: " + stage, kBakeShare * fraction);
    };
    return baker.ground(*request.project, job);
  }

  Request request;
  mutable std::mutex mutex;
  Status status;
  std::jthread thread;
};

PictureJob::PictureJob(Request request) : m_impl(std::make_unique<Impl>(std::move(request))) {}
PictureJob::~PictureJob() = default;

PictureJob::Status PictureJob::status() const {
  const std::lock_guard lock(m_impl->mutex);
  return m_impl->status;
}

const std::filesystem::path& PictureJob::output() const {
  return m_impl->request.output;
}

void PictureJob::cancel() {
  m_impl->thread.request_stop();
}

}  // namespace sward::editor
