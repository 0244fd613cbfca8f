// SPDX-License-Identifier: BSD-3-Clause
// Checks that an estimator that starts in flight sets no validity flag before its attitude is correct. Flies
// legs and turns to both sides in wind and turbulence with many seeds, with two sets of sensors that were
// calibrated on the ground, and receivers of 1, 5 and 10 Hz with a delay of 0.1 to 0.3 s. The estimator gets
// the delay with an error of up to 0.05 s, and starts at any time, at any bank up to 30 deg. Prints the table
// of plugins/estimator_ekf/README.md and exits 1 when a bar is missed.
// bench_air_start [--starts N] [--uncalibrated] [--each] [--json]
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <stdexcept>

#include "core/run/flight.hpp"
#include "fulmar/flight/navigation/estimator.hpp"
#include "fulmar/random.hpp"
#include "fulmar/testing.hpp"

using namespace fulmar::core;
using fulmar::VehicleState;
using fulmar::navigation::Ekf;

namespace {

constexpr double deg = std::numbers::pi / 180;
// The bars: no flag while the error of the tilt is larger; all flags within this time after the second fix,
// in this share of the starts.
constexpr double max_tilt_rad = 5 * deg, soon_s = 1.5, share_soon = 0.95;
constexpr double watched_s = 10;  // after the second fix
constexpr double tick_s = 1.0 / 400;
// Standard deviation of the biases after a calibration on the ground, as given to the estimator.
constexpr double gyro_bias_std_radps = 0.02, accel_bias_std_mps2 = 0.1;

struct Options {
  int starts = 200;
  bool uncalibrated = false, each = false, json = false;
};

struct Start {
  std::string sensors;
  double gnss_hz = 10, delay_s = 0.2, delay_reported_s = 0.2, on_s = 5, wind_from_rad = 0, bank_rad = 0.5;
  bool moderate = false, calibrated = true;
  std::uint64_t seed = 1;
};

/// Results of one start.
struct Begun {
  double valid_after_s = 1e9;  // of attitude, velocity, position and height, after the second fix
  double first_rad = 0;        // error of the tilt in the first state
  double tilt_rad = 0;         // largest error of the tilt while a flag is up
  double heading_rad = 0;      // largest error of the heading
  int wrong = 0;               // number of ticks with a flag up and a tilt error above the bar
};

/// Sample of a port of the flight; true for a new one.
template <class T>
class Tapped {
 public:
  Tapped(const Graph& graph, const std::string& component, const std::string& port) {
    for (std::size_t i = 0; i < graph.components.size(); ++i)
      if (graph.components[i].name == component)
        source_ = {Source::Kind::component, static_cast<int>(i), graph.components[i].info().output(port)};
  }
  bool look(const Flight& flight) {
    const std::byte* const bytes = flight.sample(source_);
    if (!bytes || (any_ && std::memcmp(bytes, &value, sizeof value) == 0)) return false;
    std::memcpy(&value, bytes, sizeof value);
    return any_ = true;
  }
  T value{};

