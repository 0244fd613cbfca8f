// SPDX-License-Identifier: BSD-3-Clause
// `fulmar ros2 ...`, as the program fulmar-ros2. Exit codes: 0 done; 1 it failed; 2 wrong usage.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>

#include "core/app/program.hpp"
#include "core/graph/catalogue.hpp"
#include "core/graph/graph.hpp"
#include "core/loader/home.hpp"
#include "tools/fulmar_ros2/interface_package.hpp"

namespace {

namespace core = fulmar::core;
namespace ros2 = fulmar::ros2;

struct Options {
  std::string folder, mission;
  std::vector<std::string> plugins;
};

/// The given plugins, or those of a mission; else all installed ones.
void collect(const Options& options, ros2::Collector& collector) {
  if (!options.mission.empty()) {
    const core::Graph graph = core::load_mission(options.mission);
    for (const core::Component& component : graph.components) collector.add(*component.plugin);
  }
  core::PluginCatalogue catalogue(core::plugin_folders());
  std::vector<std::string> names = options.plugins;
  if (names.empty() && options.mission.empty()) {
    for (const std::string& name : catalogue.names()) {
      if (name.find('.') == std::string::npos) names.push_back(name);  // plugins; scripts define no messages
    }
  }
  for (const std::string& name : names) {
    const bool is_file = std::filesystem::exists(name);
    collector.add(is_file ? core::Library::open(name)->info() : *catalogue.open(name).info);
  }
}

int write_interfaces(const Options& options) {
  ros2::Collector collector;
  collect(options, collector);
  const ros2::Package package = collector.package();
  ros2::write_package(package, options.folder);
  const std::size_t services = static_cast<std::size_t>(std::count_if(
      package.files.begin(), package.files.end(), [](const auto& f) { return f.first.starts_with("srv/"); }));
  std::printf(
      "%s: package fulmar_msgs with %zu messages and %zu services. In a ROS 2 workspace: colcon build "
      "--packages-select fulmar_msgs\n",
      options.folder.c_str(), package.hashes.size(), services);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Generate ROS 2 interface packages.", "fulmar ros2"};
  app.set_version_flag("--version", "fulmar ros2 " FULMAR_VERSION);
  app.require_subcommand(1);
  app.footer("Example: fulmar ros2 interface-package ~/ros2_ws/src/fulmar_msgs");
  Options options;
  CLI::App* package = app.add_subcommand("interface-package",
                                         "write the colcon package fulmar_msgs with messages and services");
  package->add_option("DIR", options.folder, "folder of the package: new, empty, or written by this command")
      ->required();
  package->add_option("PLUGIN", options.plugins, "names or files of plugins; default: all installed plugins");
  package->add_option("--mission", options.mission, "use the plugins of mission FILE")
      ->check(CLI::ExistingFile);
  return core::run_program(app, [&] {
    if (core::asked_for_rows(argc, argv)) {
      std::fputs(core::command_rows(app).c_str(), stdout);
      return 0;
    }
    app.parse(argc, argv);
    return write_interfaces(options);
  });
}
