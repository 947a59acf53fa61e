#pragma once

#include "project/project.h"

#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace sward::project {

/// An enumerator and its lower-case word in files and on the command line.
template <typename E>
struct Word {
  E value;
  std::string_view text;
};

/// words(E{}) lists every word of an enumeration; the files, the command line and messages all read these tables.
constexpr auto words(PlantKind) {
  return std::array<Word<PlantKind>, 4>{{{PlantKind::Grass, "grass"},
                                         {PlantKind::Flower, "flower"},
                                         {PlantKind::Clover, "clover"},
                                         {PlantKind::Gltf, "gltf"}}};
}
constexpr auto words(scene::LightPattern) {
  return std::array<Word<scene::LightPattern>, 2>{
      {{scene::LightPattern::Fibonacci, "fibonacci"}, {scene::LightPattern::List, "list"}}};
}
constexpr auto words(lpt::Basis) {
  return std::array<Word<lpt::Basis>, 2>{{{lpt::Basis::Lpt, "lpt"}, {lpt::Basis::Ptm, "ptm"}}};
}
constexpr auto words(tiles::SeamMethod) {
  return std::array<Word<tiles::SeamMethod>, 2>{
      {{tiles::SeamMethod::DynamicProgramming, "dynamic_programming"}, {tiles::SeamMethod::GraphCut, "graph_cut"}}};
}
constexpr auto words(tiles::SeamDomain) {
  return std::array<Word<tiles::SeamDomain>, 2>{
      {{tiles::SeamDomain::Disc, "disc"}, {tiles::SeamDomain::Square, "square"}}};
}
constexpr auto words(tiles::MapMethod) {
  return std::array<Word<tiles::MapMethod>, 2>{
      {{tiles::MapMethod::ScanOrder, "scan_order"}, {tiles::MapMethod::Hashed, "hashed"}}};
}
constexpr auto words(render::GroundMethod) {
  return std::array<Word<render::GroundMethod>, 3>{{{render::GroundMethod::March, "march"},
                                                    {render::GroundMethod::BlendedNormalised, "blended"},
                                                    {render::GroundMethod::BlendedPaper, "blended_paper"}}};
}
constexpr auto words(render::ViewTransform) {
  return std::array<Word<render::ViewTransform>, 2>{
      {{render::ViewTransform::Filmic, "filmic"}, {render::ViewTransform::Standard, "standard"}}};
}

/// The word of an enumerator; "?" for a value that is none of the enumerators.
template <typename E>
std::string_view wordOf(E value) {
  for (const Word<E>& word : words(E{})) {
    if (word.value == value) return word.text;
  }
  return "?";
}

template <typename E>
std::optional<E> fromWord(std::string_view text) {
  for (const Word<E>& word : words(E{})) {
    if (word.text == text) return word.value;
  }
  return std::nullopt;
}

/// All words of an enumeration, for messages: "march, blended, blended_paper".
template <typename E>
std::string allWords() {
  std::string list;
  for (const Word<E>& word : words(E{})) {
    if (!list.empty()) list += ", ";
    list += word.text;
  }
  return list;
}

}  // namespace sward::project
