// SPDX-License-Identifier: BSD-3-Clause
// The 333 parameters of ROSflight 2.0: order, names, types and defaults, and how they change: an echo only
// where the value differs.
#pragma once
#include <array>
#include <bit>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <iterator>
#include <string>
#include <string_view>

#include "../../link/messages.hpp"

namespace fulmar::fcu::peer {

inline constexpr std::size_t param_count = 333;

struct ParamInfo {
  std::string_view name;
  bool integer = false;
  double value = 0;
};

inline constexpr ParamInfo first_params[]{
    {"BAUD_RATE", true, 921600},        {"SERIAL_DEVICE", true, 0},   {"NUM_MOTORS", true, 4},
    {"MOTOR_RESISTANCE", false, 0.042}, {"MOTOR_KV", false, 0.01706}, {"NO_LOAD_CURRENT", false, 1.5},
    {"PROP_DIAMETER", false, 0.381},    {"PROP_CT", false, 0.075},    {"PROP_CQ", false, 0.0045},
    {"BATT_VOLT_MAX", false, 25},       {"USE_MOTOR_PARAM", true, 0}};
inline constexpr std::size_t mixer_out_params = 11, mixer_pwm_params = 21, primary_params = 31,
                             secondary_params = 131, last_params_at = 231;

inline constexpr ParamInfo last_params[]{{"SYS_ID", true, 1},
                                         {"PID_ROLL_RATE_P", false, 0.07},
                                         {"PID_ROLL_RATE_I", false, 0},
                                         {"PID_ROLL_RATE_D", false, 0},
                                         {"PID_PITCH_RATE_P", false, 0.07},
                                         {"PID_PITCH_RATE_I", false, 0},
                                         {"PID_PITCH_RATE_D", false, 0},
                                         {"PID_YAW_RATE_P", false, 0.25},
                                         {"PID_YAW_RATE_I", false, 0},
                                         {"PID_YAW_RATE_D", false, 0},
                                         {"PID_ROLL_ANG_P", false, 0.15},
                                         {"PID_ROLL_ANG_I", false, 0},
                                         {"PID_ROLL_ANG_D", false, 0.05},
                                         {"PID_PITCH_ANG_P", false, 0.15},
                                         {"PID_PITCH_ANG_I", false, 0},
                                         {"PID_PITCH_ANG_D", false, 0.05},
                                         {"X_EQ_TORQUE", false, 0},
                                         {"Y_EQ_TORQUE", false, 0},
                                         {"Z_EQ_TORQUE", false, 0},
                                         {"PID_TAU", false, 0.05},
                                         {"MOTOR_IDLE_THR", false, 0.1},
                                         {"FAILSAFE_THR", false, -1},
                                         {"ARM_SPIN_MOTORS", true, 1},
                                         {"FILT_INIT_T", true, 3000},
                                         {"FILT_ACC_KP", false, 0.5},
                                         {"FILT_KI", false, 0.01},
                                         {"FILT_EXT_KP", false, 1.5},
                                         {"FILT_ACC_MARGIN", false, 0.1},
                                         {"FILT_QUAD_INT", true, 1},
                                         {"FILT_MAT_EXP", true, 1},
                                         {"FILT_USE_ACC", true, 1},
                                         {"ARM_CAL_GYRO", true, 0},
                                         {"GYRO_XY_LPF", false, 0.3},
                                         {"GYRO_Z_LPF", false, 0.3},
                                         {"ACC_LPF", false, 0.5},
                                         {"GYRO_X_BIAS", false, 0},
                                         {"GYRO_Y_BIAS", false, 0},
                                         {"GYRO_Z_BIAS", false, 0},
                                         {"ACC_X_BIAS", false, 0},
                                         {"ACC_Y_BIAS", false, 0},
                                         {"ACC_Z_BIAS", false, 0},
                                         {"ACC_X_TEMP_COMP", false, 0},
                                         {"ACC_Y_TEMP_COMP", false, 0},
                                         {"ACC_Z_TEMP_COMP", false, 0},
                                         {"MAG_CAL_A00", false, 1},
                                         {"MAG_CAL_A01", false, 0},
                                         {"MAG_CAL_A02", false, 0},
                                         {"MAG_CAL_A10", false, 0},
                                         {"MAG_CAL_A11", false, 1},
                                         {"MAG_CAL_A12", false, 0},
                                         {"MAG_CAL_A20", false, 0},
                                         {"MAG_CAL_A21", false, 0},
                                         {"MAG_CAL_A22", false, 1},
                                         {"MAG_X_BIAS", false, 0},
                                         {"MAG_Y_BIAS", false, 0},
                                         {"MAG_Z_BIAS", false, 0},
                                         {"BARO_BIAS", false, 0},
                                         {"GROUND_LEVEL", false, 1387},
                                         {"DIFF_PRESS_BIAS", false, 0},
                                         {"RC_TYPE", true, 0},
                                         {"RC_X_CHN", true, 0},
                                         {"RC_Y_CHN", true, 1},
                                         {"RC_Z_CHN", true, 3},
                                         {"RC_F_CHN", true, 2},
                                         {"RC_F_AXIS", true, 2},
                                         {"RC_ATT_OVRD_CHN", true, 4},
                                         {"RC_THR_OVRD_CHN", true, 4},
                                         {"RC_ATT_CTRL_CHN", true, -1},
                                         {"RC_ARM_CHN", true, -1},
                                         {"RC_NUM_CHN", true, 6},
                                         {"SWITCH_5_DIR", true, 1},
                                         {"SWITCH_6_DIR", true, 1},
                                         {"SWITCH_7_DIR", true, 1},
                                         {"SWITCH_8_DIR", true, 1},
                                         {"RC_OVRD_DEV", false, 0.1},
                                         {"RC_OVRD_LAG_T", true, 1000},
                                         {"TAKE_MIN_THR", true, 1},
                                         {"RC_MAX_THR", false, 0.7},
                                         {"RC_ATT_MODE", true, 1},
                                         {"RC_MAX_ROLL", false, 0.786},
                                         {"RC_MAX_PITCH", false, 0.786},
                                         {"RC_MAX_ROLLRATE", false, 3.14159},
                                         {"RC_MAX_PITCHRATE", false, 3.14159},
                                         {"RC_MAX_YAWRATE", false, 1.507},
                                         {"PRIMARY_MIXER", true, 255},
                                         {"SECONDARY_MIXER", true, 255},
                                         {"FIXED_WING", true, 0},
                                         {"REV_ELEVATOR", true, 0},
                                         {"REV_AILERON", true, 0},
                                         {"REV_RUDDER", true, 0},
                                         {"IMU_ROLL", false, 0},
                                         {"IMU_PITCH", false, 0},
                                         {"IMU_YAW", false, 0},
                                         {"MAG_ROLL", false, 0},
                                         {"MAG_PITCH", false, 0},
                                         {"MAG_YAW", false, 0},
                                         {"RC_ARM_THRESHOLD", false, 0.15},
                                         {"OFFBOARD_TIMEOUT", true, 100},
                                         {"BATT_VOLT_MULT", false, 1},
                                         {"BATT_CURR_MULT", false, 1},
                                         {"BATT_VOLT_LPF", false, 0.995},
                                         {"BATT_CURR_LPF", false, 0.995}};
static_assert(std::size(first_params) == mixer_out_params &&
              last_params_at + std::size(last_params) == param_count);

/// The index of a named parameter that is not a mixer's.
consteval std::size_t param(std::string_view name) {
  for (std::size_t i = 0; i < std::size(first_params); ++i)
    if (first_params[i].name == name) return i;
  for (std::size_t i = 0; i < std::size(last_params); ++i)
    if (last_params[i].name == name) return last_params_at + i;
  throw "no such parameter";
}
static_assert(param("PRIMARY_MIXER") == 315 && param("OFFBOARD_TIMEOUT") == 328);

class Params {
 public:
  Params() { set_defaults(); }

