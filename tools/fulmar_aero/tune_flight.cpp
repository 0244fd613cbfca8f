// SPDX-License-Identifier: BSD-3-Clause
#include "tools/fulmar_aero/tune_flight.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "core/error.hpp"
#include "core/loader/home.hpp"
#include "core/loader/process.hpp"
#include "core/types/text.hpp"
#include "tools/fulmar_aero/messages.hpp"
#include "tools/fulmar_aero/words.hpp"

namespace fulmar::aero {
namespace {

namespace fs = std::filesystem;

/// A temporary folder, deleted at the end.
struct FlightFolder {
  fs::path path;
  FlightFolder() {
    std::error_code fault;
    std::string name = (fs::temp_directory_path(fault) / "fulmar-tune-XXXXXX").string();
    if (fault) throw core::Error(aero_messages::flight_folder_missing(name, fault.message()));
    if (!::mkdtemp(name.data()))
      throw core::Error(aero_messages::flight_folder_missing(name, std::strerror(errno)));
    path = name;
  }
  ~FlightFolder() {
    std::error_code code;
    fs::remove_all(path, code);
  }
  FlightFolder(const FlightFolder&) = delete;
  FlightFolder& operator=(const FlightFolder&) = delete;
  void write(const char* name, const std::string& text) const { std::ofstream(path / name) << text; }
};

constexpr double shipped_speed_mps = 17;
/// True near 17 m/s, for which the shipped plan is made.
bool is_shipped_speed(double airspeed_mps) { return std::abs(airspeed_mps - shipped_speed_mps) <= 1.5; }
/// North and east, m, of the shipped plan.
constexpr std::array<std::array<double, 2>, 4> shipped_corners{
    {{400, -250}, {-400, -50}, {-400, -250}, {400, -50}}};

double plan_scale(double airspeed_mps) {
  return is_shipped_speed(airspeed_mps) ? 1 : std::pow(airspeed_mps / shipped_speed_mps, 2);
}

std::string plan_text(double airspeed_mps) {
  const double k = plan_scale(airspeed_mps);
  std::string text = "name: hourglass\nend: circuit\nairspeed: " + fixed(airspeed_mps, 3) +
                     " m/s\nturn_radius: " + fixed(50 * k, 3) + " m\nwaypoints:\n";
  for (const auto& [north, east] : shipped_corners)
    text += "  - {north: " + fixed(north * k, 1) + " m, east: " + fixed(east * k, 1) + " m, up: 70 m}\n";
  return text;
}

std::string contents(const fs::path& file) {
  std::ifstream in(file);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

std::vector<FlownFigure> figures_of(const nlohmann::json& o, const Airframe& a) {
  const auto number = [&](const char* port, const char* field) {
    const auto at = o.find(port);
    if (at == o.end() || !at->is_object() || !at->contains(field) || !(*at)[field].is_number())
      return std::nan("");
    return (*at)[field].get<double>();
  };
  const double off = std::hypot(number("tracking_rmse", "north_m"), number("tracking_rmse", "east_m"));
  return {{"position", "m", off, 5},
          {"height", "m", number("tracking_rmse", "altitude_m"), 1.5},
          {"airspeed", "m/s", number("tracking_rmse", "airspeed_mps"), 1},
          {"roll", "deg", number("tracking_rmse", "roll_deg"), 3},
          {"pitch", "deg", number("tracking_rmse", "pitch_deg"), 3},
          {"course", "deg", number("tracking_rmse", "course_deg"), 8},
          {"least airspeed", "m/s", number("mission_figures", "airspeed_min_mps"), a.limits.airspeed_min_mps,
           true}};
}

/// An aircraft on skids cannot roll to its take-off speed.
bool needs_launch(const Airframe& a) {
  const auto& contacts = a.gear.contacts;
  return !contacts.empty() && std::all_of(contacts.begin(), contacts.end(), [](const auto& contact) {
    return contact.kind == ContactKind::skid;
  });
}

}  // namespace

std::string stall_of(const FlightTrack& track, const Airframe& a) {
  constexpr double moment_s = 1;
  const MostLift most = max_lift(a);
  const TrackPoint* since = nullptr;
  bool flies = false;
  for (const TrackPoint& p : track.truth) {
    flies = flies || p.airspeed_mps > a.limits.airspeed_min_mps;
    const bool beyond = flies && p.alpha_rad > most.alpha_rad;
    if (!beyond) since = nullptr;
    if (beyond && !since) since = &p;
    if (since && p.time_s - since->time_s >= moment_s)
      return aero_messages::stall_in_flight(fixed(since->time_s, 1), fixed(since->airspeed_mps, 1),
                                            degrees(since->roll_rad, 0), degrees(most.alpha_rad, 1))
          .line();
  }
  return "";
}

TuneFlight fly_hourglass(const Airframe& airframe, const std::string& text, double airspeed_mps) {
  const fs::path host = core::own_program("fulmar");
  if (host.empty()) throw core::Error(aero_messages::fulmar_program_missing());
  const FlightFolder folder;
  folder.write("airframe.yaml", text);
  std::string mission = "extends: fulmar:missions/hourglass.yaml\nmission: tune\nairframe: airframe.yaml\n";
  std::string components;
  if (!is_shipped_speed(airspeed_mps)) {
    folder.write("plan.yaml", plan_text(airspeed_mps));
    components += "  plan: {params: {plan: plan.yaml}}\n";
  }
  if (needs_launch(airframe)) components += "  sim: {params: {launch: catapult}}\n";
  if (!components.empty()) mission += "components:\n" + components;
  folder.write("mission.yaml", mission);
  const auto open_file = [&](const char* name) {
    return ::open((folder.path / name).c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0600);
  };
  const int out = open_file("out.json"), error = open_file("error.txt");
  core::Process process(host.string(),
                        {"run", (folder.path / "mission.yaml").string(), "--json", "--log",
                         (folder.path / "flight.mcap").string()},
                        {.out = out, .error = error});
  ::close(out);
  ::close(error);
  TuneFlight flight;
  if (!process.wait(std::chrono::minutes(10))) {
    process.kill();
    flight.result = "not ended after 10 minutes";
    return flight;
  }
  const nlohmann::json o = nlohmann::json::parse(contents(folder.path / "out.json"), nullptr, false);
  if (!o.is_object() || !o.contains("result")) {
    flight.result = "not begun: " + core::for_terminal(contents(folder.path / "error.txt"));
    return flight;
  }
  flight.result = o["result"].get<std::string>();
  flight.figures = figures_of(o, airframe);
  flight.track = track_of(folder.path / "flight.mcap");
  flight.stalled = stall_of(flight.track, airframe);
  for (const auto& [north, east] : shipped_corners)
    flight.corners_m.push_back({plan_scale(airspeed_mps) * north, plan_scale(airspeed_mps) * east});
  return flight;
}

std::string flight_text(const TuneFlight& flight) {
  const std::string stalled = flight.stalled.empty() ? "" : "; " + flight.stalled;
  std::string text = "\n" + aero_messages::hourglass_result(flight.result + stalled).line() + "\n";
  for (const FlownFigure& f : flight.figures)
    text += "  " + padded(f.name, 16) + right(fixed(f.value, 2), 8) + " " + padded(f.unit, 5) +
            (f.least ? "at least " : "at most ") + figures(f.bound) + "\n";
  return text;
}

nlohmann::json tune_flight_json(const TuneFlight& flight) {
  nlohmann::json list = nlohmann::json::array();
  for (const FlownFigure& f : flight.figures)
    list.push_back({{"name", f.name},
                    {"unit", f.unit},
                    {"value", std::isfinite(f.value) ? nlohmann::json(f.value) : nlohmann::json(nullptr)},
                    {f.least ? "least" : "most", f.bound}});
  nlohmann::json o{{"result", flight.result}, {"figures", list}};
  if (!flight.stalled.empty()) o["stalled"] = flight.stalled;
  return o;
}

std::vector<std::string> flight_faults(const TuneFlight& flight, const std::string& title) {
  std::vector<std::string> all;
  if (flight.result != "flown")
    all.push_back(located(title, aero_messages::hourglass_not_flown(flight.result)));
  if (!flight.stalled.empty()) all.push_back(title + ": " + flight.stalled);
  for (const FlownFigure& f : flight.figures)
    if (!f.kept())
      all.push_back(located(title, aero_messages::hourglass_bound_missed(
                                       f.name, fixed(f.value, 2), f.unit,
                                       (f.least ? "at least " : "at most ") + figures(f.bound))));
  return all;
}

}  // namespace fulmar::aero
