// SPDX-License-Identifier: BSD-3-Clause
// A component without a role: its ports come from the command line or from a template of the SDK.
#pragma once
#include <string>
#include <vector>

#include "tools/fulmar_new/new_contract.hpp"

namespace fulmar::core {

/// `in`: "state=nav.state", "edits=search.edits[]" for a queue, "truth?=vehicle.truth" for one that may be
/// missing. `out`: "range=Range", "edits=PlanEdit[]". Throws Error.
Contract ports_contract(const MissionView& mission, const std::vector<std::string>& in,
                        const std::vector<std::string>& out);

/// Contract of a template. The first lines of its source give "// wired: state vehicle.truth nav.state" (the
/// first that the mission has), "// rate: 20 Hz" and "// feeds: edits plan.edits"; `in` gives other wires.
/// Throws Error.
Contract template_contract(const MissionView& mission, const std::string& name, const std::string& source,
                           const std::vector<std::string>& in);

/// Without the lines for template_contract and for the choice of a template.
std::string without_template_lines(std::string source);

}  // namespace fulmar::core
