// SPDX-License-Identifier: BSD-3-Clause
#include "plugins/sim_aero/sensor_faults.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <functional>

#include "faulty.hpp"

namespace sensor_faults_test {

using namespace fulmar;
using namespace fulmar::sim;
using doctest::Approx;
using Eigen::Vector3d;

namespace {

/// Two aircraft of one seed that fly the same commands: one in order, one that fails.
struct Pair {
  explicit Pair(SensorSet set, std::uint64_t seed = 1)
      : right(airborne(set, seed)), failing(airborne(set, seed)) {
    step(100);
  }
  void step(
      int passes, const std::function<void()>& each = [] {}) {
    for (int i = 0; i < passes; ++i) {
      pass(*right, &level);
      pass(*failing, &level);
      each();
    }
  }
  void fail(FaultTarget target, SensorFault kind) {
    set_fault(*failing, target, kind);
    failing->retune();
  }
  std::unique_ptr<Bench<Aircraft>> right, failing;
};

bool same(const Vector3d& a, const Vector3d& b, double relative) {
  return (a - b).norm() <= relative * std::max(a.norm(), b.norm());
}

/// Deviation from their mean, each axis.
Vector3d deviation(const std::vector<Vector3d>& samples) {
  Vector3d sum = Vector3d::Zero(), squares = Vector3d::Zero();
  for (const Vector3d& s : samples) sum += s;
  const double n = static_cast<double>(samples.size());
  for (const Vector3d& s : samples) squares += (s - sum / n).cwiseAbs2();
  return (squares / (n - 1)).cwiseSqrt();
}

std::vector<Vector3d> jumps(std::uint64_t seed, FaultTarget target, double time_s) {
  Pair pair(SensorSet::perfect, seed);
  pair.failing->params.faults.sensors_that_fail.fault_time.value = time_s;
  pair.fail(target, SensorFault::jumping);
  std::vector<Vector3d> out;
  pair.step(4000, [&] {
    if (spoke(pair.failing->out, target))
      out.push_back(sensed(pair.failing->out, target) - sensed(pair.right->out, target));
  });
  return out;
}

const Vector3d off_by{0.3, -0.2, 0.1};
}  // namespace

TEST_CASE("a stuck sensor says its last value again and again, at its rate and with new stamps") {
  for (const FaultTarget target : all_sensors) {
    CAPTURE(static_cast<int>(target));
    Pair pair(SensorSet::rosflight);
    const Vector3d last = sensed(pair.failing->out, target);
    pair.fail(target, SensorFault::stuck);
    int samples = 0, in_order = 0;
    std::int64_t stamp = pair.failing->out.gnss.valid_at_ns;
    pair.step(400, [&] {
      in_order += spoke(pair.right->out, target);
      if (!spoke(pair.failing->out, target)) return;
      ++samples;
      CHECK(same(sensed(pair.failing->out, target), last, 1e-12));
      if (!pair.failing->out.gnss.written) return;
      CHECK(pair.failing->out.gnss.valid_at_ns > stamp);
      stamp = pair.failing->out.gnss.valid_at_ns;
    });
    CHECK(samples == in_order);
    CHECK(samples >= 10);
  }
}

TEST_CASE("a wrong sensor is off by its offset and factor, exactly") {
  for (const FaultTarget target : all_sensors) {
    CAPTURE(static_cast<int>(target));
    Pair pair(SensorSet::perfect);
    SensorFaultParams& p = pair.failing->params.faults.sensors_that_fail;
    for (auto* size : {&p.gyro_fault_size, &p.accel_fault_size, &p.mag_fault_size})
      size->value = {off_by.x(), off_by.y(), off_by.z()};
    for (auto* size : {&p.gnss_position_fault_size, &p.gnss_velocity_fault_size})
      size->value = {off_by.x(), off_by.y(), off_by.z()};
    for (auto* size : {&p.baro_fault_size, &p.pitot_fault_size}) size->value = off_by.x();
    for (auto* scale :
         {&p.gyro_fault_scale, &p.accel_fault_scale, &p.gnss_position_fault_scale,
          &p.gnss_velocity_fault_scale, &p.mag_fault_scale, &p.baro_fault_scale, &p.pitot_fault_scale})
      scale->value = 1.25;
    pair.fail(target, SensorFault::wrong);
    const bool scalar = target == FaultTarget::baro || target == FaultTarget::pitot;
    const Vector3d offset = scalar ? Vector3d(off_by.x(), 0, 0) : off_by;
    pair.step(80, [&] {
      if (!spoke(pair.failing->out, target)) return;
      const Vector3d expected = 1.25 * sensed(pair.right->out, target) + offset;
      CHECK(same(sensed(pair.failing->out, target), expected, 1e-9));  // a position goes through degrees
    });
  }
}

TEST_CASE("the airspeed that a wrong pitot tube shows is that of its pressure") {
  Pair pair(SensorSet::perfect);
  pair.failing->params.faults.sensors_that_fail.pitot_fault_size.value = 40;
  pair.fail(FaultTarget::pitot, SensorFault::wrong);
  pair.step(40);
  const Pitot& p = pair.failing->out.pitot.value;
  CHECK(p.pressure_pa / (pair.right->out.pitot.value.pressure_pa + 40) == Approx(1));
  CHECK(p.indicated_airspeed_mps / std::sqrt(2 * p.pressure_pa / 1.225) == Approx(1));
}

TEST_CASE("a noisy sensor has its own deviation times the factor, with and without errors of its own") {
  constexpr double factor = 1.5;  // the present offset counts
  constexpr int passes = 16000;   // 40 s: 4000 samples of most; the deviation of a deviation is 1.1 %
  for (const SensorSet set : {SensorSet::rosflight, SensorSet::ublox, SensorSet::perfect}) {
    const SensorSpec spec = sensor_spec(set == SensorSet::perfect ? SensorSet::ublox : set);
    const auto of = [&](FaultTarget target) {
      const auto both = [](const NoiseSpec& n) { return std::hypot(n.white, n.drift); };
      if (target == FaultTarget::gyro) return both(spec.gyro[1]);
      if (target == FaultTarget::accel) return both(spec.accel[1]);
      if (target == FaultTarget::mag) return both(spec.mag[1]);
      return 0.0;
    };
    for (const FaultTarget target : {FaultTarget::gyro, FaultTarget::accel, FaultTarget::mag}) {
      Pair pair(set);
      pair.failing->params.faults.sensors_that_fail.fault_noise.value = factor;
      pair.fail(target, SensorFault::noisy);
      std::vector<Vector3d> added;
      pair.step(passes, [&] {
        if (spoke(pair.failing->out, target))
          added.push_back(sensed(pair.failing->out, target) - sensed(pair.right->out, target));
      });
      const double own = set == SensorSet::perfect ? 0 : of(target);
      const double total = std::hypot(deviation(added).y(), own);
      CAPTURE(static_cast<int>(set));
      CAPTURE(static_cast<int>(target));
      CHECK(total / (factor * of(target)) == Approx(1).epsilon(0.06));
    }
  }
}

TEST_CASE("the whole error of a noisy barometer, not what is added, is ten times as large") {
  Pair exact(SensorSet::perfect, 3);
  auto noisy = airborne(SensorSet::rosflight, 3);
  noisy->params.faults.sensors_that_fail.baro_fault.value = SensorFault::noisy;
  std::vector<Vector3d> errors;
  for (int i = 0; i < 100; ++i) pass(*noisy, &level);
  double before = 0;
  exact.step(16000, [&] {
    pass(*noisy, &level);
    if (!noisy->out.baro.written) return;
    const double error =
        noisy->out.baro.value.pressure_pa - exact.right->component().plant().air().pressure_pa;
    errors.emplace_back((error - before) / std::sqrt(2), 0, 0);  // successive differences: white noise alone
    before = error;
  });
  errors.erase(errors.begin());
  CHECK(deviation(errors).x() / 40 == Approx(1).epsilon(0.05));  // 4 Pa, times ten
}

TEST_CASE("a jumping sensor is off by offsets within its size, as often as it is said") {
  const auto offsets = jumps(1, FaultTarget::gyro, 0.1);
  int changes = 0;
  for (std::size_t i = 1; i < offsets.size(); ++i) {
    CHECK(std::abs(offsets[i].x()) <= 0.05 * (1 + 1e-9));
    CHECK(std::abs(offsets[i].y()) <= 1e-12);  // the size's direction
    changes += std::abs(offsets[i].x() - offsets[i - 1].x()) > 1e-12;
  }
  CHECK(std::abs(changes - 100) < 40);  // 10 s at 10 per second: four deviations of a Poisson count
}

TEST_CASE("jumps come from the seed: the same for the same, others for another, others for each sensor") {
  for (const FaultTarget target : all_sensors) {
    const auto one = jumps(7, target, 0.5), again = jumps(7, target, 0.5), other = jumps(8, target, 0.5);
    CAPTURE(static_cast<int>(target));
    CHECK(one == again);
    CHECK(one != other);
  }
  const auto gyro = jumps(7, FaultTarget::gyro, 0.5), accel = jumps(7, FaultTarget::accel, 0.5);
  CHECK(gyro[2000].x() / 0.05 != Approx(accel[2000].x()));
}

TEST_CASE("a sensor that jumps again begins without the offset of the last time") {
  Pair pair(SensorSet::perfect);
  SensorFaultParams& p = pair.failing->params.faults.sensors_that_fail;
  const auto off = [&] {
    return (sensed(pair.failing->out, FaultTarget::gyro) - sensed(pair.right->out, FaultTarget::gyro)).norm();
  };
  p.fault_time.value = 0.01;
  pair.fail(FaultTarget::gyro, SensorFault::jumping);
  pair.step(100);
  CHECK(off() > 1e-4);
  pair.fail(FaultTarget::gyro, SensorFault::none);
  pair.step(2);
  CHECK(off() == 0);
  p.fault_time.value = 3600;
  pair.fail(FaultTarget::gyro, SensorFault::jumping);
  pair.step(2);
  CHECK(off() == 0);
}

TEST_CASE("a slow sensor reaches 63 % of a step after its lag, at any rate") {
  for (const double dt : {0.0025, 0.1}) {
    Channel channel(dt, Vector3d::Zero(), Vector3d::Zero(), false, 1);
    Fault slow;
    slow.kind = FaultKind::slow;
    slow.time_s = 2;
    channel(5.0);
    channel.suffer(slow);
    double y = 0;
    for (int i = 0; i < std::lround(2 / dt); ++i) y = channel(6.0);
    CHECK(y - 5 == Approx(1 - std::exp(-1)).epsilon(1e-6));
  }
}

TEST_CASE("a slow pitot tube lags behind a gust") {
  Pair pair(SensorSet::perfect);
  pair.failing->params.faults.sensors_that_fail.fault_time.value = 1;
  pair.fail(FaultTarget::pitot, SensorFault::slow);
  const double before = pair.failing->out.pitot.value.pressure_pa;
  for (Bench<Aircraft>* b : {pair.right.get(), pair.failing.get()}) {
    b->params.wind.wind_ned.value = {-5, 0, 0};
    b->retune();
  }
  pair.step(8);  // 20 ms
  const double step = pair.right->out.pitot.value.pressure_pa - before;
  CHECK(step > 50);
  CHECK(std::abs(pair.failing->out.pitot.value.pressure_pa - before) < 0.05 * step);
}

TEST_CASE("a sensor that is off is silent, where it speaks alone") {
  for (const FaultTarget target : {FaultTarget::mag, FaultTarget::baro, FaultTarget::pitot}) {
    Pair pair(SensorSet::rosflight);
    pair.fail(target, SensorFault::off);
    pair.step(400, [&] { CHECK_FALSE(spoke(pair.failing->out, target)); });
  }
}

TEST_CASE("gyroscopes or accelerometers alone that are off say zero; both are silence") {
  Pair pair(SensorSet::rosflight);
  pair.fail(FaultTarget::gyro, SensorFault::off);
  pair.step(10);
  CHECK(sensed(pair.failing->out, FaultTarget::gyro).norm() == 0);
  CHECK(same(sensed(pair.failing->out, FaultTarget::accel), sensed(pair.right->out, FaultTarget::accel), 0));
  pair.fail(FaultTarget::accel, SensorFault::off);
  pair.step(10, [&] { CHECK_FALSE(pair.failing->out.imu.written); });
}

TEST_CASE("a receiver without position has no fix; one without velocity does not know it") {
  Pair pair(SensorSet::rosflight);
  pair.fail(FaultTarget::gnss_velocity, SensorFault::off);
  pair.step(80);
  CHECK(pair.failing->out.gnss.value.fix == FixType::fix_3d);
  CHECK(pair.failing->out.gnss.value.speed_std_mps == unknown_std);
  pair.fail(FaultTarget::gnss_position, SensorFault::off);
  pair.step(80);
  CHECK(pair.failing->out.gnss.value.fix == FixType::none);
  CHECK(pair.failing->out.gnss.value.horizontal_std_m == unknown_std);
  CHECK(pair.failing->out.gnss.value.vertical_std_m == unknown_std);
}

TEST_CASE("a fault of one sensor leaves all others to the bit, and when it ends its own too") {
  for (const FaultTarget target : all_sensors)
    for (const SensorFault kind : {SensorFault::off, SensorFault::stuck, SensorFault::wrong,
                                   SensorFault::slow, SensorFault::noisy, SensorFault::jumping}) {
      CAPTURE(static_cast<int>(target));
      CAPTURE(static_cast<int>(kind));
      Pair pair(SensorSet::ublox);
      const auto equal = [&](FaultTarget of) {
        return sensed(pair.failing->out, of) == sensed(pair.right->out, of) &&
               spoke(pair.failing->out, of) == spoke(pair.right->out, of);
      };
      pair.fail(target, kind);
      bool others = true, own = true;
      pair.step(200, [&] {
        for (const FaultTarget other : all_sensors) others = others && (other == target || equal(other));
      });
      CHECK(others);
      pair.fail(target, SensorFault::none);
      pair.step(100);  // the receiver's samples are on their way for a while
      pair.step(100, [&] { own = own && equal(target); });
      CHECK(own);
    }
}

TEST_CASE("with a ramp a fault grows evenly to its size") {
  Pair pair(SensorSet::perfect);
  pair.failing->params.faults.sensors_that_fail.fault_ramp.value = 2;
  pair.fail(FaultTarget::baro, SensorFault::wrong);
  for (int quarter = 1; quarter <= 6; ++quarter) {
    pair.step(200);  // 0.5 s
    const double off =
        sensed(pair.failing->out, FaultTarget::baro).x() - sensed(pair.right->out, FaultTarget::baro).x();
    CHECK(off / (240 * std::min(1.0, quarter / 4.0)) == Approx(1).epsilon(0.05));
  }
}

TEST_CASE("the radio link is lost by request, and comes back") {
  auto b = airborne(SensorSet::perfect);
  const auto heard = [&](int passes) {
    int n = 0;
    for (int i = 0; i < passes; ++i) {
      pass(*b, &level);
      n += b->out.rc.written;
    }
    return n;
  };
  CHECK(heard(400) == 50);
  b->push(b->in.fault, {FaultTarget::radio, FaultKind::off, 0, 0, 1});
  CHECK(heard(1) <= 1);
  CHECK(heard(390) == 0);
  heard(20);
  CHECK(heard(400) == 50);
}

}  // namespace sensor_faults_test
