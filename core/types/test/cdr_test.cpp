// SPDX-License-Identifier: BSD-3-Clause
// Expected bytes are written by hand from the XCDR1 rules; random types are checked against a second, simple
// encoder.
#include <doctest/doctest.h>

#include <cstring>
#include <functional>
#include <nlohmann/json.hpp>
#include <random>

#include "core/error.hpp"
#include "core/types/test/types.hpp"
#include "core/types/wire.hpp"

namespace cdr_test {

using namespace fulmar::core;
using namespace fulmar::core::test;

namespace {

using Blob = std::vector<std::byte>;

/// "01 02 | 03": hex digits; other characters are for readability.
Blob hex(const std::string& text) {
  Blob bytes;
  std::string digits;
  for (const char c : text) {
    if (std::isxdigit(static_cast<unsigned char>(c))) digits += c;
    if (digits.size() == 2) {
      bytes.push_back(static_cast<std::byte>(std::stoi(digits, nullptr, 16)));
      digits.clear();
    }
  }
  return bytes;
}

Blob encoded(const Type& type, const std::byte* data) {
  Blob out;
  CdrEncoder(type).encode(data, out);
  return out;
}

const std::string one = "00000000 0000F03F ", two = "00000000 00000040 ", half = "00000000 0000E03F ";

}  // namespace

TEST_CASE("a message of every kind has the bytes of XCDR1") {
  Mixed m;
  std::memset(&m, 0xAA, sizeof m);  // padding of the struct must not reach the wire
  const Mixed value = mixed_value();
  m.armed = value.armed;
  m.speed_mps = value.speed_mps;
  m.count = value.count;
  m.gains_ratio = value.gains_ratio;
  m.name = value.name;
  m.samples_volt.count = 2;
  m.samples_volt.items = value.samples_volt.items;
  m.mode = value.mode;
  m.stamp_ns = value.stamp_ns;
  m.load_ratio = value.load_ratio;
  m.offset = value.offset;
  m.attitude_std_rad = value.attitude_std_rad;
  m.tags = value.tags;
  m.legs.count = 2;
  for (std::size_t i = 0; i < 2; ++i) {
    Leg& leg = m.legs.items[i];
    leg.kind = value.legs.items[i].kind;
    leg.has_course = value.legs.items[i].has_course;
    leg.course_rad = value.legs.items[i].course_rad;
    leg.position_m = value.legs.items[i].position_m;
  }
  const Blob expected =
      hex("00010000"             // CDR_LE
          "01 00000000000000"    // 0: bool, then up to 8
          "00000000 0000F83F"    // 8: 1.5
          "07000000 00000000" +  // 16: 7, then up to 24
          one +
          two +
          "00000000 000000C0"    // 24: 1, 2, -2
          "03000000 616200 00"   // 48: "ab" and NUL, up to 56
          "02000000 00000000" +  // 56: two doubles, up to 64
          half +
          one +                  // 64
          "01 00000000000000"    // 80: enum, up to 88
          "FEFFFFFF FFFFFFFF"    // 88: -2
          "0000803E FDFFFFFF" +  // 96: 0.25f, -3
          half +
          one + two +              // 104: the nested vector
          "02000000 7800 0000"     // 128: "x", up to 136
          "04000000 797A7700"      // 136: "yzw"
          "02000000 01 01 0000" +  // 144: two legs; enum, bool, up to 152
          half +
          "00000000 00000840 00000000 00001040 00000000 00001440"  // 152: 0.5; 3, 4, 5
          "00 00 000000000000"                                     // 184: enum, bool, up to 192
          "00000000 0000E0BF 00000000 00001840 00000000 00001C40 00000000 00002040");
  CHECK(encoded(*mixed_type(), bytes_of(m)) == expected);
}

TEST_CASE("after an empty sequence nothing is aligned for the missing elements") {
  struct S {
    Items<double, 2> list;
    bool tail;
  };
  const TypePtr type = make_type(
      "S", sizeof(S), 8, {list(number("list", 0), 2, 8), scalar("tail", FULMAR_BOOL, offsetof(S, tail), 1)});
  const S s{{0, {9, 9}}, true};
  CHECK(encoded(*type, bytes_of(s)) == hex("00010000 00000000 01"));
}

TEST_CASE("a list whose count exceeds its capacity is clamped") {
  struct S {
    Items<std::uint8_t, 2> list;
  };
  const TypePtr type = make_type("S", sizeof(S), 4, {list(scalar("list", FULMAR_U8, 0, 1), 2, 4)});
  const S s{{77, {5, 6}}};
  CHECK(encoded(*type, bytes_of(s)) == hex("00010000 02000000 0506"));
}

TEST_CASE(
    "text that fills its room ends in NUL on the wire, empty text is one NUL, an empty struct one byte") {
  struct S {
    std::array<char, 3> full, empty;
    char nothing;
  };
  const TypePtr none = make_type("Nothing", 1, 1, {});
  const TypePtr type = make_type(
      "S", sizeof(S), 1,
      {scalar("full", FULMAR_TEXT, 0, 3), scalar("empty", FULMAR_TEXT, 3, 3), nested("nothing", none, 6)});
  const S s{{'a', 'b', 'c'}, {}, 'x'};
  CHECK(encoded(*type, bytes_of(s)) == hex("00010000 04000000 61626300 01000000 00 00"));
}

TEST_CASE("a decoded message equals the encoded one") {
  const TypePtr type = mixed_type();
  const Mixed before = mixed_value();
  const Blob bytes = encoded(*type, bytes_of(before));
  Mixed after;
  std::memset(&after, 0x55, sizeof after);
  cdr_decode(*type, bytes.data(), bytes.size(), bytes_of(after));
  CHECK(to_json(*type, bytes_of(after), false) == to_json(*type, bytes_of(before), false));
  CHECK(after.legs.items[2].position_m.down == 0);  // fields without bytes are zero
}

TEST_CASE("bytes that are truncated, too many, or not CDR are rejected") {
  const TypePtr type = mixed_type();
  const Mixed m = mixed_value();
  Blob bytes = encoded(*type, bytes_of(m));
  Mixed out;
  for (std::size_t n = 0; n < bytes.size(); ++n)
    CHECK_THROWS_AS(cdr_decode(*type, bytes.data(), n, bytes_of(out)), Error);
  Blob longer = bytes;
  longer.resize(bytes.size() + 4);
  CHECK_THROWS_AS(cdr_decode(*type, longer.data(), longer.size(), bytes_of(out)), Error);
  Blob many = bytes;
  many[4 + 56] = std::byte{5};  // five samples in a list for four
  CHECK_THROWS_WITH_AS(cdr_decode(*type, many.data(), many.size(), bytes_of(out)),
                       "types.bytes_invalid(Mixed, types.too_many_items(samples_volt, 5, 4))", Error);
  bytes[1] = std::byte{0};  // big endian
  CHECK_THROWS_AS(cdr_decode(*type, bytes.data(), bytes.size(), bytes_of(out)), Error);
}

namespace {

/// A second encoder, by the specification: element after element, without merging.
struct Plain {
  Blob out;
  void align(std::size_t a) {
    while (out.size() % a != 0) out.push_back(std::byte{0});
  }
  void raw(const std::byte* from, std::size_t n) {
    align(n);
    out.insert(out.end(), from, from + n);
  }
  void element(const Field& f, const std::byte* at) {
    switch (f.kind) {
      case FULMAR_STRUCT: return type(*f.type, at);
      case FULMAR_TEXT: {
        const auto n = static_cast<std::uint32_t>(::strnlen(reinterpret_cast<const char*>(at), f.stride));
        const std::uint32_t length = n + 1;
        raw(bytes_of(length), 4);
        out.insert(out.end(), at, at + n);
        out.push_back(std::byte{0});
        return;
      }
      default: return raw(at, f.stride);
    }
  }
  void type(const Type& t, const std::byte* data) {
    if (t.fields.empty()) out.push_back(std::byte{0});
    for (const Field& f : t.fields) {
      std::uint32_t n = f.count;
      const std::byte* first = data + f.offset;
      if (f.shape == FULMAR_LIST) {
        std::memcpy(&n, first, 4);
        raw(first, 4);
        first += f.items;
      }
      for (std::uint32_t i = 0; i < n; ++i) element(f, first + i * f.stride);
    }
  }
};

/// Random structs, with the layout of a C++ compiler.
struct Maker {
  std::mt19937 random{4711};
  std::uint32_t below(std::uint32_t n) { return static_cast<std::uint32_t>(random() % n); }

