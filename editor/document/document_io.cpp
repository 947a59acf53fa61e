#include "document/document_io.h"

#include "project/assets.h"

namespace sward::editor {
namespace {

namespace fs = std::filesystem;

fs::path absolutePath(const fs::path& file) {
  std::error_code code;
  const fs::path absolute = fs::absolute(file, code);
  return code ? file : absolute.lexically_normal();
}

}  // namespace

Result<Document> openDocument(const fs::path& file) {
  const fs::path absolute = absolutePath(file);
  SWARD_ASSIGN(project::Project project, project::load(absolute));
  return Document(std::move(project), absolute);
}

Result<Document> newDocument(const std::string& templateName) {
  SWARD_ASSIGN(project::Project project, project::fromTemplate(templateName));
  return Document(std::move(project));
}

Result<void> saveDocument(Document& document) {
  if (document.file().empty()) {
    return Error::badInput("the project has no file yet", document.title(), "Choose one with Save As.");
  }
  return saveDocumentAs(document, document.file());
}

Result<void> saveDocumentAs(Document& document, const fs::path& file) {
  if (!file.has_filename()) return Error::badInput("no file is named", file.string(), "Give the name of a file.");
  const fs::path absolute = absolutePath(file);
  project::Project there = document.project();
  if (there.folder != absolute.parent_path()) project::AssetRebase(absolute.parent_path()).apply(there);
  SWARD_TRY(project::save(there, absolute));
  document.markSaved(absolute);
  return {};
}

Result<bool> revertDocument(Document& document) {
  if (document.file().empty()) {
    return Error::badInput("the project has no file yet", document.title(), "Undo its changes one by one.");
  }
  SWARD_ASSIGN(project::Project saved, project::load(document.file()));
  document.closeStep();
  const bool changed = document.edit("revert to saved", [&](project::Project& p) { p = std::move(saved); });
  document.markSaved(document.file());
  return changed;
}

fs::path withProjectExtension(fs::path file) {
  if (file.has_filename() && !file.has_extension()) file += ".sward";
  return file;
}

}  // namespace sward::editor
