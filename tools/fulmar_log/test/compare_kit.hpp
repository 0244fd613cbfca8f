// SPDX-License-Identifier: BSD-3-Clause
// Logs written by hand, and the output of fulmar log compare for them.
#pragma once
#include <doctest/doctest.h>

#include <CLI/CLI.hpp>
#include <Eigen/Geometry>
#include <cmath>
#include <functional>
#include <iostream>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>
#include <sstream>
#include <string>

#include "core/error.hpp"
#include "core/loader/table.hpp"
#include "core/log/test/log_kit.hpp"
#include "fulmar/msg/filter_check.hpp"
#include "fulmar/msg/gnss.hpp"
#include "fulmar/msg/vehicle_state.hpp"
#include "fulmar/schema.hpp"
#include "tools/fulmar_log/log_command.hpp"

namespace compare_test {

using namespace fulmar;
using core::test::Folder;
using nlohmann::json;

inline constexpr double degree = std::numbers::pi / 180;
inline constexpr std::int64_t ms = 1'000'000;

/// A log with states, fixes and checks.
class Log {
 public:
  explicit Log(const std::filesystem::path& file) : sample_({.file = file, .max_message_bytes = 4096}) {}
  ~Log() { sample_.writer.close(); }

  template <class Message>
  void write(const std::string& topic, std::int64_t at_ns, const Message& message, std::int64_t age_ns = 0) {
    static const core::TypePtr type = core::copy_type(describe<Message>());
    write_as(topic, *type, at_ns, message, age_ns);
  }
  template <class Message>
  void write_as(const std::string& topic, const core::Type& type, std::int64_t at_ns, const Message& message,
                std::int64_t age_ns = 0) {
    if (!channels_.contains(topic)) channels_[topic] = sample_.channel(topic, type);
    sample_.write(channels_[topic], at_ns, reinterpret_cast<const std::byte*>(&message), 0,
                  static_cast<std::uint64_t>(age_ns));
  }

 private:
  core::test::Sample sample_;
  std::map<std::string, std::uint16_t> channels_;
};

/// Valid throughout, with given standard deviations.
inline VehicleState state(double std = 1) {
  VehicleState s;
  s.origin_latitude_deg = 47;
  s.origin_longitude_deg = 8;
  s.origin_altitude_m = 400;
  s.origin_valid = s.attitude_valid = s.velocity_valid = s.position_valid = s.height_valid =
      s.airspeed_valid = s.wind_valid = true;
  s.position_std_m = s.velocity_std_mps = s.attitude_std_rad = s.wind_std_mps = {std, std, std};
  s.airspeed_std_mps = std;
  return s;
}
inline void turn_to(VehicleState& s, const Eigen::Quaterniond& q) {
  const Eigen::Matrix3d R = q.toRotationMatrix();
  s.attitude = {q.w(), q.x(), q.y(), q.z()};
  s.roll_rad = std::atan2(R(2, 1), R(2, 2));
  s.pitch_rad = std::asin(-R(2, 0));
  s.yaw_rad = std::atan2(R(1, 0), R(0, 0));
}
inline Eigen::Quaterniond euler(double roll, double pitch, double yaw) {
  using A = Eigen::AngleAxisd;
  return A(yaw, Eigen::Vector3d::UnitZ()) * A(pitch, Eigen::Vector3d::UnitY()) *
         A(roll, Eigen::Vector3d::UnitX());
}

struct Said {
  int code = 0;
  std::string text;
};
inline Said say(const std::string& words) {
  CLI::App app;
  const core::LogCommand log(app);
  std::ostringstream out;
  std::streambuf* const before = std::cout.rdbuf(out.rdbuf());
  Said said;
  try {
    app.parse("log compare " + words);
    said.code = log.run();
  } catch (const CLI::ParseError&) {
    said.code = 2;
  } catch (const core::Error& e) {
    said = {1, e.what()};
  }
  std::cout.rdbuf(before);
  if (said.code == 0) said.text = out.str();
  return said;
}
/// The only comparison that it makes.
inline json compared(const std::string& words) {
  const Said said = say("--json " + words);
  INFO(said.text);
  REQUIRE(said.code == 0);
  const json estimates = json::parse(said.text).at("estimates");
  REQUIRE(estimates.size() == 1);
  return estimates.at(0);
}

/// Two filters and the truth at 50 Hz for `n` samples; `make` sets them.
using Make = std::function<void(int i, VehicleState& first, VehicleState& second, VehicleState& truth)>;
inline void write_three(const std::filesystem::path& file, int n, const Make& make) {
  Log log(file);
  for (int i = 0; i < n; ++i) {
    VehicleState first = state(), second = state(), truth = state(0);
    make(i, first, second, truth);
    log.write("/vehicle/truth", i * 20 * ms, truth);
    log.write("/nav/state", i * 20 * ms, first);
    log.write("/second/state", i * 20 * ms, second);
  }
}

}  // namespace compare_test
