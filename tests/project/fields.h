#pragma once

#include <functional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace sward::project::test {

using Json = nlohmann::ordered_json;

/// Every scalar of a document with its pointer, deepest first or not: the order of the document.
inline std::vector<Json::json_pointer> leaves(const Json& json, const Json::json_pointer& at = Json::json_pointer()) {
  std::vector<Json::json_pointer> out;
  if (!json.is_structured()) return {at};
  for (auto item = json.begin(); item != json.end(); ++item) {
    const Json::json_pointer place =
        json.is_object() ? at / item.key() : at / static_cast<std::size_t>(item - json.begin());
    for (auto& leaf : leaves(item.value(), place)) out.push_back(std::move(leaf));
  }
  return out;
}

}  // namespace sward::project::test
