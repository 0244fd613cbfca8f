// SPDX-License-Identifier: BSD-3-Clause
// Requested faults: rejections, durations, and priorities.
#include "fulmar/msg/fault_request.hpp"

#include <doctest/doctest.h>

#include <limits>

#include "faulty.hpp"

namespace fault_request_test {

using namespace fulmar;
using namespace fulmar::sim;
using doctest::Approx;

namespace {
std::string ask(Bench<Aircraft>& b, const FaultRequest& request) {
  b.push(b.in.fault, request);
  pass(b, &level);
  return b.answer(b.in.fault);
}
void fly(Bench<Aircraft>& b, double seconds) {
  for (int i = 0; i < std::lround(400 * seconds); ++i) pass(b, &level);
}
/// How far the barometer is off now.
double off(Bench<Aircraft>& b) {
  do pass(b, &level);
  while (!b.out.baro.written);
  return b.out.baro.value.pressure_pa - b.component().plant().air().pressure_pa;
}
constexpr auto baro = FaultTarget::baro;
constexpr auto wrong = FaultKind::wrong;
}  // namespace

TEST_CASE("a combination that there is not is refused with the valid ones") {
  auto b = airborne(SensorSet::perfect);
  CHECK(ask(*b, {baro, FaultKind::hardover_positive}) ==
        "sim_aero.fault_unknown(baro, hardover_positive, none, off, stuck, wrong, slow, noisy, jumping)");
  CHECK(ask(*b, {FaultTarget::elevator, FaultKind::noisy}) ==
        "sim_aero.fault_unknown(elevator, noisy, none, stuck, hardover_positive, hardover_negative, slow, "
        "free, lost)");
  CHECK(ask(*b, {FaultTarget::radio, FaultKind::stuck}) == "sim_aero.fault_unknown(radio, stuck, none, off)");
  CHECK(ask(*b, {FaultTarget::engine, FaultKind::empty}) ==
        "sim_aero.fault_unknown(engine, empty, none, off, weak)");
}

TEST_CASE("each kind that a target has is accepted, and no other") {
  for (std::size_t target = 0; target < fault_targets; ++target)
    for (std::size_t kind = 0; kind <= static_cast<std::size_t>(FaultKind::melting); ++kind) {
      auto b = airborne(SensorSet::perfect);
      const FaultRequest r{static_cast<FaultTarget>(target), static_cast<FaultKind>(kind),
                           target == at(FaultTarget::icing) && kind > 0 ? 0.1 : 0};
      const auto kinds = kinds_of(r.what);
      const bool valid = std::find(kinds.begin(), kinds.end(), r.kind) != kinds.end();
      CHECK((ask(*b, r) == "accepted") == valid);
      fly(*b, 0.1);
      CHECK(b->validation_error() == "");
    }
}

TEST_CASE("a size, a ramp or a time out of range is refused with the range") {
  auto b = airborne(SensorSet::perfect);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK(ask(*b, {baro, wrong, 2e5}) ==
        "size: sim_aero.fault_size_out_of_range(200000, -100000 to 100000 Pa)");
  CHECK(ask(*b, {baro, wrong, nan}) == "size: sim_aero.fault_size_out_of_range(nan, -100000 to 100000 Pa)");
  CHECK(ask(*b, {FaultTarget::engine, FaultKind::weak, 1.5}) ==
        "size: sim_aero.fault_size_out_of_range(1.5, 0 to 1)");
  CHECK(ask(*b, {baro, FaultKind::stuck, 1}) == "size: sim_aero.fault_without_size(stuck)");
  CHECK(ask(*b, {FaultTarget::icing, FaultKind::growing}) == "size: sim_aero.icing_rate_missing");
  CHECK(ask(*b, {baro, wrong, 100, -1}) == "ramp: sim_aero.fault_ramp_out_of_range(-1)");
  CHECK(ask(*b, {baro, wrong, 100, 0, nan}) == "for: sim_aero.fault_time_out_of_range(nan)");
  CHECK(std::abs(off(*b)) < 1e-6);  // a rejected request has no effect
}

TEST_CASE("a request has its size, or that of the parameters") {
  auto b = airborne(SensorSet::perfect);
  CHECK(ask(*b, {baro, wrong, 77}) == "accepted");
  CHECK(off(*b) == Approx(77));
  CHECK(ask(*b, {baro, wrong}) == "accepted");
  CHECK(off(*b) == Approx(240));
  CHECK(ask(*b, {baro, FaultKind::none}) == "accepted");
  CHECK(std::abs(off(*b)) < 1e-6);
}

TEST_CASE("the size of a vector is its length, along the parameter's") {
  auto b = airborne(SensorSet::perfect), right = airborne(SensorSet::perfect);
  b->params.faults.sensors_that_fail.gyro_fault_size.value = {0, 3, 4};
  b->configure();
  CHECK(ask(*b, {FaultTarget::gyro, wrong, 0.5}) == "accepted");
  pass(*right, &level);
  pass(*b, &level);
  pass(*right, &level);
  const Eigen::Vector3d offset = sensed(b->out, FaultTarget::gyro) - sensed(right->out, FaultTarget::gyro);
  CHECK((offset - Eigen::Vector3d(0, 0.3, 0.4)).norm() < 1e-9);
}

TEST_CASE("a request wins over the parameters until its time is over") {
  auto b = airborne(SensorSet::perfect);
  b->params.faults.sensors_that_fail.baro_fault.value = SensorFault::wrong;
  b->params.faults.sensors_that_fail.baro_fault_size.value = 10;
  CHECK(off(*b) == Approx(10));
  CHECK(ask(*b, {baro, wrong, 500, 0, 1}) == "accepted");
  CHECK(off(*b) == Approx(500));
  b->params.faults.sensors_that_fail.baro_fault_size.value = 20;
  b->retune();
  CHECK(off(*b) == Approx(500));
  fly(*b, 1);
  CHECK(off(*b) == Approx(20));
}

TEST_CASE("a request with a ramp grows evenly, and the next one for the same target takes its place") {
  auto b = airborne(SensorSet::perfect);
  CHECK(ask(*b, {baro, wrong, 1000, 4}) == "accepted");
  fly(*b, 1);
  CHECK(off(*b) == Approx(250).epsilon(0.05));
  fly(*b, 4);
  CHECK(off(*b) == Approx(1000));
  CHECK(ask(*b, {baro, FaultKind::off}) == "accepted");
  int spoken = 0;
  for (int i = 0; i < 400; ++i) {
    pass(*b, &level);
    spoken += b->out.baro.written;
  }
  CHECK(spoken == 0);
}

TEST_CASE("ice is requested by its rate, melts by request, and stays when a request has ended") {
  auto b = airborne(SensorSet::perfect);
  CHECK(ask(*b, {FaultTarget::icing, FaultKind::growing, 0.2, 0, 2}) == "accepted");
  fly(*b, 3);
  CHECK(b->component().ice() == Approx(0.4).epsilon(0.01));
  CHECK(ask(*b, {FaultTarget::icing, FaultKind::melting, 0.1, 0, 1}) == "accepted");
  fly(*b, 2);
  CHECK(b->component().ice() == Approx(0.3).epsilon(0.01));
}

TEST_CASE("a flight with faults allocates nothing, and its bytes follow from the seed") {
  const auto flight = [](std::uint64_t seed) {
    auto b = airborne(SensorSet::ublox, seed);
    ask(*b, {FaultTarget::mag, FaultKind::jumping, 0, 0, 2});
    ask(*b, {FaultTarget::accel, FaultKind::noisy});
    ask(*b, {FaultTarget::aileron, FaultKind::free, 0, 0, 1});
    std::vector<double> all;
    const auto allocated = allocations([&] {
      for (int i = 0; i < 400; ++i) b->component().read(b->tick, b->params, b->out);
    });
    CHECK(allocated == 0);
    for (int i = 0; i < 800; ++i) {
      pass(*b, &level);
      all.insert(all.end(), {b->out.mag.value.field_tesla.x, b->out.imu.value.specific_force_mps2.z,
                             b->component().plant().state().p_n.z()});
    }
    return all;
  };
  CHECK(flight(3) == flight(3));
  CHECK(flight(3) != flight(4));
}

}  // namespace fault_request_test
