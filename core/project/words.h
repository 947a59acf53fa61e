#pragma once

#include "project/project.h"

#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace sward::project {

/// An enumerator, its lower-case word in files and on the command line, and its name and meaning for people.
template <typename E>
struct Word {
  E value;
  std::string_view text;
  const char* label;
  const char* help;
};

/// words(E{}) lists every word of an enumeration; the files, the command line, messages and editors read these tables.
constexpr auto words(PlantKind) {
  return std::array<Word<PlantKind>, 4>{
      {{PlantKind::Grass, "grass", "Grass", "A tuft of blades, with seed heads if wanted."},
       {PlantKind::Flower, "flower", "Flower", "A stem with leaves and one head of petals."},
       {PlantKind::Clover, "clover", "Clover", "Stems with three leaflets each, and round flower heads."},
       {PlantKind::Gltf, "gltf", "Mesh file", "A plant of your own, from a glTF file."}}};
}
constexpr auto words(scene::LightPattern) {
  return std::array<Word<scene::LightPattern>, 4>{
      {{scene::LightPattern::Fibonacci, "fibonacci", "Fibonacci", "Evenly over the whole sky, any number of lights."},
       {scene::LightPattern::List, "list", "List", "Directions that you place one by one."},
       {scene::LightPattern::Rings, "rings", "Rings", "Rings at chosen heights, with one light above."},
       {scene::LightPattern::SunPath, "sun_path", "Sun path",
        "Where the sun passes on some dates at a latitude; elsewhere relighting is a guess."}}};
}
constexpr auto words(lpt::Basis) {
  return std::array<Word<lpt::Basis>, 7>{
      {{lpt::Basis::Lpt, "lpt", "Layered (LPT)", "One polynomial for a whole column of layers: small and smooth."},
       {lpt::Basis::Ptm, "ptm", "Per layer (PTM)", "One polynomial for every texel of a layer: truer and larger."},
       {lpt::Basis::Constant, "constant", "Constant",
        "One value for every texel, whatever the light: least memory, no moving shadows."},
       {lpt::Basis::Clustered, "clustered", "Clustered LPT",
        "Two or four polynomials for a column: between the two above. Each new sun takes a moment."},
       {lpt::Basis::Hsh, "hsh", "Harmonics (HSH)",
        "Four harmonics for every texel, for comparison. Each new sun takes a moment."},
       {lpt::Basis::Marched, "marched", "Marched shadows",
        "Shadows marched through the plants' own density: truest, bakes no lights. Each new sun takes a moment."},
       {lpt::Basis::Sampled, "sampled", "Traced for this sun",
        "Nothing is fitted: light is traced for the sun as it stands, and again for each new one."}}};
}
constexpr auto words(lpt::LayerCoordinate) {
  return std::array<Word<lpt::LayerCoordinate>, 2>{
      {{lpt::LayerCoordinate::Response, "response", "Expected light",
        "How bright the sky and the plants above let each texel be: much truer, at the same size."},
       {lpt::LayerCoordinate::Depth, "depth", "Depth", "The layer's depth alone, as first published."}}};
}
constexpr auto words(report::ErrorBound) {
  return std::array<Word<report::ErrorBound>, 5>{
      {{report::ErrorBound::None, "none", "None", "What the project says is baked, whatever its error."},
       {report::ErrorBound::Rmse, "rmse", "RMSE", "Root mean square difference of display values, 0 to 1."},
       {report::ErrorBound::Psnr, "psnr", "PSNR", "Peak signal to noise of display values, dB: at least."},
       {report::ErrorBound::Ssim, "ssim", "SSIM", "Structural similarity of display values, 0 to 1: at least."},
       {report::ErrorBound::Flip, "flip", "FLIP", "What an eye notices when it flips between the two, 0 to 1."}}};
}
constexpr auto words(terrain::Source) {
  return std::array<Word<terrain::Source>, 3>{{{terrain::Source::Flat, "flat", "Flat", "Level ground without end."},
                                               {terrain::Source::Hills, "hills", "Hills", "Hills grown from a seed."},
                                               {terrain::Source::Heightmap, "heightmap", "Heightmap",
                                                "Heights from an image (PNG, TIFF, EXR) or an ESRI ASCII grid."}}};
}
constexpr auto words(tiles::SeamMethod) {
  return std::array<Word<tiles::SeamMethod>, 2>{
      {{tiles::SeamMethod::DynamicProgramming, "dynamic_programming", "Straight scan",
        "Dynamic programming from end to end: fast, and the seam never turns back."},
       {tiles::SeamMethod::GraphCut, "graph_cut", "Graph cut",
        "The cheapest seam of any form: slower, better round large leaves."}}};
}
constexpr auto words(tiles::SeamDomain) {
  return std::array<Word<tiles::SeamDomain>, 2>{
      {{tiles::SeamDomain::Disc, "disc", "Real lights", "All directions that a light can have."},
       {tiles::SeamDomain::Square, "square", "Square (paper)",
        "The square round them, as first published; its corners are no lights."}}};
}
constexpr auto words(tiles::MapMethod) {
  return std::array<Word<tiles::MapMethod>, 2>{
      {{tiles::MapMethod::ScanOrder, "scan_order", "One by one",
        "Laid in rows, each tile chosen to fit its neighbours."},
       {tiles::MapMethod::Hashed, "hashed", "Hashed",
        "Each tile follows from its place alone; needs every tile there is."}}};
}
constexpr auto words(leaf::LeafOptions::Model) {
  using Model = leaf::LeafOptions::Model;
  return std::array<Word<Model>, 2>{
      {{Model::Plates, "plates", "Plates", "Light through layers that absorb: the truer, and straw is bright."},
       {Model::Subtraction, "subtraction", "Subtraction", "Light minus what pigments absorb, as first published."}}};
}
constexpr auto words(wither::Autumn) {
  return std::array<Word<wither::Autumn>, 4>{
      {{wither::Autumn::Normal, "normal", "Normal autumn", "Leaves yellow, then dry and fall."},
       {wither::Autumn::AmpleWater, "ample_water", "Ample water", "Leaves yellow but keep their water and stand."},
       {wither::Autumn::LowTemperature, "low_temperature", "Early cold", "Green and water go early and fast."},
       {wither::Autumn::Custom, "custom", "Own curves", "Water and chlorophyll follow curves of your own."}}};
}
constexpr auto words(render::GroundMethod) {
  return std::array<Word<render::GroundMethod>, 4>{
      {{render::GroundMethod::March, "march", "March",
        "Follows each ray through the layers, front to back: true parallax, and the fastest."},
       {render::GroundMethod::BlendedNormalised, "blended", "Blended planes",
        "Draws slices and blades as planes over one another, weighted by the view."},
       {render::GroundMethod::BlendedPaper, "blended_paper", "Blended (paper)",
        "The same with the published weights, for comparison."},
       {render::GroundMethod::Texels, "texels", "Texels",
        "Marches through a block of voxels, which withers at once; no layers are baked."}}};
}
constexpr auto words(render::ViewTransform) {
  return std::array<Word<render::ViewTransform>, 2>{
      {{render::ViewTransform::Filmic, "filmic", "Filmic", "Highlights roll off softly, as on film."},
       {render::ViewTransform::Standard, "standard", "Standard",
        "Plain sRGB; whatever is brighter than white clips."}}};
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