  TypePtr type(int depth) {
    std::vector<Field> fields;
    std::uint32_t end = 0, align = 1;
    for (std::uint32_t i = 0, n = below(7); i < n; ++i) {
      Field f = scalar("f" + std::to_string(i), FULMAR_F64, 0, 8);
      std::uint32_t a = element(f, depth);
      f.shape = static_cast<fulmar_shape>(below(3));
      if (f.shape != FULMAR_SCALAR) f.count = 1 + below(12);
      std::uint32_t size = f.count * f.stride;
      if (f.shape == FULMAR_LIST) {
        f.items = std::max(4u, a);
        size += f.items;
        a = std::max(4u, a);
        size = (size + a - 1) / a * a;
      }
      f.offset = (end + a - 1) / a * a;
      end = f.offset + size;
      align = std::max(align, a);
      fields.push_back(f);
    }
    return make_type("Random", std::max(1u, (end + align - 1) / align * align), align, fields);
  }

  /// Fills in kind, stride and type; returns the alignment.
  std::uint32_t element(Field& f, int depth) {
    const std::array kinds{FULMAR_BOOL, FULMAR_U8,  FULMAR_I32,  FULMAR_U32,  FULMAR_I64,   FULMAR_U64,
                           FULMAR_F32,  FULMAR_F64, FULMAR_ENUM, FULMAR_TEXT, FULMAR_STRUCT};
    f.kind = kinds[below(depth > 0 ? 11 : 10)];
    if (f.kind == FULMAR_TEXT) {
      f.stride = 1 + below(6);
      return 1;
    }
    if (f.kind == FULMAR_STRUCT) {
      f.type = type(depth - 1);
      f.stride = f.type->size;
      return f.type->align;
    }
    const std::array<std::uint32_t, 9> sizes{1, 1, 4, 4, 8, 8, 4, 8, 1};
    return f.stride = sizes[static_cast<std::size_t>(f.kind - 1)];
  }

