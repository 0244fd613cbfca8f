// SPDX-License-Identifier: BSD-3-Clause
// The peer's messages, with the ids and silences of the real ones. Source: ROSflight firmware 2.0.1.
#include "firmware.hpp"

namespace fulmar::fcu::peer {

void Firmware::receive(std::span<const std::uint8_t> bytes, std::int64_t now_us) {
  run(now_us);
  parser_.feed(bytes, [&](const Packet& packet) { handle(packet); });
}

bool Firmware::take(Frame& frame) {
  if (fifo_.empty()) return false;
  frame = fifo_.front();
  fifo_.pop_front();
  return true;
}

std::vector<std::uint8_t> Firmware::take() {
  std::vector<std::uint8_t> bytes;
  Frame f;
  while (take(f))
    bytes.insert(bytes.end(), f.bytes.begin(), f.bytes.begin() + static_cast<std::ptrdiff_t>(f.size));
  return bytes;
}

void Firmware::reboot(std::int64_t now_us) {
  run(now_us);
  boot(now_us, false);
}

void Firmware::crash(std::int64_t now_us) {
  run(now_us);
  hard_error_ = RosflightHardError{3, 0x0800abcd, boots_, armed() ? 1u : 0u};
  boot(now_us, true);
}

void Firmware::handle(const Packet& packet) {
  if (packet.is<Heartbeat>()) {
    connected_ = true;
    if (hard_error_) send(*hard_error_);
    hard_error_.reset();
    return;
  }
  if (packet.is<OffboardControl>()) return handle(packet.as<OffboardControl>());
  if (packet.is<RosflightAuxCmd>()) return handle(packet.as<RosflightAuxCmd>());
  if (packet.is<ExternalAttitude>()) {
    const auto m = packet.as<ExternalAttitude>();
    return attitude_.correct({m.qw, m.qx, m.qy, m.qz});
  }
  if (!options_.answers) return;
  if (packet.is<Timesync>()) {
    const auto m = packet.as<Timesync>();
    if (m.tc1 == 0) send(Timesync{clock_us_ * 1000, m.ts1});
  } else if (packet.is<ParamRequestList>()) {
    if (packet.as<ParamRequestList>().target_system == system()) next_param_ = 0;
  } else if (packet.is<ParamRequestRead>()) {
    handle(packet.as<ParamRequestRead>());
  } else if (packet.is<ParamSet>()) {
    handle(packet.as<ParamSet>());
  } else if (packet.is<RosflightCmd>()) {
    handle(packet.as<RosflightCmd>(), packet.system);
  }
}

void Firmware::handle(const ParamRequestRead& m) {
  if (m.target_system != system()) return;
  const std::size_t id =
      m.param_index >= 0 ? static_cast<std::size_t>(m.param_index) : params_.find(text(m.param_id));
  if (id < param_count) send_param(id);  // else silence
}

void Firmware::handle(const ParamSet& m) {
  if (m.target_system != system()) return;
  const std::size_t id = params_.find(text(m.param_id));
  if (id == param_count || m.param_type != (params_.integer(id) ? param_int32 : param_real32)) return;
  if (params_.integer(id))
    params_.set(id, std::bit_cast<std::int32_t>(m.param_value));
  else
    params_.set(id, std::bit_cast<float>(m.param_value));
}

void Firmware::handle(const OffboardControl& m) {
  if (m.mode > 2) return;
  ++commands_;
  const auto kept = offboard_.u;
  offboard_.mode = static_cast<ControlMode>(m.mode);
  offboard_.stamp_ms = clock_ms();
  for (std::size_t i = 0; i < 10; ++i) {
    offboard_.active[i] = !(m.ignore >> i & 1);
    offboard_.u[i] = offboard_.active[i] || i < 6 ? m.u[i] : kept[i];
  }
}

void Firmware::handle(const RosflightAuxCmd& m) {
  for (const std::uint8_t type : m.type_array)
    if (type > 2) return;
  aux_ = m;
}

void Firmware::handle(const RosflightCmd& m, std::uint8_t from) {
  if (m.command > static_cast<std::uint8_t>(Command::reboot_to_bootloader) &&
      m.command != static_cast<std::uint8_t>(Command::send_version))
    return put(
        encode(RosflightCmdAck{m.command, 0}, sequence_++, from, component));  // the requester's own system
  const auto command = static_cast<Command>(m.command);
  const bool accepted = !armed() && !options_.refuses && run_command(command);
  send(RosflightCmdAck{m.command, accepted ? std::uint8_t{1} : std::uint8_t{0}});
  if (accepted && options_.reboots &&
      (command == Command::reboot || command == Command::reboot_to_bootloader))
    reboot_at_us_ = clock_us_ + 20000;
}

bool Firmware::run_command(Command command) {
  switch (command) {
    case Command::rc_calibration:
      log(Severity::warning, "Use trims for only one axis at a time");
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t id = param("X_EQ_TORQUE") + k;
        params_.set(id, params_.f(id) + static_cast<float>(radio_.stick[k]));
      }
      log(Severity::warning, "Equilibrium torques found and applied");
      return true;
    case Command::accel_calibration:
      start_gyro_calibration();
      accel_calibration_.start();
      for (std::size_t k = 0; k < 3; ++k) params_.set(param("ACC_X_BIAS") + k, 0.f);
      return true;
    case Command::gyro_calibration: start_gyro_calibration(); return true;
    case Command::baro_calibration:
      baro_calibration_.start();
      params_.set(param("BARO_BIAS"), 0.f);
      return true;
    case Command::airspeed_calibration:
      pitot_calibration_.start();
      params_.set(param("DIFF_PRESS_BIAS"), 0.f);
      return true;
    case Command::read_params: params_.load(flash_); return !options_.flash_fails;
    case Command::write_params:
      if (!options_.flash_fails) write_flash();
      return !options_.flash_fails;
    case Command::set_param_defaults: params_.set_defaults(); return true;
    case Command::send_version: send_version(); return true;
    default: return true;
  }
}

