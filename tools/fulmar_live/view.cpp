// SPDX-License-Identifier: BSD-3-Clause
#include "tools/fulmar_live/view.hpp"

#include <spawn.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <tuple>

#include "core/app/report_program.hpp"
#include "core/graph/shipped.hpp"
#include "core/loader/home.hpp"
#include "core/terminal.hpp"
#include "core/types/text.hpp"
#include "tools/fulmar_live/commands.hpp"
#include "tools/fulmar_live/messages.hpp"

extern char** environ;

namespace fulmar::core {
namespace {

namespace fs = std::filesystem;

constexpr std::array viewers = {"page", "lichtblick", "foxglove", "rerun", "plotjuggler"};

std::string layout_file(const char* name) {
  const fs::path file = named_file(".", std::string("fulmar:layouts/") + name);
  return fs::exists(file) ? file.string() : "";
}

std::string query(const LiveAddress& target) {
  return target.token.empty() ? "" : "?token=" + percent_encoded(target.token);
}

/// Of Lichtblick and Foxglove: the whole text after `ds.url` is one value.
std::string live_link(const std::string& scheme, const LiveAddress& target) {
  return scheme + "://open?ds=foxglove-websocket&ds.url=" +
         percent_encoded("ws://" + target.text() + "/" + query(target));
}

Opening of_link(const std::string& link, const std::string& layout) {
  return {{"xdg-open", link}, link, layout, {}, ""};
}

std::string in_path(const std::string& program) {
  const char* list = std::getenv("PATH");
  std::istringstream folders(list ? list : "");
  for (std::string folder; std::getline(folders, folder, ':');) {
    const fs::path file = fs::path(folder) / program;
    if (file.is_absolute() && can_run(file)) return file.string();
  }
  return "";
}

bool has_display() {
  const auto set = [](const char* name) {
    const char* value = std::getenv(name);
    return value && *value != '\0';
  };
  return set("DISPLAY") || set("WAYLAND_DISPLAY");
}

/// The viewer continues after the end of this program and of its terminal.
void start(const std::string& program, const std::vector<std::string>& words) {
  std::vector<std::string> copies = words;
  std::vector<char*> arguments;
  for (std::string& word : copies) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSID);
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  for (const int to : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    posix_spawn_file_actions_addopen(&files, to, "/dev/null", to == STDIN_FILENO ? 0 : 1, 0);
  pid_t child = 0;
  const int fault = posix_spawn(&child, program.c_str(), &files, &attributes, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&files);
  posix_spawnattr_destroy(&attributes);
  if (fault != 0) throw Error(remote_messages::program_start_failed(program, std::strerror(fault)));
}

std::string whole_log(const std::string& name) {
  const fs::path file = name;
  if (fs::is_directory(file)) throw Error(remote_messages::log_is_folder(name));
  if (!fs::exists(file)) throw Error(remote_messages::log_missing(name));
  if (file.extension() == ".part") throw Error(remote_messages::log_incomplete(name));
  std::array<char, 5> magic{};
  std::ifstream(file, std::ios::binary).read(magic.data(), magic.size());
  if (std::memcmp(magic.data(), "\x89MCAP", magic.size()) != 0)
    throw Error(remote_messages::log_expected(name));
  return fs::absolute(file).lexically_normal().string();
}

/// The page of a log, next to it. An existing page is used if it is newer than the log.
void make_page(const std::string& log, const std::string& file) {
  if (!fs::exists(file)) return make_report(log, file, "");
  if (fs::last_write_time(file) < fs::last_write_time(log))
    throw Error(remote_messages::page_outdated(file, log));
}

}  // namespace

std::string percent_encoded(const std::string& text) {
  std::string out;
  for (const char c : text) {
    const bool plain = (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
                       std::strchr("-._~", c) != nullptr;
    char hex[4];
    std::snprintf(hex, sizeof hex, "%%%02X", static_cast<unsigned>(static_cast<unsigned char>(c)));
    out += plain && c != '\0' ? std::string(1, c) : std::string(hex);
  }
  return out;
}

std::string shell_quoted(const std::string& word) {
  const bool plain = !word.empty() && word.find_first_not_of(
                                          "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRST"
                                          "UVWXYZ0123456789-._/:=,+@%") == std::string::npos;
  if (plain) return word;
  std::string out = "'";
  for (const char c : word) c == '\'' ? out += "'\\''" : out += c;
  return out + "'";
}

Opening opening_of(const std::string& viewer, const std::string& log, const LiveAddress& target) {
  const std::string& in = viewer;
  const std::string layout = layout_file("fulmar.json"), curves = layout_file("plotjuggler.xml");
  const std::string import = "once: Layouts, Import from file, the layout above";
  if (in == "page") {
    if (!log.empty()) {
      const std::string file = report_beside(log).string();
      return {{"xdg-open", file}, "", "", {}, file};
    }
    return of_link("http://" + target.text() + "/" + query(target), "");
  }
  if (in == "lichtblick") {
    const std::string copy =
        "or once, then it has the name fulmar: mkdir -p ~/.lichtblick-suite/layouts && cp " +
        shell_quoted(layout) + " ~/.lichtblick-suite/layouts/";
    if (log.empty()) {
      Opening o = of_link(live_link("lichtblick", target), layout);
      o.to_do = {import, copy};
      return o;
    }
    return {{"lichtblick", "--source=" + log, "--defaultLayout=fulmar"}, "", layout, {import, copy}, ""};
  }
  if (in == "foxglove") {
    if (log.empty()) {
      Opening o = of_link(live_link("foxglove", target), layout);
      o.to_do = {import};
      return o;
    }
    return {{"foxglove-studio", log}, "", layout, {import}, ""};
  }
  if (in == "plotjuggler") {
    if (!log.empty()) return {{"plotjuggler", "-d", log, "-l", curves}, "", curves, {}, ""};
    return {{"plotjuggler", "-l", curves},
            "",
            curves,
            {"Streaming, Foxglove Bridge, address " + target.text() + ": of its plugin of that name"},
            ""};
  }
  if (in == "rerun") {
    if (log.empty()) throw WrongUsage(remote_messages::viewer_without_live_view());
    return {{"rerun", log}, "", "", {}, ""};
  }
  throw WrongUsage(remote_messages::viewer_unknown(
      in, choices_text(in, std::vector<std::string>(viewers.begin(), viewers.end()))));
}

int view_command(const LiveAddress& target, const ViewOptions& options) {
  const bool running = options.what.empty() || options.what == "running";
  const std::string viewer = !options.in.empty() ? options.in : running ? "page" : "lichtblick";
  // starts it under its first name
  if (!running && viewer != "page") std::ignore = opening_of(viewer, "x", target);
  const std::string log = running ? "" : whole_log(options.what);
  const Opening opening = opening_of(viewer, log, target);
  if (running && !options.print)
    Client(target, std::chrono::seconds(5));  // reports the fault without a flight
  if (!opening.report.empty()) make_page(log, opening.report);
  std::string line;
  for (const std::string& word : opening.words) line += (line.empty() ? "" : " ") + shell_quoted(word);
  std::printf("%s\n", for_terminal(opening.link.empty() ? line : opening.link).c_str());
  if (options.print) return 0;
  if (!opening.layout.empty()) std::printf("layout: %s\n", opening.layout.c_str());
  for (const std::string& what : opening.to_do) std::printf("%s\n", what.c_str());
  if (!has_display() || ::isatty(STDOUT_FILENO) == 0) return 0;
  const std::string program = in_path(opening.words.front());
  if (program.empty()) {
    std::printf("%s\n", remote_messages::viewer_not_installed(opening.words.front()).text.c_str());
    return 1;
  }
  std::fflush(stdout);
  start(program, opening.words);
  return 0;
}

}  // namespace fulmar::core
