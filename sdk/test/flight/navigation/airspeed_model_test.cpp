// SPDX-License-Identifier: BSD-3-Clause
// The airspeed from throttle and forces without a pitot: the model alone against a propeller and a polar of
// other form, and the component in flights.
#include "fulmar/flight/navigation/airspeed_model.hpp"

#include <doctest/doctest.h>

#include <cstring>

#include "flight_bench.hpp"
#include "fulmar/flight/model/propulsion.hpp"

namespace airspeed_model_test {

using namespace synthetic;
using Block = AirspeedModel::Block;

namespace {

constexpr double g = 9.80665;

/// Motor and propeller of the Anaconda (configs/airframes/anaconda.yaml), and a wing with a parabolic polar.
struct Aircraft {
  Propulsion engine = [] {
    Propulsion p;
    p.propeller_diameter_m = 0.381;
    p.ct0_ratio = 0.06288743;
    p.ct1_ratio = -0.02704452;
    p.ct2_ratio = -0.31320732;
    p.cq0_ratio = 0.00614891;
    p.cq1_ratio = -0.0106795;
    p.cq2_ratio = -0.011779;
    p.torque_constant_ratio = 0.01705;
    p.resistance_ohm = 0.042;
    p.no_load_amp = 1.5;
    p.battery_volt = 24;
    return p;
  }();
  double mass_kg = 4.6, wing_m2 = 0.52, rho = 1.225;

  /// Block at this throttle and airspeed, at the angle of attack with `f_z`.
  Block at(double throttle, double V, double f_z) const {
    const Propeller propeller(engine);
    const double T = propeller.thrust(propeller.steady_speed(throttle, V, rho), V, rho);
    const double qS = 0.5 * rho * V * V * wing_m2;
    const auto lift = [](double alpha) { return 0.25 + 4.8 * alpha; };
    const auto drag = [&](double alpha) { return 0.035 + 0.055 * lift(alpha) * lift(alpha); };
    const auto made = [&](double alpha) {
      return -qS * (lift(alpha) * std::cos(alpha) + drag(alpha) * std::sin(alpha)) / mass_kg;
    };
    double low = -0.3, high = 0.6;
    for (int i = 0; i < 60; ++i) (made(0.5 * (low + high)) > f_z ? low : high) = 0.5 * (low + high);
    const double f_x = (T + qS * (lift(low) * std::sin(low) - drag(low) * std::cos(low))) / mass_kg;
    return {f_x, f_z, throttle, V};
  }
};

struct Span {
  double from, to;
};

/// Model after `blocks` in these ranges. The force has the noise `noise`, with the correlation `r` between
/// blocks.
AirspeedModel taught(Span throttle, Span V, Span f_z, std::uint64_t seed, int blocks = 300,
                     double noise = 0.1, double r = 0) {
  Random random(seed);
  const Aircraft aircraft;
  AirspeedModel model;
  const auto in = [&](Span s) { return random.uniform(s.from, s.to); };
  double off = 0;
  for (int i = 0; i < blocks; ++i) {
    model.wander(AirspeedModel::block_s);
    Block b = aircraft.at(in(throttle), in(V), in(f_z));
    off = r * off + noise * std::sqrt(1 - r * r) * random.normal();
    b.f_x_mps2 += off;
    model.learn(b);
  }
  return model;
}

AirspeedModel taught_well(std::uint64_t seed) { return taught({0.2, 0.9}, {14, 20}, {-14, -7}, seed); }

/// Result of the model at the true airspeed `V`, with the estimate `believed`.
AirspeedModel::Said asked(const AirspeedModel& model, double throttle, double V, double believed,
                          double f_z = -g) {
  Block b = Aircraft{}.at(throttle, V, f_z);
  b.Va_mps = believed;
  return model.airspeed(b);
}

}  // namespace

TEST_CASE(
    "forces say the airspeed that a propeller and a polar make of them, faster and slower than believed") {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    const AirspeedModel model = taught_well(seed);
    for (const double throttle : {0.35, 0.6, 0.8})
      for (const double V : {15.0, 17.0, 19.0})
        for (const double off : {-1.0, 1.0}) {
          CAPTURE(seed);
          CAPTURE(throttle);
          CAPTURE(V);
          CAPTURE(off);
          const AirspeedModel::Said said = asked(model, throttle, V, V + off);
          CHECK(said.known);
          CHECK(said.Va_mps == doctest::Approx(V).epsilon(0.03));
          CHECK(said.model_std_mps > 0.02);
          CHECK(said.model_std_mps < 0.5);
        }
  }
}

