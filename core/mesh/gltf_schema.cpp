#include "mesh/gltf_schema.h"

#include <nlohmann/json.hpp>

#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace sward::mesh {
namespace {

using Json = nlohmann::json;

enum class Kind {
  Text,      ///< a string
  Label,     ///< a string for people; dropped when it is something else
  Flag,      ///< true or false
  Number,    ///< finite
  Numbers,   ///< `size` finite numbers
  Count,     ///< an integer from 0 to 2^53
  Index,     ///< an integer that names an element of the root array `target`
  Indices,   ///< an array of these
  IndexMap,  ///< an object whose values are these
  Object,    ///< by `nested`
  Objects    ///< an array of objects by `nested`
};

struct Field {
  const char* key;
  Kind kind;
  bool required = false;
  const char* target = nullptr;
  std::size_t size = 0;
  std::span<const Field> nested = {};
};

constexpr const char* kRemedy = "Export the file again with a glTF 2.0 exporter.";

// Needed by the code that reads the checked copy; everything else stays out.
constexpr Field kAsset[] = {{"version", Kind::Text, true}, {"minVersion", Kind::Text}};
constexpr Field kScene[] = {{"name", Kind::Label}, {"nodes", Kind::Indices, false, "nodes"}};
constexpr Field kNode[] = {{"name", Kind::Label},
                           {"mesh", Kind::Index, false, "meshes"},
                           {"skin", Kind::Index, false, "skins"},
                           {"children", Kind::Indices, false, "nodes"},
                           {"matrix", Kind::Numbers, false, nullptr, 16},
                           {"translation", Kind::Numbers, false, nullptr, 3},
                           {"rotation", Kind::Numbers, false, nullptr, 4},
                           {"scale", Kind::Numbers, false, nullptr, 3}};
constexpr Field kPrimitive[] = {{"attributes", Kind::IndexMap, true, "accessors"},
                                {"indices", Kind::Index, false, "accessors"},
                                {"material", Kind::Index, false, "materials"},
                                {"mode", Kind::Count}};
constexpr Field kMesh[] = {{"name", Kind::Label}, {"primitives", Kind::Objects, true, nullptr, 0, kPrimitive}};
constexpr Field kSparseIndices[] = {{"bufferView", Kind::Index, true, "bufferViews"},
                                    {"byteOffset", Kind::Count},
                                    {"componentType", Kind::Count, true}};
constexpr Field kSparseValues[] = {{"bufferView", Kind::Index, true, "bufferViews"}, {"byteOffset", Kind::Count}};
constexpr Field kSparse[] = {{"count", Kind::Count, true},
                             {"indices", Kind::Object, true, nullptr, 0, kSparseIndices},
                             {"values", Kind::Object, true, nullptr, 0, kSparseValues}};
constexpr Field kAccessor[] = {{"name", Kind::Label},       {"bufferView", Kind::Index, false, "bufferViews"},
                               {"byteOffset", Kind::Count}, {"componentType", Kind::Count, true},
                               {"normalized", Kind::Flag},  {"count", Kind::Count, true},
                               {"type", Kind::Text, true},  {"sparse", Kind::Object, false, nullptr, 0, kSparse}};
constexpr Field kBufferView[] = {{"buffer", Kind::Index, true, "buffers"},
                                 {"byteOffset", Kind::Count},
                                 {"byteLength", Kind::Count, true},
                                 {"byteStride", Kind::Count}};
constexpr Field kBuffer[] = {{"byteLength", Kind::Count, true}, {"uri", Kind::Text}};
constexpr Field kTransform[] = {{"offset", Kind::Numbers, false, nullptr, 2},
                                {"rotation", Kind::Number},
                                {"scale", Kind::Numbers, false, nullptr, 2},
                                {"texCoord", Kind::Count}};
constexpr Field kTextureExtensions[] = {{"KHR_texture_transform", Kind::Object, false, nullptr, 0, kTransform}};
constexpr Field kTextureInfo[] = {{"index", Kind::Index, true, "textures"},
                                  {"texCoord", Kind::Count},
                                  {"extensions", Kind::Object, false, nullptr, 0, kTextureExtensions}};
constexpr Field kPbr[] = {{"baseColorFactor", Kind::Numbers, false, nullptr, 4},
                          {"baseColorTexture", Kind::Object, false, nullptr, 0, kTextureInfo}};
constexpr Field kOptics[] = {{"translucency", Kind::Number, true},
                             {"transmissionTint", Kind::Numbers, true, nullptr, 3}};
constexpr Field kMaterial[] = {{"name", Kind::Label},
                               {"pbrMetallicRoughness", Kind::Object, false, nullptr, 0, kPbr},
                               {"alphaMode", Kind::Text},
                               {"alphaCutoff", Kind::Number},
                               {"doubleSided", Kind::Flag}};
constexpr Field kTexture[] = {{"sampler", Kind::Index, false, "samplers"}, {"source", Kind::Index, false, "images"}};
constexpr Field kSampler[] = {{"wrapS", Kind::Count}, {"wrapT", Kind::Count}};
constexpr Field kImage[] = {{"name", Kind::Label},
                            {"uri", Kind::Text},
                            {"bufferView", Kind::Index, false, "bufferViews"},
                            {"mimeType", Kind::Label}};
constexpr Field kRoot[] = {{"asset", Kind::Object, true, nullptr, 0, kAsset},
                           {"scene", Kind::Index, false, "scenes"},
                           {"scenes", Kind::Objects, false, nullptr, 0, kScene},
                           {"nodes", Kind::Objects, false, nullptr, 0, kNode},
                           {"meshes", Kind::Objects, false, nullptr, 0, kMesh},
                           {"accessors", Kind::Objects, false, nullptr, 0, kAccessor},
                           {"bufferViews", Kind::Objects, false, nullptr, 0, kBufferView},
                           {"buffers", Kind::Objects, false, nullptr, 0, kBuffer},
                           {"materials", Kind::Objects, false, nullptr, 0, kMaterial},
                           {"textures", Kind::Objects, false, nullptr, 0, kTexture},
                           {"samplers", Kind::Objects, false, nullptr, 0, kSampler},
                           {"images", Kind::Objects, false, nullptr, 0, kImage}};

std::string joined(const std::string& where, std::string_view key) {
  return where.empty() ? std::string(key) : where + '.' + std::string(key);
}

std::string element(const std::string& where, std::size_t i) {
  return where + '[' + std::to_string(i) + ']';
}

Error wrong(const std::string& what, const std::string& where) {
  return Error::badInput(what, where, kRemedy);
}

/// The integer that a JSON number stands for; exporters also write 3.0.
std::optional<std::uint64_t> integerOf(const Json& value) {
  constexpr double kLargest = 9007199254740992.0;  // 2^53: beyond it doubles skip integers
  if (value.is_number_unsigned()) {
    const auto n = value.get<std::uint64_t>();
    return n <= static_cast<std::uint64_t>(kLargest) ? std::optional(n) : std::nullopt;
  }
  if (!value.is_number_float()) return std::nullopt;
  const double number = value.get<double>();
  if (!(number >= 0.0 && number <= kLargest) || number != std::floor(number)) return std::nullopt;
  return static_cast<std::uint64_t>(number);
}

class Checker {
 public:
  explicit Checker(const Json& root) : m_root(root) {}

