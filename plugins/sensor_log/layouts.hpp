// SPDX-License-Identifier: BSD-3-Clause
// Messages whose columns and units need not be written: sensor_msgs and rosflight_msgs of ROS 2, Fulmar's
// own, and PX4's.
// What a description says itself stays. Sources: the interface definitions of these packages.
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

/// Bags are stamped in the message's header, or by their recorder; ULogs in microseconds since the start.
inline void assume_time(Source& from, const Topic& topic) {
  if (said(from.time)) return;
  if (topic.has("header.stamp"))
    from.time = "header.stamp", from.unit = TimeUnit::ns;
  else if (topic.has("timestamp"))
    from.time = "timestamp", from.unit = TimeUnit::us;
  else if (topic.has("log_time"))
    from.time = "log_time", from.unit = TimeUnit::ns;
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
  if (topic.type == "airspeed")
    log.pressure.column = "indicated_airspeed_m_s", log.pressure.unit = PitotUnit::mps;
}

inline void assume_ros(GnssLog& log, const Topic& topic) {
  if (topic.type == "sensor_msgs/msg/NavSatFix") {
    log.position.columns = {"latitude", "longitude", "altitude"};
    log.fix = {"status.status", FixCode::navsat};
  }
  if (topic.type == "rosflight_msgs/msg/GNSS") {
    log.position.columns = {"lat", "lon", "alt"};
    log.velocity.columns = {"vel_n", "vel_e", "vel_d"};
    log.fix = {"fix_type", FixCode::fulmar};
    log.satellites = "num_sat";
    log.horizontal_std = "horizontal_accuracy", log.vertical_std = "vertical_accuracy";
    log.speed_std = "speed_accuracy";
  }
  if (topic.type == "fulmar_msgs/msg/Gnss") {
    log.position.columns = {"latitude_deg", "longitude_deg", "altitude_m"};
    log.velocity.columns = {"velocity_mps.north", "velocity_mps.east", "velocity_mps.down"};
    log.fix = {"fix", FixCode::fulmar};
    log.satellites = "satellites";
    log.horizontal_std = "horizontal_std_m", log.vertical_std = "vertical_std_m";
    log.speed_std = "speed_std_mps";
  }
}

inline void assume(GnssLog& log, const Topic& topic) {
  if (said(log.position.columns)) return;
  assume_ros(log, topic);
  if (topic.type != "sensor_gps" && topic.type != "vehicle_gps_position") return;
  if (topic.has("latitude_deg")) {  // since version 1.14
    log.position.columns = {"latitude_deg", "longitude_deg", "altitude_msl_m"};
  } else {
    log.position = {{"lat", "lon", "alt"}, AngleUnit::deg_e7, LengthUnit::mm};
  }
  log.velocity.columns = {"vel_n_m_s", "vel_e_m_s", "vel_d_m_s"};
  log.fix = {"fix_type", FixCode::px4};
  log.satellites = "satellites_used";
  log.horizontal_std = "eph", log.vertical_std = "epv", log.speed_std = "s_variance_m_s";
}

/// What the description says, and what goes without saying of the topic.
template <class Log>
Log with_layout(Log log, Files& files, const std::string& key) {
  const Topic topic = files.look(log.from, key);
  if (topic.type.empty()) return log;
  assume_time(log.from, topic);
  assume(log, topic);
  return log;
}

}  // namespace fulmar::sensor_log
