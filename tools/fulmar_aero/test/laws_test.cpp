// SPDX-License-Identifier: BSD-3-Clause
// The linear laws against the shipped components, which are excited by small sines: the components are the
// other implementation. Names, defaults and ranges against their tables.
#include "tools/fulmar_aero/laws.hpp"

#include <doctest/doctest.h>

#include <fulmar/testing.hpp>
#include <functional>
#include <numbers>

#include "plugins/control_slc/inner.hpp"
#include "plugins/control_slc/outer.hpp"
#include "plugins/control_tecs/outer.hpp"
#include "tools/fulmar_aero/airframe_file.hpp"
#include "tools/fulmar_aero/loops.hpp"

namespace laws_test {

using namespace fulmar;
using namespace fulmar::aero;

namespace {
constexpr double T = 0.01;

/// Away from cruise, where every gain is scaled; and at a heading across the jump of angles.
struct Place {
  Airframe airframe;
  VehicleState state;
  GuidanceCommand command;
  AttitudeCommand attitude;
  LawPoint at;

  explicit Place(const char* name, double speed_ratio) {
    airframe = read_airframe_file(std::string(FULMAR_SOURCE_DIR "/configs/airframes/") + name).airframe;
    const double Va = speed_ratio * airframe.limits.airspeed_cruise_mps;
    state.height_m = 70;
    state.airspeed_mps = state.ground_speed_mps = Va;
    state.airspeed_valid = state.attitude_valid = state.velocity_valid = state.height_valid = true;
    state.course_rad = std::numbers::pi;
    state.pitch_rad = 0.03;
    command = {.course_rad = std::numbers::pi, .height_m = 70, .climb_rate_mps = 0, .airspeed_mps = Va};
    attitude = {0, state.pitch_rad, 0.5};
    at = {&airframe, Va, standard_air(70).density_kgm3, state.pitch_rad, T};
  }
  /// `x`: what is added to one sensor, course and height commands as they are.
  VehicleState measured(int which, double x, double acceleration = 0) const {
    VehicleState s = state;
    if (which == sensor::roll) s.roll_rad += x;
    if (which == sensor::pitch) s.pitch_rad += x;
    if (which == sensor::p) s.rate_radps.x += x;
    if (which == sensor::q) s.rate_radps.y += x;
    if (which == sensor::r) s.rate_radps.z += x;
    if (which == sensor::course) s.course_rad = angle_difference(s.course_rad + x, 0);
    if (which == sensor::height) s.height_m += x;
    if (which == sensor::climb) s.climb_rate_mps += x;
    if (which == sensor::airspeed) s.airspeed_mps += x;
    if (which == sensor::acceleration) acceleration += x;
    if (which == sensor::sideslip) s.beta_rad += x;
    // along the airflow, alpha 0: gravity taken off
    s.specific_force_mps2 = {acceleration + isa::g0 * std::sin(s.pitch_rad), 0,
                             -isa::g0 * std::cos(s.pitch_rad)};
    return s;
  }
};

template <int N>
using Answers = std::array<double, N>;
/// What a sine of that period in steps makes of N outputs, as complex gains. `step(x)` is one step.
template <int N>
std::array<Complex, N> answer(const std::function<Answers<N>(double)>& step, double amplitude, int period) {
  const double turn = 2 * std::numbers::pi / period;
  const int settle = 20 * period > 4000 ? 20 * period : (4000 / period + 1) * period;
  std::array<Complex, N> sum{};
  for (int k = 0; k < settle + 2 * period; ++k) {
    const Answers<N> y = step(amplitude * std::sin(turn * k));
    if (k < settle) continue;
    for (std::size_t i = 0; i < N; ++i) sum[i] += y[i] * std::exp(Complex(0, -turn * k));
  }
  for (Complex& one : sum) one *= Complex(0, 1) / (amplitude * period);
  return sum;
}

/// Within 2 % of what it is; where it is to be nothing, within `nothing`.
void check_gain(Complex found, Complex expected, double nothing) {
  CAPTURE(found);
  CAPTURE(expected);
  CHECK(std::abs(found - expected) <= 0.02 * std::abs(expected) + nothing);
}

template <class Law, class P>
void check_table(const Law& law) {
  const auto& table = fulmar::detail::ParamTable<P>::table;
  const auto& all = parameters_of(law);
  CHECK(all.size() == table.size());
  for (const fulmar_param& p : table) {
    CAPTURE(p.name);
    const auto one =
        std::find_if(all.begin(), all.end(), [&](const auto& n) { return std::string(n.name) == p.name; });
    REQUIRE(one != all.end());
    if (!one->number) continue;
    const Number& n = law.*one->number;
    CHECK(n.value == p.initial[0]);
    CHECK(n.min == p.min);
    CHECK(n.max == p.max);
    CHECK(std::string(n.unit) == p.unit);
  }
}
constexpr std::array<int, 2> periods{64, 500};  // 9.8 and 1.26 rad/s

/// An outer law's commands for each sensor and goal.
template <class Component>
void check_outer(const Place& place, OuterResponse (*linear)(const LawPoint&, Complex),
                 const std::function<void(typename Component::Params&)>& set) {
  for (const int period : periods) {
    const Complex z = std::exp(Complex(0, 2 * std::numbers::pi / period));
    const OuterResponse expected = linear(place.at, z);
    for (int input = 0; input < sensor::count + goal::count; ++input)
      for (const double sign : {1.0, -1.0}) {
        Bench<Component> bench;
        set(bench.params);
        bench.params.common.airframe.value = place.airframe;
        const int which = input < sensor::count ? input : -1, asked = input - sensor::count;
        const auto step = [&](double x) {
          GuidanceCommand command = place.command;
          if (asked == goal::course) command.course_rad = angle_difference(command.course_rad + x, 0);
          if (asked == goal::height) command.height_m += x;
          if (asked == goal::airspeed) command.airspeed_mps += x;
          bench.set(bench.in.state, place.measured(which, x));
          bench.set(bench.in.command, command);
          bench.step(T);
          const AttitudeCommand& a = bench.out.attitude;
          return Answers<3>{a.roll_rad, a.pitch_rad, a.throttle_frac};
        };
        const auto found = answer<3>(step, 1e-3 * sign, period);
        for (int i = 0; i < command::count; ++i) {
          CAPTURE(input);
          CAPTURE(i);
          CAPTURE(period);
          check_gain(found[std::size_t(i)],
                     which >= 0 ? expected.of_sensors(i, which) : expected.of_goals(i, asked), 1e-4);
        }
      }
  }
}
}  // namespace

TEST_CASE("names, defaults, units and ranges are those of the components") {
  check_table<InnerLaw, slc::Inner::Params>({});
  check_table<SlcLaw, slc::Outer::Params>({});
  check_table<TecsLaw, tecs::Outer::Params>({});
}

TEST_CASE("control_slc/Inner answers small sines of every sensor and command as its linear law" *
          doctest::test_suite("amounts")) {
  InnerLaw law;
  law.roll_from_sideslip.value = 0.3;
  for (const double speed : {0.85, 1.2}) {
    const Place place("anaconda.yaml", speed);
    for (const int period : periods) {
      const InnerResponse expected =
          response(law, place.at, std::exp(Complex(0, 2 * std::numbers::pi / period)));
      for (int input = 0; input < sensor::count + command::count; ++input)
        for (const double sign : {1.0, -1.0}) {
          Bench<slc::Inner> bench;
          bench.params.airframe.value = place.airframe;
          bench.params.roll_from_sideslip.value = law.roll_from_sideslip;
          const int which = input < sensor::count ? input : -1, asked = input - sensor::count;
          const auto step = [&](double x) {
            AttitudeCommand a = place.attitude;
            if (asked == command::roll) a.roll_rad += x;
            if (asked == command::pitch) a.pitch_rad += x;
            if (asked == command::throttle) a.throttle_frac += x;
            bench.set(bench.in.state, place.measured(which, x));
            bench.set(bench.in.attitude, a);
            bench.step(T);
            const Actuators& u = bench.out.actuators;
            return Answers<4>{u.aileron_rad, u.elevator_rad, u.rudder_rad, u.throttle_frac};
          };
          const auto found = answer<4>(step, 1e-3 * sign, period);
          for (int i = 0; i < model::inputs; ++i) {
            CAPTURE(input);
            CAPTURE(i);
            check_gain(found[std::size_t(i)],
                       which >= 0 ? expected.of_sensors(i, which) : expected.of_commands(i, asked), 1e-4);
          }
        }
    }
  }
}

TEST_CASE("without a rudder nothing is damped with it") {
  const Place place("x8.yaml", 1.1);
  const InnerResponse linear = response(InnerLaw{}, place.at, std::exp(Complex(0, 0.1)));
  CHECK(linear.of_sensors.row(model::rudder).norm() == 0);
}

TEST_CASE("control_slc/Outer answers small sines of every sensor and goal as its linear law" *
          doctest::test_suite("amounts")) {
  check_outer<slc::Outer>(
      Place("anaconda.yaml", 1.2),
      [](const LawPoint& at, Complex z) -> OuterResponse { return response(SlcLaw{}, at, z); },
      [](slc::Outer::Params&) {});
}

TEST_CASE("control_tecs/Outer does, with both weights" * doctest::test_suite("amounts")) {
  for (const double weight : {0.4, 1.6}) {
    static double shared;
    shared = weight;
    check_outer<tecs::Outer>(
        Place("anaconda.yaml", 1.2),
        [](const LawPoint& at, Complex z) -> OuterResponse {
          TecsLaw law;
          law.speed_weight.value = shared;
          return response(law, at, z);
        },
        [](tecs::Outer::Params& p) { p.speed_weight.value = shared; });
  }
}

}  // namespace laws_test
