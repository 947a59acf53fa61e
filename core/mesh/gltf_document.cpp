#include "mesh/gltf_document.h"

#include "mesh/gltf_schema.h"
#include "mesh/gltf_uri.h"

#include "base/file.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cstring>
#include <optional>
#include <string_view>
#include <utility>

namespace sward::mesh {
namespace {

using Json = nlohmann::json;
using Bytes = std::span<const std::byte>;

constexpr int kMaxDepth = 64;                         // tinygltf recurses; real files stay below 12
constexpr std::uint64_t kMaxJsonValues = 16'000'000;  // some 100 bytes each in memory
constexpr std::uint32_t kGlbMagic = 0x46546C67;       // "glTF"
constexpr std::uint32_t kJsonChunk = 0x4E4F534A;      // "JSON"
constexpr std::uint32_t kBinaryChunk = 0x004E4942;    // "BIN"
constexpr const char* kDamaged = "Export the file again; it is damaged or cut short.";

std::uint32_t word(Bytes bytes, std::size_t at) {
  std::uint32_t value = 0;
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}

struct Chunks {
  std::string_view json;
  Bytes binary;
  std::vector<std::string> warnings;
};

std::string_view textOf(Bytes bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

/// Splits a .glb into its chunks (glTF 2.0, section 4.4); anything else is taken as JSON.
Result<Chunks> splitContainer(Bytes file) {
  if (file.empty()) return Error::badInput("the file is empty", {}, kDamaged);
  if (file.size() < 4 || word(file, 0) != kGlbMagic) return Chunks{textOf(file), {}, {}};
  if (file.size() < 12) return Error::badInput("the file ends within its header", "byte 4", kDamaged);
  if (word(file, 4) != 2) {
    return Error::badInput("the binary glTF version is " + std::to_string(word(file, 4)) + ", not 2", "byte 4",
                           "Export the file as glTF 2.0.");
  }
  const std::uint64_t length = word(file, 8);
  if (length > file.size()) {
    return Error::badInput(
        "the header promises " + std::to_string(length) + " bytes, the file has " + std::to_string(file.size()),
        "byte 8", kDamaged);
  }
  Chunks chunks;
  if (length < file.size()) chunks.warnings.push_back("there are bytes after the end that the header gives; ignored");
  Bytes rest = file.first(static_cast<std::size_t>(length)).subspan(std::min<std::size_t>(12, length));
  for (int i = 0; rest.size() >= 8; ++i) {
    const std::uint64_t size = word(rest, 0);
    const std::uint32_t type = word(rest, 4);
    const std::string place = "chunk " + std::to_string(i);
    if (size > rest.size() - 8) return Error::badInput("the chunk is longer than the file", place, kDamaged);
    const Bytes body = rest.subspan(8, static_cast<std::size_t>(size));
    if (i == 0 && type != kJsonChunk) return Error::badInput("the first chunk is not JSON", place, kDamaged);
    if (i == 0) chunks.json = textOf(body);
    if (i == 1 && type == kBinaryChunk) chunks.binary = body;
    rest = rest.subspan(8 + static_cast<std::size_t>(size));
  }
  if (!rest.empty()) return Error::badInput("the file ends within a chunk's header", {}, kDamaged);
  if (chunks.json.data() == nullptr) return Error::badInput("the file has no JSON chunk", {}, kDamaged);
  return chunks;
}

/// Parses JSON of bounded depth and size, so that neither building nor walking it can exhaust stack or memory.
Result<Json> parseJson(std::string_view text) {
  bool tooDeep = false;
  std::uint64_t values = 0;
  const auto watch = [&](int depth, Json::parse_event_t, Json&) {
    tooDeep = tooDeep || depth > kMaxDepth;
    return ++values <= kMaxJsonValues && !tooDeep;
  };
  try {
    Json document = Json::parse(text, watch);
    if (tooDeep) return Error::badInput("the JSON is nested too deeply", {}, "Export the file again.");
    if (values > kMaxJsonValues) return Error::badInput("the JSON has too many values", {}, "Split the file.");
    return document;
  } catch (const Json::exception& problem) {
    return Error::badInput(std::string("the JSON cannot be read: ") + problem.what(), {}, kDamaged);
  }
}

/// Extensions that may be required: read here, or without effect on shape, base colour and alpha.
bool isSupported(const std::string& extension) {
  static constexpr std::array<std::string_view, 5> kKnown = {"KHR_texture_transform", "KHR_mesh_quantization",
                                                             "KHR_lights_punctual", "KHR_xmp", "KHR_xmp_json_ld"};
  if (extension == "KHR_materials_pbrSpecularGlossiness") return false;  // the base colour is elsewhere then
  if (extension.starts_with("KHR_materials_")) return true;
  return std::find(kKnown.begin(), kKnown.end(), extension) != kKnown.end();
}

std::string extensionRemedy(const std::string& extension) {
  if (extension == "KHR_draco_mesh_compression") return "Export the file again without Draco mesh compression.";
  if (extension == "EXT_meshopt_compression" || extension == "KHR_meshopt_compression") {
    return "Export the file again without meshopt compression.";
  }
  if (extension == "EXT_texture_webp") return "Convert its textures from WebP to PNG and export the file again.";
  if (extension == "EXT_texture_avif") return "Convert its textures from AVIF to PNG and export the file again.";
  if (extension == "KHR_texture_basisu") return "Convert its textures from KTX2 to PNG and export the file again.";
  if (extension == "EXT_mesh_gpu_instancing") return "Export the file again with its instances as plain nodes.";
  return "Export the file again without it.";
}

std::vector<std::string> extensionNames(const Json& document, const char* key) {
  std::vector<std::string> names;
  const auto found = document.find(key);
  if (found == document.end() || !found->is_array()) return names;
  for (const Json& name : *found) {
    if (name.is_string()) names.push_back(name.get<std::string>());
  }
  return names;
}

Result<void> checkExtensions(const Json& document, std::vector<std::string>& warnings) {
  std::string missing, remedy;
  for (const std::string& name : extensionNames(document, "extensionsRequired")) {
    if (isSupported(name)) continue;
    missing += (missing.empty() ? "" : ", ") + name;
    remedy += (remedy.empty() ? "" : " ") + extensionRemedy(name);
  }
  if (!missing.empty()) {
    return Error::badInput("the file requires extensions that are not supported: " + missing, "extensionsRequired",
                           remedy);
  }
  for (const std::string& name : extensionNames(document, "extensionsUsed")) {
    if (name == "EXT_mesh_gpu_instancing" || name == "KHR_materials_pbrSpecularGlossiness") {
      warnings.push_back("extension " + name + " is not supported; what it adds is left out");
    }
  }
  return {};
}

/// "2.0", "2.1" and so on, and a minVersion of at most 2.0.
Result<void> checkVersion(const Json& checked) {
  const auto version = checked["asset"]["version"].get<std::string>();
  const auto least = checked["asset"].value("minVersion", std::string("2.0"));
  if (!version.starts_with("2.") || least != "2.0") {
    return Error::badInput("the file is glTF " + (version.starts_with("2.") ? least : version) + ", not 2.0",
                           "asset.version", "Export the file as glTF 2.0.");
  }
  return {};
}

/// Moves URIs and lengths out of the document: tinygltf then parses plain structure and opens no file.
void takeResources(Json& checked, GltfDocument& document) {
  for (const Json& buffer : checked.value("buffers", Json::array())) {
    document.bufferUris.push_back(buffer.value("uri", std::string()));
    document.bufferLengths.push_back(buffer["byteLength"].get<std::uint64_t>());
  }
  checked.erase("buffers");
  for (const Json& image : checked.value("images", Json::array())) {
    document.imageUris.push_back(image.value("uri", std::string()));
    tinygltf::Image plain;
    plain.name = image.value("name", std::string());
    plain.bufferView = image.value("bufferView", -1);
    document.model.images.push_back(std::move(plain));
  }
  checked.erase("images");
}

Result<void> parseStructure(const Json& checked, GltfDocument& document) {
  const std::string text = checked.dump();
  if (text.size() > 0xffffffffu) return Error::badInput("the document is too large", {}, "Split the file.");
  std::vector<tinygltf::Image> images = std::move(document.model.images);
  tinygltf::TinyGLTF parser;
  std::string errors, warnings;
  const bool parsed = parser.LoadASCIIFromString(&document.model, &errors, &warnings, text.c_str(),
                                                 static_cast<unsigned int>(text.size()), "");
  document.model.images = std::move(images);
  if (!parsed) {
    std::replace(errors.begin(), errors.end(), '\n', ' ');
    return Error::badInput("the document cannot be read: " + errors, {},
                           "Export the file again with a glTF 2.0 exporter.");
  }
  return {};
}

Result<std::vector<std::byte>> externalBuffer(const GltfDocument& document, const std::string& uri) {
  if (isDataUri(uri)) return decodeDataUri(uri);
  SWARD_ASSIGN(const std::filesystem::path path, resolveUri(document.folder, uri));
  Result<std::vector<std::byte>> bytes = base::readFile(path, kMaxFileBytes);
  if (!bytes.ok()) {
    Error error = std::move(bytes).error();
    error.what = "the buffer file " + path.string() + " cannot be used: " + error.what;
    error.where.clear();
    error.remedy = "Put the .bin file beside the glTF file, or export as .glb.";
    return error;
  }
  return bytes;
}

}  // namespace

Result<GltfDocument> parseGltf(const std::filesystem::path& path) {
  GltfDocument document;
  document.folder = path.parent_path();
  SWARD_ASSIGN(document.file, base::readFile(path, kMaxFileBytes));
  SWARD_ASSIGN(const Chunks chunks, splitContainer(document.file));
  document.binaryChunk = chunks.binary;
  document.warnings = chunks.warnings;
  SWARD_ASSIGN(const Json json, parseJson(chunks.json));
  if (!json.is_object()) return Error::badInput("the JSON is not an object", {}, kDamaged);
  SWARD_TRY(checkExtensions(json, document.warnings));
  SWARD_ASSIGN(Json checked, checkedGltf(json));
  SWARD_TRY(checkVersion(checked));
  takeResources(checked, document);
  SWARD_TRY(parseStructure(checked, document));
  return document;
}

Result<void> loadBuffers(GltfDocument& document) {
  std::uint64_t total = 0;
  document.ownedData.resize(document.bufferUris.size());
  for (std::size_t i = 0; i < document.bufferUris.size(); ++i) {
    const std::string where = "buffers[" + std::to_string(i) + "]";
    Bytes bytes = document.binaryChunk;
    if (!document.bufferUris[i].empty()) {
      Result<std::vector<std::byte>> data = externalBuffer(document, document.bufferUris[i]);
      if (!data.ok()) {
        Error error = std::move(data).error();
        error.where = where;
        return error;
      }
      document.ownedData[i] = std::move(data).value();
      bytes = document.ownedData[i];
    } else if (i > 0 || document.binaryChunk.data() == nullptr) {
      return Error::badInput("the buffer has no URI and the file has no binary chunk for it", where, kDamaged);
    }
    if (bytes.size() < document.bufferLengths[i]) {
      return Error::badInput("the buffer should have " + std::to_string(document.bufferLengths[i]) + " bytes but has " +
                                 std::to_string(bytes.size()),
                             where, kDamaged);
    }
    total += bytes.size();
    if (total > kMaxFileBytes)
      return Error::badInput("the buffers are too large together", where, "Use a smaller model.");
    document.buffers.push_back(bytes.first(static_cast<std::size_t>(document.bufferLengths[i])));
  }
  return {};
}

Result<Bytes> bufferViewBytes(const GltfDocument& document, int bufferView) {
  const tinygltf::BufferView& view = document.model.bufferViews[static_cast<std::size_t>(bufferView)];
  const Bytes buffer = document.buffers[static_cast<std::size_t>(view.buffer)];
  if (view.byteOffset > buffer.size() || view.byteLength > buffer.size() - view.byteOffset) {
    return Error::badInput("the buffer view reaches from byte " + std::to_string(view.byteOffset) + " over " +
                               std::to_string(view.byteLength) + " bytes, but its buffer has " +
                               std::to_string(buffer.size()),
                           "bufferViews[" + std::to_string(bufferView) + "]", kDamaged);
  }
  return buffer.subspan(view.byteOffset, view.byteLength);
}

}  // namespace sward::mesh
