// SPDX-License-Identifier: BSD-3-Clause
#include "core/graph/shipped.hpp"

#include <algorithm>
#include <vector>

#include "core/error.hpp"
#include "core/loader/home.hpp"

namespace fulmar::core {
namespace fs = std::filesystem;
namespace {

constexpr std::string_view prefix = "fulmar:";

/// Of an installation, or of the source tree that a program was built in. Empty when there is neither.
fs::path shipped_folder() {
  std::error_code code;
  for (const fs::path& home : home_folders()) {
    const fs::path share = home / "share" / "fulmar";
    if (fs::is_directory(share / "missions", code)) return share;
    for (fs::path root = home; root.has_relative_path(); root = root.parent_path())
      if (fs::is_directory(root / "configs" / "missions", code)) return root / "configs";
  }
  return {};
}

}  // namespace

bool is_shipped_name(const std::string& name) { return name.starts_with(prefix); }

fs::path named_file(const fs::path& folder, const std::string& name) {
  if (!is_shipped_name(name)) return (folder / name).lexically_normal();
  const fs::path shipped = shipped_folder();
  return shipped.empty() ? fs::path(name) : (shipped / name.substr(prefix.size())).lexically_normal();
}

std::string shipped_name(const fs::path& file) {
  std::error_code code;
  const fs::path shipped = fs::canonical(shipped_folder(), code), real = fs::canonical(file, code);
  if (code || shipped.empty()) return {};
  const fs::path rest = real.lexically_relative(shipped);
  return rest.empty() || *rest.begin() == ".." ? std::string() : std::string(prefix) + rest.string();
}

std::string shipped_choices(const std::string& name) {
  if (!is_shipped_name(name)) return {};
  const fs::path shipped = shipped_folder();
  if (shipped.empty()) return ": this program is not installed";
  std::vector<std::string> names;
  std::error_code code;
  for (fs::recursive_directory_iterator it(shipped, code), end; !code && it != end; it.increment(code))
    if (it->path().extension() == ".yaml")
      names.push_back(std::string(prefix) + fs::relative(it->path(), shipped, code).string());
  std::sort(names.begin(), names.end());
  return "." + choices_text(name, names);
}

}  // namespace fulmar::core
