// SPDX-License-Identifier: BSD-3-Clause
#include "tools/fulmar_fcu/preflight.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>

#include "core/graph/record.hpp"
#include "core/loader/table.hpp"
#include "plugins/fcu_serial/firmware_version.hpp"
#include "plugins/fcu_serial/pitot_zero.hpp"
#include "tools/fulmar_fcu/messages.hpp"
#include "tools/fulmar_fcu/mixer.hpp"
#include "tools/fulmar_fcu/radio.hpp"
#include "tools/fulmar_fcu/words.hpp"

namespace fulmar::fcu {

namespace {

/// The facts and the growing list of results.
struct Judge {
  const Facts& f;
  std::vector<Item> items;

  void add(Verdict verdict, const std::string& name, const std::string& text) {
    items.push_back({verdict, name, text});
  }
  void ok(const std::string& name, const std::string& text) { add(Verdict::ok, name, text); }
  void warn(const std::string& name, const std::string& text) { add(Verdict::warn, name, text); }
  void fail(const std::string& name, const Diagnostic& text) { add(Verdict::fail, name, text); }

  double value(const std::string& name) const {
    const auto it =
        std::find_if(f.params.begin(), f.params.end(), [&](const Param& p) { return p.name == name; });
    return it == f.params.end() ? 0 : it->number();
  }
  int whole(const std::string& name) const { return static_cast<int>(value(name)); }
  bool all_zero(const std::vector<std::string>& names) const {
    return std::all_of(names.begin(), names.end(), [&](const std::string& n) { return value(n) == 0; });
  }
};

void firmware(Judge& j) {
  if (j.f.version.empty() && j.f.status.armed == 0)
    j.warn("firmware", fcu_messages::version_withheld());
  else if (j.f.version.empty())
    j.add(Verdict::note, "firmware", "it refuses to tell its version, as it does while armed");
  else if (tried(j.f.version))
    j.ok("firmware", fcu_messages::firmware_tested(j.f.version));
  else
    j.warn("firmware", fcu_messages::firmware_untested(j.f.version, tried_firmware));
  if (j.f.status.armed != 0)
    j.fail("disarmed", fcu_messages::controller_armed());
  else
    j.ok("disarmed", "yes");
  if (const auto words = error_words(j.f.status.error_code); !words.empty())
    j.fail("errors", fulmar::located(core::join(words), fcu_messages::arming_blocked()));
  else
    j.ok("errors", "none");
  if (j.f.status.num_errors > 0) j.warn("sensors", fcu_messages::sensors_not_started(j.f.status.num_errors));
}

/// At rest the means are gravity and zero rotation: the biases belong to this unit and are still valid.
void rest(Judge& j, const Rest& r) {
  constexpr double deg = 180 / std::numbers::pi, gravity = 9.80665;
  const double off = std::fabs(r.gravity_mps2 - gravity);
  if (r.accel_rms_mps2 > 1 || r.gyro_rms_rps * deg > 5)
    return j.warn(
        "IMU", fcu_messages::aircraft_in_motion(fixed(r.accel_rms_mps2, 1), fixed(r.gyro_rms_rps * deg, 0)));
  if (off > 0.15)
    j.add(off > 0.5 ? Verdict::fail : Verdict::warn, "IMU",
          fcu_messages::gravity_implausible(fixed(r.gravity_mps2, 2)));
  if (r.turn_rps * deg > 0.5)
    j.add(r.turn_rps * deg > 3 ? Verdict::fail : Verdict::warn, "IMU",
          fcu_messages::rotation_at_rest(fixed(r.turn_rps * deg, 2)));
  if (off <= 0.15 && r.turn_rps * deg <= 0.5)
    j.ok("IMU", fcu_messages::imu_calibrated(fixed(r.gravity_mps2, 2), fixed(r.turn_rps * deg, 2)));
}

void inertial(Judge& j) {
  const bool no_accel = j.all_zero({"ACC_X_BIAS", "ACC_Y_BIAS", "ACC_Z_BIAS"}),
             no_gyro = j.all_zero({"GYRO_X_BIAS", "GYRO_Y_BIAS", "GYRO_Z_BIAS"});
  const Diagnostic redo = fcu_messages::imu_not_calibrated();
  if ((no_accel && no_gyro) || (j.f.status.error_code & error_uncalibrated_imu) != 0)
    j.fail("IMU", redo);
  else if (no_accel)  // the state after a failed calibration
    j.fail("IMU",
           fulmar::located(fcu_messages::biases_zero("ACC_X_BIAS, ACC_Y_BIAS and ACC_Z_BIAS").text, redo));
  else if (no_gyro && j.whole("ARM_CAL_GYRO") == 0)
    j.fail("IMU",
           fulmar::located(fcu_messages::biases_zero("GYRO_X_BIAS, GYRO_Y_BIAS and GYRO_Z_BIAS").text, redo));
  else if (j.f.rest)
    rest(j, *j.f.rest);
}

void calibration(Judge& j) {
  inertial(j);
  if (j.f.attitude && !finite(*j.f.attitude)) j.fail("attitude", fcu_messages::attitude_not_finite());
  bool plain = j.all_zero({"MAG_X_BIAS", "MAG_Y_BIAS", "MAG_Z_BIAS"});
  for (const char* d : {"MAG_CAL_A00", "MAG_CAL_A11", "MAG_CAL_A22"}) plain = plain && j.value(d) == 1;
  if (j.f.mag_hz == 0)
    j.warn("magnetometer", fcu_messages::heading_sensor_silent());
  else if (plain)
    j.warn("magnetometer", fcu_messages::magnetometer_not_calibrated());
  else
    j.ok("magnetometer", "calibrated");
  if (j.f.uptime_s < 12) j.warn("zeroing", fcu_messages::zeroing_in_progress(fixed(j.f.uptime_s, 0)));
  const double zero = j.value(std::string(pitot_zero));
  if (!(std::fabs(zero) <= pitot_zero_limit_pa))
    j.warn("airspeed", fcu_messages::pitot_zero_implausible(fixed(zero, 0)));
  if (j.f.pitot_hz == 0)
    j.warn("airspeed", fcu_messages::airspeed_sensor_silent());
  else if (j.f.pitot && std::fabs(j.f.pitot->velocity) > 5)
    j.warn("airspeed", fcu_messages::airspeed_at_rest(fixed(j.f.pitot->velocity, 1)));
  else if (j.f.pitot)
    j.ok("airspeed", fixed(j.f.pitot->velocity, 1) + " m/s");
  if (j.f.baro_hz == 0)
    j.fail("barometer", fcu_messages::barometer_silent());
  else
    j.ok("barometer", "heard");
}

void mixing(Judge& j) {
  if (j.whole("FIXED_WING") != 1)
    j.fail("aircraft", fcu_messages::multirotor_configured());
  else
    j.ok("aircraft", "fixed wing");
  const Mixer mixer = mixer_of(j.f.params);
  const auto faults = mixer_faults(mixer), remarks = mixer_remarks(mixer);
  for (const std::string& fault : faults) j.fail("mixer", fault);
  for (const std::string& remark : remarks) j.warn("mixer", remark);
  if (faults.empty() && remarks.empty()) j.ok("mixer", mixer_name(mixer.choice));
  if (const int axis = j.whole("RC_F_AXIS"); axis != 0)
    j.fail("throttle axis", fcu_messages::throttle_axis_invalid(axis));
  for (const char* name : {"X_EQ_TORQUE", "Y_EQ_TORQUE", "Z_EQ_TORQUE"})
    if (std::fabs(j.value(name)) > 0.3)
      j.warn("trim", fcu_messages::trim_too_large(name, fixed(j.value(name), 2)));
}

void reversal(Judge& j) {
  if (!j.f.airframe) {
    j.add(Verdict::note, "reversals", "not compared: add --airframe FILE");
    return;
  }
  const auto one = [&](const char* surface, const char* param, bool reversed) {
    const bool firmware = j.whole(param) != 0;
    const std::string name = surface;
    if (firmware && reversed)
      j.fail("reversals", fcu_messages::surface_reversed_twice(param, name));
    else if (reversed)
      j.warn("reversals", fcu_messages::reversal_in_file(name, param));
    else
      j.ok("reversals",
           name + (firmware ? ": reversed by the firmware, for pilot and computer" : ": not reversed"));
  };
  one("aileron", "REV_AILERON", j.f.airframe->aileron.reversed);
  one("elevator", "REV_ELEVATOR", j.f.airframe->elevator.reversed);
  one("rudder", "REV_RUDDER", j.f.airframe->rudder.reversed);
}

void timeouts(Judge& j) {
  const int timeout = j.whole("OFFBOARD_TIMEOUT");
  const std::string text = "OFFBOARD_TIMEOUT is " + std::to_string(timeout) + " ms";
  if (timeout <= 50)
    j.fail("time-out", fulmar::located(text, fcu_messages::timeout_too_short()));
  else if (timeout > 500)
    j.warn("time-out", fulmar::located(text, fcu_messages::timeout_too_long()));
  else
    j.ok("time-out", text);
  const double thr = j.value("FAILSAFE_THR");
  if (thr > 0)
    j.add(Verdict::note, "failsafe",
          "FAILSAFE_THR is " + fixed(thr, 2) +
              ", but without radio a fixed wing gets throttle 0 and centred surfaces all the same");
  else
    j.ok("failsafe", "without radio: throttle 0, surfaces centred");
}

void radio(Judge& j) {
  const RadioMap map = radio_map(j.f.params);
  if (j.f.rc_hz == 0) return j.fail("radio", fcu_messages::radio_frames_absent());
  if (j.f.rc_hz < 40)
    j.warn("radio", fcu_messages::radio_rate_low(fixed(j.f.rc_hz, 0)));
  else
    j.ok("radio", fixed(j.f.rc_hz, 0) + " frames a second");
  for (const std::string& fault : map_faults(map)) j.fail("channels", fault);
  if (map_faults(map).empty()) j.ok("channels", map_words(map));
  if (!j.f.rc || !map_faults(map).empty()) return;
  if (map.on(RadioMap::arm, *j.f.rc)) j.fail("arm switch", fcu_messages::arm_switch_on());
  if (map.on(RadioMap::attitude_override, *j.f.rc))
    j.ok("override switch", "on: the pilot flies");
  else
    j.warn("override switch", fcu_messages::override_switch_off());
  const double stick = map.throttle(*j.f.rc);
  if (stick > j.value("RC_ARM_THRESHOLD"))
    j.warn("throttle stick", fcu_messages::throttle_stick_up(fixed(100 * stick, 0)));
}

void pilot(Judge& j) {
  if (j.whole("TAKE_MIN_THR") != 0)
    j.warn("throttle", fcu_messages::throttle_limited_by_pilot());
  else
    j.ok("throttle", "TAKE_MIN_THR is 0: to arm, the throttle override switch must be on");
  const double dev = j.value("RC_OVRD_DEV");
  if (dev >= 1)
    j.warn("sticks", fcu_messages::stick_override_off(fixed(dev, 2)));
  else
    j.ok("sticks", "more than " + fixed(100 * dev, 0) + " % of stick takes over");
}

void outside(Judge& j) {
  if (!j.f.gnss)
    j.fail("GNSS", fcu_messages::receiver_silent());
  else if (j.f.gnss->fix_type < 3 || j.f.gnss->fix_type == 5)
    j.fail("GNSS", fcu_messages::fix_missing(fix_words(j.f.gnss->fix_type), j.f.gnss->num_sat));
  else if (j.f.gnss->h_acc > 5 || j.f.gnss->num_sat < 6)
    j.warn("GNSS", fcu_messages::fix_inaccurate(fix_words(j.f.gnss->fix_type), j.f.gnss->num_sat,
                                                fixed(j.f.gnss->h_acc, 1)));
  else
    j.ok("GNSS", fix_words(j.f.gnss->fix_type) + ", " + std::to_string(j.f.gnss->num_sat) +
                     " satellites, +-" + fixed(j.f.gnss->h_acc, 1) + " m");
  if (!j.f.battery || j.f.battery->battery_voltage < 1)
    return j.warn("battery", fcu_messages::battery_not_measured());
  const double volt = j.f.battery->battery_voltage;
  if (j.f.airframe && volt < 0.85 * j.f.airframe->propulsion.battery_volt)
    j.fail("battery",
           fcu_messages::battery_low(fixed(volt, 1), fixed(j.f.airframe->propulsion.battery_volt, 1)));
  else
    j.ok("battery", fixed(volt, 1) + " V" +
                        (j.f.uptime_s < 60 ? ", still settling: the controller filters it over 20 s" : ""));
}

void judge_line(Judge& j) {
  if (j.f.imu_hz < 100)
    j.fail("IMU rate", fcu_messages::imu_rate_too_low(fixed(j.f.imu_hz, 0)));
  else if (j.f.imu_hz < 380)
    j.warn("IMU rate", fcu_messages::imu_rate_low(fixed(j.f.imu_hz, 0)));
  else
    j.ok("IMU rate", fixed(j.f.imu_hz, 0) + " Hz");
  j.add(Verdict::note, "other rates",
        "mag " + fixed(j.f.mag_hz, 0) + ", baro " + fixed(j.f.baro_hz, 0) + ", airspeed " +
            fixed(j.f.pitot_hz, 0) + ", status " + fixed(j.f.status_hz, 0) + " Hz");
  const std::string loss = fixed(100 * j.f.loss_ratio, 2) + " % of the frames lost";
  if (j.f.loss_ratio > 0.05)
    j.fail("loss", fulmar::located(loss, fcu_messages::frame_loss_high()));
  else if (j.f.loss_ratio > 0.005)
    j.warn("loss", loss);
  else
    j.ok("loss", loss);
  std::string load = fixed(j.f.bytes_per_s / 1000, 1) + " kB/s";
  // start bit, 8 bits, stop bit
  const double part = j.f.baud > 0 ? j.f.bytes_per_s * 10 / static_cast<double>(j.f.baud) : 0;
  if (j.f.baud > 0) load += ", " + fixed(100 * part, 0) + " % of " + std::to_string(j.f.baud) + " baud";
  if (part > 0.9)
    j.warn("load", fulmar::located(load, fcu_messages::line_load_high()));
  else
    j.ok("load", load);
  if (!j.f.round_trip_s) return j.fail("round trip", fcu_messages::round_trip_missing());
  const std::string trip = fixed(1000 * *j.f.round_trip_s, 2) + " ms";
  if (*j.f.round_trip_s > 0.05)
    j.fail("round trip", fulmar::located(trip, fcu_messages::round_trip_excessive()));
  else if (*j.f.round_trip_s > 0.01)
    j.warn("round trip", fulmar::located(trip, fcu_messages::round_trip_long()));
  else
    j.ok("round trip", trip);
}

/// Means and standard deviations of inertial samples.
class RestMeter {
 public:
  void take(const SmallImu& m) {
    const std::array<double, 6> now{m.xacc, m.yacc, m.zacc, m.xgyro, m.ygyro, m.zgyro};
    for (std::size_t i = 0; i < now.size(); ++i) {
      sum_[i] += now[i];
      squares_[i] += now[i] * now[i];
    }
    ++count_;
  }
  std::optional<Rest> result() const {
    if (count_ == 0) return {};
    const auto length = [&](std::size_t from) {
      double square = 0;
      for (std::size_t i = from; i < from + 3; ++i) square += (sum_[i] / count_) * (sum_[i] / count_);
      return std::sqrt(square);
    };
    const auto scatter = [&](std::size_t from) {
      double all = 0;
      for (std::size_t i = from; i < from + 3; ++i) all += squares_[i] / count_;
      return std::sqrt(std::max(0.0, all - length(from) * length(from)));
    };
    return Rest{length(0), length(3), scatter(0), scatter(3)};
  }

