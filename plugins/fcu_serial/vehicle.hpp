// SPDX-License-Identifier: BSD-3-Clause
// The vehicle on a ROSflight flight controller: receives sensors, sends commands, and reports the
// controller's status.
#pragma once
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <type_traits>

#include "commands.hpp"
#include "controller.hpp"
#include "flight_clock.hpp"
#include "fulmar/msg/ground_state.hpp"
#include "fulmar/msg/path.hpp"
#include "fulmar/msg/vehicle_state.hpp"
#include "fulmar/plugin.hpp"
#include "greeting.hpp"
#include "link/port.hpp"
#include "link_report.hpp"
#include "overload.hpp"
#include "pace.hpp"
#include "parameter_book.hpp"
#include "pitot_use.hpp"
#include "readiness.hpp"
#include "sample_gate.hpp"
#include "sensors.hpp"

namespace fulmar::fcu {

/// `AnyLink` is Link, or in tests a link with a simulated clock.
template <class AnyLink>
class Vehicle {
 public:
  static constexpr const char* doc = "A flight controller with ROSflight 2, on a serial port or over UDP.";
  struct Inputs {
    Optional<Actuators> actuators;
    Optional<AuxOutputs> aux;
    Optional<VehicleState> state;
    Optional<Path> path;
    Optional<GroundState> ground;  // keeps the throttle closed after a landing
  };
  struct Outputs {
    Out<Imu> imu;
    Out<Gnss> gnss;
    Out<Mag> mag;
    Out<Baro> baro;
    Out<Pitot> pitot;
    Out<Rc> rc;
    Out<VehicleStatus> status;
    OutQueue<Notice, 32> notices;
    Out<Range> range;
    Out<ControllerAttitude> attitude;
    Out<ControllerOutputs> outputs;
    Out<LinkStatus> link;
    OutQueue<ControllerParameter, 16> parameters;
  };
  struct Params {
    TextParam<128> port{"/dev/ttyACM0", "serial port, or udp:REMOTE:PORT of simulated firmware"};
    Count baud{921600, 1200, 12000000, "bit rate; not used by a USB port", setup};
    Record<Airframe> airframe{"airframe with the throws and directions of the surfaces", required};
    Param command_rate{400, "Hz", 50, 1000, "largest rate of commands; each has 51 bytes", setup};
    Flag send_attitude{
        false,
        "switch for the attitude of the input `state` that corrects the controller's estimate at 50 Hz"};
    Flag needs_state{false, "switch for the need of the input `state`: no command without it", setup};
    Flag needs_path{false, "switch for the need of the input `path`: not ready without it", setup};
    Param pitot_zero_limit{
        pitot_zero_limit_pa, "Pa", 0, 1000, "largest zero offset of the pitot that is accepted", setup};
    Count pitot_zeroed{0, 0, 1,
                       "record of an airspeed zeroed by a reboot in flight, for `resume`; 1: pitot not used"};
    Param time_scale{1,
                     "ratio",
                     0.1,
                     100,
                     "ratio of flight time to wall clock, for a simulated controller with a faster clock",
                     setup};
  };

  void configure(const Params& p) {
    const std::string port(p.port.view());
    if (port.empty()) throw std::runtime_error(fcu_serial_messages::port_unset());
    run_ = Run();
    run_.throws = Throws::of(*p.airframe);
    run_.pace = Pace(p.command_rate);
    run_.pitot = PitotUse(p.pitot_zero_limit);
    link_.reset();  // for a second flight: the port is held until then
    LinkOptions options;
    options.port = port;
    options.baud = p.baud;
    options.time_scale = p.time_scale;
    options.watched.assign(watched_parameters.begin(), watched_parameters.end());
    try {
      link_ = std::make_unique<AnyLink>(options);
    } catch (const PortError& fault) {
      throw PortError(fulmar::located("port", fault.diagnostic));
    }
    greet(port, p.baud, *p.airframe);
  }

