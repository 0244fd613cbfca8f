// SPDX-License-Identifier: BSD-3-Clause
// The command line. Exit codes: 0 done; 1 the flight, check or file failed; 2 wrong usage; 130 interrupted.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cstdio>
#include <functional>
#include <string_view>

#include "core/app/extern_command.hpp"
#include "core/app/many.hpp"
#include "core/app/mission_options.hpp"
#include "core/app/program.hpp"
#include "core/app/replay_command.hpp"
#include "core/app/run_command.hpp"
#include "core/error.hpp"
#include "core/run/component/realtime.hpp"
#include "core/say.hpp"
#include "core/types/text.hpp"

namespace {

using namespace fulmar::core;

/// The commands of this program, in the order of the help, which names those of other programs too.
std::vector<std::uint64_t> valid_seeds(const std::string& text) try {
  return parse_seeds(text);
} catch (const Error& fault) {
  throw CLI::ValidationError(fault.what());
}

struct Commands {
  CLI::App app{
      "Fulmar: a fixed-wing autopilot for research. A mission is a YAML file; its components are plugins."};
  MissionOptions mission;
  RunOptions run;
  std::string speed = "max", resume_log, report_file, seeds;
  ReplayWords replay;
  std::vector<std::string> replay_set, replay_with;
  std::function<int()> action;  // of the command that was given

  Commands() {
    app.set_version_flag("--version", "fulmar " FULMAR_VERSION);
    app.require_subcommand(1);
    const std::vector<std::string> programs = extern_commands();
    app.footer(
        "Example: fulmar run configs/missions/hourglass.yaml --seed 3 --set slc.roll_limit=\"30 deg\"" +
        (programs.empty()
             ? ""
             : "\n\nPrograms beside this one: " + join(programs) + " (fulmar " + programs[0] + " --help)"));
    add_run();
    for (const OwnCommand& command : own_commands()) {
      if (command.word == std::string_view("log")) add_replay();
      // what another program carries out stands here for the help alone
      CLI::App* named = app.add_subcommand(command.word, command.says)->prefix_command();
      if (*command.says == '\0') named->group("");
    }
  }

  /// An empty word, as of a variable that is not set, is not taken for the default.
  static CLI::Validator a_file(const std::string& otherwise) {
    return CLI::Validator(
        [otherwise](const std::string& text) {
          return text.empty() ? "'' names no file; without the option " + otherwise : std::string();
        },
        "");
  }

