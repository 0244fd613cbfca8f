// SPDX-License-Identifier: BSD-3-Clause
#include "tools/fulmar_replay/survey.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "tools/fulmar_replay/messages.hpp"

namespace fulmar::core {
namespace {

constexpr std::size_t max_reported_bytes = 32u << 20;  // two million late results

}  // namespace

struct Survey::Reading {
  Survey& to;
  McapStream stream;
  std::optional<HostTopic<Ticks>> ticks{};
  std::optional<HostTopic<Event>> events{};
  std::optional<HostTopic<CommandNote>> parameters{};
  std::map<std::uint16_t, std::uint32_t> expected{};  // sequence of the next message, by channel
  std::uint64_t latest_ns = 0;
  std::size_t reported_bytes = 0;
  bool in_order = true;
  std::optional<CommandNote> set{};  // the last set parameter
  std::uint64_t set_at = 0;

  void run() {
    while (const McapFile::Message* const m = stream.next()) {
      follow(*m);
      open(stream.log().channels.at(m->channel).topic);
      if (ticks && ticks->holds(*m) && to.ticks.fault.empty()) take_ticks(*m);
      if (events && events->holds(*m) && to.event_fault.empty()) take_event(*m);
      if (parameters && parameters->holds(*m)) take_parameter(*m);
      ++to.messages;
    }
    to.log = stream.take_log();
    conclude();
  }

  void follow(const McapFile::Message& m) {
    std::uint32_t& next = expected[m.channel];
    if (m.sequence != next) to.lost[m.channel] += m.sequence - next;
    next = m.sequence + 1;
    if (m.log_ns < latest_ns) to.late.insert(m.channel);
    latest_ns = std::max(latest_ns, m.log_ns);
  }

  /// A table is in the log before the first message that it describes.
  void open(const std::string& topic) {
    if (!ticks && topic == Ticks::topic) ticks.emplace(stream.log());
    if (!events && topic == Event::topic) events.emplace(stream.log());
    if (!parameters && topic == CommandNote::parameter_topic)
      parameters.emplace(stream.log(), CommandNote::parameter_topic);
  }

  void conclude() try {
    if (!to.ticks.fault.empty()) return;
    const HostTopic<Ticks> topic(to.log);
    if (!topic.there()) throw Error(replay_messages::ticks_missing());
    topic.check();
    if (to.ticks.count == 0) throw Error(replay_messages::ticks_empty());
    if (!in_order) throw Error(replay_messages::ticks_not_in_order());
  } catch (const Error& fault) {
    to.ticks.fault = fault.what();
  }

  void take_ticks(const McapFile::Message& m) try {
    const Ticks now = ticks->read(m.data);
    if (now.first != to.ticks.count || now.periods != now.hashes)
      throw Error(to.ticks.count == 0 ? replay_messages::first_tick_missing(now.first)
                                      : replay_messages::ticks_lost(
                                            to.ticks.count, std::max(now.first, to.ticks.count + 1) - 1,
                                            Fixed{1e-9 * static_cast<double>(to.ticks.last_ns), 3}));
    each_tick(now, [&](std::uint32_t, std::int64_t time_ns) {
      if (to.ticks.count == 0) to.ticks.first_ns = time_ns;
      in_order = in_order && (to.ticks.count == 0 || time_ns > to.ticks.last_ns);
      to.ticks.last_ns = time_ns;
      ++to.ticks.count;
    });
  } catch (const Error& fault) {
    to.ticks.fault = fault.what();
  }

  void take_event(const McapFile::Message& m) try {
    const Event e = events->read(m.data);
    if (e.code == Code::phase_entered) to.begun_at = std::min(to.begun_at, to.messages);
    if (e.code == Code::resumed || e.code == Code::not_resumed) take_resume(e);
    note(e, m.log_ns);
  } catch (const Error& fault) {
    to.event_fault = fault.what();
  }

  /// Facts that only the host's events show: wall-clock time-outs, signals, failed devices, and an end that
  /// was requested.
  void note(const Event& e, std::uint64_t log_ns) {
    switch (e.code) {
      case Code::vehicle_failed:
        to.vehicle_failed_ns = log_ns;
        to.last_words = e.cause.data();
        break;
      case Code::duration_reached: to.ended_ns = log_ns; break;
      case Code::concluded:
        if (e.name[0] != '\0') to.conclusion = e;
        break;
      case Code::signal_refused:
      case Code::gave_up:
        if (e.component[0] == '\0') {
          to.signals.push_back(log_ns);
          count(sizeof log_ns);
        }
        break;
      case Code::guard:
      case Code::hung:
      case Code::died:
      case Code::over_budget:
      case Code::late_result: note_reported(e, log_ns); break;
      default: break;
    }
  }

  void note_reported(const Event& e, std::uint64_t log_ns) {
    const std::string name = e.component.data(), call = e.name.data(), cause = e.cause.data();
    if (!to.reported.contains(name)) count(sizeof(Reported) + name.size());
    Reported& of_it = to.reported[name];
    count(2 * sizeof log_ns);
    if (e.code == Code::over_budget) {
      of_it.over_budget.push_back(log_ns);
    } else if (e.code == Code::late_result) {
      of_it.late.emplace_back(e.value_ns, log_ns);
    } else if (e.code == Code::guard) {
      count(sizeof cause + cause.size());
      of_it.guards.emplace_back(log_ns, cause);
    } else {
      count(sizeof(Reported::Death) + call.size() + cause.size());
      of_it.deaths.push_back({log_ns, call, cause, e.code == Code::hung});
    }
  }

  void count(std::size_t bytes) {
    if ((reported_bytes += bytes) > max_reported_bytes)
      throw Error(replay_messages::too_many_events(max_reported_bytes >> 20));
  }

  void take_parameter(const McapFile::Message& m) try {
    set = parameters->read(m.data);
    set_at = to.messages;
  } catch (const Error&) {  // reported when the plugin enters the replay
  }

  /// Each parameter was set just before its event.
  void take_resume(const Event& e) {
    if (e.component[0] == '\0') {
      to.resumed.emplace();
      to.resumed->phase = e.name.data();
      to.resumed->begun = to.begun_at < to.messages;
      return;
    }
    if (e.code == Code::not_resumed || !to.resumed || !set) return;  // of a parameter that was not set
    const bool same = std::string_view(set->component.data()) == e.component.data() &&
                      std::string_view(set->name.data()) == e.name.data();
    if (!same) return;
    count(sizeof *set);
    to.resumed->params.push_back(*set);
    to.resumed->places.insert(set_at);
    set.reset();
  }
};

Survey::Survey(const std::filesystem::path& file) { Reading{*this, McapStream(file)}.run(); }

}  // namespace fulmar::core
