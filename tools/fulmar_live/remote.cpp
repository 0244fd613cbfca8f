// SPDX-License-Identifier: BSD-3-Clause
#include "tools/fulmar_live/remote.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <utility>

#include "core/types/text.hpp"
#include "tools/fulmar_live/client.hpp"
#include "tools/fulmar_live/commands.hpp"
#include "tools/fulmar_live/completion.hpp"
#include "tools/fulmar_live/messages.hpp"
#include "tools/fulmar_live/view.hpp"
#include "tools/fulmar_log/plot_log.hpp"

namespace fulmar::core {
namespace {

/// CLI11's own check prints the largest possible number.
CLI::Validator number_check(const char* what, bool whole) {
  return CLI::Validator(
      [what, whole](const std::string& text) {
        double x = 0;
        const auto [end, code] = std::from_chars(text.data(), text.data() + text.size(), x);
        const bool good = code == std::errc{} && end == text.data() + text.size() && x > 0 && x <= 1e15 &&
                          (!whole || text.find_first_not_of("0123456789") == std::string::npos);
        return good ? std::string() : remote_messages::number_invalid(what, text).text;
      },
      "");
}
/// Adds positional words to the usage that CLI11 does not list.
struct RestFormatter : CLI::Formatter {
  std::string rest;
  explicit RestFormatter(std::string r) : rest(std::move(r)) {}
  std::string make_usage(const CLI::App* command, std::string name) const override {
    std::string text = CLI::Formatter::make_usage(command, std::move(name));
    return text.insert(std::min(text.find('\n'), text.size()), " " + rest);
  }
};

const CLI::Validator above_zero = number_check("a number above 0", false),
                     from_one = number_check("a whole number from 1", true);

}  // namespace

struct RemoteCommands::Impl {
  CLI::App& app;
  std::string at, token, mission, pattern, component, file, shell, kind, prefix;
  std::vector<std::string> words, typed_logs;
  std::string name;
  EchoOptions echo;
  PlotOptions curves;
  plot::LogPlotArguments figure;
  CLI::Option* live_seconds = nullptr;          // of plot
  std::vector<const CLI::Option*> log_options;  // of plot
  SaveOptions save;
  ViewOptions view;
  bool json = false, rates = false;
  std::vector<std::pair<CLI::App*, std::function<int()>>> actions;

  std::vector<std::string> programs;  // commands in separate programs

  Impl(CLI::App& a, std::vector<std::string> p) : app(a), programs(std::move(p)) {}

  // Not CLI11's envname: it also sets options of commands that are not used, and so overrides the command
  // line.
  static std::string given(const std::string& word, const char* variable) {
    const char* value = std::getenv(variable);
    return word.empty() && value ? value : word;
  }
  LiveAddress target() const { return parse_target(given(at, "FULMAR_LIVE"), given(token, "FULMAR_TOKEN")); }

  CLI::App* add(CLI::App& to, const std::string& word, const std::string& says, const std::string& example,
                std::function<int()> action) {
    CLI::App* command = to.add_subcommand(word, says);
    command->footer("Example: fulmar " + example);
    add_target(command);
    actions.emplace_back(command, std::move(action));
    return command;
  }

  void add_target(CLI::App* command) {
    command
        ->add_option("--at", at,
                     "connect to the flight at HOST:PORT; default $FULMAR_LIVE, else 127.0.0.1:8765")
        ->type_name("HOST:PORT");
    command->add_option("--token", token, "send the access token of the flight; default $FULMAR_TOKEN");
  }

  void look() {
    CLI::App* list = add(app, "list", "list components, ports, requests and phases of a running flight",
                         "list --rates", [this] { return list_command(target(), rates, json); });
    list->add_flag("--rates", rates, "measure the rate of every port for one second");
    list->add_flag("--json", json, "print one JSON object");

    add(app, "watch", "show a running flight on one terminal screen", "watch",
        [this] { return watch_command(target()); });

    CLI::App* show = add(app, "echo", "print messages of a running flight, angles in degrees",
                         "echo nav.state.height_m --rate 2", [this] { return echo_command(target(), echo); });
    show->add_option("PORT", echo.ports, "PORT, PORT.FIELD, or a component's probe")
        ->required()
        ->type_name("");
    show->add_option("--rate", echo.rate_hz, "limit the output to NUMBER messages per second of flight time")
        ->check(above_zero)
        ->type_name("NUMBER");
    show->add_option("--count", echo.count, "end after NUMBER messages")
        ->check(from_one)
        ->type_name("NUMBER");
    CLI::Option* as_json = show->add_flag("--json", echo.json, "print one JSON object per line");
    show->add_flag("--csv", echo.csv, "print one port as CSV")->excludes(as_json);

    CLI::App* open =
        add(app, "view", "open a log or the running flight in a viewer",
            "view logs/hourglass.mcap --in lichtblick", [this] { return view_command(target(), view); });
    open->add_option("LOG", view.what, "log file, or running for the running flight; default running")
        ->type_name("");
    open->add_option("--in", view.in, "select the viewer: page, lichtblick, foxglove, rerun or plotjuggler")
        ->type_name("VIEWER");
    open->add_flag("--print", view.print, "print the link or the command line without opening it");

    add_plot();
  }

