#pragma once

#include <filesystem>

namespace sward::editor {

/// Where preferences lie: $XDG_CONFIG_HOME/sward, else ~/.config/sward. Not created here. A variable that is not an
/// absolute path is ignored, as the XDG base directory specification 0.8 asks. Empty when there is no home either.
std::filesystem::path configFolder();

/// Where state lies that should outlive the program but is no document: $XDG_STATE_HOME/sward, else
/// ~/.local/state/sward.
std::filesystem::path stateFolder();

}  // namespace sward::editor
