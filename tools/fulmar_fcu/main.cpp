// SPDX-License-Identifier: BSD-3-Clause
// `fulmar fcu ...`, as the program fulmar-fcu. Exit codes: 0 done; 1 it failed, or there is a difference; 2
// wrong usage; 130 interrupted.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <functional>
#include <map>
#include <string>

#include "core/app/program.hpp"
#include "core/types/text.hpp"
#include "tools/fulmar_fcu/app.hpp"
#include "tools/fulmar_fcu/messages.hpp"

namespace {

using namespace fulmar::fcu;
namespace core = fulmar::core;

using Deed = std::function<int(Client&)>;

struct CommandLine {
  CLI::App app{
      "Looks after a flight controller with ROSflight firmware 2, on the ground: no flight may hold its "
      "port.",
      "fulmar fcu"};
  Options options;
  ParamsOptions params;
  HardwareOptions hardware;
  BenchOptions bench;
  bool once = false, watch = false;
  Deed deed;

  CommandLine() {
    app.require_subcommand(1);
    app.set_version_flag("--version", "fulmar fcu " FULMAR_VERSION);
    app.add_option("--port", options.port, "serial device, or udp:ADDRESS:PORT for firmware in simulation")
        ->envname("FULMAR_FCU_PORT")
        ->capture_default_str();
    app.add_option("--baud", options.baud, "of a serial line; USB does not care")
        ->check(CLI::Range(1200, 12000000))
        ->capture_default_str();
    app.add_flag("--json", options.json, "print JSON, where there is something to print");
    app.footer("Example: fulmar fcu --port /dev/ttyACM0 check");
    app.fallthrough();
    add_status();
    add_params();
    add_calibrate();
    add_hardware();
  }

  CLI::App* command(CLI::App* parent, const std::string& name, const std::string& what,
                    const Deed& what_to_do) {
    CLI::App* sub = parent->add_subcommand(name, what);
    sub->fallthrough();
    sub->footer("");  // the parent's
    sub->footer([=] { return "Example: fulmar fcu" + example(*sub); });
    if (what_to_do) sub->callback([this, what_to_do] { deed = what_to_do; });
    return sub;
  }

  /// " params set RC_ARM_CHN 6"
  static std::string example(const CLI::App& sub) {
    static const std::map<std::string, std::string> arguments{
        {"list", " 'RC_*_CHN'"},
        {"get", " RC_ARM_CHN"},
        {"set", " RC_ARM_CHN 6 --write"},
        {"save", " before.yaml"},
        {"load", " aircraft.yaml"},
        {"diff", " aircraft.yaml"},
        {"imu", " --write"},
        {"mag", " --record samples.csv"},
        {"bench", " board.md"},
        {"status", " --once"},
        {"check", " --airframe configs/airframes/anaconda.yaml"},
        {"params", " list"},
        {"calibrate", " imu"}};
    const std::string& name = sub.get_name();
    const auto at = arguments.find(name);
    const std::string before = sub.get_parent() && sub.get_parent()->get_parent()
                                   ? " " + sub.get_parent()->get_name()
                                   : std::string();
    return before + " " + name + (at == arguments.end() ? "" : at->second);
  }

  void add_status() {
    CLI::App* status = command(&app, "status", "what the controller says of itself, live", [this](Client& c) {
      return status_command(c, options, once || (!watch && !on_terminal()));
    });
    CLI::Option* one =
        status->add_flag("--once", once, "one block of text; so it is when the output is no terminal");
    status->add_flag("--watch", watch, "twice a second, until interrupted; so it is on a terminal")
        ->excludes(one);
    command(&app, "version", "the firmware's version",
            [this](Client& c) { return version_command(c, options); });
  }

  void add_params() {
    CLI::App* all = command(&app, "params", "the controller's parameters", {});
    all->require_subcommand(1);
    CLI::App* list = command(all, "list", "all of them, or those that match",
                             [this](Client& c) { return params_list(c, options, params); });
    list->add_option("PATTERN", params.pattern, "part of a name, or with * and ?, as in 'RC_*_CHN'");
    CLI::App* get =
        command(all, "get", "one of them", [this](Client& c) { return params_get(c, options, params); });
    get->add_option("NAME", params.name, "of the parameter; case does not matter")->required();
    CLI::App* set = command(all, "set", "sets one and reads it back",
                            [this](Client& c) { return params_set(c, options, params); });
    set->add_option("NAME", params.name, "of the parameter; case does not matter")->required();
    set->add_option("VALUE", params.value, "whole or not, as the parameter is: 'params get' shows it")
        ->required();
    command(all, "write", "keeps them over a power cycle",
            [this](Client& c) { return params_write(c, options); });
    CLI::App* save = command(all, "save", "writes them to a YAML file",
                             [this](Client& c) { return params_save(c, options, params); });
    CLI::App* load =
        command(all, "load", "sets those of a YAML file, ours or ROSflight's, after showing what changes",
                [this](Client& c) { return params_load(c, options, params); });
    CLI::App* diff = command(all, "diff", "shows how they differ from a YAML file; exit code 1 when they do",
                             [this](Client& c) { return params_diff(c, options, params); });
    for (CLI::App* sub : {save, load, diff})
      sub->add_option("FILE", params.file, "YAML: lines NAME: value")->required();
    for (CLI::App* sub : {set, load})
      sub->add_flag("--write", params.write, "then keep them over a power cycle");
    save->add_flag("--replace", params.replace, "overwrite a file that is there");
    load->add_flag("--yes", options.yes, "do not ask");
  }

