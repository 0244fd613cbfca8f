// SPDX-License-Identifier: BSD-3-Clause
// The list of plugins that a mission may load, and who may have written them.
#include "core/graph/trust.hpp"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>

#include "core/graph/graph.hpp"
#include "core/loader/home.hpp"
#include "core/types/text.hpp"

namespace fulmar::core {
namespace {

namespace fs = std::filesystem;

bool is_hash(const std::string& text) {
  return text.size() == 64 && text.find_first_not_of("0123456789abcdef") == std::string::npos;
}

bool is_plugin_file(const std::string& name) { return name.ends_with(".so") || name.ends_with(".py"); }

fs::path real_path(const fs::path& file) {
  std::error_code code;
  const fs::path path = fs::weakly_canonical(fs::absolute(file), code);
  return code ? file.lexically_normal() : path;
}

struct stat status_of(const fs::path& path) {
  struct stat info {};
  if (::stat(path.c_str(), &info) != 0)
    throw Error(path.string() + " cannot be looked at: " + std::strerror(errno));
  return info;
}

// Root acts for the user who called sudo.
bool is_trusted_owner(uid_t owner) {
  if (owner == 0 || owner == ::geteuid()) return true;
  const char* caller = ::geteuid() == 0 ? std::getenv("SUDO_UID") : nullptr;
  return caller != nullptr && std::to_string(owner) == caller;
}

void check_folder(const fs::path& folder, const std::string& name) {
  const struct stat info = status_of(folder);
  if ((info.st_mode & S_IWOTH) != 0 && (info.st_mode & S_ISVTX) == 0)
    throw Error(name + " is not loaded: everybody may replace files in its folder; chmod o-w " +
                folder.string());
}

}  // namespace

void check_private_file(const fs::path& file) {
  const fs::path path = real_path(file);
  const std::string name = file.filename().string();
  const struct stat info = status_of(path);
  if ((info.st_mode & S_IWOTH) != 0)
    throw Error(name + " is not loaded: everybody may write to it; chmod o-w " + path.string());
  if (!is_trusted_owner(info.st_uid))
    throw Error(name + " is not loaded: it belongs to the user " + std::to_string(info.st_uid) +
                ", neither to you nor to root; chown it: " + path.string());
  check_folder(path.parent_path(), name);
}

Trust::Trust(const MissionText& mission, Report& report) {
  if (mission.plugins.is(Node::Kind::missing)) return;
  listed_ = true;
  home_ = (mission.plugins.file ? mission.plugins.file : mission.file)->path.parent_path();
  if (home_.empty()) home_ = ".";  // a mission named without a folder
  read(mission.plugins, report);
}

void Trust::read(const Node& node, Report& report) {
  const Keys keys(node, "plugins", {"allow"}, report);
  const Node* allow = keys.get("allow");
  where_ = allow != nullptr ? keys.where("allow") : node.where();
  if (!node.is(Node::Kind::map)) return;
  if (allow == nullptr)
    return report.add(node.where(), "plugins: 'allow' is missing, as in {allow: [control_slc, my_law.so]}");
  for (const Node& item : keys.items("allow", "a list such as [control_slc, my_law.so]"))
    read_entry(item, report);
}

void Trust::read_entry(const Node& node, Report& report) {
  static const std::string path = "plugins.allow";
  Entry entry;
  entry.where = node.where();
  if (node.is(Node::Kind::map)) {
    const Keys keys(node, path, {"file", "sha256"}, report);
    entry.text = keys.text("file").value_or("");
    entry.sha256 = lower(keys.text("sha256").value_or(""));
    if (!keys.has("file"))
      report.add(node.where(), path + ": 'file' is missing, as in {file: my_law.so, sha256: ...}");
    if (keys.has("sha256") && !is_hash(entry.sha256))
      return report.add(keys.where("sha256"), path + ".sha256: expected 64 hexadecimal digits, found " +
                                                  found_words(*keys.get("sha256")));
  } else {
    entry.text =
        scalar_text(node, path, "the name or file of a plugin, or {file, sha256}", report).value_or("");
  }
  if (entry.text.empty()) return;
  entry.files = meaning(entry.text, node, report);
  if (!entry.files.empty()) entries_.push_back(std::move(entry));
}

// "control_slc" is a plugin of that name; "my_law.so" a file beside this one, or a plugin of that name;
// "build/my_law.so" a file; "build/*" every file of that folder.
std::vector<fs::path> Trust::meaning(const std::string& text, const Node& node, Report& report) const {
  const fs::path path = text;
  const std::string last = path.filename().string();
  std::vector<fs::path> files;
  const bool pattern = text.find('*') != std::string::npos, named = text.find('/') == std::string::npos;
  if (pattern && (named || last != "*" || path.parent_path().string().find('*') != std::string::npos)) {
    report.add(node.where(),
               "plugins.allow: '" + text + "': a '*' stands alone for the files of a folder, as in build/*");
  } else if (pattern) {
    files.push_back(real_path(home_ / path.parent_path()) / "*");
  } else if (!named && !is_plugin_file(last)) {
    report.add(node.where(), "plugins.allow: '" + text +
                                 "' is no file of a plugin; write the name of a plugin (control_slc), a file "
                                 "(build/my_law.so) or a folder (build/*)");
  } else {
    if (is_plugin_file(last)) files.push_back(real_path(home_ / path));
    if (named)
      for (const fs::path& folder : plugin_folders())
        files.push_back(real_path(folder / (is_plugin_file(last) ? text : text + ".so")));
  }
  return files;
}

bool Trust::Entry::covers(const fs::path& file) const {
  return std::any_of(files.begin(), files.end(), [&](const fs::path& mine) {
    return mine == file || (mine.filename() == "*" && mine.parent_path() == file.parent_path());
  });
}

Expected Trust::check(const fs::path& file) const {
  check_private_file(file);
  if (!listed_) return {};
  const fs::path path = real_path(file);
  Expected expected;
  bool allowed = false, any_content = false;
  for (const Entry& entry : entries_) {
    if (!entry.covers(path)) continue;
    allowed = true;
    any_content = any_content || entry.sha256.empty();
    if (expected.where.empty()) expected.where = entry.where.text();
    expected.sha256.push_back(entry.sha256);
  }
  if (!allowed) refuse(path);
  return any_content ? Expected{} : expected;
}

void Trust::refuse(const fs::path& file) const {
  const std::vector<fs::path> folders = plugin_folders();
  const bool named = std::any_of(folders.begin(), folders.end(),
                                 [&](const fs::path& f) { return real_path(f) == file.parent_path(); });
  std::string entry = named && file.extension() == ".so" ? file.stem().string() : file.filename().string();
  if (!named)
    entry = "{file: " + file.lexically_proximate(real_path(home_)).string() +
            ", sha256: " + sha256_file(file) + "}";
  std::vector<std::string> texts;
  for (const Entry& e : entries_) texts.push_back(e.text);
  throw Error(file.filename().string() +
              " is not among the plugins that this mission allows: " + join(texts) + ". Write " + entry +
              " into plugins.allow (" + where_.text() + ") if you trust it");
}

}  // namespace fulmar::core
