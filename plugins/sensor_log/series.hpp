// SPDX-License-Identifier: BSD-3-Clause
// Units, axes and calibration: converts the numbers of a row to a message.
#pragma once
#include <fulmar/flight/earth/atmosphere.hpp>
#include <numbers>

#include "layouts.hpp"
#include "reader.hpp"

namespace fulmar::sensor_log {

inline Vec3<Body> body(const std::array<double, 3>& raw, double unit, BodyAxes axes, const Vec3<Body>& offset,
                       const Vec3<Body>& scale) {
  const double turned = axes == BodyAxes::flu ? -unit : unit;
  return {scale.x * (raw[0] * unit - offset.x), scale.y * (raw[1] * turned - offset.y),
          scale.z * (raw[2] * turned - offset.z)};
}

inline Series<Imu> read_imu(const ImuLog& description, Files& files) {
  const ImuLog log = with_layout(description, files, "log.imu");
  constexpr std::array<double, 2> rates = {1, std::numbers::pi / 180};
  constexpr std::array<double, 2> forces = {1, isa::g0};
  Reader file(log.from, files, "log.imu");
  const auto rate = file.want(log.rate.columns, "rate");
  const auto force = file.want(log.specific_force.columns, "specific_force");
  const RateColumns& w = log.rate;
  const ForceColumns& f = log.specific_force;
  const double rate_unit = rates[static_cast<std::size_t>(w.unit)];
  const double force_unit = forces[static_cast<std::size_t>(f.unit)];
  return file.read<Imu>([&](std::size_t i) {
    Imu imu;
    imu.rate_radps = body(file.numbers(rate, i), rate_unit, w.axes, w.offset_radps, w.scale_ratio);
    imu.specific_force_mps2 = body(file.numbers(force, i), force_unit, f.axes, f.offset_mps2, f.scale_ratio);
    return imu;
  });
}

inline Series<Mag> read_mag(const MagLog& description, Files& files) {
  const MagLog log = with_layout(description, files, "log.mag");
  constexpr std::array<double, 5> units = {1, 1e-6, 1e-9, 1e-4, 1e-7};
  Reader file(log.from, files, "log.mag");
  const auto field = file.want(log.field.columns, "field");
  const FieldColumns& b = log.field;
  const double unit = units[static_cast<std::size_t>(b.unit)];
  return file.read<Mag>([&](std::size_t i) {
    return Mag{body(file.numbers(field, i), unit, b.axes, b.offset_tesla, b.scale_ratio)};
  });
}

inline Series<Baro> read_baro(const BaroLog& description, Files& files) {
  const BaroLog log = with_layout(description, files, "log.baro");
  constexpr std::array<double, 3> units = {1, 100, 1000};
  Reader file(log.from, files, "log.baro");
  const PressureColumn& p = log.pressure;
  const std::size_t column = file.want(p.column, "pressure.column");
  return file.read<Baro>([&](std::size_t i) {
    const double raw = file.number(column, i);
    const double pa = p.unit == PressureUnit::m ? standard_air(p.height_zero_m + raw).pressure_pa
                                                : raw * units[static_cast<std::size_t>(p.unit)];
    return Baro{p.scale_ratio * (pa - p.offset_pa)};
  });
}

inline Series<Pitot> read_pitot(const PitotLog& description, Files& files) {
  const PitotLog log = with_layout(description, files, "log.pitot");
  Reader file(log.from, files, "log.pitot");
  const PitotColumn& p = log.pressure;
  const std::size_t column = file.want(p.column, "pressure.column");
  return file.read<Pitot>([&](std::size_t i) {
    const double raw = file.number(column, i);
    const double q = p.unit == PitotUnit::mps ? 0.5 * isa::sea_level_density * raw * std::abs(raw)
                                              : (p.unit == PitotUnit::hpa ? 100 : 1) * raw;
    Pitot pitot;
    pitot.pressure_pa = p.scale_ratio * (q - p.offset_pa);
    pitot.indicated_airspeed_mps = indicated_airspeed(pitot.pressure_pa);
    return pitot;
  });
}

inline FixType fix_of(FixCode code, double number) {
  const int n = static_cast<int>(std::clamp(number, -1.0, 100.0));
  if (code == FixCode::fulmar) return n >= 0 && n <= 7 ? static_cast<FixType>(n) : FixType::none;
  if (code == FixCode::navsat) return n >= 0 ? FixType::fix_3d : FixType::none;
  if (code == FixCode::px4 && n == 5) return FixType::rtk_float;
  if (code == FixCode::px4 && n == 6) return FixType::rtk_fixed;
  if (code == FixCode::px4 && n == 8) return FixType::dead_reckoning;
  return n >= 3 ? FixType::fix_3d : n == 2 ? FixType::fix_2d : FixType::none;
}

/// Optional columns of fixes.
struct FixExtras {
  std::size_t fix = 0, satellites = 0, horizontal = 0, vertical = 0, speed = 0, velocity = 0;
  std::array<std::size_t, 3> velocities{};

