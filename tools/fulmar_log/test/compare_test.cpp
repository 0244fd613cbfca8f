// SPDX-License-Identifier: BSD-3-Clause
// fulmar log compare for logs written by hand with given errors: the figures.
#include <random>

#include "tools/fulmar_log/test/compare_kit.hpp"

namespace compare_test {

TEST_CASE("a filter beside itself: no difference at all, and that is told") {
  const Folder folder;
  const std::string log = folder.path / "a.mcap";
  write_three(log, 100, [](int i, VehicleState& first, VehicleState& second, VehicleState&) {
    first.position_m.north = 0.1 * i;
    first.yaw_rad = 3.1 + 0.01 * i;
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
    first.yaw_rad = 179 * degree;
    second.yaw_rad = -179 * degree;
    second.roll_rad = -3 * degree;
    second.position_m.north = 2;
    second.height_m = i == 40 ? -7 : 1;
    second.velocity_mps.down = i % 2 == 0 ? 0.5 : -0.5;
    second.wind_mps.east = -0.25;
    second.gyro_bias_radps.z = 0.5 * degree;
    second.accel_bias_mps2.x = 0.125;
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
    truth.position_m.north = 10;
    first.position_m.north = 12;
    second.position_m.north = 7;
    second.position_std_m.north = 2;
    truth.airspeed_mps = 17;
    first.airspeed_mps = i < 25 ? 17.5 : 18.5;
    second.airspeed_mps = 17;
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
  CHECK(first.at("channels").at("wind_north_mps").at("claimed").is_null());  // unknown
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
      s->position_std_m = {3, 2, 1};
      s->velocity_std_mps = {0.3, 0.2, 0.1};
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
    s.position_m.north = 20 * t_s;
    s.velocity_mps.north = 20;
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
    first.position_m = truth.position_m = {200, 50, -30};
    first.height_m = truth.height_m = 30;
    second.origin_latitude_deg += 100 / north_deg;
    second.origin_longitude_deg -= 40 / east_deg;
    second.origin_altitude_m += 25;
    second.position_m = {101, 90, -5};
    second.height_m = 5;  // a metre too far north
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
    fix.latitude_deg = 47 + 20 * t_s / north_deg;
    fix.longitude_deg = 8;
    fix.altitude_m = 410;
    fix.velocity_mps = {20, 0, 0};
    fix.horizontal_std_m = 4;
    fix.fix = FixType::fix_3d;
    return fix;
  };
  {
    Log out(log);
    for (int t = 0; t < 10'000; t += 20) {
      VehicleState s = state(3);
      s.position_m = {20e-3 * t, 0, -12};
      s.height_m = 12;
      s.velocity_mps = {20.5, 0, 0};
      out.write("/nav/state", t * ms, s);
      s.position_m.north += 6;
      out.write("/second/state", t * ms, s);
      if (t % 200 != 0 || t < 400) continue;
      Gnss fix = fix_at(1e-3 * (t - 230));
      if (t % 1000 == 0) {
        fix.fix = FixType::time_only;
        fix.latitude_deg = 0;
      }
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
  CHECK(first.at("height_m").at("claimed").is_null());  // the receiver does not report it
  CHECK(first.at("velocity_north_mps").at("mean") == 0.5);
  CHECK_FALSE(first.contains("roll_deg"));
  CHECK(j.at("first").at("nees").is_null());
}

}  // namespace compare_test
