#pragma once

#include "app/shortcut.h"

#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace sward::editor {

/// Something the user can do. One registered action drives menu, shortcut, toolbar and palette.
struct Action {
  std::string id = {};     ///< such as "file.save"; unique
  std::string menu = {};   ///< the menu it stands in, such as "File"; empty: palette alone
  std::string label = {};  ///< such as "Save as..."
  std::string help = {};   ///< tooltip: what it does, in a sentence
  const char* icon = "";
  std::vector<Shortcut> shortcuts = {};  ///< the first is shown
  std::function<void()> run = {};
  std::function<bool()> enabled = {};              ///< empty: always
  std::function<bool()> checked = {};              ///< empty: not a toggle
  std::function<std::string()> currentLabel = {};  ///< empty: `label`; "Undo: blade height"
  bool separatorBefore = false;

  bool isEnabled() const { return !enabled || enabled(); }
  bool isChecked() const { return checked && checked(); }
  std::string text() const { return currentLabel ? currentLabel() : label; }
};

/// All actions in the order of their menus.
class ActionTable {
 public:
  /// Ids must be new and shortcuts not taken: a broken contract otherwise.
  Action& add(Action action);
  const Action* find(std::string_view id) const;
  const std::vector<Action>& all() const { return m_actions; }
  /// Runs an enabled action; false when it is unknown or disabled.
  bool run(std::string_view id) const;
  /// The action that a key press asks for; none while text is typed and the shortcut is a plain key.
  const Action* forShortcut(const Shortcut& pressed, bool typing) const;
  /// Actions whose label, menu or id contain the letters of `query` in order, the best match first; all for an empty
  /// query.
  std::vector<const Action*> search(std::string_view query) const;

 private:
  std::vector<Action> m_actions;
};

/// How well `text` matches `query`: nothing when its letters do not all occur in order (case ignored); higher is
/// better, with runs of letters and starts of words counting most.
int matchScore(std::string_view query, std::string_view text);

}  // namespace sward::editor
