// SPDX-License-Identifier: BSD-3-Clause
// A flight controller with an aircraft around it, in software: fcu_peer --link fcu, then fulmar run MISSION
// --io fcu --set fcu.port=fcu. Hardware in the loop without hardware.
#include <poll.h>
#include <sched.h>
#include <sys/prctl.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <memory>

#include "airplane.hpp"
#include "endpoint.hpp"
#include "faults.hpp"
#include "script.hpp"
#include "sdk/test/flight/airframe_file.hpp"

namespace fulmar::fcu::peer {
namespace {

volatile std::sig_atomic_t stop_asked = 0, disarm_asked = 0;

struct Settings {
  std::string link, airframe = "anaconda", truth, sensors = "rosflight", turbulence = "light";
  bool udp = false, refuse = false, old_firmware = false, nmea = false, cold = false, realtime = false,
       silent = false, garbage = false, multirotor = false, shaken = false;
  double scale = 1, for_s = never_s, heading_deg = 135, start_height_m = 0, delay_ms = 0;
  std::vector<double> wind{3.5355, -3.5355, 0};
  FaultRates faults;
  Rates rates;
  Script script;
  std::uint64_t seed = 7;
  double rc_silent_until = never_s, rc_lost_until = never_s, override_until = never_s, unplug_for = 5,
         mute_for = 0.1;
  bool no_mag = false, no_baro = false, no_pitot = false;
  std::vector<double> moved_accel{0, 0, 0}, moved_gyro{0, 0, 0};
};

/// As the host makes the seed of a component: of the mission's and its name.
std::uint64_t seed_of_sim(std::uint64_t mission_seed) {
  std::uint64_t h = mission_seed ^ 0x9e3779b97f4a7c15ull;
  for (const char c : {'s', 'i', 'm'}) h = (h ^ static_cast<unsigned char>(c)) * 0x100000001b3ull;
  h ^= h >> 30;
  h *= 0xbf58476d1ce4e5b9ull;
  h ^= h >> 27;
  h *= 0x94d049bb133111ebull;
  return h ^ (h >> 31);
}

void read_options(CLI::App& app, Settings& s) {
  app.add_option("--link", s.link, "symbolic link to the pseudo-terminal");
  app.add_flag("--udp", s.udp, "UDP 127.0.0.1:14525 in place of a pseudo-terminal");
  app.add_option("--scale", s.scale, "so many times faster than the clock on the wall")
      ->check(CLI::Range(0.1, 100.0));
  app.add_option("--for", s.for_s, "ends after so many seconds of its time");
  app.add_option("--airframe", s.airframe, "of configs/airframes");
  app.add_option("--sensors", s.sensors, "their errors")
      ->check(CLI::IsMember({"perfect", "rosflight", "ublox"}));
  app.add_option("--imu-rate", s.rates.imu, "Hz");
  app.add_option("--gnss-rate", s.rates.gnss, "Hz");
  app.add_option("--turbulence", s.turbulence, "of the air")
      ->check(CLI::IsMember({"none", "light", "moderate", "severe"}));
  app.add_option("--wind", s.wind, "north, east, down, m/s")->expected(3)->allow_extra_args(false);
  app.add_option("--heading", s.heading_deg, "at the start, deg");
  app.add_option("--start-height", s.start_height_m, "m; 0: on the ground");
  app.add_option("--seed", s.seed, "of noise, air and faults");
  app.add_option(
      "--mission-seed",
      [&s](const std::vector<std::string>& v) {
        s.seed = seed_of_sim(std::stoull(v[0]));
        return true;
      },
      "the biases that `io: sim` has with this seed of the mission, in a component called sim");
  app.add_option("--truth", s.truth, "CSV of the true flight, 100 Hz");
  app.add_flag("--realtime", s.realtime, "SCHED_FIFO");
  app.add_flag("--cold", s.cold, "boots now; otherwise it has been up for 12 s");
  app.add_flag("--refuse", s.refuse, "refuses every command");
  app.add_flag("--old-firmware", s.old_firmware, "says that it is version 1.3");
  app.add_flag("--multirotor", s.multirotor, "factory settings");
  app.add_flag("--shaken", s.shaken, "somebody shakes it until it is armed: it cannot be calibrated");
  app.add_flag("--nmea", s.nmea, "no flight controller: a GNSS receiver's text");
  app.add_flag("--garbage", s.garbage, "as at a wrong baud rate");
  app.add_flag("--silent", s.silent, "sends nothing");
  app.add_option("--loss", s.faults.loss, "of frames, both ways, 0..1");
  app.add_option("--duplicate", s.faults.duplicate, "of frames, both ways, 0..1");
  app.add_option("--corrupt", s.faults.corrupt, "of frames, both ways, 0..1");
  app.add_option("--delay", s.delay_ms, "of frames, each way, ms");
  app.add_option("--arm-at", s.script.arm_at,
                 "seconds after the host's first command, as all that follow; inf: never");
  app.add_option("--disarm-at", s.script.disarm_at, "or at SIGUSR1");
  app.add_option("--rc-silent-at", s.script.rc_silent.at, "the radio's frames stop without a flag");
  app.add_option("--rc-back-at", s.rc_silent_until, "and come again");
  app.add_option("--rc-lost-at", s.script.rc_lost.at, "the receiver says that it has lost the radio");
  app.add_option("--rc-found-at", s.rc_lost_until, "and has it again");
  app.add_option("--override-at", s.script.override.at, "the pilot takes over");
  app.add_option("--override-until", s.override_until, "and hands back");
  app.add_option("--unplug-at", s.script.unplugged.at, "the cable is pulled");
  app.add_option("--unplug-for", s.unplug_for, "seconds");
  app.add_option("--mute-at", s.script.mute.at, "nothing gets through, either way");
  app.add_option("--mute-for", s.mute_for, "seconds");
  app.add_option("--no-fix-at", s.script.no_fix.at, "the receiver has no fix; below 0: from the start");
  app.add_option("--fix-back-at", s.script.no_fix.until, "and has it again");
  app.add_option("--gnss-silent-at", s.script.gnss_silent.at,
                 "the receiver says nothing; below 0: from the start");
  app.add_option("--gnss-back-at", s.script.gnss_silent.until, "and speaks again");
  app.add_flag("--no-mag", s.no_mag, "there is no magnetometer");
  app.add_flag("--no-baro", s.no_baro, "there is no barometer");
  app.add_flag("--no-pitot", s.no_pitot, "there is no pitot tube");
  app.add_option("--moved-at", s.script.moved_at,
                 "the inertial unit's calibration is another one; below 0: from the start");
  app.add_option("--moved-accel", s.moved_accel, "by so much, forward, right, down, m/s2")
      ->expected(3)
      ->allow_extra_args(false);
  app.add_option("--moved-gyro", s.moved_gyro, "by so much, roll, pitch, yaw, rad/s")
      ->expected(3)
      ->allow_extra_args(false);
  app.add_flag("--level", s.script.levels,
               "in the air the pilot holds the wings level with 60 % throttle whenever he has the aircraft");
  app.add_option("--reboot-at", s.script.reboot_at, "the controller reboots");
  app.add_option("--crash-at", s.script.crash_at, "the controller crashes and recovers");
}

World world(const Settings& s) {
  World w;
  w.airframe = test::airframe_file(s.airframe);
  w.sensors = s.sensors == "perfect" ? sim::SensorSet::perfect
              : s.sensors == "ublox" ? sim::SensorSet::ublox
                                     : sim::SensorSet::rosflight;
  w.weather.wind_n = {s.wind[0], s.wind[1], s.wind[2]};
  constexpr std::array names{"none", "light", "moderate", "severe"};
  for (std::size_t k = 0; k < names.size(); ++k)
    if (s.turbulence == names[k]) w.weather.turbulence = static_cast<Turbulence>(k);
  w.heading_rad = s.heading_deg * std::numbers::pi / 180;
  w.start_height_m = s.start_height_m;
  w.seed = s.seed;
  return w;
}

Options options(const Settings& s) {
  Options o;
  o.refuses = s.refuse;
  o.rates = s.rates;
  o.seed = s.seed;
  if (s.old_firmware) o.version = "v1.3.1-12-g6d4b9c1";
  return o;
}

class Peer {
 public:
  explicit Peer(const Settings& s)
      : s_(s),
        firmware_(options(s)),
        plane_(world(s), firmware_, options(s).rates),
        pilot_(s.script, plane_.airframe(), plane_.plant().air().density_kgm3),
        out_(s.faults, mix_seed(s.seed, 21)),
        in_(s.faults, mix_seed(s.seed, 22)) {
    if (s.udp)
      end_ = std::make_unique<Datagrams>(std::uint16_t{14525}, std::uint16_t{14520});
    else
      end_ = std::make_unique<Terminal>(s.link);
    if (!s.truth.empty() && !(truth_ = std::fopen(s.truth.c_str(), "w")))
      throw std::runtime_error("cannot write " + s.truth);
    if (truth_)
      std::fputs(
          "t_s,north_m,east_m,height_m,roll_rad,pitch_rad,yaw_rad,airspeed_mps,throttle_frac,aileron_rad,"
          "elevator_rad,rudder_rad,armed,"
          "offboard,override,"
          "commands,u_throttle,u_aileron,u_elevator,u_rudder\n",
          truth_);
    if (!s.multirotor) firmware_.provision(0);
    firmware_.before_imu = [this] { before_imu(); };
    for (; !s.cold && now_us_ < warm_us; firmware_.take()) firmware_.run(now_us_ += 100000);
  }
  ~Peer() {
    if (truth_) std::fclose(truth_);
  }
  Peer(const Peer&) = delete;
  Peer& operator=(const Peer&) = delete;

