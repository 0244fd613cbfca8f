// SPDX-License-Identifier: BSD-3-Clause
// The 25 messages between a ROSflight flight controller and its companion: MAVLink 1 with the dialect of
// ROSflight 2. Members are in the order of transmission, largest elements first, so that a payload is the
// first bytes of its struct. Length and checksum seed of each message are computed from the struct; at the
// end they are compared with the output of the dialect's generator. Sources: MAVLink serialization guide;
// rosflight_firmware 2.0, comms/mavlink/v1.0/rosflight.xml.
#pragma once
#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <string_view>

#include "fulmar/schema.hpp"

namespace fulmar::fcu {

static_assert(std::endian::native == std::endian::little,
              "the wire is little endian, and so must be the machine");

struct Heartbeat {  ///< both directions, 1 Hz
  static constexpr std::uint8_t id = 0;
  static constexpr std::string_view name = "HEARTBEAT";
  std::uint32_t custom_mode = 0;
  std::uint8_t type = 0;  ///< 1 fixed wing, 2 multirotor
  std::uint8_t autopilot = 0, base_mode = 0, system_status = 0;
  std::uint8_t mavlink_version = 2;  ///< though the framing is 1
};

struct ParamRequestRead {  ///< to the controller. By name when the index is negative
  static constexpr std::uint8_t id = 20;
  static constexpr std::string_view name = "PARAM_REQUEST_READ";
  std::int16_t param_index = -1;
  std::uint8_t target_system = 1, target_component = 0;
  std::array<char, 16> param_id{};  ///< a name of 16 characters has no NUL
};

struct ParamRequestList {  ///< to the controller
  static constexpr std::uint8_t id = 21;
  static constexpr std::string_view name = "PARAM_REQUEST_LIST";
  std::uint8_t target_system = 1, target_component = 0;
};

inline constexpr std::uint8_t param_int32 = 6,
                              param_real32 = 9;  ///< param_type; the float field holds the bits of an integer

struct ParamValue {  ///< from the controller
  static constexpr std::uint8_t id = 22;
  static constexpr std::string_view name = "PARAM_VALUE";
  std::uint32_t param_value = 0;  ///< the bits: a float register may change them
  std::uint16_t param_count = 0, param_index = 0;
  std::array<char, 16> param_id{};
  std::uint8_t param_type = param_real32;
};

struct ParamSet {  ///< to the controller. Echoed by PARAM_VALUE only when the value changes
  static constexpr std::uint8_t id = 23;
  static constexpr std::string_view name = "PARAM_SET";
  std::uint32_t param_value = 0;  ///< the bits
  std::uint8_t target_system = 1, target_component = 0;
  std::array<char, 16> param_id{};
  std::uint8_t param_type = param_real32;
};

struct AttitudeQuaternion {  ///< from the controller: its estimate
  static constexpr std::uint8_t id = 31;
  static constexpr std::string_view name = "ATTITUDE_QUATERNION";
  std::uint32_t time_boot_ms = 0;
  float q1 = 1, q2 = 0, q3 = 0, q4 = 0;               ///< w, x, y, z; body to NED
  float rollspeed = 0, pitchspeed = 0, yawspeed = 0;  ///< rad/s, filtered, bias removed
};

// from the controller: one per frame of the radio. Channels 9 to 18, chancount and rssi are not set
struct RcChannels {
  static constexpr std::uint8_t id = 65;
  static constexpr std::string_view name = "RC_CHANNELS";
  std::uint32_t time_boot_ms = 0;
  std::uint16_t chan1_raw = 0, chan2_raw = 0, chan3_raw = 0, chan4_raw = 0, chan5_raw = 0, chan6_raw = 0,
                chan7_raw = 0,
                chan8_raw = 0;  ///< us
  std::uint16_t chan9_raw = 0, chan10_raw = 0, chan11_raw = 0, chan12_raw = 0, chan13_raw = 0, chan14_raw = 0,
                chan15_raw = 0;
  std::uint16_t chan16_raw = 0, chan17_raw = 0, chan18_raw = 0;
  std::uint8_t chancount = 0, rssi = 0;
};

// both directions, ns. A request has tc1 = 0; the response has the controller's clock there and the same ts1
struct Timesync {
  static constexpr std::uint8_t id = 111;
  static constexpr std::string_view name = "TIMESYNC";
  std::int64_t tc1 = 0, ts1 = 0;
};

struct OffboardControl {  ///< to the controller
  static constexpr std::uint8_t id = 180;
  static constexpr std::string_view name = "OFFBOARD_CONTROL";
  std::array<float, 10>
      u{};  ///< mode 0, fixed wing: u[0] throttle 0..1; u[3] aileron, u[4] elevator, u[5] rudder -1..1
  std::uint16_t ignore = 0;  ///< bit i: u[i] is ignored
  std::uint8_t mode = 0;     ///< 0: to the mixer, unchanged
};

struct SmallImu {  ///< from the controller, SI
  static constexpr std::uint8_t id = 181;
  static constexpr std::string_view name = "SMALL_IMU";
  std::uint64_t time_boot_us = 0;
  float xacc = 0, yacc = 0, zacc = 0, xgyro = 0, ygyro = 0, zgyro = 0;
  float temperature = 0;  ///< K
};

struct SmallMag {  ///< from the controller, tesla
  static constexpr std::uint8_t id = 182;
  static constexpr std::string_view name = "SMALL_MAG";
  float xmag = 0, ymag = 0, zmag = 0;
};

struct SmallBaro {  ///< from the controller
  static constexpr std::uint8_t id = 183;
  static constexpr std::string_view name = "SMALL_BARO";
  float altitude = 0, pressure = 0, temperature = 0;  ///< m in the standard atmosphere; Pa, absolute; K
};

struct DiffPressure {  ///< from the controller
  static constexpr std::uint8_t id = 184;
  static constexpr std::string_view name = "DIFF_PRESSURE";
  float velocity = 0, diff_pressure = 0, temperature = 0;  ///< m/s, indicated; Pa; K
};

struct SmallRange {  ///< from the controller
  static constexpr std::uint8_t id = 187;
  static constexpr std::string_view name = "SMALL_RANGE";
  float range = 0, max_range = 0, min_range = 0;  ///< m
  std::uint8_t type = 0;                          ///< 0 sonar, 1 lidar
};

enum class Command : std::uint8_t {
  rc_calibration = 0,
  accel_calibration = 1,
  gyro_calibration = 2,
  baro_calibration = 3,
  airspeed_calibration = 4,
  read_params = 5,
  write_params = 6,
  set_param_defaults = 7,
  reboot = 8,
  reboot_to_bootloader = 9,
  send_version = 10
};

struct RosflightCmd {  ///< to the controller. An armed controller rejects every command
  static constexpr std::uint8_t id = 188;
  static constexpr std::string_view name = "ROSFLIGHT_CMD";
  std::uint8_t command = 0;
};

struct RosflightCmdAck {  ///< from the controller: accepted or rejected, not yet executed
  static constexpr std::uint8_t id = 189;
  static constexpr std::string_view name = "ROSFLIGHT_CMD_ACK";
  std::uint8_t command = 0, success = 0;
};

struct RosflightOutputRaw {  ///< from the controller: its outputs, servos and motors 0..1
  static constexpr std::uint8_t id = 190;
  static constexpr std::string_view name = "ROSFLIGHT_OUTPUT_RAW";
  std::uint64_t stamp = 0;  ///< ms
  std::array<float, 14> values{};
};

struct RosflightStatus {  ///< from the controller
  static constexpr std::uint8_t id = 191;
  static constexpr std::string_view name = "ROSFLIGHT_STATUS";
  std::uint16_t rc_override = 0;  ///< bits of Override
  std::int16_t num_errors = 0;    ///< sensors that did not start
  std::int16_t loop_time_us = 0;
  std::uint8_t armed = 0, failsafe = 0, offboard = 0;
  std::uint8_t error_code = 0;  ///< bits of ErrorBit
  std::uint8_t control_mode = 0;
};

/// Bits of RosflightStatus::rc_override: cause that keeps a command from the outputs.
enum Override : std::uint16_t {
  override_attitude_switch = 0x001,
  override_throttle_switch = 0x002,
  override_stick_x = 0x004,
  override_stick_y = 0x008,
  override_stick_z = 0x010,
  override_min_throttle = 0x020,
  override_offboard_x_inactive = 0x040,
  override_offboard_y_inactive = 0x080,
  override_offboard_z_inactive = 0x100,
  override_offboard_throttle_inactive = 0x200,
  override_by_pilot = 0x03f,
  override_inactive = 0x3c0
};

/// Bits of RosflightStatus::error_code.
enum ErrorBit : std::uint8_t {
  error_invalid_mixer = 0x01,
  error_imu_not_responding = 0x02,  ///< never set by firmware 2.0
  error_rc_lost = 0x04,
  error_unhealthy_estimator = 0x08,
  error_time_backwards = 0x10,
  error_uncalibrated_imu = 0x20,
  error_buffer_overrun = 0x40,  ///< never set by firmware 2.0
  error_invalid_failsafe = 0x80
};

struct RosflightVersion {  ///< from the controller
  static constexpr std::uint8_t id = 192;
  static constexpr std::string_view name = "ROSFLIGHT_VERSION";
  std::array<char, 50> version{};  ///< up to the first NUL; the bytes behind it are undefined
};

struct RosflightAuxCmd {  ///< to the controller: outputs that the mixer does not use
  static constexpr std::uint8_t id = 193;
  static constexpr std::string_view name = "ROSFLIGHT_AUX_CMD";
  std::array<float, 14> aux_cmd_array{};
  std::array<std::uint8_t, 14> type_array{};  ///< 0 disabled (last value), 1 servo -1..1, 2 motor 0..1
};

struct ExternalAttitude {  ///< to the controller: corrects its filter once
  static constexpr std::uint8_t id = 195;
  static constexpr std::string_view name = "EXTERNAL_ATTITUDE";
  float qw = 1, qx = 0, qy = 0, qz = 0;
};

struct RosflightHardError {  ///< from the controller after its crash
  static constexpr std::uint8_t id = 196;
  static constexpr std::string_view name = "ROSFLIGHT_HARD_ERROR";
  std::uint32_t error_code = 0, pc = 0, reset_count = 0, doRearm = 0;
};

struct RosflightGnss {  ///< from the controller
  static constexpr std::uint8_t id = 197;
  static constexpr std::string_view name = "ROSFLIGHT_GNSS";
  std::int64_t seconds = 0;               ///< since 1970, UTC
  double lat = 0, lon = 0;                ///< deg
  std::uint64_t rosflight_timestamp = 0;  ///< us, the controller's clock
  std::int32_t nanos = 0;
  float height = 0;                        ///< m above mean sea level
  float vel_n = 0, vel_e = 0, vel_d = 0;   ///< m/s
  float h_acc = 0, v_acc = 0, s_acc = 0;   ///< m, m, m/s
  std::uint8_t fix_type = 0, num_sat = 0;  ///< numbered as by u-blox
};

struct RosflightBatteryStatus {  ///< from the controller
  static constexpr std::uint8_t id = 199;
  static constexpr std::string_view name = "ROSFLIGHT_BATTERY_STATUS";
  float battery_voltage = 0, battery_current = 0;  ///< V, A
};

enum class Severity : std::uint8_t {
  critical = 2,
  error = 3,
  warning = 4,
  info = 6
};  ///< those that the firmware uses

struct Statustext {  ///< from the controller
  static constexpr std::uint8_t id = 253;
  static constexpr std::string_view name = "STATUSTEXT";
  std::uint8_t severity = 6;
  std::array<char, 50> text{};  ///< up to the first NUL
};

// ---- derived from the structs

inline constexpr std::size_t max_payload = 70;

/// X.25 checksum of one more byte. MAVLink, "Packet Serialization": initial value 0xFFFF, no final xor.
constexpr std::uint16_t crc_byte(std::uint16_t crc, std::uint8_t byte) {
  const auto low = static_cast<std::uint8_t>(byte ^ (crc & 0xff));
  const auto t = static_cast<std::uint8_t>(low ^ (low << 4));
  return static_cast<std::uint16_t>((crc >> 8) ^ (t << 8) ^ (t << 3) ^ (t >> 4));
}

namespace detail {

constexpr std::uint16_t crc_text(std::uint16_t crc, std::string_view text) {
  for (const char c : text) crc = crc_byte(crc, static_cast<std::uint8_t>(c));
  return crc_byte(crc, ' ');
}

template <class T>
struct Element {
  using type = T;
  static constexpr std::size_t count = 0;  // no array
};
template <class T, std::size_t N>
struct Element<std::array<T, N>> {
  using type = T;
  static constexpr std::size_t count = N;
};

template <class T>
constexpr std::string_view type_name(bool bits) {
  if constexpr (std::is_same_v<T, float>)
    return "float";
  else if constexpr (std::is_same_v<T, double>)
    return "double";
  else if constexpr (std::is_same_v<T, char>)
    return "char";
  else if constexpr (std::is_same_v<T, std::uint8_t>)
    return "uint8_t";
  else if constexpr (std::is_same_v<T, std::uint16_t>)
    return "uint16_t";
  else if constexpr (std::is_same_v<T, std::int16_t>)
    return "int16_t";
  else if constexpr (std::is_same_v<T, std::uint32_t>)
    return bits ? "float" : "uint32_t";
  else if constexpr (std::is_same_v<T, std::int32_t>)
    return "int32_t";
  else if constexpr (std::is_same_v<T, std::uint64_t>)
    return "uint64_t";
  else
    return "int64_t";
}

struct Layout {
  std::size_t length = 0;
  std::uint8_t crc_extra = 0;
};

/// MAVLink, "CRC_EXTRA calculation": name and fields as text, in the order of transmission; the length of an
/// array as a byte.
template <class M>
consteval Layout layout() {
  Layout out;
  std::uint16_t crc = crc_text(0xffff, M::name);
  std::size_t i = 0;
  const auto add = [&]<class Member>(const Member*) {
    using E = Element<Member>;
    const std::string_view field = fulmar::detail::FieldNames<M>::view(i++);
    crc = crc_text(crc_text(crc, type_name<typename E::type>(field == "param_value")), field);
    if (E::count > 0) crc = crc_byte(crc, static_cast<std::uint8_t>(E::count));
    out.length += sizeof(Member);
  };
  const auto all = [&]<class... Member>(fulmar::detail::Types<Member...>) {
    (add(static_cast<const Member*>(nullptr)), ...);
  };
  all(fulmar::detail::MemberTypes<M>{});
  out.crc_extra = static_cast<std::uint8_t>((crc & 0xff) ^ (crc >> 8));
  return out;
}

}  // namespace detail

template <class M>
inline constexpr std::size_t length = detail::layout<M>().length;
template <class M>
inline constexpr std::uint8_t crc_extra = detail::layout<M>().crc_extra;

/// Calls `visit.template operator()<M>()` for every message M.
template <class Visit>
constexpr void for_each_message(Visit&& visit) {
  const auto each = [&]<class... M>() { (visit.template operator()<M>(), ...); };
  each.template operator()<
      Heartbeat, ParamRequestRead, ParamRequestList, ParamValue, ParamSet, AttitudeQuaternion, RcChannels,
      Timesync, OffboardControl, SmallImu, SmallMag, SmallBaro, DiffPressure, SmallRange, RosflightCmd,
      RosflightCmdAck, RosflightOutputRaw, RosflightStatus, RosflightVersion, RosflightAuxCmd,
      ExternalAttitude, RosflightHardError, RosflightGnss, RosflightBatteryStatus, Statustext>();
}

struct WireInfo {
  std::uint8_t length = 0, crc_extra = 0;
  bool known = false;
};

/// By message id.
inline constexpr std::array<WireInfo, 256> wire = [] {
  std::array<WireInfo, 256> table{};
  for_each_message([&]<class M>() {
    table[M::id] = {static_cast<std::uint8_t>(length<M>), crc_extra<M>, true};
  });
  return table;
}();

/// Text of a fixed field, up to the first NUL.
template <std::size_t N>
std::string_view text(const std::array<char, N>& field) {
  return {field.data(), ::strnlen(field.data(), N)};
}
/// Writes a text into a fixed field, cut to its size.
template <std::size_t N>
constexpr std::array<char, N> field(std::string_view text) {
  std::array<char, N> out{};
  for (std::size_t i = 0; i < text.size() && i < N; ++i) out[i] = text[i];
  return out;
}

// Length and CRC_EXTRA as printed by the dialect's generator.
template <class M>
consteval bool is(std::uint8_t id, std::size_t bytes, std::uint8_t seed) {
  return M::id == id && length<M> == bytes && crc_extra<M> == seed && bytes <= max_payload &&
         sizeof(M) >= bytes;
}
static_assert(is<Heartbeat>(0, 9, 50));
static_assert(is<ParamRequestRead>(20, 20, 214));
static_assert(is<ParamRequestList>(21, 2, 159));
static_assert(is<ParamValue>(22, 25, 220));
static_assert(is<ParamSet>(23, 23, 168));
static_assert(is<AttitudeQuaternion>(31, 32, 246));
static_assert(is<RcChannels>(65, 42, 118));
static_assert(is<Timesync>(111, 16, 34));
static_assert(is<OffboardControl>(180, 43, 90));
static_assert(is<SmallImu>(181, 36, 67));
static_assert(is<SmallMag>(182, 12, 218));
static_assert(is<SmallBaro>(183, 12, 206));
static_assert(is<DiffPressure>(184, 12, 169));
static_assert(is<SmallRange>(187, 13, 60));
static_assert(is<RosflightCmd>(188, 1, 249));
static_assert(is<RosflightCmdAck>(189, 2, 113));
static_assert(is<RosflightOutputRaw>(190, 64, 181));
static_assert(is<RosflightStatus>(191, 11, 12));
static_assert(is<RosflightVersion>(192, 50, 134));
static_assert(is<RosflightAuxCmd>(193, 70, 1));
static_assert(is<ExternalAttitude>(195, 16, 65));
static_assert(is<RosflightHardError>(196, 16, 10));
static_assert(is<RosflightGnss>(197, 66, 221));
static_assert(is<RosflightBatteryStatus>(199, 8, 48));
static_assert(is<Statustext>(253, 51, 83));

}  // namespace fulmar::fcu
