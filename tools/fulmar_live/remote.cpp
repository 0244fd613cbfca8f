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

/// CLI11's own check prints the largest number there is.
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
/// Names words in the usage that CLI11 does not know of.
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

  std::vector<std::string> programs;  // commands that are programs beside this one

  Impl(CLI::App& a, std::vector<std::string> p) : app(a), programs(std::move(p)) {}

  // Not CLI11's envname: it sets the options of commands that are not given, too, and so wins over the
  // command line.
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
    command->add_option("--at", at, "where the flight listens; default $FULMAR_LIVE, else 127.0.0.1:8765")
        ->type_name("HOST:PORT");
    command->add_option("--token", token, "what the flight asks for; default $FULMAR_TOKEN");
  }

  void look() {
    CLI::App* list = add(app, "list", "components of a running flight, their ports, requests and phases",
                         "list --rates", [this] { return list_command(target(), rates, json); });
    list->add_flag("--rates", rates, "count the samples of every port for a second");
    list->add_flag("--json", json, "print one JSON object");

    add(app, "watch", "a running flight on one screen of the terminal", "watch",
        [this] { return watch_command(target()); });

    CLI::App* show = add(app, "echo", "print messages of a running flight; angles in degrees",
                         "echo nav.state.height_m --rate 2", [this] { return echo_command(target(), echo); });
    show->add_option("PORT", echo.ports, "PORT, PORT.FIELD, or a component's probe")
        ->required()
        ->type_name("");
    show->add_option("--rate", echo.rate_hz, "at most so many per second of flight")
        ->check(above_zero)
        ->type_name("NUMBER");
    show->add_option("--count", echo.count, "end after so many")->check(from_one)->type_name("NUMBER");
    CLI::Option* as_json = show->add_flag("--json", echo.json, "one JSON object per line");
    show->add_flag("--csv", echo.csv, "a table; of one port")->excludes(as_json);

    CLI::App* open =
        add(app, "view", "open a log, or the flight that runs, in a viewer",
            "view logs/hourglass.mcap --in lichtblick", [this] { return view_command(target(), view); });
    open->add_option("LOG", view.what, "a log's file; or running, which is meant when nothing is said")
        ->type_name("");
    open->add_option("--in", view.in, "page, lichtblick, foxglove, rerun or plotjuggler")
        ->type_name("VIEWER");
    open->add_flag("--print", view.print, "print the link or the command line, and open nothing");

    add_plot();
  }

  /// Of a running flight, or of logs when the first word is one.
  void add_plot() {
    CLI::App* draw =
        add(app, "plot", "plot fields of a running flight in the terminal; of logs as a figure",
            "plot nav.state.roll_deg slc.attitude.roll_deg\n"
            "Example: fulmar plot flight.mcap nav.state.height_m nav.state.roll_deg -o flight.svg",
            [this] { return draws_logs() ? plot_logs() : plot_live(); });
    draw->add_option("FIELD", curves.fields,
                     "PORT.FIELD, or a component's probe; logs that stand before them are drawn")
        ->required()
        ->type_name("");
    live_seconds = draw->add_option("--seconds", curves.seconds, "so much of a running flight");
    live_seconds->check(CLI::Range(0.1, 36000.0));
    const auto of_logs = [&](CLI::Option* option) {
      log_options.push_back(option->group("Of logs"));
      return option;
    };
    of_logs(draw->add_option("-o,--out", figure.out,
                             "the figure: .svg, .png or .pdf; without one it is drawn in the terminal"))
        ->type_name("FILE");
    of_logs(draw->add_option("--over", figure.over,
                             "a field in place of time, as for a track; .FIELD: of each curve's own port"))
        ->type_name("FIELD");
    of_logs(draw->add_option("--panel", figure.panels,
                             "a panel of these fields, commas between them; may be given again. Other fields "
                             "have a panel per unit"))
        ->allow_extra_args(false)
        ->type_name("FIELD,FIELD");
    const auto seconds = CLI::Range(-1e7, 1e7);
    of_logs(draw->add_option("--from", figure.from_s, "only from so many seconds of flight on"))
        ->check(seconds);
    of_logs(draw->add_option("--to", figure.to_s, "only up to so many seconds of flight"))->check(seconds);
    of_logs(draw->add_option("--size", figure.size, "width and height, as in 160x90mm; default 160 mm wide"))
        ->type_name("SIZE");
    of_logs(draw->add_option("--names", figure.names, "what the logs are called, as in --names old,new"))
        ->type_name("NAMES");
    of_logs(draw->add_option("--labels", figure.labels,
                             "what each field is called in the legend, as in --labels estimated,true"))
        ->type_name("NAMES");
    of_logs(draw->add_flag("--no-phases", figure.no_phases, "no bands of the flight's phases"));
    of_logs(draw->add_flag("--no-plan", figure.no_plan, "no plan behind a track of north over east"));
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
    CLI::App* param = app.add_subcommand("param", "parameters of a running flight");
    param->require_subcommand(1);
    param->footer("Example: fulmar param set attitude.roll_kp 0.6 slc.roll_limit \"35 deg\"");
    CLI::App* list =
        add(*param, "list", "values, ranges, and which can change in flight", "param list 'slc.roll*'",
            [this] { return param_list_command(target(), pattern, json); });
    list->add_option("NAME", pattern, "COMPONENT, COMPONENT.PARAMETER, or with a *")->type_name("");
    list->add_flag("--json", json, "print a JSON list");
    CLI::App* get = add(*param, "get", "values of parameters", "param get attitude.roll_kp",
                        [this] { return param_get_command(target(), words, json); });
    get->add_option("NAME", words, "COMPONENT.PARAMETER")->required()->type_name("");
    get->add_flag("--json", json, "one JSON object per line");
    CLI::App* set = add(
        *param, "set",
        "change parameters in flight, between ticks. A name is COMPONENT.PARAMETER, a value is written as in "
        "a mission file.\n"
        "Several are set one after another; the first that is refused ends it, and those before it stay set.",
        "param set slc.roll_limit \"35 deg\" attitude.roll_kp 0.6", [] { return 0; });
    take_rest(set, "NAME VALUE [NAME VALUE ...]", [this] {
      if (words.empty()) throw WrongUsage(remote_messages::parameters_missing());
      return param_set_command(target(), words);
    });
    CLI::App* keep =
        add(*param, "save", "write what flies back into the mission's and airframe's files, comments kept",
            "param save slc --dry-run", [this] { return param_save_command(target(), save); });
    keep->add_option("COMPONENT", save.component, "its parameters alone")->type_name("");
    keep->add_option("--mission", save.mission, "the mission's file, when the flight runs elsewhere");
    keep->add_flag("--dry-run", save.dry_run, "show what would change");
    keep->add_flag("--yes", save.yes, "do not ask");
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
        add(app, "call", "ask a component for something: {field: value, ...} or field=value ...",
            "call plan.edit '{kind: append, waypoint: {position_m: {north: 100, east: 50, down: -80}}}'",
            [] { return 0; });
    call->add_option("REQUEST", name, "COMPONENT.REQUEST")->required()->type_name("");
    take_rest(call, "FIELD=VALUE ... | '{FIELD: VALUE, ...}'",
              [this] { return call_command(target(), name, words); });
    CLI::App* phase = add(app, "phase", "enter a phase of the mission", "phase cruise",
                          [this] { return phase_command(target(), name); });
    phase->add_option("NAME", name, "of the phase")->required()->type_name("");
    CLI::App* swap = add(app, "swap", "another plugin file for a component, on the ground",
                         "swap my_law build/lib/fulmar/my_law.so",
                         [this] { return swap_command(target(), component, file); });
    swap->add_option("COMPONENT", component, "of the mission")->required()->type_name("");
    swap->add_option("FILE", file, "plugin")->required()->type_name("");
    add(app, "reset", "let components fly again that a guard has stopped", "reset",
        [this] { return reset_command(target()); });
  }

  void clock() {
    add(app, "pause", "let a simulation stand still", "pause", [this] { return pause_command(target()); });
    add(app, "resume", "let a paused simulation go on", "resume",
        [this] { return resume_command(target()); });
    CLI::App* step = add(app, "step", "fly some ticks of a paused simulation", "step 400",
                         [this] { return step_command(target(), name.empty() ? "1" : name); });
    step->add_option("TICKS", name, "a whole number")->type_name("");
    CLI::App* speed = add(app, "speed", "how fast a simulation flies", "speed 10",
                          [this] { return speed_command(target(), name); });
    speed->add_option("SPEED", name, "of 0.01 to 1e6; a paused simulation goes on")
        ->required()
        ->type_name("");
    CLI::App* restart = add(app, "restart", "end a simulation, and begin its mission anew in the same host",
                            "restart --seed 3", [this] { return restart_command(target(), name); });
    restart->add_option("--seed", name, "of the new flight; default that of the one that ends")
        ->type_name("NUMBER");
  }

  void completion() {
    CLI::App* script = app.add_subcommand("completion", "print what completes words in a shell");
    script->add_option("SHELL", shell, "bash or zsh")
        ->required()
        ->check(CLI::IsMember({"bash", "zsh"}))
        ->type_name("");
    script->footer("Example: source <(fulmar completion bash)");
    actions.emplace_back(script, [this] {
      std::fputs(completion_script(shell).c_str(), stdout);
      return 0;
    });
    CLI::App* complete = app.add_subcommand("complete", "words of a running flight, for shells")->group("");
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
