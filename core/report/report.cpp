#include "report/report.h"

#include "bake/quality.h"

#include <cmath>
#include <cstdlib>
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

Json machineJson(const Machine& machine) {
  Json json = Json::object();
  if (!machine.cpu.empty()) json["cpu"] = machine.cpu;
  json["cores"] = machine.cores;
  if (machine.memoryBytes > 0) json["memory_bytes"] = machine.memoryBytes;
  const gpu::DeviceInfo& device = machine.device;
  json["gl"] = {
      {"api", device.api}, {"renderer", device.renderer}, {"version", device.version}, {"software", device.software}};
  return json;
}

void set(Json& json, const char* name, const std::optional<double>& value) {
  if (value.has_value() && std::isfinite(*value)) json[name] = *value;
}
void set(Json& json, const char* name, const std::optional<std::uint64_t>& value) {
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
  for (const auto& [name, value] : row.error) {
    if (std::isfinite(value)) json["error"][name] = value;
  }
  set(json, "reference", row.reference);
  set(json, "notes", row.notes);
  return json;
}

}  // namespace

project::Project groundProject(const project::Project& project, bool quick) {
  return quick ? bake::atQuality(project, bake::Quality::Half) : project;
}

Machine thisMachine(const gpu::DeviceInfo& device) {
  // "MemTotal: 12345 kB"
  const std::string memory = procValue("/proc/meminfo", "MemTotal");
  return {procValue("/proc/cpuinfo", "model name"), std::thread::hardware_concurrency(),
          std::strtoull(memory.c_str(), nullptr, 10) * 1024, device};
}

std::string reportJson(const ReportHead& head, const std::vector<Section>& sections) {
  Json json = {{"sward", head.version}, {"machine", machineJson(head.machine)}, {"project", head.project}};
  json["sections"] = Json::object();
  for (const Section& section : sections) {
    if (!section.failure.empty()) continue;
    Json list = Json::array();
    for (const Row& row : section.rows) list.push_back(rowJson(row));
    json["sections"][section.name] = {{"rows", list}};
  }
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace sward::report
