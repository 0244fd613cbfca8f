// SPDX-License-Identifier: BSD-3-Clause
#include "tools/fulmar_new/new_places.hpp"

#include <cstdlib>
#include <sstream>

#include "core/error.hpp"
#include "tools/fulmar_new/messages.hpp"

namespace fulmar::core {
namespace fs = std::filesystem;

fs::path this_program() {
  std::error_code code;
  const fs::path self = fs::read_symlink("/proc/self/exe", code);
  if (code) throw Error(new_messages::program_path_unknown(code.message()));
  return self;
}

Places find_places(const fs::path& program) {
  const fs::path prefix = program.parent_path().parent_path(), share = prefix / "share" / "fulmar";
  std::error_code code;
  if (fs::is_directory(share / "missions", code)) {
    if (!fs::is_directory(share / "template", code))
      throw Error(new_messages::templates_missing((share / "template").string()));
    return {share / "missions", share / "template", prefix / "include", prefix};
  }
  for (fs::path root = prefix; root.has_relative_path(); root = root.parent_path())
    if (fs::is_directory(root / "sdk" / "template", code))
      return {root / "configs" / "missions", root / "sdk" / "template", root / "sdk" / "include", prefix};
  throw Error(new_messages::missions_missing((share / "missions").string(), program.string()));
}

std::string shell_word(const std::string& text) {
  const auto plain = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) ||
           std::string_view("_-./+=:@%,").find(c) != std::string_view::npos;
  };
  bool quote = text.empty();
  std::string quoted = "'";
  for (const char c : text) {
    quote = quote || !plain(c);
    quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  }
  return quote ? quoted + "'" : text;
}

std::string program_word() {
  const fs::path host =
      this_program().parent_path() / "fulmar";  // the launcher that users call, which starts this program
  std::istringstream folders(std::getenv("PATH") ? std::getenv("PATH") : "");
  std::error_code code;
  for (std::string folder; std::getline(folders, folder, ':');) {
    const fs::path found = fs::path(folder) / host.filename();
    if (folder.empty() || !fs::exists(found, code)) continue;
    return fs::equivalent(found, host, code) ? host.filename().string() : shell_word(host.string());
  }
  return shell_word(host.string());
}

}  // namespace fulmar::core
