// SPDX-License-Identifier: BSD-3-Clause
#include "core/app/mission_options.hpp"

namespace fulmar::core {
namespace {

const CLI::Validator whole_number(
    [](const std::string& text) {
      const bool good =
          !text.empty() && text.size() < 20 && text.find_first_not_of("0123456789") == std::string::npos;
      return good ? std::string() : "give a whole number from 0, not '" + text + "'";
    },
    "NUMBER");

}  // namespace

std::vector<std::pair<std::string, std::string>> pairs(const std::vector<std::string>& words) {
  std::vector<std::pair<std::string, std::string>> out;
  for (const std::string& word : words) {
    const std::size_t equals = word.find('=');
    if (equals == std::string::npos || equals == 0)
      throw CLI::ValidationError("'" + word + "' is not of the form name=value");
    out.emplace_back(word.substr(0, equals), word.substr(equals + 1));
  }
  return out;
}

void MissionOptions::add(CLI::App* command) {
  command->add_option("MISSION", mission, "mission file (YAML)")->required();
  command->add_option("--io", io, "sim or fcu: simulated aircraft or flight controller")
      ->check(CLI::IsMember({"sim", "fcu"}));
  command->add_option("--role", roles, "ROLE=COMPONENT: who fills a role in every phase")
      ->type_name("ROLE=COMPONENT")
      ->allow_extra_args(false);
  command->add_option("--with", with, "COMPONENT=PLUGIN.so: another file for a component")
      ->type_name("COMPONENT=FILE")
      ->allow_extra_args(false);
  command->add_option("--seed", seed, "seed of all noise")->check(whole_number);
  command->add_option("--set", set, "COMPONENT.PARAMETER=VALUE")
      ->type_name("COMP.PARAM=VALUE")
      ->allow_extra_args(false);
}

Overrides MissionOptions::overrides(const CLI::App* command) const {
  Overrides o;
  if (!io.empty()) o.io = io;
  if (command->count("--seed") > 0) o.seed = seed;
  o.roles = pairs(roles);
  o.set = pairs(set);
  o.with = pairs(with);
  for (const auto& [component, file] : o.with)
    if (file.empty())
      throw CLI::ValidationError("--with " + component + "=: a file is missing, as in --with " + component +
                                 "=my_law.so");
  return o;
}

}  // namespace fulmar::core