  Result<Json> object(const Json& value, std::span<const Field> fields, const std::string& where) const {
    if (!value.is_object()) return wrong("this is not an object", where.empty() ? "the document" : where);
    Json copy = Json::object();
    for (const Field& field : fields) {
      const std::string place = joined(where, field.key);
      const auto found = value.find(field.key);
      if (found == value.end()) {
        if (field.required) return wrong("this is missing", place);
        continue;
      }
      if (field.kind == Kind::Label && !found->is_string()) continue;
      SWARD_ASSIGN(copy[field.key], checked(*found, field, place));
    }
    return copy;
  }

 private:
  Result<Json> checked(const Json& value, const Field& field, const std::string& where) const {
    switch (field.kind) {
      case Kind::Label:
      case Kind::Text:
        return value.is_string() ? Result<Json>(value) : wrong("this is not a string", where);
      case Kind::Flag:
        return value.is_boolean() ? Result<Json>(value) : wrong("this is not true or false", where);
      case Kind::Number:
        return number(value, where);
      case Kind::Numbers:
        return numbers(value, field.size, where);
      case Kind::Count:
        return count(value, where);
      case Kind::Index:
        return index(value, field.target, where);
      case Kind::Indices:
        return indices(value, field.target, where);
      case Kind::IndexMap:
        return indexMap(value, field.target, where);
      case Kind::Object:
        return object(value, field.nested, where);
      case Kind::Objects:
        return objects(value, field.nested, where);
    }
    return wrong("this is not understood", where);
  }

  static Result<Json> number(const Json& value, const std::string& where) {
    if (!value.is_number()) return wrong("this is not a number", where);
    const double d = value.get<double>();
    if (!std::isfinite(d)) return wrong("this number is not finite", where);
    return Json(d);
  }

  static Result<Json> numbers(const Json& value, std::size_t size, const std::string& where) {
    if (!value.is_array() || value.size() != size) {
      return wrong("this is not an array of " + std::to_string(size) + " numbers", where);
    }
    Json copy = Json::array();
    for (std::size_t i = 0; i < size; ++i) {
      SWARD_ASSIGN(Json item, number(value[i], element(where, i)));
      copy.push_back(std::move(item));
    }
    return copy;
  }

  static Result<Json> count(const Json& value, const std::string& where) {
    const std::optional<std::uint64_t> n = integerOf(value);
    if (!n) return wrong("this is not an integer from 0 to 2^53", where);
    return Json(*n);
  }

