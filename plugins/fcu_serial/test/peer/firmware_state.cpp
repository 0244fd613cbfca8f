// SPDX-License-Identifier: BSD-3-Clause
// The peer's radio, arming, errors and calibrations. Source: ROSflight firmware 2.0.1.
#include <cmath>

#include "firmware.hpp"

namespace fulmar::fcu::peer {

void Firmware::provision(std::int64_t now_us) {
  const auto whole = [&](std::size_t id, std::int32_t v) { params_.set(id, v); };
  whole(param("FIXED_WING"), 1);
  whole(param("PRIMARY_MIXER"), mixer_fixed_wing);
  whole(param("RC_F_AXIS"), 0);
  whole(param("RC_ARM_CHN"), 4);
  whole(param("RC_ATT_OVRD_CHN"), 5);
  whole(param("RC_THR_OVRD_CHN"), 5);
  whole(param("RC_NUM_CHN"), 8);
  whole(param("TAKE_MIN_THR"), 0);
  whole(param("ARM_SPIN_MOTORS"), 0);
  params_.set(param("RC_OVRD_DEV"), 1.f);
  params_.set(param("FAILSAFE_THR"), 0.f);
  params_.set(param("GYRO_X_BIAS"), 1e-6f);  // calibrated: the sensors that a test gives have no bias
  params_.set(param("ACC_X_BIAS"), 1e-6f);
  write_flash();
  boots_ = 0;
  boot(now_us, false);
}

void Firmware::rc_pass() {
  send([&] {
    RcChannels m;
    m.time_boot_ms = static_cast<std::uint32_t>(clock_ms());
    std::memcpy(&m.chan1_raw, inputs.rc_us.data(), sizeof inputs.rc_us);
    return m;
  }());
  const bool lost = inputs.rc_lost || !Radio::sound(params_, inputs.rc_us);
  set_error(error_rc_lost, lost);
  const std::uint16_t before = mux_.reasons;
  if (lost) {
    if (state_ == FlightState::armed) {
      state_ = FlightState::failsafe;
      send_status();
    }
    if (state_ == FlightState::failsafe) {
      std::fill(mux_.u.begin(), mux_.u.begin() + 6, 0.f);
      if (!params_.i(param("FIXED_WING"))) mux_.u[2] = params_.f(param("FAILSAFE_THR"));
      mux_.mode.fill(ControlMode::pass);
    }
    return;
  }
  if (state_ == FlightState::failsafe) {
    state_ = FlightState::armed;
    send_status();
  }
  radio_.decode(params_, inputs.rc_us);
  look_for_arming();
  mux_.run(params_, radio_, offboard_, clock_ms());
  if (mux_.reasons != before) send_status();
}

void Firmware::look_for_arming() {
  const std::int64_t dt = clock_ms() - last_rc_ms_;
  last_rc_ms_ = clock_ms();
  if (radio_.mapped[Radio::arm]) {
    if (!radio_.on[Radio::arm])
      disarm();
    else if (!armed())
      request_arm();
    return;
  }
  const double threshold = params_.f(param("RC_ARM_THRESHOLD")),
               side = armed() ? -radio_.stick[2] : radio_.stick[2];
  arm_stick_ms_ = radio_.stick[3] < threshold && side > 1 - threshold ? arm_stick_ms_ + dt : 0;
  if (arm_stick_ms_ <= 1000) return;
  arm_stick_ms_ = 0;
  if (armed())
    disarm();
  else
    request_arm();
}

void Firmware::request_arm() {
  const auto complain = [&](const char* text) {
    if (clock_ms() < next_complaint_ms_) return;
    next_complaint_ms_ = clock_ms() + 1000;
    log(Severity::error, text);
  };
  if (state_ == FlightState::error) {
    if (errors_ & error_invalid_mixer) return complain("Unable to arm: Invalid mixer");
    if (errors_ & error_rc_lost) return complain("Unable to arm: RC signal lost");
    if (errors_ & error_uncalibrated_imu) return complain("Unable to arm: IMU not calibrated");
    return complain("Unable to arm: Invalid failsafe");
  }
  if (state_ != FlightState::preflight) return;
  if (radio_.stick[3] >= params_.f(param("RC_ARM_THRESHOLD")))
    return complain("RC throttle is too high to arm");
  if (!params_.i(param("TAKE_MIN_THR")) && !radio_.on[Radio::throttle_override])
    return complain("RC throttle override must be active to arm");
  if (params_.i(param("ARM_CAL_GYRO"))) {
    state_ = FlightState::calibrating;
    return start_gyro_calibration();
  }
  state_ = FlightState::armed;
  send_status();
}

void Firmware::disarm() {
  if (state_ == FlightState::calibrating) state_ = FlightState::preflight;
  if (!armed()) return;
  state_ = errors_ ? FlightState::error : FlightState::preflight;
  send_status();
}

void Firmware::set_error(std::uint8_t bit, bool on) {
  const auto before = errors_;
  errors_ = static_cast<std::uint8_t>(on ? errors_ | bit : errors_ & ~bit);
  process_errors();
  if (errors_ != before && !booting_) send_status();
}

void Firmware::process_errors() {
  if (state_ == FlightState::preflight && errors_) state_ = FlightState::error;
  if (state_ == FlightState::error && !errors_) state_ = FlightState::preflight;
}

void Firmware::start_gyro_calibration() {
  gyro_calibration_.start();
  for (std::size_t k = 0; k < 3; ++k) params_.set(param("GYRO_X_BIAS") + k, 0.f);
}

void Firmware::calibrate_imu(const Vec& accel, const Vec& gyro) {
  if (accel_calibration_.running() && accel_calibration_.add(accel, inputs.imu_kelvin)) accel_calibrated();
  if (gyro_calibration_.running() && gyro_calibration_.add(gyro, inputs.imu_kelvin)) gyro_calibrated();
}

void Firmware::gyro_calibrated() {
  const Vec bias = gyro_calibration_.mean();
  const bool good = norm(bias) < 1;
  if (good)
    for (std::size_t k = 0; k < 3; ++k) params_.set(param("GYRO_X_BIAS") + k, static_cast<float>(bias[k]));
  else
    log(Severity::error, "Too much movement for gyro cal");
  if (state_ != FlightState::calibrating) return;
  state_ = good ? FlightState::armed : FlightState::preflight;
  send_status();
}

void Firmware::accel_calibrated() {
  Vec bias = accel_calibration_.mean();
  bias[2] += 9.80665;
  for (std::size_t k = 0; k < 3; ++k)
    bias[k] -= params_.f(param("ACC_X_TEMP_COMP") + k) * accel_calibration_.temperature();
  if (accel_calibration_.spread() > 1) return log(Severity::error, "Too much movement for IMU cal");
  if (norm(bias) >= 3) {
    char text[50];
    std::snprintf(text, sizeof text, "large accel bias: norm = %.3f", norm(bias));
    return log(Severity::error, text);
  }
  for (std::size_t k = 0; k < 3; ++k) params_.set(param("ACC_X_BIAS") + k, static_cast<float>(bias[k]));
  log(Severity::info, "IMU offsets captured");
  set_error(error_uncalibrated_imu, false);
}

void Firmware::changed(std::size_t id) {
  if (!booting_) send_param(id);
  if (id >= param("RC_X_CHN") && id <= param("SWITCH_8_DIR")) {
    radio_.map(params_);
    constexpr std::array names{"ARM", "ATTITUDE OVERRIDE", "THROTTLE OVERRIDE", "ATTITUDE TYPE"};
    for (std::size_t s = 0; s < Radio::switches; ++s)
      log(Severity::info, std::string(names[s]) + (radio_.mapped[s] ? " switch mapped to RC channel " +
                                                                          std::to_string(radio_.channel[s])
                                                                    : std::string(" switch not mapped")));
  }
  const bool own = params_.i(param("PRIMARY_MIXER")) == mixer_custom ||
                   params_.i(param("SECONDARY_MIXER")) == mixer_custom;
  if (id == param("PRIMARY_MIXER") || id == param("SECONDARY_MIXER") ||
      (own && id >= mixer_out_params && id < last_params_at)) {
    const bool valid = mixing_.load(params_);
    if (!valid) log(Severity::error, "Invalid Mixer Choice");
    set_error(error_invalid_mixer, !valid);
  }
  if (id == param("FAILSAFE_THR") || id == param("FIXED_WING")) {
    const float v = params_.f(param("FAILSAFE_THR"));
    set_error(error_invalid_failsafe, !params_.i(param("FIXED_WING")) && !(v >= 0 && v <= 1));
  }
}

}  // namespace fulmar::fcu::peer
