// SPDX-License-Identifier: BSD-3-Clause
#include "core/graph/shipped.hpp"

#include <algorithm>
#include <vector>

#include "core/error.hpp"
#include "core/graph/messages.hpp"
#include "core/loader/home.hpp"

namespace fulmar::core {
namespace fs = std::filesystem;
namespace {

constexpr std::string_view shipped_prefix = "fulmar:";

/// Folder of the installation, or of the source tree of this build. Empty when there is neither.
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

template <class Iterator>
std::vector<fs::path> yaml_files(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code code;
  for (Iterator it(folder, code), end; !code && it != end; it.increment(code))
    if (it->path().extension() == ".yaml") files.push_back(it->path());
  std::sort(files.begin(), files.end());
  return files;
}

/// ". Did you mean 'a.yaml'?": files with the nearest name, in any folder.
template <class Called>
std::string near_files(const std::string& stem, const std::vector<fs::path>& files, Called called) {
  std::vector<std::string> stems;
  for (const fs::path& file : files) stems.push_back(file.stem().string());
  const std::string near = nearest(stem, stems);
  std::string hint;
  for (std::size_t i = 0; i < files.size(); ++i)
    if (near.empty() ? stem.size() >= 3 && stems[i].starts_with(stem) : stems[i] == near)
      hint += (hint.empty() ? ". Did you mean '" : " or '") + called(files[i]) + "'";
  return hint.empty() ? hint : hint + "?";
}

}  // namespace

bool is_shipped_name(const std::string& name) { return name.starts_with(shipped_prefix); }

fs::path named_file(const fs::path& folder, const std::string& name) {
  if (!is_shipped_name(name)) return (folder / name).lexically_normal();
  const fs::path shipped = shipped_folder();
  return shipped.empty() ? fs::path(name) : (shipped / name.substr(shipped_prefix.size())).lexically_normal();
}

std::string shipped_name(const fs::path& file) {
  std::error_code code;
  const fs::path shipped = fs::canonical(shipped_folder(), code), real = fs::canonical(file, code);
  if (code || shipped.empty()) return {};
  const fs::path rest = real.lexically_relative(shipped);
  return rest.empty() || *rest.begin() == ".." ? std::string() : std::string(shipped_prefix) + rest.string();
}

std::string file_hint(const fs::path& path, const std::string& name) {
  const fs::path wanted(name), shipped = shipped_folder();
  if (is_shipped_name(name) && shipped.empty()) return graph_messages::program_not_installed().line();
  const std::string stem = wanted.stem().string();
  if (!is_shipped_name(name)) {
    const std::vector<fs::path> beside =
        yaml_files<fs::directory_iterator>(path.has_parent_path() ? path.parent_path() : fs::path("."));
    const auto called = [&](const fs::path& file) {
      return (wanted.parent_path() / file.filename()).string();
    };
    if (const std::string hint = near_files(stem, beside, called); !hint.empty()) return hint;
  }
  return near_files(stem, yaml_files<fs::recursive_directory_iterator>(shipped), [&](const fs::path& file) {
    return std::string(shipped_prefix) + file.lexically_relative(shipped).string();
  });
}

}  // namespace fulmar::core
