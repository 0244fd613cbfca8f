// SPDX-License-Identifier: BSD-3-Clause
// The peer's time, sensors and outputs. Source: ROSflight firmware 2.0.1.
#include "firmware.hpp"

#include <algorithm>

namespace fulmar::fcu::peer {

void Firmware::boot(std::int64_t now_us, bool crashed) {
  booting_ = true;
  ++boots_;
  boot_us_ = now_us;
  clock_us_ = options_.first_clock_us;
  params_.changed = nullptr;
  params_.load(flash_);
  const Rates& r = options_.rates;
  const auto timer = [&](double hz) {
    Timer t(hz);
    t.due(clock_us_);  // a clock that begins late
    return t;
  };
  imu_ = timer(r.imu);
  mag_ = timer(r.mag);
  baro_ = timer(r.baro);
  pitot_ = timer(r.pitot);
  gnss_ = timer(r.gnss);
  battery_ = timer(r.battery);
  rc_ = timer(r.rc);
  range_ = timer(r.range);
  pass_ = timer(r.passes);
  heartbeat_ = timer(1);
  status_ = timer(10);
  reboot_at_us_ = -1;
  fifo_.clear();
  texts_.clear();
  connected_ = false;
  next_param_ = param_count;
  errors_ = 0;
  state_ = FlightState::preflight;
  arm_stick_ms_ = last_rc_ms_ = next_complaint_ms_ = 0;
  mux_.restart();
  offboard_ = {};
  aux_ = {};
  outputs_ = {};
  attitude_ = {};
  gyro_calibration_ = accel_calibration_ = {};
  baro_calibration_.start();
  pitot_calibration_.start();
  battery_volt_ = params_.f(param("BATT_VOLT_MAX"));
  battery_amp_ = 0;
  params_.changed = [this](std::size_t id) { changed(id); };
  changed(param("RC_X_CHN"));
  changed(param("PRIMARY_MIXER"));
  changed(param("FAILSAFE_THR"));
  bool calibrated = false;
  for (std::size_t k = 0; k < 3; ++k)
    calibrated |= params_.f(param("GYRO_X_BIAS") + k) != 0 || params_.f(param("ACC_X_BIAS") + k) != 0;
  set_error(error_uncalibrated_imu, !calibrated);
  log(Severity::info, "Booting");
  fifo_.clear();
  booting_ = false;
  if (crashed && hard_error_) {
    if (hard_error_->doRearm && state_ == FlightState::preflight) state_ = FlightState::armed;
    log(Severity::critical, "Firmware crash detected and recovered!");
    log(Severity::critical, "Error code: " + std::to_string(hard_error_->error_code));
  }
}

std::int64_t Firmware::clock_at(std::int64_t now_us) const {
  const double elapsed = static_cast<double>(now_us - boot_us_);
  return options_.first_clock_us + now_us - boot_us_ +
         static_cast<std::int64_t>(elapsed * options_.clock_ppm * 1e-6);
}

std::int64_t Firmware::next_us() const {
  std::int64_t next = std::min(imu_.next_us, rc_.next_us);
  if (next_param_ < param_count || !texts_.empty()) next = std::min(next, pass_.next_us);
  if (reboot_at_us_ >= 0) next = std::min(next, reboot_at_us_);
  const double ahead = static_cast<double>(next - options_.first_clock_us) / (1 + options_.clock_ppm * 1e-6);
  std::int64_t now = boot_us_ + static_cast<std::int64_t>(ahead);
  while (clock_at(now) < next) ++now;  // rounding
  return now;
}

void Firmware::run(std::int64_t now_us) {
  while (true) {
    const std::int64_t at = next_us();
    if (at > now_us) break;
    advance(clock_at(at));
    if (reboot_at_us_ >= 0 && clock_us_ >= reboot_at_us_) boot(at, false);
  }
  clock_us_ = std::max(clock_us_, clock_at(now_us));
}

void Firmware::advance(std::int64_t clock_us) {
  clock_us_ = std::max(clock_us_, clock_us);
  if (imu_.due(clock_us_)) imu_pass();
  if (rc_.due(clock_us_) && inputs.rc_frames) rc_pass();
  pass();
}

/// One turn of the main loop, as far as it talks.
void Firmware::pass() {
  const bool turn = pass_.due(clock_us_);
  if (heartbeat_.due(clock_us_)) {
    Heartbeat m;
    m.type = params_.i(param("FIXED_WING")) ? 1 : 2;
    send(m);
  }
  if (status_.due(clock_us_)) send_status();
  if (!turn) return;
  if (next_param_ < param_count) send_param(next_param_++);
  if (connected_ && !texts_.empty()) {
    send_text(texts_.front().severity, texts_.front().text,
              static_cast<std::uint8_t>(clock_us_ & 0xff));  // so it does
    texts_.pop_front();
  }
}

void Firmware::imu_pass() {
  if (before_imu) before_imu();
  if (!inputs.imu_works) return;  // neither control nor telemetry, and no error
  calibrate_imu(inputs.accel, inputs.gyro);
  Vec accel = inputs.accel, gyro = inputs.gyro;
  for (std::size_t k = 0; k < 3; ++k) {
    accel[k] -=
        params_.f(param("ACC_X_TEMP_COMP") + k) * inputs.imu_kelvin + params_.f(param("ACC_X_BIAS") + k);
    gyro[k] -= params_.f(param("GYRO_X_BIAS") + k);
  }
  attitude_.advance(params_, accel, gyro, 1 / options_.rates.imu, clock_us_);
  control();
  const auto f = [](double v) { return static_cast<float>(v); };
  send(SmallImu{static_cast<std::uint64_t>(clock_us_), f(accel[0]), f(accel[1]), f(accel[2]), f(gyro[0]),
                f(gyro[1]), f(gyro[2]), f(inputs.imu_kelvin)});
  send(AttitudeQuaternion{static_cast<std::uint32_t>(clock_ms()), f(attitude_.q[0]), f(attitude_.q[1]),
                          f(attitude_.q[2]), f(attitude_.q[3]), f(attitude_.rate[0]), f(attitude_.rate[1]),
                          f(attitude_.rate[2])});
  if (imu_.count % 8 == 0) send(RosflightOutputRaw{static_cast<std::uint64_t>(clock_ms()), outputs_});
  sensor_passes();
}

void Firmware::sensor_passes() {
  if (pitot_.due(clock_us_) && inputs.pitot_works) pitot_pass();
  if (baro_.due(clock_us_) && inputs.baro_works) baro_pass();
  if (mag_.due(clock_us_) && inputs.mag_works) {
    Vec m{};
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j)
        m[i] += params_.f(param("MAG_CAL_A00") + 3 * i + j) *
                (inputs.mag[j] - params_.f(param("MAG_X_BIAS") + j));
    send(SmallMag{static_cast<float>(m[0]), static_cast<float>(m[1]), static_cast<float>(m[2])});
  }
  if (range_.due(clock_us_) && inputs.range_m)
    send(SmallRange{static_cast<float>(*inputs.range_m), 8, 0.25, 0});
  if (battery_.due(clock_us_)) {
    const double av = params_.f(param("BATT_VOLT_LPF")), ac = params_.f(param("BATT_CURR_LPF"));
    battery_volt_ = av * battery_volt_ + (1 - av) * inputs.battery_volt * params_.f(param("BATT_VOLT_MULT"));
    battery_amp_ = ac * battery_amp_ + (1 - ac) * inputs.battery_amp * params_.f(param("BATT_CURR_MULT"));
    send(RosflightBatteryStatus{static_cast<float>(battery_volt_), static_cast<float>(battery_amp_)});
  }
  if (gnss_.due(clock_us_) && inputs.gnss_works) {
    RosflightGnss m = inputs.gnss;
    m.rosflight_timestamp =
        static_cast<std::uint64_t>(std::max<std::int64_t>(0, clock_us_ - inputs.gnss_age_us));
    send(m);
  }
}

