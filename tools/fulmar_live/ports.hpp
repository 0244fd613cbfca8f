// SPDX-License-Identifier: BSD-3-Clause
// Ports and fields by displayed names, "nav.state.position_m.north", looked up among the topics of a running
// flight.
#pragma once
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "core/types/type.hpp"
#include "tools/fulmar_live/session.hpp"

namespace fulmar::core {

/// "nav.state" -> "/nav/state", and back.
std::string topic_of(const std::string& port);
std::string port_of(const std::string& topic);

struct PortField {
  std::string topic;
  TypePtr type;
  std::string field;  // "position_m.north"; "" for the whole message. Angles are named as they are in the
                      // message: roll_rad
  std::string label;  // displayed name: "nav.state.roll_deg"
};

/// Finds the port by topic, by component ("ekf.state" where the topic is that of the role) or as a probe.
/// Fields are checked; a name in
/// `_deg` finds the field in `_rad`, one in `_degps` that in `_radps`. Throws Error with the nearest name and
/// the choices.
PortField find_port(Session& session, const std::string& name);

/// Names of the ports that can be echoed, sorted.
std::vector<std::string> port_names(Session& session);

/// The part of a message that `field` names, from shown_json; null when the list is shorter.
nlohmann::ordered_json part_of(const nlohmann::ordered_json& message, const std::string& field);

}  // namespace fulmar::core