  const Endpoint& endpoint() const { return *end_; }
  void run();
  void print_result() const;

 private:
  static constexpr std::int64_t warm_us = 12000000;  ///< baro and airspeed are zeroed by then

  void before_imu();
  void shake();
  void run_script();
  void receive();
  void transmit();
  void write_truth();
  std::int64_t wall_us() const {
    return std::chrono::duration_cast<std::chrono::microseconds>(
               std::chrono::steady_clock::now().time_since_epoch())
        .count();
  }
  std::int64_t peer_us() const {
    return start_us_ + static_cast<std::int64_t>(static_cast<double>(wall_us() - wall_start_us_) * s_.scale);
  }
  void wait_until(std::int64_t at_us) const;
  /// Seconds since the host's first command, negative before it.
  double flight_s() const {
    return first_command_us_ < 0 ? -1 : 1e-6 * static_cast<double>(now_us_ - first_command_us_);
  }

  Settings s_;
  Firmware firmware_;
  Airplane plane_;
  Pilot pilot_;
  Line out_, in_;
  std::unique_ptr<Endpoint> end_;
  std::FILE* truth_ = nullptr;
  std::int64_t now_us_ = 0, start_us_ = 0, wall_start_us_ = 0, first_command_us_ = -1, nmea_us_ = 0,
               worst_late_us_ = 0, worst_late_in_flight_us_ = 0;
  std::uint64_t steps_ = 0;
  bool rebooted_ = false, crashed_ = false, unplugged_ = false;
  double top_height_m_ = 0;
};

void Peer::before_imu() {
  plane_.pitot_covered = !plane_.released() && firmware_.clock_us() < 11000000;
  plane_.step();
  if (s_.shaken && !plane_.released()) shake();
  fail(s_.script, flight_s(), firmware_.inputs);
  top_height_m_ = std::max(top_height_m_, plane_.height_m());
  if (truth_ && ++steps_ % 4 == 0) write_truth();
}

/// By hand, 3 Hz: more than the firmware takes for rest, in rotations that leave a mean.
void Peer::shake() {
  const double swing = std::sin(2 * std::numbers::pi * 3 * 1e-6 * static_cast<double>(firmware_.clock_us()));
  firmware_.inputs.accel[0] += 2 * swing;
  firmware_.inputs.gyro[1] += 0.3 + 0.2 * swing;
}

void Peer::write_truth() {
  const RigidBody& x = plane_.plant().state();
  const Eigen::Matrix3d R = x.q_nb.toRotationMatrix();
  const auto d = plane_.plant().deflections();
  const Commands& u = firmware_.last_command().u;
  std::fprintf(
      truth_,
      "%.4f,%.3f,%.3f,%.3f,%.5f,%.5f,%.5f,%.3f,%.4f,%.5f,%.5f,%.5f,%d,%d,%d,%llu,%.4f,%.4f,%.4f,%.4f\n",
      flight_s(), x.p_n.x(), x.p_n.y(), -x.p_n.z(), std::atan2(R(2, 1), R(2, 2)),
      std::asin(std::clamp(-R(2, 0), -1.0, 1.0)), std::atan2(R(1, 0), R(0, 0)),
      plane_.plant().air_velocity_b().norm(), plane_.actuators().throttle_frac, d.aileron, d.elevator,
      d.rudder, int(firmware_.armed()), int(firmware_.offboard()), int(firmware_.override_reasons()),
      static_cast<unsigned long long>(firmware_.commands()), double(u[0]), double(u[3]), double(u[4]),
      double(u[5]));
}

void Peer::run_script() {
  const double t = flight_s();
  pilot_.act(firmware_.inputs, t, disarm_asked != 0);
  if (s_.script.levels && disarm_asked == 0 && plane_.height_m() > 3 && firmware_.override_reasons() != 0)
    pilot_.hold_level(firmware_.inputs, plane_.plant().state());
  if (t >= s_.script.reboot_at && !std::exchange(rebooted_, true)) firmware_.reboot(now_us_);
  if (t >= s_.script.crash_at && !std::exchange(crashed_, true)) firmware_.crash(now_us_);
  const bool pulled = s_.script.unplugged.holds(t);
  if (pulled != unplugged_) {
    unplugged_ = pulled;
    if (pulled)
      end_->unplug();
    else
      end_->plug();
    out_.clear();
  }
}

void Peer::receive() {
  std::array<std::uint8_t, 4096> room;
  while (const std::size_t n = end_->read(room))
    if (!s_.script.mute.holds(flight_s())) in_.put({room.data(), n}, now_us_);
  std::vector<std::uint8_t> bytes;
  while (in_.take(bytes, now_us_)) firmware_.receive(bytes, now_us_);
  if (first_command_us_ < 0 && firmware_.commands() > 0) first_command_us_ = now_us_;
}

void Peer::transmit() {
  Frame f;
  const bool mute =
      s_.silent || s_.script.mute.holds(flight_s()) || s_.nmea || s_.garbage || !end_->attended();
  while (firmware_.take(f))
    if (!mute) out_.put(f.view(), now_us_);
  if (s_.nmea && now_us_ - nmea_us_ > 100000) {
    nmea_us_ = now_us_;
    const std::string_view line =
        "$GPGGA,123519,4014.783,N,11138.845,W,1,08,0.9,1387.0,M,-17.0,M,,*53\r\n$GPRMC,123519,A,4014.783,N,"
        "11138.845,W,000.0,084.4,230394,"
        "003.1,W*6E\r\n";
    out_.put({reinterpret_cast<const std::uint8_t*>(line.data()), line.size()}, now_us_);
  }
  if (s_.garbage && now_us_ - nmea_us_ > 2500) {
    nmea_us_ = now_us_;
    std::array<std::uint8_t, 96> noise;
    Random random(static_cast<std::uint64_t>(now_us_));
    for (auto& b : noise) b = static_cast<std::uint8_t>(random.bits());
    out_.put(noise, now_us_);
  }
  std::vector<std::uint8_t> bytes, whole;
  while (out_.take(bytes, now_us_)) whole.insert(whole.end(), bytes.begin(), bytes.end());
  if (!whole.empty()) end_->write(whole);
}

void Peer::wait_until(std::int64_t at_us) const {
  const double wall = static_cast<double>(at_us - peer_us()) / s_.scale;
  if (wall <= 0) return;
  const auto ns = static_cast<std::int64_t>(1e3 * wall);
  const timespec time{ns / 1000000000, ns % 1000000000};
  pollfd p{end_->descriptor(), POLLIN, 0};
  if (p.fd >= 0 && !end_->attended()) {
    p.events = 0;
    p.fd = -1;  // closed: a hang-up would end every wait at once
  }
  ::ppoll(&p, 1, &time, nullptr);
}

void Peer::run() {
  start_us_ = now_us_;
  wall_start_us_ = wall_us();
  const double end_us = s_.for_s == never_s ? 9e18 : static_cast<double>(start_us_) + 1e6 * s_.for_s;
  while (!stop_asked && static_cast<double>(now_us_) < end_us) {
    wait_until(std::min({firmware_.next_us(), out_.next_us(), in_.next_us()}));
    now_us_ = std::max(now_us_, peer_us());
    const std::int64_t late_us = now_us_ - firmware_.next_us();
    worst_late_us_ = std::max(worst_late_us_, late_us);
    if (first_command_us_ >= 0) worst_late_in_flight_us_ = std::max(worst_late_in_flight_us_, late_us);
    run_script();
    receive();
    firmware_.run(now_us_);
    transmit();
  }
}

void Peer::print_result() const {
  std::printf(
      "{\"aircraft_crashed\": %s, \"armed\": %s, \"boots\": %u, \"commands\": %llu, \"dropped_frames\": "
      "%llu, \"duration_s\": %.1f, "
      "\"override_reasons\": %u, \"top_height_m\": %.1f, \"worst_late_ms\": %.1f, \"worst_late_wall_ms\": "
      "%.2f}\n",
      plane_.plant().crashed() ? "true" : "false", firmware_.armed() ? "true" : "false", firmware_.boots(),
      static_cast<unsigned long long>(firmware_.commands()),
      static_cast<unsigned long long>(firmware_.dropped()), 1e-6 * static_cast<double>(now_us_ - start_us_),
      unsigned{firmware_.override_reasons()}, top_height_m_, 1e-3 * static_cast<double>(worst_late_us_),
      1e-3 * static_cast<double>(worst_late_in_flight_us_) / s_.scale);
}

}  // namespace
}  // namespace fulmar::fcu::peer