 private:
  Source source_{};
  bool any_ = false;
};

Graph graph_of(const Start& s) {
  Overrides o;
  o.seed = s.seed;
  o.roles = {{"nav", "truth"}};
  const fulmar::Vec3<fulmar::Ned> wind{5 * std::cos(s.wind_from_rad), 5 * std::sin(s.wind_from_rad), 0};
  const auto gnss = [](const char* name, double value) {
    return std::pair{std::string("sim.sensor_file.gnss.timing.") + name, std::to_string(value)};
  };
  o.set = {{"sim.sensor_file", "fulmar:sensors/" + s.sensors + ".yaml"},
           gnss("rate_hz", s.gnss_hz),
           gnss("latency_s", s.delay_s),
           {"slc.roll_limit", std::to_string(s.bank_rad)},
           {"sim.calibrated", s.calibrated ? "true" : "false"},
           {"sim.turbulence", s.moderate ? "moderate" : "light"},
           {"sim.wind_ned", "[" + std::to_string(wind.north) + ", " + std::to_string(wind.east) + ", 0]"}};
  return load_mission("bench/air_start/mission.yaml", o);
}

class Flown {
 public:
  explicit Flown(const Start& start)
      : start_(start), graph_(graph_of(start)), flight_(graph_, without_log()) {
    ekf_.params.origin.value = {40.2463724, -111.6474138, 1387, true};  // that of the mission
    ekf_.params.origin.is_given = true;
    ekf_.params.gnss_delay.value = start.delay_reported_s;
    if (!start.calibrated) return;
    ekf_.params.gyro_bias_std.value = gyro_bias_std_radps;
    ekf_.params.accel_bias_std.value = accel_bias_std_mps2;
  }
  Begun fly() {
    while (flight_.step() && now_s() < second_s_ + watched_s) {
      truth_.look(flight_);
      const bool news[] = {imu_.look(flight_),  gnss_.look(flight_),  mag_.look(flight_),
                           baro_.look(flight_), pitot_.look(flight_), status_.look(flight_)};
      if (now_s() < start_.on_s) continue;
      ekf_.set(ekf_.in.status, status_.value);
      // Each sample is stamped with its arrival: the estimator knows the delay of the receiver only from its
      // parameter.
      if (news[0]) ekf_.set(ekf_.in.imu, imu_.value, -tick_s);
      if (news[1]) ekf_.set(ekf_.in.gnss, gnss_.value, -tick_s);
      if (news[2]) ekf_.set(ekf_.in.mag, mag_.value, -tick_s);
      if (news[3]) ekf_.set(ekf_.in.baro, baro_.value, -tick_s);
      if (news[4]) ekf_.set(ekf_.in.pitot, pitot_.value, -tick_s);
      if (news[1] && ++fixes_ == 2) second_s_ = now_s();
      ekf_.step(tick_s);
      if (ekf_.out.state.written) judge(ekf_.out.state.value);
    }
    return begun_;
  }

 private:
  static FlightOptions without_log() {
    FlightOptions options;
    options.log = false;
    return options;
  }
  double now_s() const { return 1e-9 * static_cast<double>(flight_.now_ns()); }
  void judge(const VehicleState& s) {
    const Eigen::Vector3d down = Eigen::Vector3d::UnitZ();
    const double cosine = (eigen(truth_.value.attitude).conjugate() * down)
                              .dot(eigen(s.attitude).conjugate() * down),
                 tilt = std::acos(std::clamp(cosine, -1.0, 1.0)),
                 heading = std::abs(fulmar::wrap_pi(s.yaw_rad - truth_.value.yaw_rad));
    if (std::exchange(first_, false)) begun_.first_rad = tilt;
    if (s.attitude_valid && s.velocity_valid && s.position_valid && s.height_valid)
      begun_.valid_after_s = std::min(begun_.valid_after_s, now_s() - second_s_);
    if (!(s.attitude_valid || s.velocity_valid || s.position_valid || s.height_valid || s.airspeed_valid ||
          s.wind_valid))
      return;
    begun_.tilt_rad = std::max(begun_.tilt_rad, tilt);
    begun_.heading_rad = std::max(begun_.heading_rad, heading);
    begun_.wrong += tilt > max_tilt_rad;
  }

  Start start_;
  Graph graph_;
  Flight flight_;
  fulmar::Bench<Ekf> ekf_;
  Tapped<VehicleState> truth_{graph_, "sim", "truth"};
  Tapped<fulmar::Imu> imu_{graph_, "sim", "imu"};
  Tapped<fulmar::Gnss> gnss_{graph_, "sim", "gnss"};
  Tapped<fulmar::Mag> mag_{graph_, "sim", "mag"};
  Tapped<fulmar::Baro> baro_{graph_, "sim", "baro"};
  Tapped<fulmar::Pitot> pitot_{graph_, "sim", "pitot"};
  Tapped<fulmar::VehicleStatus> status_{graph_, "sim", "status"};
  Begun begun_;
  int fixes_ = 0;
  double second_s_ = 1e9;
  bool first_ = true;
};

Start start_of(int i, bool calibrated) {
  constexpr double rates[] = {1, 5, 10};
  Start s;
  s.seed = static_cast<std::uint64_t>(i) + 1;
  fulmar::Random random(s.seed);
  s.calibrated = calibrated;
  s.sensors = i % 2 == 0 ? "rosflight" : "ublox";
  s.gnss_hz = rates[i / 2 % 3];
  s.moderate = i / 6 % 2 == 1;
  s.delay_s = random.uniform(0.1, 0.3);
  s.delay_reported_s = s.delay_s + random.uniform(-0.05, 0.05);
  s.on_s = random.uniform(4, 16);
  s.wind_from_rad = random.uniform(0, 2 * std::numbers::pi);
  s.bank_rad = random.uniform(5 * deg, 30 * deg);
  return s;
}

struct Row {
  std::vector<double> valid_after_s;
  int soon = 0, wrong_starts = 0, wrong = 0;
  double first_rad = 0, tilt_rad = 0, heading_rad = 0;

