// SPDX-License-Identifier: BSD-3-Clause
// The hourglass, whose host ends after a minute and starts again in the air: it resumes, and does not start
// from the beginning.
#include "core/run/state/resume.hpp"

#include <doctest/doctest.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "core/log/test/read_mcap.hpp"
#include "core/run/flight.hpp"
#include "sdk/test/said.hpp"

using namespace fulmar::core;
namespace fs = std::filesystem;

namespace {

const std::string hourglass = FULMAR_SOURCE_DIR "/configs/missions/hourglass.yaml";

struct Folder {
  fs::path path = fs::temp_directory_path() / ("fulmar-resume-test-" + std::to_string(getpid()));
  Folder() { fs::create_directories(path); }
  ~Folder() { fs::remove_all(path); }
};

/// A mission beside the hourglass that extends it with this `record:`.
fs::path recorded_hourglass(const fs::path& folder, const std::string& record) {
  std::ifstream in(hourglass);
  std::ofstream out(folder / "turn.yaml");
  for (std::string line; std::getline(in, line);) {
    for (const std::string word : {"common.yaml", "../"})
      if (const auto at = line.find(word); at != std::string::npos)
        line.insert(at, FULMAR_SOURCE_DIR "/configs/missions/");
    out << line << "\n";
  }
  out << "record: " << record << "\n";
  return folder / "turn.yaml";
}

/// Time of the last message of a topic: the log holds it at a lower rate.
std::uint64_t last_reported_ns(const WholeLog& log, const std::string& topic) {
  const std::uint16_t channel = log.channel(topic);
  const auto last = std::find_if(log.messages.rbegin(), log.messages.rend(),
                                 [&](const McapFile::Message& m) { return m.channel == channel; });
  REQUIRE(last != log.messages.rend());
  return last->log_ns;
}

double field(const Graph& graph, const Flight& flight, const std::string& component, const std::string& port,
             const std::string& name) {
  const auto at = std::find_if(graph.components.begin(), graph.components.end(),
                               [&](const Component& c) { return c.name == component; });
  REQUIRE(at != graph.components.end());
  const int output = at->info().output(port);
  const FieldRef ref = resolve_field(*at->info().outputs[static_cast<std::size_t>(output)].type, name);
  const std::byte* message =
      flight.sample({Source::Kind::component, static_cast<int>(at - graph.components.begin()), output});
  return message ? number_at(*ref.field, message + ref.offset) : -1;
}

fulmar::test::Said shell(const std::string& command) { return fulmar::test::shell(command + " 2>&1"); }

}  // namespace