void Firmware::baro_pass() {
  if (const auto mean = baro_calibration_.add(inputs.baro_pa, clock_us_)) {
    params_.set(param("BARO_BIAS"), static_cast<float>(*mean));
    params_.set(param("GROUND_LEVEL"), static_cast<float>(pressure_altitude(*mean)));
    log(Severity::info, "Baro Cal successful!");
  } else if (baro_calibration_.scattered()) {
    log(Severity::error, "Too much movement for barometer cal");
  }
  send(SmallBaro{static_cast<float>(pressure_altitude(inputs.baro_pa)), static_cast<float>(inputs.baro_pa),
                 static_cast<float>(inputs.baro_kelvin)});
}

void Firmware::pitot_pass() {
  if (const auto mean = pitot_calibration_.add(inputs.pitot_pa, clock_us_)) {
    params_.set(param("DIFF_PRESS_BIAS"), static_cast<float>(*mean));
    log(Severity::info, "Airspeed Cal Successful!");
  } else if (pitot_calibration_.scattered()) {
    log(Severity::error, "Too much movement for diff pressure cal");
  }
  const double pascal = inputs.pitot_pa - params_.f(param("DIFF_PRESS_BIAS"));
  send(DiffPressure{static_cast<float>(indicated(pascal)), static_cast<float>(pascal),
                    static_cast<float>(inputs.pitot_kelvin)});
}

