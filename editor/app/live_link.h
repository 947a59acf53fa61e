#pragma once

#include "app/ui_gl.h"
#include "document/document.h"
#include "document/preferences.h"
#include "live/bake_service.h"
#include "live/reference_service.h"
#include "live/thumbnail_service.h"
#include "live/view_service.h"
#include "panels/panel_context.h"

#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <string>

namespace sward::editor {

/// Ties the document to the services: asks for bakes, pictures and thumbnails as it changes, and keeps the textures
/// that show their results. Belongs to the UI thread and its OpenGL context.
class LiveLink {
 public:
  struct Options {
    std::filesystem::path cacheFolder;
    std::uint64_t cacheLimitBytes = 0;
    int threads = 0;
    gpu::Device device = gpu::Device::Auto;
    std::function<void()> wake;  ///< called from other threads when there is something to show
  };
  LiveLink(const UiGl& gl, Options options);
  ~LiveLink();
  LiveLink(const LiveLink&) = delete;
  LiveLink& operator=(const LiveLink&) = delete;

  /// Takes what the services finished; true when the window should be drawn again.
  bool poll();
  /// Asks for what this frame shows; `width` and `height` of the viewport in pixels.
  void update(const Document& document, const UiState& ui, int width, int height, double seconds);
  /// A moment at which the window should be drawn again by itself: a picture at full resolution follows a drag.
  std::optional<double> nextWake() const { return m_settleAt; }

  const LiveState& state() const { return m_state; }
  /// Everything of the newest request is on screen: ground at full quality, all samples.
  bool settled() const;
  void cancelBake();
  /// An asset changed on the disk: asks for the same project again.
  void rebake() { m_revision = 0; }
  /// Pictures that came so far.
  std::uint64_t pictures() const { return m_pictures; }

 private:
  struct Wanted {
    Snapshot project;
    std::shared_ptr<const bake::GroundBake> ground;
    scene::View view;
    int width = 0, height = 0;
    render::ViewMode mode;
    CompareState compare;
    bool moving = false;
    std::shared_ptr<const bake::GroundBake> other;  ///< of the compared fit
    std::shared_ptr<const bake::Inspection> inspection;
    bool given = false;                                 ///< compared with the reference
    std::shared_ptr<const ReferencePicture> reference;  ///< as far as it is traced
    bool operator==(const Wanted&) const = default;
  };
  /// The document's project at the weathering degree that is shown.
  Snapshot shownProject(const Document& document, const UiState& ui);
  void takeGrounds();
  bool takePicture();
  bool takeThumbnails();
  void requestPicture(const Wanted& wanted);
  void requestThumbnails(const Document& document);
  void updateOther(const Document& document, const CompareState& compare);
  /// Whether the newest ground is of the kind that the project is drawn with.
  bool groundFits(const project::Project& project) const;
  bool pollReference();
  /// Asks for the reference of what is wanted, or lets go of it.
  void updateReference(Wanted& wanted);

  const UiGl& m_gl;
  BakeService::Options m_bakeOptions;
  BakeService m_bakes;
  ViewService m_views;
  ThumbnailService m_thumbnails;
  LiveState m_state;
  std::map<std::uint64_t, PanelPicture> m_thumbnailTextures;  ///< by the plant's index
  std::uint64_t m_revision = 0;
  std::optional<double> m_weathering;  ///< that is asked for in place of the document's own
  Snapshot m_groundProject;            ///< that m_state.ground was baked from
  std::shared_ptr<const bake::Inspection> m_inspection;
  bool m_inspecting = false;
  std::optional<Wanted> m_wanted;
  std::uint64_t m_requestId = 0;
  std::optional<double> m_settleAt;
  std::deque<double> m_pictureTimes;
  std::uint64_t m_pictures = 0;
  bool m_groundChanged = false;

  std::unique_ptr<BakeService> m_otherBakes;  ///< of the fit that the viewport compares with, once it is asked for
  std::shared_ptr<const bake::GroundBake> m_otherGround;
  std::uint64_t m_otherRevision = 0;
  CompareState::Other m_otherOther{};
  std::unique_ptr<ReferenceService> m_reference;  ///< once it is asked for
};

}  // namespace sward::editor
