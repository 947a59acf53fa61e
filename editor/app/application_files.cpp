#include "app/application.h"

#include "document/document_io.h"
#include "document/edits.h"

#include "bake/import.h"
#include "project/assets.h"

#include <algorithm>
#include <array>
#include <string_view>

#include <unistd.h>

namespace sward::editor {
namespace {

namespace fs = std::filesystem;

/// Endings of pictures that can be dropped on the window; what they hold is read when the soil is baked.
constexpr std::array<std::string_view, 6> kPictures{".png", ".jpg", ".jpeg", ".tif", ".tiff", ".exr"};

std::string lowerExtension(const fs::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

/// The sample that a first start opens: beside the program's source, where it was built.
std::optional<fs::path> sampleProject() {
  std::error_code code;
  const fs::path program = fs::read_symlink("/proc/self/exe", code);
  for (fs::path folder = program.parent_path(); !code && folder.has_relative_path(); folder = folder.parent_path()) {
    const fs::path sample = folder / "projects" / "meadow.sward";
    if (fs::exists(sample, code)) return sample;
  }
  return std::nullopt;
}

}  // namespace

void Application::openAtStart() {
  m_document = std::make_unique<Document>();
  if (m_options.project) {
    auto opened = openDocument(*m_options.project);
    if (opened.ok()) {
      replaceDocument(std::move(*opened));
      applyOverrides();
    } else {
      startFromTemplate("meadow");
      m_dialogs.showError("The project cannot be opened", opened.error());
    }
    return;
  }
  const auto sample = sampleProject();
  auto opened = sample ? openDocument(*sample) : Result<Document>(Error::failed("there is no sample"));
  if (opened.ok()) {
    replaceDocument(std::move(*opened));
  } else {
    startFromTemplate("meadow");
  }
}

void Application::applyOverrides() {
  if (m_options.overrides.empty()) return;
  auto changed = project::load(m_document->file(), m_options.overrides);
  if (!changed.ok()) return m_dialogs.showError("The values of --set cannot be used", changed.error());
  edit("values of --set", [&](project::Project& p) { p = std::move(*changed); }, {});
}

void Application::startFromTemplate(const std::string& name) {
  auto made = newDocument(name);
  if (!made.ok()) return m_dialogs.showError("The template cannot be used", made.error());
  replaceDocument(std::move(*made));
}

void Application::replaceDocument(Document document) {
  m_autosave.clear();
  showDocument(std::move(document));
}

void Application::showDocument(Document document) {
  *m_document = std::move(document);
  m_ui.selection = {};
  if (!m_document->project().patch.plants.empty()) m_ui.selection = selectPlant(m_document->project(), 0);
  const auto& views = m_document->project().views;
  const auto main = std::find_if(views.begin(), views.end(), [](const scene::View& v) { return v.name == "main"; });
  m_ui.boundView.reset();
  if (!views.empty()) {
    m_ui.boundView = main == views.end() ? 0 : static_cast<std::size_t>(main - views.begin());
    m_ui.camera = views[*m_ui.boundView];
  } else {
    m_ui.camera = scene::View{};
  }
  m_ui.activeCurve.clear();
  m_ui.season = {};
  if (!m_document->file().empty()) m_preferences.addRecent(m_document->file());
  m_watch.watchProject(m_document->file(), m_document->snapshot());
  showMissingAssets();
}

void Application::showMissingAssets() {
  std::vector<std::string> wheres, files;
  for (const project::AssetReference& asset : project::missingAssets(m_document->project())) {
    wheres.push_back(asset.where);
    files.push_back(m_document->project().resolve(asset.path).string());
  }
  if (!wheres.empty()) m_dialogs.showMissing(std::move(wheres), std::move(files));
}

void Application::open(const fs::path& file) {
  whenSaved([this, file] {
    auto opened = openDocument(file);
    if (!opened.ok()) return m_dialogs.showError("The project cannot be opened", opened.error());
    replaceDocument(std::move(*opened));
  });
}

void Application::chooseProject() {
  FileDialogOptions options;
  options.title = "Open a project";
  options.filters = {{"Sward projects", {".sward"}}};
  chooseFile(std::move(options), [this](const fs::path& file) { open(file); });
}

void Application::choosePlantFile() {
  FileDialogOptions options;
  options.title = "Add a plant from glTF";
  options.filters = {{"glTF meshes", {".glb", ".gltf"}}};
  chooseFile(std::move(options), [this](const fs::path& file) { addPlantFrom(file); });
}

void Application::save(const std::function<void()>& then) {
  m_document->closeStep();
  if (m_document->file().empty()) return saveAs(then);
  const auto saved = saveDocument(*m_document);
  if (!saved.ok()) return m_dialogs.showError("The project was not saved", saved.error());
  saveDone(then);
}

void Application::saveAs(const std::function<void()>& then) {
  FileDialogOptions options;
  options.mode = FileDialogMode::Save;
  options.title = "Save the project";
  options.filters = {{"Sward projects", {".sward"}}};
  options.name = m_document->file().empty() ? "meadow.sward" : m_document->file().filename().string();
  options.extension = ".sward";
  chooseFile(std::move(options), [this, then](const fs::path& file) {
    m_document->closeStep();
    const auto saved = saveDocumentAs(*m_document, withProjectExtension(file));
    if (!saved.ok()) return m_dialogs.showError("The project was not saved", saved.error());
    saveDone(then);
  });
}

void Application::saveDone(const std::function<void()>& then) {
  m_autosave.clear();
  m_preferences.addRecent(m_document->file());
  m_watch.watchProject(m_document->file(), m_document->snapshot());
  notice("Saved " + m_document->file().filename().string());
  if (then) then();
}

void Application::revert() {
  m_document->closeStep();
  const auto reverted = revertDocument(*m_document);
  if (!reverted.ok()) return m_dialogs.showError("The file cannot be read", reverted.error());
  m_watch.watchProject(m_document->file(), m_document->snapshot());
  afterHistory();
}

void Application::recoverFrom(const fs::path& autosave) {
  auto recovered = recover(autosave, m_autosave);
  if (!recovered.ok()) return m_dialogs.showError("The copy cannot be used", recovered.error());
  showDocument(std::move(*recovered));
}

void Application::autosave() {
  if (m_options.unattended) return;
  const auto wrote = m_autosave.update(*m_document, std::chrono::steady_clock::now(), m_preferences.autosaveSeconds);
  if (!wrote.ok()) {
    notice("No copy for recovery could be written: " + wrote.error().text());
  } else if (*wrote) {
    m_autosavedRevision = m_document->revision();
    m_noticed = true;
  }
}

void Application::whenSaved(const std::function<void()>& then) {
  m_document->closeStep();
  if (!m_document->modified()) return then();
  const std::string name = m_document->file().empty() ? "The new project" : m_document->file().filename().string();
  m_dialogs.askUnsaved(
      name, [this, then] { save(then); }, then);
}

void Application::addPlantFrom(const fs::path& mesh) {
  const auto imported = bake::plantFromMesh(mesh, m_document->project(), m_document->project().folder);
  if (!imported.ok()) return m_dialogs.showError("The mesh cannot be used", imported.error());
  std::optional<std::size_t> added;
  const auto add = [&](project::Project& p) {
    added = addPlant(p, imported->plant);
    p.sampling.slices = imported->slices;
  };
  edit("add " + imported->plant.name, add, {});
  if (added) m_ui.selection = selectPlant(m_document->project(), *added);
}

void Application::dropped(const std::vector<fs::path>& files) {
  for (const fs::path& file : files) {
    const std::string extension = lowerExtension(file);
    if (extension == ".sward") {
      open(file);
    } else if (extension == ".glb" || extension == ".gltf") {
      addPlantFrom(file);
    } else if (std::find(kPictures.begin(), kPictures.end(), extension) != kPictures.end()) {
      edit("soil texture", [&](project::Project& p) { p.patch.soil.texture = project::assetPath(file, p.folder); }, {});
      m_ui.selection = {};
    } else {
      notice("\"" + file.filename().string() + "\" is no project, glTF mesh or image");
    }
  }
}

void Application::browse(const std::string& where, const std::string& files) {
  FileDialogOptions options;
  options.title = "Choose a file";
  std::vector<std::string> endings;
  for (std::size_t at = 0; at < files.size();) {
    const std::size_t space = std::min(files.find(' ', at), files.size());
    endings.push_back(files.substr(at, space - at));
    at = space + 1;
  }
  if (!endings.empty()) options.filters = {{files, endings}};
  chooseFile(std::move(options), [this, where](const fs::path& file) {
    edit("choose file", [&](project::Project& p) { (void)project::relocate(p, where, file); }, {});
  });
}

void Application::chooseOutput(const std::function<void(const fs::path&)>& then) {
  FileDialogOptions options;
  options.mode = FileDialogMode::Save;
  options.title = "Write the picture to";
  options.filters = {{"Pictures", {".png", ".exr"}}};
  options.name = "meadow.png";
  options.extension = ".png";
  chooseFile(std::move(options), then);
}

void Application::chooseFile(FileDialogOptions options, std::function<void(const fs::path&)> then) {
  options.folder = m_document->file().empty() ? fs::current_path() : m_document->file().parent_path();
  if (!m_document->file().empty()) options.places.emplace_back("Project", m_document->file().parent_path());
  std::vector<fs::path> seen;
  for (const fs::path& recent : m_preferences.recentFiles) {
    const fs::path folder = recent.parent_path();
    if (std::find(seen.begin(), seen.end(), folder) != seen.end()) continue;
    seen.push_back(folder);
    options.places.emplace_back(folder.filename().string(), folder);
  }
  m_fileChosen = std::move(then);
  m_fileDialog.open(std::move(options));
}

void Application::watchFiles() {
  if (m_watchedRevision != m_document->revision()) {
    m_watchedRevision = m_document->revision();
    std::vector<fs::path> files;
    for (const project::AssetReference& asset : project::assets(m_document->project()))
      files.push_back(m_document->project().resolve(asset.path));
    m_watch.watchAssets(files);
  }
  for (const FileEvent& event : m_watch.poll(std::chrono::steady_clock::now())) {
    const std::string name = event.file.filename().string();
    if (!event.isProject) {
      const bool gone = event.what == FileEvent::What::Removed;
      notice("\"" + name + (gone ? "\" is gone" : "\" changed on disk: baked again"));
      m_live->rebake();
    } else if (event.what == FileEvent::What::Removed) {
      notice("The project's file was removed by another program; save to write it again");
    } else if (m_document->modified()) {
      m_dialogs.askReload(name, [this] { revert(); });
    } else {
      revert();
      notice("Loaded anew: another program changed \"" + name + "\"");
    }
  }
}

void Application::closeRequested() {
  whenSaved([this] { m_quit = true; });
}

}  // namespace sward::editor
