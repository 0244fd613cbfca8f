// SPDX-License-Identifier: BSD-3-Clause
// Logs exported and read back by small readers of the formats that are independent of the writers.
#include <doctest/doctest.h>
#include <zlib.h>

#include <cmath>
#include <map>

#include "core/error.hpp"
#include "core/log/test/log_kit.hpp"
#include "tools/fulmar_log/export_log.hpp"
#include "tools/fulmar_log/info.hpp"

namespace export_test {

using namespace fulmar::core;
using namespace fulmar::core::test;

namespace {

std::string inflated(const std::string& bytes, std::size_t size, int window) {
  std::string out(size, '\0');
  z_stream z{};
  REQUIRE(::inflateInit2(&z, window) == Z_OK);
  z.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  z.avail_in = static_cast<uInt>(bytes.size());
  z.next_out = reinterpret_cast<Bytef*>(out.data());
  z.avail_out = static_cast<uInt>(out.size());
  const int code = ::inflate(&z, Z_FINISH);
  CHECK((code == Z_STREAM_END || code == Z_BUF_ERROR));
  out.resize(z.total_out);
  ::inflateEnd(&z);
  return out;
}

template <class T>
T at(const std::string& bytes, std::size_t place) {
  T value;
  REQUIRE(place + sizeof value <= bytes.size());
  std::memcpy(&value, bytes.data() + place, sizeof value);
  return value;
}

/// name -> content of a zip file, found from its end.
std::map<std::string, std::string> unzip(const std::string& zip) {
  std::map<std::string, std::string> files;
  const std::size_t end = zip.size() - 22;
  REQUIRE(zip.substr(end, 4) == "PK\5\6");
  std::size_t place = at<std::uint32_t>(zip, end + 16);
  for (int left = at<std::uint16_t>(zip, end + 10); left > 0; --left) {
    REQUIRE(zip.substr(place, 4) == "PK\1\2");
    const auto method = at<std::uint16_t>(zip, place + 10), name = at<std::uint16_t>(zip, place + 28);
    const auto crc = at<std::uint32_t>(zip, place + 16), stored = at<std::uint32_t>(zip, place + 20),
               size = at<std::uint32_t>(zip, place + 24);
    const auto local = at<std::uint32_t>(zip, place + 42);
    REQUIRE(zip.substr(local, 4) == "PK\3\4");
    const std::string content = zip.substr(local + 30 + name, stored);
    std::string& made = files[zip.substr(place + 46, name)];
    made = method == 8 ? inflated(content, size, -15) : content;
    CHECK(made.size() == size);
    CHECK(::crc32_z(0, reinterpret_cast<const Bytef*>(made.data()), made.size()) == crc);
    place += 46u + name;
  }
  return files;
}

struct Npy {
  std::string header, data;
  explicit Npy(const std::string& bytes) {
    REQUIRE(bytes.substr(0, 8) == std::string("\x93NUMPY\x01\0", 8));
    const auto length = at<std::uint16_t>(bytes, 8);
    CHECK((10u + length) % 64 == 0);
    header = bytes.substr(10, length);
    data = bytes.substr(10u + length);
  }
};

/// A data element of a MAT file: type, bytes, and where the next one begins.
struct Element {
  std::uint32_t type;
  std::string bytes;
  std::size_t next;
  Element(const std::string& file, std::size_t place) {
    const auto word = at<std::uint32_t>(file, place);
    if (word >> 16 != 0) {
      type = word & 0xffff;
      bytes = file.substr(place + 4, word >> 16);
      next = place + 8;
      return;
    }
    type = word;
    bytes = file.substr(place + 8, at<std::uint32_t>(file, place + 4));
    next = place + 8 + (bytes.size() + 7) / 8 * 8;
  }
};

struct Matrix {
  std::uint32_t shape;
  std::int32_t rows, columns;
  std::string name, bytes;
  std::size_t body;  // behind the name
  explicit Matrix(const std::string& b) : bytes(b) {
    const Element flags(bytes, 0), dims(bytes, flags.next), title(bytes, dims.next);
    shape = at<std::uint32_t>(flags.bytes, 0);
    rows = at<std::int32_t>(dims.bytes, 0);
    columns = at<std::int32_t>(dims.bytes, 4);
    name = title.bytes;
    body = title.next;
  }
};

std::vector<std::string> lines(const std::string& text) {
  std::vector<std::string> list;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) list.push_back(line);
  return list;
}

}  // namespace

