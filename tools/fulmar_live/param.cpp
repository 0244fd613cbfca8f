// SPDX-License-Identifier: BSD-3-Clause
// `fulmar param list|get|set|save`.
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <iostream>
#include <nlohmann/json.hpp>

#include "tools/fulmar_live/commands.hpp"
#include "tools/fulmar_live/messages.hpp"
#include "tools/fulmar_live/parameters.hpp"
#include "tools/fulmar_live/session.hpp"
#include "tools/fulmar_live/table.hpp"
#include "tools/fulmar_save/answer.hpp"

namespace fulmar::core {
namespace {

using nlohmann::json;

json param_json(const NamedParam& p, const json& view) {
  for (const json& c : view.value("components", json::array()))
    for (const json& param : c.value("params", json::array()))
      if (c.value("name", "") == p.component && param.value("name", "") == p.info.name) {
        json object = param;
        object["name"] = p.name;
        return object;
      }
  return nullptr;
}

/// "slc" selects all of slc; so does a word without a star that begins a name.
bool asked_for(const NamedParam& p, const std::string& pattern) {
  return pattern.empty() || p.component == pattern || port_matches(p.name, pattern);
}

}  // namespace

int param_list_command(const LiveAddress& target, const std::string& pattern, bool as_json) {
  Session session(target);
  const json view = session.view();
  const std::vector<NamedParam> params = params_of(view);
  json all = json::array();
  std::vector<std::vector<std::string>> rows;
  for (const NamedParam& p : params) {
    if (!asked_for(p, pattern)) continue;
    if (as_json) all.push_back(param_json(p, view));
    rows.push_back({p.name, shown_value(p.info, p.value), shown_range(p.info),
                    p.info.live ? "live" : "set-up", p.overlaid ? "overlaid" : ""});
  }
  if (rows.empty()) {
    if (pattern.find('*') != std::string::npos) throw Error(remote_messages::pattern_unmatched(pattern));
    find_param(params, pattern);
  }
  std::fputs(as_json ? (all.dump() + "\n").c_str() : table_text(rows).c_str(), stdout);
  return 0;
}

int param_get_command(const LiveAddress& target, const std::vector<std::string>& names, bool as_json) {
  Session session(target);
  const json view = session.view();
  const std::vector<NamedParam> params = params_of(view);
  std::vector<const NamedParam*> found;
  for (const std::string& name : names) found.push_back(&find_param(params, name));
  for (const NamedParam* p : found) {
    if (as_json)
      std::printf("%s\n", param_json(*p, view).dump().c_str());
    else if (found.size() == 1)
      std::printf("%s\n", shown_value(p->info, p->value).c_str());
    else
      std::printf("%s: %s\n", p->name.c_str(), shown_value(p->info, p->value).c_str());
  }
  return 0;
}

namespace {

/// The reason without the name of the parameter, which the message already has: "slc.roll_limit: roll_limit:
/// 100 deg is outside".
std::string without_name(std::string reason, const NamedParam& p) {
  for (const std::string& name : {p.name + ": ", p.info.name + ": "})
    if (reason.starts_with(name)) reason.erase(0, name.size());
  return reason;
}

std::string already_set(const std::vector<std::string>& words, std::size_t refused) {
  std::vector<std::string> before, after;
  for (std::size_t i = 0; i < words.size(); i += 2)
    if (i != refused) (i < refused ? before : after).push_back(words[i]);
  return (before.empty() ? "" : "; already set: " + join(before)) +
         (after.empty() ? "" : "; not tried: " + join(after));
}

}  // namespace

int param_set_command(const LiveAddress& target, const std::vector<std::string>& words) {
  if (words.size() % 2 != 0) throw WrongUsage(remote_messages::parameter_value_missing(words.back()));
  Session session(target);
  const std::vector<NamedParam> params = params_of(session.view());
  for (std::size_t i = 0; i < words.size(); i += 2)
    find_param(params, words[i]);  // check all names before the first change
  for (std::size_t i = 0; i < words.size(); i += 2) {
    const NamedParam& p = find_param(params, words[i]);
    const auto [accepted, reason] = session.order(
        "/fulmar/set_parameter", {{"component", p.component}, {"name", p.info.name}, {"text", words[i + 1]}});
    if (!accepted)
      throw Error(remote_messages::parameter_rejected(p.name, words[i + 1], without_name(reason, p),
                                                      already_set(words, i)));
    std::printf("%s: %s -> %s%s\n", p.name.c_str(), shown_value(p.info, p.value).c_str(),
                words[i + 1].c_str(), p.overlaid ? remote_messages::phase_overlays_parameter.c_str() : "");
  }
  return 0;
}

namespace {

std::filesystem::path mission_file(const json& view, const std::string& given) {
  const std::string file = given.empty() ? view.value("file", "") : given;
  if (file.empty()) throw Error(remote_messages::mission_file_unknown());
  if (!std::filesystem::exists(file)) throw Error(remote_messages::mission_file_missing(file));
  check_mission_name(file, view.value("mission", ""));
  return file;
}

bool agreed() {
  if (!isatty(STDIN_FILENO)) throw Error(remote_messages::confirmation_required());
  std::printf("Write this? [y/N] ");
  std::fflush(stdout);
  std::string answer;
  std::getline(std::cin, answer);
  return answer == "y" || answer == "yes";
}

}  // namespace

int param_save_command(const LiveAddress& target, const SaveOptions& options) {
  Session session(target);
  const json view = session.view();
  const std::vector<SavedParam> list = saved_params(view, options.component);
  const std::vector<NamedParam> params = params_of(view);
  const auto of_component = [&](const NamedParam& p) { return p.component == options.component; };
  if (!options.component.empty() && std::none_of(params.begin(), params.end(), of_component))
    find_param(params, options.component);  // throws: it is unknown
  const SavePlan plan = plan_save(mission_file(view, options.mission), list, flown_plugins(view));
  for (const FileEdit& file : plan.files) std::fputs(diff_text(file).c_str(), stdout);
  for (const std::string& sentence : plan.refused) std::fprintf(stderr, "%s\n", sentence.c_str());
  for (const std::string& sentence : plan.also) std::fprintf(stderr, "%s\n", sentence.c_str());
  const int code = plan.refused.empty() ? 0 : 1;
  if (plan.files.empty()) {
    if (plan.refused.empty()) std::printf("%s\n", remote_messages::parameters_unchanged.c_str());
    return code;
  }
  if (options.dry_run) return code;
  if (!options.yes && !agreed()) {
    std::printf("Nothing was written.\n");
    return 1;
  }
  for (const FileEdit& file : plan.files) {
    write_edit(file);
    std::printf("written: %s\n", file.path.string().c_str());
  }
  return code;
}

}  // namespace fulmar::core
