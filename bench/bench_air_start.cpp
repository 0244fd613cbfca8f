// SPDX-License-Identifier: BSD-3-Clause
// Does an estimator that is switched on in flight say that it knows its attitude before it does? Flies turns
// to both sides in wind and turbulence, seed after seed, with two sets of sensors and receivers of 1, 5 and
// 10 Hz that are 0.1 to 0.3 s late; the estimator is told that to 0.05 s and begins at any time, in any bank.
// Prints the table of plugins/estimator_ekf/README.md and exits 1 when a bar is missed.
// bench_air_start [--starts N] [--set PARAMETER=VALUE]... [--json]
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <stdexcept>

#include "core/run/flight.hpp"
#include "fulmar/flight/estimator.hpp"
#include "fulmar/random.hpp"
#include "fulmar/testing.hpp"

using namespace fulmar::core;
using fulmar::VehicleState;
using fulmar::navigation::Ekf;

namespace {

constexpr double deg = std::numbers::pi / 180;
// The bars: no flag while the tilt is off by more; flags after the second fix, in this share of the starts.
constexpr double most_tilt_rad = 5 * deg, soon_s = 1.5, share_soon = 0.95;
constexpr double watched_s = 10;  // after the second fix

struct Start {
  std::string sensors;
  double bank_rad = 0.5, gnss_hz = 10, delay_s = 0.2, delay_told_s = 0.2, on_s = 5, wind_from_rad = 0;
  bool moderate = false;
  std::uint64_t seed = 1;
};

struct Outcome1 {
  double valid_after_s = 1e9;        // of attitude, velocity, position and height, after the second fix
  double bank_rad = 0;               // when it was switched on
  double tilt_rad = 0, all_rad = 0;  // largest errors while a flag is up
  double first_tilt_rad = 0, first_all_rad = 0;
  int wrong = 0;  // ticks with a flag up and a tilt that is off by more than the bar
};

/// What a port of the flight says; true when it is news.
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
           {"sim.calibrated", getenv("CAL") ? "true" : "false"},
           {"sim.turbulence", s.moderate ? "moderate" : "light"},
           {"sim.wind_ned", "[" + std::to_string(wind.north) + ", " + std::to_string(wind.east) + ", 0]"}};
  return load_mission("bench/air_start/mission.yaml", o);
}

class Flown {
 public:
  Flown(const Start& start, const std::vector<std::pair<std::string, double>>& set)
      : start_(start), graph_(graph_of(start)), flight_(graph_, without_log()) {
    ekf_.params.origin.value = {40.2463724, -111.6474138, 1387, true};
    ekf_.params.origin.is_given = true;
    ekf_.params.gnss_delay.value = start.delay_told_s;
    (void)set;
    if (getenv("CAL")) {
      ekf_.params.accel_bias_std.value = atof(getenv("CAL"));
      ekf_.params.gyro_bias_std.value = 0.02;
    }
  }
  Outcome1 fly() {
    while (flight_.step()) {
      const double now_s = 1e-9 * static_cast<double>(flight_.now_ns());
      truth_.look(flight_);
      const bool imu = imu_.look(flight_), gnss = gnss_.look(flight_), mag = mag_.look(flight_),
                 baro = baro_.look(flight_), pitot = pitot_.look(flight_), status = status_.look(flight_);
      if (now_s < start_.on_s) continue;
      if (status || o_.bank_rad == 0) ekf_.set(ekf_.in.status, status_.value);
      if (o_.bank_rad == 0) o_.bank_rad = truth_.value.roll_rad;
      if (imu) ekf_.set(ekf_.in.imu, imu_.value, -1 / 400.0);
      if (gnss) ekf_.set(ekf_.in.gnss, gnss_.value, -1 / 400.0);  // by its stamp it is new when it comes
      if (mag) ekf_.set(ekf_.in.mag, mag_.value, -1 / 400.0);
      if (baro) ekf_.set(ekf_.in.baro, baro_.value, -1 / 400.0);
      if (pitot) ekf_.set(ekf_.in.pitot, pitot_.value, -1 / 400.0);
      if (gnss && ++fixes_ == 2) second_s_ = now_s;
      ekf_.step(1 / 400.0);
      if (ekf_.out.state.written) judge(now_s, ekf_.out.state.value);
      if (fixes_ >= 2 && now_s > second_s_ + watched_s) break;
    }
    return o_;
  }

