// SPDX-License-Identifier: BSD-3-Clause
// Two analyses of one aircraft at other reference lengths, and the Dutch roll with its damper by eigenvalues.
#include <Eigen/Eigenvalues>

#include "import_kit.hpp"
#include "tools/fulmar_aero/airframe_file.hpp"
#include "tools/fulmar_aero/flight_model.hpp"
#include "tools/fulmar_aero/gains_file.hpp"
#include "tools/fulmar_aero/loops.hpp"

namespace off_nominal_test {

using namespace fulmar;
using namespace fulmar::aero;
using namespace fulmar::aero::test;
using doctest::Approx;

namespace {

/// The same forces and moments, by other reference lengths: of area x, span y and chord z times as large.
Input by_other_lengths(Input input, double x, double y, double z) {
  Analysis& a = input.analyses.at(0);
  a.area_m2.x *= x;
  a.span_m.x *= y;
  a.chord_m.x *= z;
  const auto divide = [&](Column& c, double rate) {
    c[lift].x /= x * rate;
    c[drag].x /= x * rate;
    c[side].x /= x * rate;
    c[roll].x /= x * y * rate;
    c[yaw].x /= x * y * rate;
    c[pitch].x /= x * z * rate;
  };
  divide(a.base, 1);
  const double rates[] = {1, 1, y, z, y};  // alpha, beta, p, q, r
  for (std::size_t by = 0; by < bys; ++by) divide(a.slope[by], rates[by]);
  for (Control& control : a.controls) divide(control.of, 1);
  return input;
}

double damping_by_eigenvalues(const Plant& plant, double k) {
  using Lateral = Eigen::Matrix4d;
  const int states[] = {model::v, model::p, model::r, model::roll};
  Lateral A;
  Eigen::Vector4d B, law;
  const double V = plant.flight.condition.airspeed_mps, theta = plant.flight.x(model::pitch);
  for (int i = 0; i < 4; ++i) {
    for (int j = 0; j < 4; ++j) A(i, j) = plant.linear.A(states[i], states[j]);
    B(i) = plant.linear.B(states[i], model::rudder);
  }
  law << 0, 0, k, -k * 9.80665 / V * std::cos(theta);  // less the rate of a level turn at this bank
  const Eigen::Vector4cd all = (A + B * law.transpose()).eigenvalues();
  for (const std::complex<double>& s : all)
    if (s.imag() > 1e-9) return -s.real() / std::abs(s);
  return 1;
}

}  // namespace

TEST_CASE("two analyses of one aircraft by other reference lengths say the same, and a difference is told") {
  const Input first = read_text(tern_text("tern.st"), "a.st");
  Input second = by_other_lengths(first, 1.1, 0.85, 1.2);
  second.file = "b.st";
  Input same = first;
  same.file = "b.st";
  ImportOptions options;
  options.mass_kg = 3;
  const Aircraft two = aircraft_of({first, second}, options), one = aircraft_of({first, same}, options);
  CHECK(two.notes == one.notes);
  is_tern(two);
  for (const By by : {p, q, r}) {
    Input other = second;
    Value& value = other.analyses[0].slope[by][by == p ? roll : by == q ? pitch : yaw];
    value.x *= 1.2;
    CHECK(aircraft_of({first, other}, options).notes.size() == one.notes.size() + 1);
  }
}

TEST_CASE("the Dutch roll's damping with the damper is that of the closed lateral motion, at any speed") {
  for (const char* name : {"anaconda", "x8"}) {
    const AirframeFile file =
        read_airframe_file(std::string(FULMAR_SOURCE_DIR "/configs/airframes/") + name + ".yaml");
    const FlightLimits& limits = file.airframe.limits;
    for (const double V : {limits.airspeed_cruise_mps, 1.25 * limits.airspeed_cruise_mps}) {
      CAPTURE(name);
      CAPTURE(V);
      const AircraftModel m(file.airframe, 0);
      const SteadyFlight flight = fly(m, {.airspeed_mps = V});
      const Plant plant = {file.airframe, linearised(m, flight), flight, 0, 0.01, 0};
      InnerLaw inner = laws_in(file).laws.inner;
      for (const double kd : {0.0, 0.1, 0.3}) {
        inner.yaw_kd.value = kd;
        const double scale = std::pow(limits.airspeed_cruise_mps / V, 2);
        CHECK(std::abs(dutch_roll_damping(plant, inner) - damping_by_eigenvalues(plant, scale * kd)) < 1e-4);
      }
    }
  }
}

}  // namespace off_nominal_test
