#pragma once

#include "document/document.h"
#include "live/bake_service.h"
#include "live/reference_service.h"
#include "panels/ui_state.h"

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace sward::editor {

/// Where panels send what the user wants; they never change a document themselves.
class EditSink {
 public:
  virtual ~EditSink() = default;
  /// As Document::edit.
  virtual void edit(const std::string& name, const std::function<void(project::Project&)>& change,
                    const std::string& mergeKey = {}) = 0;
  /// Ends the open step: a drag was let go.
  virtual void closeStep() = 0;
  /// Runs an action of the table by its id, such as "plant.addFromFile".
  virtual void run(const std::string& action) = 0;
  /// Says something in passing.
  virtual void notice(const std::string& text) = 0;
  /// Lets the user choose a file for the value at a path of the document; `files` are the endings that are accepted.
  virtual void browse(const std::string& path, const std::string& files) = 0;
};

/// A texture that a panel shows.
struct PanelPicture {
  std::uint64_t texture = 0;  ///< an OpenGL name; 0: none yet
  int width = 0, height = 0;
};

/// The reference that the viewport compares with.
struct ReferenceState {
  std::shared_ptr<const ReferencePicture> picture;  ///< null: not there yet
  bool running = false;                             ///< more samples are on their way
  bool waitsForBake = false;                        ///< it is traced once the ground is baked in full
  std::optional<Error> error;
  std::optional<double> rmse;  ///< of the display values of both sides, when the view is at rest
};

/// What the services have to show this frame.
struct LiveState {
  BakeStatus bake;
  std::shared_ptr<const bake::GroundBake> ground;      ///< newest; null until the first is ready
  std::shared_ptr<const bake::Inspection> inspection;  ///< of `ground`, while a view mode needs one
  Quality quality = Quality::Coarse;                   ///< of `ground`
  double groundSeconds = 0.0;                          ///< from the edit to `ground`
  bool stale = false;                                  ///< `ground` is of an older project than the document's
  PanelPicture picture;
  int samples = 0;
  bool pictureFinal = false;
  double drawMs = 0.0, framesPerSecond = 0.0;
  std::optional<ReferenceState> reference;  ///< while it is compared with and the mode is the plain picture
  std::optional<Error> viewError;
  std::optional<gpu::DeviceInfo> device;
  const std::map<std::uint64_t, PanelPicture>* thumbnails = nullptr;  ///< by the plant's index
};

/// What every panel is given.
struct PanelContext {
  const Document& document;
  /// This frame's project: stays what it is while panels send edits.
  Snapshot project;
  EditSink& edits;
  UiState& ui;
  const LiveState& live;
  double seconds = 0.0;                      ///< of the clock that frames are drawn by
  float scale = 1.0f;                        ///< pixels a design pixel
  std::vector<std::string> addPlantActions;  ///< ids of the actions that add a preset
};

}  // namespace sward::editor