  void add_calibrate() {
    CLI::App* all = command(&app, "calibrate", "calibrates a sensor; refused while armed", {});
    all->require_subcommand(1);
    const auto one = [&](const std::string& name, const std::string& what) {
      CLI::App* sub = command(all, name, what, [this, name](Client& c) {
        hardware.what = name;
        return calibrate_command(c, options, hardware);
      });
      sub->add_flag("--write", hardware.write, "then keep it over a power cycle");
      return sub;
    };
    one("imu", "gyroscope and accelerometer: lay it level, 3 s");
    one("gyro", "gyroscope: keep it still, 3 s");
    one("rc", "takes the transmitter's trims over as the controller's own");
    one("baro", "barometer, to the ground's height: 8 s");
    one("airspeed", "pitot: cover the tube, 8 s");
    CLI::App* mag = one("mag", "magnetometer: turn the aircraft by hand on each of six sides");
    CLI::Option* from =
        mag->add_option("--from", hardware.file,
                        "samples of a file in place of turning: x,y,z in tesla, as the sensor read them");
    mag->add_option("--record", hardware.record, "write the samples to a file")->excludes(from);
    mag->add_flag("--dry-run", hardware.dry_run, "tell the result, and set nothing");
    mag->add_flag("--yes", options.yes, "do not ask");
  }

  void add_hardware() {
    CLI::App* check = command(&app, "check", "the list before a flight; exit code 1 on a FAIL",
                              [this](Client& c) { return check_command(c, options, hardware); });
    check->add_option("--airframe", hardware.airframe, "the airframe file of this aircraft, to compare with");
    CLI::App* measure = command(&app, "bench", "a report of the board at rest: latency, rates, losses, noise",
                                [this](Client& c) { return bench_command(c, options, bench); });
    measure->add_option("FILE", bench.file, "to keep it: .json, else Markdown")->required();
    measure->add_option("--seconds", bench.seconds, "how long it listens")
        ->check(CLI::Range(1, 3600))
        ->capture_default_str();
    measure->add_flag("--replace", bench.replace, "overwrite a file that is there");
    command(&app, "mixer", "which output follows which command",
            [this](Client& c) { return mixer_command(c, options); });
    CLI::App* outputs =
        command(&app, "test-outputs", "moves aileron, elevator and rudder; propeller off, disarmed",
                [this](Client& c) { return outputs_command(c, options, hardware); });
    outputs->add_flag("--propeller-off", hardware.propeller_off, "it is off: do not ask");
    command(&app, "reboot", "restarts the controller; what was not written is gone",
            [this](Client& c) { return reboot_command(c, options); });
  }
};

/// "fulmar fcu calibrate: there is no command 'foo'. ..." when that, or none, is what is wrong; "" otherwise.
std::string unknown_command(const CLI::App& all) {
  const CLI::App* app = &all;
  while (!app->get_subcommands().empty()) app = app->get_subcommands().front();
  const std::vector<std::string> rest = all.remaining(true);
  std::vector<std::string> names;
  for (const CLI::App* sub : app->get_subcommands([](const CLI::App*) { return true; }))
    names.push_back(sub->get_name());
  const std::string path = app == &all ? "" : " " + app->get_name();
  if (!names.empty() && rest.empty())
    return fulmar::fcu_messages::subcommand_missing(path, core::join(names)).line();
  if (names.empty() || rest.front().front() == '-') return "";
  return fulmar::fcu_messages::subcommand_unknown(path, rest.front(), core::choices_text(rest.front(), names))
      .line();
}

int usage(const CommandLine& line, const CLI::ParseError& e) {
  const bool words = dynamic_cast<const CLI::RequiredError*>(&e) || dynamic_cast<const CLI::ExtrasError*>(&e);
  const std::string unknown = words ? unknown_command(line.app) : "";
  if (unknown.empty()) return core::report_usage(line.app, e);
  std::fprintf(stderr, "%s\n", core::for_terminal(unknown).c_str());
  return 2;
}

int run(int argc, char** argv) {
  CommandLine line;
  try {
    line.app.parse(argc, argv);
  } catch (const CLI::ParseError& e) {
    return usage(line, e);
  }
  catch_interrupt();
  if (!line.hardware.file.empty() && line.hardware.dry_run) return try_mag_file(line.options, line.hardware);
  Client client(device(line.options.port, line.options.baud));
  client.cancelled = interrupted;
  client.connect();
  return line.deed(client);
}

}  // namespace

int main(int argc, char** argv) {
  std::setvbuf(stdout, nullptr, _IOLBF, 0);  // in order with what goes to stderr
  try {
    return run(argc, argv);
  } catch (const Interrupted& e) {
    std::fprintf(stderr, "\n%s\n", e.what());
    return 130;
  } catch (const std::exception& e) {
    show_progress("");
    std::fprintf(stderr, "%s\n", e.what());
  }
  return 1;
}
