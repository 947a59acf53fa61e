#pragma once

#include <nlohmann/json.hpp>

#include <cstddef>
#include <filesystem>
#include <fstream>
#include <span>
#include <string>
#include <unistd.h>
#include <vector>

#include <gtest/gtest.h>

namespace sward::mesh::testing {

/// A folder of its own for each test, removed at its end.
class GltfTest : public ::testing::Test {
 protected:
  void SetUp() override {
    m_folder =
        std::filesystem::temp_directory_path() / ("sward-mesh-" + std::to_string(::getpid()) + "-" +
                                                  ::testing::UnitTest::GetInstance()->current_test_info()->name());
    std::filesystem::create_directories(m_folder);
  }
  void TearDown() override {
    std::error_code code;
    std::filesystem::remove_all(m_folder, code);
  }
  std::filesystem::path write(const std::string& name, const std::string& text) const {
    std::ofstream(m_folder / name, std::ios::binary) << text;
    return m_folder / name;
  }
  std::filesystem::path m_folder;
};

inline std::string base64(std::span<const std::byte> bytes) {
  const char* letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 3; ++k)
      bits = (bits << 8) | (i + k < bytes.size() ? static_cast<std::uint32_t>(bytes[i + k]) : 0u);
    for (std::size_t k = 0; k < 4; ++k)
      text.push_back(i + k <= bytes.size() ? letters[(bits >> (18 - 6 * k)) & 63u] : '=');
  }
  return text;
}

/// A small glTF document with one buffer as a data URI; tests change `json` as they like before text().
struct GltfBuilder {
  nlohmann::json json = nlohmann::json::parse(R"({
    "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
    "meshes": [{"primitives": [{"attributes": {}}]}], "accessors": [], "bufferViews": []})");
  std::vector<std::byte> buffer;

  template <typename T>
  int view(const std::vector<T>& values) {
    buffer.resize((buffer.size() + 3) / 4 * 4);
    const auto bytes = std::as_bytes(std::span(values));
    json["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", buffer.size()}, {"byteLength", bytes.size()}});
    buffer.insert(buffer.end(), bytes.begin(), bytes.end());
    return static_cast<int>(json["bufferViews"].size()) - 1;
  }
  template <typename T>
  int accessor(const std::vector<T>& values, const char* type, int componentType, std::size_t count,
               bool normalised = false) {
    nlohmann::json accessor = {
        {"bufferView", view(values)}, {"componentType", componentType}, {"count", count}, {"type", type}};
    if (normalised) accessor["normalized"] = true;
    json["accessors"].push_back(accessor);
    return static_cast<int>(json["accessors"].size()) - 1;
  }
  nlohmann::json& primitive() { return json["meshes"][0]["primitives"][0]; }
  /// A right triangle with corners (0,0,0), (1,0,0), (0,2,0) in glTF's axes, no normals.
  GltfBuilder& triangle() {
    primitive()["attributes"]["POSITION"] = accessor(std::vector<float>{0, 0, 0, 1, 0, 0, 0, 2, 0}, "VEC3", 5126, 3);
    return *this;
  }
  std::string text() const {
    nlohmann::json whole = json;
    whole["buffers"] = nlohmann::json::array(
        {{{"byteLength", buffer.size()}, {"uri", "data:application/octet-stream;base64," + base64(buffer)}}});
    return whole.dump();
  }
};

}  // namespace sward::mesh::testing
