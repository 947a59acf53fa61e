#include "report/report.h"

#include "base/file.h"

#include <fstream>
#include <thread>

#include <nlohmann/json.hpp>

namespace sward::report {
namespace {

using Json = nlohmann::ordered_json;

/// The value of the first line of a /proc file that starts with `name`, without the colon; empty when there is none.
std::string procValue(const char* file, const std::string& name) {
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    if (line.rfind(name, 0) != 0) continue;
    const std::size_t colon = line.find(':');
    const std::size_t start = colon == std::string::npos ? colon : line.find_first_not_of(" \t", colon + 1);
    return start == std::string::npos ? "" : line.substr(start);
  }
  return {};
}

Json machineJson(const gpu::DeviceInfo& device) {
  Json machine = Json::object();
  if (const std::string cpu = procValue("/proc/cpuinfo", "model name"); !cpu.empty()) machine["cpu"] = cpu;
  machine["cores"] = std::thread::hardware_concurrency();
  // "MemTotal: 12345 kB"
  if (const std::string memory = procValue("/proc/meminfo", "MemTotal"); !memory.empty()) {
    machine["memory_bytes"] = std::strtoull(memory.c_str(), nullptr, 10) * 1024;
  }
  machine["gl"] = {
      {"api", device.api}, {"renderer", device.renderer}, {"version", device.version}, {"software", device.software}};
  return machine;
}

template <typename T>
void set(Json& json, const char* name, const std::optional<T>& value) {
  if (value.has_value()) json[name] = *value;
}
void set(Json& json, const char* name, const std::string& value) {
  if (!value.empty()) json[name] = value;
}

Json rowJson(const Row& row) {
  Json json = {{"method", row.method}, {"parameters", Json::object()}};
  for (const auto& [name, value] : row.numbersAndNames) json["parameters"][name] = Json::parse(value);
  if (!row.rateUnit.empty()) json["parameters"]["rate_unit"] = row.rateUnit;
  if (row.timeMs) {
    json["time_ms"] = {
        {"median", row.timeMs->median}, {"min", row.timeMs->min}, {"max", row.timeMs->max}, {"runs", row.timeMs->runs}};
  }
  set(json, "rate", row.rate);
  set(json, "ratio", row.ratio);
  set(json, "against", row.against);
  set(json, "bake_s", row.bakeSeconds);
  set(json, "bytes", row.bytes);
  set(json, "bytes_total", row.bytesTotal);
  if (!row.error.empty()) json["error"] = row.error;
  set(json, "reference", row.reference);
  set(json, "notes", row.notes);
  return json;
}

}  // namespace

std::string reportJson(const ReportHead& head, const std::vector<Section>& sections) {
  Json json = {{"sward", head.version}, {"machine", machineJson(head.device)}, {"project", head.project}};
  json["sections"] = Json::object();
  for (const Section& section : sections) {
    Json list = Json::array();
    for (const Row& row : section.rows) list.push_back(rowJson(row));
    json["sections"][section.name] = {{"rows", list}};
  }
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

Result<std::filesystem::path> writeReport(const std::filesystem::path& folder, const ReportHead& head,
                                          const std::vector<Section>& sections) {
  std::error_code code;
  std::filesystem::create_directories(folder, code);
  if (code || !std::filesystem::is_directory(folder)) {
    return Error::badInput("cannot make the folder" + (code ? ": " + code.message() : std::string()), folder.string(),
                           "Choose another folder with -o.");
  }
  const std::filesystem::path file = folder / "report.json";
  SWARD_TRY(base::writeFileAtomically(file, reportJson(head, sections)));
  return file;
}

}  // namespace sward::report
