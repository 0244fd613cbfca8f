// SPDX-License-Identifier: BSD-3-Clause
// fulmar log compare, of logs that are written by hand with errors that are known.
#include <doctest/doctest.h>

#include <CLI/CLI.hpp>
#include <Eigen/Geometry>
#include <cmath>
#include <functional>
#include <iostream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <random>

#include "core/error.hpp"
#include "core/loader/table.hpp"
#include "core/log/test/log_kit.hpp"
#include "fulmar/msg/filter_check.hpp"
#include "fulmar/msg/gnss.hpp"
#include "fulmar/msg/vehicle_state.hpp"
#include "fulmar/schema.hpp"
#include "tools/fulmar_log/log_command.hpp"

namespace compare_test {
namespace {

using namespace fulmar;
using core::test::Folder;
using nlohmann::json;

constexpr double degree = std::numbers::pi / 180;
constexpr std::int64_t ms = 1'000'000;

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

/// Valid throughout, with deviations that are known.
VehicleState state(double std = 1) {
  VehicleState s;
  s.origin_latitude_deg = 47, s.origin_longitude_deg = 8, s.origin_altitude_m = 400;
  s.origin_valid = s.attitude_valid = s.velocity_valid = s.position_valid = s.height_valid =
      s.airspeed_valid = s.wind_valid = true;
  s.position_std_m = s.velocity_std_mps = s.attitude_std_rad = s.wind_std_mps = {std, std, std};
  s.airspeed_std_mps = std;
  return s;
}
void turn_to(VehicleState& s, const Eigen::Quaterniond& q) {
  const Eigen::Matrix3d R = q.toRotationMatrix();
  s.attitude = {q.w(), q.x(), q.y(), q.z()};
  s.roll_rad = std::atan2(R(2, 1), R(2, 2)), s.pitch_rad = std::asin(-R(2, 0));
  s.yaw_rad = std::atan2(R(1, 0), R(0, 0));
}
Eigen::Quaterniond euler(double roll, double pitch, double yaw) {
  using A = Eigen::AngleAxisd;
  return A(yaw, Eigen::Vector3d::UnitZ()) * A(pitch, Eigen::Vector3d::UnitY()) *
         A(roll, Eigen::Vector3d::UnitX());
}

struct Said {
  int code = 0;
  std::string text;
};
Said say(const std::string& words) {
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
json compared(const std::string& words) {
  const Said said = say("--json " + words);
  INFO(said.text);
  REQUIRE(said.code == 0);
  const json estimates = json::parse(said.text).at("estimates");
  REQUIRE(estimates.size() == 1);
  return estimates.at(0);
}

/// Two filters and the truth at 50 Hz for `n` samples; `make` sets them.
using Make = std::function<void(int i, VehicleState& first, VehicleState& second, VehicleState& truth)>;
void write_three(const std::filesystem::path& file, int n, const Make& make) {
  Log log(file);
  for (int i = 0; i < n; ++i) {
    VehicleState first = state(), second = state(), truth = state(0);
    make(i, first, second, truth);
    log.write("/vehicle/truth", i * 20 * ms, truth);
    log.write("/nav/state", i * 20 * ms, first);
    log.write("/second/state", i * 20 * ms, second);
  }
}

}  // namespace

TEST_CASE("a filter beside itself: no difference at all, and that is told") {
  const Folder folder;
  const std::string log = folder.path / "a.mcap";
  write_three(log, 100, [](int i, VehicleState& first, VehicleState& second, VehicleState&) {
    first.position_m.north = 0.1 * i, first.yaw_rad = 3.1 + 0.01 * i;
    second = first;
  });
  const json j = compared(log);
  CHECK(j.at("equal") == true);
  CHECK(j.at("compared") == 100);
  CHECK(j.at("difference").size() == 18);
  for (const json& row : j.at("difference")) {
    CHECK(row.at("rms") == 0);
    CHECK(row.at("largest") == 0);
    CHECK(row.at("both_valid_frac") == 1);
  }
  CHECK(json::parse(say("--json --changed " + log).text).at("estimates").empty());
}

TEST_CASE("known differences, second minus first, each in its unit; angles the short way") {
  const Folder folder;
  const std::string log = folder.path / "a.mcap";
  write_three(log, 100, [](int i, VehicleState& first, VehicleState& second, VehicleState&) {
    first.yaw_rad = 179 * degree, second.yaw_rad = -179 * degree;
    second.roll_rad = -3 * degree;
    second.position_m.north = 2;
    second.height_m = i == 40 ? -7 : 1;
    second.velocity_mps.down = i % 2 == 0 ? 0.5 : -0.5;
    second.wind_mps.east = -0.25;
    second.gyro_bias_radps.z = 0.5 * degree, second.accel_bias_mps2.x = 0.125;
  });
  const json d = compared(log).at("difference");
  const auto row = [&](const char* key, double mean, double rms, double largest) {
    INFO(key);
    CHECK(d.at(key).at("mean").get<double>() == doctest::Approx(mean).epsilon(1e-9));
    CHECK(d.at(key).at("rms").get<double>() == doctest::Approx(rms).epsilon(1e-9));
    CHECK(d.at(key).at("largest").get<double>() == doctest::Approx(largest).epsilon(1e-9));
  };
  row("yaw_deg", 2, 2, 2);
  row("roll_deg", -3, 3, -3);
  row("pitch_deg", 0, 0, 0);
  row("position_north_m", 2, 2, 2);
  row("position_east_m", 0, 0, 0);
  row("height_m", 0.92, std::sqrt((99 + 49) / 100.0), -7);
  row("velocity_down_mps", 0, 0.5, 0.5);
  row("wind_east_mps", -0.25, 0.25, -0.25);
  row("gyro_bias_z_degps", 0.5, 0.5, 0.5);
  row("accel_bias_x_mps2", 0.125, 0.125, 0.125);
}

TEST_CASE("errors are the estimate's minus the truth, and what is claimed stands beside them") {
  const Folder folder;
  const std::string log = folder.path / "a.mcap";
  write_three(log, 100, [](int i, VehicleState& first, VehicleState& second, VehicleState& truth) {
    truth.position_m.north = 10, first.position_m.north = 12, second.position_m.north = 7;
    second.position_std_m.north = 2;
    truth.airspeed_mps = 17, first.airspeed_mps = i < 25 ? 17.5 : 18.5, second.airspeed_mps = 17;
    first.wind_std_mps = {unknown_std, unknown_std, unknown_std};
  });
  const json j = compared(log), first = j.at("errors").at("first"), second = j.at("errors").at("second");
  CHECK(first.at("truth") == "/vehicle/truth");
  const json north = first.at("channels").at("position_north_m");
  CHECK(north.at("mean") == 2);
  CHECK(north.at("claimed") == 1);
  CHECK(north.at("within_1") == 0);
  CHECK(north.at("within_2") == 0);  // an error of two deviations is not within them
  CHECK(second.at("channels").at("position_north_m").at("mean") == -3);
  CHECK(second.at("channels").at("position_north_m").at("within_1") == 0);
  CHECK(second.at("channels").at("position_north_m").at("within_2") == 1);
  CHECK(first.at("channels").at("airspeed_mps").at("within_1") == 0.25);
  CHECK(first.at("channels").at("airspeed_mps").at("within_2") == 1);
  CHECK(first.at("channels").at("wind_north_mps").at("claimed").is_null());  // nobody knows
  CHECK(first.at("channels").at("wind_north_mps").at("rms") == 0);
  CHECK(first.at("channels").at("gyro_bias_x_degps").at("within_1").is_null());
}

TEST_CASE(
    "white errors of the deviation that is claimed: 0.683, 0.954, NEES of 9; twice as large: 0.383, 36") {
  const Folder folder;
  const std::string log = folder.path / "a.mcap";
  std::mt19937 random(4);
  std::normal_distribution<double> normal;
  const Eigen::Vector3d attitude_std(0.01, 0.02, 0.03);
  const Eigen::Quaterniond q = euler(0.5, 0.4, 1.2);
  write_three(log, 10'000, [&](int, VehicleState& first, VehicleState& second, VehicleState& truth) {
    turn_to(truth, q);
    double times = 1;
    for (VehicleState* s : {&first, &second}) {
      const auto draw = [&](double std) { return times * std * normal(random); };
      s->position_std_m = {3, 2, 1}, s->velocity_std_mps = {0.3, 0.2, 0.1};
      s->attitude_std_rad = {attitude_std.x(), attitude_std.y(), attitude_std.z()};
      s->position_m = {draw(3), draw(2), draw(1)};
      s->height_m = -s->position_m.down;
      s->velocity_mps = {draw(0.3), draw(0.2), draw(0.1)};
      const Eigen::Vector3d phi(draw(0.01), draw(0.02), draw(0.03));
      turn_to(*s, Eigen::Quaterniond(Eigen::AngleAxisd(phi.norm(), phi.normalized())) * q);
      times = 2;
    }
  });
  const json j = compared(log), first = j.at("errors").at("first"), second = j.at("errors").at("second");
  for (const char* key : {"roll_deg", "pitch_deg", "yaw_deg", "velocity_north_mps", "velocity_down_mps",
                          "position_east_m", "height_m"}) {
    INFO(key);
    const json a = first.at("channels").at(key), b = second.at("channels").at(key);
    CHECK(std::abs(a.at("within_1").get<double>() - 0.683) < 0.012);
    CHECK(std::abs(a.at("within_2").get<double>() - 0.954) < 0.006);
    CHECK(std::abs(b.at("within_1").get<double>() - 0.383) < 0.012);
    CHECK(std::abs(a.at("rms").get<double>() / a.at("claimed").get<double>() - 1) < 0.02);
  }
  CHECK(std::abs(first.at("nees").at("mean").get<double>() / 9 - 1) < 0.02);
  CHECK(std::abs(first.at("nees").at("inside").get<double>() - 0.95) < 0.006);
  CHECK(std::abs(second.at("nees").at("mean").get<double>() / 36 - 1) < 0.02);
  CHECK(first.at("nees").at("correlated") == false);
}

TEST_CASE("correlations that a filter tells beside its state count in its NEES") {
  const Folder folder;
  const std::string log = folder.path / "a.mcap";
  std::mt19937 random(5);
  std::normal_distribution<double> normal;
  FilterCheck check;
  check.correlation_ratio[28] = 0.99;  // row 8 of the lower triangle begins there: position down with roll
  {
    Log out(log);
    for (int i = 0; i < 5000; ++i) {
      const auto draw = [&] { return normal(random); };
      const double common = draw();
      VehicleState s = state();
      s.attitude_std_rad = {0.01, 0.01, 0.01};
      const Eigen::Vector3d phi(0.01 * common, 0.01 * draw(), 0.01 * draw());
      turn_to(s, Eigen::Quaterniond(Eigen::AngleAxisd(phi.norm(), phi.normalized())));
      s.velocity_mps = {draw(), draw(), draw()};
      s.position_m = {draw(), draw(), 0.99 * common + std::sqrt(1 - 0.99 * 0.99) * draw()};
      s.height_m = -s.position_m.down;
      out.write("/vehicle/truth", i * 20 * ms, state(0));
      out.write("/nav/check", i * 20 * ms, check);
      out.write("/nav/state", i * 20 * ms, s);
      out.write("/second/state", i * 20 * ms, s);
    }
  }
  const json e = compared(log).at("errors");
  CHECK(e.at("first").at("nees").at("correlated") == true);
  CHECK(e.at("second").at("nees").at("correlated") == false);
  CHECK(std::abs(e.at("first").at("nees").at("inside").get<double>() - 0.95) < 0.01);
  CHECK(e.at("second").at("nees").at("inside").get<double>() < 0.94);  // two of nine errors are one
  CHECK(std::abs(e.at("first").at("nees").at("mean").get<double>() / 9 - 1) < 0.04);
}

TEST_CASE("streams with clocks of their own are compared at one time, the dense one interpolated") {
  const Folder folder;
  const auto at = [](double t_s) {  // constant speed and rate of turn, through south
    VehicleState s = state();
    s.position_m.north = 20 * t_s, s.velocity_mps.north = 20;
    s.yaw_rad = std::remainder((170 + 10 * t_s) * degree, 2 * std::numbers::pi);
    return s;
  };
  for (const int truth_ms : {20, 137, 1000}) {
    INFO(truth_ms);
    const std::string log = folder.path / (std::to_string(truth_ms) + ".mcap");
    {
      Log out(log);
      for (int t = 0; t <= 10'000; ++t) {
        if (t % truth_ms == truth_ms / 2) out.write("/vehicle/truth", t * ms, at(1e-3 * t));
        if (t % 100 == 0) out.write("/nav/state", t * ms, at(1e-3 * t));
        if (t % 7 == 3) out.write("/second/state", t * ms, at(1e-3 * t));
      }
    }
    const json j = compared(log);
    CHECK(j.at("compared") == 99);  // not the first and the last of nav's 101
    CHECK(std::abs(j.at("difference").at("position_north_m").at("largest").get<double>()) < 1e-9);
    CHECK(std::abs(j.at("difference").at("yaw_deg").at("largest").get<double>()) < 1e-9);
    const json e = j.at("errors").at("first");
    CHECK(e.at("compared") > (truth_ms == 1000 ? 9 : 70));
    CHECK(std::abs(e.at("channels").at("position_north_m").at("largest").get<double>()) < 1e-9);
    CHECK(std::abs(e.at("channels").at("yaw_deg").at("largest").get<double>()) < 1e-9);
  }
}

TEST_CASE("nothing is interpolated over a gap") {
  const Folder folder;
  const std::string log = folder.path / "a.mcap";
  {
    Log out(log);
    for (int t = 0; t < 10'000; t += 20) {
      VehicleState s = state();
      s.position_m.north = 1e-3 * t * 1e-3 * t;  // no straight line
      if (t % 100 == 0) out.write("/nav/state", t * ms, s);
      if (t < 4000 || t > 6010) out.write("/second/state", t * ms, s);
    }
  }
  const json j = compared(log);
  CHECK(j.at("compared") == 79);  // of 100: 4.0 s to 6.0 s are left out
  CHECK(j.at("difference").at("position_north_m").at("largest") == 0);
  CHECK(j.at("difference").at("position_north_m").at("both_valid_frac") == 0.79);
}

TEST_CASE(
    "a filter that is silent or not valid at first is judged by the rest; how much that is stands beside "
    "it") {
  const Folder folder;
  const std::string log = folder.path / "a.mcap";
  {
    Log out(log);
    for (int i = 0; i < 100; ++i) {
      VehicleState first = state(), second = state();
      second.velocity_mps.east = 1;
      second.velocity_valid = i >= 40;
      first.wind_valid = second.wind_valid = false;
      out.write("/nav/state", i * 100 * ms, first);
      if (i >= 20) out.write("/second/state", i * 100 * ms, second);
    }
  }
  const json j = compared(log);
  CHECK(j.at("first").at("samples") == 100);
  CHECK(j.at("second").at("samples") == 80);
  CHECK(j.at("second").at("from_s") == 2.0);
  CHECK(j.at("compared") == 80);
  const json d = j.at("difference");
  CHECK(d.at("roll_deg").at("both_valid_frac") == 0.8);
  CHECK(d.at("velocity_east_mps").at("both_valid_frac") == 0.6);
  CHECK(d.at("velocity_east_mps").at("mean") == 1);
  CHECK_FALSE(d.contains("wind_north_mps"));
}

TEST_CASE(
    "what is no number is left out and counted, as are samples that are not later than the one before") {
  const Folder folder;
  const std::string log = folder.path / "a.mcap";
  {
    Log out(log);
    for (int i = 0; i < 100; ++i) {
      VehicleState s = state();
      out.write("/nav/state", i * 100 * ms, s);
      if (i % 10 == 0) s.position_m.east = std::nan("");
      if (i == 5) s.airspeed_mps = INFINITY;
      s.height_m = i % 4 == 3 ? 1000 : 0;
      out.write("/second/state", i * 100 * ms, s, i % 4 == 3 ? 150 * ms : 0);  // from before the last one
    }
  }
  const json j = compared(log);
  CHECK(j.at("second").at("not_new") == 25);
  CHECK(j.at("second").at("not_finite") == 11);
  CHECK(j.at("difference").at("height_m").at("largest") == 0);
  for (const json& row : j.at("difference")) CHECK(std::isfinite(row.at("rms").get<double>()));
  CHECK(j.at("difference").at("position_east_m").at("both_valid_frac") <
        j.at("difference").at("velocity_east_mps").at("both_valid_frac"));
}

TEST_CASE("two estimates with origins of their own are seen from one") {
  const Folder folder;
  const std::string log = folder.path / "a.mcap";
  // metres per degree at 47 degrees north from the radii of curvature of WGS-84
  const double a = 6378137, e2 = 0.00669437999014, sine = std::sin(47 * degree),
               w = std::sqrt(1 - e2 * sine * sine), meridian = a * (1 - e2) / (w * w * w), normal = a / w,
               north_deg = (meridian + 400) * degree,
               east_deg = (normal + 400) * degree * std::cos(47 * degree);
  write_three(log, 10, [&](int, VehicleState& first, VehicleState& second, VehicleState& truth) {
    first.position_m = truth.position_m = {200, 50, -30}, first.height_m = truth.height_m = 30;
    second.origin_latitude_deg += 100 / north_deg, second.origin_longitude_deg -= 40 / east_deg;
    second.origin_altitude_m += 25;
    second.position_m = {101, 90, -5}, second.height_m = 5;  // a metre too far north
  });
  const json j = compared(log);
  CHECK(j.at("difference").at("position_north_m").at("mean").get<double>() ==
        doctest::Approx(1).epsilon(0.01));
  CHECK(std::abs(j.at("difference").at("position_east_m").at("mean").get<double>()) < 0.01);
  CHECK(std::abs(j.at("difference").at("height_m").at("mean").get<double>()) < 0.01);
  const json second = j.at("errors").at("second").at("channels");
  CHECK(second.at("position_north_m").at("mean").get<double>() == doctest::Approx(1).epsilon(0.01));
  CHECK(std::abs(second.at("height_m").at("mean").get<double>()) < 0.01);
}

TEST_CASE("without a truth the fixes judge, at the time for which they hold, with what the receiver claims") {
  const Folder folder;
  const std::string log = folder.path / "a.mcap";
  const double a = 6378137, e2 = 0.00669437999014, sine = std::sin(47 * degree),
               w = std::sqrt(1 - e2 * sine * sine), north_deg = (a * (1 - e2) / (w * w * w) + 400) * degree;
  const auto fix_at = [&](double t_s) {
    Gnss fix;
    fix.latitude_deg = 47 + 20 * t_s / north_deg, fix.longitude_deg = 8, fix.altitude_m = 410;
    fix.velocity_mps = {20, 0, 0};
    fix.horizontal_std_m = 4, fix.fix = FixType::fix_3d;
    return fix;
  };
  {
    Log out(log);
    for (int t = 0; t < 10'000; t += 20) {
      VehicleState s = state(3);
      s.position_m = {20e-3 * t, 0, -12}, s.height_m = 12, s.velocity_mps = {20.5, 0, 0};
      out.write("/nav/state", t * ms, s);
      s.position_m.north += 6;
      out.write("/second/state", t * ms, s);
      if (t % 200 != 0 || t < 400) continue;
      Gnss fix = fix_at(1e-3 * (t - 230));
      if (t % 1000 == 0) fix.fix = FixType::time_only, fix.latitude_deg = 0;
      out.write("/vehicle/gnss", t * ms, fix, 230 * ms);
    }
  }
  const json j = compared(log).at("errors"), first = j.at("first").at("channels"),
             second = j.at("second").at("channels");
  CHECK(j.at("first").at("fixes") == "/vehicle/gnss");
  CHECK(j.at("first").at("truth").is_null());
  CHECK(std::abs(first.at("position_north_m").at("rms").get<double>()) < 0.02);
  CHECK(second.at("position_north_m").at("mean").get<double>() == doctest::Approx(6).epsilon(0.005));
  CHECK(second.at("position_north_m").at("claimed") == 5);  // 3 and 4
  CHECK(second.at("position_north_m").at("within_1") == 0);
  CHECK(second.at("position_north_m").at("within_2") == 1);
  CHECK(first.at("height_m").at("mean").get<double>() == doctest::Approx(2).epsilon(0.005));
  CHECK(first.at("height_m").at("claimed").is_null());  // the receiver says nothing of it
  CHECK(first.at("velocity_north_mps").at("mean") == 0.5);
  CHECK_FALSE(first.contains("roll_deg"));
  CHECK(j.at("first").at("nees").is_null());
}

TEST_CASE("a receiver beside the aircraft's own is the reference; --fixes and --truth choose") {
  const Folder folder;
  const std::string log = folder.path / "a.mcap";
  {
    Log out(log);
    for (int i = 0; i < 20; ++i) {
      out.write("/nav/state", i * 100 * ms, state());
      out.write("/second/state", i * 100 * ms, state());
      out.write("/vehicle/gnss", i * 100 * ms, Gnss());
      out.write("/reference/gnss", i * 100 * ms, Gnss());
    }
  }
  CHECK(compared(log).at("errors").at("first").at("fixes") == "/reference/gnss");
  CHECK(compared(log + " --fixes vehicle.gnss").at("errors").at("first").at("fixes") == "/vehicle/gnss");
  CHECK(
      compared(log + " --truth second").at("errors").at("first").at("truth").is_null());  // it is the second
  CHECK(say(log + " --fixes nav.state").text ==
        log + ": /nav/state is a VehicleState, and no Gnss. Valid: /reference/gnss, /vehicle/gnss.");
  CHECK(say(log + " --fixes vehicle.gnss --truth second").code == 2);
}

TEST_CASE("a log of an older layout is read as far as it goes; fields that mean something else are refused") {
  const Folder folder;
  const std::string log = folder.path / "a.mcap", other = folder.path / "b.mcap";
  const core::TypePtr now = core::copy_type(describe<VehicleState>());
  core::Type old = *now, feet = *now;
  std::erase_if(old.fields, [](const core::Field& f) {
    return f.name.find("_std_") != std::string::npos || f.name.ends_with("_valid") || f.name == "wind_mps";
  });
  for (core::Field& field : feet.fields)
    if (field.name == "airspeed_mps") field.kind = FULMAR_F32, field.stride = 4;
  {
    Log out(log), second(other);
    for (int i = 0; i < 20; ++i) {
      VehicleState s = state();
      out.write("/vehicle/truth", i * 100 * ms, s);
      s.position_m.north = 3, s.position_valid = false;
      out.write_as("/nav/state", old, i * 100 * ms, s);
      out.write("/second/state", i * 100 * ms, state());
      second.write_as("/nav/state", feet, i * 100 * ms, s);
      second.write("/second/state", i * 100 * ms, s);
    }
  }
  const json j = compared(log), first = j.at("errors").at("first").at("channels");
  CHECK(first.at("position_north_m").at("mean") == 3);  // there is no flag that says it were not valid
  CHECK(first.at("position_north_m").at("claimed").is_null());
  CHECK(j.at("errors").at("first").at("nees").is_null());
  CHECK(j.at("errors").at("second").at("channels").at("position_north_m").at("claimed") == 1);
  CHECK(say(other).text == "/nav/state: airspeed_mps: reader has kind f64, writer f32");
}

TEST_CASE("which states: by port, topic or owner; what cannot be is told with what there is") {
  const Folder folder;
  const std::string log = folder.path / "a.mcap", alone = folder.path / "b.mcap",
                    none = folder.path / "c.mcap";
  {
    Log out(log), one(alone), nothing(none);
    for (int i = 0; i < 20; ++i) {
      for (const char* topic : {"/nav/state", "/second/state", "/third/state", "/vehicle/truth"})
        out.write(topic, i * 100 * ms, state());
      one.write("/nav/state", i * 100 * ms, state());
      one.write("/vehicle/truth", i * 100 * ms, state());
      nothing.write("/vehicle/gnss", i * 100 * ms, Gnss());
    }
    out.write("/vehicle/gnss", 0, Gnss());
  }
  for (const char* words : {" second.state nav.state", " /second/state /nav/state", " second nav"}) {
    const json j = compared(log + words);
    CHECK(j.at("first").at("topic") == "/second/state");
    CHECK(j.at("second").at("topic") == "/nav/state");
    CHECK(j.at("first").at("name") == "second");
  }
  const std::string all = "/nav/state, /second/state, /third/state, /vehicle/truth";
  const auto refused = [](const std::string& words, const std::string& why) {
    const Said said = say(words);
    CHECK(said.code == 1);
    CHECK(said.text == why);
  };
  refused(log, log + ": name the two that are compared, as in nav.state second.state. It has " +
                   core::join({all}));
  refused(log + " nav second third", "two states are compared, not nav, second, third");
  refused(log + " nav thrid.state",
          log + ": there is no /thrid/state in it. Did you mean '/third/state'? Valid: " + all + ".");
  refused(log + " nav vehicle.gnss",
          log + ": /vehicle/gnss is a Gnss, and no VehicleState. Valid: " + all + ".");
  refused(alone, alone +
                     ": name the two that are compared, as in nav.state second.state. It has /nav/state, "
                     "/vehicle/truth");
  refused(none, none + ": there is no state of an aircraft (VehicleState) in it");
  refused(log + " " + (folder.path / "no.mcap").string(),
          "cannot read '" + (folder.path / "no.mcap").string() + "': there is no such file");
  const json by_truth =
      compared(alone + " nav vehicle.truth");  // one estimate and the truth: their difference
  CHECK(by_truth.at("errors").at("first").at("truth").is_null());
}

TEST_CASE("when nothing can be compared the exit code is 1, but for what asks for changes alone") {
  const Folder folder;
  const std::string a = folder.path / "a.mcap", b = folder.path / "b.mcap", c = folder.path / "c.mcap";
  {
    Log one(a), later(b), other(c);
    for (int i = 0; i < 20; ++i) {
      one.write("/nav/state", i * 100 * ms, state());
      later.write("/nav/state", (i + 1000) * 100 * ms, state());
      other.write("/second/state", i * 100 * ms, state());
    }
  }
  CHECK(say(a + " " + b).code == 1);
  CHECK(say(a + " " + a).code == 0);
  CHECK(say("--changed " + a + " " + b).code == 0);
  CHECK(say(a + " " + c).code == 1);
  CHECK(say(a + " " + c).text == "No estimate (VehicleState) stands in both logs: none is compared.");
  CHECK(say("--changed " + a + " " + c).code == 0);
  CHECK(compared(a + " " + c + " nav second").at("compared") == 20);
}

TEST_CASE("two logs: the states that both have, each beside its own truth; that these differ is told") {
  const Folder folder;
  const std::string a = folder.path / "a.mcap", b = folder.path / "b.mcap", c = folder.path / "c.mcap";
  const auto write = [](const std::string& file, double truth_m, double error_m) {
    write_three(file, 50, [&](int i, VehicleState& first, VehicleState& second, VehicleState& truth) {
      truth.position_m.north = truth_m * i, first.position_m.north = truth_m * i + error_m;
      second.position_m.north = truth_m * i;
    });
  };
  write(a, 1, 2), write(b, 1, 5), write(c, 1.1, 5);
  const json j = compared("--changed " + a + " " + b);  // second is the same in both
  CHECK(j.at("first").at("topic") == "/nav/state");
  CHECK(j.at("first").at("name") == "first");
  CHECK(j.at("truths_apart_m").is_null());
  CHECK(j.at("difference").at("position_north_m").at("mean") == 3);
  CHECK(j.at("errors").at("first").at("channels").at("position_north_m").at("rms") == 2);
  CHECK(j.at("errors").at("second").at("channels").at("position_north_m").at("rms") == 5);
  CHECK(json::parse(say("--json " + a + " " + b).text).at("estimates").size() == 2);
  const json apart = compared("--names old,new " + a + " " + c + " nav");
  CHECK(apart.at("truths_apart_m").get<double>() == doctest::Approx(4.9));
  CHECK(apart.at("errors").at("second").at("channels").at("position_north_m").at("rms").get<double>() ==
        doctest::Approx(5));
  CHECK(apart.at("first").at("name") == "old");
  CHECK(apart.at("second").at("name") == "new");
  CHECK(say("--names old " + a + " " + c).code == 1);
}

TEST_CASE("a span of flight time; a log that was cut off is read up to there, and that is told") {
  const Folder folder;
  const std::string log = folder.path / "a.mcap", part = folder.path / "b.mcap.part";
  write_three(log, 1000, [](int i, VehicleState& first, VehicleState& second, VehicleState&) {
    second.position_m.north = i * 20 < 10'000 ? 1 : 3;
    first.position_m.east = std::sin(i);  // that chunks cannot be compressed to nothing
  });
  const json whole = compared(log + " --from 12 --to 15");
  CHECK(whole.at("compared") == 151);
  CHECK(whole.at("difference").at("position_north_m").at("mean") == 3);
  CHECK(whole.at("errors").at("second").at("compared") == 151);
  CHECK(whole.at("first").at("fault").is_null());
  const std::string bytes = core::test::contents(log);
  core::test::store(part, bytes.substr(0, bytes.size() / 2));
  const json cut = compared(part);
  CHECK(cut.at("compared") > 100);
  CHECK(cut.at("compared") < 900);
  CHECK(cut.at("first").at("fault").is_string());
  CHECK(compared(part + " " + log + " nav").at("second").at("fault").is_null());
}

}  // namespace compare_test
