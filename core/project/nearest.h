#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace sward::project {

/// The name of `known` that a person may have meant by `given`: the nearest by edit distance (case ignored), or empty
/// when none is near.
std::string nearestName(std::string_view given, const std::vector<std::string>& known);

}  // namespace sward::project
