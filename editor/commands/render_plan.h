#pragma once

#include "common.h"

#include "image/image.h"
#include "render/renderer.h"
#include "scene/sun_sky.h"
#include "terrain/height_field.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace sward::editor {

/// The options of `sward render`.
struct RenderRequest {
  std::string project, output, view, size, sun, maxError, device = "auto", frames, shard;
  std::vector<std::string> methods;
  std::optional<int> samples;
  std::optional<double> weathering;
  double exposureEv = 0.0;
  bool force = false;
};

/// The project with what the options say put into it, checked.
Result<project::Project> requestedProject(const Program& program, const RenderRequest& request);
/// The view of that name; without a name "main", else the first. Errors: there is none of that name.
Result<scene::View> chooseView(const project::Project& project, const std::string& name);
/// The project's terrain, its warnings said; null: level ground.
Result<std::shared_ptr<const terrain::HeightField>> requestedTerrain(const Program& program,
                                                                     const project::Project& project);

/// Whether a picture can be put there.
Result<void> checkPicture(const std::filesystem::path& file);
/// Whether a picture's file holds linear light (.exr) rather than what a display shows (.png).
bool isLinear(const std::filesystem::path& file);
/// Writes a picture under the lock that keeps an interrupt from cutting it off.
Result<void> writePicture(Program& program, const std::filesystem::path& file, const image::Image& picture);

/// One picture of a ground that the renderer holds. Errors: Error::cancelled() after an interrupt, too.
Result<image::Image> drawPicture(const Program& program, render::Renderer& renderer, const project::Project& project,
                                 const scene::Daylight& daylight, const render::Frame& frame, bool linear);

/// Draws a range of frames of the project's sequence (--frames).
Result<int> renderSequence(Program& program, const RenderRequest& request);

}  // namespace sward::editor