  /// Returns with each inertial sample, and after 10 ms without one.
  Status read(Tick& tick, const Params& p, Outputs& out) {
    if (!run_.clock.begun()) begin();
    if (p.pitot_zeroed != 0) run_.pitot.zeroed_in_the_air(run_.notices);
    const std::int64_t arrived_ns = wait(out), host_ns = link_->now_ns();
    const std::int64_t since_ns = run_.clock.tick(arrived_ns, host_ns);
    if (since_ns > stood_still_ns)
      run_.notices.add(fulmar::Severity::critical, fcu_serial_messages::stood_still, tenths_s(since_ns));
    if (since_ns > missed_ns) run_.heard.resumed_ns = flight_ns(host_ns);
    tick.now_ns = run_.clock.now_ns();
    last_frame_.fd = link_->descriptor();
    return report(host_ns, out);
  }

  Status write(const Tick& tick, const Inputs& in, const Params& p) {
    run_.met_state = run_.met_state || in.state;
    if (run_.met_state && !in.state && !in.actuators)
      return Status::ok;  // the host was paused, and has reported it
    const bool locked = in.ground && in.ground->throttle_locked;
    if (may_command(tick.now_ns, in, p)) send_command(tick.now_ns, in.actuators, locked);
    send_aux(tick.now_ns, in.aux);
    if (p.send_attitude) send_attitude(tick.now_ns, in.state);
    return Status::ok;
  }

  const fulmar_last_frame* last_frame(const Inputs& failsafe) {
    const auto command = failsafe.actuators ? to_offboard(*failsafe.actuators, run_.throws) : std::nullopt;
    if (!command) return nullptr;
    const Frame frame = encode(*command, 0);
    std::copy(frame.view().begin(), frame.view().end(), last_frame_.data);
    last_frame_.size = static_cast<std::uint32_t>(frame.size);
    last_frame_.fd = link_ ? link_->descriptor() : -1;
    return &last_frame_;
  }

 private:
  static constexpr std::int64_t wait_ns = 10'000'000;
  static constexpr std::int64_t backlog_ns = 50'000'000;  ///< older samples are not used
  static constexpr std::int64_t stood_still_ns =
      300'000'000;  ///< between two ticks, which wait for at most 10 ms
  static constexpr std::int64_t missed_ns =
      100'000'000;  ///< likewise: the silence during a longer pause is unknown
  static constexpr std::int64_t reboot_memory_ns = 1'000'000'000;
  enum Kind : std::uint32_t {
    kind_imu = 1,
    kind_mag = 2,
    kind_baro = 4,
    kind_pitot = 8,
    kind_gnss = 16,
    kind_other = 32,
    kind_command = 64,
    kind_aux = 128
  };

  /// State of one flight. Times are flight time.
  struct Run {
    Throws throws;
    Pace pace;
    AuxPace aux;
    AttitudePace attitude;
    FlightClock clock;
    Controller controller;
    ParameterBook book;
    SampleGate samples;
    PitotUse pitot;
    ReportedKinds reported;
    Heard heard;
    Reporter reporter;
    Notices notices;
    Forwarder texts;
    LinkReport report;
    Readiness readiness;
    FixWatch fixes;
    Overload overload;
    Spoken spoken;
    StatusPace status;
    Rc rc;
    std::int64_t disarmed_ns = never_ns;
    bool met_state = false;
  };

  std::int64_t flight_ns(std::int64_t host_ns) const { return run_.clock.flight_ns(host_ns); }

  void greet(const std::string& port, std::int64_t baud, const Airframe& airframe);
  void listen(Greeting& greeting);
  void report_untried(std::string_view version);
  void report_reversals(const Greeting& greeting, const Airframe& airframe);

  /// At the first tick: data from the time of the greeting are dropped.
  void begin() {
    Received r;
    while (link_->pop(r))
      if (r.event == LinkEvent::packet && r.packet.template is<Statustext>())
        run_.texts.forward(r.packet.template as<Statustext>(), r.arrived_ns, run_.notices);
    link_->wait_imu(link_->now_ns() + wait_ns);
    run_.clock.begin(link_->now_ns());
  }

  /// Waits for a usable inertial sample, or 10 ms. Returns its arrival in host time, or never.
  std::int64_t wait(Outputs& out) {
    const std::int64_t until_ns = link_->now_ns() + wait_ns;
    while (true) {
      const bool sample = link_->wait_imu(until_ns);
      const std::int64_t arrived_ns = drain(out);
      if (arrived_ns != never_ns || !sample || link_->now_ns() >= until_ns) return arrived_ns;
    }
  }

