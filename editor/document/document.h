#pragma once

#include "project/project.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace sward::editor {

/// A state of the project that never changes; bakes and pictures hold on to the one that they were asked for.
using Snapshot = std::shared_ptr<const project::Project>;

/// The project being edited, with its history. Every state is an immutable snapshot, so that undoing returns the very
/// value and a job may read its own while edits go on. Belongs to the UI thread.
class Document {
 public:
  /// `file` may be empty: the project was never saved.
  explicit Document(project::Project project = {}, std::filesystem::path file = {});

  const project::Project& project() const { return *m_states[m_position].snapshot; }
  Snapshot snapshot() const { return m_states[m_position].snapshot; }
  /// Another number after every change of the project, by edit, undo or redo; never one that was seen before, by this
  /// or any other document of the process.
  std::uint64_t revision() const { return m_revision; }
  const std::filesystem::path& file() const { return m_file; }
  /// What to call the document in a window's title: its file's name, or the project's, or "Untitled".
  std::string title() const;

  /// Applies a change as one step named for people, such as "blade height"; clears what could be redone. While the step
  /// of the same `mergeKey` (such as a value's path) is open, the change joins it: one drag is one step. An empty key
  /// never joins. False, and no step, when the change changes nothing; a change that throws leaves the document alone.
  bool edit(const std::string& name, const std::function<void(project::Project&)>& change,
            const std::string& mergeKey = {});
  /// Ends the open step: the next edit starts one of its own. A merged step that came back to where it began is
  /// dropped. Undo, redo and saving end it too.
  void closeStep();

  bool canUndo() const { return m_position > 0; }
  bool canRedo() const { return m_position + 1 < m_states.size(); }
  /// Name of the step that undo() would take back; empty when there is none.
  std::string undoName() const;
  std::string redoName() const;
  void undo();
  void redo();
  /// Undoes or redoes until `position` steps are applied; a position beyond the last step means the last.
  void goTo(std::size_t position);
  /// Names of all steps, oldest first, and how many of them are applied.
  std::vector<std::string> stepNames() const;
  std::size_t position() const { return m_position; }

  /// The project differs from what was saved (or from what it started as).
  bool modified() const { return m_position != m_savedPosition; }
  /// Says that the present state lies in `file` now. Where the folder is another, every state of the history moves
  /// along: relative asset paths are rewritten so that they name the same files from there (see project::rebaseAssets).
  void markSaved(const std::filesystem::path& file);
  /// A recovered project differs from its file from the start.
  void markUnsaved() { m_savedPosition = kNowhere; }

 private:
  static constexpr std::size_t kNowhere = static_cast<std::size_t>(-1);
  struct State {
    Snapshot snapshot;
    std::string step;  ///< name of the step that led here; empty for the first
  };
  void moveTo(std::size_t position);

  std::vector<State> m_states;
  std::size_t m_position = 0;
  std::size_t m_savedPosition = 0;
  std::uint64_t m_revision;
  std::string m_mergeKey;  ///< of the open step, which is then the last one; empty when none is open
  std::filesystem::path m_file;
};

}  // namespace sward::editor