int main(int argc, char** argv) {
  using namespace fulmar::fcu::peer;
  CLI::App app("A ROSflight flight controller and a simulated aircraft, on a pseudo-terminal");
  Settings s;
  read_options(app, s);
  CLI11_PARSE(app, argc, argv);
  s.faults.delay_us = static_cast<std::int64_t>(1e3 * s.delay_ms);
  s.script.rc_silent.until = s.rc_silent_until;
  s.script.rc_lost.until = s.rc_lost_until;
  s.script.override.until = s.override_until;
  s.script.mag = !s.no_mag;
  s.script.baro = !s.no_baro;
  s.script.pitot = !s.no_pitot;
  std::copy_n(s.moved_accel.begin(), 3, s.script.moved_accel.begin());
  std::copy_n(s.moved_gyro.begin(), 3, s.script.moved_gyro.begin());
  s.script.mute.until = s.script.mute.at + s.mute_for;
  s.script.unplugged.until = s.script.unplugged.at + s.unplug_for;
  std::signal(SIGTERM, [](int) { stop_asked = 1; });
  std::signal(SIGINT, [](int) { stop_asked = 1; });
  std::signal(SIGUSR1, [](int) { disarm_asked = 1; });
  ::prctl(PR_SET_TIMERSLACK, 1000UL, 0UL, 0UL, 0UL);
  const sched_param priority{70};
  if (s.realtime && ::sched_setscheduler(0, SCHED_FIFO, &priority) != 0) {
    std::perror("fcu_peer: --realtime");
    return 1;
  }
  try {
    Peer peer(s);
    std::printf("port %s\n", peer.endpoint().name().c_str());
    std::fflush(stdout);
    peer.run();
    peer.print_result();
  } catch (const std::exception& e) {
    std::fprintf(stderr, "fcu_peer: %s\n", e.what());
    return 1;
  }
  return 0;
}
