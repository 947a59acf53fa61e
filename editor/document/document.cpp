#include "document/document.h"

#include "project/assets.h"

#include <algorithm>
#include <atomic>

namespace sward::editor {
namespace {

/// Revisions are told apart across documents, so that a bake of the one closed is never taken for one of the next.
std::uint64_t nextRevision() {
  static std::atomic<std::uint64_t> counter{0};
  return ++counter;
}

}  // namespace

Document::Document(project::Project project, std::filesystem::path file)
    : m_revision(nextRevision()), m_file(std::move(file)) {
  m_states.push_back({std::make_shared<const project::Project>(std::move(project)), {}});
}

std::string Document::title() const {
  if (!m_file.empty()) return m_file.filename().string();
  return project().name.empty() ? "Untitled" : project().name;
}

bool Document::edit(const std::string& name, const std::function<void(project::Project&)>& change,
                    const std::string& mergeKey) {
  auto changed = std::make_shared<project::Project>(project());
  change(*changed);
  if (*changed == project()) return false;
  const bool joins = !mergeKey.empty() && mergeKey == m_mergeKey;
  if (!joins) {
    closeStep();
    // Before anything is added: what was undone is gone, and with it a saved state that lay there.
    m_states.resize(m_position + 1);
    if (m_savedPosition != kNowhere && m_savedPosition > m_position) m_savedPosition = kNowhere;
    m_states.push_back({nullptr, name});
    ++m_position;
    m_mergeKey = mergeKey;
  }
  m_states[m_position].snapshot = std::move(changed);
  m_revision = nextRevision();
  return true;
}

void Document::closeStep() {
  if (m_mergeKey.empty()) return;
  m_mergeKey.clear();
  // An open step is the last one, and was not saved: markSaved closes it.
  if (*m_states[m_position].snapshot == *m_states[m_position - 1].snapshot) {
    m_states.pop_back();
    --m_position;
  }
}

std::string Document::undoName() const {
  return canUndo() ? m_states[m_position].step : std::string();
}

std::string Document::redoName() const {
  return canRedo() ? m_states[m_position + 1].step : std::string();
}

void Document::moveTo(std::size_t position) {
  if (position == m_position) return;
  m_position = position;
  m_revision = nextRevision();
}

void Document::undo() {
  closeStep();
  if (canUndo()) moveTo(m_position - 1);
}

void Document::redo() {
  closeStep();
  if (canRedo()) moveTo(m_position + 1);
}

void Document::goTo(std::size_t position) {
  closeStep();
  moveTo(std::min(position, m_states.size() - 1));
}

std::vector<std::string> Document::stepNames() const {
  std::vector<std::string> names;
  for (std::size_t i = 1; i < m_states.size(); ++i) names.push_back(m_states[i].step);
  return names;
}

void Document::markSaved(const std::filesystem::path& file) {
  closeStep();
  m_savedPosition = m_position;
  m_file = file;
  project::AssetRebase rebase(file.parent_path());
  const Snapshot before = snapshot();
  for (State& state : m_states) {
    if (state.snapshot->folder == file.parent_path()) continue;
    auto there = std::make_shared<project::Project>(*state.snapshot);
    rebase.apply(*there);
    state.snapshot = std::move(there);
  }
  if (!(project() == *before)) m_revision = nextRevision();
}

}  // namespace sward::editor