  /// Plots a running flight, or logs when the first word is one.
  void add_plot() {
    CLI::App* draw =
        add(app, "plot", "plot fields of a running flight or of logs",
            "plot nav.state.roll_deg slc.attitude.roll_deg\n"
            "Example: fulmar plot flight.mcap nav.state.height_m nav.state.roll_deg -o flight.svg",
            [this] { return draws_logs() ? plot_logs() : plot_live(); });
    draw->add_option("FIELD", curves.fields,
                     "PORT.FIELD or COMPONENT.PROBE; to plot logs, give their files first")
        ->required()
        ->type_name("");
    live_seconds = draw->add_option("--seconds", curves.seconds, "show the last SECONDS of a running flight")
                       ->type_name("SECONDS");
    live_seconds->check(CLI::Range(0.1, 36000.0));
    const auto of_logs = [&](CLI::Option* option) {
      log_options.push_back(option->group("Options for logs"));
      return option;
    };
    of_logs(draw->add_option("-o,--out", figure.out,
                             "write the figure to FILE: .svg, .png or .pdf; default: draw in the terminal"))
        ->type_name("FILE");
    of_logs(
        draw->add_option("--over", figure.over,
                         "plot over FIELD instead of time, as for a track; .FIELD: of each curve's own port"))
        ->type_name("FIELD");
    of_logs(
        draw->add_option("--panel", figure.panels,
                         "draw these fields in one panel; repeatable. Other fields have one panel per unit"))
        ->allow_extra_args(false)
        ->type_name("FIELD,FIELD");
    const auto seconds = CLI::Range(-1e7, 1e7);
    of_logs(
        draw->add_option("--from", figure.from_s, "start at SECONDS of flight time")->type_name("SECONDS"))
        ->check(seconds);
    of_logs(draw->add_option("--to", figure.to_s, "end at SECONDS of flight time")->type_name("SECONDS"))
        ->check(seconds);
    of_logs(
        draw->add_option("--size", figure.size, "set width and height, as in 160x90mm; default: 160 mm wide"))
        ->type_name("SIZE");
    of_logs(draw->add_option("--names", figure.names, "set the names of the logs, as in --names old,new"))
        ->type_name("NAMES");
    of_logs(draw->add_option("--labels", figure.labels,
                             "set the name of each field in the legend, as in --labels estimated,true"))
        ->type_name("NAMES");
    of_logs(draw->add_flag("--no-phases", figure.no_phases, "omit the bands of the flight's phases"));
    of_logs(draw->add_flag("--no-plan", figure.no_plan, "omit the plan behind a track of north over east"));
  }

  bool draws_logs() {
    figure.words = curves.fields;
    const bool logs = plot::names_a_log(figure.words[0]);
    if (logs && live_seconds->count() > 0) throw WrongUsage(remote_messages::live_option_of_log());
    return logs;
  }
  int plot_logs() const {
    const bool in_terminal = figure.out.empty() && figure.over.empty() && figure.size.empty();
    return in_terminal ? picture_command(figure) : plot::plot_log_command(figure);
  }
  int plot_live() const {
    for (const CLI::Option* option : log_options)
      if (option->count() > 0)
        throw WrongUsage(
            remote_messages::log_option_without_log(option->get_name(false, true), curves.fields[0]));
    return plot_command(target(), curves);
  }

  void parameters() {
    CLI::App* param = app.add_subcommand("param", "list, read, set and save parameters of a running flight");
    param->require_subcommand(1);
    param->footer("Example: fulmar param set attitude.roll_kp 0.6 slc.roll_limit \"35 deg\"");
    CLI::App* list =
        add(*param, "list", "list values, ranges and whether a parameter can change in flight",
            "param list 'slc.roll*'", [this] { return param_list_command(target(), pattern, json); });
    list->add_option("NAME", pattern, "COMPONENT or COMPONENT.PARAMETER; * matches any text")->type_name("");
    list->add_flag("--json", json, "print a JSON list");
    CLI::App* get = add(*param, "get", "print values of parameters", "param get attitude.roll_kp",
                        [this] { return param_get_command(target(), words, json); });
    get->add_option("NAME", words, "COMPONENT.PARAMETER")->required()->type_name("");
    get->add_flag("--json", json, "print one JSON object per line");
    CLI::App* set = add(*param, "set", "change parameters of a running flight between two ticks",
                        "param set slc.roll_limit \"35 deg\" attitude.roll_kp 0.6\n\n"
                        "NAME is COMPONENT.PARAMETER; VALUE is written as in a mission file. The parameters "
                        "are set in order. "
                        "The first rejected one ends the command; earlier ones stay set.",
                        [] { return 0; });
    take_rest(set, "NAME VALUE [NAME VALUE ...]", [this] {
      if (words.empty()) throw WrongUsage(remote_messages::parameters_missing());
      return param_set_command(target(), words);
    });
    CLI::App* keep =
        add(*param, "save", "write current parameters to the mission and airframe files; comments are kept",
            "param save slc --dry-run", [this] { return param_save_command(target(), save); });
    keep->add_option("COMPONENT", save.component, "save only the parameters of COMPONENT")->type_name("");
    keep->add_option("--mission", save.mission,
                     "write to mission FILE, if the flight runs on another computer")
        ->type_name("FILE");
    keep->add_flag("--dry-run", save.dry_run, "print the changes and write nothing");
    keep->add_flag("--yes", save.yes, "skip the confirmation");
  }

