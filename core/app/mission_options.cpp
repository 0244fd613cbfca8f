// SPDX-License-Identifier: BSD-3-Clause
#include "core/app/mission_options.hpp"

#include "core/app/messages.hpp"

namespace fulmar::core {
namespace {

const CLI::Validator whole_number(
    [](const std::string& text) {
      const bool good =
          !text.empty() && text.size() < 20 && text.find_first_not_of("0123456789") == std::string::npos;
      return good ? std::string() : app_messages::whole_number_invalid(text).line();
    },
    "NUMBER");

}  // namespace

std::vector<std::pair<std::string, std::string>> pairs(const std::vector<std::string>& words,
                                                       const char* option, const char* form) {
  std::vector<std::pair<std::string, std::string>> out;
  for (const std::string& word : words) {
    const std::size_t equals = word.find('=');
    if (equals == std::string::npos || equals == 0)
      throw CLI::ValidationError(app_messages::assignment_form_invalid(option, word, form).line());
    out.emplace_back(word.substr(0, equals), word.substr(equals + 1));
  }
  return out;
}

void add_pairs(CLI::App* command, const char* option, std::vector<std::string>& words, const char* type,
               const char* help) {
  command->add_option(option, words, help)->type_name(type)->allow_extra_args(false);
}

CLI::Validator a_file(const std::string& otherwise) {
  return CLI::Validator(
      [otherwise](const std::string& text) {
        return text.empty() ? app_messages::file_name_empty(otherwise).line() : std::string();
      },
      "");
}

void MissionOptions::add(CLI::App* command) {
  command->add_option("MISSION", mission, "mission file (YAML)")->required();
  command->add_option("--io", io, "select the simulated aircraft (sim) or the flight controller (fcu)")
      ->check(CLI::IsMember({"sim", "fcu"}));
  add_pairs(command, "--role", roles, "ROLE=COMPONENT", "assign COMPONENT to ROLE in every phase");
  add_pairs(command, "--with", with, "COMPONENT=FILE",
            "load COMPONENT, or the component of a role, from plugin FILE");
  command->add_option("--seed", seed, "set the seed of all noise")->check(whole_number);
  add_pairs(command, "--set", set, "COMP.PARAM=VALUE",
            "set a parameter, or a field of a record as in sim.airframe.mass=\"5 kg\"");
  command->add_option("--arm", arm, "simulation: arm automatically (auto), or wait for an arm request (off)")
      ->check(CLI::IsMember({"auto", "off"}));
  add_pairs(command, "--record", record, "PORTS[@RATE]",
            "log additional PORTS: all, nav.*, or nav.*,outer.attitude@100Hz; without RATE every sample");
}

Overrides MissionOptions::overrides(const CLI::App* command) const {
  Overrides o;
  if (!io.empty()) o.io = io;
  if (command->count("--seed") > 0) o.seed = seed;
  o.roles = pairs(roles, "--role", "ROLE=COMPONENT");
  o.set = pairs(set, "--set", "COMP.PARAM=VALUE");
  o.with = pairs(with, "--with", "COMPONENT=FILE");
  o.record = record;
  if (!arm.empty()) o.arm = arm;
  for (const auto& [component, file] : o.with)
    if (file.empty())
      throw CLI::ValidationError(app_messages::with_file_missing(component, component).line());
  return o;
}

}  // namespace fulmar::core
