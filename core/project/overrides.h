#pragma once

#include "base/result.h"

#include <string>

#include <nlohmann/json.hpp>

namespace sward::project {

/// Applies "a.b[0].c=value" to a document. Objects on the way are made when absent (missing keys have defaults); list
/// entries must exist. The value is JSON, or plain text when it is not. Errors say what is wrong with the path.
Result<void> applyOverride(nlohmann::ordered_json& document, const std::string& text);

}  // namespace sward::project