  /// Takes all events up to and with the next inertial sample. Returns its arrival in host time, or never.
  std::int64_t drain(Outputs& out) {
    Received r;
    while (link_->pop(r)) {
      if (r.event == LinkEvent::rebooted) rebooted();
      if (r.event == LinkEvent::rebooted || r.event == LinkEvent::connected) ask_anew();
      if (r.event != LinkEvent::packet) continue;
      run_.heard.frame(flight_ns(r.arrived_ns));
      if (!r.packet.template is<SmallImu>())
        take(r, out);
      else if (take_imu(r, out))
        return r.arrived_ns;
    }
    return never_ns;
  }

  bool take_imu(const Received& r, Outputs& out) {
    const std::int64_t valid_ns = std::min(r.valid_at_ns, r.arrived_ns);
    const bool too_old = link_->now_ns() - r.arrived_ns > backlog_ns;
    run_.overload.sample(too_old);
    if (!run_.samples.newer_imu(valid_ns) || too_old) return false;
    const auto imu = to_imu(r.packet.template as<SmallImu>());
    if (!usable(imu.has_value(), kind_imu, "inertial unit")) return false;
    run_.samples.imu(valid_ns);
    run_.controller.packet_from(r.packet.system, r.packet.template as<SmallImu>().time_boot_us);
    run_.report.imu(valid_ns);
    run_.heard.imu_ns = flight_ns(r.arrived_ns);
    out.imu.publish(*imu, flight_ns(valid_ns));
    return true;
  }

  void take(const Received& r, Outputs& out);
  void take_state(const Received& r, Outputs& out);
  void take_gnss(const Received& r, Outputs& out);
  void take_parameter(const ParamValue& p, Outputs& out);
  void take_version(const RosflightVersion& m);

  template <class T>
  void publish(Out<T>& port, const std::optional<T>& value, const Received& r, Kind kind, const char* name) {
    if (!usable(value.has_value(), kind, name)) return;
    port.publish(*value, flight_ns(std::min(r.valid_at_ns, r.arrived_ns)));
    const std::int64_t arrived_ns = flight_ns(r.arrived_ns);
    if constexpr (std::is_same_v<T, Gnss>) {
      if (solved(value->fix)) run_.spoken.fix_ns = arrived_ns;
    }
    if (kind == kind_mag) run_.spoken.mag_ns = arrived_ns;
    if (kind == kind_baro) run_.spoken.baro_ns = arrived_ns;
    if (kind == kind_pitot) run_.spoken.pitot_ns = arrived_ns;
  }
  bool usable(bool good, Kind kind, const char* name) {
    if (good) return true;
    ++run_.report.unusable;
    if (run_.reported.first(kind))
      run_.notices.add(fulmar::Severity::warning, fcu_serial_messages::values_implausible, name);
    return false;
  }

  /// The controller may be another one. An armed controller does not answer; then it is the same.
  void ask_anew() {
    link_->send(RosflightCmd{static_cast<std::uint8_t>(Command::send_version)});
    run_.book.restart();
  }
  void ask_parameter() {
    const auto index = run_.book.next(run_.clock.now_ns());
    if (index) link_->send(ParamRequestRead{*index, run_.controller.system()});
    run_.book.report(run_.notices);
  }

  void rebooted() {
    const std::int64_t now_ns = run_.clock.now_ns();
    const bool flying = run_.heard.status.armed != 0 || now_ns - run_.disarmed_ns < reboot_memory_ns;
    run_.samples.rebooted(now_ns);
    if (!flying) return run_.notices.add(fulmar::Severity::warning, fcu_serial_messages::rebooted);
    run_.notices.add(fulmar::Severity::critical, fcu_serial_messages::rebooted_armed);
    run_.pitot.zeroed_in_the_air(run_.notices);
  }