  /// Counts within the capacities, all other bytes random, unused ones included.
  void fill(const Type& t, std::byte* data) {
    for (std::uint32_t i = 0; i < t.size; ++i) data[i] = static_cast<std::byte>(random());
    counts(t, data);
  }
  void counts(const Type& t, std::byte* data) {
    for (const Field& f : t.fields) {
      if (f.shape == FULMAR_LIST) {
        const std::uint32_t n = below(f.count + 1);
        std::memcpy(data + f.offset, &n, 4);
      }
      if (f.kind != FULMAR_STRUCT) continue;
      for (std::uint32_t i = 0; i < f.count; ++i) counts(*f.type, data + f.offset + f.items + i * f.stride);
    }
  }
};

}  // namespace

TEST_CASE(
    "the compiled encoder agrees with an encoder that does nothing clever, and the decoder undoes it, for "
    "random types") {
  Maker maker;
  std::size_t with_bytes = 0;
  for (int i = 0; i < 2000; ++i) {
    const TypePtr type = maker.type(2);
    Blob data(type->size);
    maker.fill(*type, data.data());
    Plain plain;
    plain.type(*type, data.data());
    Blob expected = hex("00010000");
    expected.insert(expected.end(), plain.out.begin(), plain.out.end());
    const Blob bytes = encoded(*type, data.data());
    REQUIRE(bytes == expected);
    REQUIRE(bytes.size() <= CdrEncoder(*type).max_size());
    with_bytes += bytes.size() > 100;

    bool text_fits = true;  // a text that fills its room has no NUL in the struct
    const std::function<void(const Type&)> look = [&](const Type& t) {
      for (const Field& f : t.fields) {
        text_fits = text_fits && f.kind != FULMAR_TEXT;
        if (f.kind == FULMAR_STRUCT) look(*f.type);
      }
    };
    look(*type);
    if (!text_fits) continue;
    Blob decoded(type->size);
    cdr_decode(*type, bytes.data(), bytes.size(), decoded.data());
    REQUIRE(encoded(*type, decoded.data()) == bytes);
  }
  CHECK(with_bytes > 500);  // the types were not all trivial
}

}  // namespace cdr_test
