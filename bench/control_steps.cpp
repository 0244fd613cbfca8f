// SPDX-License-Identifier: BSD-3-Clause
#include "bench/control_steps.hpp"

#include <fulmar/testing.hpp>

#include "plugins/control_slc/inner.hpp"
#include "plugins/control_slc/outer.hpp"
#include "plugins/control_tecs/error_law.hpp"
#include "plugins/control_tecs/outer.hpp"
#include "sdk/test/flight/airframe_file.hpp"

namespace {

using namespace fulmar;

VehicleState climbing_turn() {
  VehicleState s;
  s.attitude_valid = s.velocity_valid = s.position_valid = s.height_valid = s.airspeed_valid = true;
  s.roll_rad = 0.35;
  s.pitch_rad = 0.08;
  s.yaw_rad = 1;
  s.course_rad = 1.02;
  s.rate_radps = {-0.01, 0.07, 0.19};
  s.specific_force_mps2 = {0.8, 0.02, -10.4};
  s.height_m = 60;
  s.climb_rate_mps = 0.5;
  s.ground_speed_mps = 18;
  s.airspeed_mps = 16.8;
  s.alpha_rad = 0.06;
  s.beta_rad = 0.01;
  return s;
}

/// `set` gives a bench parameters and inputs, and returns a function that changes an input in every step.
/// With constant inputs a wash-out decays to denormal numbers, which are slow.
template <class Law, class Set>
LawStep of(const std::string& name, Set set) {
  auto bench = std::make_shared<Bench<Law>>();
  auto move = set(*bench);
  bench->step(0.0025);  // sets parameters and inputs, starts the integrals
  return {name, [bench, move] {
            for (int i = 0; i < 1000; ++i) {
              move(*bench, i & 1 ? 0.001 : -0.001);
              bench->tick.now_ns += 2'500'000;
              bench->component().step(bench->tick, bench->in, bench->params, bench->out);
              asm volatile("" ::: "memory");
            }
          }};
}

template <class Law>
LawStep outer(const std::string& name) {
  return of<Law>(name, [](auto& bench) {
    bench.params.common.airframe.value = test::airframe_file("anaconda");
    bench.params.common.airframe.is_given = true;
    bench.set(bench.in.state, climbing_turn());
    bench.set(bench.in.command, GuidanceCommand{.course_rad = 1.1,
                                                .height_m = 61,
                                                .climb_rate_mps = 0.4,
                                                .airspeed_mps = 17,
                                                .roll_feedforward_rad = 0.3});
    return [](auto& b, double by) { const_cast<GuidanceCommand&>(*b.in.command).course_rad = 1.1 + by; };
  });
}

}  // namespace

std::vector<LawStep> law_steps() {
  return {outer<slc::Outer>("control_slc/Outer, the law alone"),
          outer<tecs::Outer>("control_tecs/Outer, the law alone"),
          outer<tecs::ErrorLaw>("control_tecs/ErrorLaw, the law alone"),
          of<slc::Inner>("control_slc/Inner, the law alone", [](auto& bench) {
            bench.params.airframe.value = test::airframe_file("anaconda");
            bench.params.airframe.is_given = true;
            bench.set(bench.in.state, climbing_turn());
            bench.set(bench.in.attitude, AttitudeCommand{0.3, 0.1, 0.6});
            return [](auto& b, double by) {
              const_cast<AttitudeCommand&>(*b.in.attitude).roll_rad = 0.3 + by;
              const_cast<VehicleState&>(*b.in.state).rate_radps.z = 0.19 + by;
            };
          })};
}
