// SPDX-License-Identifier: BSD-3-Clause
// Texts of events have no effect: a log with another text in each event is replayed and resumed as before.
// The test also covers logs whose events have no codes yet.
#include <algorithm>
#include <atomic>
#include <functional>
#include <limits>
#include <map>

#include "core/log/events.hpp"
#include "core/log/mcap.hpp"
#include "core/run/state/resume.hpp"
#include "core/run/test/commands.hpp"
#include "core/types/wire.hpp"
#include "tools/fulmar_log/diff.hpp"
#include "tools/fulmar_log/export_log.hpp"
#include "tools/fulmar_log/info.hpp"
#include "tools/fulmar_replay/test/replays.hpp"

namespace translated_test {
namespace {

/// Replacement of an event: its table and a message of it.
using Change = std::function<std::vector<std::byte>(const Event&)>;

/// A copy of a log with other events.
void rewrite(const fs::path& from, const fs::path& to, const Type& event_type, const Change& change) {
  const WholeLog file = read_mcap(from);
  const HostTopic<Event> events(file);
  McapWriter writer({.file = to});
  for (const auto& a : file.attachments) writer.attach(a.name, a.media_type, a.content, a.log_ns);
  for (const auto& m : file.metadata) writer.metadata(m.name, m.pairs);
  std::map<std::uint16_t, std::uint16_t> channels;
  for (const auto& [id, channel] : file.channels) {
    const McapFile::Schema& schema = file.schemas.at(channel.schema);
    const std::string text = id == events.channel() ? ros_definition(event_type) : schema.text;
    channels[id] = writer.add_channel(writer.add_schema(schema.name, schema.encoding, text), channel.topic,
                                      channel.encoding, channel.metadata);
  }
  const CdrEncoder encoder(event_type);
  for (const auto& m : file.messages) {
    std::byte* const room = writer.begin_message(channels.at(m.channel), m.sequence, m.log_ns, m.publish_ns);
    if (events.holds(m)) {
      writer.end_message(encoder.encode(change(events.read(m.data)).data(), room));
    } else {
      std::copy(m.data.begin(), m.data.end(), room);
      writer.end_message(m.data.size());
    }
  }
  CHECK(writer.close().error.empty());
}

template <class Message>
std::vector<std::byte> bytes_of(const Message& message) {
  const auto* const first = reinterpret_cast<const std::byte*>(&message);
  return {first, first + sizeof message};
}

/// Sentences by which logs were once read: none of them may mean anything.
constexpr const char* misleading[] = {"phase nowhere",
                                      "resumed: phase two, one.u = 0.9, two.u = 0.8",
                                      "not resumed: the aircraft is not in the air, armed",
                                      "hung: no answer within 5 ms",
                                      "was over its time budget in 5 steps in a row",
                                      "took late a result that was due at 100000000 ns",
                                      "the aircraft is armed: Ctrl-C once more within 5 s gives up control",
                                      "control given up by a signal: the aircraft is its pilot's",
                                      "duration reached; flies on until disarmed",
                                      "failsafe: one: says that it failed; flies on until disarmed",
                                      "",
                                      "ÜBERSETZT, mit Kommas, ohne Sinn"};

/// A copy in which the text of every event is `word` of it.
fs::path translated(const fs::path& log, const std::string& name,
                    const std::function<std::string(std::size_t)>& word) {
  const fs::path to = fresh(name);
  std::size_t n = 0;
  rewrite(log, to, *host_type<Event>(), [&](const Event& e) {
    Event other = e;
    put(other.words, word(n++));
    return bytes_of(other);
  });
  return to;
}

std::size_t count(const fs::path& log, Code code) {
  const WholeLog file = read_mcap(log);
  const HostTopic<Event> events(file);
  return static_cast<std::size_t>(std::count_if(
      file.messages.begin(), file.messages.end(),
      [&](const McapFile::Message& m) { return events.holds(m) && events.read(m.data).code == code; }));
}

/// The flight is independent of the texts of events, to the byte of the replay's log.
void check_words_mean_nothing(const fs::path& log) {
  const fs::path again = fresh("again.mcap");
  CHECK(replay_of(log, {}, again).equal());
  REQUIRE(contents(again) == contents(log));
  const std::vector<std::function<std::string(std::size_t)>> words = {
      [](std::size_t) { return std::string(); },
      [](std::size_t n) { return std::string(misleading[n % std::size(misleading)]); },
      [](std::size_t n) { return std::string(misleading[(n * 5 + 3) % std::size(misleading)]); },
      [](std::size_t) { return std::string(511, 'w'); }};
  for (const auto& word : words) {
    const fs::path other = translated(log, "other.mcap", word), out = fresh("other-again.mcap");
    const ReplayResult r = replay_of(other, {}, out);
    CHECK(r.notes == std::vector<std::string>{});
    CHECK(contents(out) == contents(again));
    const LogDiff d = diff_logs(log, other);
    for (const auto& t : d.topics)
      CHECK_MESSAGE((t.first == Event::topic) == (t.second.different > 0), t.first);
  }
}

Graph craft(const std::string& tail, const std::vector<std::pair<std::string, std::string>>& set) {
  const fs::path file = folder().path / "craft.yaml";
  std::ofstream(file)
      << "mission: craft\nrate: 400 Hz\nio: fcu\nfailsafe: {u_frac: -0.25, for: 0.5 s}\nroles:\n"
         "  vehicle: {in: {command: law.command}, out: {status: State, applied: Received}}\n"
         "  law:     {in: {state: vehicle.status}, out: {command: Command}}\ncomponents:\n"
         "  craft: {fills: vehicle, use: craft/Craft}\n  law_a: {fills: law, use: craft/Hoarder, run: tick}\n"
      << tail;
  Overrides o;
  o.set = set;
  return load_mission(file.string(), o);
}

bool fly_until(Flight& flight, double t_s) {
  while (static_cast<double>(flight.now_ns()) < t_s * 1e9 - 1)
    if (!flight.step()) return false;
  return true;
}

const std::string two_phases =
    "resume: {law_a.heirloom: law.command.u_frac}\nphases:\n"
    "  first: {next: [{to: second, when: \"vehicle.status.tick_s > 0.2 s\"}]}\n"
    "  second: {next: [{to: first, when: \"vehicle.status.tick_s > 1000 s\"}]}\n";

}  // namespace

TEST_CASE("words mean nothing: a guard, its fallback, a request, its refusal, a parameter, a reset") {
  const fs::path log = fresh("asked.mcap");
  Flight flight(mission(with_fallback, {{"one.fault", "nan"}, {"one.fault_at", "0.2"}}), logged(log, 0.6));
  ParamValue v;
  v.number[0] = 0.25;
  const double go = 1, back = -1;
  for (int n = 0; flight.step(); ++n) {
    if (n == 420) set_parameter(flight, "two", "u", v);
    if (n == 500) request(flight, "watch", "ask", go);
    if (n == 510) request(flight, "watch", "ask", back);
    if (n == 560) reset_guards(flight);
  }
  flight.finish();
  CHECK(count(log, Code::guard) == 1);
  CHECK(count(log, Code::took_over) == 1);
  CHECK(count(log, Code::request_taken) == 2);
  CHECK(count(log, Code::request_refused) == 1);
  CHECK(count(log, Code::parameter_set) == 1);
  CHECK(count(log, Code::guard_reset) == 1);
  check_words_mean_nothing(log);
}

TEST_CASE("words mean nothing: a vehicle that fails, and a driver") {
  const fs::path log = fresh("failed.mcap");
  Flight(mission(one_phase, {{"sim.fail_at", "0.2"}}), logged(log, 1)).run();
  CHECK(count(log, Code::vehicle_failed) == 1);
  check_words_mean_nothing(log);
  const fs::path driven = fresh("driven.mcap");
  Flight flight(mission("  watch: {use: lab/Watch, run: tick, in: {burst: gauge.reading}}\n"
                        "  gauge: {use: lab/Ticker, run: driver, params: {samples: 3, fails: true}}\n"s +
                        one_phase),
                logged(driven, 0.3, 4));
  flight.run();
  CHECK(count(driven, Code::guard) == 1);
  check_words_mean_nothing(driven);
}

TEST_CASE("words mean nothing: what the wall clock did") {
  const fs::path slow = fresh("slow.mcap"), hung = fresh("hung.mcap");
  const auto lab = [](const std::string& how, const char* fault) {
    return mission("  one: {fills: law, use: lab/Law, " + how + "params: {id: 1, u: 0.1}}\n" + with_fallback,
                   {{"one.fault", fault}, {"one.fault_at", "0.1"}});
  };
  Flight(lab("budget: 500 us, ", "slow"), logged(slow, 0.3, 4)).run();
  CHECK(count(slow, Code::over_budget) == 1);
  check_words_mean_nothing(slow);
  Flight(lab("run: process, hang: 200 ms, ", "hangs"), logged(hung, 0.3, 4)).run();
  CHECK(count(hung, Code::hung) == 1);
  check_words_mean_nothing(hung);
}

TEST_CASE(
    "words mean nothing: an armed aircraft whose owner, and then a signal, wants the end; a flight that goes "
    "on where another ended") {
  const std::vector<std::pair<std::string, std::string>> armed = {{"craft.arm_at", "0"}};
  const fs::path first = fresh("first.mcap"), second = fresh("second.mcap");
  std::atomic<int> interrupt{0};
  FlightOptions o = logged(first, 1);
  o.interrupt = &interrupt;
  Flight flight(craft(two_phases, armed), o);
  CHECK(fly_until(flight, 1.2));
  for (const double again_s : {1.3, 1.4}) {
    interrupt = 2;
    CHECK(fly_until(flight, again_s));
  }
  fly_until(flight, 4);
  flight.finish();
  CHECK(count(first, Code::duration_reached) == 1);
  CHECK(count(first, Code::signal_refused) == 1);
  CHECK(count(first, Code::gave_up) == 1);
  check_words_mean_nothing(first);

  const Graph graph = craft(two_phases, armed);
  for (const char* words : {"", "phase first", "phase third"}) {
    const Resume resume =
        read_resume(graph, translated(first, "told.mcap", [&](std::size_t) { return std::string(words); }));
    CHECK(resume.text() == read_resume(graph, first).text());
    CHECK(resume.phase == "second");
  }
  for (const bool if_armed : {false, true}) {
    FlightOptions next = logged(fresh("second.mcap"), 1);
    next.resume = read_resume(graph, first);
    next.resume->if_armed = if_armed;
    Flight goes_on(graph, next);
    fly_until(goes_on, 0.5);
    goes_on.finish();
    CHECK(count(second, Code::resumed) == 2);  // the phase and one parameter
    check_words_mean_nothing(second);
  }
  FlightOptions third = logged(fresh("second.mcap"), 2);
  third.resume = read_resume(graph, first);
  third.resume->if_armed = true;
  Flight on_ground(craft(two_phases, {{"craft.arm_at", "5"}}), third);
  fly_until(on_ground, 1.5);
  on_ground.finish();
  CHECK(count(second, Code::not_resumed) == 1);
  check_words_mean_nothing(second);
}

TEST_CASE("a name as long as the log has room for is found again: a guard, a late result") {
  const std::string name(47, 'n');
  const fs::path log = fresh("long-name.mcap");
  Flight(mission("  " + name +
                     ": {fills: law, use: lab/Law, budget: 500 us, params: {id: 1, u: 0.1}}\nphases:\n  fly: "
                     "{law: {use: " +
                     name + ", fallback: two}}\n",
                 {{name + ".fault", "slow"}, {name + ".fault_at", "0.1"}}),
         logged(log, 0.3, 4))
      .run();
  CHECK(count(log, Code::over_budget) == 1);
  check_words_mean_nothing(log);
  const std::string too_long = "graph.name_too_long(n" + name + ", 48, 47)";
  const std::string law = "  n" + name + ": {fills: law, use: lab/Law}\n";
  CHECK_THROWS_WITH_AS(mission(law + one_phase), doctest::Contains(too_long.c_str()), Error);
}

TEST_CASE(
    "a flight resumes with more parameters than a line has room for, and is replayed with all of them") {
  constexpr int laws = 30;
  std::string tail, rules, phases;
  for (int i = 0; i < laws; ++i) {
    const std::string n = std::to_string(i), name = "law_with_a_long_name_" + n;
    tail += "  " + name + ": {fills: law, use: craft/Hoarder, run: tick}\n";
    rules += (i > 0 ? ", " : "") + name + ".heirloom: law.command.u_frac";
    phases +=
        "  p" + n + ": {law: " + name +
        (i + 1 < laws ? ", next: [{to: p" + std::to_string(i + 1) + ", when: \"vehicle.status.tick_s > " +
                            (i == 0 ? "0.2" : "1000") + " s\"}]}\n"
                      : "}\n");
  }
  const Graph graph = craft(tail + "resume: {" + rules + "}\nphases:\n" + phases, {{"craft.arm_at", "0"}});
  const fs::path first = fresh("many.mcap"), second = fresh("many-2.mcap");
  Flight gone(graph, logged(first, 100));
  fly_until(gone, 0.5);
  gone.finish();
  FlightOptions o = logged(second, 100);
  o.resume = read_resume(graph, first);
  REQUIRE(o.resume->params.size() == laws);
  CHECK(o.resume->phase == "p1");
  CHECK(o.resume->text().size() > 512);
  Flight flight(graph, o);
  fly_until(flight, 0.5);
  flight.finish();
  CHECK(count(second, Code::resumed) == laws + 1);
  CHECK(count(second, Code::parameter_set) == 0);
  check_words_mean_nothing(second);
}

TEST_CASE("every live parameter comes again as it was taken: a number, a word, a phase, a swap") {
  const fs::path log = fresh("values.mcap");
  Flight flight(mission("phases:\n  a: {law: one, next: [{to: b, when: \"vehicle.signal.tick_s > 1000 "
                        "s\"}]}\n  b: {law: two}\n"),
                logged(log, 0.5));
  ParamValue exact, word;
  exact.number[0] = 0.1 + 0.2;  // no short decimal
  word.integer = 1;
  for (int n = 0; flight.step(); ++n) {
    if (n == 50) swap(flight, "two", std::string(FULMAR_TEST_PLUGIN_DIR) + "/lab_better.so");
    if (n == 410) set_parameter(flight, "one", "u", exact);
    if (n == 420) set_parameter(flight, "one", "fault", word);
    if (n == 430) enter_phase(flight, "b");
  }
  flight.finish();
  const WholeLog file = read_mcap(log);
  const HostTopic<CommandNote> commands(file), parameters(file, CommandNote::parameter_topic);
  std::vector<CommandNote> notes;
  for (const auto& m : file.messages)
    if (commands.holds(m) || parameters.holds(m)) notes.push_back(commands.read(m.data));
  REQUIRE(notes.size() == 4);
  CHECK(std::string(notes[0].text.data()) == "lab_better.so");
  CHECK(std::string(notes[0].version.data()) == "1.0.0");
  CHECK(std::string(notes[0].sha256.data()).size() == 64);
  CHECK(notes[1].number[0] == 0.1 + 0.2);
  CHECK(std::string(notes[1].name.data()) == "u");
  CHECK(notes[2].integer == 1);
  CHECK(std::string(notes[3].name.data()) == "b");
  check_words_mean_nothing(log);
}

// ---- logs from before there were codes

namespace {

struct OldEvent {
  std::uint8_t kind = 0;
  std::array<char, 48> component{};
  std::array<char, 207> text{};
};

const std::vector<std::string> old_kinds = {"phase", "guard",  "request", "parameter", "failsafe",
                                            "swap",  "notice", "end",     "resume"};

Type old_event_type() {
  Type t;
  t.name = "Event";
  t.size = sizeof(OldEvent);
  const auto add = [&](const char* name, fulmar_kind kind, std::size_t offset, std::size_t stride) {
    Field f;
    f.name = name;
    f.kind = kind;
    f.offset = static_cast<std::uint32_t>(offset);
    f.stride = static_cast<std::uint32_t>(stride);
    t.fields.push_back(f);
  };
  add("kind", FULMAR_ENUM, 0, 1);
  t.fields.back().labels = old_kinds;
  add("component", FULMAR_TEXT, offsetof(OldEvent, component), sizeof(OldEvent::component));
  add("text", FULMAR_TEXT, offsetof(OldEvent, text), sizeof(OldEvent::text));
  return t;
}

fs::path old_log(const fs::path& log) {
  const fs::path to = fresh("old.mcap");
  rewrite(log, to, old_event_type(), [](const Event& e) {
    OldEvent old;
    old.kind = static_cast<std::uint8_t>(std::find(old_kinds.begin(), old_kinds.end(), kind_words(e.code)) -
                                         old_kinds.begin());
    old.component = e.component;
    put(old.text, e.code == Code::phase_entered ? "phase " + std::string(e.name.data()) : e.words.data());
    return bytes_of(old);
  });
  return to;
}

}  // namespace

TEST_CASE(
    "a log whose events have no codes is read, exported and compared; to replay or resume from it is refused "
    "in a sentence") {
  const fs::path log = fresh("new.mcap");
  Flight(mission(with_fallback, {{"one.fault", "nan"}, {"one.fault_at", "0.2"}}), logged(log, 0.6)).run();
  const fs::path old = old_log(log);
  const LogInfo was = read_info(old), is = read_info(log);
  REQUIRE(was.events.size() == is.events.size());
  REQUIRE(is.events.size() >= 3);
  for (std::size_t i = 0; i < is.events.size(); ++i) {
    CHECK(was.events[i].time_ns == is.events[i].time_ns);
    CHECK(was.events[i].kind == is.events[i].kind);
    CHECK(was.events[i].component == is.events[i].component);
    CHECK(was.events[i].text == (is.events[i].kind == "phase" ? "phase fly" : is.events[i].text));
  }
  REQUIRE(was.phases.size() == 1);
  CHECK(was.phases[0].name == "fly");
  CHECK(is.phases[0].name == "fly");
  CHECK(is.phases[0].end_ns == was.phases[0].end_ns);

  const fs::path tables = folder().path / "old-tables";
  export_log(old, ExportForm::csv, tables, {});
  CHECK(contents(tables / "fulmar.event.csv").find("one") != std::string::npos);

  const LogDiff d = diff_logs(old, log);
  for (const auto& t : d.topics)
    CHECK_MESSAGE((t.first == Event::topic) == (t.second.different > 0), t.first);
  REQUIRE(d.first.has_value());
  CHECK(d.first->topic == Event::topic);
  CHECK(!d.first_tick.has_value());

  const std::string why = "log.host_fields_differ(/fulmar/event, Event)";
  CHECK_THROWS_WITH_AS(replay_of(old, {}, fresh("never.mcap")), doctest::Contains(why.c_str()), Error);
  const Recording recording(log);
  CHECK_THROWS_WITH_AS(read_resume(recording.mission({}, {}), old), doctest::Contains(why.c_str()), Error);
}

TEST_CASE("an event of any code, its fields empty or full, is read without fault wherever it stands") {
  const fs::path log = fresh("any.mcap"), odd = fresh("odd.mcap");
  Flight(mission(with_fallback, {{"one.fault", "nan"}, {"one.fault_at", "0.02"}}), logged(log, 0.05)).run();
  const Graph graph = Recording(log).mission({}, {});
  const std::size_t codes = host_type<Event>()->fields[0].labels.size();
  for (std::size_t code = 0; code < codes; ++code)
    for (const bool full : {false, true}) {
      CAPTURE(code);
      CAPTURE(full);
      fs::remove(odd);
      std::size_t n = 0;
      rewrite(log, odd, *host_type<Event>(), [&](const Event& e) {
        if (n++ % 3 == 0) return bytes_of(e);  // the phase, so that there is one
        Event other = event_of(static_cast<Code>(code));
        if (!full) return bytes_of(other);
        const std::string most(other.words.size() - 1, '\xff');
        put(other.component, most);
        put(other.name, most);
        put(other.cause, most);
        put(other.words, most);
        other.value_ns = std::numeric_limits<std::int64_t>::min();
        other.value = std::numeric_limits<double>::infinity();
        return bytes_of(other);
      });
      CHECK(read_info(odd).events.size() == n);
      try {
        CHECK(read_resume(graph, odd).phase == "fly");
      } catch (const Error& fault) {  // of a phase without a name, or with another
        CHECK(static_cast<Code>(code) == Code::phase_entered);
      }
      try {
        replay_of(odd, {}, fresh("odd-again.mcap"));
      } catch (const Error& fault) {
        CHECK_MESSAGE(static_cast<Code>(code) == Code::resumed, fault.what());
      }
    }
}

TEST_CASE("every code has a kind that people know, and bytes that are no code are an event all the same") {
  const fs::path log = fresh("new.mcap"), odd = fresh("odd.mcap");
  Flight(mission(one_phase), logged(log, 0.1)).run();
  for (std::size_t code = 0; code < host_type<Event>()->fields[0].labels.size(); ++code)
    CHECK(std::find(old_kinds.begin(), old_kinds.end(), kind_words(static_cast<Code>(code))) !=
          old_kinds.end());
  for (const int code : {200, 255}) {
    fs::remove(odd);
    rewrite(log, odd, *host_type<Event>(), [&](const Event& e) {
      Event other = e;
      other.code = static_cast<Code>(code);
      return bytes_of(other);
    });
    const LogInfo info = read_info(odd);
    CHECK(info.phases.empty());
    CHECK_THROWS_AS(read_resume(mission(one_phase), odd), Error);
  }
}

}  // namespace translated_test
