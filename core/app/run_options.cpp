// SPDX-License-Identifier: BSD-3-Clause
#include "core/app/run_options.hpp"

#include <charconv>

#include "core/app/messages.hpp"
#include "core/run/component/realtime.hpp"
#include "core/tap/pace.hpp"

namespace fulmar::core {
namespace {

/// What is wrong with a duration; empty: nothing.
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
  mission_.add(command);
  command->add_option("--speed", speed_, "real, max, or a multiple of real time");
  command->add_option("--duration", run_.duration_s, "end after so many seconds of flight")
      ->check(CLI::Validator(not_seconds, "SECONDS"));
  command->add_option("--log", run_.log_file, "where to write the log; default logs/<mission>-<UTC>.mcap")
      ->check(a_file("the log gets a name of its own in logs/"));
  command->add_flag("--no-log", run_.no_log, "write no log");
  command
      ->add_option("--report", report_file_,
                   "make an HTML page of the log when the flight is over: beside the log, or FILE.html")
      ->expected(0, 1)
      ->type_name("[FILE.html]");
  command->add_flag("--json", run_.json, "print one JSON object instead of a table");
  command->add_flag("--strict", run_.strict, "exit code 3 when a guard has fired in a flight that was flown");
  add_many(command);
  command
      ->add_option("--live", run_.live,
                   "ADDRESS:PORT where onlookers connect, or off; default: what the mission says")
      ->type_name("ADDRESS:PORT");
  command
      ->add_flag("--realtime{" + std::to_string(usual_priority) + "}", run_.realtime,
                 "real-time priority, 1 to 99 as in --realtime=70, and locked memory for the loop")
      ->check(CLI::Range(1, 99));
  command->add_option("--drivers-from", run_.drivers_from,
                      "take the samples of drivers from this log, in place of their devices");
  add_resume(command);
}

void RunArguments::add_many(CLI::App* command) {
  CLI::Option* repeat =
      command->add_option("--repeat", many.repeat, "so many flights in one host, all with the same seed")
          ->check(CLI::Range(1, 1000000));
  CLI::Option* watch = command->add_flag(
      "--watch", many.watch,
      "after a flight wait until a plugin or file of the mission changes, fly again, and compare");
  command
      ->add_option("--seeds", many.seeds,
                   "a flight with each seed, as in 1..20 or 3,5,8..10; ends with their figures' mean and "
                   "deviation")
      ->type_name("SEEDS")
      ->excludes(repeat)
      ->excludes(watch)
      ->excludes(command->get_option("--seed"));
  command->add_option("--build", many.build,
                      "with --watch: command to run when a source file beside the mission has changed");
}

void RunArguments::add_resume(CLI::App* command) {
  CLI::Option* resume =
      command
          ->add_option("--resume", resume_log_,
                       "go on where this log ended, or without a file the newest of the mission")
          ->expected(0, 1)
          ->type_name("[LOG]");
  command
      ->add_flag("--no-resume", run_.no_resume,
                 "with --io fcu: begin at the beginning, also when the newest log ended in the air")
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