/// From the combined command to the outputs. Fixed wing: straight through; the modes of multirotors run their
/// proportional loops even so.
void Firmware::control() {
  Commands u = mux_.u;
  const std::array<double, 3> angle{attitude_.roll(), attitude_.pitch(), 0};
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t rate_p = param("PID_ROLL_RATE_P") + 3 * k, angle_p = param("PID_ROLL_ANG_P") + 3 * k;
    if (mux_.mode[k] == ControlMode::rate)
      u[3 + k] = params_.f(rate_p) * static_cast<float>(static_cast<double>(u[3 + k]) - attitude_.rate[k]);
    if (mux_.mode[k] == ControlMode::angle)
      u[3 + k] = static_cast<float>(params_.f(angle_p) * (static_cast<double>(u[3 + k]) - angle[k]) -
                                    params_.f(angle_p + 2) * attitude_.rate[k]);
    u[3 + k] += params_.f(param("X_EQ_TORQUE") + k);
  }
  if (mux_.mode[0] != ControlMode::pass)
    for (std::size_t k = 0; k < 3; ++k) u[k] *= params_.f(param("RC_MAX_THR"));
  if (params_.i(param("FIXED_WING"))) {
    if (params_.i(param("REV_AILERON"))) u[3] = -u[3];
    if (params_.i(param("REV_ELEVATOR"))) u[4] = -u[4];
    if (params_.i(param("REV_RUDDER"))) u[5] = -u[5];
  }
  write_outputs(mixing_.mix(u, mux_.pilot_throttle(), mux_.pilot_attitude()));
}

void Firmware::write_outputs(const Outputs14& mixed) {
  const float idle = params_.f(param("MOTOR_IDLE_THR"));
  for (std::size_t j = 0; j < outputs_.size(); ++j) {
    const bool owned = mixing_.type(j) != OutputType::aux;
    const auto type = owned ? mixing_.type(j) : static_cast<OutputType>(aux_.type_array[j]);
    float v = owned ? mixed[j] : aux_.aux_cmd_array[j];
    if (type == OutputType::servo) {
      if (v > 1) v = 1;
      if (v < -1) v = -1;
      outputs_[j] = 0.5f + 0.5f * v;
    } else if (type == OutputType::motor) {
      if (v > 1)
        v = 1;
      else if (v < idle && params_.i(param("ARM_SPIN_MOTORS")))
        v = idle;
      else if (v < 0)
        v = 0;
      outputs_[j] = armed() ? v : 0;
    }  // outputs without a command keep their values
  }
}

}  // namespace fulmar::fcu::peer
