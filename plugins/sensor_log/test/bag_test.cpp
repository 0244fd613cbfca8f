// SPDX-License-Identifier: BSD-3-Clause
#include "files.hpp"
#include "recording.hpp"

namespace bag_test {

using namespace recording;
using namespace files;
using doctest::Approx;

namespace {

Description all_topics() {
  Description d;
  d.imu.from.file = d.mag.from.file = d.baro.from.file = d.pitot.from.file = d.gnss.from.file = "flight.mcap";
  d.imu.from.topic = "/imu/data";
  d.mag.from.topic = "/mag";
  d.baro.from.topic = "/pressure";
  d.pitot.from.topic = "/airspeed";
  d.gnss.from.topic = "/gnss";
  return d;
}
Description imu_topic() {
  Description d;
  d.imu.from.file = "flight.mcap";
  d.imu.from.topic = "/imu/data";
  return d;
}
Flown flown(const Description& d, const std::string& bytes) {
  return recording::flown(d, "flight.mcap", bytes);
}
std::string refusal(const Description& d, const std::string& bytes) { return flown(d, bytes).fault; }

}  // namespace

TEST_CASE("topics of sensor_msgs and rosflight_msgs need no column: their types say what they are") {
  const Flown f = flown(all_topics(), bag());
  REQUIRE(f.fault == "");
  REQUIRE(f.imu.size() == 3);
  for (std::size_t i = 0; i < 3; ++i) {
    const double k = static_cast<double>(i + 1);
    CHECK(f.imu[i].now_ns == static_cast<std::int64_t>(i) * 10'000'001);
    CHECK(f.imu[i].value.rate_radps == Vec3<Body>{0.1 * k, 0.2 * k, 0.3 * k});
    CHECK(f.imu[i].value.specific_force_mps2 == Vec3<Body>{k, 2 * k, -9.8});
  }
  REQUIRE(f.gnss.size() == 1);
  CHECK(f.gnss[0].valid_at_ns == 20'000'000);
  const Gnss& g = f.gnss[0].value;
  CHECK(g.latitude_deg == 40.25);
  CHECK(g.longitude_deg == -111.65);
  CHECK(g.altitude_m == 1387.5);
  CHECK(g.velocity_mps == Vec3<Ned>{3, -4, 0.5});
  CHECK(g.horizontal_std_m == 1.5);
  CHECK(g.vertical_std_m == 2.5);
  CHECK(g.speed_std_mps == 0.25);
  CHECK(g.fix == FixType::fix_3d);
  CHECK(g.satellites == 11);
  REQUIRE(f.baro.size() == 1);
  CHECK(f.baro[0].value.pressure_pa == 86'000.5);
  CHECK(f.baro[0].valid_at_ns == 5'000'000);
  REQUIRE(f.pitot.size() == 1);
  CHECK(f.pitot[0].value.pressure_pa == 245);
  REQUIRE(f.mag.size() == 1);
  CHECK(f.mag[0].value.field_tesla == Vec3<Body>{2e-5, -1e-6, 4.5e-5});
}

TEST_CASE(
    "a NavSatFix has no velocity, and an altitude above the ellipsoid, which the description may take off") {
  Description d;
  d.gnss.from.file = "flight.mcap";
  d.gnss.from.topic = "/fix";
  d.gnss.position.geoid_m = -17;
  const Flown f = flown(d, bag());
  REQUIRE(f.fault == "");
  const Gnss& g = f.gnss.at(0).value;
  CHECK(g.latitude_deg == 40.5);
  CHECK(g.longitude_deg == -111.5);
  CHECK(g.altitude_m == 1387);
  CHECK(g.speed_std_mps == unknown_std);
  CHECK(g.fix == FixType::fix_3d);
}

TEST_CASE(
    "a description may name any field of a topic, elements of arrays included, over what goes without "
    "saying") {
  Description d = imu_topic();
  d.imu.rate.columns = {"angular_velocity.z", "orientation.w", "linear_acceleration_covariance[8]"};
  d.imu.specific_force.unit = ForceUnit::g;
  const Flown f = flown(d, bag());
  REQUIRE(f.fault == "");
  CHECK(f.imu.at(0).value.rate_radps == Vec3<Body>{0.3, -1, -3});
  CHECK(f.imu.at(0).value.specific_force_mps2.x == Approx(9.80665));
}

TEST_CASE("of a fix, too, what the description names is read, and the rest goes without saying") {
  Description d;
  d.gnss.from.file = "flight.mcap";
  d.gnss.from.topic = "/gnss";
  d.gnss.horizontal_std = "vertical_accuracy";
  d.gnss.satellites = "fix_type";
  d.gnss.fix = {"fix_type", FixCode::px4};
  d.gnss.velocity.columns = {"vel_e", "vel_n", "vel_d"};
  Flown f = flown(d, bag());
  REQUIRE(f.fault == "");
  const Gnss g = f.gnss.at(0).value;
  CHECK(g.horizontal_std_m == 2.5);
  CHECK(g.vertical_std_m == 2.5);
  CHECK(g.satellites == 3);
  CHECK(g.fix == FixType::fix_3d);
  CHECK(g.velocity_mps == Vec3<Ned>{-4, 3, 0.5});
  CHECK(g.latitude_deg == 40.25);
  d = Description{};
  d.gnss.from.file = "flight.mcap";
  d.gnss.from.topic = "/gnss";
  d.gnss.position.columns = {"lat", "lat", "alt"};
  d.gnss.position.altitude_unit = LengthUnit::cm;
  f = flown(d, bag());
  REQUIRE(f.fault == "");
  CHECK(f.gnss.at(0).value.longitude_deg == 40.25);
  CHECK(f.gnss.at(0).value.altitude_m == 13.875);
  CHECK(f.gnss.at(0).value.satellites == 11);
  CHECK(f.gnss.at(0).value.velocity_mps == Vec3<Ned>{3, -4, 0.5});
}

TEST_CASE("text, bounded text, sequences and arrays of structures are stepped over") {
  const std::string definition =
      "string a\nstring<=8 b\npkg/Pair[] pairs\nuint16[] list\nbool[3] flags\npkg/Pair[2] two\nfloat32 "
      "x\nHeader header\n" +
      header_definition + "===\nMSG: pkg/Pair\nint8 k\nint64 v\n";
  Cdr c;
  c.put_text("hello").put_text("");
  c.put(std::uint32_t{2}).put(std::int8_t{1}).put(std::int64_t{2}).put(std::int8_t{3}).put(std::int64_t{4});
  c.put(std::uint32_t{3}).put(std::uint16_t{7}).put(std::uint16_t{8}).put(std::uint16_t{9});
  c.put(std::uint8_t{1}).put(std::uint8_t{0}).put(std::uint8_t{1});
  c.put(std::int8_t{1}).put(std::int64_t{2}).put(std::int8_t{3}).put(std::int64_t{4});
  c.put(6.25F).header(5, 6, "f");
  Description d;
  d.baro.from.file = "flight.mcap";
  d.baro.from.topic = "/own";
  d.baro.pressure.column = "x";
  d.baro.pressure.unit = PressureUnit::hpa;
  const Flown f = flown(d, mcap_begin() + mcap_schema(1, "pkg/msg/Own", definition) +
                               mcap_channel(1, 1, "/own") + mcap_message(1, 0, c.bytes()) + mcap_end());
  REQUIRE(f.fault == "");
  CHECK(f.baro.at(0).value.pressure_pa == 625);
}

TEST_CASE("a topic without a header is stamped by its recorder; both stamps of a bag are columns") {
  const auto message = [](std::uint64_t logged, std::uint64_t published, float x) {
    return record(5, raw(std::uint16_t{1}) + raw(std::uint32_t{0}) + raw(logged) + raw(published) +
                         Cdr{}.put(x).bytes());
  };
  constexpr std::uint64_t t = 1'700'000'000'000'000'000;
  const auto file = [&](const std::string& fields) {
    return mcap_begin() + mcap_schema(1, "pkg/msg/Own", fields) + mcap_channel(1, 1, "/own") +
           message(t, t - 9, 1e5F) + message(t + 7, t - 8, 1.01e5F) +
           message(~std::uint64_t{0}, t - 7, 1.02e5F) + mcap_end();
  };
  Description d;
  d.baro.from.file = "flight.mcap";
  d.baro.from.topic = "/own";
  d.baro.pressure.column = "x";
  const Flown f = flown(d, file("float32 x\n"));
  REQUIRE(f.fault == "");
  CHECK(f.ticks_ns == std::vector<std::int64_t>{0, 7});
  CHECK(f.last.not_finite == 1);  // a stamp of 584 years
  d.baro.from.time = "publish_time";
  d.baro.from.unit = TimeUnit::ns;
  CHECK(flown(d, file("float32 x\n")).ticks_ns == std::vector<std::int64_t>{0, 1, 2});
  d.baro.from.time = "log_time";
  d.baro.from.unit = TimeUnit::s;
  const std::string none = flown(d, file("float32 x\n")).fault;
  CHECK(none.find("sensor_log.rows_unusable(") != std::string::npos);
  CHECK(none.ends_with(", 3)"));
  // a field of that name comes first
  CHECK(flown(d, file("float32 log_time\n")).fault.find("sensor_log.column_unknown(x, /own of ") !=
        std::string::npos);
  d.baro.pressure.column = "log_time";
  CHECK(flown(d, file("float32 log_time\n")).ticks_ns ==
        std::vector<std::int64_t>{0, 1'000'000'000'000, 2'000'000'000'000});
}

TEST_CASE("NaN and stamps out of order in a bag: left out, counted, told with the number of the message") {
  constexpr std::int32_t s = 1'700'000'000;
  std::string file =
      mcap_begin() + mcap_schema(1, "sensor_msgs/msg/Imu", imu_definition) + mcap_channel(1, 1, "/imu/data");
  const std::pair<std::uint32_t, double> rows[] = {{0, 1}, {10, 2}, {10, 9}, {20, std::nan("")},
                                                   {5, 9}, {30, 3}};
  for (const auto& [ns, k] : rows) file += mcap_message(1, 0, imu_message(s, ns, "x", k));
  const Flown f = flown(imu_topic(), file + mcap_end());
  CHECK(f.ticks_ns == std::vector<std::int64_t>{0, 10, 30});
  CHECK(f.last.not_finite == 1);
  CHECK(f.last.out_of_order == 2);
  CHECK(f.notices == std::vector<std::string>{"sensor_log.rows_left_out(flight.mcap, 3, message 3, "
                                              "1 not finite, 2 out of order)"});
}

TEST_CASE("what cannot be read of a bag is refused in one sentence") {
  const auto topic = [](const char* name) {
    Description d = imu_topic();
    d.imu.from.topic = name;
    return d;
  };
  CHECK(refusal(imu_topic(), "t,p\n1,2\n") == "log.imu.from.file: sensor_log.file_not_mcap(flight.mcap)");
  CHECK(refusal(topic("/imu"), bag()) ==
        "log.imu.from.topic: sensor_log.topic_unknown(/imu, flight.mcap, /imu/data, /gnss, /pressure, "
        "/airspeed, /mag, /fix)");
  CHECK(refusal(topic("/mag"), bag()) ==
        "log.imu.rate.columns[0]: sensor_log.column_of_topic_not_named(flight.mcap)");
  Description other = imu_topic();
  other.imu.from.time = "stamp";
  CHECK(refusal(other, bag())
            .starts_with("log.imu.from.time: sensor_log.column_unknown(stamp, /imu/data of flight.mcap, "
                         "header.stamp, orientation.x, "));
  CHECK(refusal(imu_topic(), bag(false)) == "log.imu.from.file: sensor_log.file_damaged(flight.mcap, " +
                                                std::to_string(bag(false).size()) +
                                                ", sensor_log.data_without_end)");
  const std::string types = mcap_schema(1, "sensor_msgs/msg/Imu", imu_definition);
  CHECK(refusal(imu_topic(), mcap_begin() + types + mcap_channel(1, 1, "/imu/data", "json") + mcap_end()) ==
        "log.imu.from.topic: sensor_log.encoding_unsupported(/imu/data, json, ros2msg)");
  CHECK(refusal(imu_topic(), mcap_begin() + mcap_chunk_of(types.size(), 0, "lz4", "foreign") + mcap_end())
            .find("sensor_log.chunk_packing_unsupported(flight.mcap, lz4)") != std::string::npos);
  const std::string whole = mcap_begin() + types + mcap_channel(1, 1, "/imu/data");
  CHECK(refusal(imu_topic(), whole + mcap_message(1, 0, std::string("\0\x01\0\0\1\2\3", 7)) + mcap_end())
            .find("sensor_log.data_cut") != std::string::npos);
  CHECK(refusal(imu_topic(), whole + mcap_message(1, 0, std::string(400, '\0')) + mcap_end())
            .find("sensor_log.message_not_xcdr") != std::string::npos);
  CHECK(refusal(imu_topic(), whole + mcap_end()).find("sensor_log.topic_empty(flight.mcap)") !=
        std::string::npos);
  CHECK(refusal(imu_topic(), mcap_begin() + mcap_schema(1, "sensor_msgs/msg/Imu", "pkg/Other x\n") +
                                 mcap_channel(1, 1, "/imu/data") + mcap_end()) ==
        "log.imu.from.file: sensor_log.type_unknown(flight.mcap, /imu/data, pkg/Other)");
}

TEST_CASE("the checksum is that of IEEE 802.3, whose check value is published") {
  CHECK(crc32("123456789") == 0xCBF43926U);
  CHECK(crc32("") == 0);
}

TEST_CASE("a chunk that is damaged, or is not as long as it says, is refused, not read") {
  const std::string records = mcap_schema(1, "sensor_msgs/msg/Imu", imu_definition) +
                              mcap_channel(1, 1, "/imu/data") + mcap_message(1, 0, imu_message(5, 6, "x", 1));
  const auto said = [&](std::uint64_t size, std::uint32_t checksum, const char* name,
                        const std::string& packed) {
    return refusal(imu_topic(), mcap_begin() + mcap_chunk_of(size, checksum, name, packed) + mcap_end());
  };
  const std::uint32_t checksum = checksum_of(records);
  const std::string packed = packed_zstd(records);
  CHECK(said(records.size(), checksum, "zstd", packed) == "");
  CHECK(said(records.size(), 0, "zstd", packed) == "");  // 0: not computed
  for (const char* name : {"", "zstd"}) {
    const bool zstd = *name != '\0';
    CHECK(said(records.size(), checksum ^ 1, name, zstd ? packed : records)
              .ends_with(", sensor_log.chunk_checksum_wrong)"));
  }
  const std::string unreported = packed_zstd(records, false);
  CHECK(said(records.size(), checksum, "zstd", unreported) == "");
  for (const std::uint64_t size : {records.size() - 1, records.size() + 1, std::size_t{1} << 29})
    for (const std::string& each : {packed, unreported})
      CHECK(said(size, 0, "zstd", each).ends_with(", sensor_log.chunk_damaged)"));
  CHECK(said(records.size(), 0, "zstd", packed.substr(0, packed.size() - 1))
            .ends_with(", sensor_log.chunk_damaged)"));
  CHECK(said(std::uint64_t{1} << 40, 0, "zstd", packed).ends_with(", sensor_log.chunk_too_large)"));
}

TEST_CASE("a structure of nothing is one byte, and arrays of such have an end") {
  std::string definition = "pkg/Empty nothing\nfloat32 x\nHeader header\n" + header_definition +
                           "===\nMSG: pkg/Empty\nuint8 A=1\n";
  Cdr c;
  c.put(std::uint8_t{0}).put(6.25F).header(5, 6, "f");
  Description d;
  d.baro.from.file = "flight.mcap";
  d.baro.from.topic = "/own";
  d.baro.pressure.column = "x";
  d.baro.pressure.unit = PressureUnit::hpa;
  const auto file = [&](const std::string& words, const std::string& message) {
    return mcap_begin() + mcap_schema(1, "pkg/msg/Own", words) + mcap_channel(1, 1, "/own") +
           mcap_message(1, 0, message) + mcap_end();
  };
  const Flown f = flown(d, file(definition, c.bytes()));
  REQUIRE(f.fault == "");
  CHECK(f.baro.at(0).value.pressure_pa == 625);

  std::string deep = "float32 x\nHeader header\npkg/A0[100] many\n" + header_definition;
  for (int i = 0; i < 12; ++i)
    deep += "===\nMSG: pkg/A" + std::to_string(i) + "\npkg/A" + std::to_string(i + 1) + "[100] many\n";
  deep += "===\nMSG: pkg/A12\n";
  CHECK(refusal(d, file(deep, Cdr{}.put(6.25F).header(5, 6, "f").bytes() + std::string(300, '\0')))
            .find("sensor_log.message_cut(100, ") != std::string::npos);
}

TEST_CASE("every beginning of a bag, and every bag with one byte changed, is read or refused in words") {
  const std::string whole = bag();
  const std::string end = mcap_end();
  const Folder folder;
  const auto with = [&](const Description& d, const std::string& bytes) {
    folder.write("flight.mcap", bytes);
    return fly(d, folder).fault;
  };
  for (std::size_t n = 0; n < whole.size() - end.size(); n += n < 200 ? 1 : 17)
    CHECK(with(imu_topic(), whole.substr(0, n)).starts_with("log.imu."));
  for (std::size_t n = 0; n < whole.size(); n += 5) {
    std::string changed = whole;
    changed[n] = static_cast<char>(changed[n] ^ (1 << n % 8));
    const std::string fault = with(all_topics(), changed);
    CHECK((fault == "" || (fault.starts_with("log.") && fault.find(": ") != std::string::npos)));
  }
}

}  // namespace bag_test
