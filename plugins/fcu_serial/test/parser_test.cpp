// SPDX-License-Identifier: BSD-3-Clause
// Messages and frames against the dialect written down a second time: types and names in the order of its XML
// (rosflight_firmware 2.0, comms/mavlink/rosflight.xml), the rule of order, a bitwise checksum, and the
// numbers of the generated headers.
#include <doctest/doctest.h>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "fulmar/random.hpp"
#include "plugins/fcu_serial/link/frame.hpp"

namespace parser_test {

using namespace fulmar;
using namespace fulmar::fcu;

namespace {

using Bytes = std::vector<std::uint8_t>;

struct Dialect {
  int id;
  std::string name;
  int crc_extra;
  std::string fields;
};

std::string channels(int first, int last) {
  std::string out;
  for (int i = first; i <= last; ++i) out += " uint16_t chan" + std::to_string(i) + "_raw";
  return out;
}

const std::vector<Dialect> dialect{
    {0, "HEARTBEAT", 50,
     "uint8_t type uint8_t autopilot uint8_t base_mode uint32_t custom_mode uint8_t system_status uint8_t "
     "mavlink_version"},
    {20, "PARAM_REQUEST_READ", 214,
     "uint8_t target_system uint8_t target_component char[16] param_id int16_t param_index"},
    {21, "PARAM_REQUEST_LIST", 159, "uint8_t target_system uint8_t target_component"},
    {22, "PARAM_VALUE", 220,
     "char[16] param_id float param_value uint8_t param_type uint16_t param_count uint16_t param_index"},
    {23, "PARAM_SET", 168,
     "uint8_t target_system uint8_t target_component char[16] param_id float param_value uint8_t param_type"},
    {31, "ATTITUDE_QUATERNION", 246,
     "uint32_t time_boot_ms float q1 float q2 float q3 float q4 float rollspeed float pitchspeed float "
     "yawspeed"},
    {65, "RC_CHANNELS", 118, "uint32_t time_boot_ms uint8_t chancount" + channels(1, 18) + " uint8_t rssi"},
    {111, "TIMESYNC", 34, "int64_t tc1 int64_t ts1"},
    {180, "OFFBOARD_CONTROL", 90, "uint8_t mode uint16_t ignore float[10] u"},
    {181, "SMALL_IMU", 67,
     "uint64_t time_boot_us float xacc float yacc float zacc float xgyro float ygyro float zgyro float "
     "temperature"},
    {182, "SMALL_MAG", 218, "float xmag float ymag float zmag"},
    {183, "SMALL_BARO", 206, "float altitude float pressure float temperature"},
    {184, "DIFF_PRESSURE", 169, "float velocity float diff_pressure float temperature"},
    {187, "SMALL_RANGE", 60, "uint8_t type float range float max_range float min_range"},
    {188, "ROSFLIGHT_CMD", 249, "uint8_t command"},
    {189, "ROSFLIGHT_CMD_ACK", 113, "uint8_t command uint8_t success"},
    {190, "ROSFLIGHT_OUTPUT_RAW", 181, "uint64_t stamp float[14] values"},
    {191, "ROSFLIGHT_STATUS", 12,
     "uint8_t armed uint8_t failsafe uint16_t rc_override uint8_t offboard uint8_t error_code uint8_t "
     "control_mode int16_t num_errors "
     "int16_t loop_time_us"},
    {192, "ROSFLIGHT_VERSION", 134, "char[50] version"},
    {193, "ROSFLIGHT_AUX_CMD", 1, "uint8_t[14] type_array float[14] aux_cmd_array"},
    {195, "EXTERNAL_ATTITUDE", 65, "float qw float qx float qy float qz"},
    {196, "ROSFLIGHT_HARD_ERROR", 10,
     "uint32_t error_code uint32_t pc uint32_t reset_count uint32_t doRearm"},
    {197, "ROSFLIGHT_GNSS", 221,
     "int64_t seconds int32_t nanos uint8_t fix_type uint8_t num_sat double lat double lon float height "
     "float vel_n float vel_e float "
     "vel_d "
     "float h_acc float v_acc float s_acc uint64_t rosflight_timestamp"},
    {199, "ROSFLIGHT_BATTERY_STATUS", 48, "float battery_voltage float battery_current"},
    {253, "STATUSTEXT", 83, "uint8_t severity char[50] text"}};

struct Field {
  std::string type, name;
  std::size_t size = 0, count = 0, offset = 0;  // count 0: no array
  std::size_t bytes() const { return size * std::max<std::size_t>(count, 1); }
};

/// The order of the wire: larger elements first, else as the XML has them.
std::vector<Field> wire_order(const std::string& text) {
  const std::map<std::string, std::size_t> sizes{
      {"char", 1},     {"uint8_t", 1}, {"int16_t", 2}, {"uint16_t", 2}, {"int32_t", 4},
      {"uint32_t", 4}, {"float", 4},   {"int64_t", 8}, {"uint64_t", 8}, {"double", 8}};
  std::vector<Field> fields;
  std::istringstream in(text);
  for (std::string type, name; in >> type >> name;) {
    Field f;
    const std::size_t bracket = type.find('[');
    if (bracket != std::string::npos) f.count = std::stoul(type.substr(bracket + 1));
    f.type = type.substr(0, bracket);
    f.name = name;
    f.size = sizes.at(f.type);
    fields.insert(
        std::find_if(fields.begin(), fields.end(), [&](const Field& other) { return other.size < f.size; }),
        f);
  }
  std::size_t at = 0;
  for (Field& f : fields) {
    f.offset = at;
    at += f.bytes();
  }
  return fields;
}

/// CRC-16/MCRF4XX, bit by bit: reflected polynomial 0x8408.
std::uint16_t bitwise_crc(const Bytes& bytes) {
  unsigned crc = 0xffff;
  for (const unsigned byte : bytes) {
    crc ^= byte;
    for (int bit = 0; bit < 8; ++bit) crc = (crc & 1) != 0 ? (crc >> 1) ^ 0x8408 : crc >> 1;
  }
  return static_cast<std::uint16_t>(crc);
}

int seed_of(const Dialect& d) {
  Bytes text;
  const auto add = [&](const std::string& s) {
    text.insert(text.end(), s.begin(), s.end());
    text.push_back(' ');
  };
  add(d.name);
  for (const Field& f : wire_order(d.fields)) {
    add(f.type);
    add(f.name);
    if (f.count > 0) text.push_back(static_cast<std::uint8_t>(f.count));
  }
  const std::uint16_t crc = bitwise_crc(text);
  return (crc & 0xff) ^ (crc >> 8);
}

const Dialect& known(int id) {
  return *std::find_if(dialect.begin(), dialect.end(), [&](const Dialect& d) { return d.id == id; });
}

/// Names of the members of M and where they begin.
template <class M>
std::vector<std::pair<std::string, std::size_t>> members_of() {
  std::vector<std::pair<std::string, std::size_t>> out;
  M message{};
  fulmar::detail::for_each(message, [&](const auto& member, std::size_t i) {
    const auto* at = reinterpret_cast<const char*>(&member);
    out.emplace_back(fulmar::detail::FieldNames<M>::view(i),
                     static_cast<std::size_t>(at - reinterpret_cast<const char*>(&message)));
  });
  return out;
}

Bytes random_bytes(Random& random, std::size_t n) {
  Bytes out(n);
  for (std::uint8_t& b : out) b = static_cast<std::uint8_t>(random.bits() >> 32);
  return out;
}

/// A whole frame of this message with this payload, made without the code under test.
Bytes frame_of(const Dialect& d, const Bytes& payload, std::uint8_t sequence, std::uint8_t system = 1,
               std::uint8_t component = 250) {
  Bytes out{0xfe,      static_cast<std::uint8_t>(payload.size()),
            sequence,  system,
            component, static_cast<std::uint8_t>(d.id)};
  out.insert(out.end(), payload.begin(), payload.end());
  Bytes summed(out.begin() + 1, out.end());
  summed.push_back(static_cast<std::uint8_t>(d.crc_extra));
  const std::uint16_t crc = bitwise_crc(summed);
  out.push_back(static_cast<std::uint8_t>(crc & 0xff));
  out.push_back(static_cast<std::uint8_t>(crc >> 8));
  return out;
}

std::size_t payload_size(const Dialect& d) {
  const std::vector<Field> fields = wire_order(d.fields);
  return fields.back().offset + fields.back().bytes();
}

Bytes random_frame(Random& random, std::uint8_t sequence) {
  const Dialect& d = dialect[random.bits() % dialect.size()];
  return frame_of(d, random_bytes(random, payload_size(d)), sequence);
}

Bytes bytes_of(const Packet& p) {
  return frame_of(known(p.id), Bytes(p.payload.begin(), p.payload.begin() + p.length), p.sequence, p.system,
                  p.component);
}

std::vector<Packet> parse(Parser& parser, std::span<const std::uint8_t> bytes, std::size_t chunk = SIZE_MAX) {
  std::vector<Packet> out;
  while (!bytes.empty()) {
    const std::size_t n = std::min(chunk, bytes.size());
    parser.feed(bytes.first(n), [&](const Packet& p) { out.push_back(p); });
    bytes = bytes.subspan(n);
  }
  return out;
}

}  // namespace

TEST_CASE("the bitwise checksum is the one of the MAVLink documents") {
  const std::string nine = "123456789";
  CHECK(bitwise_crc(Bytes(nine.begin(), nine.end())) ==
        0x6f91);  // the catalogue's check value of CRC-16/MCRF4XX
}

TEST_CASE("length, seed, names and places of every field of all 25 messages follow from the dialect") {
  int messages = 0;
  for_each_message([&]<class M>() {
    ++messages;
    CAPTURE(M::name);
    const Dialect& d = known(M::id);
    REQUIRE(d.name == M::name);
    CHECK(seed_of(d) == d.crc_extra);
    CHECK(crc_extra<M> == d.crc_extra);
    CHECK(fcu::length<M> == payload_size(d));
    const std::vector<Field> fields = wire_order(d.fields);
    const auto members = members_of<M>();
    REQUIRE(members.size() == fields.size());
    for (std::size_t i = 0; i < fields.size(); ++i) {
      CHECK(members[i].first == fields[i].name);
      CHECK(members[i].second == fields[i].offset);
    }
  });
  CHECK(messages == 25);
  CHECK(dialect.size() == 25);
}

TEST_CASE(
    "every message with random bytes in all fields goes out as the dialect frames it and comes back the "
    "same") {
  Random random(1);
  for (int round = 0; round < 200; ++round) {
    for_each_message([&]<class M>() {
      CAPTURE(M::name);
      const Bytes payload = random_bytes(random, fcu::length<M>);
      M message{};
      std::memcpy(static_cast<void*>(&message), payload.data(), payload.size());
      const auto sequence = static_cast<std::uint8_t>(random.bits());
      const Frame frame = encode(message, sequence, 1, 250);
      const Bytes wire_bytes(frame.view().begin(), frame.view().end());
      REQUIRE(wire_bytes == frame_of(known(M::id), payload, sequence));
      Parser parser;
      const std::vector<Packet> got = parse(parser, frame.view());
      REQUIRE(got.size() == 1);
      CHECK(got[0].sequence == sequence);
      CHECK(got[0].system == 1);
      CHECK(got[0].component == 250);
      const M back = got[0].as<M>();
      CHECK(std::memcmp(&back, payload.data(), payload.size()) == 0);
    });
  }
}

TEST_CASE("bytes fed one by one, in odd pieces and all at once give the same packets and counts") {
  Random random(2);
  Bytes stream;
  for (int i = 0; i < 300; ++i) {
    Bytes piece = random_frame(random, static_cast<std::uint8_t>(i));
    if (i % 7 == 3) piece = random_bytes(random, 40);
    if (i % 11 == 5) piece[piece.size() / 2] ^= 0x10;
    stream.insert(stream.end(), piece.begin(), piece.end());
  }
  Parser whole;
  const std::vector<Packet> expected = parse(whole, stream);
  REQUIRE(expected.size() > 200);
  for (const std::size_t chunk : {1UL, 2UL, 3UL, 7UL, 77UL, 78UL, 511UL, 512UL, 513UL}) {
    CAPTURE(chunk);
    Parser parser;
    const std::vector<Packet> got = parse(parser, stream, chunk);
    REQUIRE(got.size() == expected.size());
    for (std::size_t i = 0; i < got.size(); ++i) CHECK(bytes_of(got[i]) == bytes_of(expected[i]));
    CHECK(parser.counts().frames == whole.counts().frames);
    CHECK(parser.counts().bad == whole.counts().bad);
    CHECK(parser.counts().skipped == whole.counts().skipped);
    CHECK(parser.counts().missing == whole.counts().missing);
  }
}

TEST_CASE("every frame among garbage is found, and the frame behind a damaged one") {
  Random random(3);
  Parser parser;
  Bytes stream;
  std::vector<Bytes> good;
  for (int i = 0; i < 2000; ++i) {
    const Bytes frame = random_frame(random, static_cast<std::uint8_t>(i));
    Bytes noise = random_bytes(random, random.bits() % 60);
    if (i % 3 == 0) noise.insert(noise.end(), {0xfe, 36, 0, 1, 250, 181});  // a start without an end
    if (i % 3 == 1) {
      noise = random_frame(random, 0);
      noise[random.bits() % noise.size()] ^= static_cast<std::uint8_t>(1U << (random.bits() % 8));
    }
    stream.insert(stream.end(), noise.begin(), noise.end());
    stream.insert(stream.end(), frame.begin(), frame.end());
    good.push_back(frame);
  }
  stream.insert(stream.end(), max_frame,
                0);  // a false start at the very end waits for its remaining bytes
  std::vector<Bytes> found;
  for (const Packet& p : parse(parser, stream, 100)) found.push_back(bytes_of(p));
  std::size_t at = 0;
  for (const Bytes& frame : good) {
    const auto hit = std::find(found.begin() + static_cast<std::ptrdiff_t>(at), found.end(), frame);
    REQUIRE(hit != found.end());
    at = static_cast<std::size_t>(hit - found.begin()) + 1;
  }
  CHECK(found.size() == good.size());
  CHECK(parser.counts().bad > 300);
}

TEST_CASE(
    "a frame of a known message with another length, a longer one than any, and a frame of MAVLink 2 are "
    "none") {
  Parser parser;
  const Bytes heartbeat = frame_of(known(0), Bytes(9, 1), 0);
  Bytes wrong_length = frame_of(known(0), Bytes(8, 1), 0);
  Bytes too_long = frame_of(known(193), Bytes(200, 1), 0);
  Bytes version_2 = heartbeat;
  version_2[0] = 0xfd;
  for (const Bytes& bytes : {wrong_length, too_long, version_2}) CHECK(parse(parser, bytes).empty());
  CHECK(parse(parser, heartbeat).size() == 1);
}

TEST_CASE("a whole frame of an unknown message is counted and hides nothing") {
  Parser parser;
  Bytes stream{0xfe, 9, 5, 1, 1, 42};
  const Bytes inside = frame_of(known(0), Bytes(9, 1), 6);
  stream.insert(stream.end(), 11, 0);
  stream.insert(stream.end(), inside.begin(), inside.end());
  CHECK(parse(parser, stream).size() == 1);
  CHECK(parser.counts().unknown == 1);
}

TEST_CASE("missing frames are counted by their sequence, over its wrap, and not over a new connection") {
  Parser parser;
  const auto feed = [&](int sequence) {
    parse(parser, frame_of(known(188), {1}, static_cast<std::uint8_t>(sequence)));
  };
  feed(253);
  feed(254);
  CHECK(parser.counts().missing == 0);
  feed(1);  // 255 and 0 did not come
  CHECK(parser.counts().missing == 2);
  parser.restart();
  feed(100);
  CHECK(parser.counts().missing == 2);
}

TEST_CASE("whatever bytes come, each packet is a frame that stood in them, in order") {
  // Under the sanitizers this also checks for access beyond the buffer.
  const std::size_t total = std::getenv("FULMAR_LONG") != nullptr ? 100'000'000 : 2'000'000;
  Random random(4);
  Parser parser;
  std::size_t fed = 0, packets = 0, damaged = 0;
  Bytes behind;  // the last bytes of the block before
  while (fed < total) {
    Bytes block = behind;
    while (block.size() < 20'000) {
      Bytes piece = random.bits() % 4 == 0 ? random_bytes(random, random.bits() % 120)
                                           : random_frame(random, static_cast<std::uint8_t>(random.bits()));
      for (std::uint64_t hits = random.bits() % 3; hits > 0 && !piece.empty(); --hits) {
        const std::size_t at = random.bits() % piece.size();
        switch (random.bits() % 5) {
          case 0: piece[at] = static_cast<std::uint8_t>(random.bits()); break;
          case 1: piece.erase(piece.begin() + static_cast<std::ptrdiff_t>(at), piece.end()); break;
          case 2: piece.insert(piece.begin() + static_cast<std::ptrdiff_t>(at), 0xfe); break;
          case 3: piece[at] ^= static_cast<std::uint8_t>(1U << (random.bits() % 8)); break;
          default: piece.insert(piece.end(), piece.begin(), piece.begin() + static_cast<std::ptrdiff_t>(at));
        }
        ++damaged;
      }
      block.insert(block.end(), piece.begin(), piece.end());
    }
    auto from = block.begin();
    const std::span<const std::uint8_t> fresh(block.data() + behind.size(), block.size() - behind.size());
    bool in_order = true;
    for (std::size_t at = 0; at < fresh.size();) {
      const std::size_t n = std::min<std::size_t>(1 + random.bits() % 200, fresh.size() - at);
      parser.feed(fresh.subspan(at, n), [&](const Packet& p) {
        ++packets;
        const Bytes frame = bytes_of(p);
        const auto hit = std::search(from, block.end(), frame.begin(), frame.end());
        in_order = in_order && hit != block.end();
        if (hit != block.end()) from = hit + static_cast<std::ptrdiff_t>(frame.size());
      });
      at += n;
    }
    REQUIRE(in_order);
    fed += fresh.size();
    behind.assign(block.end() - static_cast<std::ptrdiff_t>(max_frame), block.end());
  }
  CHECK(packets > fed / 200);
  CHECK(damaged > fed / 200);
  CHECK(parser.counts().frames == packets);
}

}  // namespace parser_test