  /// What is wrong with a duration; empty: nothing.
  static std::string not_seconds(const std::string& text) {
    double x = 0;
    const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), x);
    const bool good = code == std::errc{} && end == text.data() + text.size() && x > 0 && x <= 1e7;
    return good ? std::string() : "give seconds, above 0 and up to 1e7, not '" + text + "'";
  }

  void add_run() {
    CLI::App* command = app.add_subcommand("run", "fly a mission and tell how it went");
    mission.add(command);
    command->add_option("--speed", speed, "real, max, or a multiple of real time");
    command->add_option("--duration", run.duration_s, "end after so many seconds of flight")
        ->check(CLI::Validator(not_seconds, "SECONDS"));
    command->add_option("--log", run.log_file, "where to write the log; default logs/<mission>-<UTC>.mcap")
        ->check(a_file("the log gets a name of its own in logs/"));
    command->add_flag("--no-log", run.no_log, "write no log");
    CLI::Option* const report =
        command
            ->add_option("--report", report_file,
                         "make an HTML page of the log when the flight is over: beside the log, or FILE.html")
            ->expected(0, 1)
            ->type_name("[FILE.html]");
    command->add_flag("--json", run.json, "print one JSON object instead of a table");
    command->add_flag("--strict", run.strict,
                      "exit code 3 when a guard has fired in a flight that was flown");
    CLI::Option* repeat =
        command->add_option("--repeat", run.repeat, "so many flights in one host, all with the same seed")
            ->check(CLI::Range(1, 1000000));
    CLI::Option* watch = command->add_flag(
        "--watch", run.watch,
        "after a flight wait until a plugin or file of the mission changes, fly again, and compare");
    command
        ->add_option("--seeds", seeds,
                     "a flight with each seed, as in 1..20 or 3,5,8..10; ends with their figures' mean and "
                     "deviation")
        ->type_name("SEEDS")
        ->excludes(repeat)
        ->excludes(watch)
        ->excludes(command->get_option("--seed"));
    command->add_option("--build", run.build,
                        "with --watch: command to run when a source file beside the mission has changed");
    command
        ->add_option("--live", run.live,
                     "ADDRESS:PORT where onlookers connect, or off; default: what the mission says")
        ->type_name("ADDRESS:PORT");
    command
        ->add_flag("--realtime{" + std::to_string(usual_priority) + "}", run.realtime,
                   "real-time priority, 1 to 99 as in --realtime=70, and locked memory for the loop")
        ->check(CLI::Range(1, 99));
    command->add_option("--drivers-from", run.drivers_from,
                        "take the samples of drivers from this log, in place of their devices");
    CLI::Option* const resume = add_resume(command);
    command->callback([this, command, resume, report] {
      run.mission = mission.mission;
      run.overrides = mission.overrides(command);
      run.speed = parse_speed(speed);
      if (!seeds.empty()) run.seeds = valid_seeds(seeds);
      if (resume->count() > 0) run.resume = resume_log;
      if (report->count() > 0) run.report = report_file;
      action = [this] { return run_command(run); };
    });
  }

  CLI::Option* add_resume(CLI::App* command) {
    CLI::Option* resume =
        command
            ->add_option("--resume", resume_log,
                         "go on where this log ended, or without a file the newest of the mission")
            ->expected(0, 1)
            ->type_name("[LOG]");
    command
        ->add_flag("--no-resume", run.no_resume,
                   "with --io fcu: begin at the beginning, also when the newest log ended in the air")
        ->excludes(resume);
    return resume;
  }

  void add_replay() {
    CLI::App* command = app.add_subcommand(
        "replay",
        "fly a log again: what entered the flight is fed to its mission, and what comes out is compared");
    command->callback([this] {
      replay.changes.set = pairs(replay_set);
      replay.changes.with = pairs(replay_with);
      action = [this] { return replay_command(replay); };
    });
    command->add_option("LOG", replay.log, "log of a flight (MCAP)")->required();
    add_pairs(
        command, "--with", replay_with, "COMPONENT=FILE",
        "COMPONENT=PLUGIN.so: an experiment with another file for a component, or for the one that fills a "
        "role, as in nav=my_filter.so");
    add_pairs(command, "--set", replay_set, "COMP.PARAM=VALUE",
              "COMPONENT.PARAMETER=VALUE: an experiment with another parameter");
    command
        ->add_option("--record", replay.changes.record,
                     "all, or PORTS[@RATE] as in nav.*@100Hz: with --log, its log holds this, too")
        ->type_name("PORTS[@RATE]")
        ->allow_extra_args(false);
    command->add_option("--log", replay.out, "where to write the log of the replay; default nowhere")
        ->check(a_file("none is written"));
    command->add_flag("--json", replay.json, "print one JSON object");
  }

  std::vector<std::string> names() const {
    std::vector<std::string> list;
    for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
      list.push_back(command->get_name());
    return list;
  }

  /// A word that is no command: the program of that name, or a sentence.
  int other_program(char** words) {
    become_extern_command(words);
    std::vector<std::string> valid = names();
    for (const std::string& word : extern_commands()) valid.push_back(word);
    std::erase(valid, "complete");  // for shells
    const std::string word = words[0];
    std::fprintf(stderr, "fulmar: there is no command '%s'.%s\n", for_terminal(word).c_str(),
                 choices_text(word, valid).c_str());
    if (word == "fcu" || word == "ros2" || word == "aero" || word == "import")
      std::fprintf(stderr,
                   "The program fulmar-%s is not there: `cmake --build build --target "
                   "tools` makes it.\n",
                   words[0]);
    return 2;
  }

  int parse(int argc, char** argv) {
    if (asked_for_rows(argc, argv)) {
      std::fputs(command_rows(app).c_str(), stdout);
      return 0;
    }
    become_own_command(argv);
    const std::vector<std::string> known = names();
    if (argc > 1 && argv[1][0] != '-' && std::find(known.begin(), known.end(), argv[1]) == known.end())
      return other_program(argv + 1);
    app.parse(argc, argv);
    return action ? action() : 2;
  }
};

}  // namespace

int main(int argc, char** argv) {
  Commands commands;
  return run_program(
      commands.app, [&] { return commands.parse(argc, argv); }, ExitCode::refused);
}
