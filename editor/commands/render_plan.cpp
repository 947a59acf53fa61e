#include "render_plan.h"

#include "base/two_numbers.h"

#include "methods.h"

#include "image/io.h"
#include "project/limits.h"
#include "project/nearest.h"
#include "render/frame_plan.h"
#include "report/choice.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <utility>

namespace sward::editor {
namespace {

namespace fs = std::filesystem;

Result<void> applySize(const std::string& text, project::Project& project) {
  if (text.empty()) return {};
  const auto size = base::twoNumbers<std::int64_t>(text, 'x');
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
  const auto angles = base::twoNumbers<double>(text, ',');
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

}  // namespace

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

Result<project::Project> requestedProject(const Program& program, const RenderRequest& request) {
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
  return project;
}

Result<std::shared_ptr<const terrain::HeightField>> requestedTerrain(const Program& program,
                                                                     const project::Project& project) {
  SWARD_ASSIGN(const terrain::Terrain terrain, render::terrainOf(project));
  for (const std::string& warning : terrain.warnings) warn(program, "terrain: " + warning);
  return std::shared_ptr<const terrain::HeightField>(terrain.field);
}

bool isLinear(const fs::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension == ".exr";
}

Result<void> writePicture(Program& program, const fs::path& file, const image::Image& picture) {
  const auto writing = program.interrupts.writing();
  return isLinear(file) ? image::writeExr(file, picture) : image::writePng(file, picture);
}

Result<image::Image> drawPicture(const Program& program, render::Renderer& renderer, const project::Project& project,
                                 const scene::Daylight& daylight, const render::Frame& frame, bool linear) {
  renderer.setDaylight(daylight, project.sky.hazeKm);
  if (program.interrupts.requested()) return Error::cancelled();
  SWARD_ASSIGN(image::Image picture, linear ? renderer.drawLinear(frame) : renderer.drawDisplay(frame));
  if (program.interrupts.requested()) return Error::cancelled();
  return picture;
}

}  // namespace sward::editor
