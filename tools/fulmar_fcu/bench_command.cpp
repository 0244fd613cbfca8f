// SPDX-License-Identifier: BSD-3-Clause
#include <cstdio>
#include <ctime>
#include <nlohmann/json.hpp>

#include "tools/fulmar_fcu/app.hpp"
#include "tools/fulmar_fcu/board_bench.hpp"
#include "tools/fulmar_fcu/param_file.hpp"

namespace fulmar::fcu {

namespace {

std::string utc_now() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  gmtime_r(&now, &parts);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &parts);
  return text;
}

}  // namespace

int bench_command(Client& client, const Options& options, const BenchOptions& what) {
  client.refuse_armed("measuring");
  show_progress("measuring; let it stand still");
  BoardReport report = measure_board(client, what.seconds);
  show_progress("");
  report.at = utc_now();
  const std::string markdown = board_markdown(report), json = board_json(report).dump(2) + "\n";
  if (!what.file.empty())
    write_param_file(what.file, what.file.ends_with(".json") ? json : markdown, what.replace);
  std::printf("%s", options.json ? json.c_str() : markdown.c_str());
  return 0;
}

}  // namespace fulmar::fcu
