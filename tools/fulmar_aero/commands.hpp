// SPDX-License-Identifier: BSD-3-Clause
// The commands of `fulmar aero`. Each returns an exit code: 0 done, 1 no such flight or faults found.
#pragma once
#include <string>
#include <vector>

#include "tools/fulmar_aero/options.hpp"

namespace fulmar::aero {

int trim_command(const FlightOptions& options);
int linearize_command(const FlightOptions& options, bool csv);
/// `step` between speeds; `svg`: a file for the picture, or "".
int modes_command(const FlightOptions& options, const std::string& step, const std::string& svg);
int check_command(const FlightOptions& options);
/// Texts of bandwidths and times; "" for the default.
struct TuneOptions {
  std::vector<std::string> bandwidths;  ///< "roll=8 rad/s"
  std::string step, delay;
  bool write = false, verify = false;
};
int tune_command(const FlightOptions& options, const TuneOptions& tune_options);
struct VlmCommand {
  std::string geometry, out;  ///< `out`: file of the airframe, or ""
  bool convergence = false, json = false;
};
int vlm_command(const VlmCommand& options);
/// Writes `out`, a page of airframes and drawings. Returns 1 when one has no level flight in cruise; the page
/// has the reason.
int see_command(const std::vector<std::string>& files, const FlightOptions& options, const std::string& out);
/// Check, trim, modes, gains and a flight with them, up to the first failure. `report`: page of the results,
/// or "".
int fly_command(const FlightOptions& options, bool write, const std::string& report);
/// Texts of the command line; "" for the default.
struct ImportArguments {
  std::vector<std::string> files;
  std::string out, mass, length_unit, cruise, parasite_drag, alpha, name, drag_from, controls_from;
  std::vector<double> inertia;
  bool json = false;
};
/// Returns 1 when the check of the result finds a fault, or its eigenvalues differ from those of the files.
int import_command(const ImportArguments& words);
/// Converts a folder of ROSplane's files to airframe, plans and missions in the folder `out`.
int rosplane_command(const std::string& folder, const std::string& out);

}  // namespace fulmar::aero
