// SPDX-License-Identifier: BSD-3-Clause
#include "core/app/file_names.hpp"

#include <spdlog/fmt/chrono.h>

#include <cstdio>
#include <ctime>
#include <nlohmann/json.hpp>

#include "core/app/messages.hpp"
#include "core/app/report_program.hpp"
#include "core/error.hpp"
#include "core/log/out_file.hpp"
#include "core/say.hpp"
#include "core/terminal.hpp"

namespace fulmar::core {

namespace fs = std::filesystem;

fs::path numbered(const fs::path& file, std::size_t n) {
  return file.parent_path() / (file.stem().string() + "-" + std::to_string(n) + file.extension().string());
}

void make_folder_of(const fs::path& file) {
  std::error_code fault;
  if (file.has_parent_path()) fs::create_directories(file.parent_path(), fault);
  if (fault) throw Error(app_messages::folder_not_created(file.parent_path().string(), fault.message()));
}

LogName free_name(const fs::path& wanted) {
  make_folder_of(wanted);
  fs::path file = wanted;
  std::error_code none;  // an invalid name is free; the error comes when the file is made
  for (std::size_t n = 2; fs::exists(file, none) || !OutFile::hold(file); ++n) file = numbered(wanted, n);
  return {file, true};
}

LogName default_log(const Graph& graph, const fs::path& folder, bool another) {
  if (!graph.record_file.empty())
    return graph.io == Io::fcu || another ? free_name(folder / graph.record_file)
                                          : LogName{folder / graph.record_file};
  return free_name(
      folder / fmt::format("logs/{}-{:%Y%m%dT%H%M%SZ}.mcap", graph.mission, fmt::gmtime(std::time(nullptr))));
}

void check_report(const std::string& wanted, const Graph& graph) {
  if (!graph.record) throw Error(app_messages::report_without_log());
  if (!wanted.empty() && !wanted.ends_with(".html")) throw Error(app_messages::report_name_invalid(wanted));
  check_report_program();
}

fs::path report_name(const std::string& wanted, const fs::path& start, const fs::path& log, std::size_t nth,
                     bool another) {
  fs::path file = report_beside(log);
  if (!wanted.empty()) {
    file = (start / wanted).lexically_normal();
    if (nth > 1) file = numbered(file, nth);
  }
  std::error_code none;
  if (!another && fs::exists(file, none)) throw Error(app_messages::report_exists(file.string()));
  const fs::path taken = file;
  for (std::size_t n = 2; fs::exists(file, none); ++n) file = numbered(taken, n);
  return file;
}

bool report_flight(const fs::path& file, const fs::path& log, const nlohmann::json& result, bool quiet) try {
  if (log.empty()) throw Error(app_messages::report_log_missing());
  make_folder_of(file);
  make_report(log, file, result.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace));
  if (!quiet) std::printf("report %s\n", for_terminal(file.string()).c_str());
  std::fflush(stdout);
  return true;
} catch (const Error& fault) {
  warn(fault.what());
  return false;
}

}  // namespace fulmar::core
