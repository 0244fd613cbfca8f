// SPDX-License-Identifier: BSD-3-Clause
// The vehicle of fcu_serial on the software flight controller with the simulated aircraft around it, all in
// virtual time: a mission that flies through a controller's port as fast as the machine allows, the same with
// each run. For tests.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "fulmar/flight/math/attitude.hpp"
#include "fulmar/msg/contact_truth.hpp"
#include "fulmar/plugin.hpp"
#include "plugins/fcu_serial/test/peer/script.hpp"
#include "plugins/fcu_serial/test/virtual_link.hpp"
#include "plugins/fcu_serial/vehicle.hpp"

namespace fulmar::fcu::testing {

class VirtualController {
  using Inner = Vehicle<VirtualLink>;

 public:
  static constexpr const char* doc =
      "fcu_serial, its controller, the aircraft and its pilot in virtual time.";
  using Inputs = Inner::Inputs;
  struct Outputs {
    Out<Imu> imu;
    Out<Gnss> gnss;
    Out<Mag> mag;
    Out<Baro> baro;
    Out<Pitot> pitot;
    Out<Rc> rc;
    Out<VehicleStatus> status;
    OutQueue<Notice, 32> notices;
    Out<ControllerAttitude> attitude;
    Out<VehicleState> truth;
    Out<ContactTruth> contact;  ///< of the aircraft, for figures alone
    Probe script_s;             ///< since the host's first command, negative before it
    Probe commands_ratio;       ///< frames with commands that the host has sent
    Probe blind_ratio;          ///< of these: without a valid attitude
    Probe host_ratio;           ///< 1: its commands move the aircraft
    Probe throttle_ratio;       ///< that the motor gets
    Probe sticks_ratio;         ///< how far the outputs are off the sticks, while the pilot has the aircraft
  };
  /// Times count from the host's first command.
  struct Params {
    Record<Airframe> airframe{"of the aircraft", required};
    Choice<Turbulence> turbulence{Turbulence::light, "of the air", setup};
    Vector<Ned> wind_ned{{3.5355, -3.5355, 0}, "m/s", -50, 50, "steady velocity of the air"};
    Param heading{2.356, "rad", -6.3, 6.3, "at the start", setup};
    Param arm_at{6, "s", 0, 1e9, "the pilot arms, and hands over half a second later"};
    Param pilot_from{1e9, "s", -100, 1e9, "the pilot takes over"};
    Param pilot_until{1e9, "s", -100, 1e9, "and hands back"};
    Param pilot_height{0, "m", 0, 1000,
                       "to which he takes off and climbs; 0: in the air he holds the wings level"};
    Param gap_from{1e9, "s", -100, 1e9, "nothing comes through the link, either way"};
    Param gap_until{1e9, "s", -100, 1e9, "and again"};
    Param no_fix_from{1e9, "s", -100, 1e9, "the receiver has no fix"};
    Param no_fix_until{1e9, "s", -100, 1e9, "and has it again"};
    Param gnss_silent_from{1e9, "s", -100, 1e9, "the receiver says nothing"};
    Param gnss_silent_until{1e9, "s", -100, 1e9, "and speaks again"};
    Choice<peer::Failing> fails{peer::Failing::none, "a sensor of the board"};
    Param fails_from{1e9, "s", -100, 1e9, "it fails"};
    Param fails_until{1e9, "s", -100, 1e9, "and works again"};
    Param rc_silent_from{1e9, "s", -100, 1e9, "the frames of the radio stop, without a flag"};
    Param rc_silent_until{1e9, "s", -100, 1e9, "and come again"};
    Param rc_lost_from{1e9, "s", -100, 1e9, "the receiver says that it has lost the radio"};
    Param rc_lost_until{1e9, "s", -100, 1e9, "and has it again"};
    Param pilot_throttle{-1, "ratio", -1, 1, "of the pilot in the air; below 0: as the flight needs it"};
    Flag pilot_lands{false, "the pilot, when he has it in the air, lands with the heading of the start"};
    Flag manual{false, "set up as control_manual has it: armed by the sticks, three switches are free",
                setup};
    Param aux1{-1, "ratio", -1, 1, "with `manual`, as the others: the switch of channel 5"};
    Param aux2{-1, "ratio", -1, 1, "of channel 6"};
    Param aux3{-1, "ratio", -1, 1, "of channel 7"};
    Flag mag{true, "false: there is none"};
    Flag baro{true, "false: there is none"};
    Flag pitot{true, "false: there is none"};
    Param moved_at{1e9, "s", -100, 1e9, "the calibration of the inertial unit is another one"};
    Vector<Body> moved_accel{{0, 0, 0}, "m/s2", -10, 10, "by so much"};
    Vector<Body> moved_gyro{{0, 0, 0}, "rad/s", -1, 1, "by so much"};
  };

  explicit VirtualController(std::uint64_t seed) : seed_(seed) {}