TEST_CASE("CSV: times, every field, labels, lists as wide as the longest; numbers read back as they were") {
  const Folder folder;
  write_sample({.file = folder.path / "a.mcap"}, 1000, [](int i, Mixed& m) {
    m.speed_mps = 0.1 * i;
    if (i == 1) m.name = {'a', '"', ',', 'b'};
  });
  const ExportResult r = export_log(folder.path / "a.mcap", ExportForm::csv, folder.path / "out", {});
  CHECK(r.fault == "");
  REQUIRE(r.topics.size() == 2);
  const auto number = lines(contents(folder.path / "out" / "number.csv"));
  REQUIRE(number.size() == 251);
  CHECK(number[0] == "time_s,valid_s,value_ratio");
  CHECK(number[1] == "-1,-1.000001,0");
  CHECK(number[2] == "-0.99,-0.990001,2");
  const auto mixed = lines(contents(folder.path / "out" / "mixed.csv"));
  REQUIRE(mixed.size() == 1001);
  CHECK(mixed[0] ==
        "time_s,valid_s,armed,speed_mps,count,gains_ratio[0],gains_ratio[1],gains_ratio[2],name,samples_volt["
        "0],samples_volt[1],mode,mode."
        "label,"
        "stamp_ns,load_ratio,offset,attitude_std_rad.north,attitude_std_rad.east,attitude_std_rad.down,tags["
        "0],tags[1],"
        "legs[0].kind,legs[0].kind.label,legs[0].has_course,legs[0].course_rad,legs[0].position_m.north,legs["
        "0].position_m.east,legs[0]."
        "position_m.down,"
        "legs[1].kind,legs[1].kind.label,legs[1].has_course,legs[1].course_rad,legs[1].position_m.north,legs["
        "1].position_m.east,legs[1]."
        "position_m.down");
  CHECK(mixed[1] ==
        "-1,-1.000001,1,0,7,1,2,-2,ab,0.5,1,1,hold,0,0.25,-3,0.5,1,2,x,yzw,nan,,nan,nan,nan,nan,nan,nan,,nan,"
        "nan,nan,nan,nan");
  CHECK(
      mixed[2].starts_with("-0.9975,-0.997501,1,0.1,7,1,2,-2,\"a\"\",b\",0.5,1,1,hold,1,0.25,-3,0.5,1,2,x,"
                           "yzw,1,orbit,1,0.5,3,4,5,nan"));
  CHECK(mixed[8].substr(0, 40).find(",0.7000000000000001,") != std::string::npos);
  CHECK_THROWS_WITH_AS(export_log(folder.path / "a.mcap", ExportForm::csv, folder.path / "out", {}),
                       doctest::Contains("exists"), Error);
}

TEST_CASE("NPZ: one array per field, of its own type; labels and texts beside") {
  const Folder folder;
  write_sample({.file = folder.path / "a.mcap"}, 1000);
  export_log(folder.path / "a.mcap", ExportForm::npz, folder.path / "a.npz", {});
  const auto files = unzip(contents(folder.path / "a.npz"));
  const Npy time(files.at("mixed.time_s.npy")), speed(files.at("mixed.speed_mps.npy")),
      armed(files.at("mixed.armed.npy"));
  const std::string numbers = "'descr': '<f8', 'fortran_order': False, 'shape': (1000,)";
  CHECK(time.header.find(numbers) != std::string::npos);
  REQUIRE(time.data.size() == 8000);
  CHECK(at<double>(time.data, 8) == -0.9975);
  CHECK(at<double>(speed.data, 8 * 999) == 0.1 * 999);
  CHECK(armed.header.find("'|b1'") != std::string::npos);
  CHECK(armed.data.size() == 1000);
  const Npy stamp(files.at("mixed.stamp_ns.npy"));
  CHECK(stamp.header.find("'<i8'") != std::string::npos);
  CHECK(at<std::int64_t>(stamp.data, 8 * 7) == 7);
  CHECK(Npy(files.at("mixed.load_ratio.npy")).header.find("'<f4'") != std::string::npos);
  const Npy course(files.at("mixed.legs[1].course_rad.npy"));
  CHECK(at<double>(course.data, 8 * 2) == -0.5);
  CHECK(std::isnan(at<double>(course.data, 8 * 3)));
  const Npy name(files.at("mixed.name.npy")), labels(files.at("mixed.mode.labels.npy"));
  CHECK(name.header.find("'<U2'") != std::string::npos);
  CHECK(at<char32_t>(name.data, 4) == U'b');
  const std::string texts = "'<U6', 'fortran_order': False, 'shape': (3,)";
  CHECK(labels.header.find(texts) != std::string::npos);
  CHECK(at<char32_t>(labels.data, 24) == U'h');
  CHECK(files.at("number.value_ratio.npy").size() == 128 + 250 * 8);
}