  void set_defaults() {
    for (std::size_t i = 0; i < param_count; ++i) {
      const bool mixer = i >= mixer_out_params && i < last_params_at;
      const ParamInfo info = mixer                  ? ParamInfo{{}, i < mixer_pwm_params, 0}
                             : i < mixer_out_params ? first_params[i]
                                                    : last_params[i - last_params_at];
      integer_[i] = info.integer;
      names_[i] = mixer ? mixer_name(i) : std::string(info.name);
      bits_[i] = info.integer ? std::bit_cast<std::uint32_t>(static_cast<std::int32_t>(info.value))
                              : std::bit_cast<std::uint32_t>(static_cast<float>(info.value));
    }
  }
  std::int32_t i(std::size_t id) const { return std::bit_cast<std::int32_t>(bits_[id]); }
  float f(std::size_t id) const { return std::bit_cast<float>(bits_[id]); }
  bool integer(std::size_t id) const { return integer_[id]; }
  const std::string& name(std::size_t id) const { return names_[id]; }
  std::uint32_t bits(std::size_t id) const { return bits_[id]; }
  /// param_count for an unknown name.
  std::size_t find(std::string_view name) const {
    for (std::size_t k = 0; k < param_count; ++k)
      if (names_[k] == name) return k;
    return param_count;
  }

  /// Called after a change: echo and handlers.
  std::function<void(std::size_t)> changed;
  void set(std::size_t id, std::int32_t value) {
    if (i(id) == value) return;
    bits_[id] = std::bit_cast<std::uint32_t>(value);
    if (changed) changed(id);
  }
  void set(std::size_t id, float value) {
    if (f(id) == value) return;  // never so for a NaN
    bits_[id] = std::bit_cast<std::uint32_t>(value);
    if (changed) changed(id);
  }
  using Image = std::array<std::uint32_t, param_count>;
  const Image& image() const { return bits_; }
  void load(const Image& image) { bits_ = image; }

 private:
  static std::string mixer_name(std::size_t id) {
    char text[24];
    const auto number = [&](const char* format, std::size_t a, std::size_t b) {
      std::snprintf(text, sizeof text, format, int(a), int(b));
    };
    // Matrices are stored column by column: row i of the inputs, output j.
    if (id < mixer_pwm_params)
      number("PRI_MIXER_OUT_%d", id - mixer_out_params, 0);
    else if (id < primary_params)
      number("PRI_MIXER_PWM_%d", id - mixer_pwm_params, 0);
    else if (id < secondary_params)
      number("PRI_MIXER_%d_%d", (id - primary_params) % 10, (id - primary_params) / 10);
    else
      number("SEC_MIXER_%d_%d", (id - secondary_params) % 10, (id - secondary_params) / 10);
    return text;
  }

  Image bits_{};
  std::array<bool, param_count> integer_{};
  std::array<std::string, param_count> names_{};
};

}  // namespace fulmar::fcu::peer
