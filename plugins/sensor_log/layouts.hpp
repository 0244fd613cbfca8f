// SPDX-License-Identifier: BSD-3-Clause
// Messages with default columns: sensor_msgs and rosflight_msgs of ROS 2, Fulmar's own, and PX4's. A column
// in the description has priority; units of the message apply only to its default columns. Sources: the
// interface definitions of these packages.
#pragma once
#include <utility>

#include "files.hpp"

namespace fulmar::sensor_log {

inline bool said(const Name& name) { return !name.view().empty(); }
inline bool said(const std::array<Name, 3>& names) { return said(names[0]); }

inline std::array<Name, 3> axes_of(const std::string& stem, bool numbered) {
  return {Name(stem + (numbered ? "[0]" : ".x")), Name(stem + (numbered ? "[1]" : ".y")),
          Name(stem + (numbered ? "[2]" : ".z"))};
}

/// Bags have stamps in the header of a message or from their recorder; ULogs have microseconds since the
/// start.
inline void assume_time(Source& from, const Topic& topic) {
  if (said(from.time)) return;
  if (topic.has("header.stamp")) {
    from.time = "header.stamp";
    from.unit = TimeUnit::ns;
  } else if (topic.has("timestamp")) {
    from.time = "timestamp";
    from.unit = TimeUnit::us;
  } else if (topic.has("log_time")) {
    from.time = "log_time";
    from.unit = TimeUnit::ns;
  }
}

inline void assume(ImuLog& log, const Topic& topic) {
  struct Layout {
    const char *type, *rate, *force;
    bool numbered;
  };
  constexpr std::array<Layout, 3> all = {
      {{"sensor_msgs/msg/Imu", "angular_velocity", "linear_acceleration", false},
       {"fulmar_msgs/msg/Imu", "rate_radps", "specific_force_mps2", false},
       {"sensor_combined", "gyro_rad", "accelerometer_m_s2", true}}};
  for (const Layout& each : all) {
    if (topic.type != each.type) continue;
    if (!said(log.rate.columns)) log.rate.columns = axes_of(each.rate, each.numbered);
    if (!said(log.specific_force.columns)) log.specific_force.columns = axes_of(each.force, each.numbered);
  }
}

inline void assume(MagLog& log, const Topic& topic) {
  if (said(log.field.columns)) return;
  if (topic.type == "sensor_msgs/msg/MagneticField") log.field.columns = axes_of("magnetic_field", false);
  if (topic.type == "fulmar_msgs/msg/Mag") log.field.columns = axes_of("field_tesla", false);
  if (topic.type != "vehicle_magnetometer" && topic.type != "sensor_mag") return;
  log.field.unit = FieldUnit::gauss;
  if (topic.type == "sensor_mag")
    log.field.columns = {"x", "y", "z"};
  else
    log.field.columns = axes_of("magnetometer_ga", true);
}

inline void assume(BaroLog& log, const Topic& topic) {
  constexpr std::array<std::pair<const char*, const char*>, 4> all = {
      {{"sensor_msgs/msg/FluidPressure", "fluid_pressure"},
       {"rosflight_msgs/msg/Barometer", "pressure"},
       {"fulmar_msgs/msg/Baro", "pressure_pa"},
       {"vehicle_air_data", "baro_pressure_pa"}}};
  for (const auto& [type, column] : all)
    if (topic.type == type && !said(log.pressure.column)) log.pressure.column = column;
}

inline void assume(PitotLog& log, const Topic& topic) {
  if (said(log.pressure.column)) return;
  constexpr std::array<std::pair<const char*, const char*>, 3> all = {
      {{"sensor_msgs/msg/FluidPressure", "fluid_pressure"},
       {"rosflight_msgs/msg/Airspeed", "differential_pressure"},
       {"fulmar_msgs/msg/Pitot", "pressure_pa"}}};
  for (const auto& [type, column] : all)
    if (topic.type == type) log.pressure.column = column;
  if (topic.type == "differential_pressure")
    log.pressure.column =
        topic.has("differential_pressure_pa") ? "differential_pressure_pa" : "differential_pressure_raw_pa";
  if (topic.type == "airspeed") {
    log.pressure.column = "indicated_airspeed_m_s";
    log.pressure.unit = PitotUnit::mps;
  }
}

/// Names of the fields in a receiver's message; "" for a missing one.
struct GnssLayout {
  const char* type;
  std::array<const char*, 3> place, velocity;
  const char* fix;
  FixCode code;
  const char *satellites = "", *horizontal_std = "", *vertical_std = "", *speed_std = "";
  AngleUnit angle = AngleUnit::deg;
  LengthUnit length = LengthUnit::m;
};
inline constexpr std::array<const char*, 3> px4_velocity = {"vel_n_m_s", "vel_e_m_s", "vel_d_m_s"};
inline constexpr std::array<GnssLayout, 5> gnss_layouts = {
    {{"sensor_msgs/msg/NavSatFix",
      {"latitude", "longitude", "altitude"},
      {"", "", ""},
      "status.status",
      FixCode::navsat},
     {"rosflight_msgs/msg/GNSS",
      {"lat", "lon", "alt"},
      {"vel_n", "vel_e", "vel_d"},
      "fix_type",
      FixCode::fulmar,
      "num_sat",
      "horizontal_accuracy",
      "vertical_accuracy",
      "speed_accuracy"},
     {"fulmar_msgs/msg/Gnss",
      {"latitude_deg", "longitude_deg", "altitude_m"},
      {"velocity_mps.north", "velocity_mps.east", "velocity_mps.down"},
      "fix",
      FixCode::fulmar,
      "satellites",
      "horizontal_std_m",
      "vertical_std_m",
      "speed_std_mps"},
     {"sensor_gps",
      {"latitude_deg", "longitude_deg", "altitude_msl_m"},
      px4_velocity,
      "fix_type",
      FixCode::px4,
      "satellites_used",
      "eph",
      "epv",
      "s_variance_m_s"},
     {"sensor_gps",
      {"lat", "lon", "alt"},
      px4_velocity,
      "fix_type",
      FixCode::px4,
      "satellites_used",
      "eph",
      "epv",
      "s_variance_m_s",
      AngleUnit::deg_e7,
      LengthUnit::mm}}};  // before version 1.14

inline void assume(GnssLog& log, const Topic& topic) {
  const auto one = [&](Name& at, const char* column) {
    if (!said(at) && topic.has(column)) at = column;
  };
  const auto three = [&](std::array<Name, 3>& at, const std::array<const char*, 3>& columns) {
    const bool unsaid = !said(at) && topic.has(columns[0]);
    if (unsaid) at = {columns[0], columns[1], columns[2]};
    return unsaid;
  };
  const std::string type = topic.type == "vehicle_gps_position" ? "sensor_gps" : topic.type;
  for (const GnssLayout& each : gnss_layouts) {
    if (type != each.type) continue;
    if (three(log.position.columns, each.place)) {
      log.position.unit = each.angle;
      log.position.altitude_unit = each.length;
    }
    three(log.velocity.columns, each.velocity);
    if (!said(log.fix.column)) log.fix.code = each.code;
    one(log.fix.column, each.fix);
    one(log.satellites, each.satellites);
    one(log.horizontal_std, each.horizontal_std);
    one(log.vertical_std, each.vertical_std);
    one(log.speed_std, each.speed_std);
  }
}

/// The source as described, with the defaults of the topic.
template <class Log>
Log with_layout(Log log, Files& files, const std::string& key) {
  const Topic topic = files.look(log.from, key);
  if (topic.type.empty()) return log;
  assume_time(log.from, topic);
  assume(log, topic);
  return log;
}

}  // namespace fulmar::sensor_log
