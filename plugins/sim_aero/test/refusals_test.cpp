// SPDX-License-Identifier: BSD-3-Clause
// Aircraft that do not fly, motions that are no flight, and gusts as parameters: through the vehicle.
#include "plugins/sim_aero/refusals.hpp"

#include <doctest/doctest.h>

#include <limits>
#include <memory>
#include <vector>

#include "fly.hpp"

namespace refusals_test {

using namespace fulmar;
using namespace fulmar::sim;
using doctest::Approx;

namespace {

const Actuators cruise{0.57, 0.0041, 0.1212, 0};

std::unique_ptr<Bench<Aircraft>> bench(double start_height) {
  auto b = std::make_unique<Bench<Aircraft>>(1);
  b->params.airframe.value = anaconda();
  b->params.start.start_height.value = start_height;
  b->params.sensors.value = SensorSet::perfect;
  return b;
}

template <class Change>
std::string refusal(double start_height, Change&& change) {
  auto b = bench(start_height);
  change(b->params);
  if (b->configure() != Status::failed) return "flies";
  return std::string(b->error());
}
template <class Change>
std::string refused_airframe(Change&& change) {
  const std::string on_ground = refusal(0, [&](Aircraft::Params& p) { change(p.airframe.value); });
  CHECK(on_ground == refusal(0.5, [&](Aircraft::Params& p) { change(p.airframe.value); }));
  return on_ground;
}

/// Body z of the air's velocity in each tick of `seconds` from flight time 0 on.
std::vector<double> gusts(Bench<Aircraft>& b, double seconds, double now_at = -1) {
  std::vector<double> seen;
  arm(b);
  while (b.tick.now_ns < std::llround(1e9 * seconds)) {
    if (now_at >= 0 && b.tick.now_ns >= std::llround(1e9 * now_at) && !b.params.around.air.gust_now.value) {
      b.params.around.air.gust_now.value = true;
      b.retune();
    }
    pass(b, &cruise);
    const Plant& p = b.component().plant();
    if (b.tick.now_ns > 0) seen.push_back((p.state().q_nb.conjugate() * p.wind_n()).z());
  }
  return seen;
}
/// Times at which a gust begins, s.
std::vector<double> begins(const std::vector<double>& z) {
  std::vector<double> out;
  for (std::size_t i = 0; i < z.size(); ++i)
    if (std::abs(z[i]) > 1e-12 && (i == 0 || std::abs(z[i - 1]) <= 1e-12))
      out.push_back(0.0025 * static_cast<double>(i));
  return out;
}

}  // namespace

TEST_CASE("an aircraft that cannot trim is refused with the parameter and the reason, in the air or not") {
  CHECK(refused_airframe([](Airframe&) {}) == "flies");
  // 45 kg on 0.52 m2 at 17 m/s: CL is 441.3 N / (q S)
  const std::string heavy = refused_airframe([](Airframe& a) { a.mass_kg = 45; });
  CHECK(heavy.find("airframe.limits.airspeed_cruise: sim_aero.level_flight_impossible(17, ") == 0);
  CHECK(heavy.find(", sim_aero.wing_stalls(5.") != std::string::npos);
  const std::string elevator = refused_airframe([](Airframe& a) { a.elevator.limit_rad = 0.02; });
  CHECK(elevator.find("airframe.elevator.limit: sim_aero.surface_too_small(") == 0);
  CHECK(elevator.find(", elevator, 1.15 deg)") != std::string::npos);
  CHECK(refused_airframe([](Airframe& a) { a.propulsion.battery_volt = 4; }).find("airframe.propulsion: ") ==
        0);
  CHECK(refused_airframe([](Airframe& a) {
          a.limits.airspeed_cruise_mps = 40;
        }).find("sim_aero.thrust_too_small") != std::string::npos);
  CHECK(refused_airframe([](Airframe& a) {
          a.aero.pitch.elevator_ratio = 0;
        }).find("airframe.aero.pitch: ") == 0);
  CHECK(refused_airframe([](Airframe& a) { a.aero.roll = {}; }).find("airframe.aero.roll: ") == 0);
  CHECK(refusal(70, [](Aircraft::Params& p) {
          p.start.start_airspeed.value = 6;
        }).find("start_airspeed: sim_aero.level_flight_impossible(6, ") == 0);
  CHECK(refusal(0, [](Aircraft::Params& p) { p.start.start_airspeed.value = 6; }) ==
        "flies");  // of no start there
}

TEST_CASE("an inertia that is not positive definite is refused, just inside it flies") {
  const double most = std::sqrt(anaconda().inertia.xx_kgm2 * anaconda().inertia.zz_kgm2);
  for (const double sign : {1.0, -1.0}) {
    const auto with = [&](double part) {
      return refused_airframe([&](Airframe& a) { a.inertia.xz_kgm2 = sign * part * most; });
    };
    CHECK(with(1.001).find("airframe.inertia.xz: sim_aero.inertia_not_definite(") == 0);
    CHECK(with(1).find("airframe.inertia.xz: ") == 0);
    CHECK(with(0.5) == "flies");
  }
  CHECK(refused_airframe([](Airframe& a) {
          a.inertia.xz_kgm2 = std::numeric_limits<double>::quiet_NaN();
        }).find("airframe.inertia.xz") == 0);
}

TEST_CASE("a slope is no ground of the ellipsoid, and no aircraft starts inside it") {
  const auto slope = [](EarthModel earth, double north) {
    return [=](Aircraft::Params& p) {
      p.earth.value = earth;
      p.around.ground.ground_slope.value = 0.2;
      p.start.start_north.value = north;
    };
  };
  CHECK(refusal(50, slope(EarthModel::wgs84, 0)).find("ground_slope: sim_aero.ground_slope_unsupported") ==
        0);
  CHECK(refusal(50, slope(EarthModel::flat, 0)) == "flies");
  CHECK(refusal(50, slope(EarthModel::gravity, 200)) == "flies");  // 40.5 m high there
  CHECK(refusal(50, slope(EarthModel::flat, 300)).find("start_height: sim_aero.start_below_ground(50, 62)") ==
        0);
  CHECK(refusal(50, slope(EarthModel::flat, -300)) == "flies");
}

TEST_CASE("a motion that runs away ends the flight with its cause") {
  auto b = bench(200);
  b->params.airframe.value.aero.pitch.q_ratio = 1e4;  // a damping with the wrong sign: it drives
  arm(*b);
  Status status = Status::ok;
  int ticks = 0;
  for (; ticks < 40000 && status != Status::failed; ++ticks) {
    status = b->read();
    b->set(b->in.actuators, cruise);
    if (status != Status::failed) b->write();
  }
  CHECK(status == Status::failed);
  CHECK_MESSAGE(b->error().starts_with("sim_aero.motion_diverged("), b->error());
  CHECK(b->component().plant().departure() == Departure::diverged);
}

TEST_CASE("a flow beyond the tables of an airframe has left the model, one inside has not") {
  struct Range {
    double min = -0.2, max = 0.3;
    bool holds(double x) const { return x >= min && x <= max; }
  };
  struct Tables {
    Range alpha, beta;
    const Range& alpha_range() const { return alpha; }
    const Range& beta_range() const { return beta; }
  } tables;
  const auto flow = [](double Va, double alpha, double beta) {
    return air_velocity<double>(Va, alpha, beta);
  };
  CHECK(beyond_tables(tables, flow(17, 0.1, 0.1)) == Departure::none);
  CHECK(beyond_tables(tables, flow(17, 0.31, 0)) == Departure::beyond_alpha);
  CHECK(beyond_tables(tables, flow(17, -0.21, 0)) == Departure::beyond_alpha);
  CHECK(beyond_tables(tables, flow(17, 0, 0.31)) == Departure::beyond_beta);
  CHECK(beyond_tables(tables, flow(17, 0, -0.21)) == Departure::beyond_beta);
  CHECK(beyond_tables(tables, flow(2, 1, 0)) == Departure::none);  // hardly any wind
  CHECK(table_ends(tables, Departure::beyond_alpha) == "sim.table_ends(-11.5, 17.2)");
  tables.alpha.min = -(tables.alpha.max = std::numeric_limits<double>::infinity());
  CHECK(beyond_tables(tables, flow(17, 1.5, 0)) == Departure::none);
  CHECK(beyond_tables(tables, flow(17, 1.5, 0.31)) == Departure::beyond_beta);
  tables.beta = tables.alpha;
  CHECK(beyond_tables(tables, flow(17, 1.5, 1)) == Departure::none);
}

TEST_CASE("gusts come at their time, again and again, or when asked for") {
  const auto with = [](double at, double every) {
    auto b = bench(200);
    b->params.around.air.gust.value = {0, 0, -3};
    b->params.around.air.gust_length.value = 5;
    b->params.around.air.gust_at.value = at;
    b->params.around.air.gust_every.value = every;
    return b;
  };
  using Times = std::vector<double>;
  const auto near = [](const Times& a, const Times& b) {
    REQUIRE(a.size() == b.size());
    for (std::size_t i = 0; i < a.size(); ++i) CHECK(a[i] == Approx(b[i]).epsilon(1e-9).scale(1));
  };
  near(begins(gusts(*with(-1, 0), 3)), {});
  near(begins(gusts(*with(-1, 1), 3)), {});
  near(begins(gusts(*with(1.5, 0), 4)), {1.5});
  near(begins(gusts(*with(0.5, 1), 4)), {0.5, 1.5, 2.5, 3.5});
  near(begins(gusts(*with(-1, 0), 4, 2)), {2});
  near(begins(gusts(*with(1, 0), 4, 2.5)), {1, 2.5});
  auto none = with(1, 1);
  none->params.around.air.gust.value = {};
  near(begins(gusts(*none, 3)), {});
  // a time that is over when it is set lets none begin, the next of a row does
  auto late = with(-1, 0);
  gusts(*late, 2);
  late->params.around.air.gust_at.value = 1;
  late->retune();
  near(begins(gusts(*late, 3)), {});
  late->params.around.air.gust_every.value = 0.75;
  late->retune();
  const auto row = begins(gusts(*late, 4.2));  // counted from 3 s on: 3.25, 4.0
  near(row, {0.25, 1.0});
}

TEST_CASE("the weather of the parameters reaches the plant") {
  auto b = bench(200);
  Thermals& t = b->params.around.air.thermals.value;
  t.thermals.count = 1;
  t.thermals.items[0] = {0, 0, 2, 1e4, 880, false};
  arm(*b);
  while (b->tick.now_ns < 100000000) pass(*b, &cruise);
  CHECK(b->component().plant().wind_n().z() == Approx(-2).epsilon(0.01));
  // turbulence at 3 m is not that at 300 m
  double sums[2] = {0, 0};
  for (int k = 0; k < 2; ++k) {
    auto g = bench(k == 0 ? 30 : 3000);
    g->params.wind.turbulence.value = Turbulence::severe;
    g->params.around.air.turbulence_height.value = TurbulenceHeight::actual;
    g->params.settle.value = 600;  // carried along: same airspeed, same height
    for (int i = 0; i < 200000; ++i) {
      g->read();
      sums[k] += g->component().plant().wind_n().squaredNorm() / 200000;
    }
  }
  const auto power = [](double h) { return dryden_scales_at(Turbulence::severe, h).sigma.squaredNorm(); };
  CHECK(sums[1] / sums[0] == Approx(power(3000) / power(30)).epsilon(0.4));
}

}  // namespace refusals_test
