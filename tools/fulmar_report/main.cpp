// SPDX-License-Identifier: BSD-3-Clause
// `fulmar report LOG -o FILE.html`, as the program fulmar-report. Exit codes: 0 done; 1 it failed; 2 wrong
// usage.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <fstream>
#include <iterator>

#include "core/app/program.hpp"
#include "core/error.hpp"
#include "core/loader/home.hpp"
#include "tools/fulmar_report/report.hpp"

namespace {

namespace core = fulmar::core;
namespace fs = std::filesystem;

std::string page() {
  const fs::path folder = core::page_folder();
  std::ifstream in(folder / "report.html", std::ios::binary);
  if (folder.empty() || !in)
    throw core::Error(
        "this Fulmar was built without the page of a flight, which a report needs: install nodejs and npm, "
        "configure and build again");
  return {std::istreambuf_iterator<char>(in), {}};
}

int write_report(const std::string& log, std::string out, double rate_hz) {
  const core::McapFile file = core::read_mcap(log);
  if (out.empty()) out = fs::path(log).filename().replace_extension(".html").string();
  if (fs::exists(out)) throw core::Error(out + " is there already: give another name with -o");
  const std::string json = fulmar::report::log_json(file, fs::path(log).filename().string(), rate_hz);
  const std::string html = fulmar::report::with_log(page(), json);
  std::ofstream to(out, std::ios::binary);
  to << html;
  to.close();
  if (!to) throw core::Error(out + " cannot be written");
  if (!file.fault.empty()) std::printf("the log ends early: %s\n", file.fault.c_str());
  std::printf("%s: %.1f MB, for a browser\n", out.c_str(), 1e-6 * static_cast<double>(html.size()));
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"A log as one HTML file: the flight to look at, at any moment of it.", "fulmar report"};
  std::string log, out;
  double rate_hz = 10;
  app.add_option("log", log, "the log")->required()->check(CLI::ExistingFile)->type_name("LOG");
  app.add_option("-o,--out", out, "the file; default: the log's name in this folder, with .html");
  app.add_option("--rate", rate_hz, "at most so many messages of a topic per second; default 10")
      ->check(CLI::Range(0.1, 1000.0));
  return core::run_program(app, [&] {
    if (core::asked_for_rows(argc, argv)) return std::fputs(core::command_rows(app).c_str(), stdout), 0;
    app.parse(argc, argv);
    return write_report(log, out, rate_hz);
  });
}
