// SPDX-License-Identifier: BSD-3-Clause
// Small bags and ULogs, written only here. The output of the readers is compared with the original numbers,
// and other readers are compared as well (core/tap/test/node/recording_test.mjs).
#pragma once
#include <zstd.h>

#include <cstdint>
#include <cstring>
#include <string>

namespace files {

template <class T>
std::string raw(T value) {
  std::string bytes(sizeof value, '\0');
  std::memcpy(bytes.data(), &value, sizeof value);
  return bytes;
}
inline std::string text(const std::string& words) {
  return raw(static_cast<std::uint32_t>(words.size())) + words;
}

/// XCDR1, little-endian: each number at a multiple of its size, counted from behind the head.
struct Cdr {
  std::string body;
  template <class T>
  Cdr& put(T value) {
    while (body.size() % sizeof value != 0) body += '\x55';  // padding may be anything
    body += raw(value);
    return *this;
  }
  Cdr& put_text(const std::string& words) {
    put(static_cast<std::uint32_t>(words.size() + 1));
    body += words + '\0';
    return *this;
  }
  Cdr& header(std::int32_t s, std::uint32_t ns, const std::string& frame) {
    return put(s).put(ns).put_text(frame);
  }
  std::string bytes() const { return std::string("\0\x01\0\0", 4) + body; }
};

// ---- MCAP

inline std::string record(std::uint8_t code, const std::string& content) {
  return static_cast<char>(code) + raw(static_cast<std::uint64_t>(content.size())) + content;
}
inline const std::string mcap_magic{"\x89MCAP0\r\n", 8};
inline std::string mcap_begin() { return mcap_magic + record(1, text("ros2") + text("fulmar test")); }
inline std::string mcap_end() {
  return record(15, raw(std::uint32_t{0})) +
         record(2, raw(std::uint64_t{0}) + raw(std::uint64_t{0}) + raw(std::uint32_t{0})) + mcap_magic;
}
inline std::string mcap_schema(std::uint16_t id, const std::string& name, const std::string& definition,
                               const std::string& encoding = "ros2msg") {
  return record(3, raw(id) + text(name) + text(encoding) + text(definition));
}
inline std::string mcap_channel(std::uint16_t id, std::uint16_t schema, const std::string& topic,
                                const std::string& encoding = "cdr") {
  return record(4, raw(id) + raw(schema) + text(topic) + text(encoding) + raw(std::uint32_t{0}));
}
inline std::string mcap_message(std::uint16_t channel, std::uint64_t ns, const std::string& data) {
  return record(5, raw(channel) + raw(std::uint32_t{0}) + raw(ns) + raw(ns) + data);
}
/// Bit by bit, of IEEE 802.3.
inline std::uint32_t checksum_of(const std::string& bytes) {
  std::uint32_t crc = ~0U;
  for (const char c : bytes)
    for (int k = 0; k < 8; ++k) {
      const bool odd = ((crc ^ (static_cast<std::uint8_t>(c) >> k)) & 1) != 0;
      crc = odd ? (crc >> 1) ^ 0xEDB88320U : crc >> 1;
    }
  return ~crc;
}
/// `told`: the frame contains the length of its content.
inline std::string packed_zstd(const std::string& plain, bool reported = true) {
  std::string packed(ZSTD_compressBound(plain.size()), '\0');
  ZSTD_CCtx* const context = ZSTD_createCCtx();
  ZSTD_CCtx_setParameter(context, ZSTD_c_contentSizeFlag, reported ? 1 : 0);
  packed.resize(ZSTD_compress2(context, packed.data(), packed.size(), plain.data(), plain.size()));
  ZSTD_freeCCtx(context);
  return packed;
}
/// A chunk of stated size `size`, compressed by `name`.
inline std::string mcap_chunk_of(std::uint64_t size, std::uint32_t checksum, const std::string& name,
                                 const std::string& packed) {
  return record(6, raw(std::uint64_t{0}) + raw(std::uint64_t{1} << 62) + raw(size) + raw(checksum) +
                       text(name) + raw(static_cast<std::uint64_t>(packed.size())) + packed);
}
inline std::string mcap_chunk(const std::string& records, bool zstd) {
  return mcap_chunk_of(records.size(), checksum_of(records), zstd ? "zstd" : "",
                       zstd ? packed_zstd(records) : records);
}

inline const std::string header_definition =
    "================================================================================\n"
    "MSG: std_msgs/Header\n# comment\nbuiltin_interfaces/Time stamp\nstring frame_id\n"
    "================================================================================\n"
    "MSG: builtin_interfaces/Time\nint32 sec\nuint32 nanosec\n";
inline const std::string imu_definition =
    "std_msgs/Header header\ngeometry_msgs/Quaternion orientation\nfloat64[9] orientation_covariance # row "
    "major\n"
    "geometry_msgs/Vector3 angular_velocity\nfloat64[9] angular_velocity_covariance\n"
    "geometry_msgs/Vector3 linear_acceleration\nfloat64[9] linear_acceleration_covariance\n" +
    header_definition +
    "================================================================================\n"
    "MSG: geometry_msgs/Quaternion\nfloat64 x 0\nfloat64 y 0\nfloat64 z 0\nfloat64 w 1\n"
    "================================================================================\n"
    "MSG: geometry_msgs/Vector3\nfloat64 x\nfloat64 y\nfloat64 z\n";
inline const std::string gnss_definition =
    "std_msgs/Header header\nuint8 GNSS_FIX_TYPE_NO_FIX = 0\nuint8 fix_type\nuint8 num_sat\nfloat64 lat\n"
    "float64 lon\nfloat32 alt\nfloat32 horizontal_accuracy\nfloat32 vertical_accuracy\nfloat32 "
    "vel_n\nfloat32 vel_e\n"
    "float32 vel_d\nfloat32 speed_accuracy\nint64 gnss_unix_seconds\nint32 gnss_unix_nanos\n" +
    header_definition;
inline const std::string fix_definition =
    "std_msgs/Header header\nsensor_msgs/NavSatStatus status\nfloat64 latitude\nfloat64 longitude\nfloat64 "
    "altitude\n"
    "float64[9] position_covariance\nuint8 COVARIANCE_TYPE_UNKNOWN = 0\nuint8 position_covariance_type\n" +
    header_definition +
    "================================================================================\n"
    "MSG: sensor_msgs/NavSatStatus\nint8 STATUS_NO_FIX = -1\nint8 status\nuint16 service\n";
inline std::string float_definition(const std::string& fields) {
  return "std_msgs/Header header\n" + fields + header_definition;
}

inline std::string imu_message(std::int32_t s, std::uint32_t ns, const std::string& frame, double k) {
  Cdr c;
  c.header(s, ns, frame);
  for (int i = 0; i < 4 + 9; ++i) c.put(-1.0);
  c.put(0.1 * k).put(0.2 * k).put(0.3 * k);
  for (int i = 0; i < 9; ++i) c.put(-2.0);
  c.put(1.0 * k).put(2.0 * k).put(-9.8);
  for (int i = 0; i < 9; ++i) c.put(-3.0);
  return c.bytes();
}

/// A bag of two seconds since 1970 + 1.7e9 s: IMU in packed chunks, the rest outside and in chunks that are
/// not packed.
inline std::string bag(bool whole = true) {
  constexpr std::int32_t s = 1'700'000'000;
  constexpr std::uint64_t ns = 1'700'000'000'000'000'000;
  std::string file = mcap_begin();
  std::string chunk = mcap_schema(1, "sensor_msgs/msg/Imu", imu_definition) + mcap_channel(1, 1, "/imu/data");
  for (std::uint32_t i = 0; i < 3; ++i)
    chunk += mcap_message(1, ns, imu_message(s, i * 10'000'001, std::string(i, 'f'), i + 1.0));
  file += mcap_chunk(chunk, true);
  file += mcap_schema(2, "rosflight_msgs/msg/GNSS", gnss_definition) + mcap_channel(2, 2, "/gnss");
  Cdr gnss;
  gnss.header(s, 20'000'000, "gps")
      .put(std::uint8_t{3})
      .put(std::uint8_t{11})
      .put(40.25)
      .put(-111.65)
      .put(1387.5F);
  for (const float x : {1.5F, 2.5F, 3.F, -4.F, 0.5F, 0.25F}) gnss.put(x);
  gnss.put(std::int64_t{s}).put(std::int32_t{20'000'000});
  file += mcap_message(2, ns, gnss.bytes());
  std::string plain =
      mcap_schema(3, "sensor_msgs/msg/FluidPressure",
                  float_definition("float64 fluid_pressure\nfloat64 variance\n")) +
      mcap_channel(3, 3, "/pressure") +
      mcap_schema(
          4, "rosflight_msgs/msg/Airspeed",
          float_definition("float32 velocity\nfloat32 differential_pressure\nfloat32 temperature\n")) +
      mcap_channel(4, 4, "/airspeed") +
      mcap_schema(
          5, "sensor_msgs/msg/MagneticField",
          float_definition("geometry_msgs/Vector3 magnetic_field\nfloat64[9] magnetic_field_covariance\n") +
              "===\nMSG: geometry_msgs/Vector3\nfloat64 x\nfloat64 y\nfloat64 z\n") +
      mcap_channel(5, 5, "/mag") + mcap_schema(6, "sensor_msgs/msg/NavSatFix", fix_definition) +
      mcap_channel(6, 6, "/fix");
  plain += mcap_message(3, ns, Cdr{}.header(s, 5'000'000, "static").put(86'000.5).put(0.0).bytes());
  plain += mcap_message(4, ns, Cdr{}.header(s, 5'000'000, "").put(20.F).put(245.F).put(288.F).bytes());
  Cdr mag;
  mag.header(s, 6'000'000, "magnetometer").put(2e-5).put(-1e-6).put(4.5e-5);
  for (int i = 0; i < 9; ++i) mag.put(0.0);
  plain += mcap_message(5, ns, mag.bytes());
  Cdr fix;
  fix.header(s, 7'000'000, "a").put(std::int8_t{0}).put(std::uint16_t{1}).put(40.5).put(-111.5).put(1370.0);
  for (int i = 0; i < 9; ++i) fix.put(0.0);
  fix.put(std::uint8_t{0});
  plain += mcap_message(6, ns, fix.bytes());
  file += mcap_chunk(plain, false);
  return whole ? file + mcap_end() : file;
}

// ---- ULog

inline std::string ulog_record(char kind, const std::string& content) {
  return raw(static_cast<std::uint16_t>(content.size())) + kind + content;
}
inline std::string ulog_begin(char incompatible = 0) {
  std::string flags(40, '\0');
  flags[8] = incompatible;
  return std::string("ULog\x01\x12\x35\x01", 8) + raw(std::uint64_t{1000}) + ulog_record('B', flags);
}
inline std::string ulog_format(const std::string& words) { return ulog_record('F', words); }
inline std::string ulog_topic(std::uint8_t instance, std::uint16_t id, const std::string& name) {
  return ulog_record('A', static_cast<char>(instance) + raw(id) + name);
}
inline std::string ulog_data(std::uint16_t id, const std::string& content) {
  return ulog_record('D', raw(id) + content);
}

/// A log of 20 ms, of PX4's messages as version 1.14 has them, and of a nested one. Times in microseconds.
inline std::string ulog() {
  std::string file = ulog_begin();
  file += ulog_format(
      "sensor_combined:uint64_t timestamp;float[3] gyro_rad;uint32_t gyro_integral_dt;int32_t "
      "accelerometer_timestamp_relative;float[3] accelerometer_m_s2;");
  file += ulog_format(
      "vehicle_air_data:uint64_t timestamp;float baro_alt_meter;float baro_pressure_pa;uint8_t[4] "
      "_padding0;");
  file += ulog_format(
      "differential_pressure:uint64_t timestamp;float differential_pressure_pa;uint8_t[4] _padding0;");
  file += ulog_format("sensor_mag:uint64_t timestamp;float x;float y;float z;");
  file += ulog_format(
      "sensor_gps:uint64_t timestamp;double latitude_deg;double longitude_deg;double altitude_msl_m;float "
      "s_variance_m_s;float eph;float epv;float vel_n_m_s;float vel_e_m_s;float vel_d_m_s;uint8_t "
      "fix_type;uint8_t satellites_used;");
  file += ulog_format("point:uint64_t timestamp;int16_t a;double b;");
  file += ulog_format("own:uint64_t timestamp;point[2] points;bool good;");
  file += ulog_topic(0, 7, "sensor_combined") + ulog_topic(0, 8, "vehicle_air_data") +
          ulog_topic(0, 3, "differential_pressure") + ulog_topic(0, 4, "sensor_mag") +
          ulog_topic(1, 5, "sensor_mag") + ulog_topic(0, 6, "sensor_gps") + ulog_topic(0, 9, "own");
  for (std::uint64_t i = 0; i < 3; ++i) {
    const float k = static_cast<float>(i + 1);
    file +=
        ulog_data(7, raw(1'000'000 + 10'000 * i) + raw(0.5F * k) + raw(0.25F * k) + raw(-0.125F * k) +
                         raw(std::uint32_t{4000}) + raw(std::int32_t{0}) + raw(k) + raw(2 * k) + raw(-9.75F));
  }
  const std::uint64_t t = 1'005'000;
  file += ulog_record('O', raw(std::uint16_t{12}));  // a dropout of 12 ms, reported by the logger
  file += ulog_data(8, raw(t) + raw(1300.F) + raw(86'000.5F));
  file += ulog_data(3, raw(t) + raw(245.F));
  file += ulog_data(4, raw(t) + raw(0.2F) + raw(-0.01F) + raw(0.45F));
  file += ulog_data(5, raw(t) + raw(0.25F) + raw(-0.05F) + raw(0.5F));
  file += ulog_data(6, raw(t) + raw(40.25) + raw(-111.65) + raw(1387.5) + raw(0.25F) + raw(1.5F) + raw(2.5F) +
                           raw(3.F) + raw(-4.F) + raw(0.5F) + raw(std::uint8_t{6}) + raw(std::uint8_t{11}));
  file += ulog_data(9, raw(t) + raw(t) + raw(std::int16_t{-3}) + raw(1.5) + raw(t) + raw(std::int16_t{4}) +
                           raw(-2.5) + raw(std::uint8_t{1}));
  return file;
}

}  // namespace files