  void configure(const Params& p) {
    inner_.reset();
    plane_.reset();
    wire_.reset();  // before the next one: only one exists at a time
    wire_.emplace();
    wire_->fcu.provision();
    if (p.manual) set_up_manual();
    world_ = {};
    world_.airframe = *p.airframe;
    world_.weather.wind_n = eigen(p.wind_ned.value);
    world_.weather.turbulence = p.turbulence;
    world_.heading_rad = p.heading;
    world_.seed = seed_;
    plane_.emplace(world_, wire_->fcu, peer::Rates{});
    run_ = Run();
    read_script(p);
    wire_->fcu.before_imu = [this] {
      plane_->pitot_covered = !plane_->released() && wire_->fcu.clock_us() < 11000000;
      failure_.undo(wire_->fcu.inputs);
      plane_->step();
      act();
    };
    wire_->run(12'000'000'000, false);  // barometer and airspeed are zeroed by then
    wire_->queue.clear();
    inner_params_.airframe = p.airframe;
    inner_params_.needs_state.value = true;
    inner_.emplace();
    inner_->configure(inner_params_);
  }
  void retune(const Params& p) { read_script(p); }

  Status read(Tick& tick, const Params&, Outputs& out) {
    Inner::Outputs from{};
    const Status status = inner_->read(tick, inner_params_, from);
    out.imu = from.imu;
    out.gnss = from.gnss;
    out.mag = from.mag;
    out.baro = from.baro;
    out.pitot = from.pitot;
    out.rc = from.rc;
    out.status = from.status;
    out.attitude = from.attitude;
    for (std::uint32_t i = 0; i < from.notices.count; ++i)
      out.notices.push(from.notices.items[i], from.notices.stamps_ns[i]);
    out.truth.publish(truth());
    ContactTruth contact;
    contact.touching = plane_->plant().on_ground();
    contact.crashed = plane_->plant().crashed();
    out.contact.publish(contact);
    out.script_s = script_s();
    out.commands_ratio = static_cast<double>(run_.commands);
    out.blind_ratio = static_cast<double>(run_.blind);
    out.host_ratio = host_flies() ? 1 : 0;
    out.throttle_ratio = plane_->actuators().throttle_frac;
    out.sticks_ratio = run_.sticks;
    return status;
  }

  Status write(const Tick& tick, const Inputs& in, const Params&) {
    const Status status = inner_->write(tick, in, inner_params_);
    for (const Packet& p : wire_->sent) {
      if (!p.is<OffboardControl>()) continue;
      if (run_.first_ns == never_ns) run_.first_ns = wire_->now_ns;
      ++run_.commands;
      run_.blind += in.state && in.state->attitude_valid ? 0 : 1;
    }
    wire_->sent.clear();
    wire_->sent_ns.clear();
    return status;
  }

 private:
  static constexpr double in_the_air_m = 3;
  static constexpr int patience = 12;  ///< inertial samples: a frame of the radio comes every 9 ms

  struct Run {
    std::int64_t first_ns = never_ns;
    std::uint64_t commands = 0, blind = 0;
    double sticks = 0;
    int pilots = 0;  ///< inertial samples in which the pilot has had it, without a break
    std::array<std::array<double, 4>, patience> held{};  ///< the latest positions of the sticks
  };

  void read_script(const Params& p) {
    script_.arm_at = p.arm_at;
    script_.override = {p.pilot_from, p.pilot_until};
    script_.mute = {p.gap_from, p.gap_until};
    script_.no_fix = {p.no_fix_from, p.no_fix_until};
    script_.gnss_silent = {p.gnss_silent_from, p.gnss_silent_until};
    script_.rc_silent = {p.rc_silent_from, p.rc_silent_until};
    script_.rc_lost = {p.rc_lost_from, p.rc_lost_until};
    script_.gesture = p.manual;
    script_.aux = {p.aux1, p.aux2, p.aux3};
    fails_ = p.fails;
    failing_ = {p.fails_from, p.fails_until};
    pilot_throttle_ = p.pilot_throttle;
    pilot_lands_ = p.pilot_lands;
    script_.mag = p.mag;
    script_.baro = p.baro;
    script_.pitot = p.pitot;
    script_.moved_at = p.moved_at;
    const Eigen::Vector3d accel = eigen(p.moved_accel.value), gyro = eigen(p.moved_gyro.value);
    script_.moved_accel = {accel.x(), accel.y(), accel.z()};
    script_.moved_gyro = {gyro.x(), gyro.y(), gyro.z()};
    script_.levels = true;
    pilot_height_m_ = p.pilot_height;
    pilot_.emplace(script_, plane_->airframe(), plane_->plant().air().density_kgm3);
  }

  /// The parameters of control_manual's README.
  void set_up_manual() {
    peer::Params& board = wire_->fcu.params();
    board.set(peer::param("RC_ARM_CHN"), -1);
    board.set(peer::param("RC_ATT_OVRD_CHN"), 7);
    board.set(peer::param("RC_THR_OVRD_CHN"), 7);
    board.set(peer::param("RC_OVRD_DEV"), 1.5f);
    wire_->fcu.write_flash();
    wire_->fcu.reboot(0);
  }

  double script_s() const {
    return run_.first_ns == never_ns ? -1 : 1e-9 * static_cast<double>(wire_->now_ns - run_.first_ns);
  }
  bool host_flies() const {
    const peer::Firmware& f = wire_->fcu;
    return f.state() == peer::FlightState::armed && f.offboard() && f.override_reasons() == 0;
  }

  /// With each inertial sample: the script, and the pilot.
  void act() {
    peer::Inputs& in = wire_->fcu.inputs;
    const double t = script_s();
    peer::fail(script_, t, in);
    failure_.act(fails_, failing_.holds(t), in);
    wire_->cut = script_.mute.holds(t);
    watch_sticks(in);
    pilot_->act(in, t, false);
    const RigidBody& x = plane_->plant().state();
    if (host_flies()) {
      if (script_.aux[1] > 0.5) pilot_->weave(in, x, t, 70, script_.aux[2] <= -0.5);
      return;
    }
    const bool takes_off = pilot_height_m_ > 0 && wire_->fcu.armed();
    const bool flies = takes_off || plane_->height_m() > in_the_air_m;
    if (pilot_lands_ && script_.override.holds(t))
      pilot_->land(in, x, plane_->plant().air_velocity_b().norm(), world_.heading_rad);
    else if (script_.levels && flies)
      pilot_->hold_level(in, x, pilot_height_m_);
    if (pilot_throttle_ >= 0 && flies && script_.override.holds(t))
      in.rc_us[2] = static_cast<std::uint16_t>(1000 + std::lround(1000 * pilot_throttle_));
  }

  /// The side in control has it through its sticks of a moment ago.
  void watch_sticks(const peer::Inputs& in) {
    const peer::Firmware& f = wire_->fcu;
    std::rotate(run_.held.begin(), run_.held.end() - 1, run_.held.end());
    run_.held[0] = {(in.rc_us[2] - 1000) / 1000.0, (in.rc_us[0] - 1500) / 500.0, (in.rc_us[1] - 1500) / 500.0,
                    (in.rc_us[3] - 1500) / 500.0};
    const bool his = f.state() == peer::FlightState::armed && f.override_reasons() != 0;
    run_.pilots = his ? run_.pilots + 1 : 0;
    if (run_.pilots < patience) return;
    const peer::Deflected d = f.deflected();
    double nearest = 1e9;
    for (const auto& s : run_.held)
      nearest = std::min(nearest, std::max({std::abs(d.throttle - s[0]), std::abs(d.aileron - s[1]),
                                            std::abs(d.elevator - s[2]), std::abs(d.rudder - s[3])}));
    run_.sticks = std::max(run_.sticks, nearest);
  }

  VehicleState truth() const {
    const RigidBody& x = plane_->plant().state();
    const Euler e = euler_from(x.q_nb);
    VehicleState s;
    s.position_m = from_eigen<Ned>(x.p_n);
    s.velocity_mps = from_eigen<Ned>(x.v_n);
    s.attitude = from_eigen(x.q_nb);
    s.roll_rad = e.roll_rad;
    s.pitch_rad = e.pitch_rad;
    s.yaw_rad = e.yaw_rad;
    s.height_m = -x.p_n.z();
    s.climb_rate_mps = -x.v_n.z();
    s.ground_speed_mps = std::hypot(x.v_n.x(), x.v_n.y());
    s.course_rad = s.ground_speed_mps > 0.1 ? std::atan2(x.v_n.y(), x.v_n.x()) : s.yaw_rad;
    s.airspeed_mps = plane_->plant().air_velocity_b().norm();
    s.wind_mps = from_eigen<Ned>(plane_->plant().wind_n());
    s.origin_latitude_deg = world_.latitude_deg;
    s.origin_longitude_deg = world_.longitude_deg;
    s.origin_altitude_m = world_.altitude_m;
    s.wind_valid = s.origin_valid = s.attitude_valid = s.velocity_valid = s.position_valid = s.height_valid =
        s.airspeed_valid = true;
    return s;
  }

  std::uint64_t seed_;
  peer::World world_;
  std::optional<World> wire_;
  std::optional<peer::Airplane> plane_;
  std::optional<peer::Pilot> pilot_;
  std::optional<Inner> inner_;
  Inner::Params inner_params_;
  peer::Script script_;
  peer::SensorFailure failure_;
  peer::Failing fails_ = peer::Failing::none;
  peer::Span failing_;
  double pilot_height_m_ = 0, pilot_throttle_ = -1;
  bool pilot_lands_ = false;
  Run run_;
};

}  // namespace fulmar::fcu::testing

FULMAR_PLUGIN("1.0.0", fulmar::fcu::testing::VirtualController)
