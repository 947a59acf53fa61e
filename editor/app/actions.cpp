#include "app/actions.h"

#include "base/check.h"

#include <algorithm>
#include <cctype>

namespace sward::editor {
namespace {

char lower(char c) {
  return static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
}

bool startsWord(std::string_view text, std::size_t at) {
  return at == 0 || std::isalnum(static_cast<unsigned char>(text[at - 1])) == 0;
}

}  // namespace

Action& ActionTable::add(Action action) {
  SWARD_CHECK(find(action.id) == nullptr);
  for (const Shortcut& shortcut : action.shortcuts) SWARD_CHECK(forShortcut(shortcut, false) == nullptr);
  m_actions.push_back(std::move(action));
  return m_actions.back();
}

const Action* ActionTable::find(std::string_view id) const {
  const auto found = std::find_if(m_actions.begin(), m_actions.end(), [&](const Action& a) { return a.id == id; });
  return found == m_actions.end() ? nullptr : &*found;
}

bool ActionTable::run(std::string_view id) const {
  const Action* action = find(id);
  if (action == nullptr || !action->isEnabled()) return false;
  action->run();
  return true;
}

const Action* ActionTable::forShortcut(const Shortcut& pressed, bool typing) const {
  if (pressed.empty() || (typing && pressed.plain())) return nullptr;
  for (const Action& action : m_actions)
    if (std::find(action.shortcuts.begin(), action.shortcuts.end(), pressed) != action.shortcuts.end()) return &action;
  return nullptr;
}

std::vector<const Action*> ActionTable::search(std::string_view query) const {
  std::vector<std::pair<int, const Action*>> found;
  for (const Action& action : m_actions) {
    const int score =
        std::max(matchScore(query, action.text()) * 2, matchScore(query, action.menu + " " + action.label));
    if (query.empty() || score > 0) found.emplace_back(score, &action);
  }
  std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  std::vector<const Action*> actions;
  for (const auto& [score, action] : found) actions.push_back(action);
  return actions;
}

int matchScore(std::string_view query, std::string_view text) {
  constexpr int kLetter = 1, kRun = 3, kWordStart = 4;
  int score = 0;
  std::size_t at = 0;
  bool inRun = false;
  for (const char wanted : query) {
    if (wanted == ' ') {
      inRun = false;
      continue;
    }
    const std::size_t from = at;
    while (at < text.size() && lower(text[at]) != lower(wanted)) ++at;
    if (at == text.size()) return 0;
    score += kLetter;
    if (inRun && at == from) score += kRun;
    if (startsWord(text, at)) score += kWordStart;
    inRun = true;
    ++at;
  }
  return score;
}

}  // namespace sward::editor
