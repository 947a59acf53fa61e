#include "app/live_link.h"

#include "panels/view_edits.h"

#include <algorithm>
#include <chrono>

namespace sward::editor {
namespace {

/// A picture answers at half resolution until nothing moved for so long.
constexpr double kSettleSeconds = 0.25;
constexpr double kRateSeconds = 2.0;  ///< over which pictures a second are counted
constexpr int kThumbnailPixels = 96;

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

render::GroundMethod methodOf(CompareState::Other other, render::GroundMethod own) {
  switch (other) {
    case CompareState::Other::March:
      return render::GroundMethod::March;
    case CompareState::Other::Blended:
      return render::GroundMethod::BlendedNormalised;
    case CompareState::Other::BlendedPaper:
      return render::GroundMethod::BlendedPaper;
    case CompareState::Other::Ptm:
    case CompareState::Other::LptPaper:
    case CompareState::Other::Reference:
      return own;
  }
  return own;
}

BakeService::Options bakeOptions(const LiveLink::Options& options) {
  BakeService::Options bake;
  bake.cacheFolder = options.cacheFolder;
  bake.cacheLimitBytes = options.cacheLimitBytes;
  bake.threads = options.threads;
  bake.onChanged = options.wake;
  return bake;
}

}  // namespace

LiveLink::LiveLink(const UiGl& gl, Options options)
    : m_gl(gl),
      m_bakeOptions(bakeOptions(options)),
      m_bakes(m_bakeOptions),
      m_views({options.device, options.wake}),
      m_thumbnails({{.size = kThumbnailPixels}, options.wake}) {
  m_state.thumbnails = &m_thumbnailTextures;
}

LiveLink::~LiveLink() {
  m_gl.destroy(m_state.picture.texture);
  for (const auto& [key, picture] : m_thumbnailTextures) m_gl.destroy(picture.texture);
}

bool LiveLink::poll() {
  takeGrounds();
  const bool picture = takePicture();
  const bool thumbnails = takeThumbnails();
  const bool reference = pollReference();
  const BakeStatus before = m_state.bake;
  m_state.bake = m_bakes.status();
  m_state.viewError = m_views.error();
  m_state.device = m_views.device();
  const auto percent = [](const BakeStatus& status) { return static_cast<int>(status.fraction * 100.0); };
  const bool status = before.running != m_state.bake.running || before.quality != m_state.bake.quality ||
                      percent(before) != percent(m_state.bake) ||
                      before.error.has_value() != m_state.bake.error.has_value();
  return picture || thumbnails || reference || status || m_groundChanged;
}

void LiveLink::takeGrounds() {
  m_groundChanged = false;
  while (auto baked = m_bakes.tryPop()) {
    m_state.ground = std::move(baked->ground);
    m_groundProject = std::move(baked->project);
    m_inspection = baked->inspection;
    m_state.inspection = std::move(baked->inspection);
    m_state.quality = baked->quality;
    m_state.groundSeconds = baked->secondsSinceRequest;
    m_groundChanged = true;
  }
  if (m_otherBakes) {
    while (auto baked = m_otherBakes->tryPop()) {
      m_otherGround = std::move(baked->ground);
      m_groundChanged = true;
    }
  }
}

bool LiveLink::takePicture() {
  auto picture = m_views.tryPop();
  if (!picture) return false;
  m_state.picture.texture = m_gl.upload(m_state.picture.texture, picture->width, picture->height, picture->rgba);
  m_state.picture.width = picture->width;
  m_state.picture.height = picture->height;
  m_state.samples = picture->samples;
  m_state.pictureFinal = picture->final && picture->id == m_requestId;
  m_state.drawMs = picture->drawMs;
  if (m_state.reference) m_state.reference->rmse = picture->rmse;
  ++m_pictures;
  m_pictureTimes.push_back(now());
  while (m_pictureTimes.back() - m_pictureTimes.front() > kRateSeconds) m_pictureTimes.pop_front();
  const double span = m_pictureTimes.back() - m_pictureTimes.front();
  m_state.framesPerSecond = span > 0.0 ? static_cast<double>(m_pictureTimes.size() - 1) / span : 0.0;
  return true;
}

bool LiveLink::takeThumbnails() {
  bool any = false;
  while (auto drawn = m_thumbnails.tryPop()) {
    any = true;
    if (drawn->error) continue;  // its bake says what is wrong
    PanelPicture& picture = m_thumbnailTextures[drawn->slot];
    picture.width = picture.height = drawn->thumbnail.size;
    picture.texture = m_gl.upload(picture.texture, picture.width, picture.height, drawn->thumbnail.rgba);
  }
  return any;
}

void LiveLink::update(const Document& document, const UiState& ui, int width, int height, double seconds) {
  // What only inspections show is baked while it is looked at.
  const render::ViewMode mode = shownMode(ui, document.project());
  if (const bool inspect = mode.needsInspection(); inspect != m_inspecting) {
    m_inspecting = inspect;
    m_bakes.inspect(inspect);
    if (inspect) m_revision = 0;
  }
  const std::optional<double> weathering = ui.season.at ? std::optional(ui.season.weathering) : std::optional<double>();
  if (document.revision() != m_revision || weathering != m_weathering) {
    if (document.revision() != m_revision) requestThumbnails(document);
    m_revision = document.revision();
    m_weathering = weathering;
    m_bakes.request(shownProject(document, ui), m_revision);
  }
  const CompareState compare = shownComparison(ui, document.project());
  updateOther(document, compare);
  m_state.stale = m_bakes.status().running;
  if (!m_state.ground || width < 1 || height < 1 || !groundFits(document.project())) return;
  if (m_inspecting && !m_inspection) return;
  const bool moved = ui.inputActive || seconds - ui.lastMotion < kSettleSeconds;
  Wanted wanted{document.snapshot(), m_state.ground, ui.camera, width, height, mode, compare, moved,
                m_otherGround,       m_inspection,   false,     {}};
  updateReference(wanted);
  if (m_wanted == wanted) return;
  m_settleAt = moved ? std::optional(seconds + kSettleSeconds) : std::nullopt;
  // More of the reference leaves the project's own picture as it is.
  if (m_wanted) m_wanted->reference = wanted.reference;
  if (m_wanted != wanted) m_state.pictureFinal = false;
  requestPicture(wanted);
  m_wanted = std::move(wanted);
}

Snapshot LiveLink::shownProject(const Document& document, const UiState& ui) {
  if (!ui.season.at) return document.snapshot();
  auto shown = std::make_shared<project::Project>(document.project());
  shown->wither.weathering = ui.season.weathering;
  return shown;
}

bool LiveLink::groundFits(const project::Project& project) const {
  return (m_state.ground->texels != nullptr) == drawsTexels(project);
}

bool LiveLink::pollReference() {
  if (!m_reference || !m_state.reference) return false;
  ReferenceState& state = *m_state.reference;
  const ReferenceService::Status status = m_reference->status();
  auto picture = m_reference->picture();
  const bool changed = picture != state.picture || status.running != state.running ||
                       status.error.has_value() != state.error.has_value();
  state.picture = std::move(picture);
  if (!state.picture) state.rmse.reset();
  state.running = status.running;
  state.error = status.error;
  return changed;
}

void LiveLink::updateReference(Wanted& wanted) {
  const bool compared = wanted.compare.on && wanted.compare.other == CompareState::Other::Reference;
  if (!compared || !wanted.mode.plain()) {
    if (m_reference) m_reference->close();
    m_state.reference.reset();
    return;
  }
  if (!m_reference)
    m_reference = std::make_unique<ReferenceService>(
        ReferenceService::Options{.threads = m_bakeOptions.threads, .onChanged = m_bakeOptions.onChanged});
  if (!m_state.reference) m_state.reference.emplace();
  const bool full = m_state.quality == Quality::Full;
  // A coarse ground is on its way to another one, and its bake needs the processor.
  const bool held = m_bakes.status().running || !full;
  m_reference->request(
      {wanted.project, wanted.ground, m_groundProject, wanted.view, wanted.width, wanted.height, wanted.moving, held});
  pollReference();
  m_state.reference->waitsForBake = held && !m_state.reference->picture;
  wanted.given = true;
  wanted.reference = m_state.reference->picture;
}

void LiveLink::updateOther(const Document& document, const CompareState& compare) {
  const bool needed =
      compare.on && (compare.other == CompareState::Other::Ptm || compare.other == CompareState::Other::LptPaper);
  if (!needed) {
    m_otherRevision = 0;
    return;
  }
  if (!m_otherBakes) m_otherBakes = std::make_unique<BakeService>(m_bakeOptions);
  if (m_otherRevision == document.revision() && m_otherOther == compare.other) return;
  auto other = std::make_shared<project::Project>(document.project());
  other->fit.basis = compare.other == CompareState::Other::Ptm ? lpt::Basis::Ptm : lpt::Basis::Lpt;
  other->fit.paper = compare.other == CompareState::Other::LptPaper;
  m_otherBakes->request(std::move(other), document.revision());
  m_otherRevision = document.revision();
  m_otherOther = compare.other;
  m_otherGround.reset();
}

void LiveLink::requestThumbnails(const Document& document) {
  // A plant's place in the list decides about its random numbers, so that it is the slot, too.
  const project::Patch& patch = document.project().patch;
  for (std::size_t i = 0; i < patch.plants.size(); ++i)
    m_thumbnails.request(i, patch.plants[i], i, patch.seed, document.project().folder);
  while (!m_thumbnailTextures.empty() && m_thumbnailTextures.rbegin()->first >= patch.plants.size()) {
    const auto last = std::prev(m_thumbnailTextures.end());
    m_thumbnails.forget(last->first);
    m_gl.destroy(last->second.texture);
    m_thumbnailTextures.erase(last);
  }
}

void LiveLink::requestPicture(const Wanted& wanted) {
  ViewRequest request;
  request.project = wanted.project;
  request.ground = wanted.ground;
  request.view = wanted.view;
  request.width = wanted.width;
  request.height = wanted.height;
  request.mode = wanted.mode;
  request.inspection = wanted.inspection;
  request.moving = wanted.moving;
  request.id = ++m_requestId;
  const bool nothingBeside = wanted.compare.other == CompareState::Other::Reference && !wanted.given;
  if (wanted.compare.on && !nothingBeside) {
    Comparison comparison;
    comparison.show = wanted.compare.show;
    comparison.splitAt = wanted.compare.splitAt;
    comparison.method = methodOf(wanted.compare.other, wanted.project->render.method);
    comparison.ground = wanted.other;
    comparison.differenceGain = wanted.compare.gain;
    comparison.given = wanted.given;
    if (wanted.reference) comparison.other = {wanted.reference, &wanted.reference->bytes};
    request.comparison = std::move(comparison);
  }
  m_views.request(std::move(request));
}

bool LiveLink::settled() const {
  return m_state.ground && m_state.quality == Quality::Full && m_state.bake.revision == m_revision &&
         !m_state.bake.running && !m_state.bake.error && m_state.pictureFinal && !m_settleAt;
}

void LiveLink::cancelBake() {
  m_bakes.cancel();
}

}  // namespace sward::editor
