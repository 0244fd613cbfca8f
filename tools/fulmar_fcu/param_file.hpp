// SPDX-License-Identifier: BSD-3-Clause
// Parameters in files: ours, one "NAME: value" a line; and the list of {name, type, value} that ROSflight's
// own tools write.
#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "tools/fulmar_fcu/params.hpp"

namespace fulmar::fcu {

struct FileParam {
  std::string name, text;
  std::optional<bool> whole;  ///< where the file says it
  core::Where where;
};

/// Throws Error with every fault, each with file:line.
std::vector<FileParam> read_param_file(const std::string& path);
/// The text of a file of ours, in the order of the parameters.
std::string param_file_text(const std::vector<Param>& params, const std::string& version);
/// Writes a whole file or none. Throws Error when there is one already, unless `replace`.
void write_param_file(const std::string& path, const std::string& text, bool replace);

struct Change {
  Param now;
  std::uint32_t bits = 0;
  core::Where where;
  std::string wanted() const;
};

/// What the file would change. Throws Error with every fault: unknown names, values that the type does not
/// hold.
std::vector<Change> changes(const std::vector<FileParam>& file, const std::vector<Param>& now);
/// As a table: name, what the controller has, what the file has.
std::string changes_text(const std::vector<Change>& list);

/// Makes the controller have what the file says, reads everything back, and returns what did not take.
std::vector<Change> load_params(Client& client, const std::vector<FileParam>& file, std::vector<Change> todo,
                                const std::function<void(std::size_t done, std::size_t all)>& progress = {});

}  // namespace fulmar::fcu