TEST_CASE("MAT: one struct per topic, columns of numbers, cells of texts") {
  const Folder folder;
  write_sample({.file = folder.path / "a.mcap"}, 100);
  export_log(folder.path / "a.mcap", ExportForm::mat, folder.path / "a.mat", {"/mixed"});
  const std::string file = contents(folder.path / "a.mat");
  CHECK(file.starts_with("MATLAB 5.0 MAT-file"));
  CHECK(file.substr(124, 4) == std::string("\0\x01IM", 4));
  CHECK(at<std::uint32_t>(file, 128) == 15);  // compressed
  const std::string inside = inflated(file.substr(136, at<std::uint32_t>(file, 132)), 1u << 20, 15);
  const Matrix mixed(Element(inside, 0).bytes);
  CHECK(mixed.name == "mixed");
  CHECK((mixed.shape & 0xff) == 2);
  const Element length(mixed.bytes, mixed.body), names(mixed.bytes, length.next);
  REQUIRE(at<std::uint32_t>(length.bytes, 0) == 64);
  std::map<std::string, Matrix> fields;
  std::size_t place = names.next;
  for (std::size_t i = 0; i < names.bytes.size() / 64; ++i) {
    const Element field(mixed.bytes, place);
    REQUIRE(field.type == 14);
    fields.emplace(names.bytes.substr(64 * i, 64).c_str(), Matrix(field.bytes));
    place = field.next;
  }
  CHECK(place == mixed.bytes.size());
  const Matrix& speed = fields.at("speed_mps");
  CHECK((speed.shape & 0xff) == 6);
  CHECK(speed.rows == 100);
  CHECK(speed.columns == 1);
  CHECK(at<double>(Element(speed.bytes, speed.body).bytes, 8 * 99) == 0.1 * 99);
  CHECK(fields.at("armed").shape == (0x200 | 9));
  CHECK((fields.at("stamp_ns").shape & 0xff) == 14);
  CHECK(std::isnan(at<double>(
      Element(fields.at("legs_1_course_rad").bytes, fields.at("legs_1_course_rad").body).bytes, 0)));
  const Matrix& name = fields.at("name");
  CHECK((name.shape & 0xff) == 1);
  const Matrix first(Element(name.bytes, name.body).bytes);
  CHECK((first.shape & 0xff) == 4);
  CHECK(Element(first.bytes, first.body).bytes == "ab");
  CHECK(fields.count("mode_labels") == 1);
}

TEST_CASE(
    "a topic that is not there is refused with the ones that are; one of another encoding is left out, and "
    "refused by name") {
  const Folder folder;
  Sample sample({.file = folder.path / "a.mcap", .profile = "", .library = "other"});
  const std::uint16_t number = sample.channel("/camera/number", *number_type());
  const Number n{0.5};
  sample.write(number, 5'000'000'000, bytes_of(n));
  const std::uint16_t schema = sample.writer.add_schema("pose", "protobuf", "...");
  const std::uint16_t foreign = sample.writer.add_channel(schema, "/pose", "protobuf", {});
  sample.writer.begin_message(foreign, 0, static_cast<std::uint64_t>(epoch_ns), 0);
  sample.writer.end_message(3);
  sample.writer.close();
  const ExportResult r = export_log(folder.path / "a.mcap", ExportForm::csv, folder.path / "out", {});
  REQUIRE(r.left_out.size() == 1);
  CHECK(r.left_out[0].find("/pose") == 0);
  CHECK(r.left_out[0].find("'protobuf'") != std::string::npos);
  CHECK(contents(folder.path / "out" / "camera.number.csv") ==
        "time_s,valid_s,value_ratio\n5,4.999999,0.5\n");  // from the first message on
  CHECK_THROWS_WITH_AS(export_log(folder.path / "a.mcap", ExportForm::npz, folder.path / "b.npz", {"/pose"}),
                       doctest::Contains("protobuf"), Error);
  CHECK_THROWS_WITH_AS(export_log(folder.path / "a.mcap", ExportForm::npz, folder.path / "b.npz", {"/posee"}),
                       doctest::Contains("log.topic_unknown(/posee,  [/pose] "), Error);
  CHECK_FALSE(std::filesystem::exists(folder.path / "b.npz"));
}

TEST_CASE("seconds are exact") {
  CHECK(seconds_text(0) == "0");
  CHECK(seconds_text(-1) == "-0.000000001");
  CHECK(seconds_text(1'002'500'000) == "1.0025");
  CHECK(seconds_text(-5'000'000'000) == "-5");
  CHECK(seconds_text(std::numeric_limits<std::int64_t>::min()) == "-9223372036.854775808");
}

TEST_CASE("what a log costs is told by topic, and adds up to the file") {
  const Folder folder;
  const auto written = write_sample({.file = folder.path / "a.mcap"}, 4000);
  const LogInfo info = read_info(folder.path / "a.mcap");
  CHECK(info.messages == 5000);
  CHECK(info.bytes == written.bytes);
  CHECK(info.file.complete);
  CHECK(info.value("fulmar", "seed") == "7");
  CHECK(info.begin_ns == -1'000'000'000);
  CHECK(info.end_ns == 3999 * 2'500'000LL - 1'000'000'000);
  REQUIRE(info.topics.size() == 2);
  CHECK(info.topics[1].topic == "/number");
  CHECK(info.topics[1].messages == 1000);
  CHECK(info.topics[1].bytes == 1000 * (31 + 4 + 8));
  double sum = 0;
  for (const LogInfo::Topic& t : info.topics) sum += t.stored_bytes;
  CHECK(sum == doctest::Approx(static_cast<double>(written.bytes)).epsilon(0.01));
}

}  // namespace export_test