 private:
  std::array<double, 6> sum_{}, squares_{};
  double count_ = 0;
};

}  // namespace

Facts gather(Client& client, std::int64_t baud, std::int64_t listen_ns) {
  Facts f;
  f.version = client.version();
  f.params = read_params(client);
  const Meter meter(client);
  RestMeter still;
  client.on_packet = [&](const Packet& packet) {
    if (packet.is<SmallImu>()) still.take(packet.as<SmallImu>());
  };
  client.pump(listen_ns);
  client.on_packet = nullptr;
  f.rest = still.result();
  f.imu_hz = meter.rate(client, SmallImu::id);
  f.mag_hz = meter.rate(client, SmallMag::id);
  f.baro_hz = meter.rate(client, SmallBaro::id);
  f.pitot_hz = meter.rate(client, DiffPressure::id);
  f.rc_hz = meter.rate(client, RcChannels::id);
  f.status_hz = meter.rate(client, RosflightStatus::id);
  f.bytes_per_s = meter.bytes_per_s(client);
  f.loss_ratio = meter.loss_ratio(client);
  if (const auto ns = client.round_trip_ns()) f.round_trip_s = static_cast<double>(*ns) * 1e-9;
  client.armed();  // requests a fresh status
  f.status = *client.last<RosflightStatus>();
  f.rc = client.last<RcChannels>();
  if (client.age_s<RosflightGnss>() < 2) f.gnss = client.last<RosflightGnss>();
  f.battery = client.last<RosflightBatteryStatus>();
  f.pitot = client.last<DiffPressure>();
  f.attitude = client.last<AttitudeQuaternion>();
  if (const auto imu = client.last<SmallImu>()) f.uptime_s = static_cast<double>(imu->time_boot_us) * 1e-6;
  f.baud = client.name().rfind("udp:", 0) == 0 ? 0 : baud;
  return f;
}

std::vector<Item> judge(const Facts& facts) {
  Judge j{facts, {}};
  firmware(j);
  calibration(j);
  mixing(j);
  reversal(j);
  timeouts(j);
  radio(j);
  pilot(j);
  outside(j);
  judge_line(j);
  j.add(Verdict::note, "parameters",
        "whether they are all written cannot be asked: 'fulmar fcu params write' makes sure");
  return j.items;
}

std::string items_text(const std::vector<Item>& items) {
  static constexpr std::array<const char*, 4> words{"OK    ", "note  ", "WARN  ", "FAIL  "};
  std::array<int, 4> count{};
  std::string out;
  for (const Item& item : items) {
    ++count[static_cast<std::size_t>(item.verdict)];
    out += words[static_cast<std::size_t>(item.verdict)] + item.name +
           std::string(item.name.size() < 16 ? 16 - item.name.size() : 1, ' ') + item.text + "\n";
  }
  out += std::to_string(count[3]) + " FAIL, " + std::to_string(count[2]) + " WARN, " +
         std::to_string(count[0]) + " OK: ";
  return out + (count[3] > 0   ? "not ready.\n"
                : count[2] > 0 ? "ready, if the warnings are meant to be so.\n"
                               : "ready.\n");
}

Airframe read_airframe(const std::string& path) {
  core::Report report;
  Airframe out;
  const core::Node root = core::parse_yaml(core::read_source(path, path), report);
  if (report.empty())
    core::fill_record(*core::copy_type(fulmar::describe<Airframe>()), root,
                      reinterpret_cast<std::byte*>(&out), "", report, {"params"});
  report.throw_if_any();
  return out;
}

}  // namespace fulmar::fcu
