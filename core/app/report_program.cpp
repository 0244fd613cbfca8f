// SPDX-License-Identifier: BSD-3-Clause
#include "core/app/report_program.hpp"

#include <unistd.h>

#include <chrono>
#include <vector>

#include "core/app/messages.hpp"
#include "core/error.hpp"
#include "core/loader/home.hpp"
#include "core/loader/memory_file.hpp"
#include "core/loader/process.hpp"

namespace fulmar::core {
namespace {

namespace fs = std::filesystem;

constexpr std::chrono::minutes patience{30};  // a log may have gigabytes
constexpr const char* program = "fulmar-report";

}  // namespace

void check_report_program() {
  if (own_program(program).empty()) throw Error(app_messages::report_program_missing(program));
  if (std::error_code none; !fs::exists(page_folder() / "report.html", none))
    throw Error(app_messages::report_page_missing());
}

void make_report(const fs::path& log, const fs::path& out, const std::string& result) {
  check_report_program();
  const MemoryFile file(result);
  std::vector<std::string> words{"--out=" + out.string()};
  if (!result.empty()) words.insert(words.end(), {"--result", "-"});
  words.insert(words.end(), {"--", log.string()});
  ChildFiles files;
  if (!result.empty()) files.in = file.descriptor();
  files.error = STDERR_FILENO;
  Process process(own_program(program).string(), words, files);
  if (!process.wait(patience)) throw Error(app_messages::report_timed_out(log.string()));
  if (process.signal() != 0 || process.exit_code() != 0)
    throw Error(app_messages::report_not_made(log.string()));
}

fs::path report_beside(const fs::path& log) {
  fs::path file = log;
  if (file.extension() == ".part") file.replace_extension();
  return file.replace_extension(".html");
}

}  // namespace fulmar::core
