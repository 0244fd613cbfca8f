// SPDX-License-Identifier: BSD-3-Clause
#include "tools/fulmar_save/answer.hpp"

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/loader/file_sum.hpp"
#include "tools/fulmar_save/messages.hpp"
#include "tools/fulmar_save/named_params.hpp"

namespace fulmar::core {
namespace {

using nlohmann::json;

struct Answer {
  bool accepted = false;
  std::string reason, lines, mark;
};

/// Throws Error when the file is not the active mission.
SavePlan plan_of(const json& request) {
  const std::string file = request.at("file"), component = request.at("component");
  std::vector<std::string> names;
  for (const json& c : request.at("components")) names.push_back(c.at("name"));
  if (!component.empty() && std::find(names.begin(), names.end(), component) == names.end())
    throw Error(save_messages::component_unknown(component, choices_text(component, names)));
  if (!std::filesystem::exists(file)) throw Error(save_messages::mission_file_missing(file));
  check_mission_name(file, request.at("mission"));
  return plan_save(file, saved_params(request, component), flown_plugins(request));
}

/// Mark of the plan: a later plan must have the same one.
std::string mark_of(const SavePlan& plan) {
  std::string all;
  for (const FileEdit& file : plan.files)
    for (const std::string& part : {file.path.string(), file.before, file.after})
      all += std::to_string(part.size()) + ":" + part;
  return plan.files.empty() ? "" : sha256_hex(all.data(), all.size());
}

void add(std::string& sentences, const std::string& more) {
  sentences += (sentences.empty() ? "" : "\n") + more;
}

Answer written(const SavePlan& plan) {
  Answer answer;
  try {
    for (const FileEdit& file : plan.files) {
      write_edit(file);
      add(answer.lines, "written: " + file.path.string());
    }
    answer.accepted = true;
  } catch (const Error& fault) {
    answer.reason = fault.what();
  }
  return answer;
}

Answer answer_to(const json& request) {
  const SavePlan plan = plan_of(request);
  const std::string mark = request.at("mark");
  Answer answer;
  answer.mark = mark_of(plan);
  if (!mark.empty() && mark != answer.mark) throw Error(save_messages::preview_outdated());
  if (!mark.empty()) return written(plan);
  answer.accepted = !plan.files.empty() || plan.refused.empty();
  for (const FileEdit& file : plan.files) answer.lines += diff_text(file);
  for (const std::string& sentence : plan.refused) add(answer.reason, sentence);
  for (const std::string& sentence : plan.also) add(answer.reason, sentence);
  const std::vector<std::string> set = request.at("set");
  for (const std::string& name : plan.changed)
    if (std::find(set.begin(), set.end(), name) != set.end())
      add(answer.reason, save_messages::option_value_saved(name));
  return answer;
}

}  // namespace

std::vector<SavedParam> saved_params(const json& view, const std::string& component) {
  std::vector<SavedParam> list;
  for (const NamedParam& p : params_of(view)) {
    if (!component.empty() && component != p.component) continue;
    // keys of the mission itself
    const bool key = p.vehicle && (p.info.name == "rate" || p.info.name == "epoch");
    if (!key) list.push_back({p.component, p.use, p.info, p.value});
  }
  return list;
}

std::vector<std::string> flown_plugins(const json& view) {
  std::vector<std::string> list;
  for (const json& c : view.value("components", json::array())) list.push_back(c.value("use", ""));
  return list;
}

json save_answer(const json& request) {
  Answer answer;
  try {
    answer = answer_to(request);
  } catch (const std::exception& fault) {
    answer.reason = fault.what();
  }
  return {{"accepted", answer.accepted},
          {"reason", answer.reason},
          {"lines", answer.lines},
          {"mark", answer.mark}};
}

}  // namespace fulmar::core