  Result<Json> index(const Json& value, const char* target, const std::string& where) const {
    const std::optional<std::uint64_t> n = integerOf(value);
    if (!n) return wrong("this is not an index", where);
    const auto found = m_root.find(target);
    const std::size_t size = found != m_root.end() && found->is_array() ? found->size() : 0;
    if (*n >= size) {
      return wrong(
          "index " + std::to_string(*n) + " is out of range: the file has " + std::to_string(size) + " " + target,
          where);
    }
    return Json(*n);
  }

  Result<Json> indices(const Json& value, const char* target, const std::string& where) const {
    if (!value.is_array()) return wrong("this is not an array", where);
    Json copy = Json::array();
    for (std::size_t i = 0; i < value.size(); ++i) {
      SWARD_ASSIGN(Json item, index(value[i], target, element(where, i)));
      copy.push_back(std::move(item));
    }
    return copy;
  }

  Result<Json> indexMap(const Json& value, const char* target, const std::string& where) const {
    if (!value.is_object()) return wrong("this is not an object", where);
    Json copy = Json::object();
    for (const auto& [key, item] : value.items()) {
      SWARD_ASSIGN(copy[key], index(item, target, joined(where, key)));
    }
    return copy;
  }

  Result<Json> objects(const Json& value, std::span<const Field> fields, const std::string& where) const {
    if (!value.is_array()) return wrong("this is not an array", where);
    Json copy = Json::array();
    for (std::size_t i = 0; i < value.size(); ++i) {
      SWARD_ASSIGN(Json item, object(value[i], fields, element(where, i)));
      copy.push_back(std::move(item));
    }
    return copy;
  }

  const Json& m_root;
};

/// Optics that this program wrote into a material's extras; those of other programs are left alone.
void copyOptics(const Checker& checker, const Json& document, Json& copy) {
  if (!copy.contains("materials")) return;
  for (std::size_t i = 0; i < copy["materials"].size(); ++i) {
    const Json& material = document["materials"][i];
    const auto extras = material.find("extras");
    if (extras == material.end() || !extras->is_object() || !extras->contains("sward_optics")) continue;
    Result<Json> optics = checker.object((*extras)["sward_optics"], kOptics, "sward_optics");
    if (optics.ok()) copy["materials"][i]["extras"]["sward_optics"] = std::move(optics).value();
  }
}

Result<void> checkAccessors(const Json& copy) {
  if (!copy.contains("accessors")) return {};
  constexpr std::array<std::string_view, 7> kTypes = {"SCALAR", "VEC2", "VEC3", "VEC4", "MAT2", "MAT3", "MAT4"};
  const Json& accessors = copy["accessors"];
  for (std::size_t i = 0; i < accessors.size(); ++i) {
    const std::string where = element("accessors", i);
    const auto type = accessors[i]["type"].get<std::string>();
    if (std::find(kTypes.begin(), kTypes.end(), type) == kTypes.end()) {
      return wrong("the accessor type \"" + type + "\" is not one of glTF 2.0", where + ".type");
    }
    const auto component = accessors[i]["componentType"].get<std::uint64_t>();
    if (component < 5120 || component > 5126 || component == 5124) {
      return wrong("the component type " + std::to_string(component) + " is not one of glTF 2.0",
                   where + ".componentType");
    }
  }
  return {};
}

Result<void> checkModes(const Json& copy) {
  if (!copy.contains("meshes")) return {};
  const Json& meshes = copy["meshes"];
  for (std::size_t m = 0; m < meshes.size(); ++m) {
    const Json& primitives = meshes[m]["primitives"];
    for (std::size_t p = 0; p < primitives.size(); ++p) {
      if (primitives[p].value("mode", std::uint64_t{4}) <= 6) continue;
      return wrong("the primitive mode is not 0 to 6", element(element("meshes", m) + ".primitives", p) + ".mode");
    }
  }
  return {};
}

Result<void> checkNodes(const Json& copy) {
  if (!copy.contains("nodes")) return {};
  const Json& nodes = copy["nodes"];
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const bool trs = nodes[i].contains("translation") || nodes[i].contains("rotation") || nodes[i].contains("scale");
    if (nodes[i].contains("matrix") && trs) {
      return wrong("the node has a matrix and a translation, rotation or scale as well; which one holds is undefined",
                   element("nodes", i));
    }
  }
  return {};
}

}  // namespace

Result<Json> checkedGltf(const Json& document) {
  const Checker checker(document);
  SWARD_ASSIGN(Json copy, checker.object(document, kRoot, ""));
  SWARD_TRY(checkAccessors(copy));
  SWARD_TRY(checkModes(copy));
  SWARD_TRY(checkNodes(copy));
  copyOptics(checker, document, copy);
  return copy;
}

}  // namespace sward::mesh
