// SPDX-License-Identifier: BSD-3-Clause
// A ROSflight 2.0 flight controller for tests: its messages, rates, delays, rejections and peculiarities,
// without a device and without a clock. Source: ROSflight firmware 2.0.1 and its behaviour on a serial line.
#pragma once
#include <array>
#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "../../link/frame.hpp"
#include "mixer.hpp"
#include "params.hpp"
#include "radio.hpp"
#include "sensing.hpp"

namespace fulmar::fcu::peer {

/// Present values of the board's sensors and the radio; raw, before the corrections of the firmware. They may
/// be set at any time.
struct Inputs {
  Vec accel{0, 0, -9.80665}, gyro{};  ///< m/s2, rad/s
  double imu_kelvin = 300.15;
  Vec mag{2.1e-5, 0, 4.6e-5};  ///< tesla
  double baro_pa = 85700, baro_kelvin = 300.15;
  double pitot_pa = 0, pitot_kelvin = 300.15;
  RosflightGnss gnss{1767225600, 40.2463724, -111.6474138, 0,    0, 1387, 0, 0,
                     0,          0.5f,       0.8f,         0.1f, 3, 15};  ///< its timestamp is filled in
  std::int64_t gnss_age_us = 22000;
  double battery_volt = 23, battery_amp = 1;
  std::optional<double> range_m;
  std::array<std::uint16_t, 8> rc_us{1500, 1500, 1000, 1500, 1000, 1000, 1000, 1000};
  bool rc_frames = true;  ///< false: the frames of the radio stop, without a flag
  bool rc_lost = false;   ///< the receiver's flag
  bool imu_works = true, gnss_works = true, mag_works = true, baro_works = true, pitot_works = true;
  std::int16_t sensor_errors = 0;
};

struct Rates {
  double imu = 400, mag = 100, baro = 50, pitot = 100, gnss = 10, battery = 10, rc = 111, range = 20,
         passes = 2000;  ///< Hz
};

struct Options {
  Rates rates;
  std::string version = "v2.0.1-0-ge8cf6a0f";
  double clock_ppm = 0;  ///< its crystal runs fast by this
  std::int64_t first_clock_us = 0;
  std::uint64_t seed = 1;
  bool refuses = false;  ///< no command is accepted
  bool flash_fails = false;
  bool reboots = true;  ///< H7 boards acknowledge and stay
  bool answers = true;  ///< false: streams, but does not answer
};

enum class FlightState : std::uint8_t { preflight, error, calibrating, armed, failsafe };

class Firmware {
 public:
  explicit Firmware(const Options& options = {}) : options_(options), flash_(params_.image()) {
    boot(0, false);
  }
  Firmware(const Firmware&) = delete;
  Firmware& operator=(const Firmware&) = delete;

  /// A fixed wing that is set up and calibrated: mixer 9, throttle on x, arm switch on channel 5, override
  /// switch on channel 6 (1-based), as ROSflight's own fixed-wing set-up has it; written to flash and booted.
  void provision(std::int64_t now_us = 0);

  Inputs inputs;
  std::function<void()> before_imu;  ///< called when an inertial sample is due: the time to set `inputs`

  /// Bytes from the companion. Advances to `now_us`, the owner's time, first.
  void receive(std::span<const std::uint8_t> bytes, std::int64_t now_us);
  /// Advances to `now_us`: all samples, frames of the radio and passes up to then.
  void run(std::int64_t now_us);
  /// Time of the next event, on the owner's clock.
  std::int64_t next_us() const;

  /// Takes sent frames, oldest first; one frame, or all. The board's fifo holds 256; further ones are
  /// dropped.
  bool take(Frame& frame);
  std::vector<std::uint8_t> take();
  std::size_t waiting() const { return fifo_.size(); }

  void reboot(std::int64_t now_us);
  /// A hard fault: its record is sent after the reboot, which follows at once.
  void crash(std::int64_t now_us);

