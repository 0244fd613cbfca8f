// SPDX-License-Identifier: BSD-3-Clause
// `fulmar aero fly`: from an airframe file to a flight, in one.
#include "core/app/program.hpp"
#include "core/types/text.hpp"
#include "tools/fulmar_aero/commands.hpp"
#include "tools/fulmar_aero/messages.hpp"
#include "tools/fulmar_aero/see/fly_report.hpp"
#include "tools/fulmar_aero/see/page.hpp"
#include "tools/fulmar_aero/words.hpp"

namespace fulmar::aero {
namespace {

/// Returns the exit code; `record` holds the completed steps.
int steps_of_fly(const FlightOptions& options, bool write, FlyRecord& record) {
  const auto step = [&](const char* name, int code) {
    if (code == core::ExitCode::done) return true;
    record.verdict = aero_messages::flight_skipped(name).line();
    std::fprintf(stderr, "%s\n", record.verdict.c_str());
    return false;
  };
  if (!step("check", check_command(options))) return core::ExitCode::failed;
  print_text("\n");
  if (!step("trim", trim_command(options))) return core::ExitCode::failed;
  print_text("\n");
  if (!step("modes", modes_command(options, "", ""))) return core::ExitCode::failed;
  print_text("\n");
  TuneOptions tuning;
  tuning.verify = true;
  tuning.write = write;
  record.tuned = tune_outcome(options, tuning);
  for (const std::string& sentence : record.tuned->faults)
    std::fprintf(stderr, "%s\n", core::for_terminal(sentence).c_str());
  record.verdict = record.tuned->code != core::ExitCode::done ? aero_messages::flight_unacceptable.c_str()
                   : write                                    ? aero_messages::flight_acceptable.c_str()
                                                              : "flown";
  if (!record.tuned->flown || record.tuned->flown->result != "flown") record.verdict = "not flown";
  return record.tuned->code;
}

}  // namespace

int fly_command(const FlightOptions& options, bool write, const std::string& report) {
  refuse_as_page(report, {options.airframe});
  // Values written below are valid for the page too: gains change only the section of gains.
  const AirframeFile file = read_airframe_file(options.airframe);
  Findings findings(file);
  FlyRecord record{&file, &findings, options.altitude_m(), {}, ""};
  const int code = steps_of_fly(options, write, record);
  if (report.empty()) return code;
  check_all(findings, record.altitude_m);
  write_page(report, fly_report_html(record));
  print_text("written: " + core::for_terminal(report) + "\n");
  return code;
}

}  // namespace fulmar::aero
