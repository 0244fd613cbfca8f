// SPDX-License-Identifier: BSD-3-Clause
// The tables generated from a struct, against the compiler (offsetof, sizeof) and against expected names.
#include "fulmar/schema.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstddef>
#include <random>
#include <string>

#include "fulmar/eigen.hpp"
#include "fulmar/msg/actuators.hpp"
#include "fulmar/msg/airframe.hpp"
#include "fulmar/msg/attitude_command.hpp"
#include "fulmar/msg/gnss.hpp"
#include "fulmar/msg/path.hpp"
#include "fulmar/msg/plan.hpp"
#include "fulmar/msg/vehicle_state.hpp"

namespace schema_test {

using namespace fulmar;

namespace {

enum class Colour : std::uint8_t { red, green, blue };

struct Sample {
  bool on = false;
  std::uint8_t small = 0;
  Colour colour = Colour::red;
  float short_m = 0;
  std::int64_t stamp_ns = 0;
  std::array<double, 3> gains_ratio{};
  Text<16> name;
  List<Vec3<Ned>, 4> points_m;
  Quat attitude;
  double share_frac = 0;
};

const fulmar_field& field(const fulmar_type& type, const std::string& name) {
  for (std::uint32_t i = 0; i < type.field_count; ++i)
    if (type.fields[i].name == name) return type.fields[i];
  FAIL("no field " << name);
  return type.fields[0];
}

struct ForeignPose {
  static constexpr const char* ros_type = "geometry_msgs/msg/Point";
  double x = 0, y = 0, z = 0;
};

}  // namespace

TEST_CASE("what a record has to say is marked in its table") {
  const fulmar_type& airframe = describe<Airframe>();
  const auto required = [](const fulmar_type& type, const char* name) {
    return (field(type, name).flags & FULMAR_FIELD_REQUIRED) != 0;
  };
  CHECK(required(airframe, "mass_kg"));
  CHECK(required(airframe, "wing"));
  CHECK(required(*field(airframe, "wing").type, "span_m"));
  CHECK_FALSE(required(*field(airframe, "wing").type, "oswald_ratio"));
  CHECK_FALSE(required(airframe, "gear"));
  CHECK(field(airframe, "mass_kg").min > 0);
}

TEST_CASE("offsets follow the compiler") {
  const fulmar_type& t = describe<Sample>();
  CHECK(t.size == sizeof(Sample));
  CHECK(t.align == alignof(Sample));
  REQUIRE(t.field_count == 10);
  CHECK(field(t, "on").offset == offsetof(Sample, on));
  CHECK(field(t, "small").offset == offsetof(Sample, small));
  CHECK(field(t, "colour").offset == offsetof(Sample, colour));
  CHECK(field(t, "short_m").offset == offsetof(Sample, short_m));
  CHECK(field(t, "stamp_ns").offset == offsetof(Sample, stamp_ns));
  CHECK(field(t, "gains_ratio").offset == offsetof(Sample, gains_ratio));
  CHECK(field(t, "name").offset == offsetof(Sample, name));
  CHECK(field(t, "points_m").offset == offsetof(Sample, points_m));
  CHECK(field(t, "attitude").offset == offsetof(Sample, attitude));
  CHECK(field(t, "share_frac").offset == offsetof(Sample, share_frac));
}

TEST_CASE("kinds, shapes, counts and units are read from the members") {
  const fulmar_type& t = describe<Sample>();
  CHECK(std::string(t.name) == "Sample");
  CHECK(field(t, "on").kind == FULMAR_BOOL);
  CHECK(field(t, "colour").kind == FULMAR_ENUM);
  CHECK(field(t, "short_m").kind == FULMAR_F32);
  CHECK(std::string(field(t, "short_m").unit) == "m");
  CHECK(std::string(field(t, "stamp_ns").unit) == "ns");
  CHECK(field(t, "gains_ratio").shape == FULMAR_ARRAY);
  CHECK(field(t, "gains_ratio").count == 3);
  CHECK(field(t, "name").kind == FULMAR_TEXT);
  CHECK(field(t, "name").stride == 16);
  const fulmar_field& points = field(t, "points_m");
  CHECK(points.shape == FULMAR_LIST);
  CHECK(points.count == 4);
  CHECK(points.items == offsetof(decltype(Sample::points_m), items));
  CHECK(points.stride == sizeof(Vec3<Ned>));
  CHECK(std::string(points.type->frame) == "ned");
  CHECK(std::string(points.type->fields[2].name) == "down");
  CHECK(std::string(field(t, "attitude").type->frame) == "body to ned");
}

TEST_CASE("enum labels come in order") {
  const fulmar_field& colour = field(describe<Sample>(), "colour");
  REQUIRE(colour.label_count == 3);
  CHECK(std::string(colour.labels[0]) == "red");
  CHECK(std::string(colour.labels[2]) == "blue");
  CHECK(field(describe<Gnss>(), "fix").label_count == 8);
}

TEST_CASE("a fraction is bounded, another number is not") {
  CHECK(field(describe<Sample>(), "share_frac").min == -1.0);
  CHECK(field(describe<Sample>(), "share_frac").max == 1.0);
  CHECK(field(describe<Sample>(), "short_m").max == std::numeric_limits<double>::infinity());
}

TEST_CASE("the largest shipped messages describe themselves") {
  CHECK(describe<VehicleState>().size == sizeof(VehicleState));
  CHECK(field(describe<VehicleState>(), "accel_bias_mps2").offset == offsetof(VehicleState, accel_bias_mps2));
  CHECK(field(describe<VehicleState>(), "wind_valid").offset == offsetof(VehicleState, wind_valid));
  CHECK(field(describe<Plan>(), "waypoints").count == 1024);
  CHECK(field(describe<Airframe>(), "gear").offset == offsetof(Airframe, gear));
  CHECK(field(describe<Path>(), "next_curvature_ratio").offset == offsetof(Path, next_curvature_ratio));
}

TEST_CASE("a foreign message is exempt from units and names its ROS type") {
  CHECK(std::string(describe<ForeignPose>().ros) == "geometry_msgs/msg/Point");
  CHECK(std::string(describe<ForeignPose>().fields[0].unit).empty());
}

TEST_CASE("a vector goes to Eigen and back, and rotates as the attitude says") {
  const Vec3<Ned> v{1, 2, 3};
  CHECK(from_eigen<Ned>(eigen(v)) == v);
  const double h = std::sqrt(0.5);
  const Quat east_facing{h, 0, 0, h};  // yaw 90 deg: the body's x axis points east
  const Vec3<Ned> nose = to_ned(east_facing, Vec3<Body>{1, 0, 0});
  CHECK(nose.north == doctest::Approx(0));
  CHECK(nose.east == doctest::Approx(1));
  CHECK(to_body(east_facing, nose).x == doctest::Approx(1));
}

TEST_CASE("sums, multiples and rotations are those of Eigen, to the last bit") {
  std::mt19937_64 random(11);
  std::normal_distribution<double> normal;
  const auto n = [&] { return normal(random); };
  for (int i = 0; i < 10'000; ++i) {
    const Vec3<Ned> a{n(), n(), n()}, b{n(), n(), n()};
    const Vec3<Body> v{n(), n(), n()};
    const Quat q{n(), n(), n(), n()};
    const double k = n();
    REQUIRE(a + b == from_eigen<Ned>(eigen(a) + eigen(b)));
    REQUIRE(a - b == from_eigen<Ned>(eigen(a) - eigen(b)));
    REQUIRE(k * v == from_eigen<Body>(k * eigen(v)));
    REQUIRE(to_ned(q, v) == from_eigen<Ned>(eigen(q) * eigen(v)));
    REQUIRE(to_body(q, a) == from_eigen<Body>(eigen(q).conjugate() * eigen(a)));
    REQUIRE(from_eigen(eigen(q)) == q);
  }
}

namespace {

enum class Many : std::uint8_t { a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, the_eighteenth };
enum class Gap : std::uint8_t { first, second, fourth = 3 };
template <class T, int n>
struct Pair {
  T one{}, two{};
};
struct Widest {
  double a0_m, a1_m, a2_m, a3_m, a4_m, a5_m, a6_m, a7_m, a8_m, a9_m, b0_m, b1_m, b2_m, b3_m, b4_m, b5_m, b6_m,
      b7_m, b8_m, b9_m, c0_m, c1_m, c2_m, c3_m, c4_m, c5_m, c6_m, c7_m, c8_m, c9_m, d0_m, d1_m, d2_m, d3_m,
      d4_m, d5_m, d6_m, d7_m, d8_m, d9_m, e0_m, e1_m, e2_m, e3_m, e4_m, e5_m, e6_m, e7_m, e8_m, e9_m, f0_m,
      f1_m, f2_m, f3_m, f4_m, f5_m, f6_m, f7_m, f8_m, f9_m, g0_m, g1_m, g2_m;
  bool last;
};
struct Nested {
  Pair<std::array<List<Quat, 2>, 3>, 4> not_a_message;  // members are counted and named for any type
  Text<2> t;
  Gap gap;
};

}  // namespace

TEST_CASE("members are counted and named from none to 64") {
  struct None {};
  CHECK(detail::member_count<None>() == 0);
  CHECK(detail::member_count<ForeignPose>() == 3);
  CHECK(detail::member_count<Nested>() == 3);
  CHECK(detail::FieldNames<Nested>::view(0) == "not_a_message");
  CHECK(detail::FieldNames<Nested>::view(2) == "gap");
  CHECK(detail::member_count<Widest>() == 64);
  CHECK(field(describe<Widest>(), "g2_m").offset == offsetof(Widest, g2_m));
  CHECK(field(describe<Widest>(), "last").offset == offsetof(Widest, last));
  CHECK(std::string(describe<Widest>().fields[31].name) == "d1_m");
}

TEST_CASE("an enum's labels end where a number names nothing, however many there are") {
  CHECK(detail::Labels<Many>::count == 18);
  CHECK(std::string(detail::Labels<Many>::names[17]) == "the_eighteenth");
  CHECK(detail::Labels<Gap>::count == 2);
}

TEST_CASE("text is cut where its room ends") {
  const Text<4> t("abcdef");
  CHECK(t.view() == "abc");
  CHECK(Text<8>("ab") == Text<8>("ab"));
}

TEST_CASE("a list refuses what it has no room for") {
  List<int, 2> list;
  CHECK(list.push_back(1));
  CHECK(list.push_back(2));
  CHECK_FALSE(list.push_back(3));
  CHECK(list.size() == 2);
}

}  // namespace schema_test

TEST_CASE("angles that an aircraft is to take or its surfaces to have are no degrees") {
  const auto check = [](const fulmar_type& type, std::string_view name, double most) {
    CAPTURE(name);
    for (std::uint32_t i = 0; i < type.field_count; ++i)
      if (name == type.fields[i].name) {
        CHECK(type.fields[i].max == doctest::Approx(most).epsilon(1e-12));
        CHECK(type.fields[i].min == doctest::Approx(-most).epsilon(1e-12));
        return;
      }
    FAIL("there is no such field");
  };
  for (const char* const surface : {"aileron_rad", "elevator_rad", "rudder_rad"})
    check(fulmar::describe<fulmar::Actuators>(), surface, 1.5707963267948966);
  check(fulmar::describe<fulmar::AttitudeCommand>(), "roll_rad", 3.141592653589793);
  check(fulmar::describe<fulmar::AttitudeCommand>(), "pitch_rad", 1.5707963267948966);
  check(fulmar::describe<fulmar::Actuators>(), "throttle_frac", 1);
}