TEST_CASE("a host that starts again in the air resumes in the same phase with the same waypoint") {
  const Folder folder;
  FlightOptions first;
  first.log_file = folder.path / "first.mcap";
  first.duration_s = 90;
  const Graph before = load_mission(hourglass);
  Flight gone(before, first);
  CHECK(gone.run().outcome == Outcome::flown);
  const double item = field(before, gone, "manage", "progress", "item");
  CHECK(item == 1);
  const auto text = [&](const char* name) {
    return std::to_string(field(before, gone, "sim", "truth", name));
  };
  Overrides in_the_air;
  in_the_air.set = {{"sim.start_height", text("height_m")},
                    {"sim.start_north", text("position_m.north")},
                    {"sim.start_east", text("position_m.east")},
                    {"sim.start_heading", text("yaw_rad")}};
  const Graph after = load_mission(hourglass, in_the_air);
  for (const bool resumes : {true, false}) {
    FlightOptions o;
    o.log = false;
    if (resumes) o.resume = read_resume(after, first.log_file);
    Flight flight(after, o);
    std::vector<double> items;
    while (flight.now_ns() < 60'000'000'000 && flight.step())
      if (const double now = field(after, flight, "manage", "progress", "item");
          now >= 0 && (items.empty() || items.back() != now))
        items.push_back(now);
    const FlightResult r = flight.finish();
    CHECK(r.guards.empty());
    CHECK(r.phases.front().name == (resumes ? "cruise" : "hold"));
    REQUIRE(items.size() >= 2);
    CHECK(items[0] == (resumes ? item : 0));
    CHECK(items[1] == (resumes ? item + 1 : 1));
  }
}

TEST_CASE("state that only a vehicle of another io has is resumed with that io alone") {
  Overrides hardware;
  hardware.io = "fcu";
  const auto rules = [](const Graph& graph) {
    std::string all;
    for (const ResumeRule& rule : graph.resume) all += rule.param + " <- " + rule.field.text + "\n";
    return all;
  };
  CHECK(rules(load_mission(hourglass)) == "manage.first_item <- manage.progress.item\n");
  CHECK(rules(load_mission(hourglass, hardware)) ==
        "manage.first_item <- manage.progress.item\nfcu.pitot_zeroed <- fcu.link.pitot_zeroed\n");
}

TEST_CASE("a flight resumes from a log, complete or truncated, with the phase and waypoint of that time") {
  const Folder folder;
  const Graph graph = load_mission(
      recorded_hourglass(folder.path, "{file: " + (folder.path / "a.mcap").string() + "}").string());
  FlightOptions o;
  o.log_file = graph.record_file;
  o.duration_s = 110;
  Flight flight(graph, o);
  struct Then {
    std::int64_t now_ns;
    std::string phase;
    double item;
  };
  std::vector<Then> flown;
  for (bool goes_on = true; goes_on;) {
    goes_on = flight.step();
    flown.push_back({flight.now_ns(), flight.phase(), field(graph, flight, "manage", "progress", "item")});
  }
  flight.finish();
  for (const double left : {1.0, 0.8, 0.6, 0.4, 0.2}) {
    const fs::path cut = folder.path / "cut.mcap.part";
    fs::copy_file(graph.record_file, cut, fs::copy_options::overwrite_existing);
    fs::resize_file(cut, static_cast<std::uintmax_t>(left * static_cast<double>(fs::file_size(cut))));
    const WholeLog log = read_mcap(cut);
    const auto at = [&](std::uint64_t log_ns) {  // state of the flight at that time
      const std::int64_t now_ns = static_cast<std::int64_t>(log_ns) - graph.epoch_ns;
      const auto found =
          std::find_if(flown.begin(), flown.end(), [&](const Then& t) { return t.now_ns >= now_ns; });
      REQUIRE(found != flown.end());
      return found;
    };
    const auto then = at(log.messages.back().log_ns),
               reported = at(last_reported_ns(log, "/manage/progress"));
    const Resume resume = read_resume(graph, cut);
    CHECK(resume.phase == then->phase);
    CHECK(resume.missing.empty());
    REQUIRE(resume.params.size() == 1);
    CHECK(resume.params[0].value.number[0] == reported->item);
  }
  CHECK(flown.front().item != flown.back().item);

  // The newest log with content: one that had only begun does not count.
  fs::remove(folder.path / "cut.mcap.part");
  std::ofstream(folder.path / "a-2.mcap.part") << "";
  fs::copy_file(folder.path / "a.mcap", folder.path / "a-3.mcap.part");
  fs::resize_file(folder.path / "a-3.mcap.part", 40);
  CHECK(newest_log(graph, 0) == folder.path / "a.mcap");
}

TEST_CASE(
    "--resume takes the log that it is given, or the newest of the mission; what it cannot use it says") {
  const Folder folder;
  const std::string here = "cd " + folder.path.string() + " && ",
                    run = FULMAR_BIN_DIR "/fulmar run " + hourglass;
  const auto none = shell(here + run + " --no-log --resume");
  CHECK(none.code == 4);
  CHECK(none.out == "app.resume_log_missing(hourglass)\n");
  CHECK(shell(here + run + " --duration 20").code == 0);
  for (const std::string log : {"", " logs/hourglass-*.mcap"}) {
    const auto [code, out] = shell(here + run + " --no-log --duration 1 --resume" + log);
    CHECK(code == 0);
    CHECK(out.find("resumes from logs/hourglass-") != std::string::npos);
    CHECK(out.find("   -5.00 s  run.resumed(phase cruise, manage.first_item = 0)\n") != std::string::npos);
    CHECK(out.find("   -5.00 s  run.phase_entered(cruise)\n") != std::string::npos);
    CHECK(out.find("run.phase_entered(takeoff)") == std::string::npos);
  }
  const auto plain =
      shell(here + run + " --no-log --duration 1");  // a simulation starts from the beginning by default
  CHECK(plain.out.find("resume") == std::string::npos);
  const auto other = shell(here + run + " --no-log --resume " + hourglass);
  CHECK(other.code == 4);
  CHECK(other.out == "log.log_format_invalid(" + hourglass + ")\n");
}
