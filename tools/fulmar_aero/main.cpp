// SPDX-License-Identifier: BSD-3-Clause
// `fulmar aero ...`, as the program fulmar-aero. Exit codes: 0 done; 1 there is no such flight, or a check
// has found a fault; 2 wrong usage; 4 the airframe file was refused.
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
  CLI::App app{"Looks at an airframe before it flies.", "fulmar aero"};
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
    trim = app.add_subcommand("trim", "angles, deflections, throttle and forces of a steady flight");
    flight.add(trim);
    trim->footer(
        "Example: fulmar aero trim fulmar:airframes/anaconda.yaml --airspeed \"17 m/s\" --turn \"30 deg\"");
    linearize = app.add_subcommand("linearize", "the linear model about a steady flight: A and B");
    flight.add(linearize);
    linearize->add_flag("--csv", csv, "A and B of all twelve states as CSV");
    linearize->footer("Example: fulmar aero linearize fulmar:airframes/anaconda.yaml --json");
    modes = app.add_subcommand("modes", "short period, phugoid, Dutch roll, roll and spiral, over speeds");
    flight.add(modes, true);
    modes->add_option("--step", step, "between the speeds of a range; else 1 m/s");
    modes->add_option("--svg", svg, "write a picture of them in the complex plane; replaces the file");
    modes->footer(
        "Example: fulmar aero modes fulmar:airframes/anaconda.yaml --airspeed \"12..27 m/s\" --svg "
        "modes.svg");
    check = app.add_subcommand("check", "signs, sizes, units, trim and modes; exit code 1 on a fault");
    check->add_option("AIRFRAME", flight.airframe, "airframe file, or fulmar:airframes/anaconda.yaml")
        ->required();
    check->add_option("--altitude", flight.altitude, "above mean sea level, of the standard air; else 0 m");
    check->add_flag("--json", flight.json, "print one JSON object");
    check->footer("Example: fulmar aero check fulmar:airframes/anaconda.yaml");
    add_tune();
    add_vlm();
    add_see();
    add_import();
    fly = app.add_subcommand("fly", "check, trim, modes, gains and a flight with them, in one");
    fly->add_option("AIRFRAME", flight.airframe, "airframe file, or fulmar:airframes/anaconda.yaml")
        ->required();
    fly->add_option("--altitude", flight.altitude, "above mean sea level, of the standard air; else 0 m");
    fly->add_flag("--write", tuning.write, "put the gains into the file; all else of it stays");
    fly->add_option("-o,--output", report, "a page of all that; replaces the file");
    fly->footer("Example: fulmar aero fly mine.yaml --write -o mine.html");
  }

  void add_vlm() {
    vlm = app.add_subcommand("vlm", "coefficients, mass and inertia of a drawing, by a vortex lattice");
    vlm->add_option("GEOMETRY", drawing.geometry, "surfaces, bodies and masses, as YAML")->required();
    vlm->add_option("-o,--output", drawing.out, "write the airframe there; replaces the file");
    vlm->add_flag("--convergence", drawing.convergence, "the same with fewer and more panels");
    vlm->add_flag("--json", drawing.json, "print one JSON object");
    vlm->footer("Example: fulmar aero vlm fulmar:drawings/petrel.yaml -o petrel.yaml");
  }

  void add_see() {
    see = app.add_subcommand(
        "see", "aircraft side by side on a page: planform, lift, polars, trim, envelope, modes");
    see->add_option("FILE", seen, "airframe files or drawings, up to six")->required()->expected(1, 6);
    see->add_option("-o,--output", page, "the page; replaces the file; else aircraft.html");
    see->add_option("--altitude", flight.altitude, "above mean sea level, of the standard air; else 0 m");
    see->footer(
        "Example: fulmar aero see fulmar:drawings/petrel.yaml fulmar:airframes/anaconda.yaml -o both.html");
  }

  void add_tune() {
    tune = app.add_subcommand("tune", "gains of the shipped laws, their margins, and a flight with them");
    flight.add(tune);
    tune->add_option(
        "--bandwidth", tuning.bandwidths,
        "of roll, pitch, course, height or airspeed, as in \"roll=8 rad/s\"; else what margins allow");
    tune->add_option("--step", tuning.step, "of the laws, as in \"10 ms\"; else that");
    tune->add_option("--delay", tuning.delay, "of estimator, computer and link together; else 0 ms");
    tune->add_flag("--write", tuning.write, "put the gains into the file; all else of it stays");
    tune->add_flag("--verify", tuning.verify, "fly the hourglass with them");
    tune->footer("Example: fulmar aero tune fulmar:airframes/anaconda.yaml --bandwidth \"roll=8 rad/s\"");
  }

  void add_import() {
    ImportArguments& w = importing;
    importer = app.add_subcommand("import",
                                  "an airframe file from files of AVL, XFLR5, VSPAERO, ROSflight, JSBSim or "
                                  "pyfly; exit code 1 on a fault");
    importer->add_option("FILE", w.files, "of one aircraft; where two say the same, the first one counts")
        ->required();
    importer->add_option("-o,--out", w.out, "write the airframe file; replaces it. Else it is printed");
    importer->add_option("--mass", w.mass, "as in \"4.5 kg\"; else that of the files");
    importer->add_option("--inertia", w.inertia, "xx yy zz [xz] in kg m^2; else that of the files")
        ->expected(3, 4);
    importer->add_option("--cruise", w.cruise,
                         "airspeed, as in \"17 m/s\"; else that of the files, or of CL 0.5");
    importer->add_option("--parasite-drag", w.parasite_drag, "CD_p; else that of the files");
    importer->add_option("--alpha", w.alpha, "of a sweep the analysis nearest to it, as in \"3 deg\"");
    importer->add_option("--length-unit", w.length_unit, "of files that do not say theirs, as in ft; else m");
    importer->add_option("--drag-from", w.drag_from, "the file whose drag counts");
    importer->add_option("--controls-from", w.controls_from, "the file whose control derivatives count");
    importer->add_option("--name", w.name, "of the aircraft; else that in the files");
    importer->add_flag("--json", w.json, "print one JSON object");
    importer->footer("Example: fulmar aero import plane.st plane.mass -o plane.yaml");
  }

  /// Of the first word, when it is no command: the sentence, else "".
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
