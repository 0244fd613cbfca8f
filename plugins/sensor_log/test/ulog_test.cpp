// SPDX-License-Identifier: BSD-3-Clause
#include "files.hpp"
#include "recording.hpp"

namespace ulog_test {

using namespace recording;
using namespace files;
using doctest::Approx;

namespace {

Description all_topics() {
  Description d;
  d.imu.from.file = d.mag.from.file = d.baro.from.file = d.pitot.from.file = d.gnss.from.file = "flight.ulg";
  d.imu.from.topic = "sensor_combined";
  d.mag.from.topic = "sensor_mag#1";
  d.baro.from.topic = "vehicle_air_data";
  d.pitot.from.topic = "differential_pressure";
  d.gnss.from.topic = "sensor_gps";
  return d;
}
Description imu_topic() {
  Description d;
  d.imu.from.file = "flight.ulg";
  d.imu.from.topic = "sensor_combined";
  return d;
}
Flown flown(const Description& d, const std::string& bytes) {
  return recording::flown(d, "flight.ulg", bytes);
}
std::string refusal(const Description& d, const std::string& bytes) { return flown(d, bytes).fault; }

}  // namespace

TEST_CASE("topics of PX4 need no column: their names say what they are; # is an instance") {
  const Flown f = flown(all_topics(), ulog());
  REQUIRE(f.fault == "");
  CHECK(f.ticks_ns == std::vector<std::int64_t>{0, 10'000'000, 20'000'000});
  REQUIRE(f.imu.size() == 3);
  for (std::size_t i = 0; i < 3; ++i) {
    const double k = static_cast<double>(i + 1);
    CHECK(f.imu[i].value.rate_radps == Vec3<Body>{0.5 * k, 0.25 * k, -0.125 * k});
    CHECK(f.imu[i].value.specific_force_mps2 == Vec3<Body>{k, 2 * k, -9.75});
  }
  REQUIRE(f.gnss.size() == 1);
  CHECK(f.gnss[0].valid_at_ns == 5'000'000);
  const Gnss& g = f.gnss[0].value;
  CHECK(g.latitude_deg == 40.25);
  CHECK(g.longitude_deg == -111.65);
  CHECK(g.altitude_m == 1387.5);
  CHECK(g.velocity_mps == Vec3<Ned>{3, -4, 0.5});
  CHECK(g.horizontal_std_m == 1.5);
  CHECK(g.vertical_std_m == 2.5);
  CHECK(g.speed_std_mps == 0.25);
  CHECK(g.fix == FixType::rtk_fixed);
  CHECK(g.satellites == 11);
  CHECK(f.baro.at(0).value.pressure_pa == 86'000.5);
  CHECK(f.pitot.at(0).value.pressure_pa == 245);
  CHECK(f.mag.at(0).value.field_tesla.x == Approx(2.5e-5).epsilon(1e-6));  // 0.25 gauss, of the second one
  CHECK(f.mag.at(0).value.field_tesla.z == Approx(5e-5).epsilon(1e-6));
}

TEST_CASE("the fixes of a PX4 before 1.14 are whole numbers of 1e-7 degrees and of millimetres") {
  Description d;
  d.gnss.from.file = "flight.ulg";
  d.gnss.from.topic = "vehicle_gps_position";
  std::string file = ulog_begin() +
                     ulog_format(
                         "vehicle_gps_position:uint64_t timestamp;int32_t lat;int32_t lon;int32_t alt;float "
                         "s_variance_m_s;float eph;float epv;float vel_n_m_s;float vel_e_m_s;float "
                         "vel_d_m_s;uint8_t fix_type;uint8_t satellites_used;") +
                     ulog_topic(0, 1, "vehicle_gps_position");
  file += ulog_data(1, raw(std::uint64_t{5}) + raw(402'500'000) + raw(-1'116'500'000) + raw(1'387'500) +
                           raw(0.F) + raw(1.F) + raw(1.F) + raw(1.F) + raw(1.F) + raw(1.F) +
                           raw(std::uint8_t{2}) + raw(std::uint8_t{4}));
  const Flown f = flown(d, file);
  REQUIRE(f.fault == "");
  CHECK(f.gnss.at(0).value.latitude_deg == Approx(40.25).epsilon(1e-12));
  CHECK(f.gnss.at(0).value.longitude_deg == Approx(-111.65).epsilon(1e-12));
  CHECK(f.gnss.at(0).value.altitude_m == Approx(1387.5).epsilon(1e-12));
  CHECK(f.gnss.at(0).value.fix == FixType::fix_2d);
  CHECK(f.gnss.at(0).value.speed_std_mps == unknown_std);  // 0 is no deviation
}

TEST_CASE("a description may name any field, nested ones and elements included") {
  Description d;
  d.imu.from.file = "flight.ulg";
  d.imu.from.topic = "own";
  d.imu.from.time = "timestamp";
  d.imu.from.unit = TimeUnit::us;
  d.imu.rate.columns = {"points[0].a", "points[1].b", "good"};
  d.imu.specific_force.columns = {"points[0].b", "points[1].a", "good"};
  const Flown f = flown(d, ulog());
  REQUIRE(f.fault == "");
  CHECK(f.imu.at(0).value.rate_radps == Vec3<Body>{-3, -2.5, 1});
  CHECK(f.imu.at(0).value.specific_force_mps2 == Vec3<Body>{1.5, 4, 1});
}

TEST_CASE("what cannot be read of a ULog is refused in one sentence") {
  const std::string no_log = "no log at all, but as long as the head of one";
  CHECK(refusal(imu_topic(), no_log) == "log.imu.from.file: sensor_log.file_not_ulog(flight.ulg)");
  Description none = imu_topic();
  const std::string topics =
      "sensor_combined, vehicle_air_data, differential_pressure, sensor_mag, sensor_mag#1, sensor_gps, own";
  for (const char* const topic : {"sensor_mag#2", "sensor_mag#x", "sensor_mag#", "sensor_mag#1a"}) {
    none.imu.from.topic = topic;
    CHECK(refusal(none, ulog()) == "log.imu.from.topic: sensor_log.topic_unknown(" + std::string(topic) +
                                       ", flight.ulg, " + topics + ")");
  }
  Description column = imu_topic();
  column.imu.rate.columns = {"gyro_rad[0]", "gyro_rad[3]", "gyro_rad[2]"};
  CHECK(refusal(column, ulog())
            .starts_with("log.imu.rate.columns[1]: sensor_log.column_unknown(gyro_rad[3], sensor_combined of "
                         "flight.ulg, timestamp, gyro_rad[0], gyro_rad[1], gyro_rad[2], "));
  CHECK(refusal(imu_topic(), ulog_begin(2) + ulog_topic(0, 1, "x")).find("sensor_log.log_too_new") !=
        std::string::npos);
  CHECK(refusal(imu_topic(), ulog_begin() + ulog_topic(0, 1, "sensor_combined")) ==
        "log.imu.from.file: sensor_log.format_missing(flight.ulg, sensor_combined)");
  const std::string with_pose = ulog_format("sensor_combined:uint64_t timestamp;pose[2] p;");
  const auto one_topic = [](const std::string& formats) {
    return ulog_begin() + formats + ulog_topic(0, 1, "sensor_combined") + ulog_data(1, std::string(40, '\0'));
  };
  CHECK(refusal(imu_topic(), one_topic(with_pose)) ==
        "log.imu.from.file: sensor_log.format_missing(flight.ulg, pose)");
  CHECK(refusal(imu_topic(), one_topic(with_pose + ulog_format("pose:"))) ==
        "log.imu.from.file: sensor_log.format_empty(flight.ulg, pose)");
  CHECK(refusal(imu_topic(), one_topic(with_pose + ulog_format("pose:pose[60000] p;"))) ==
        "log.imu.from.file: sensor_log.format_missing(flight.ulg, pose)");
  CHECK(refusal(imu_topic(), one_topic(with_pose + ulog_format("pose:float[60000] p;"))) ==
        "log.imu.from.file: sensor_log.format_too_large(flight.ulg, float[60000], p[1].p)");
  const std::string silent = ulog_begin() + ulog_format("sensor_combined:uint64_t timestamp;float x;") +
                             ulog_topic(0, 1, "sensor_combined");
  Description empty = imu_topic();
  empty.imu.rate.columns = empty.imu.specific_force.columns = {"x", "x", "x"};
  CHECK(refusal(empty, silent) == "log.imu.from.topic: sensor_log.topic_empty(flight.ulg)");
  Description csv = imu_topic();
  csv.imu.from.file = "imu.csv";
  const Folder folder;
  folder.write("imu.csv", level(3));
  CHECK(fly(csv, folder).fault ==
        "log.imu.from.topic: sensor_log.topics_not_in_file(" + folder.path.string() + "/imu.csv)");
}

TEST_CASE("a ULog that the power has cut is read up to its last whole record, and says where it is cut") {
  constexpr std::size_t record = 3 + 2 + 8 + 6 * 4, rows = 40;
  std::string begin = ulog_begin() +
                      ulog_format(
                          "sensor_combined:uint64_t timestamp;float[3] gyro_rad;float[3] "
                          "accelerometer_m_s2;") +
                      ulog_topic(0, 7, "sensor_combined");
  std::string whole = begin;
  for (std::uint64_t i = 0; i < rows; ++i)
    whole += ulog_data(
        7, raw(1'000'000 + 5'000 * i) + raw(0.F) + raw(0.F) + raw(0.F) + raw(0.F) + raw(0.F) + raw(-9.8F));
  REQUIRE(whole.size() == begin.size() + rows * record);
  for (std::size_t size = whole.size() - 1000; size <= whole.size(); size += 3) {
    CAPTURE(size);
    const Flown f = flown(imu_topic(), whole.substr(0, size));
    const std::size_t kept = (size - begin.size()) / record, at = begin.size() + kept * record;
    CHECK(f.fault == "");
    CHECK(f.imu.size() == kept);
    REQUIRE(f.notices.size() == (at == size ? 0 : 1));
    if (at == size) continue;
    CHECK(f.notices[0].find("sensor_log.file_cut(flight.ulg, " + std::to_string(at) + ", ") == 0);
    CHECK(f.notices[0].find(seconds(0.005 * static_cast<double>(kept - 1))) != std::string::npos);
  }
}

TEST_CASE("what PX4 has appended to a ULog after a crash is read, behind the record that the crash has cut") {
  const auto row = [](std::uint64_t t_us) {
    return ulog_data(7, raw(t_us) + raw(0.F) + raw(0.F) + raw(0.F) + raw(0.F) + raw(0.F) + raw(-9.8F));
  };
  std::string file = ulog_begin(1) +
                     ulog_format(
                         "sensor_combined:uint64_t timestamp;float[3] gyro_rad;float[3] "
                         "accelerometer_m_s2;") +
                     ulog_topic(0, 7, "sensor_combined") + row(1'000'000) + row(1'005'000);
  file += row(1'010'000).substr(0, 20);
  constexpr std::size_t offsets_at = 16 + 3 + 8 + 8;
  file.replace(offsets_at, 8, raw(std::uint64_t{file.size()}));
  file += row(1'020'000) + row(1'025'000) + row(1'030'000);
  const Flown f = flown(imu_topic(), file);
  CHECK(f.fault == "");
  CHECK(f.ticks_ns == std::vector<std::int64_t>{0, 5'000'000, 20'000'000, 25'000'000, 30'000'000});
  CHECK(f.notices.empty());
}

TEST_CASE("every beginning of a ULog, and every one with one byte changed, is read or refused in words") {
  const std::string whole = ulog();
  const Folder folder;
  const auto with = [&](const std::string& bytes) {
    folder.write("flight.ulg", bytes);
    return fly(all_topics(), folder);
  };
  for (std::size_t n = 0; n < whole.size(); n += 3) {
    const Flown cut = with(whole.substr(0, n));
    CHECK((cut.fault.starts_with("log.") || !cut.imu.empty()));
    std::string changed = whole;
    changed[n] = static_cast<char>(changed[n] ^ (1 << n % 8));
    const Flown f = with(changed);
    CHECK((f.fault == "" || (f.fault.starts_with("log.") && f.fault.find(": ") != std::string::npos)));
  }
}

TEST_CASE("a folder in the place of a file is refused with the key, the path and the reason") {
  for (const char* name : {"imu.csv", "imu.mcap", "imu.ulg"}) {
    const Folder folder;
    const std::filesystem::path path = folder.path / name;
    std::filesystem::create_directory(path);
    Description d = imu_alone();
    d.imu.from.file = name;
    CHECK(fly(d, folder).fault ==
          "log.imu.from.file: sensor_log.file_unreadable(" + path.string() + ", Is a directory)");
  }
}

}  // namespace ulog_test
