// SPDX-License-Identifier: BSD-3-Clause
// The command line. Exit codes: 0 done; 1 the flight, check or file failed; 2 wrong usage; 130 interrupted.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cstdio>
#include <iostream>

#include "core/app/extern_command.hpp"
#include "tools/fulmar_log/log_command.hpp"
#include "tools/fulmar_new/new_command.hpp"
#include "tools/fulmar_live/remote.hpp"
#include "core/app/replay_command.hpp"
#include "core/app/run_command.hpp"
#include "core/error.hpp"
#include "core/graph/graph.hpp"
#include "core/loader/inspect.hpp"
#include "core/loader/library.hpp"
#include "core/run/realtime.hpp"

namespace {

using namespace fulmar::core;

const CLI::Validator whole_number(
    [](const std::string& text) {
      const bool good = !text.empty() && text.size() < 20 && text.find_first_not_of("0123456789") == std::string::npos;
      return good ? std::string() : "give a whole number from 0, not '" + text + "'";
    },
    "NUMBER");

/// "a=b" -> {a, b}
std::vector<std::pair<std::string, std::string>> pairs(const std::vector<std::string>& words) {
  std::vector<std::pair<std::string, std::string>> out;
  for (const std::string& word : words) {
    const std::size_t equals = word.find('=');
    if (equals == std::string::npos || equals == 0) throw CLI::ValidationError("'" + word + "' is not of the form name=value");
    out.emplace_back(word.substr(0, equals), word.substr(equals + 1));
  }
  return out;
}

struct MissionOptions {
  std::string mission, io;
  std::uint64_t seed = 0;
  bool seed_given = false;
  std::vector<std::string> roles, set, with;

