// SPDX-License-Identifier: BSD-3-Clause
// `fulmar aero ...`, as the program fulmar-aero. Exit codes: 0 done; 1 there is no such flight, or a check
// has found a fault; 2 wrong usage; 4 the airframe file is invalid.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>

#include "core/app/program.hpp"
#include "core/error.hpp"
#include "core/types/text.hpp"
#include "fulmar/abi.h"
#include "tools/fulmar_aero/commands.hpp"
#include "tools/fulmar_aero/messages.hpp"

namespace {

using namespace fulmar::aero;
namespace core = fulmar::core;

struct CommandLine {
  CLI::App app{"Analyse, tune and import airframes.", "fulmar aero"};
  FlightOptions flight;
  std::string step, svg, page = "aircraft.html", report;
  std::vector<std::string> seen;
  bool csv = false;
  TuneOptions tuning;
  VlmCommand drawing;
  ImportArguments importing;
  CLI::App *trim, *linearize, *modes, *check, *tune, *vlm, *see, *fly, *importer;

  CommandLine() {
    app.require_subcommand(1);
    app.set_version_flag("--version", "fulmar aero " FULMAR_VERSION);
    app.footer("Example: fulmar aero check configs/airframes/anaconda.yaml");
    trim = app.add_subcommand("trim", "compute angles, deflections, throttle and forces of a steady flight");
    flight.add(trim);
    trim->footer(
        "Example: fulmar aero trim fulmar:airframes/anaconda.yaml --airspeed \"17 m/s\" --turn \"30 deg\"");
    linearize = app.add_subcommand("linearize", "compute the linear model (A, B) about a steady flight");
    flight.add(linearize);
    linearize->add_flag("--csv", csv, "print A and B of all twelve states as CSV");
    linearize->footer("Example: fulmar aero linearize fulmar:airframes/anaconda.yaml --json");
    modes = app.add_subcommand(
        "modes", "compute short period, phugoid, Dutch roll, roll and spiral modes over airspeed");
    flight.add(modes, true);
    modes->add_option("--step", step, "set the step of the airspeed range; default 1 m/s");
    modes->add_option("--svg", svg, "draw the modes in the complex plane to FILE; replaces the file")
        ->type_name("FILE");
    modes->footer(
        "Example: fulmar aero modes fulmar:airframes/anaconda.yaml --airspeed \"12..27 m/s\" --svg "
        "modes.svg");
    check = app.add_subcommand("check", "check signs, sizes, units, trim and modes; exit code 1 on an error");
    check->add_option("AIRFRAME", flight.airframe, "airframe file, or fulmar:airframes/anaconda.yaml")
        ->required();
    check->add_option("--altitude", flight.altitude,
                      "set the altitude above mean sea level in the standard atmosphere; default 0 m");
    check->add_flag("--json", flight.json, "print one JSON object");
    check->footer("Example: fulmar aero check fulmar:airframes/anaconda.yaml");
    add_tune();
    add_vlm();
    add_see();
    add_import();
    fly =
        app.add_subcommand("fly", "check an airframe, compute trim, modes and gains, and fly with the gains");
    fly->add_option("AIRFRAME", flight.airframe, "airframe file, or fulmar:airframes/anaconda.yaml")
        ->required();
    fly->add_option("--altitude", flight.altitude,
                    "set the altitude above mean sea level in the standard atmosphere; default 0 m");
    fly->add_flag("--write", tuning.write, "write the gains to the airframe file; the rest is kept");
    fly->add_option("-o,--output", report, "write a page with all results to FILE; replaces the file")
        ->type_name("FILE");
    fly->footer("Example: fulmar aero fly mine.yaml --write -o mine.html");
  }

  void add_vlm() {
    vlm = app.add_subcommand(
        "vlm", "compute coefficients, mass and inertia from geometry by the vortex lattice method");
    vlm->add_option("GEOMETRY", drawing.geometry, "surfaces, bodies and masses (YAML)")->required();
    vlm->add_option("-o,--output", drawing.out, "write the airframe to FILE; replaces the file")
        ->type_name("FILE");
    vlm->add_flag("--convergence", drawing.convergence, "repeat the computation with fewer and more panels");
    vlm->add_flag("--json", drawing.json, "print one JSON object");
    vlm->footer("Example: fulmar aero vlm fulmar:drawings/petrel.yaml -o petrel.yaml");
  }

