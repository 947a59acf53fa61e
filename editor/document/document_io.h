#pragma once

#include "document/document.h"

#include <filesystem>
#include <string>

namespace sward::editor {

/// Opens a project file; the document's file is its absolute path. A missing asset is no error (see
/// project::missingAssets); a file that cannot be read or is no project is.
Result<Document> openDocument(const std::filesystem::path& file);

/// A document from a template of project::templateNames(), saved nowhere and not modified.
Result<Document> newDocument(const std::string& templateName);

/// Saves to the document's own file. On an error (read-only, no space, gone folder, no file yet) the file holds what it
/// held and the document stays modified.
Result<void> saveDocument(Document& document);

/// Saves to `file`, which becomes the document's; asset paths are rewritten to name the same files from there, in the
/// whole history. A symbolic link is followed, not replaced. The same promise on errors.
Result<void> saveDocumentAs(Document& document, const std::filesystem::path& file);

/// Goes back to what the document's file says now, as a step that can be undone; the document is unmodified after it.
/// True when that changed the project.
Result<bool> revertDocument(Document& document);

/// `file` with the extension .sward where it has none, for a name typed by a person.
std::filesystem::path withProjectExtension(std::filesystem::path file);

}  // namespace sward::editor
