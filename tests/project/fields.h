#pragma once

#include "project/words.h"

#include <functional>
#include <optional>
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

/// Another value of the same type that the field can hold.
inline Json changed(const Json& value) {
  if (value.is_boolean()) return !value.get<bool>();
  if (value.is_number_float()) return value.get<double>() + 0.015625;
  if (value.is_number()) return value.get<int>() + 1;
  const auto text = value.get<std::string>();
  const auto swapTo = [&](auto e) -> std::optional<std::string> {
    using E = decltype(e);
    if (!fromWord<E>(text)) return std::nullopt;
    for (const auto& word : words(E{})) {
      if (word.text != text) return std::string(word.text);
    }
    return std::nullopt;
  };
  for (const auto& word :
       {swapTo(PlantKind{}), swapTo(scene::LightPattern{}), swapTo(lpt::Basis{}), swapTo(lpt::LayerCoordinate{}),
        swapTo(tiles::SeamMethod{}), swapTo(tiles::SeamDomain{}), swapTo(tiles::MapMethod{}),
        swapTo(render::GroundMethod{}), swapTo(render::ViewTransform{}), swapTo(report::ErrorBound{}),
        swapTo(terrain::Source{}), swapTo(wither::Autumn{}), swapTo(leaf::LeafOptions::Model{})}) {
    if (word) return *word;
  }
  return Json(text + "x");
}

}  // namespace sward::project::test