TEST_CASE("the slope of the force by the airspeed is that of propeller and polar") {
  const Aircraft aircraft;
  const AirspeedModel model = taught_well(1);
  for (const double throttle : {0.4, 0.7}) {
    const double slope =
        (aircraft.at(throttle, 17.5, -g).f_x_mps2 - aircraft.at(throttle, 16.5, -g).f_x_mps2) / 1.0;
    CHECK(slope < 0);
    CHECK(model.slope_per_s(aircraft.at(throttle, 17, -g)) == doctest::Approx(slope).epsilon(0.12));
  }
}

TEST_CASE("errors of the airspeed are as large as claimed, also where those of the force follow each other") {
  for (const double r : {0.0, 0.6}) {
    int within_1 = 0, within_2 = 0, n = 0;
    for (std::uint64_t seed = 1; seed <= 60; ++seed) {
      const AirspeedModel model = taught({0.35, 0.7}, {16, 18}, {-11, -9}, seed, 400, 0.2, r);
      const AirspeedModel::Said said = asked(model, 0.55, 17, 17);
      CHECK(said.known);
      const double off = std::abs(said.Va_mps - 17);
      within_1 += off < said.model_std_mps;
      within_2 += off < 2 * said.model_std_mps;
      ++n;
    }
    CAPTURE(r);
    CHECK(within_1 > 0.5 * n);
    CHECK(within_2 > 0.85 * n);
    CHECK(within_1 < n);  // not by a large standard deviation
  }
}

TEST_CASE("for an unseen throttle the model has a large standard deviation") {
  const AirspeedModel cruise = taught({0.545, 0.555}, {16.5, 17.5}, {-10, -9.6}, 3), all = taught_well(3);
  const AirspeedModel::Said there = asked(cruise, 0.9, 17, 17), climb = asked(all, 0.9, 17, 17);
  CHECK(climb.known);
  CHECK(climb.model_std_mps < 0.5);
  CHECK((!there.known || there.model_std_mps > 3));
  const AirspeedModel::Said still = asked(cruise, 0.55, 17, 17);
  CHECK((!still.known || (still.model_std_mps < 1 && std::abs(still.Va_mps - 17) < 3 * still.model_std_mps)));
}

TEST_CASE("a steady airspeed teaches no slope, and there is no result before some time of learning") {
  CHECK_FALSE(asked(AirspeedModel{}, 0.55, 17, 17).known);
  CHECK_FALSE(asked(taught({0.3, 0.8}, {14, 20}, {-14, -7}, 1, 90), 0.55, 17, 17).known);
  CHECK(asked(taught({0.3, 0.8}, {14, 20}, {-14, -7}, 1, 120), 0.55, 17, 17).known);
  CHECK_FALSE(asked(taught({0.55, 0.55}, {17, 17}, {-g, -g}, 1), 0.55, 17, 17).known);
}

TEST_CASE("what was learnt long ago is less sure, and no surer than nothing at last") {
  AirspeedModel model = taught_well(2);
  const double now = asked(model, 0.55, 17, 17).model_std_mps;
  for (int i = 0; i < 600; ++i) model.wander(0.2);  // two minutes
  const double later = asked(model, 0.55, 17, 17).model_std_mps;
  CHECK(later > 2 * now);
  CHECK(later < 1.5);
  for (int i = 0; i < 100; ++i) model.wander(1e6);
  CHECK_FALSE(asked(model, 0.55, 17, 17).known);
  CHECK(model.covariance().diagonal().maxCoeff() <= 400 + 1e-6);  // as the initial one
}

