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
      "Configure, calibrate and check a flight controller with ROSflight firmware 2, on the ground. No "
      "flight may hold its port.",
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
    app.add_option("--port", options.port,
                   "connect to a serial device, or to udp:ADDRESS:PORT for firmware in simulation")
        ->envname("FULMAR_FCU_PORT")
        ->capture_default_str();
    app.add_option("--baud", options.baud, "set the baud rate of a serial line; USB ignores it")
        ->check(CLI::Range(1200, 12000000))
        ->capture_default_str();
    app.add_flag("--json", options.json, "print results as JSON");
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
    sub->footer("");  // that of the parent is used
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
    CLI::App* status = command(&app, "status", "show the state of the controller", [this](Client& c) {
      return status_command(c, options, once || (!watch && !on_terminal()));
    });
    CLI::Option* one =
        status->add_flag("--once", once, "print the state once; default if the output is not a terminal");
    status
        ->add_flag("--watch", watch,
                   "print the state twice a second until interrupted; default on a terminal")
        ->excludes(one);
    command(&app, "version", "print the firmware version",
            [this](Client& c) { return version_command(c, options); });
  }

  void add_params() {
    CLI::App* all = command(&app, "params", "list, read, set and save parameters of the controller", {});
    all->require_subcommand(1);
    CLI::App* list = command(all, "list", "list all parameters, or those that match PATTERN",
                             [this](Client& c) { return params_list(c, options, params); });
    list->add_option("PATTERN", params.pattern, "part of a name, or with * and ?, as in 'RC_*_CHN'");
    CLI::App* get = command(all, "get", "print one parameter",
                            [this](Client& c) { return params_get(c, options, params); });
    get->add_option("NAME", params.name, "name of the parameter; case is ignored")->required();
    CLI::App* set = command(all, "set", "set one parameter and read it back",
                            [this](Client& c) { return params_set(c, options, params); });
    set->add_option("NAME", params.name, "name of the parameter; case is ignored")->required();
    set->add_option("VALUE", params.value, "value of the parameter's type, as 'params get' shows it")
        ->required();
    command(all, "write", "write parameters to non-volatile memory",
            [this](Client& c) { return params_write(c, options); });
    CLI::App* save = command(all, "save", "save parameters to a YAML file",
                             [this](Client& c) { return params_save(c, options, params); });
    CLI::App* load =
        command(all, "load", "show changes and set the parameters of a YAML file of Fulmar or ROSflight",
                [this](Client& c) { return params_load(c, options, params); });
    CLI::App* diff = command(all, "diff", "compare parameters with a YAML file; exit code 1 on differences",
                             [this](Client& c) { return params_diff(c, options, params); });
    for (CLI::App* sub : {save, load, diff})
      sub->add_option("FILE", params.file, "YAML: lines NAME: value")->required();
    for (CLI::App* sub : {set, load})
      sub->add_flag("--write", params.write, "write the parameters to non-volatile memory afterwards");
    save->add_flag("--replace", params.replace, "overwrite an existing file");
    load->add_flag("--yes", options.yes, "skip the confirmation");
  }

  void add_calibrate() {
    CLI::App* all = command(&app, "calibrate", "calibrate a sensor; rejected while armed", {});
    all->require_subcommand(1);
    const auto one = [&](const std::string& name, const std::string& what) {
      CLI::App* sub = command(all, name, what, [this, name](Client& c) {
        hardware.what = name;
        return calibrate_command(c, options, hardware);
      });
      sub->add_flag("--write", hardware.write, "write the result to non-volatile memory afterwards");
      return sub;
    };
    one("imu", "calibrate gyroscope and accelerometer: keep the aircraft level and still, 3 s");
    one("gyro", "calibrate the gyroscope: keep the aircraft still, 3 s");
    one("rc", "set the controller's trims to those of the transmitter");
    one("baro", "set the barometer's reference to the ground, 8 s");
    one("airspeed", "calibrate the airspeed sensor: cover the pitot, 8 s");
    CLI::App* mag = one("mag", "calibrate the magnetometer: rotate the aircraft on each of its six sides");
    CLI::Option* from = mag->add_option("--from", hardware.file,
                                        "use raw samples from FILE instead of rotating: x,y,z in tesla")
                            ->type_name("FILE");
    mag->add_option("--record", hardware.record, "write the samples to FILE")
        ->type_name("FILE")
        ->excludes(from);
    mag->add_flag("--dry-run", hardware.dry_run, "print the result and set nothing");
    mag->add_flag("--yes", options.yes, "skip the confirmation");
  }

  void add_hardware() {
    CLI::App* check = command(&app, "check", "run the preflight checks; exit code 1 on a FAIL",
                              [this](Client& c) { return check_command(c, options, hardware); });
    check->add_option("--airframe", hardware.airframe, "compare with airframe FILE")->type_name("FILE");
    CLI::App* measure =
        command(&app, "bench", "measure latency, rates, losses and noise of the board at rest",
                [this](Client& c) { return bench_command(c, options, bench); });
    measure->add_option("FILE", bench.file, "report file: .json, else Markdown")->required();
    measure->add_option("--seconds", bench.seconds, "set the time of the measurement")
        ->type_name("SECONDS")
        ->check(CLI::Range(1, 3600))
        ->capture_default_str();
    measure->add_flag("--replace", bench.replace, "overwrite an existing file");
    command(&app, "mixer", "print the command of each output",
            [this](Client& c) { return mixer_command(c, options); });
    CLI::App* outputs =
        command(&app, "test-outputs", "move aileron, elevator and rudder; propeller off, disarmed",
                [this](Client& c) { return outputs_command(c, options, hardware); });
    outputs->add_flag("--propeller-off", hardware.propeller_off,
                      "confirm that the propeller is off and skip the question");
    command(&app, "reboot", "restart the controller; unwritten parameters are lost",
            [this](Client& c) { return reboot_command(c, options); });
  }
};

/// Message for an unknown or missing command, "fulmar fcu calibrate: there is no command 'foo'. ..."; ""
/// otherwise.
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
  std::setvbuf(stdout, nullptr, _IOLBF, 0);  // in order with the output to stderr
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
