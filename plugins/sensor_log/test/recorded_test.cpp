// SPDX-License-Identifier: BSD-3-Clause
// Samples of the files in the autopilot: content, time, and units. Expected values are computed by hand, from
// the definitions of the units and the standard atmosphere's tables (ISO 2533).
#define FULMAR_COUNT_ALLOCATIONS
#include <fulmar/testing.hpp>

#include "recording.hpp"

namespace recorded_test {

using namespace recording;
using doctest::Approx;

namespace {

void mag_columns(Description& d) {
  d.mag.from.file = "mag.csv";
  d.mag.from.time = "t";
  d.mag.field.columns = {"x", "y", "z"};
}

Imu one_imu(Description d, const std::string& cells) {
  const Folder folder;
  folder.write("imu.csv", "t,p,q,r,x,y,z\n0," + cells + "\n");
  const Flown f = fly(d, folder);
  REQUIRE(f.fault == "");
  REQUIRE(f.imu.size() == 1);
  return f.imu[0].value;
}
Vec3<Body> one_field(FieldUnit unit, const std::string& cells) {
  const Folder folder;
  Description d;
  mag_columns(d);
  d.mag.field.unit = unit;
  folder.write("mag.csv", "t,x,y,z\n0," + cells + "\n");
  const Flown f = fly(d, folder);
  REQUIRE(f.fault == "");
  REQUIRE(f.mag.size() == 1);
  return f.mag[0].value.field_tesla;
}
double one_pressure(PressureUnit unit, double zero_m, const std::string& cell) {
  const Folder folder;
  Description d;
  d.baro.from.file = "air.csv";
  d.baro.from.time = "t";
  d.baro.pressure.column = "p";
  d.baro.pressure.unit = unit;
  d.baro.pressure.height_zero_m = zero_m;
  folder.write("air.csv", "t,p\n0," + cell + "\n");
  const Flown f = fly(d, folder);
  REQUIRE(f.fault == "");
  REQUIRE(f.baro.size() == 1);
  return f.baro[0].value.pressure_pa;
}
Pitot one_pitot(PitotColumn column, const std::string& cell) {
  const Folder folder;
  Description d;
  d.pitot.from.file = "air.csv";
  d.pitot.from.time = "t";
  d.pitot.pressure = column;
  d.pitot.pressure.column = "p";
  folder.write("air.csv", "t,p\n0," + cell + "\n");
  const Flown f = fly(d, folder);
  REQUIRE(f.fault == "");
  REQUIRE(f.pitot.size() == 1);
  return f.pitot[0].value;
}

Description gnss_alone() {
  Description d;
  d.gnss.from.file = "gps.csv";
  d.gnss.from.time = "t";
  d.gnss.position.columns = {"lat", "lon", "alt"};
  return d;
}
Flown gnss(const Description& d, const std::string& head, const std::string& rows) {
  const Folder folder;
  folder.write("gps.csv", "t,lat,lon,alt" + head + "\n" + rows);
  Flown f = fly(d, folder);
  REQUIRE(f.fault == "");
  return f;
}

}  // namespace

TEST_CASE("each column goes where the description says: axes, angles, fix, satellites, deviations") {
  const Folder folder;
  Description d = imu_alone();
  d.imu.rate.columns = {"z", "x", "p"};  // any names for any axis
  d.imu.specific_force.columns = {"q", "r", "y"};
  folder.write("imu.csv", "t,p,q,r,x,y,z\n0,1,2,3,4,5,6\n");
  const Flown f = fly(d, folder);
  REQUIRE(f.imu.size() == 1);
  CHECK(f.imu[0].value.rate_radps == Vec3<Body>{6, 4, 1});
  CHECK(f.imu[0].value.specific_force_mps2 == Vec3<Body>{2, 3, 5});

  Description g = gnss_alone();
  g.gnss.velocity.columns = {"a", "b", "c"};
  g.gnss.fix = {"fix", FixCode::dimensions};
  g.gnss.satellites = "n";
  g.gnss.horizontal_std = "h";
  g.gnss.vertical_std = "v";
  g.gnss.speed_std = "s";
  const Gnss fix = gnss(g, ",a,b,c,fix,n,h,v,s", "0,-37.5,144.7,25,1,2,3,3,9,1.5,2.5,0.2\n").gnss[0].value;
  CHECK(fix.latitude_deg == -37.5);
  CHECK(fix.longitude_deg == 144.7);
  CHECK(fix.altitude_m == 25);
  CHECK(fix.velocity_mps == Vec3<Ned>{1, 2, 3});
  CHECK(fix.fix == FixType::fix_3d);
  CHECK(fix.satellites == 9);
  CHECK(fix.horizontal_std_m == 1.5);
  CHECK(fix.vertical_std_m == 2.5);
  CHECK(fix.speed_std_mps == 0.2);
}

TEST_CASE("units of rates, forces and fields") {
  Description d = imu_alone();
  d.imu.rate.unit = RateUnit::degps;
  d.imu.specific_force.unit = ForceUnit::g;
  const Imu imu = one_imu(d, "180,-90,0,0,0.5,-1");
  CHECK(imu.rate_radps.x == Approx(3.14159265358979).epsilon(1e-12));
  CHECK(imu.rate_radps.y == Approx(-1.57079632679490).epsilon(1e-12));
  CHECK(imu.specific_force_mps2.y == Approx(4.903325).epsilon(1e-12));
  CHECK(imu.specific_force_mps2.z == Approx(-9.80665).epsilon(1e-12));
  const std::pair<FieldUnit, double> units[] = {{FieldUnit::tesla, 1},
                                                {FieldUnit::microtesla, 1e-6},
                                                {FieldUnit::nanotesla, 1e-9},
                                                {FieldUnit::gauss, 1e-4},
                                                {FieldUnit::milligauss, 1e-7}};
  for (const auto& [unit, tesla] : units) {
    const Vec3<Body> field = one_field(unit, "20,-5,40");
    CHECK(field.x == Approx(20 * tesla).epsilon(1e-12));
    CHECK(field.y == Approx(-5 * tesla).epsilon(1e-12));
    CHECK(field.z == Approx(40 * tesla).epsilon(1e-12));
  }
}

TEST_CASE("units of pressure; a height is the pressure of the standard atmosphere there") {
  CHECK(one_pressure(PressureUnit::pa, 0, "98765.4") == Approx(98765.4).epsilon(1e-12));
  CHECK(one_pressure(PressureUnit::hpa, 0, "987.654") == Approx(98765.4).epsilon(1e-12));
  CHECK(one_pressure(PressureUnit::kpa, 0, "98.7654") == Approx(98765.4).epsilon(1e-12));
  CHECK(one_pressure(PressureUnit::m, 0, "0") == Approx(101325).epsilon(1e-9));
  CHECK(one_pressure(PressureUnit::m, 0, "1000") == Approx(89876.3).epsilon(1e-4));  // ISO 2533, geometric
  CHECK(one_pressure(PressureUnit::m, 600, "400") == Approx(89876.3).epsilon(1e-4));
}

TEST_CASE("a pitot tube in pascal, hectopascal or as indicated airspeed says the same") {
  // 20 m/s at 1.225 kg/m3: 245 Pa
  for (const auto& [unit, cell] :
       {std::pair{PitotUnit::pa, "245"}, {PitotUnit::hpa, "2.45"}, {PitotUnit::mps, "20"}}) {
    const Pitot p = one_pitot({{}, unit}, cell);
    CHECK(p.pressure_pa == Approx(245).epsilon(1e-9));
    CHECK(p.indicated_airspeed_mps == Approx(20).epsilon(1e-9));
  }
  const Pitot backwards = one_pitot({{}, PitotUnit::pa}, "-3");
  CHECK(backwards.pressure_pa == -3);
  CHECK(backwards.indicated_airspeed_mps == Approx(-2.2131333).epsilon(1e-6));
  CHECK(one_pitot({{}, PitotUnit::mps}, "-20").pressure_pa == Approx(-245).epsilon(1e-9));
}

TEST_CASE("units and axes of a fix") {
  Description d = gnss_alone();
  d.gnss.position.unit = AngleUnit::deg_e7;
  d.gnss.position.altitude_unit = LengthUnit::mm;
  d.gnss.velocity.columns = {"e", "n", "u"};
  d.gnss.velocity.axes = LocalAxes::enu;
  d.gnss.velocity.unit = SpeedUnit::kmph;
  const Gnss fix = gnss(d, ",e,n,u", "0,-379596764,1447648038,15780,36,72,-18\n").gnss[0].value;
  CHECK(fix.latitude_deg == Approx(-37.9596764).epsilon(1e-12));
  CHECK(fix.longitude_deg == Approx(144.7648038).epsilon(1e-12));
  CHECK(fix.altitude_m == Approx(15.78).epsilon(1e-12));
  CHECK(fix.velocity_mps.north == Approx(20).epsilon(1e-12));
  CHECK(fix.velocity_mps.east == Approx(10).epsilon(1e-12));
  CHECK(fix.velocity_mps.down == Approx(5).epsilon(1e-12));
  CHECK(fix.fix == FixType::fix_3d);           // the default without a column
  CHECK(fix.horizontal_std_m == unknown_std);  // nor a standard deviation
  d.gnss.velocity.unit = SpeedUnit::kt;
  CHECK(gnss(d, ",e,n,u", "0,-379596764,1447648038,15780,36,72,-18\n").gnss[0].value.velocity_mps.north ==
        Approx(37.04).epsilon(1e-4));  // 1 kt = 1.852 km/h
  d.gnss.position.unit = AngleUnit::rad;
  d.gnss.position.altitude_unit = LengthUnit::cm;
  const Gnss radians = gnss(d, ",e,n,u", "0,0.5,-1.5,100,0,0,0\n").gnss[0].value;
  CHECK(radians.latitude_deg == Approx(28.6478897565).epsilon(1e-10));
  CHECK(radians.longitude_deg == Approx(-85.9436692696).epsilon(1e-10));
  CHECK(radians.altitude_m == Approx(1));
}

TEST_CASE("a column of fixes means what its code says") {
  const auto type = [](FixCode code, const char* cell) {
    Description d = gnss_alone();
    d.gnss.fix = {"fix", code};
    return gnss(d, ",fix", std::string("0,1,2,3,") + cell + "\n").gnss[0].value.fix;
  };
  CHECK(type(FixCode::fulmar, "6") == FixType::rtk_float);
  CHECK(type(FixCode::fulmar, "12") == FixType::none);
  CHECK(type(FixCode::dimensions, "1") == FixType::none);
  CHECK(type(FixCode::dimensions, "2") == FixType::fix_2d);
  CHECK(type(FixCode::dimensions, "3") == FixType::fix_3d);
  CHECK(type(FixCode::navsat, "-1") == FixType::none);
  CHECK(type(FixCode::navsat, "0") == FixType::fix_3d);
  CHECK(type(FixCode::px4, "4") == FixType::fix_3d);
  CHECK(type(FixCode::px4, "5") == FixType::rtk_float);
  CHECK(type(FixCode::px4, "6") == FixType::rtk_fixed);
}

TEST_CASE("calibration: first into SI and body axes, then the offset is taken off, then the scale") {
  Description d = imu_alone();
  d.imu.rate.axes = d.imu.specific_force.axes = BodyAxes::flu;  // y left, z up
  d.imu.specific_force.unit = ForceUnit::g;
  d.imu.specific_force.offset_mps2 = {0.1, 0, 0.2};
  d.imu.specific_force.scale_ratio = {2, 1, 1.01};
  d.imu.rate.offset_radps = {0.01, -0.02, 0};
  const Imu imu = one_imu(d, "0.11,0.3,0.4,0.5,0.25,1");
  CHECK(imu.rate_radps.x == Approx(0.1).epsilon(1e-12));
  CHECK(imu.rate_radps.y == Approx(-0.28).epsilon(1e-12));
  CHECK(imu.rate_radps.z == Approx(-0.4).epsilon(1e-12));
  CHECK(imu.specific_force_mps2.x == Approx(9.60665).epsilon(1e-12));  // 2 (4.903325 - 0.1)
  CHECK(imu.specific_force_mps2.y == Approx(-2.4516625).epsilon(1e-12));
  CHECK(imu.specific_force_mps2.z == Approx(-10.1067165).epsilon(1e-12));  // 1.01 (-9.80665 - 0.2)
  const Pitot p = one_pitot({{}, PitotUnit::hpa, 5, 0.98}, "2.55");
  CHECK(p.pressure_pa == Approx(245).epsilon(1e-12));  // 0.98 (255 - 5)
}

TEST_CASE(
    "ticks are at the times of the inertial samples, however irregular; others arrive in the first one not "
    "before them") {
  const Folder folder;
  Description d = imu_alone();
  mag_columns(d);
  folder.write("imu.csv",
               "t,p,q,r,x,y,z\n5.000,1,0,0,0,0,0\n5.004,2,0,0,0,0,0\n5.005,3,0,0,0,0,0\n5.105,4,0,0,0,0,0\n5."
               "106,5,0,0,0,0,0\n");
  folder.write("mag.csv", "t,x,y,z\n5.0041,1,0,0\n5.005,2,0,0\n5.050,3,0,0\n5.060,4,0,0\n5.107,5,0,0\n");
  const Flown f = fly(d, folder);
  // 5.005 takes the second magnetic sample; the first had to be published before it. Likewise 5.050 before
  // 5.060, in a separate tick. After the last inertial sample there is one, too.
  CHECK(f.ticks_ns == std::vector<std::int64_t>{0, 4'000'000, 4'100'000, 5'000'000, 50'000'000, 105'000'000,
                                                106'000'000, 107'000'000});
  REQUIRE(f.imu.size() == 5);
  REQUIRE(f.mag.size() == 5);
  for (std::size_t i = 0; i < 5; ++i) {
    CHECK(f.imu[i].value.rate_radps.x == static_cast<double>(i + 1));
    CHECK(f.mag[i].value.field_tesla.x == static_cast<double>(i + 1));
    CHECK(f.imu[i].valid_at_ns == f.imu[i].now_ns);
  }
  CHECK(f.mag[3].now_ns == 105'000'000);
  CHECK(f.mag[3].valid_at_ns == 60'000'000);  // and is 45 ms old then
  CHECK(f.last.left_s == 0);
}

TEST_CASE("a delay makes what a row says older, a shift moves its clock, and both are of that sensor alone") {
  const Folder folder;
  Description d = imu_alone();
  mag_columns(d);
  d.mag.from.unit = TimeUnit::us;
  d.mag.from.shift_s = -100;
  d.mag.from.delay_s = 0.015;
  folder.write("imu.csv", level(3));
  folder.write("mag.csv", "t,x,y,z\n100010000,1,0,0\n");
  const Flown f = fly(d, folder);
  REQUIRE(f.mag.size() == 1);
  CHECK(f.mag[0].now_ns == 10'000'000);
  CHECK(f.mag[0].valid_at_ns == -5'000'000);
  CHECK(f.ticks_ns.size() == 3);
}

TEST_CASE(
    "a withheld sensor is silent in its windows and counted; a withheld inertial unit leaves its ticks") {
  const Folder folder;
  Description d = imu_alone();
  mag_columns(d);
  folder.write("imu.csv", level(10));
  folder.write("mag.csv", "t,x,y,z\n0.00,1,0,0\n0.02,2,0,0\n0.04,3,0,0\n0.06,4,0,0\n0.08,5,0,0\n");
  d.mag.withhold.count = 2;
  d.mag.withhold.items[0] = {0.02, 0.04};  // the end is not in it
  d.mag.withhold.items[1] = {0.07, 1};
  d.imu.withhold.count = 1;
  d.imu.withhold.items[0] = {0.03, 0.05};
  const Flown f = fly(d, folder);
  std::vector<double> shown;
  for (const auto& sample : f.mag) shown.push_back(sample.value.field_tesla.x);
  CHECK(shown == std::vector<double>{1, 3, 4});
  CHECK(f.ticks_ns.size() == 10);
  CHECK(f.imu.size() == 8);
  CHECK(f.last.withheld == 4);
}

TEST_CASE(
    "use, armed and airborne are of flight time; a receiver's UTC is that of the fix, not of its arrival") {
  const Folder folder;
  Description d = imu_alone();
  folder.write("imu.csv", level(10));
  d.use = {0.02, 0.08};
  d.armed = {0.03, 0.07};
  d.airborne = {0.04, 0.06};
  const Flown f = fly(d, folder);
  REQUIRE(f.status.size() == 6);  // 0.02 to 0.07
  CHECK(f.ticks_ns.front() == 20'000'000);
  const std::vector<bool> armed = {false, true, true, true, true, false},
                          ground = {true, true, false, false, true, true};
  for (std::size_t i = 0; i < 6; ++i) {
    CHECK(f.status[i].armed == armed[i]);
    CHECK(f.status[i].on_ground == ground[i]);
    CHECK(f.status[i].override);  // commands have no effect
    CHECK_FALSE(f.status[i].in_control);
  }
  Description g = gnss_alone();
  g.utc_at_zero_s = 1'384'992'000;
  g.gnss.from.delay_s = 0.2;
  const Flown fixes = gnss(g, "", "7.5,1,2,3\n8.5,1,2,3\n");
  REQUIRE(fixes.gnss.size() == 2);
  CHECK(fixes.gnss[1].value.utc_ns == 1'384'992'000'800'000'000);
}

TEST_CASE("rows that repeat the one before in the column of changes are left out, and are no fault") {
  Description d = gnss_alone();
  d.gnss.from.changes = "itow";
  const Flown f = gnss(d, ",itow", "0,1,2,3,500\n1,1,2,3,500\n2,nan,2,3,700\n3,4,2,3,700\n4,4,2,3,700\n");
  REQUIRE(f.gnss.size() == 2);
  CHECK(f.gnss[1].value.latitude_deg == 4);  // the row before it was none
  CHECK(f.last.not_finite == 1);
  CHECK(f.last.out_of_order == 0);
}

TEST_CASE(
    "NaN, Inf, an empty cell or an overflow in any field, the stamp included: that row alone is left out and "
    "counted") {
  const std::vector<std::string> bad = {"nan", "NaN", "inf", "-Infinity", "", "1e400"};
  for (const std::string& cell : bad)
    for (std::size_t column = 0; column < 7; ++column) {
      const Folder folder;
      std::string row;
      for (std::size_t i = 0; i < 7; ++i)
        row += (i > 0 ? "," : "") + (i == column ? cell : std::to_string(i) + (i == 0 ? "e-2" : ""));
      folder.write("imu.csv", "t,p,q,r,x,y,z\n-0.01,0,0,0,0,0,0\n" + row + "\n0.01,0,0,0,0,0,0\n");
      const Flown f = fly(imu_alone(), folder);
      CAPTURE(row);
      CHECK(f.fault == "");
      CHECK(f.imu.size() == 2);
      CHECK(f.last.not_finite == 1);
      CHECK(f.notices == std::vector<std::string>{"sensor_log.row_left_out(imu.csv, line 3, 1 not finite)"});
    }
}

TEST_CASE("numbers that are finite and mean nothing on Earth are left out and counted, too") {
  Description d = gnss_alone();
  CHECK(gnss(d, "", "0,1,2,3\n1,91,2,3\n2,1,999,3\n3,1,2,1e7\n4,1,2,3\n").last.out_of_range == 3);
  const Folder folder;
  Description b = imu_alone();
  b.imu.specific_force.unit = ForceUnit::g;
  b.imu.specific_force.scale_ratio = {10, 1, 1};
  b.baro.from.file = "air.csv";
  b.baro.from.time = "t";
  b.baro.pressure.column = "p";
  folder.write(
      "imu.csv",
      "t,p,q,r,x,y,z\n0,0,0,0,1,0,0\n1,0,0,0,1.7e308,0,0\n2,0,0,0,1,0,0\n");  // finite, until it is in m/s2
  folder.write("air.csv", "t,p\n0,1e5\n1,0\n2,-5\n3,1e9\n");
  const Flown f = fly(b, folder);
  CHECK(f.fault == "");
  CHECK(f.imu.size() == 2);
  CHECK(f.baro.size() == 1);
  CHECK(f.last.out_of_range == 4);
  CHECK(f.notices.size() == 2);
}

TEST_CASE("stamps that repeat, go back or jump years ahead are left out and counted; ticks still rise") {
  const Folder folder;
  folder.write("imu.csv",
               "t,p,q,r,x,y,z\n0.00,1,0,0,0,0,0\n0.01,2,0,0,0,0,0\n0.01,9,0,0,0,0,0\n0.005,9,0,0,0,0,0\n9e8,"
               "9,0,0,0,0,0\n0.02,3,0,0,0,0,0\n0.03,4,0,0,0,0,0\n");
  const Flown f = fly(imu_alone(), folder);
  CHECK(f.ticks_ns == std::vector<std::int64_t>{0, 10'000'000, 20'000'000, 30'000'000});
  REQUIRE(f.imu.size() == 4);
  for (std::size_t i = 0; i < 4; ++i) CHECK(f.imu[i].value.rate_radps.x == static_cast<double>(i + 1));
  CHECK(f.last.out_of_order == 3);
  CHECK(f.last.not_finite == 0);
  CHECK(f.notices ==
        std::vector<std::string>{"sensor_log.rows_left_out(imu.csv, 3, line 4, 3 out of order)"});
}

TEST_CASE("after its last tick a recording fails, and says what ends a mission before that") {
  const Folder folder;
  folder.write("imu.csv", level(2));
  Bench<Recorded> bench;
  bench.params.log.value = imu_alone();
  bench.params.folder.value = Text<256>(folder.path.string());
  CHECK(bench.read() == Status::ok);
  CHECK_FALSE(bench.out.recording.ended);
  CHECK(bench.out.recording.left_s == Approx(0.01));
  CHECK(bench.read() == Status::ok);
  CHECK(bench.out.recording.ended);
  CHECK(bench.read() == Status::failed);
  CHECK(bench.error() == "sensor_log.recording_ended");
}

TEST_CASE("nothing is allocated in flight") {
  const Folder folder;
  folder.write("imu.csv", level(200) + "nan,0,0,0,0,0,0\n");
  Bench<Recorded> bench;
  bench.params.log.value = imu_alone();
  bench.params.folder.value = Text<256>(folder.path.string());
  REQUIRE(bench.configure() == Status::ok);
  CHECK(allocations([&] {
          for (int i = 0; i < 200; ++i) {
            bench.read();
            bench.write();
          }
        }) == 0);
  CHECK(bench.out.recording.ended);
}

TEST_CASE("set up again it begins again") {
  const Folder folder;
  folder.write("imu.csv", level(3) + "nan,0,0,0,0,0,0\n");
  Bench<Recorded> bench;
  bench.params.log.value = imu_alone();
  bench.params.folder.value = Text<256>(folder.path.string());
  for (int n = 0; n < 2; ++n) {
    REQUIRE(bench.configure() == Status::ok);
    bench.read();
    CHECK(bench.tick.now_ns == 0);
    CHECK(bench.out.recording.not_finite == 1);
    CHECK(bench.out.notices.count == 1);
    bench.read();
  }
}

TEST_CASE("what cannot be flown is refused in one sentence that begins with the key of the description") {
  const Folder folder;
  folder.write("imu.csv", level(5));
  folder.write("mag.csv", "t,x,y,z\n1000,1,2,3\n");
  folder.write("empty.csv", "t,p,q,r,x,y,z\nnan,0,0,0,0,0,0\n");
  const std::string at = folder.path.string() + "/", heading = at + "imu.csv:1, t, p, q, r, x, y, z";
  const auto refusal = [&](auto change) {
    Description d = imu_alone();
    change(d);
    return fly(d, folder).fault;
  };
  CHECK(refusal([](Description& d) { d = {}; }) == "log: sensor_log.sensors_missing");
  CHECK(refusal([](Description& d) { d.imu.from.file = "no.csv"; }) ==
        "log.imu.from.file: sensor_log.file_missing(" + at + "no.csv)");
  CHECK(refusal([](Description& d) { d.imu.from.file = "imu.mat"; }) ==
        "log.imu.from.file: sensor_log.file_kind_unknown(" + at + "imu.mat)");
  CHECK(refusal([](Description& d) { d.imu.from.time = ""; }) ==
        "log.imu.from.time: sensor_log.column_not_named(" + at + "imu.csv)");
  CHECK(refusal([](Description& d) { d.imu.rate.columns[1] = ""; }) ==
        "log.imu.rate.columns[1]: sensor_log.column_not_named(" + at + "imu.csv)");
  CHECK(refusal([](Description& d) { d.imu.rate.columns[1] = "gy"; }) ==
        "log.imu.rate.columns[1]: sensor_log.column_unknown(gy, " + heading + ")");
  CHECK(refusal([](Description& d) {
          d.mag.field.columns = {"x", "y", "z"};
        }) == "log.mag.from.file: sensor_log.file_not_named(log.mag)");
  CHECK(refusal([](Description& d) {
          d.imu.withhold.count = 1;
          d.imu.withhold.items[0] = {3, 2};
        }) == "log.imu.withhold[0]: sensor_log.window_empty(3 s, 2 s)");
  CHECK(refusal([](Description& d) {
          d.use = {5, 6};
        }) == "log.imu.from.file: sensor_log.file_ends_early(" + at + "imu.csv:6, 0.04 s, 6 s)");
  CHECK(refusal([](Description& d) { d.use.from_s = 5; }) == "log.use: sensor_log.use_empty");
  CHECK(refusal([](Description& d) { d.imu.from.file = "empty.csv"; }) ==
        "log.imu.from.file: sensor_log.rows_unusable(" + at + "empty.csv, 1)");
  CHECK(refusal([](Description& d) { mag_columns(d); }) == "log.mag.from: sensor_log.times_apart(" + at +
                                                               "mag.csv, 1000 s, 1000 s, " + at +
                                                               "imu.csv, 0 s, 0.04 s)");
}

TEST_CASE("without a folder one sentence says how to give it, and which files are wanted") {
  Bench<Recorded> bench;
  bench.params.log.value = imu_alone();
  mag_columns(bench.params.log.value);
  CHECK(bench.configure() == Status::failed);
  CHECK(bench.error() == "folder: sensor_log.folder_missing(imu.csv, mag.csv)");
}

}  // namespace recorded_test