  /// The words after the options are the command's own: CLI11 would take [1, 2, 3] apart, and -0.5 for an
  /// option.
  void take_rest(CLI::App* command, const std::string& rest, std::function<int()> action) {
    command->allow_extras();
    command->formatter(std::make_shared<RestFormatter>(rest));
    actions.back().second = [this, command, action = std::move(action)] {
      words = command->remaining();
      return action();
    };
  }

  void orders() {
    CLI::App* call =
        add(app, "call", "call a component's request port: {field: value, ...} or field=value ...",
            "call plan.edit '{kind: append, waypoint: {position_m: {north: 100, east: 50, down: -80}}}'",
            [] { return 0; });
    call->add_option("REQUEST", name, "COMPONENT.REQUEST")->required()->type_name("");
    take_rest(call, "FIELD=VALUE ... | '{FIELD: VALUE, ...}'",
              [this] { return call_command(target(), name, words); });
    CLI::App* phase = add(app, "phase", "enter a phase of the mission", "phase cruise",
                          [this] { return phase_command(target(), name); });
    phase->add_option("NAME", name, "name of the phase")->required()->type_name("");
    CLI::App* swap = add(app, "swap", "replace the plugin file of a component, on the ground",
                         "swap my_law build/lib/fulmar/my_law.so",
                         [this] { return swap_command(target(), component, file); });
    swap->add_option("COMPONENT", component, "component of the mission")->required()->type_name("");
    swap->add_option("FILE", file, "plugin file")->required()->type_name("");
    add(app, "reset", "clear latched guards", "reset", [this] { return reset_command(target()); });
  }

  void clock() {
    add(app, "pause", "pause a simulation", "pause", [this] { return pause_command(target()); });
    add(app, "resume", "resume a paused simulation", "resume", [this] { return resume_command(target()); });
    CLI::App* step = add(app, "step", "advance a paused simulation by TICKS", "step 400",
                         [this] { return step_command(target(), name.empty() ? "1" : name); });
    step->add_option("TICKS", name, "number of ticks; default 1")->type_name("");
    CLI::App* speed = add(app, "speed", "set the speed of a simulation", "speed 10",
                          [this] { return speed_command(target(), name); });
    speed
        ->add_option("SPEED", name, "multiple of real time, 0.01 to 1e6, or max; a paused simulation resumes")
        ->required()
        ->type_name("");
    CLI::App* restart = add(app, "restart", "restart the mission of a simulation in the same host",
                            "restart --seed 3", [this] { return restart_command(target(), name); });
    restart
        ->add_option("--seed", name, "set the seed of the new flight; default: the seed of the current one")
        ->type_name("NUMBER");
  }

  void completion() {
    CLI::App* script = app.add_subcommand("completion", "print a shell completion script");
    script->add_option("SHELL", shell, "bash or zsh")
        ->required()
        ->check(CLI::IsMember({"bash", "zsh"}))
        ->type_name("");
    script->footer("Example: source <(fulmar completion bash)");
    actions.emplace_back(script, [this] {
      std::fputs(completion_script(shell).c_str(), stdout);
      return 0;
    });
    CLI::App* complete = app.add_subcommand("complete", "print completions for a shell")->group("");
    complete->add_option("KIND", kind)->required();
    complete->add_option("PREFIX", prefix);
    complete->add_option("--log", typed_logs)->allow_extra_args(false);
    add_target(complete);
    actions.emplace_back(complete, [this] {
      if (kind == "field" && !typed_logs.empty()) return complete_from_log(typed_logs.front(), prefix);
      if (kind != "program")
        return complete_command(given(at, "FULMAR_LIVE"), given(token, "FULMAR_TOKEN"), kind, prefix);
      for (const std::string& word : programs)
        if (word.starts_with(prefix)) std::printf("%s\n", word.c_str());
      return 0;
    });
  }
};

RemoteCommands::RemoteCommands(CLI::App& app, std::vector<std::string> programs)
    : impl_(std::make_unique<Impl>(app, std::move(programs))) {
  impl_->look();
  impl_->parameters();
  impl_->orders();
  impl_->clock();
  impl_->completion();
}

RemoteCommands::~RemoteCommands() = default;

int RemoteCommands::run() const {
  try {
    for (const auto& [command, action] : impl_->actions)
      if (command->parsed()) return action();
    return 2;
  } catch (const plot::UsageError& wrong) {
    std::fprintf(stderr, "%s\n", for_terminal(wrong.what()).c_str());
    return 2;
  } catch (const WrongUsage& wrong) {
    std::fprintf(stderr, "%s\n", for_terminal(wrong.what()).c_str());
    return 2;
  }
}

}  // namespace fulmar::core
