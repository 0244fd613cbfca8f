// SPDX-License-Identifier: BSD-3-Clause
// Hand-written type tables for the tests, with offsets that the compiler states.
#pragma once
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/loader/table.hpp"
#include "fulmar/abi.h"

namespace tables {

inline fulmar_field field(const char* name, const char* unit, std::uint32_t kind, std::size_t offset,
                          std::size_t stride) {
  return {name,
          unit,
          nullptr,
          nullptr,
          0,
          kind,
          FULMAR_SCALAR,
          static_cast<std::uint32_t>(offset),
          1,
          static_cast<std::uint32_t>(stride),
          0,
          -INFINITY,
          INFINITY,
          0};
}
inline fulmar_field real(const char* name, const char* unit, std::size_t offset) {
  return field(name, unit, FULMAR_F64, offset, 8);
}
inline fulmar_field in_range(fulmar_field f, double min, double max) {
  f.min = min;
  f.max = max;
  return f;
}
inline fulmar_field nested(const char* name, const char* unit, const fulmar_type& type, std::size_t offset) {
  fulmar_field f = field(name, unit, FULMAR_STRUCT, offset, type.size);
  f.type = &type;
  return f;
}
template <std::size_t N>
fulmar_field labelled(const char* name, const char* const (&labels)[N], std::size_t offset) {
  fulmar_field f = field(name, "", FULMAR_ENUM, offset, 1);
  f.labels = labels;
  f.label_count = N;
  return f;
}
inline fulmar_field array(fulmar_field f, std::uint32_t count) {
  f.shape = FULMAR_ARRAY;
  f.count = count;
  return f;
}
inline fulmar_field list(fulmar_field f, std::uint32_t capacity, std::size_t items) {
  f.shape = FULMAR_LIST;
  f.count = capacity;
  f.items = static_cast<std::uint32_t>(items);
  return f;
}
inline fulmar_type type(const char* name, const std::vector<fulmar_field>& fields, std::size_t size,
                        std::size_t align = 8, const char* frame = "") {
  return {name,
          frame,
          "",
          fields.data(),
          static_cast<std::uint32_t>(fields.size()),
          sizeof(fulmar_field),
          static_cast<std::uint32_t>(size),
          static_cast<std::uint32_t>(align)};
}

// A message with one of everything.
struct Vec {
  double north, east, down;
};
struct Waypoint {
  Vec position_m;
  double airspeed_mps;
  std::uint8_t hold;
};
struct Route {
  double airspeed_mps;
  double throttle_frac;
  Vec position_m;
  float heading_rad;
  std::int32_t lap;
  double gains_ratio[4];
  std::uint8_t mode, valid;
  char label[14];
  struct {
    std::uint32_t count;
    Waypoint items[5];
  } waypoints;
  std::uint64_t serial;
  Vec corners_m[2];
};

inline const char* const modes[] = {"idle", "glide", "climb"};
inline const std::vector<fulmar_field> vec_fields{real("north", "", 0), real("east", "", 8),
                                                  real("down", "", 16)};
inline const fulmar_type vec = type("Vec3", vec_fields, sizeof(Vec), 8, "ned");
inline const std::vector<fulmar_field> waypoint_fields{
    nested("position_m", "m", vec, offsetof(Waypoint, position_m)),
    real("airspeed_mps", "m/s", offsetof(Waypoint, airspeed_mps)),
    field("hold", "", FULMAR_BOOL, offsetof(Waypoint, hold), 1)};
inline const fulmar_type waypoint = type("Waypoint", waypoint_fields, sizeof(Waypoint));
inline std::vector<fulmar_field> route_fields() {
  return {real("airspeed_mps", "m/s", offsetof(Route, airspeed_mps)),
          in_range(real("throttle_frac", "", offsetof(Route, throttle_frac)), 0, 1),
          nested("position_m", "m", vec, offsetof(Route, position_m)),
          field("heading_rad", "rad", FULMAR_F32, offsetof(Route, heading_rad), 4),
          in_range(field("lap", "", FULMAR_I32, offsetof(Route, lap), 4), -2, 9),
          array(real("gains_ratio", "", offsetof(Route, gains_ratio)), 4),
          labelled("mode", modes, offsetof(Route, mode)),
          field("valid", "", FULMAR_BOOL, offsetof(Route, valid), 1),
          field("label", "", FULMAR_TEXT, offsetof(Route, label), 14),
          list(nested("waypoints", "", waypoint, offsetof(Route, waypoints)), 5,
               offsetof(Route, waypoints.items) - offsetof(Route, waypoints)),
          field("serial", "", FULMAR_U64, offsetof(Route, serial), 8),
          array(nested("corners_m", "m", vec, offsetof(Route, corners_m)), 2)};
}
inline const std::vector<fulmar_field> route_table = route_fields();
inline const fulmar_type route = type("Route", route_table, sizeof(Route));

template <class T>
const std::byte* bytes(const T& message) {
  return reinterpret_cast<const std::byte*>(&message);
}

}  // namespace tables
