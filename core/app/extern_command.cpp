// SPDX-License-Identifier: BSD-3-Clause
#include "core/app/extern_command.hpp"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <sstream>

#include "core/app/messages.hpp"
#include "core/error.hpp"
#include "core/loader/home.hpp"

namespace fulmar::core {
namespace {

namespace fs = std::filesystem;

constexpr const char* program_prefix = "fulmar-";

/// Whether a word can be a subcommand: no path, and no helper that only the host itself starts.
bool is_command(const std::string& word) {
  constexpr const char* letters = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-";
  static const std::vector<std::string> parts{
      "campaign", "child", "inspect", "live", "log",
      "new",      "probe", "replay",  "save"};  // of Fulmar, not subcommands
  return !word.empty() && word[0] != '-' && word.find_first_not_of(letters) == std::string::npos &&
         std::find(parts.begin(), parts.end(), word) == parts.end();
}

fs::path find_program(const std::string& name) {
  if (const fs::path own = own_program(name); !own.empty()) return own;
  const char* list = std::getenv("PATH");
  std::istringstream folders(list ? list : "");
  for (std::string folder; std::getline(folders, folder, ':');) {
    const fs::path file = fs::path(folder) / name;
    if (file.is_absolute() && can_run(file)) return file;  // independent of the working directory
  }
  return {};
}

[[noreturn]] void become(const fs::path& program, const std::string& word, char** words) {
  std::string name = program.string();
  words[0] = name.data();
  ::execv(name.c_str(), words);
  throw Error(app_messages::command_not_started(word, name, std::strerror(errno)));
}

}  // namespace

const std::vector<OwnCommand>& own_commands() {
  static const std::vector<OwnCommand> list = {
      {"check", "fulmar-inspect", "check a mission file and report all errors"},
      {"graph", "fulmar-inspect", "print components, connections, order and phases of a mission"},
      {"inspect", "fulmar-inspect", "print components, parameters and ports of a plugin"},
      {"new", "fulmar-new", "create a plugin project for a mission"},
      {"replay", "fulmar-replay", "replay a recorded flight through its mission and compare the outputs"},
      {"log", "fulmar-log", "inspect, repair, export and compare logs"},
      {"response", "fulmar-log", "compute step and frequency response between two log fields"},
      {"list", "fulmar-live", "list components, ports, requests and phases of a running flight"},
      {"watch", "fulmar-live", "show a running flight on one terminal screen"},
      {"echo", "fulmar-live", "print messages of a running flight, angles in degrees"},
      {"plot", "fulmar-live", "plot fields of a running flight or of logs"},
      {"view", "fulmar-live", "open a log or the running flight in a viewer"},
      {"param", "fulmar-live", "list, read, set and save parameters of a running flight"},
      {"call", "fulmar-live", "call a component's request port: {field: value, ...} or field=value ..."},
      {"phase", "fulmar-live", "enter a phase of the mission"},
      {"swap", "fulmar-live", "replace the plugin file of a component, on the ground"},
      {"reset", "fulmar-live", "clear latched guards"},
      {"pause", "fulmar-live", "pause a simulation"},
      {"resume", "fulmar-live", "resume a paused simulation"},
      {"step", "fulmar-live", "advance a paused simulation by TICKS"},
      {"speed", "fulmar-live", "set the speed of a simulation"},
      {"restart", "fulmar-live", "restart the mission of a simulation in the same host"},
      {"completion", "fulmar-live", "print a shell completion script"},
      {"complete", "fulmar-live", ""}};  // used by shells, not in the help
  return list;
}

void become_own_command(char** words) {
  if (words[1] == nullptr) return;
  const std::string word = words[1];
  for (const OwnCommand& command : own_commands()) {
    if (command.word != word) continue;
    become_program(command.program, words);
  }
}

void become_program(const std::string& name, char** words) {
  const fs::path program = own_program(name);
  const std::string word = words[1];
  if (program.empty()) throw Error(app_messages::command_program_missing(word, name));
  become(program, word, words);
}

std::vector<std::string> extern_commands() {
  std::error_code fault;
  const fs::path folder = fs::read_symlink("/proc/self/exe", fault).parent_path();
  std::vector<std::string> words;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, fault)) {
    const std::string name = entry.path().filename().string();
    const std::string word =
        name.rfind(program_prefix, 0) == 0 ? name.substr(std::strlen(program_prefix)) : "";
    if (is_command(word) && can_run(entry.path())) words.push_back(word);
  }
  std::sort(words.begin(), words.end());
  return words;
}

void become_extern_command(char** words) {
  const std::string word = words[0];
  const fs::path program = is_command(word) ? find_program(program_prefix + word) : fs::path();
  if (!program.empty()) become(program, word, words);
}

}  // namespace fulmar::core
