// SPDX-License-Identifier: BSD-3-Clause
#include <cstdio>
#include <nlohmann/json.hpp>

#include "tools/fulmar_fcu/app.hpp"
#include "tools/fulmar_fcu/messages.hpp"
#include "tools/fulmar_fcu/param_file.hpp"

namespace fulmar::fcu {

namespace {

constexpr const char* unsaved =
    "It is in the controller's memory and gone after a power cycle: 'fulmar fcu params write' keeps it.\n";

nlohmann::json param_json(const Param& param) {
  // the text of the float, not of the double next to it: 0.1, not 0.10000000149
  const nlohmann::json value =
      param.whole ? nlohmann::json(param.integer()) : nlohmann::json::parse(param.text(), nullptr, false);
  return {{"name", param.name},
          {"index", param.index},
          {"type", param.whole ? "int" : "float"},
          {"value", value.is_discarded() ? nlohmann::json() : value},
          {"bits", param.bits}};
}

std::vector<Param> all(Client& client) {
  std::vector<Param> list = read_params(client, [](std::size_t have, std::size_t n) {
    if (have % 16 == 0 || have == n)
      show_progress(std::to_string(have) + " of " + std::to_string(n) + " parameters");
  });
  show_progress("");
  return list;
}

void print_param(const Param& param) {
  std::printf("%3u  %-16s  %-5s  %s\n", static_cast<unsigned>(param.index), param.name.c_str(),
              param.whole ? "int" : "float", param.text().c_str());
}

std::string counted(std::size_t n, const std::string& what) {
  return std::to_string(n) + " " + what + (n == 1 ? "" : "s");
}

}  // namespace

void write_flash(Client& client) {
  client.refuse_armed("writing the parameters");
  client.demand(Command::write_params, "writing the parameters",
                " and gave no reason: its flash does not take them, and they are gone after a power cycle.");
  std::printf("Written: the controller keeps its parameters over a power cycle.\n");
}

int params_list(Client& client, const Options& options, const ParamsOptions& what) {
  std::size_t shown = 0;
  nlohmann::json out = nlohmann::json::array();
  for (const Param& param : all(client)) {
    if (!what.pattern.empty() && !matches(param.name, what.pattern)) continue;
    ++shown;
    if (options.json)
      out.push_back(param_json(param));
    else
      print_param(param);
  }
  if (options.json) std::printf("%s\n", out.dump(1).c_str());
  if (shown == 0 && !what.pattern.empty())
    throw Error(fcu_messages::pattern_unmatched(client.param_count(), what.pattern));
  return 0;
}

int params_get(Client& client, const Options& options, const ParamsOptions& what) {
  const Param param = read_param(client, what.name);
  if (options.json)
    std::printf("%s\n", param_json(param).dump(1).c_str());
  else
    std::printf("%s\n", param.text().c_str());
  return 0;
}

int params_set(Client& client, const Options&, const ParamsOptions& what) {
  const Param before = read_param(client, what.name);
  const std::uint32_t bits = parse_value(before, what.value);
  client.refuse_armed("changing its parameters");
  if (set_param(client, before, bits)) {
    const std::string after = client.params().at(before.name).text();
    std::printf("%s\n", fcu_messages::param_set(before.name, before.text(), after).text.c_str());
    if (!what.write) std::printf("%s", unsaved);
  } else {
    std::printf("%s is %s already: nothing was sent.\n", before.name.c_str(), before.text().c_str());
  }
  if (what.write) write_flash(client);
  return 0;
}

int params_write(Client& client, const Options&) {
  write_flash(client);
  return 0;
}

int params_save(Client& client, const Options&, const ParamsOptions& what) {
  const std::vector<Param> list = all(client);
  write_param_file(what.file, param_file_text(list, client.version()), what.replace);
  std::printf("%s: %s.\n", what.file.c_str(), counted(list.size(), "parameter").c_str());
  return 0;
}

int params_diff(Client& client, const Options& options, const ParamsOptions& what) {
  const std::vector<FileParam> file = read_param_file(what.file);
  const std::vector<Change> list = changes(file, all(client));
  if (options.json) {
    nlohmann::json out = nlohmann::json::array();
    for (const Change& c : list)
      out.push_back({{"name", c.now.name}, {"controller", c.now.text()}, {"file", c.wanted()}});
    std::printf("%s\n", out.dump(1).c_str());
  } else if (list.empty()) {
    std::printf("No difference: the controller has all %s of %s.\n",
                counted(file.size(), "parameter").c_str(), what.file.c_str());
  } else {
    std::printf("%s", changes_text(list).c_str());
  }
  return list.empty() ? 0 : 1;
}

int params_load(Client& client, const Options& options, const ParamsOptions& what) {
  const std::vector<FileParam> file = read_param_file(what.file);
  const std::vector<Change> todo = changes(file, all(client));
  if (todo.empty()) {
    std::printf("Nothing to do: the controller has all %s of %s.\n",
                counted(file.size(), "parameter").c_str(), what.file.c_str());
    if (what.write) write_flash(client);
    return 0;
  }
  std::printf("%s", changes_text(todo).c_str());
  client.refuse_armed("changing its parameters");
  if (!confirmed("Change " + counted(todo.size(), "parameter") + " of the controller?", options.yes, "--yes"))
    return 1;
  const std::vector<Change> left = load_params(client, file, todo, [](std::size_t done, std::size_t n) {
    show_progress(std::to_string(done) + " of " + std::to_string(n) + " set");
  });
  show_progress("");
  if (!left.empty()) {
    std::printf("Still different:\n%s", changes_text(left).c_str());
    throw Error(fcu_messages::parameters_not_taken(counted(left.size(), "parameter"), todo.size(),
                                                   left.front().now.name));
  }
  std::printf("Set and read back: %s.\n", counted(todo.size(), "parameter").c_str());
  if (what.write)
    write_flash(client);
  else
    std::printf(
        "They are in the controller's memory and gone after a power cycle: 'fulmar fcu params write' keeps "
        "them.\n");
  return 0;
}

}  // namespace fulmar::fcu