  FixExtras(Reader& file, const GnssLog& log) {
    const auto maybe = [&](const Name& column, const char* use) {
      return column.view().empty() ? 0 : file.want(column, use);
    };
    fix = maybe(log.fix.column, "fix.column");
    satellites = maybe(log.satellites, "satellites");
    horizontal = maybe(log.horizontal_std, "horizontal_std");
    vertical = maybe(log.vertical_std, "vertical_std");
    speed = maybe(log.speed_std, "speed_std");
    if (log.velocity.columns[0].view().empty()) return;
    velocities = file.want(log.velocity.columns, "velocity");
    velocity = velocities[0];
  }
};

inline Vec3<Ned> ned(const std::array<double, 3>& raw, const VelocityColumns& v) {
  constexpr std::array<double, 5> units = {1, 1e-2, 1e-3, 1 / 3.6, 1852.0 / 3600};
  const double unit = units[static_cast<std::size_t>(v.unit)];
  if (v.axes == LocalAxes::enu) return {raw[1] * unit, raw[0] * unit, -raw[2] * unit};
  return {raw[0] * unit, raw[1] * unit, raw[2] * unit};
}

/// Fixes without a velocity have velocity zero with the standard deviation of an unknown value.
inline Series<Gnss> read_gnss(const GnssLog& description, Files& files) {
  const GnssLog log = with_layout(description, files, "log.gnss");
  constexpr std::array<double, 3> angles = {1, 1e-7, 180 / std::numbers::pi}, lengths = {1, 1e-2, 1e-3};
  Reader file(log.from, files, "log.gnss");
  const auto place = file.want(log.position.columns, "position");
  const FixExtras extra(file, log);
  const double angle = angles[static_cast<std::size_t>(log.position.unit)];
  const double length = lengths[static_cast<std::size_t>(log.position.altitude_unit)];
  return file.read<Gnss>([&](std::size_t i) {
    Gnss g;
    g.latitude_deg = file.number(place[0], i) * angle;
    g.longitude_deg = file.number(place[1], i) * angle;
    g.altitude_m = file.number(place[2], i) * length - log.position.geoid_m;
    if (extra.velocity != 0) g.velocity_mps = ned(file.numbers(extra.velocities, i), log.velocity);
    const auto deviation = [&](std::size_t column) {
      const double number = column != 0 ? file.number(column, i) : 0;
      return number > 0 ? number : unknown_std;
    };
    g.horizontal_std_m = deviation(extra.horizontal);
    g.vertical_std_m = deviation(extra.vertical);
    g.speed_std_mps = deviation(extra.speed);
    g.fix = extra.fix != 0 ? fix_of(log.fix.code, file.number(extra.fix, i)) : FixType::fix_3d;
    if (extra.satellites != 0)
      g.satellites = static_cast<std::uint8_t>(std::clamp(file.number(extra.satellites, i), 0.0, 255.0));
    return g;
  });
}

}  // namespace fulmar::sensor_log