  Status report(std::int64_t host_ns, Outputs& out) {
    const std::int64_t now_ns = run_.clock.now_ns();
    run_.heard.open = last_frame_.fd >= 0;
    VehicleStatus s = evaluate(run_.heard, now_ns);
    s.in_control = s.in_control && !run_.readiness.refuses(s);  // the last command is still in force
    run_.reporter.report(s, run_.heard, now_ns, run_.notices);
    run_.overload.report(now_ns, run_.notices);
    run_.fixes.report(run_.spoken.fix_ns, std::max(run_.heard.since_ns, run_.heard.resumed_ns),
                      (s.errors & own_error_link_down) == 0, s.armed, now_ns, run_.notices);
    if (run_.heard.status_ns != never_ns && run_.status.due(s, now_ns)) {
      out.status.publish(s);
      if ((s.errors & own_error_rc_silent) != 0) {
        run_.rc.link = false;
        out.rc.publish(run_.rc);
      }
    }
    if ((s.errors & own_error_link_down) == 0) ask_parameter();
    run_.notices.flush(out.notices, now_ns);
    if (run_.report.due(now_ns)) {
      LinkStatus link = run_.report.take(link_->state(), host_ns, now_ns);
      link.pitot_zeroed = run_.pitot.zeroed();
      out.link.publish(link);
    }
    return (s.errors & own_error_link_down) != 0 ? Status::degraded : Status::ok;
  }

  /// Without a required estimate the gate stays closed.
  bool may_command(std::int64_t now_ns, const Inputs& in, const Params& p) {
    const Optional<VehicleState>& state = in.state;
    if (p.send_attitude && !state && now_ns > estimate_patience_ns * 20)
      run_.attitude.report_unwired(run_.notices);
    if ((!state && !p.needs_state) || run_.heard.status_ns == never_ns) return true;
    const bool current = state && now_ns - state.valid_at_ns() < estimate_patience_ns;
    return run_.readiness.update(
        {current ? &*state : nullptr, run_.status.last(), run_.spoken,
         now_ns - run_.heard.imu_ns < command_patience_ns, run_.pitot.zero(run_.controller.clock_us()),
         in.path || !p.needs_path, run_.fixes.lost()},
        now_ns, run_.notices);
  }

  /// Sends nothing without a command or with one that is not renewed: the controller then hands over to its
  /// pilot.
  void send_command(std::int64_t now_ns, const Optional<Actuators>& actuators, bool throttle_locked) {
    if (!actuators || now_ns - actuators.valid_at_ns() > command_patience_ns ||
        !run_.pace.due(actuators.fresh(), now_ns))
      return;
    Actuators wanted = *actuators;
    if (throttle_locked) wanted.throttle_frac = 0;
    const auto command = to_offboard(wanted, run_.throws);
    if (!command || !link_->send(*command)) {
      ++run_.report.unsent;
      if (!command && run_.reported.first(kind_command))
        run_.notices.add(fulmar::Severity::error, fcu_serial_messages::command_not_finite);
      return;
    }
    run_.pace.sent(now_ns);
    run_.heard.command_ns = now_ns;
    ++run_.report.commands;
    const std::int64_t arrived_ns = run_.clock.arrived_ns();
    if (arrived_ns != never_ns) run_.report.turnaround(link_->now_ns() - arrived_ns);
  }

  void send_aux(std::int64_t now_ns, const Optional<AuxOutputs>& aux) {
    if (!aux || !run_.aux.due(aux.fresh(), now_ns)) return;
    auto command = to_aux(*aux);
    if (!command) {
      if (run_.reported.first(kind_aux))
        run_.notices.add(fulmar::Severity::error, fcu_serial_messages::aux_not_finite);
      return;
    }
    stop_motors(*command, run_.aux.motors);
    link_->send(*command);
  }

  void send_attitude(std::int64_t now_ns, const Optional<VehicleState>& state) {
    if (!state || !state.fresh() || !state->attitude_valid || !run_.attitude.due(now_ns)) return;
    const auto attitude = to_external_attitude(state->attitude);
    if (!attitude) return;
    link_->send(*attitude);
    run_.attitude.sent(now_ns);
  }

  std::unique_ptr<AnyLink> link_;
  Run run_;
  fulmar_last_frame last_frame_{-1, 0, {}};
};

}  // namespace fulmar::fcu

#include "vehicle_impl.hpp"
