// SPDX-License-Identifier: BSD-3-Clause
// Parameters in files: one "NAME: value" a line; and the list of {name, type, value} that ROSflight's tools
// write.
#pragma once
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "tools/fulmar_fcu/params.hpp"

namespace fulmar::fcu {

struct FileParam {
  std::string name, text;
  std::optional<bool> whole;  ///< if the file gives it
  core::Where where;
};

/// Throws Error with all faults, each with file:line.
std::vector<FileParam> read_param_file(const std::string& path);
/// Text of a parameter file, in the order of the parameters.
std::string param_file_text(const std::vector<Param>& params, const std::string& version);
/// Writes the complete file or nothing. Throws Error for an existing one, unless `replace`.
void write_param_file(const std::string& path, const std::string& text, bool replace);

struct Change {
  Param now;
  std::uint32_t bits = 0;
  core::Where where;
  std::string wanted() const;
};

/// Changes that the file would make. Throws Error with all faults: unknown names, values that do not fit the
/// type.
std::vector<Change> changes(const std::vector<FileParam>& file, const std::vector<Param>& now);
/// A table: name, value of the controller, value of the file.
std::string changes_text(const std::vector<Change>& list);

/// Sets the parameters of the file, reads all back, and returns those that differ.
std::vector<Change> load_params(Client& client, const std::vector<FileParam>& file, std::vector<Change> todo,
                                const std::function<void(std::size_t done, std::size_t all)>& progress = {});

}  // namespace fulmar::fcu