  void add(CLI::App* command) {
    command->add_option("MISSION", mission, "mission file (YAML)")->required();
    command->add_option("--io", io, "sim or fcu: simulated aircraft or flight controller")->check(CLI::IsMember({"sim", "fcu"}));
    command->add_option("--role", roles, "ROLE=COMPONENT: who fills a role in every phase")
        ->type_name("ROLE=COMPONENT")
        ->allow_extra_args(false);
    command->add_option("--with", with, "COMPONENT=PLUGIN.so: another file for a component")
        ->type_name("COMPONENT=FILE")
        ->allow_extra_args(false);
    command->add_option("--seed", seed, "seed of all noise")->check(whole_number);
    command->add_option("--set", set, "COMPONENT.PARAMETER=VALUE")->type_name("COMP.PARAM=VALUE")->allow_extra_args(false);
  }
  Overrides overrides(const CLI::App* command) const {
    Overrides o;
    if (!io.empty()) o.io = io;
    if (command->count("--seed") > 0) o.seed = seed;
    o.roles = pairs(roles);
    o.set = pairs(set);
    o.with = pairs(with);
    for (const auto& [component, file] : o.with)
      if (file.empty())
        throw CLI::ValidationError("--with " + component + "=: a file is missing, as in --with " + component + "=my_law.so");
    return o;
  }
};

int check(const std::string& mission, const Overrides& overrides) {
  const Graph graph = load_mission(mission, overrides);
  std::printf("%s is in order: %zu components, %zu roles, %zu phases.\n", mission.c_str(), graph.components.size(), graph.roles.size(),
              graph.phases.size());
  return 0;
}

int run_app(int argc, char** argv) {
  CLI::App app{"Fulmar: a fixed-wing autopilot for research. A mission is a YAML file; its components are plugins."};
  app.set_version_flag("--version", "fulmar " FULMAR_VERSION);
  app.require_subcommand(1);
  const std::vector<std::string> programs = extern_commands();
  app.footer("Example: fulmar run configs/missions/hourglass.yaml --seed 3 --set slc.roll_limit=\"30 deg\"" +
             (programs.empty() ? "" : "\n\nPrograms beside this one: " + join(programs) + " (fulmar " + programs[0] + " --help)"));

  MissionOptions mission;
  RunOptions run_options;
  std::string speed = "max", format = "text", plugin;
  double duration = 0;
  bool fields = false, markdown = false;

  CLI::App* run = app.add_subcommand("run", "fly a mission and tell how it went");
  mission.add(run);
  run->add_option("--speed", speed, "real, max, or a multiple of real time");
  run->add_option("--duration", duration, "end after so many seconds of flight")
      ->check(CLI::Validator(
          [](const std::string& text) {
            double x = 0;
            const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), x);
            const bool good = code == std::errc{} && end == text.data() + text.size() && x > 0 && x <= 1e7;
            return good ? std::string() : "give seconds, above 0 and up to 1e7, not '" + text + "'";
          },
          "SECONDS"));
  run->add_option("--log", run_options.log_file, "where to write the log; default logs/<mission>-<UTC>.mcap");
  run->add_flag("--no-log", run_options.no_log, "write no log");
  run->add_flag("--json", run_options.json, "print one JSON object instead of a table");
  run->add_option("--repeat", run_options.repeat, "so many flights in one host")->check(CLI::Range(1, 1000000));
  run->add_flag("--watch", run_options.watch, "after a flight wait until a plugin or file of the mission changes, fly again, and compare");
  run->add_option("--build", run_options.build, "with --watch: command to run when a source file beside the mission has changed");
  run->add_option("--live", run_options.live, "ADDRESS:PORT where onlookers connect, or off; default: what the mission says")
      ->type_name("ADDRESS:PORT");
  run->add_flag("--realtime{" + std::to_string(usual_priority) + "}", run_options.realtime,
                "real-time priority, 1 to 99 as in --realtime=70, and locked memory for the loop")
      ->check(CLI::Range(1, 99));
  run->add_option("--drivers-from", run_options.drivers_from, "take the samples of drivers from this log, in place of their devices");
  std::string resume_log;
  CLI::Option* resume = run->add_option("--resume", resume_log, "go on where this log ended, or without a file the newest of the mission")
                            ->expected(0, 1)
                            ->type_name("[LOG]");
  run->add_flag("--no-resume", run_options.no_resume, "with --io fcu: begin at the beginning, also when the newest log ended in the air")
      ->excludes(resume);
  CLI::App* check_command = app.add_subcommand("check", "check a mission file: every fault in one go");
  mission.add(check_command);
  CLI::App* graph = app.add_subcommand("graph", "print components, wires, order and phases of a mission");
  mission.add(graph);
  graph->add_option("--format", format, "text, dot or mermaid")->check(CLI::IsMember({"text", "dot", "mermaid"}));
  CLI::App* inspect = app.add_subcommand("inspect", "print what a plugin file offers");
  inspect->add_option("PLUGIN", plugin, "shared object")->required();
  inspect->add_flag("--fields", fields, "also the fields of every message");
  inspect->add_flag("--markdown", markdown, "as a page of reference: Markdown with every parameter, port and field");
  NewOptions new_options;
  CLI::App* new_plugin = app.add_subcommand("new", "write the project of a plugin that fills a role of a mission");
  new_plugin->add_option("NAME", new_options.name, "of the plugin: letters, digits and _")->required();
  new_plugin->add_option("--role", new_options.role, "that it fills, as in outer")->required();
  new_plugin->add_option("--mission", new_options.mission, "whose role it fills; default the shipped hourglass");
  new_plugin->add_option("--dir", new_options.folder, "folder to write; default ./NAME");

  ReplayWords replay_words;
  std::vector<std::string> replay_set, replay_with;
  CLI::App* replay =
      app.add_subcommand("replay", "fly a log again: what entered the flight is fed to its mission, and what comes out is compared");
  replay->add_option("LOG", replay_words.log, "log of a flight (MCAP)")->required();
  replay->add_option("--with", replay_with, "COMPONENT=PLUGIN.so: an experiment with another file for a component")
      ->type_name("COMPONENT=FILE")
      ->allow_extra_args(false);
  replay->add_option("--set", replay_set, "COMPONENT.PARAMETER=VALUE: an experiment with another parameter")
      ->type_name("COMP.PARAM=VALUE")
      ->allow_extra_args(false);
  replay->add_option("--log", replay_words.out, "where to write the log of the replay; default nowhere");
  replay->add_flag("--json", replay_words.json, "print one JSON object");

  const LogCommand log(app);
  const RemoteCommands remote(app, programs);
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands([](CLI::App*) { return true; })) names.push_back(command->get_name());
  if (argc > 1 && argv[1][0] != '-' && std::find(names.begin(), names.end(), argv[1]) == names.end()) {
    become_extern_command(argv + 1);
    for (const std::string& word : extern_commands()) names.push_back(word);
    std::erase(names, "complete");  // for shells
    std::fprintf(stderr, "fulmar: there is no command '%s'.%s\n", argv[1], choices_text(argv[1], names).c_str());
    if (const std::string word = argv[1]; word == "fcu" || word == "ros2")
      std::fprintf(stderr, "The program fulmar-%s is not there: ./fly leaves it out, `cmake --build build --target tools` makes it.\n", argv[1]);
    return 2;
  }
  try {
    app.parse(argc, argv);
    if (const auto code = remote.run()) return *code;
    if (log.parsed()) return log.run();
    if (run->parsed()) {
      run_options.mission = mission.mission;
      run_options.overrides = mission.overrides(run);
      run_options.speed = parse_speed(speed);
      if (resume->count() > 0) run_options.resume = resume_log;
      if (duration > 0) run_options.duration_s = duration;
      return run_command(run_options);
    }
    if (check_command->parsed()) return check(mission.mission, mission.overrides(check_command));
    if (graph->parsed()) {
      std::cout << print_graph(load_mission(mission.mission, mission.overrides(graph)), format);
      return 0;
    }
    if (replay->parsed()) {
      replay_words.changes.set = pairs(replay_set), replay_words.changes.with = pairs(replay_with);
      return replay_command(replay_words);
    }
    if (new_plugin->parsed()) return new_command(new_options);
    const std::shared_ptr<Library> library = Library::open(plugin);
    std::cout << (markdown ? describe_plugin_markdown(library->info()) : describe_plugin(library->info(), fields));
    return 0;
  } catch (const CLI::ParseError& e) {
    return app.exit(e) == 0 ? 0 : 2;
  }
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const int code = run_app(argc, argv);
    if (code != 0 || (std::fflush(stdout) == 0 && std::ferror(stdout) == 0)) return code;
    std::fprintf(stderr, "fulmar: the output cannot be written; is the disk full?\n");
    return 1;
  } catch (const fulmar::core::Error& e) {
    std::fprintf(stderr, "%s\n", e.what());
  } catch (const std::exception& e) {
    std::fprintf(stderr, "fulmar: %s\n", e.what());
  }
  return 1;
}
