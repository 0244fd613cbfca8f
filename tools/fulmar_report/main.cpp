// SPDX-License-Identifier: BSD-3-Clause
// `fulmar report LOG [LOG...] -o FILE.html`, as the program fulmar-report. Exit codes: 0 done; 1 it failed; 2
// wrong usage.
#include <CLI/CLI.hpp>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <iostream>
#include <iterator>

#include "core/app/program.hpp"
#include "core/error.hpp"
#include "core/graph/yaml.hpp"
#include "core/loader/home.hpp"
#include "core/types/text.hpp"
#include "tools/fulmar_log/terminal.hpp"
#include "tools/fulmar_report/messages.hpp"
#include "tools/fulmar_report/report.hpp"
#include "tools/log_reading/log_file.hpp"

namespace {

namespace core = fulmar::core;
namespace report = fulmar::report;
namespace fs = std::filesystem;

constexpr std::size_t most_bytes = 4'900'000;  // of the file, without --rate
constexpr double usual_rate_hz = 10;

struct Words {
  std::vector<std::string> logs, names;
  std::string out, result;
  double rate_hz = 0;  // 0: the default, reduced for a file that is too large
};

std::string whole_text(std::istream& in) { return {std::istreambuf_iterator<char>(in), {}}; }

std::string page() {
  const fs::path folder = core::page_folder();
  std::ifstream in(folder / "report.html", std::ios::binary);
  if (folder.empty() || !in) throw core::Error(fulmar::report_messages::page_not_built());
  return whole_text(in);
}

void check(const Words& words) {
  if (words.logs.size() > report::max_logs)
    throw CLI::ValidationError(
        fulmar::report_messages::too_many_logs(report::max_logs, words.logs.size()).line());
  if (!words.names.empty() && words.names.size() != words.logs.size())
    throw CLI::ValidationError(
        fulmar::report_messages::name_count_mismatch(words.logs.size(), words.names.size()).line());
  if (!words.result.empty() && words.logs.size() > 1)
    throw CLI::ValidationError(fulmar::report_messages::result_with_logs().line());
  for (std::size_t i = 0; i < words.logs.size(); ++i) {
    core::check_log_file(words.logs[i]);
    std::error_code none;
    for (std::size_t k = 0; k < i; ++k)
      if (fs::equivalent(words.logs[i], words.logs[k], none))
        throw core::Error(fulmar::report_messages::log_duplicate(words.logs[i]));
  }
}

/// "a.mcap" -> "a.html"; of several logs "a-and-2.html".
std::string usual_out(const std::vector<std::string>& logs) {
  fs::path file = fs::path(logs.front()).filename();
  while (file.extension() == ".part" || file.extension() == ".mcap") file = file.stem();
  const std::size_t more = logs.size() - 1;
  return file.string() + (more > 0 ? "-and-" + std::to_string(more) : "") + ".html";
}

/// The step times in the output of `fulmar run --json`.
nlohmann::json step_times(const std::string& file) {
  const std::string text = file == "-" ? whole_text(std::cin) : core::read_source(file, file)->text;
  const nlohmann::json result = nlohmann::json::parse(text, nullptr, false);
  if (!result.is_object() || !result.contains("step_time_us"))
    throw core::Error(fulmar::report_messages::result_expected(file));
  return result["step_time_us"];
}

int write_report(const Words& words) {
  check(words);
  const std::string out = words.out.empty() ? usual_out(words.logs) : words.out;
  if (fs::exists(out)) throw core::Error(fulmar::report_messages::report_exists(out));
  const std::string empty_page = page();
  const std::vector<std::string> names = words.names.empty() ? report::short_names(words.logs) : words.names;
  const double rate_hz = words.rate_hz > 0 ? words.rate_hz : usual_rate_hz;
  std::vector<report::ReportedLog> logs;
  for (std::size_t i = 0; i < words.logs.size(); ++i)
    logs.push_back(report::read_log(words.logs[i], names[i], rate_hz));
  if (!words.result.empty()) logs[0].steps = step_times(words.result);
  const std::size_t room = most_bytes - std::min(most_bytes, empty_page.size());
  const report::Fitted fitted =
      words.rate_hz > 0 ? report::Fitted{report::report_json(logs, 1), 1} : report::fitted_json(logs, room);
  const std::string html = report::with_logs(empty_page, fitted.json);
  std::ofstream to(out, std::ios::binary);
  to << html;
  to.close();
  if (!to) throw core::Error(fulmar::report_messages::report_not_writable(out, std::strerror(errno)));
  for (const report::ReportedLog& log : logs)
    if (!log.info.file.fault.empty())
      std::printf("%s ends early: %s\n", core::printable(log.name).c_str(),
                  core::printable(log.info.file.fault).c_str());
  if (fitted.every_nth > 1)
    std::printf("thinned out to %g Hz, so that it stays small; --rate %g keeps all of it\n",
                rate_hz / static_cast<double>(fitted.every_nth), rate_hz);
  std::printf("%s: %.1f MB, for a browser\n", core::printable(out).c_str(),
              1e-6 * static_cast<double>(html.size()));
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Write logs as one HTML report with figures, curves and a replay of the flight.",
               "fulmar report"};
  Words words;
  app.add_option("logs", words.logs, "one log, or up to six side by side")->required()->type_name("LOG");
  app.add_option("-o,--out", words.out,
                 "write the report to FILE; default: the log's name in this folder, with .html")
      ->type_name("FILE");
  app.add_option("--rate", words.rate_hz,
                 "limit each topic to RATE messages per second; default 10, fewer if the file would "
                 "exceed 5 MB")
      ->type_name("RATE")
      ->check(CLI::Range(0.1, 1000.0));
  app.add_option("--names", words.names, "set the names of the logs, as in --names before,after")
      ->type_name("NAMES")
      ->delimiter(',');
  app.add_option("--result", words.result,
                 "add step times from FILE, the output of fulmar run --json, or - for standard input")
      ->type_name("FILE");
  app.footer("Example: fulmar report logs/hourglass.mcap --out hourglass.html");
  return core::run_program(app, [&] {
    if (core::asked_for_rows(argc, argv)) {
      std::fputs(core::command_rows(app).c_str(), stdout);
      return 0;
    }
    app.parse(argc, argv);
    return write_report(words);
  });
}