TEST_CASE("blocks whose errors follow each other count for fewer: (1 + r) / (1 - r) as one") {
  for (const double r : {0.0, 0.6}) {
    CAPTURE(r);
    const AirspeedModel model = taught({0.3, 0.8}, {15, 19}, {-12, -8}, 7, 1500, 0.2, r);
    CHECK(model.std_mps2() == doctest::Approx(0.2).epsilon(0.2));
    CHECK(model.alone() == doctest::Approx((1 + r) / (1 - r)).epsilon(0.35));
  }
}

namespace {

/// Throttle with this specific force by a simple law: 14 m/s2 of thrust, drag, tilt of the lift.
double throttle_of(const Truth& x) {
  const double V = x.airspeed();
  return std::clamp((x.f_b.x() + 0.014 * V * V - 0.06 * x.f_b.z()) / 14, 0.0, 1.0);
}

constexpr double lost_s = 110;

/// Removes receiver and pitot from then on.
void lose_both(const Truth& x, Samples& s) {
  if (x.t < lost_s) return;
  s.gnss.reset();
  s.pitot.reset();
}

struct Seen {
  double most = 0, max_std = 0, square = 0;
  int flagged = 0, early = 0, n = 0, invalid = 0;

  void look(const Truth& x, const VehicleState& s) {
    early += x.t < lost_s && s.airspeed_from_model;
    if (x.t < lost_s + 1.1) return;
    const double off = s.airspeed_mps - x.airspeed();
    most = std::max(most, std::abs(off));
    max_std = std::max(max_std, s.airspeed_std_mps);
    square += off * off;
    flagged += s.airspeed_from_model;
    invalid += !s.airspeed_valid;
    ++n;
  }
  double rms() const { return std::sqrt(square / n); }
};

Seen flown(const Quality& quality, std::uint64_t seed, const std::function<double(const Truth&)>& throttle) {
  Flown flight;
  flight.plan.duration_s = lost_s + 60;
  flight.plan.seed = seed;
  flight.quality = quality;
  flight.alter = lose_both;
  flight.throttle = throttle;
  Seen seen;
  flight.watch = [&](const Truth& x, const VehicleState& s, Status) { seen.look(x, s); };
  flight.run();
  return seen;
}

}  // namespace

TEST_CASE("without receiver and pitot the throttle gives the airspeed for a minute, with a flag") {
  for (const Quality& quality : {rosflight, ublox}) {
    const Seen with = flown(quality, 4, throttle_of), without = flown(quality, 4, {});
    CHECK(with.early == 0);
    CHECK(with.flagged == with.n);
    CHECK(with.invalid == 0);
    CHECK(with.rms() < 0.6);
    CHECK(with.most < 2);
    CHECK(with.max_std < 1.5);
    CHECK(without.flagged == 0);
    CHECK(without.rms() > 1.2 * with.rms());
  }
}

TEST_CASE("a motor that does not do what is commanded, more or less, ends it within half a second") {
  for (const double more : {0.4, -0.4}) {
    CAPTURE(more);
    Flown flight;
    flight.plan.duration_s = lost_s + 40;
    flight.quality = ublox;
    flight.alter = lose_both;
    const double fails_s = lost_s + 20;
    flight.throttle = [&](const Truth& x) { return throttle_of(x) + (x.t < fails_s ? 0 : more); };
    int before = 0, n = 0, after = 0;
    double most = 0;
    flight.watch = [&](const Truth& x, const VehicleState& s, Status) {
      if (x.t > lost_s + 1.1 && x.t < fails_s) {
        before += s.airspeed_from_model;
        ++n;
      }
      if (x.t < fails_s + 0.5) return;
      after += s.airspeed_from_model;
      most = std::max(most, std::abs(s.airspeed_mps - x.airspeed()) / s.airspeed_std_mps);
    };
    flight.run();
    CHECK(before == n);
    CHECK(after == 0);
    CHECK(most < 3);
  }
}

