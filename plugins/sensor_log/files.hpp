// SPDX-License-Identifier: BSD-3-Clause
// The files of a recording. The ending of the name selects the reader.
#pragma once
#include <cerrno>
#include <cstring>
#include <fstream>

#include "bag.hpp"
#include "csv.hpp"
#include "description.hpp"
#include "ulog.hpp"

namespace fulmar::sensor_log {

class Files {
 public:
  explicit Files(std::string folder) : folder_(std::move(folder)) {}

  std::string path(const Source& from) const { return folder_ + "/" + std::string(from.file.view()); }

  Table read(const Source& from, const std::string& key, const std::vector<Wanted>& wanted) {
    const File file = open(from, key);
    if (kind_of(file) == Kind::csv) return Csv(file, wanted).read();
    if (kind_of(file) == Kind::bag) return Bag(file, from.topic.view()).read(wanted);
    return Ulog(file, from.topic.view()).read(wanted);
  }

  /// A CSV file has no type information.
  Topic look(const Source& from, const std::string& key) {
    const File file = open(from, key);
    if (kind_of(file) == Kind::csv) {
      if (!from.topic.view().empty())
        refuse(key + ".from.topic", sensor_log_messages::topics_not_in_file(file.path));
      return {};
    }
    return kind_of(file) == Kind::bag ? Bag(file, from.topic.view()).look()
                                      : Ulog(file, from.topic.view()).look();
  }

  bool has_lines(const Source& from) const { return path(from).ends_with(".csv"); }

 private:
  enum class Kind : std::uint8_t { csv, bag, ulog };
  static Kind kind_of(const File& file) {
    if (file.path.ends_with(".csv")) return Kind::csv;
    if (file.path.ends_with(".mcap")) return Kind::bag;
    if (file.path.ends_with(".ulg") || file.path.ends_with(".ulog")) return Kind::ulog;
    refuse(file.key, sensor_log_messages::file_kind_unknown(file.path));
  }

  static std::size_t count_of(const std::ifstream& stream) {
    return static_cast<std::size_t>(stream.gcount());
  }

  /// Several sensors may share a file, which is read once.
  File open(const Source& from, const std::string& key) {
    File file{path(from), key + ".from.file", {}};
    kind_of(file);
    const auto [at, fresh] = bytes_.try_emplace(file.path);
    if (fresh) {
      errno = 0;
      std::ifstream stream(file.path, std::ios::binary);
      if (!stream && errno == ENOENT) refuse(file.key, sensor_log_messages::file_missing(file.path));
      // read() sets badbit, where an iterator of the buffer throws, as for a folder
      for (std::string block(1u << 16, '\0'); stream; at->second.append(block, 0, count_of(stream)))
        stream.read(block.data(), static_cast<std::streamsize>(block.size()));
      if (!stream.eof())
        refuse(file.key,
               sensor_log_messages::file_unreadable(file.path, std::strerror(errno != 0 ? errno : EIO)));
    }
    file.bytes = at->second;
    return file;
  }

  std::string folder_;
  std::map<std::string, std::string> bytes_;
};

}  // namespace fulmar::sensor_log