 private:
  static FlightOptions without_log() {
    FlightOptions options;
    options.log = false;
    return options;
  }
  void judge(double now_s, const VehicleState& s) {
    const Eigen::Quaterniond q = eigen(truth_.value.attitude), estimated = eigen(s.attitude);
    const Eigen::Vector3d down = Eigen::Vector3d::UnitZ();
    const double tilt =
        std::acos(std::clamp((q.conjugate() * down).dot(estimated.conjugate() * down), -1.0, 1.0));
    const double all = q.angularDistance(estimated);
    if (!begun_) o_.first_tilt_rad = tilt, o_.first_all_rad = all;
    if (getenv("TRACE") && (!begun_ || int(now_s * 400) % 40 == 0))
      fprintf(stderr, "%.2f tilt %.2f all %.2f std %.2f %.2f %.2f valid %d v %.2f b %.4f\n",
              now_s - second_s_, tilt / deg, all / deg, s.attitude_std_rad.north / deg,
              s.attitude_std_rad.east / deg, s.attitude_std_rad.down / deg, s.attitude_valid,
              (eigen(s.velocity_mps) - eigen(truth_.value.velocity_mps)).norm(),
              eigen(s.gyro_bias_radps).norm());
    if (getenv("AT") && std::abs(now_s - second_s_ - atof(getenv("AT"))) < 0.001)
      fprintf(stderr, "AT %s %g tilt %.2f all %.2f std %.2f %.2f %.2f bank %.0f bg %.3f ba %.2f valid %d\n",
              start_.sensors.c_str(), start_.gnss_hz, tilt / deg, all / deg, s.attitude_std_rad.north / deg,
              s.attitude_std_rad.east / deg, s.attitude_std_rad.down / deg, truth_.value.roll_rad / deg,
              eigen(s.gyro_bias_radps).norm(), eigen(s.accel_bias_mps2).norm(), s.attitude_valid);
    begun_ = true;
    if (s.attitude_valid && s.velocity_valid && s.position_valid && s.height_valid)
      o_.valid_after_s = std::min(o_.valid_after_s, now_s - second_s_);
    if (!(s.attitude_valid || s.velocity_valid || s.position_valid || s.height_valid || s.airspeed_valid ||
          s.wind_valid))
      return;
    o_.tilt_rad = std::max(o_.tilt_rad, tilt);
    o_.all_rad = std::max(o_.all_rad, all);
    o_.wrong += tilt > most_tilt_rad;
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
  Outcome1 o_;
  int fixes_ = 0;
  double second_s_ = 1e9;
  bool begun_ = false;
};

Start start_of(int i) {
  fulmar::Random random(static_cast<std::uint64_t>(i) + 1);
  const double rates[] = {1, 5, 10};
  Start s;
  s.sensors = i % 2 == 0 ? "rosflight" : "ublox";
  s.gnss_hz = rates[i / 2 % 3];
  s.moderate = i / 6 % 2 == 1;
  s.delay_s = random.uniform(0.1, 0.3);
  s.delay_told_s = s.delay_s + random.uniform(-0.05, 0.05);
  s.on_s = random.uniform(4, 16);
  s.wind_from_rad = random.uniform(0, 2 * std::numbers::pi);
  s.bank_rad = random.uniform(5 * deg, 30 * deg);
  s.seed = static_cast<std::uint64_t>(i) + 1;
  return s;
}

}  // namespace

int main(int argc, char** argv) {
  int n = argc > 1 ? atoi(argv[1]) : 200, first = argc > 2 ? atoi(argv[2]) : 0;
  for (int i = first; i < first + n; ++i) {
    const Start s = start_of(i);
    const Outcome1 o = Flown(s, {}).fly();
    std::printf(
        "%d %s %g Hz delay %.2f told %.2f bank %.1f: valid %.2f first %.1f %.1f worst %.1f %.1f wrong %d\n",
        i, s.sensors.c_str(), s.gnss_hz, s.delay_s, s.delay_told_s, o.bank_rad / deg, o.valid_after_s,
        o.first_tilt_rad / deg, o.first_all_rad / deg, o.tilt_rad / deg, o.all_rad / deg, o.wrong);
    fflush(stdout);
  }
}