  void add_see() {
    see = app.add_subcommand("see",
                             "compare aircraft on a page: planform, lift, polars, trim, envelope, modes");
    see->add_option("FILE", seen, "airframe or geometry files, up to six")->required()->expected(1, 6);
    see->add_option("-o,--output", page, "write the page to FILE; replaces the file; default aircraft.html")
        ->type_name("FILE");
    see->add_option("--altitude", flight.altitude,
                    "set the altitude above mean sea level in the standard atmosphere; default 0 m");
    see->footer(
        "Example: fulmar aero see fulmar:drawings/petrel.yaml fulmar:airframes/anaconda.yaml -o both.html");
  }

  void add_tune() {
    tune = app.add_subcommand("tune", "compute gains and margins of the shipped control laws");
    flight.add(tune);
    tune->add_option("--bandwidth", tuning.bandwidths,
                     "set the bandwidth of roll, pitch, course, height or airspeed, as in \"roll=8 rad/s\"; "
                     "default: from margins");
    tune->add_option("--step", tuning.step, "set the period of the laws; default 10 ms");
    tune->add_option("--delay", tuning.delay,
                     "set the total delay of estimator, computer and link; default 0 ms");
    tune->add_flag("--write", tuning.write, "write the gains to the airframe file; the rest is kept");
    tune->add_flag("--verify", tuning.verify, "fly the hourglass mission with the gains");
    tune->footer("Example: fulmar aero tune fulmar:airframes/anaconda.yaml --bandwidth \"roll=8 rad/s\"");
  }

  void add_import() {
    ImportArguments& w = importing;
    importer =
        app.add_subcommand("import",
                           "write an airframe file from files of AVL, XFLR5, VSPAERO, ROSflight, JSBSim "
                           "or pyfly; exit code 1 on an error");
    importer
        ->add_option("FILE", w.files, "files of one aircraft; the first file with a value takes precedence")
        ->required();
    importer
        ->add_option("-o,--out", w.out, "write the airframe to FILE; replaces the file; default: print it")
        ->type_name("FILE");
    importer->add_option("--mass", w.mass, "set the mass, as in \"4.5 kg\"; default: from the files");
    importer
        ->add_option("--inertia", w.inertia,
                     "set the inertia xx yy zz [xz] in kg m^2; default: from the files")
        ->expected(1, 4);  // options_of() refuses 1 and 2
    importer->add_option("--cruise", w.cruise,
                         "set cruise airspeed, as in \"17 m/s\"; default: from the files, or at CL 0.5");
    importer->add_option("--parasite-drag", w.parasite_drag,
                         "set the parasite drag CD_p; default: from the files");
    importer->add_option("--alpha", w.alpha,
                         "use the analysis of a sweep nearest to this angle of attack, as in \"3 deg\"");
    importer->add_option("--length-unit", w.length_unit,
                         "set the length unit of files without one, as in ft; default m");
    importer->add_option("--drag-from", w.drag_from, "take the drag from FILE")->type_name("FILE");
    importer->add_option("--controls-from", w.controls_from, "take the control derivatives from FILE")
        ->type_name("FILE");
    importer->add_option("--name", w.name, "set the name of the aircraft; default: from the files");
    importer->add_flag("--json", w.json, "print one JSON object");
    importer->footer("Example: fulmar aero import plane.st plane.mass -o plane.yaml");
  }

  /// Message for a first word that is no command, else "".
  std::string unknown(int argc, char** argv) const {
    std::vector<std::string> names;
    for (const CLI::App* one : {trim, linearize, modes, check, tune, vlm, see, fly, importer})
      names.push_back(one->get_name());
    if (argc < 2 || argv[1][0] == '-' || std::find(names.begin(), names.end(), argv[1]) != names.end())
      return "";
    return fulmar::aero_messages::command_unknown(argv[1], core::choices_text(argv[1], names)).line();
  }

  int run() const {
    if (trim->parsed()) return trim_command(flight);
    if (linearize->parsed()) return linearize_command(flight, csv);
    if (tune->parsed()) return tune_command(flight, tuning);
    if (vlm->parsed()) return vlm_command(drawing);
    if (see->parsed()) return see_command(seen, flight, page);
    if (fly->parsed()) return fly_command(flight, tuning.write, report);
    if (importer->parsed()) return import_command(importing);
    return modes->parsed() ? modes_command(flight, step, svg) : check_command(flight);
  }
};

}  // namespace

int main(int argc, char** argv) {
  CommandLine line;
  return core::run_program(
      line.app,
      [&] {
        if (core::asked_for_rows(argc, argv)) {
          std::fputs(core::command_rows(line.app).c_str(), stdout);
          return 0;
        }
        if (const std::string sentence = line.unknown(argc, argv); !sentence.empty()) {
          std::fprintf(stderr, "%s\n", core::for_terminal(sentence).c_str());
          return int(core::ExitCode::usage);
        }
        line.app.parse(argc, argv);
        return line.run();
      },
      core::ExitCode::refused);
}
