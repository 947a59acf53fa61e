#include "commands.h"

#include "gpu/context.h"

#include <thread>

#include <CLI/Version.hpp>
#include <Eigen/Core>
#include <OpenImageIO/oiioversion.h>
#include <embree3/rtcore_config.h>
#include <glm/glm.hpp>
#include <spdlog/version.h>
#include <tbb/version.h>

namespace sward::editor {
namespace {

std::string dotted(int major, int minor, int patch) {
  return std::to_string(major) + "." + std::to_string(minor) + "." + std::to_string(patch);
}

Json libraries() {
  return {
      {"Embree", RTC_VERSION_STRING},
      {"OpenImageIO", OIIO_VERSION_STRING},
      {"oneTBB", TBB_runtime_version()},
      {"Eigen", dotted(EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION)},
      {"GLM", dotted(GLM_VERSION_MAJOR, GLM_VERSION_MINOR, GLM_VERSION_PATCH)},
      {"nlohmann-json", dotted(NLOHMANN_JSON_VERSION_MAJOR, NLOHMANN_JSON_VERSION_MINOR, NLOHMANN_JSON_VERSION_PATCH)},
      {"CLI11", CLI11_VERSION},
      {"spdlog", dotted(SPDLOG_VER_MAJOR, SPDLOG_VER_MINOR, SPDLOG_VER_PATCH)}};
}

/// Tries each way to a context, one after the other.
Json devices() {
  Json list = Json::array();
  for (const auto& [name, device] : {std::pair{"egl", gpu::Device::Egl}, std::pair{"osmesa", gpu::Device::OsMesa}}) {
    const auto context = gpu::Context::create(device);
    if (!context.ok()) {
      list.push_back({{"device", name}, {"works", false}, {"why", context.error().text()}});
      continue;
    }
    const gpu::DeviceInfo& info = (*context)->info();
    list.push_back({{"device", name},
                    {"works", true},
                    {"renderer", info.renderer},
                    {"vendor", info.vendor},
                    {"version", info.version},
                    {"software", info.software}});
  }
  return list;
}

Result<int> runInfo(Program& program) {
  const Json info = {{"version", SWARD_VERSION},
                     {"processors", std::thread::hardware_concurrency()},
                     {"cache", cacheFolder(program).string()},
                     {"devices", devices()},
                     {"libraries", libraries()}};
  if (program.common.json) {
    print(info);
    return kDone;
  }
  std::cout << "sward " << SWARD_VERSION << "\nprocessors  " << info["processors"] << "\ncache       "
            << info["cache"].get<std::string>() << '\n';
  for (const Json& device : info["devices"]) {
    const bool works = device["works"].get<bool>();
    std::cout << "device      " << device["device"].get<std::string>() << ": "
              << (works ? device["renderer"].get<std::string>() + ", OpenGL " + device["version"].get<std::string>()
                        : "does not work: " + device["why"].get<std::string>())
              << '\n';
  }
  for (const auto& [name, version] : info["libraries"].items()) {
    std::cout << "library     " << name << ' ' << version.get<std::string>() << '\n';
  }
  return kDone;
}

}  // namespace

void addInfoCommand(CLI::App& app, Program& program) {
  CLI::App* command = addCommand(app, program, "info", "Show version, OpenGL devices and libraries",
                                 "Tries every way to an OpenGL context and says which work.");
  command->callback([&program] { program.run = [&program] { return runInfo(program); }; });
}

}  // namespace sward::editor
