// SPDX-License-Identifier: BSD-3-Clause
// Which plugin files a mission may load. A plugin is code that runs with the rights of its user: what others
// can change is never loaded, and section `plugins` narrows the rest to a list.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "core/graph/mission.hpp"
#include "core/loader/library.hpp"

namespace fulmar::core {

/// Throws Error when others than the user and root could have written the file: it is writable by all, lies
/// in a folder where all may replace it, or belongs to another user.
void check_private_file(const std::filesystem::path& file);

class Trust {
 public:
  /// Reads `plugins: {allow: [...]}`. Faults go to the report.
  Trust(const MissionText& mission, Report& report);

  /// Throws Error unless the file may be loaded. Tells which content is listed for it. Opens nothing.
  Expected check(const std::filesystem::path& file) const;

 private:
  struct Entry {
    std::string text;                          // as written
    std::vector<std::filesystem::path> files;  // that it can mean
    std::string sha256;                        // "": any content
    Where where;
    bool covers(const std::filesystem::path& file) const;
  };
  void read(const Node& node, Report& report);
  void read_entry(const Node& node, Report& report);
  std::vector<std::filesystem::path> meaning(const std::string& text, const Node& node, Report& report) const;
  [[noreturn]] void refuse(const std::filesystem::path& file) const;

  bool listed_ = false;  // there is a list, if an empty one
  Where where_;
  std::filesystem::path home_;  // folder of the file that holds the list
  std::vector<Entry> entries_;
};

}  // namespace fulmar::core