TEST_CASE("a motor that gains or loses a third over seconds: what is claimed grows with what is wrong") {
  for (const double more : {-0.33, 0.33})
    for (const double ramp_s : {3.0, 6.0, 12.0}) {
      CAPTURE(more);
      CAPTURE(ramp_s);
      Flown flight;
      flight.plan.duration_s = lost_s + 50;
      flight.quality = ublox;
      flight.alter = lose_both;
      const double fades_s = lost_s + 20;
      flight.throttle = [&](const Truth& x) {
        return throttle_of(x) + more * std::clamp((x.t - fades_s) / ramp_s, 0.0, 1.0);
      };
      int before = 0, n = 0, after = 0;
      double most = 0, max_valid_mps = 0;
      flight.watch = [&](const Truth& x, const VehicleState& s, Status) {
        if (x.t > lost_s + 1.1 && x.t < fades_s) {
          before += s.airspeed_from_model;
          ++n;
        }
        const double off = std::abs(s.airspeed_mps - x.airspeed());
        if (x.t < fades_s) return;
        most = std::max(most, off / s.airspeed_std_mps);
        if (s.airspeed_valid) max_valid_mps = std::max(max_valid_mps, off);
        if (x.t > fades_s + ramp_s + 8) after += s.airspeed_from_model;
      };
      flight.run();
      CHECK(before == n);
      CHECK(after == 0);
      CHECK(most < 5);  // 14 with the standard deviation of the filter alone
      CHECK(max_valid_mps < 6);
    }
}

TEST_CASE("a tube that is lost before the model has learnt leaves the airspeed as without a throttle") {
  double most = 0;
  for (const bool wired : {true, false}) {
    Flown flight;
    flight.plan.duration_s = 60;
    flight.quality = ublox;
    flight.alter = [](const Truth& x, Samples& s) {
      if (x.t > 25) {
        s.gnss.reset();
        s.pitot.reset();
      }
    };
    if (wired) flight.throttle = throttle_of;
    int flagged = 0;
    double last = 0;
    flight.watch = [&](const Truth&, const VehicleState& s, Status) {
      flagged += s.airspeed_from_model;
      last = s.airspeed_mps;
    };
    flight.run();
    CHECK(flagged == 0);
    most = wired ? last : most - last;
  }
  CHECK(most == 0);
}

TEST_CASE(
    "as long as the tube is there, the throttle changes no bit of the estimate, with fixes or without") {
  for (const double no_fix_from_s : {1e9, 100.0}) {
    std::vector<VehicleState> states[2];
    for (const bool wired : {false, true}) {
      Flown flight;
      flight.plan.duration_s = 130;
      flight.quality = rosflight;
      flight.alter = [&](const Truth& x, Samples& s) {
        if (x.t > no_fix_from_s) s.gnss.reset();
      };
      if (wired) flight.throttle = throttle_of;
      int k = 0;
      flight.watch = [&](const Truth&, const VehicleState& s, Status) {
        if (++k % 20 == 0) states[wired].push_back(s);
      };
      flight.run();
    }
    REQUIRE(states[0].size() == states[1].size());
    REQUIRE(states[0].size() > 1000);
    int other = 0;
    for (std::size_t i = 0; i < states[0].size(); ++i) {
      const VehicleState &a = states[0][i], &b = states[1][i];
      other += std::memcmp(&a.position_m, &b.position_m, offsetof(VehicleState, origin_valid)) != 0;
      other += a.airspeed_valid != b.airspeed_valid || a.airspeed_from_model || b.airspeed_from_model;
    }
    CHECK(other == 0);
  }
}

}  // namespace airspeed_model_test
