// SPDX-License-Identifier: BSD-3-Clause
#include "tools/fulmar_replay/replay_command.hpp"

#include <spdlog/fmt/fmt.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "core/app/compare.hpp"
#include "core/app/mission_options.hpp"
#include "core/app/report.hpp"
#include "core/log/out_file.hpp"
#include "core/say.hpp"
#include "tools/fulmar_replay/estimates.hpp"
#include "tools/fulmar_replay/messages.hpp"
#include "tools/fulmar_replay/replay.hpp"
#include "tools/log_reading/log_file.hpp"

namespace fulmar::core {
namespace {

using nlohmann::json;

std::atomic<bool> stop{false};
void stop_replay(int) { stop.store(true); }

double flight_seconds(std::int64_t ns) { return 1e-9 * static_cast<double>(ns); }

/// A replay and its figures.
struct Replayed {
  Graph graph;
  ReplayResult result;
  json figures;
};

using Look = std::function<void(const std::filesystem::path& log)>;

/// `compare` false: only for its log, which holds more than the original one.
Replayed fly(const Recording& recording, const Overrides& changes, const std::string& out,
             bool compare = true, const Look& look = {}) {
  const auto say = [](const std::string& text, bool warning) {
    say_aloud(text, warning ? Tone::warning : Tone::info);
  };
  Replayed r;
  r.graph = recording.mission(changes, say);
  ReplayOptions options;
  options.out = out;
  options.changes = changes;
  options.compare = compare;
  options.look = look;
  options.stop = &stop;
  auto [flight, result] = replay(recording, r.graph, options);
  r.figures = result_json(r.graph, *flight, result.flight);
  if (out.empty()) r.figures["log"] = nullptr;
  r.result = std::move(result);
  return r;
}

json difference_json(const ReplayResult& r) {
  json j;
  j["first_tick"] = r.first_tick ? json{{"index", *r.first_tick}, {"time_s", flight_seconds(r.first_tick_ns)}}
                                 : json(nullptr);
  j["first_difference"] = nullptr;
  if (r.first)
    j["first_difference"] = {{"topic", r.first->topic},
                             {"field", r.first->field},
                             {"time_s", flight_seconds(r.first->at_ns)},
                             {"was", r.first->was},
                             {"is", r.first->is}};
  j["messages"] = r.messages;
  j["differing_messages"] = r.differing_messages;
  j["differing_bytes"] = r.differing_bytes;
  return j;
}

json result_of(const Recording& recording, const Replayed& again) {
  const ReplayResult& r = again.result;
  json j = difference_json(r);
  j["mission"] = again.graph.mission;
  j["log"] = recording.path().string();
  j["equal"] = r.equal();
  j["same_file"] = r.same_file;
  j["cut_off"] = r.cut_off;
  j["ticks"] = r.ticks;
  j["recorded_ticks"] = r.recorded_ticks;
  j["flight_time_s"] = flight_seconds(r.last_ns - r.first_ns);
  j["wall_time_s"] = r.flight.wall.took_s;
  j["notes"] = r.notes;
  j["not_reproducible"] = {"wall_time_s"};
  return j;
}

void add_difference(std::string& out, const ReplayResult& r) {
  if (r.ticks != r.recorded_ticks)
    out += fmt::format("the replay has {} ticks, the log {}\n", r.ticks, r.recorded_ticks);
  if (r.first_tick)
    out += fmt::format("the first tick with other outputs is {}, at {:.4f} s\n", *r.first_tick,
                       flight_seconds(r.first_tick_ns));
  if (r.first)
    out += fmt::format("the first difference in the log: {} at {:.4f} s{}{}: {}, now {}\n", r.first->topic,
                       flight_seconds(r.first->at_ns), r.first->field.empty() ? "" : ", ", r.first->field,
                       r.first->was, r.first->is);
  out += fmt::format("{} of {} messages differ, {} bytes\n", r.differing_messages, r.messages,
                     r.differing_bytes);
}

void print(const Replayed& again) {
  std::string out;
  const ReplayResult& r = again.result;
  const double flown_s = flight_seconds(r.last_ns - r.first_ns);
  out += fmt::format("{}: {} ticks, {:.1f} s of flight in {:.2f} s: {:.0f} times real time\n",
                     again.graph.mission, r.ticks, flown_s, r.flight.wall.took_s,
                     r.flight.wall.took_s > 0 ? flown_s / r.flight.wall.took_s : 0);
  if (r.cut_off) out += replay_messages::log_cut_off(Fixed{flight_seconds(r.last_ns), 4}).text + "\n";
  for (const std::string& note : r.notes) out += note + "\n";
  if (r.equal())
    out += fmt::format("equal: {} messages, 0 differing bytes{}\n", r.messages,
                       r.same_file ? "; both logs are the same file" : "");
  else
    add_difference(out, r);
  std::fputs(out.c_str(), stdout);
}

/// A change without effect is rejected: the samples of the vehicle and of drivers come from the log.
void refuse_idle(const Graph& graph, const Overrides& changes) {
  const auto check = [&](const std::string& words, const std::string& component) {
    for (std::size_t i = 0; i < graph.components.size(); ++i) {
      const Component& c = graph.components[i];
      const bool vehicle = static_cast<int>(i) == graph.vehicle;
      if (c.name == component && (vehicle || c.run == RunMode::driver))
        throw Error(
            replay_messages::change_without_effect(words, component, vehicle ? "the vehicle" : "a driver"));
    }
  };
  for (const auto& [name, value] : changes.set) check("--set " + name, name.substr(0, name.find('.')));
  for (const auto& [component, file] : changes.with) check("--with " + component, component);
}

/// Additional topics are only in the replay's log: there is no comparison.
void fly_for_log(const Recording& recording, const ReplayArguments& words) {
  if (words.changes.record.empty()) return;
  const Replayed more = fly(recording, words.changes, words.out, false);
  const LogResult& log = more.result.flight.log;
  if (!words.json)
    std::printf("log %s (%.1f MB, %llu messages)\n", words.out.c_str(), 1e-6 * static_cast<double>(log.bytes),
                static_cast<unsigned long long>(log.messages));
}

Overrides without_record(Overrides changes) {
  changes.record.clear();
  return changes;
}

/// Compares the log with that of the experiment.
int experiment(const Recording& recording, const ReplayArguments& words, json& out) {
  refuse_idle(recording.mission(words.changes, {}), words.changes);
  const Replayed was = fly(recording, {}, "");
  const bool more = !words.changes.record.empty();
  std::string estimates;
  const Replayed is = fly(recording, without_record(words.changes), more ? "" : words.out, true,
                          [&](const std::filesystem::path& log) {
                            estimates = compared_estimates(recording.path(), log, words.json, stop);
                          });
  out = result_of(recording, is);
  out["before"] = was.figures;
  out["after"] = is.figures;
  out["before_equals_log"] = was.result.equal();
  if (!was.result.equal()) warn(replay_messages::baseline_differs());
  if (words.json) {
    const json compared = json::parse(estimates, nullptr, false);
    out["estimates"] = compared.is_object() ? compared.at("estimates") : json(nullptr);
  } else {
    print(is);
    std::printf("%s", comparison(was.figures, is.figures).c_str());
    if (!estimates.empty()) std::printf("\n%s", estimates.c_str());
  }
  fly_for_log(recording, words);
  return 0;
}

int run(ReplayArguments words, json& out) {
  check_log_file(words.log);
  if (!words.out.empty()) OutFile::refuse(words.out);  // before the replay begins
  const Recording recording(words.log);
  words.changes = recording.by_component(words.changes);
  if (!words.changes.record.empty()) {
    if (words.out.empty()) throw Error(replay_messages::record_without_log());
    recording.mission(words.changes, {});  // checks that the ports exist, before the replay begins
  }
  if (!words.changes.with.empty() || !words.changes.set.empty()) return experiment(recording, words, out);
  const Replayed again = fly(recording, {}, words.changes.record.empty() ? words.out : "");
  out = result_of(recording, again);
  if (!words.json) print(again);
  fly_for_log(recording, words);
  return again.result.equal() ? 0 : 1;
}

int carry_out(const ReplayArguments& words) {
  struct sigaction action {};
  action.sa_handler = stop_replay;
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaction(signal, &action, nullptr);
  const int own = words.json ? dup(STDOUT_FILENO) : -1;  // output of components goes to standard error
  if (own >= 0) dup2(STDERR_FILENO, STDOUT_FILENO);
  json result;
  int code = 1;
  try {
    code = run(words, result);
  } catch (const Error&) {
    if (!stop) throw;
    warn("interrupted");
    return 130;
  }
  std::fflush(stdout);
  if (own < 0) return code;
  dup2(own, STDOUT_FILENO);
  close(own);
  std::printf("%s\n", result.dump(2, ' ', false, json::error_handler_t::replace).c_str());
  return code;
}

}  // namespace

ReplayCommand::ReplayCommand(CLI::App& app) {
  CLI::App* command =
      app.add_subcommand("replay", "replay a recorded flight through its mission and compare the outputs");
  command->add_option("LOG", words_.log, "log of a flight (MCAP)")->required();
  add_pairs(
      command, "--with", with_, "COMPONENT=FILE",
      "experiment: load COMPONENT, or the component of a role, from plugin FILE, as in nav=my_filter.so");
  add_pairs(command, "--set", set_, "COMP.PARAM=VALUE", "experiment: set a parameter");
  command
      ->add_option("--record", words_.changes.record,
                   "with --log: log additional PORTS, all or as in nav.*@100Hz")
      ->type_name("PORTS[@RATE]")
      ->allow_extra_args(false);
  command->add_option("--log", words_.out, "write the log of the replay to FILE; default: no log")
      ->type_name("FILE")
      ->check(a_file("none is written"));
  command->add_flag("--json", words_.json, "print one JSON object");
  command->footer("Example: fulmar replay flight.mcap --set attitude.roll_kp=0.6");
}

int ReplayCommand::run() {
  words_.changes.set = pairs(set_, "--set", "COMP.PARAM=VALUE");
  words_.changes.with = pairs(with_, "--with", "COMPONENT=FILE");
  return carry_out(words_);
}

}  // namespace fulmar::core
