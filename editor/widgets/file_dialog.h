#pragma once

#include "widgets/folder_list.h"

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sward::editor {

enum class FileDialogMode { Open, Save, Folder };

struct FileDialogOptions {
  FileDialogMode mode = FileDialogMode::Open;
  std::string title = "Open";
  std::string accept;               ///< text of the button; empty: "Open", "Save" or "Choose"
  std::filesystem::path folder;     ///< where to start; one that cannot be read gives way to its nearest parent
  std::string name;                 ///< for Save: the name that is offered
  std::vector<FileFilter> filters;  ///< the first is chosen; none: all files
  std::string extension;            ///< for Save: added to a name that ends in none of the filter's, ".sward"
  /// Further places beside home and the file system: label and folder, such as the project's and recent ones.
  std::vector<std::pair<std::string, std::filesystem::path>> places;
};

/// The program's own modal dialog for files: breadcrumbs, places, a list that sorts by its columns and jumps to what is
/// typed, filters, hidden files, new folders, and a question before a file is replaced. Keys: arrows, Enter opens,
/// Backspace goes up, Ctrl+H shows hidden files, Ctrl+L types a path, Escape closes. Logs entries as "file:NAME",
/// crumbs as "crumb:I", places as "place:LABEL", buttons as "action:files.accept", "action:files.cancel" and so on.
class FileDialog {
 public:
  void open(FileDialogOptions options);
  bool isOpen() const { return m_open; }
  void close();

  /// Draws it while it is open. The chosen path in the frame when the user accepts it; the dialog is closed then.
  std::optional<std::filesystem::path> draw();

  const std::filesystem::path& folder() const { return m_folder; }
  /// What is shown in red: why the folder, or what was typed, will not do; empty when all is well.
  const std::string& error() const { return m_error; }

 private:
  enum class Ask { None, NewFolder, Overwrite };

  void enter(const std::filesystem::path& folder);
  void refresh();
  void goUp();
  void step(int by);
  void pick(std::size_t index);
  std::optional<std::filesystem::path> activate(std::size_t index);
  std::optional<std::filesystem::path> accept();
  std::optional<std::filesystem::path> acceptTyped();
  bool createFolder();
  std::filesystem::path target() const;
  const FileFilter& filter() const;

  // file_dialog_view.cpp
  void crumbs();
  void toolButtons();
  void places(float height);
  std::optional<std::filesystem::path> list(float height);
  void row(std::size_t index, std::optional<std::filesystem::path>& chosen);
  std::optional<std::filesystem::path> footer();
  std::optional<std::filesystem::path> question();
  std::optional<std::filesystem::path> keys();

  FileDialogOptions m_options;
  bool m_open = false, m_appearing = false;
  std::filesystem::path m_folder;
  std::vector<FolderEntry> m_entries;
  std::string m_error;  ///< why the folder, or what was typed, will not do
  std::optional<std::size_t> m_selected;
  bool m_scrollToSelected = false;
  std::string m_name;  ///< of the file to save, or of a new folder's parent
  std::string m_path;  ///< a typed path; shown instead of the crumbs while m_typingPath
  bool m_typingPath = false, m_focusPath = false;
  std::size_t m_filter = 0;
  bool m_hidden = false;
  bool m_narrow = false;  ///< no room for dates and sizes
  FolderSort m_sort = FolderSort::Name;
  bool m_descending = false;
  Ask m_ask = Ask::None;
  bool m_askAppearing = false;
  std::string m_newName;
  std::string m_typed;  ///< of the list's type-ahead
  double m_typedAt = 0.0;
};

}  // namespace sward::editor
