// SPDX-License-Identifier: BSD-3-Clause
// See saving.hpp.
#include "core/live/saving.hpp"

#include <algorithm>
#include <filesystem>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/graph/mission.hpp"
#include "core/graph/param_file.hpp"
#include "core/loader/library.hpp"
#include "core/types/text.hpp"
#include "fulmar/quiet_thread.hpp"

namespace fulmar::core::live {
namespace {

std::vector<SavedParam> params_of(const FlightView& view, const std::string& component) {
  std::vector<SavedParam> list;
  std::vector<std::string> names;
  for (const ComponentView& c : view.components) {
    names.push_back(c.name);
    if (!component.empty() && component != c.name) continue;
    const bool vehicle = c.role == "vehicle";
    for (const ParameterView& p : c.params)
      if (!vehicle || (p.info.name != "rate" && p.info.name != "epoch"))  // the mission's own keys
        list.push_back({c.name, c.use, p.info, p.base});
  }
  if (!component.empty() && std::find(names.begin(), names.end(), component) == names.end())
    throw Error("there is no component '" + component + "'." + choices_text(component, names));
  return list;
}

/// Throws Error where the file is not the mission that flies.
SavePlan plan_of(const FlightView& view, const std::string& component) {
  if (!view.no_save.empty()) throw Error("nothing is written from here: " + view.no_save);
  if (view.file.empty()) throw Error("this flight has no mission file that could be written");
  const std::vector<SavedParam> params = params_of(view, component);
  if (!std::filesystem::exists(view.file)) throw Error("the mission's file " + view.file + " is gone");
  check_mission_name(view.file, view.mission);
  std::vector<std::string> flown;
  for (const ComponentView& c : view.components) flown.push_back(c.use);
  return plan_save(view.file, params, flown);
}

/// What a later look would have to find the same.
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

SaveAnswer written(const SavePlan& plan) {
  SaveAnswer answer;
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

SaveAnswer answer_to(const FlightView& view, const std::string& component, const std::string& mark) {
  const SavePlan plan = plan_of(view, component);
  SaveAnswer answer;
  answer.mark = mark_of(plan);
  if (!mark.empty() && mark != answer.mark)
    throw Error("what would be written is not what was shown any more: look again");
  if (!mark.empty()) return written(plan);
  answer.accepted = !plan.files.empty() || plan.refused.empty();
  for (const FileEdit& file : plan.files) answer.lines += diff_text(file);
  for (const std::string& sentence : plan.refused) add(answer.reason, sentence);
  for (const std::string& sentence : plan.also) add(answer.reason, sentence);
  for (const std::string& name : plan.changed)
    if (std::find(view.set.begin(), view.set.end(), name) != view.set.end())
      add(answer.reason, name + " was given by --set: written, it is the mission's");
  return answer;
}

}  // namespace

SaveAnswer save(const FlightView& view, const std::string& component, const std::string& mark) noexcept {
  SaveAnswer refused;
  try {
    return answer_to(view, component, mark);
  } catch (const std::exception& fault) {
    refused.reason = fault.what();
  }
  return refused;
}

void Saving::begin(FlightView view, std::string component, std::string mark,
                   std::function<void(const SaveAnswer&)> answer) {
  if (busy_->exchange(true)) throw Error("another one's parameters are being saved; ask again");
  // It holds nothing of ours but this: a disk that hangs does not keep the flight from its end.
  quiet_thread("fulmar-save", [busy = busy_, view = std::move(view), component = std::move(component),
                               mark = std::move(mark), answer = std::move(answer)] {
    const SaveAnswer said = save(view, component, mark);
    busy->store(false);
    answer(said);
  }).detach();
}

}  // namespace fulmar::core::live
