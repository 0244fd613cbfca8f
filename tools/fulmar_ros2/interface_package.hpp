// SPDX-License-Identifier: BSD-3-Clause
// The messages and requests of plugins as a package of ROS 2, `fulmar_msgs`.
#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "core/types/type.hpp"

namespace fulmar::ros2 {

/// A package in memory: path inside its folder -> content.
struct Package {
  std::map<std::string, std::string> files;
  std::map<std::string, std::string> hashes;  // "fulmar_msgs/msg/Plan" -> RIHS01_...
  std::vector<std::string> depends;           // packages of foreign messages
};

/// Collects types and writes their definitions. Two different messages of one name are an Error.
class Collector {
 public:
  /// Begins with the messages that the host publishes.
  Collector();
  /// Messages of all ports, and of the probes; requests as services.
  void add(const core::PluginInfo& plugin);
  Package package() const;

 private:
  void message(const core::TypePtr& type, const std::string& from);
  void request(const core::TypePtr& type);

  struct Known {
    core::TypePtr type;
    std::string from;  // the first plugin with the message
  };
  std::map<std::string, Known> messages_;          // by ROS name, without the foreign ones
  std::map<std::string, core::TypePtr> requests_;  // by ROS name of the service
  std::map<std::string, bool> foreign_;            // packages
};

/// Writes the package. An existing folder must be empty or hold a package of this function; files of an
/// earlier package that are not in this one are removed. Throws Error.
void write_package(const Package& package, const std::filesystem::path& folder);

}  // namespace fulmar::ros2
