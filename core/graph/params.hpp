// SPDX-License-Identifier: BSD-3-Clause
// Values of parameters, from YAML: numbers with units, choices, records and the bytes of files.
#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "core/graph/graph.hpp"
#include "core/graph/yaml.hpp"

namespace fulmar::core {

/// Files that a mission names: each is read and parsed once, and its contents are kept for the log.
class FileStore {
 public:
  explicit FileStore(Report& report, const StoredFiles* stored = nullptr)
      : report_(report), stored_(stored) {}
  void keep(const FilePtr& file);
  /// The file that `node` names, relative to the folder of the file that contains `node`. Null and a fault
  /// when there is none.
  FilePtr read(const Node& node, const std::string& path);
  const Node& tree(const FilePtr& file);
  /// Name without folders -> text, in the order of reading. The second of two files of one name is called
  /// folder/name.
  std::vector<std::pair<std::string, std::string>> attachments() const;
  std::vector<std::filesystem::path> paths() const;

 private:
  FilePtr known(const std::filesystem::path& path) const;
  Report& report_;
  const StoredFiles* stored_;  // in place of the disk
  std::vector<FilePtr> files_;
  std::map<std::string, Node> trees_;  // by path
};

/// The default value of a parameter.
ParamValue initial_value(const ParamInfo& param);

/// Sets `value` from YAML; on a fault it stays, and the report gets the reason. `path` names the parameter:
/// "components.slc.params.roll_kp".
void read_param(const ParamInfo& param, const Node& node, const std::string& path, ParamValue& value,
                FileStore& files, Report& report);

/// A parameter, or a field of one that is a record: "airframe.mass" is the field "mass" of "airframe".
struct ParamPath {
  int param = -1;     // into the component's parameters; -1: unknown
  std::string field;  // "": the parameter as a whole
};
ParamPath param_path(const ComponentInfo& info, const std::string& name);

/// Sets one field of a record parameter; the others stay.
void read_param_field(const ParamInfo& param, const std::string& field, const Node& node,
                      const std::string& path, ParamValue& value, Report& report);

/// Sets a record parameter from a map of another place: an airframe file, the mission's origin. `also`: keys
/// that are not fields.
void read_record(const ParamInfo& param, const Node& map, const std::string& path, const std::string& name,
                 ParamValue& value, Report& report, const std::vector<std::string>& also = {});

/// Keys of a record's file that are not its fields: the parameters of an airframe.
const std::vector<std::string>& keys_beside_fields(const ParamInfo& param);

/// The value in the form of a mission file: "0.55 rad/rad", "takeoff", "[3, -4, 0] m/s", the name of a file.
std::string value_text(const ParamInfo& param, const ParamValue& value);

}  // namespace fulmar::core
