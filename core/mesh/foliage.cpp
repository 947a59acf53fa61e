#include "mesh/foliage.h"

#include "mesh/parts.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <limits>
#include <set>
#include <string_view>

namespace sward::mesh {
namespace {

constexpr std::array kWoodWords{std::string_view("bark"),   std::string_view("trunk"),    std::string_view("wood"),
                                std::string_view("branch"), std::string_view("branches"), std::string_view("twig"),
                                std::string_view("twigs"),  std::string_view("stem"),     std::string_view("log"),
                                std::string_view("stamm"),  std::string_view("rinde"),    std::string_view("holz"),
                                std::string_view("tronc"),  std::string_view("ecorce")};
constexpr std::array kLeafWords{
    std::string_view("leaf"),   std::string_view("leaves"),  std::string_view("leef"),    std::string_view("foliage"),
    std::string_view("needle"), std::string_view("needles"), std::string_view("canopy"),  std::string_view("crown"),
    std::string_view("frond"),  std::string_view("fronds"),  std::string_view("blatt"),   std::string_view("blaetter"),
    std::string_view("laub"),   std::string_view("nadeln"),  std::string_view("feuille"), std::string_view("feuilles"),
    std::string_view("folia"),  std::string_view("blossom"), std::string_view("flower"),  std::string_view("fruit")};

/// Letters of a name in words: "Leaves1", "treeBark_02", "OakLeaf" are leaves; tree, bark; oak, leaf.
std::vector<std::string> wordsOf(const std::string& name) {
  std::vector<std::string> words;
  std::string word;
  const auto finish = [&] {
    if (!word.empty()) words.push_back(std::move(word));
    word.clear();
  };
  bool lower = false;
  for (const char c : name) {
    const auto letter = static_cast<unsigned char>(c);
    if (std::isalpha(letter) == 0) {
      finish();
    } else {
      if (std::isupper(letter) != 0 && lower) finish();
      word += static_cast<char>(std::tolower(letter));
    }
    lower = std::islower(letter) != 0;
  }
  finish();
  return words;
}

template <std::size_t N>
bool holds(const std::vector<std::string>& words, const std::array<std::string_view, N>& of) {
  return std::any_of(words.begin(), words.end(),
                     [&](const std::string& word) { return std::find(of.begin(), of.end(), word) != of.end(); });
}

/// What the triangles of a material amount to.
struct Measured {
  double lowest = std::numeric_limits<double>::infinity();
  std::size_t triangles = 0, open = 0;
  std::set<std::uint32_t> parts;
  glm::dvec3 colour{0.0};
};

std::vector<Measured> measured(const Model& model) {
  const Parts parts = findParts(model);
  std::vector<Measured> out(model.materials.size());
  for (std::size_t t = 0; t < model.triangles.size(); ++t) {
    Measured& of = out[model.triangleMaterial[t]];
    ++of.triangles;
    const std::uint32_t part = parts.ofTriangle[t];
    if (parts.open[part]) ++of.open;
    of.parts.insert(part);
    for (int corner = 0; corner < 3; ++corner) {
      of.lowest = std::min(of.lowest, static_cast<double>(model.positions[model.triangles[t][corner]].z));
    }
    of.colour += glm::dvec3(surfaceAt(model, static_cast<std::uint32_t>(t), 1.0f / 3, 1.0f / 3).reflectance);
  }
  for (Measured& of : out) of.colour /= static_cast<double>(std::max<std::size_t>(of.triangles, 1));
  return out;
}

bool isGrey(const glm::dvec3& colour) {
  const double most = std::max({colour.x, colour.y, colour.z}), least = std::min({colour.x, colour.y, colour.z});
  return most - least < 0.2 * most;
}

}  // namespace

std::vector<MaterialPart> treeParts(const Model& model) {
  const std::vector<Measured> of = measured(model);
  const Bounds box = bounds(model);
  const double foot = static_cast<double>(box.low.z) + kFootShare * static_cast<double>(box.high.z - box.low.z);
  const auto used = std::count_if(of.begin(), of.end(), [](const Measured& m) { return m.triangles > 0; });
  std::vector<MaterialPart> parts;
  for (std::size_t i = 0; i < model.materials.size(); ++i) {
    const Material& material = model.materials[i];
    const std::vector<std::string> words = wordsOf(material.name);
    const bool atFoot = of[i].lowest <= foot;
    const bool open = of[i].triangles > 0 && of[i].open == of[i].triangles;
    const bool cards = open && (used > 1 ? !atFoot : of[i].parts.size() > 1);
    if (holds(words, kWoodWords)) {
      parts.push_back({TreePart::Wood, "its name"});
    } else if (holds(words, kLeafWords)) {
      parts.push_back({TreePart::Leaves, "its name"});
    } else if (material.alphaMode != AlphaMode::Opaque) {
      parts.push_back({TreePart::Leaves, "its alpha"});
    } else if (cards) {
      parts.push_back({TreePart::Leaves, "open cards"});
    } else if (atFoot) {
      parts.push_back({TreePart::Wood, "it reaches the foot"});
    } else if (isGrey(of[i].colour)) {
      parts.push_back({TreePart::Wood, "a grey colour"});
    } else {
      parts.push_back({TreePart::Leaves, "it stands above the foot"});
    }
  }
  return parts;
}

std::vector<TreePart> triangleParts(const Model& model, const std::vector<MaterialPart>& parts) {
  std::vector<TreePart> out;
  out.reserve(model.triangles.size());
  for (const std::uint32_t material : model.triangleMaterial) out.push_back(parts[material].part);
  return out;
}

}  // namespace sward::mesh