  void add(const Begun& b) {
    valid_after_s.push_back(b.valid_after_s);
    soon += b.valid_after_s <= soon_s + 1e-6;
    wrong_starts += b.wrong > 0;
    wrong += b.wrong;
    first_rad = std::max(first_rad, b.first_rad);
    tilt_rad = std::max(tilt_rad, b.tilt_rad);
    heading_rad = std::max(heading_rad, b.heading_rad);
  }
  double share() const { return soon / static_cast<double>(valid_after_s.size()); }
  /// Nearest rank (1: the worst).
  double quantile(double q) const {
    std::vector<double> sorted = valid_after_s;
    std::sort(sorted.begin(), sorted.end());
    const auto n = static_cast<double>(sorted.size());
    return sorted[static_cast<std::size_t>(std::max(std::ceil(q * n - 1e-9), 1.0)) - 1];
  }
};

void print(const std::map<std::string, Row>& rows) {
  std::printf(
      "| sensors, receiver | starts | valid within %.1f s | 95 %% after, s | last after, s | tilt off at "
      "first, deg | while valid, deg | heading, deg | wrong starts | wrong ticks |\n"
      "|---|---|---|---|---|---|---|---|---|---|\n",
      soon_s);
  for (const auto& [name, r] : rows)
    std::printf("| %s | %zu | %.1f %% | %.2f | %.2f | %.1f | %.1f | %.1f | %d | %d |\n", name.c_str(),
                r.valid_after_s.size(), 100 * r.share(), r.quantile(0.95), r.quantile(1), r.first_rad / deg,
                r.tilt_rad / deg, r.heading_rad / deg, r.wrong_starts, r.wrong);
}

nlohmann::json json_of(const std::map<std::string, Row>& rows) {
  nlohmann::json j;
  for (const auto& [name, r] : rows)
    j[name] = {{"starts", r.valid_after_s.size()},
               {"share_soon", r.share()},
               {"valid_after_95_s", r.quantile(0.95)},
               {"valid_after_max_s", r.quantile(1)},
               {"tilt_error_first_deg", r.first_rad / deg},
               {"tilt_error_valid_deg", r.tilt_rad / deg},
               {"heading_error_valid_deg", r.heading_rad / deg},
               {"wrong_starts", r.wrong_starts},
               {"wrong_ticks", r.wrong}};
  return j;
}

Options options_of(int argc, char** argv) {
  Options o;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--json")
      o.json = true;
    else if (word == "--uncalibrated")
      o.uncalibrated = true;
    else if (word == "--each")
      o.each = true;
    else if (word == "--starts" && i + 1 < argc && std::atoi(argv[i + 1]) > 0)
      o.starts = std::atoi(argv[++i]);
    else
      throw std::invalid_argument("usage: bench_air_start [--starts N] [--uncalibrated] [--each] [--json]");
  }
  return o;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    const Options options = options_of(argc, argv);
    std::map<std::string, Row> rows;
    Row all;
    for (int i = 0; i < options.starts; ++i) {
      const Start s = start_of(i, !options.uncalibrated);
      const Begun b = Flown(s).fly();
      char name[64];
      std::snprintf(name, sizeof name, "`%s`, %2.0f Hz", s.sensors.c_str(), s.gnss_hz);
      rows[name].add(b);
      all.add(b);
      if (options.each)
        std::fprintf(stderr,
                     "seed %d, %s, delay %.3f s, told %.3f s: valid after %.2f s, tilt off by %.1f deg\n",
                     i + 1, name, s.delay_s, s.delay_reported_s, b.valid_after_s, b.tilt_rad / deg);
    }
    rows["of both"] = all;
    if (options.json)
      std::printf("%s\n", json_of(rows).dump(2).c_str());
    else
      print(rows);
    return all.wrong == 0 && all.share() >= share_soon ? 0 : 1;
  } catch (const std::invalid_argument& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 2;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "%s\n", e.what());
    return 1;
  }
}
