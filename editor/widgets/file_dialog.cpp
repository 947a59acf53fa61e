#include "widgets/file_dialog.h"

#include "widgets/theme.h"

#include <algorithm>
#include <cstdlib>

#include <imgui.h>

namespace sward::editor {
namespace {

namespace fs = std::filesystem;

fs::path homeFolder() {
  const char* home = std::getenv("HOME");
  return home != nullptr && *home != '\0' ? fs::path(home) : fs::path("/");
}

/// The folder itself, or the nearest one above it that can be listed.
fs::path readableFolder(fs::path folder) {
  std::error_code code;
  folder = fs::absolute(folder.empty() ? homeFolder() : folder, code).lexically_normal();
  while (folder.has_parent_path() && folder != folder.parent_path()) {
    if (!folder.has_filename()) folder = folder.parent_path();  // "a/b/" as "a/b"
    const fs::directory_iterator probe(folder, code);
    if (!code) return folder;
    folder = folder.parent_path();
  }
  return folder.empty() ? fs::path("/") : folder;
}

}  // namespace

void FileDialog::open(FileDialogOptions options) {
  m_options = std::move(options);
  if (m_options.filters.empty()) m_options.filters.push_back({"All files", {}});
  m_open = m_appearing = true;
  m_name = m_options.name;
  m_filter = 0;
  m_ask = Ask::None;
  m_typingPath = false;
  m_typed.clear();
  enter(readableFolder(m_options.folder));
}

void FileDialog::close() {
  m_open = false;
  m_ask = Ask::None;
}

const FileFilter& FileDialog::filter() const {
  return m_options.filters[std::min(m_filter, m_options.filters.size() - 1)];
}

void FileDialog::enter(const fs::path& folder) {
  m_folder = folder;
  m_selected.reset();
  refresh();
}

void FileDialog::refresh() {
  const std::string kept = m_selected && *m_selected < m_entries.size() ? m_entries[*m_selected].name : "";
  m_error.clear();
  m_entries.clear();
  m_selected.reset();
  // Choosing a folder shows no files: an extension that none has.
  const FileFilter none{"", {"/"}};
  auto found = listFolder(m_folder, m_options.mode == FileDialogMode::Folder ? none : filter(), m_hidden);
  if (!found.ok()) {
    m_error = found.error().text();
    return;
  }
  m_entries = std::move(found).value();
  sortEntries(m_entries, m_sort, m_descending);
  for (std::size_t i = 0; i < m_entries.size(); ++i) {
    if (!kept.empty() && m_entries[i].name == kept) m_selected = i;
  }
}

void FileDialog::goUp() {
  const std::string left = m_folder.filename().string();
  const fs::path parent = m_folder.parent_path();
  if (parent.empty() || parent == m_folder) return;
  enter(parent);
  // The folder that one came from stays in sight.
  for (std::size_t i = 0; i < m_entries.size(); ++i) {
    if (m_entries[i].name == left) pick(i);
  }
}

void FileDialog::pick(std::size_t index) {
  if (index >= m_entries.size()) return;
  m_selected = index;
  m_scrollToSelected = true;
  if (m_options.mode == FileDialogMode::Save && !m_entries[index].folder) m_name = m_entries[index].name;
}

void FileDialog::step(int by) {
  if (m_entries.empty()) return;
  const int last = static_cast<int>(m_entries.size()) - 1;
  const int from = m_selected ? static_cast<int>(*m_selected) : (by > 0 ? -1 : last + 1);
  pick(static_cast<std::size_t>(std::clamp(from + by, 0, last)));
}

std::optional<fs::path> FileDialog::activate(std::size_t index) {
  if (index >= m_entries.size()) return std::nullopt;
  pick(index);
  if (m_entries[index].folder) {
    enter(m_folder / m_entries[index].name);
    return std::nullopt;
  }
  return accept();
}

fs::path FileDialog::target() const {
  if (m_options.mode == FileDialogMode::Save) {
    std::string name = m_name;
    if (!filter().matches(name) || filter().extensions.empty()) {
      const bool has = fs::path(name).has_extension() && filter().extensions.empty();
      if (!has && !name.ends_with(m_options.extension)) name += m_options.extension;
    }
    return m_folder / name;
  }
  if (m_selected && *m_selected < m_entries.size()) return m_folder / m_entries[*m_selected].name;
  return m_options.mode == FileDialogMode::Folder ? m_folder : fs::path();
}

std::optional<fs::path> FileDialog::accept() {
  std::error_code code;
  if (m_options.mode == FileDialogMode::Save) {
    m_error = nameProblem(m_name);
    if (!m_error.empty()) return std::nullopt;
    const fs::path file = target();
    if (fs::is_directory(file, code)) {
      m_error = "\"" + file.filename().string() + "\" is a folder; give another name.";
      return std::nullopt;
    }
    if (fs::exists(file, code) && m_ask != Ask::Overwrite) {
      m_ask = Ask::Overwrite;
      m_askAppearing = true;
      return std::nullopt;
    }
    close();
    return file;
  }
  const fs::path chosen = target();
  if (chosen.empty()) return std::nullopt;
  if (m_options.mode == FileDialogMode::Open && fs::is_directory(chosen, code)) {
    enter(chosen);
    return std::nullopt;
  }
  close();
  return chosen;
}

std::optional<fs::path> FileDialog::acceptTyped() {
  std::string text = m_path;
  if (text.starts_with("~")) text = homeFolder().string() + text.substr(1);
  fs::path typed(text);
  if (typed.is_relative()) typed = m_folder / typed;
  typed = typed.lexically_normal();
  std::error_code code;
  if (fs::is_directory(typed, code)) {
    m_typingPath = false;
    enter(readableFolder(typed));
    return std::nullopt;
  }
  if (m_options.mode == FileDialogMode::Save && fs::is_directory(typed.parent_path(), code)) {
    m_typingPath = false;
    enter(typed.parent_path());
    m_name = typed.filename().string();
    return std::nullopt;
  }
  if (m_options.mode == FileDialogMode::Open && fs::is_regular_file(typed, code)) {
    close();
    return typed;
  }
  m_error = "There is nothing called \"" + typed.string() + "\".";
  return std::nullopt;
}

bool FileDialog::createFolder() {
  m_error = nameProblem(m_newName);
  if (!m_error.empty()) return false;
  std::error_code code;
  const fs::path made = m_folder / m_newName;
  if (!fs::create_directory(made, code)) {
    m_error = "The folder \"" + m_newName + "\" cannot be made: " + (code ? code.message() : "it exists already") + ".";
    return false;
  }
  enter(made);
  return true;
}

}  // namespace sward::editor