void Firmware::send_status() {
  RosflightStatus m;
  m.rc_override = mux_.reasons;
  m.num_errors = inputs.sensor_errors;
  m.loop_time_us = 94;
  m.armed = armed();
  m.failsafe = state_ == FlightState::failsafe;
  m.offboard = offboard_.any();
  m.error_code = errors_;
  m.control_mode = params_.i(param("FIXED_WING")) ? 0 : static_cast<std::uint8_t>(mux_.mode[0]);
  send(m);
}

void Firmware::send_param(std::size_t id) {
  ParamValue m;
  m.param_value = params_.bits(id);
  m.param_count = param_count;
  m.param_index = static_cast<std::uint16_t>(id);
  m.param_id = field<16>(params_.name(id));
  m.param_type = params_.integer(id) ? param_int32 : param_real32;
  send(m, 0);  // not 250
}

/// Copies 50 bytes out of a shorter literal: the bytes after its NUL are undefined.
void Firmware::send_version() {
  RosflightVersion m;
  m.version = field<50>(options_.version);
  for (std::size_t i = options_.version.size() + 1; i < m.version.size(); ++i)
    m.version[i] = static_cast<char>(0x80 + (i * 37 + options_.seed) % 0x7f);
  send(m);
}

void Firmware::log(Severity severity, const std::string& text) {
  if (connected_ && texts_.empty()) return send_text(severity, text, system());
  texts_.push_back({severity, text});
  if (texts_.size() > 25) texts_.pop_front();
}

void Firmware::send_text(Severity severity, const std::string& text, std::uint8_t from) {
  Statustext m;
  m.severity = static_cast<std::uint8_t>(severity);
  m.text = field<50>(text);
  put(encode(m, sequence_++, from, component));
}

}  // namespace fulmar::fcu::peer
