// SPDX-License-Identifier: BSD-3-Clause
#include "core/app/run_options.hpp"

#include <charconv>

#include "core/app/messages.hpp"
#include "core/run/component/realtime.hpp"
#include "core/tap/pace.hpp"

namespace fulmar::core {
namespace {

/// Fault of a duration; empty: none.
std::string not_seconds(const std::string& text) {
  double x = 0;
  const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), x);
  const bool good = code == std::errc{} && end == text.data() + text.size() && x > 0 && x <= 1e7;
  return good ? std::string() : app_messages::seconds_invalid(text).line();
}

/// "real" -> 1, "max" -> 0, "10" -> 10.
double parse_speed(const std::string& text) {
  const std::optional<double> speed = speed_of(text);
  if (!speed) throw CLI::ValidationError(app_messages::speed_invalid(text).line());
  return *speed;
}

}  // namespace

void RunArguments::add(CLI::App* command) {
  command->footer(
      "Example: fulmar run configs/missions/hourglass.yaml --seed 3 --set slc.roll_limit=\"30 deg\"");
  mission_.add(command);
  command->add_option("--speed", speed_, "set the pace: real, max, or a multiple of real time; default max");
  command->add_option("--duration", run_.duration_s, "end the flight after SECONDS of flight time")
      ->check(CLI::Validator(not_seconds, "SECONDS"));
  command->add_option("--log", run_.log_file, "write the log to FILE; default logs/<mission>-<UTC>.mcap")
      ->type_name("FILE")
      ->check(a_file("the log gets a name of its own in logs/"));
  command->add_flag("--no-log", run_.no_log, "write no log");
  command
      ->add_option("--report", report_file_,
                   "write an HTML report after the flight, beside the log or to FILE.html")
      ->expected(0, 1)
      ->type_name("[FILE.html]");
  command->add_flag("--json", run_.json, "print one JSON object instead of a table");
  command->add_flag("--strict", run_.strict,
                    "exit with code 3 after a completed flight in which a guard fired");
  add_many(command);
  command->add_option("--live", run_.live, "accept clients at ADDRESS:PORT, or off; default from the mission")
      ->type_name("ADDRESS:PORT");
  command
      ->add_flag("--realtime{" + std::to_string(usual_priority) + "}", run_.realtime,
                 "run the loop with locked memory and real-time priority, 1 to 99 as in --realtime=70")
      ->check(CLI::Range(1, 99));
  command
      ->add_option("--drivers-from", run_.drivers_from,
                   "read the samples of drivers from log FILE instead of their devices")
      ->type_name("FILE");
  add_resume(command);
}

void RunArguments::add_many(CLI::App* command) {
  CLI::Option* repeat =
      command->add_option("--repeat", many.repeat, "run NUMBER flights in one host, all with the same seed")
          ->type_name("NUMBER")
          ->check(CLI::Range(1, 1000000));
  CLI::Option* watch = command->add_flag(
      "--watch", many.watch,
      "after each flight wait for a change of a plugin or mission file, fly again and compare");
  command
      ->add_option("--seeds", many.seeds,
                   "run one flight per seed, as in 1..20 or 3,5,8..10, and print mean and standard "
                   "deviation")
      ->type_name("SEEDS")
      ->excludes(repeat)
      ->excludes(watch)
      ->excludes(command->get_option("--seed"));
  command
      ->add_option("--build", many.build,
                   "with --watch: run COMMAND after a change of a source file beside the mission")
      ->type_name("COMMAND");
}

void RunArguments::add_resume(CLI::App* command) {
  CLI::Option* resume =
      command
          ->add_option("--resume", resume_log_,
                       "continue where LOG ended; without LOG, the newest log of the mission")
          ->expected(0, 1)
          ->type_name("[LOG]");
  command
      ->add_flag(
          "--no-resume", run_.no_resume,
          "with --io fcu: start the mission from its beginning, even if the newest log ended in flight")
      ->excludes(resume);
}

RunOptions RunArguments::options(const CLI::App* command) const {
  RunOptions run = run_;
  run.mission = mission_.mission;
  run.overrides = mission_.overrides(command);
  run.speed = parse_speed(speed_);
  if (command->count("--resume") > 0) run.resume = resume_log_;
  if (command->count("--report") > 0) run.report = report_file_;
  if (run.report && run.no_log) throw CLI::ValidationError(app_messages::report_excludes_no_log().line());
  return run;
}

}  // namespace fulmar::core