  const Outputs14& outputs() const { return outputs_; }  ///< servos and motors 0..1
  Deflected deflected() const { return unmix(params_.i(param("PRIMARY_MIXER")), outputs_); }
  bool armed() const { return state_ == FlightState::armed || state_ == FlightState::failsafe; }
  FlightState state() const { return state_; }
  std::uint16_t override_reasons() const { return mux_.reasons; }
  std::uint8_t errors() const { return errors_; }
  bool offboard() const { return offboard_.any(); }
  std::int64_t clock_us() const { return clock_us_; }
  Params& params() { return params_; }
  void write_flash() { flash_ = params_.image(); }
  const Offboard& last_command() const { return offboard_; }
  std::uint64_t dropped() const { return dropped_; }
  std::uint64_t commands() const { return commands_; }  ///< OFFBOARD_CONTROL that came
  std::uint32_t boots() const { return boots_; }

 private:
  // firmware.cpp: time, sensors, outputs
  void boot(std::int64_t now_us, bool crashed);
  std::int64_t clock_at(std::int64_t now_us) const;
  void advance(std::int64_t clock_us);
  void imu_pass();
  void sensor_passes();
  void calibrate_imu(const Vec& accel, const Vec& gyro);
  void baro_pass();
  void pitot_pass();
  void control();
  void write_outputs(const Outputs14& wanted);
  void pass();
  // firmware_state.cpp: radio, arming, errors, calibrations' ends
  void rc_pass();
  void look_for_arming();
  void request_arm();
  void disarm();
  void set_error(std::uint8_t bit, bool on);
  void process_errors();
  void gyro_calibrated();
  void accel_calibrated();
  void start_gyro_calibration();
  void changed(std::size_t id);
  // firmware_comm.cpp: messages
  void handle(const Packet& packet);
  void handle(const ParamRequestRead& m);
  void handle(const ParamSet& m);
  void handle(const OffboardControl& m);
  void handle(const RosflightAuxCmd& m);
  void handle(const RosflightCmd& m, std::uint8_t from);
  bool run_command(Command command);
  void send_status();
  void send_param(std::size_t id);
  void send_version();
  void log(Severity severity, const std::string& text);
  void send_text(Severity severity, const std::string& text, std::uint8_t system);
  std::uint8_t system() const { return static_cast<std::uint8_t>(params_.i(param("SYS_ID"))); }
  std::int64_t clock_ms() const { return clock_us_ / 1000; }

  static constexpr std::uint8_t component = 250;
  template <class M>
  void send(const M& message, std::uint8_t component_id = component) {
    put(encode(message, sequence_++, system(), component_id));
  }
  void put(const Frame& frame) {
    if (fifo_.size() < 256)
      fifo_.push_back(frame);
    else
      ++dropped_;
  }

  /// Once per period, on a grid that begins at boot.
  struct Timer {
    double period_us = 1;
    std::int64_t next_us = 0, count = 0;
    Timer() = default;
    explicit Timer(double hz) : period_us(1e6 / hz), next_us(static_cast<std::int64_t>(period_us)) {}
    bool due(std::int64_t clock_us) {
      if (clock_us < next_us) return false;
      while (next_us <= clock_us)
        next_us = static_cast<std::int64_t>(static_cast<double>(++count + 1) * period_us);
      return true;
    }
  };

  Options options_;
  Params params_;
  Params::Image flash_;
  std::deque<Frame> fifo_;
  std::uint64_t dropped_ = 0, commands_ = 0;
  std::uint32_t boots_ = 0;
  std::uint8_t sequence_ = 0;
  Parser parser_;

  std::int64_t boot_us_ = 0, clock_us_ = 0;
  Timer imu_, mag_, baro_, pitot_, gnss_, battery_, rc_, range_, pass_, heartbeat_, status_;
  std::int64_t reboot_at_us_ = -1;

  struct Text {
    Severity severity;
    std::string text;
  };
  bool connected_ = false, booting_ = false;
  std::deque<Text> texts_;
  std::size_t next_param_ = param_count;
  std::optional<RosflightHardError> hard_error_;

  FlightState state_ = FlightState::preflight;
  std::uint8_t errors_ = 0;
  std::int64_t arm_stick_ms_ = 0, last_rc_ms_ = 0, next_complaint_ms_ = 0;
  Mixing mixing_;
  Radio radio_;
  Mux mux_;
  Offboard offboard_;
  RosflightAuxCmd aux_;
  Outputs14 outputs_{};
  Attitude attitude_;
  ImuCalibration gyro_calibration_, accel_calibration_;
  PressureCalibration baro_calibration_{25}, pitot_calibration_{100};
  double battery_volt_ = 0, battery_amp_ = 0;
};

}  // namespace fulmar::fcu::peer
