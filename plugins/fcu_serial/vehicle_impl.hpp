// SPDX-License-Identifier: BSD-3-Clause
// Greeting of the controller, and processing of each packet.
#pragma once
#include "vehicle.hpp"

namespace fulmar::fcu {

/// Waits for the controller and requests its data. Throws when it cannot be used.
template <class AnyLink>
void Vehicle<AnyLink>::greet(const std::string& port, std::int64_t baud, const Airframe& airframe) {
  Greeting g;
  listen(g);
  if (const std::string fault = objection(g, link_->state(), port, baud); !fault.empty()) {
    link_.reset();
    throw std::runtime_error(fault);
  }
  run_.controller.meet(g);
  run_.book.expect(g.parameter_count);
  if (g.versioned)
    run_.notices.add(fulmar::Severity::info, fcu_serial_messages::connected, std::string_view(g.version));
  else
    run_.notices.add(fulmar::Severity::info, fcu_serial_messages::connected_armed);
  if (g.versioned) report_untried(g.version);
  run_.pitot.take_zero(g.parameter(pitot_zero, 0), run_.heard.status.armed != 0, run_.notices);
  report_reversals(g, airframe);
}

template <class AnyLink>
void Vehicle<AnyLink>::listen(Greeting& g) {
  const std::int64_t begun_ns = link_->now_ns();
  std::int64_t first_ns = never_ns, asked_ns = never_ns;
  while (!g.complete()) {
    const std::int64_t now_ns = link_->now_ns();
    if (now_ns - begun_ns > (first_ns == never_ns ? silence_patience_ns : greeting_patience_ns)) break;
    if (first_ns == never_ns && now_ns - begun_ns > noise_patience_ns && link_->state().bytes > noise_bytes)
      break;
    if (first_ns != never_ns && now_ns - first_ns > answer_patience_ns) break;
    if (g.versioned && major_version(g.version).value_or(oldest_firmware) < oldest_firmware) break;
    if (!g.versioned && now_ns - asked_ns > 300'000'000) {
      link_->send(RosflightCmd{static_cast<std::uint8_t>(Command::send_version)});
      asked_ns = now_ns;
    }
    link_->wait_imu(now_ns + wait_ns);
    Received r;
    while (link_->pop(r)) {
      if (r.event != LinkEvent::packet) continue;
      if (first_ns == never_ns) first_ns = r.arrived_ns;
      g.take(r.packet);
      if (r.packet.template is<Statustext>())
        run_.texts.forward(r.packet.template as<Statustext>(), r.arrived_ns, run_.notices);
    }
  }
}

template <class AnyLink>
void Vehicle<AnyLink>::report_untried(std::string_view version) {
  if (!tried(version))
    run_.notices.add(fulmar::Severity::warning, fcu_serial_messages::firmware_untried, tried_firmware,
                     version);
}

/// REV_* reverses a surface for pilot and host, the airframe file for the host alone. Both together are
/// probably an error.
template <class AnyLink>
void Vehicle<AnyLink>::report_reversals(const Greeting& g, const Airframe& a) {
  const std::array<std::pair<const char*, bool>, 3> surfaces{{{"REV_AILERON", a.aileron.reversed},
                                                              {"REV_ELEVATOR", a.elevator.reversed},
                                                              {"REV_RUDDER", a.rudder.reversed}}};
  for (const auto& [name, reversed] : surfaces) {
    if (!reversed || g.parameter(name) <= 0) continue;
    run_.notices.add(fulmar::Severity::warning, fcu_serial_messages::reversed_twice, name);
  }
}

template <class AnyLink>
void Vehicle<AnyLink>::take(const Received& r, Outputs& out) {
  switch (r.packet.id) {
    case SmallMag::id:
      return publish(out.mag, to_mag(r.packet.template as<SmallMag>()), r, kind_mag, "magnetometer");
    case SmallBaro::id:
      return publish(out.baro, to_baro(r.packet.template as<SmallBaro>()), r, kind_baro, "barometer");
    case DiffPressure::id:
      if (run_.pitot.used())
        publish(out.pitot, to_pitot(r.packet.template as<DiffPressure>()), r, kind_pitot, "pitot tube");
      return;
    case SmallRange::id:
      return publish(out.range, to_range(r.packet.template as<SmallRange>()), r, kind_other, "range finder");
    case AttitudeQuaternion::id:
      if (!run_.samples.attitude(run_.clock.now_ns())) return;
      return publish(out.attitude, to_attitude(r.packet.template as<AttitudeQuaternion>()), r, kind_other,
                     "controller's estimator");
    case RosflightOutputRaw::id:
      return publish(out.outputs, to_outputs(r.packet.template as<RosflightOutputRaw>()), r, kind_other,
                     "mixer");
    case RosflightGnss::id: return take_gnss(r, out);
    default: return take_state(r, out);
  }
}

template <class AnyLink>
void Vehicle<AnyLink>::take_gnss(const Received& r, Outputs& out) {
  const auto message = r.packet.template as<RosflightGnss>();
  if (run_.samples.same_fix(message.rosflight_timestamp)) return;
  publish(out.gnss, to_gnss(message), r, kind_gnss, "satellite receiver");
}

template <class AnyLink>
void Vehicle<AnyLink>::take_state(const Received& r, Outputs& out) {
  const std::int64_t arrived_ns = flight_ns(r.arrived_ns);
  Heard& heard = run_.heard;
  switch (r.packet.id) {
    case RosflightStatus::id: {
      const bool was_armed = heard.status.armed != 0;
      heard.status = r.packet.template as<RosflightStatus>();
      heard.status_ns = arrived_ns;
      if (was_armed && heard.status.armed == 0) run_.disarmed_ns = arrived_ns;
      return;
    }
    case RcChannels::id:
      heard.rc(arrived_ns);
      run_.rc = to_rc(r.packet.template as<RcChannels>(), run_.controller.map(), run_.throws,
                      (heard.status.error_code & error_rc_lost) == 0);
      return out.rc.publish(run_.rc, flight_ns(std::min(r.valid_at_ns, r.arrived_ns)));
    case RosflightBatteryStatus::id: {
      const auto battery = r.packet.template as<RosflightBatteryStatus>();
      if (!usable(within(1e3, battery.battery_voltage, battery.battery_current), kind_other,
                  "battery monitor"))
        return;
      heard.volt = battery.battery_voltage;
      heard.amp = battery.battery_current;
      return;
    }
    case ParamValue::id: return take_parameter(r.packet.template as<ParamValue>(), out);
    case RosflightVersion::id: return take_version(r.packet.template as<RosflightVersion>());
    case Statustext::id:
      return run_.texts.forward(r.packet.template as<Statustext>(), r.arrived_ns, run_.notices);
    case RosflightHardError::id: {
      const auto error = r.packet.template as<RosflightHardError>();
      return run_.notices.add(fulmar::Severity::critical, fcu_serial_messages::controller_crashed,
                              error.reset_count, error.error_code, error.pc);
    }
    default: return;
  }
}

/// Parameters arrive after each reboot and connection, and whenever one is set.
template <class AnyLink>
void Vehicle<AnyLink>::take_parameter(const ParamValue& p, Outputs& out) {
  const auto& full = out.parameters;
  if (full.count == full.items.size())
    run_.book.forget(p.param_index);
  else if (const auto news = run_.book.take(p))
    out.parameters.push(*news, run_.clock.now_ns());
  const auto change = run_.controller.take(p);
  if (!change) return;
  if (change->name == pitot_zero)
    return run_.pitot.take_zero(change->value, run_.heard.status.armed != 0, run_.notices);
  if (change->known)
    run_.notices.add(fulmar::Severity::warning, fcu_serial_messages::param_changed, change->name,
                     change->value);
}

template <class AnyLink>
void Vehicle<AnyLink>::take_version(const RosflightVersion& m) {
  const Text<50> version(std::string_view(
      m.version.data(),
      static_cast<std::size_t>(std::find(m.version.begin(), m.version.end(), '\0') - m.version.begin())));
  if (!run_.controller.other_version(version)) return;
  run_.notices.add(fulmar::Severity::warning, fcu_serial_messages::firmware_changed, version.view());
  report_untried(version.view());
}

}  // namespace fulmar::fcu
