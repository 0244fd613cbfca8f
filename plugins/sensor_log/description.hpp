// SPDX-License-Identifier: BSD-3-Clause
// Content of a file in configs/sensor_logs: the columns and files of the sensors of a recorded flight, their
// units, delays, calibration, and times in which they are withheld. The host reports all faults in it.
#pragma once
#include "fulmar/message.hpp"

namespace fulmar::sensor_log {

using Name = Text<64>;

enum class TimeUnit : std::uint8_t { s, ms, us, ns };
enum class RateUnit : std::uint8_t { radps, degps };
enum class ForceUnit : std::uint8_t { mps2, g };
enum class FieldUnit : std::uint8_t { tesla, microtesla, nanotesla, gauss, milligauss };
/// `m`: a height above `height_zero`, in the standard atmosphere.
enum class PressureUnit : std::uint8_t { pa, hpa, kpa, m };
/// `mps`: indicated airspeed.
enum class PitotUnit : std::uint8_t { pa, hpa, mps };
enum class AngleUnit : std::uint8_t { deg, deg_e7, rad };
enum class LengthUnit : std::uint8_t { m, cm, mm };
enum class SpeedUnit : std::uint8_t { mps, cmps, mmps, kmph, kt };
enum class BodyAxes : std::uint8_t { frd, flu };
enum class LocalAxes : std::uint8_t { ned, enu };
/// Code of the fix type in a column. `fulmar`: values of FixType, as u-blox. `dimensions`: 2 and 3. `navsat`:
/// sensor_msgs/NavSatStatus, a fix from 0 on. `px4`: 2 and 3, from 4 on with corrections, 5 RTK float, 6 RTK
/// fixed.
enum class FixCode : std::uint8_t { fulmar, dimensions, navsat, px4 };

/// Interval of flight time; `to` is exclusive.
struct Window {
  double from_s = -1e9, to_s = 1e9;
};

/// The rows of one sensor.
struct Source {
  Name file;                    ///< file in the folder: *.csv, *.mcap, *.ulg; "": no such sensor
  Name topic;                   ///< topic of a bag or a ULog; "sensor_mag#1" is a second instance
  Name time;                    ///< column with the time of arrival of a row
  TimeUnit unit = TimeUnit::s;  ///< unit of that time
  double shift_s = 0;           ///< addition to that time: offset between the clocks of two files
  double delay_s = 0;           ///< delay from the measurement to that time
  Name changes;                 ///< column that marks new samples: rows with the value of the row before are
                                ///< skipped
};

/// Columns of the axes x, y, z. value = scale (number - offset), in body axes.
struct RateColumns {
  std::array<Name, 3> columns;
  RateUnit unit = RateUnit::radps;
  BodyAxes axes = BodyAxes::frd;
  Vec3<Body> offset_radps, scale_ratio{1, 1, 1};
};
struct ForceColumns {
  std::array<Name, 3> columns;
  ForceUnit unit = ForceUnit::mps2;
  BodyAxes axes = BodyAxes::frd;
  Vec3<Body> offset_mps2, scale_ratio{1, 1, 1};
};
struct FieldColumns {
  std::array<Name, 3> columns;
  FieldUnit unit = FieldUnit::tesla;
  BodyAxes axes = BodyAxes::frd;
  Vec3<Body> offset_tesla, scale_ratio{1, 1, 1};
};
struct PressureColumn {
  Name column;
  PressureUnit unit = PressureUnit::pa;
  double height_zero_m = 0;  ///< height of the zero of unit `m` above mean sea level
  double offset_pa = 0, scale_ratio = 1;
};
struct PitotColumn {
  Name column;
  PitotUnit unit = PitotUnit::pa;
  double offset_pa = 0, scale_ratio = 1;
};
struct PlaceColumns {
  std::array<Name, 3> columns;  ///< columns of latitude, longitude and altitude above mean sea
                                ///< level
  AngleUnit unit = AngleUnit::deg;
  LengthUnit altitude_unit = LengthUnit::m;
  double geoid_m = 0;  ///< height of mean sea level above the ellipsoid, for altitudes
                       ///< above the ellipsoid
};
struct VelocityColumns {
  std::array<Name, 3> columns;
  SpeedUnit unit = SpeedUnit::mps;
  LocalAxes axes = LocalAxes::ned;
};
struct FixColumn {
  Name column;  ///< column of the fix type; "": a three-dimensional fix in every row
  FixCode code = FixCode::fulmar;
};

struct ImuLog {
  Source from;
  RateColumns rate;
  ForceColumns specific_force;
  List<Window, 32> withhold;
};
struct MagLog {
  Source from;
  FieldColumns field;
  List<Window, 32> withhold;
};
struct BaroLog {
  Source from;
  PressureColumn pressure;
  List<Window, 32> withhold;
};
struct PitotLog {
  Source from;
  PitotColumn pressure;
  List<Window, 32> withhold;
};
struct GnssLog {
  Source from;
  PlaceColumns position;
  VelocityColumns velocity;
  FixColumn fix;
  Name satellites, horizontal_std, vertical_std, speed_std;  ///< columns; standard deviations in m and m/s
  List<Window, 32> withhold;
};

struct Description {
  Name name;
  double utc_at_zero_s = 0;  ///< UTC of flight time 0, since 1970; 0: unknown
  Window use;                ///< interval of flight time that is used; a file that ends before `to` ends
                             ///< early
  Window armed, airborne;    ///< intervals of the armed state and of flight
  ImuLog imu;
  MagLog mag;
  BaroLog baro;
  PitotLog pitot;
  GnssLog gnss;
};

}  // namespace fulmar::sensor_log

namespace fulmar {

// bounds that keep nanoseconds within their integers
template <>
inline constexpr std::array<FieldRange, 2> field_ranges<sensor_log::Window>{
    {{"from_s", -1e9, 1e9}, {"to_s", -1e9, 1e9}}};
template <>
inline constexpr std::array<FieldRange, 2> field_ranges<sensor_log::Source>{
    {{"shift_s", -1e9, 1e9}, {"delay_s", 0, 10}}};
template <>
inline constexpr std::array<FieldRange, 1> field_ranges<sensor_log::Description>{{{"utc_at_zero_s", 0, 4e9}}};

}  // namespace fulmar
