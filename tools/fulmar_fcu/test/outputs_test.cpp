// SPDX-License-Identifier: BSD-3-Clause
// Movement of outputs on the ground, and the magnetometer from samples to parameters.
#include <doctest/doctest.h>

#include <cmath>
#include <fstream>

#include "captured.hpp"
#include "lossy_port.hpp"
#include "tools/fulmar_fcu/app.hpp"
#include "tools/fulmar_fcu/test/with_eigen.hpp"

namespace outputs_test {

namespace {

using namespace fulmar::fcu;
using fulmar::fcu::test::Bench;
using fulmar::fcu::test::Captured;
using fulmar::fcu::test::plain;
using peer::param;

struct Standing : Bench {
  explicit Standing(const peer::Options& options = {}) : Bench(options) {
    firmware.provision();
    idle(13'000'000);
  }
  Captured test_outputs(bool sure = true) {
    Client c = client();
    c.connect();
    HardwareOptions what;
    what.propeller_off = sure;
    return Captured([&] { return outputs_command(c, {}, what); });
  }
};

TEST_CASE("aileron, elevator and rudder move one after the other to both sides, and the motor never") {
  Standing bench;
  double motor = 0;
  std::array<double, 3> high{}, low{1, 1, 1};
  double together = 0;
  bench.on_command = [&](Frame&) {
    const auto& out = bench.firmware.outputs();
    motor = std::max(motor, static_cast<double>(out[4]));
    int moving = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      high[i] = std::max(high[i], static_cast<double>(out[i]));
      low[i] = std::min(low[i], bench.firmware.commands() > 50 ? static_cast<double>(out[i]) : 1.0);
      moving += std::fabs(out[i] - 0.5f) > 0.02f;
    }
    if (bench.firmware.commands() > 50) together = std::max(together, static_cast<double>(moving));
  };
  const Captured result = bench.test_outputs();
  CHECK(result.code == 0);
  CHECK(motor == 0);
  CHECK(together == 1);
  for (std::size_t i = 0; i < 3; ++i) {
    CHECK(high[i] == doctest::Approx(0.75).epsilon(0.01));
    CHECK(low[i] == doctest::Approx(0.25).epsilon(0.02));
  }
  CHECK(result.says("fcu.output_moved(1, 0.75, 0.25)"));
  bench.firmware.params().set(param("REV_ELEVATOR"), 1);
  const Captured reversed = bench.test_outputs();
  CHECK(reversed.says("fcu.output_moved(0, 0.75, 0.25)"));
  CHECK(reversed.says("fcu.output_moved(1, 0.25, 0.75)"));
}

TEST_CASE("without a yes nothing moves") {
  Standing bench;
  const Captured result = bench.test_outputs(false);
  CHECK(result.says("fcu.confirmation_required(--propeller-off, once it is)"));
  CHECK(bench.firmware.commands() == 0);
}

TEST_CASE("what keeps the outputs from following is told: the switch, the radio, arming") {
  Standing bench;
  bench.firmware.inputs.rc_us[5] = 2000;
  CHECK(bench.test_outputs().says("fcu.pilot_override_active(attitude override switch on)"));
  Standing silent;
  silent.firmware.inputs.rc_frames = false;
  CHECK(silent.test_outputs().says("fcu.radio_frames_missing"));
  Standing armed;
  armed.on_command = [&](Frame&) {
    if (armed.firmware.commands() == 100)
      armed.firmware.inputs.rc_us = {1500, 1500, 1000, 1500, 2000, 2000, 1000, 1000};
  };
  const Captured result = armed.test_outputs();
  CHECK((result.says("fcu.armed_during_test") || result.says("fcu.pilot_took_over(")));
  CHECK(armed.firmware.commands() < 160);
}

TEST_CASE("a controller that acknowledges a reboot and stays is found out") {
  peer::Options options;
  options.reboots = false;
  Standing bench(options);
  Client client = bench.client();
  client.connect();
  CHECK(Captured([&] { return reboot_command(client, {}); }).says("fcu.reboot_not_done"));
}

TEST_CASE("a calibration that fails is told in the firmware's words") {
  Standing bench;
  bench.firmware.inputs.accel = {6, 0, -9.8};
  Client client = bench.client();
  client.connect();
  HardwareOptions what;
  what.what = "imu";
  const Captured result([&] { return calibrate_command(client, {}, what); });
  CHECK(result.code == 1);
  CHECK(result.says("fcu.calibration_failed(imu, large accel bias"));
  CHECK(bench.firmware.params().f(param("ACC_X_BIAS")) == 1e-6f);  // as before: put back
}

TEST_CASE("samples of a file become the twelve parameters that undo their distortion") {
  Standing bench;
  Eigen::Matrix3d A;
  A << 1.1, 0.04, -0.03, 0.04, 0.93, 0.05, -0.03, 0.05, 0.98;
  A /= std::cbrt(A.determinant());
  const Eigen::Vector3d b(12e-6, -31e-6, 7e-6);
  fulmar::Random random(3);
  std::vector<Eigen::Vector3d> samples;
  for (int i = 0; i < 300; ++i) {
    const Eigen::Vector3d v(random.normal(), random.normal(), random.normal());
    samples.push_back(A.inverse() * (48e-6 * v.normalized()) + b);
  }
  const std::string path = "/tmp/fulmar_fcu_mag_" + std::to_string(::getpid()) + ".csv";
  std::ofstream(path) << samples_text(plain(samples));
  Client client = bench.client();
  client.connect();
  HardwareOptions what;
  what.what = "mag";
  what.file = path;
  Options sure;
  CHECK(Captured([&] {
          return calibrate_command(client, sure, what);
        }).says("fcu.confirmation_required(--yes)"));
  CHECK(bench.firmware.params().f(param("MAG_X_BIAS")) == 0);
  sure.yes = true;
  CHECK(Captured([&] { return calibrate_command(client, sure, what); }).code == 0);
  for (std::size_t i = 0; i < 3; ++i) {
    CHECK(bench.firmware.params().f(param("MAG_X_BIAS") + i) ==
          doctest::Approx(b(static_cast<Eigen::Index>(i))).epsilon(1e-4));
    for (std::size_t k = 0; k < 3; ++k)
      CHECK(bench.firmware.params().f(param("MAG_CAL_A00") + 3 * i + k) ==
            doctest::Approx(A(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k))).epsilon(1e-4));
  }
  std::ofstream(path) << "x,y,z\n1e-6,2e-6\n";
  CHECK(Captured([&] {
          return calibrate_command(client, sure, what);
        }).says("fcu.sample_line_invalid(" + path + ", 2)"));
  std::remove(path.c_str());
}

TEST_CASE("the guide is done after six sides, each turned once around") {
  MagGuide guide;
  const std::array<Eigen::Vector3d, 6> ups{
      {{0, 0, -1}, {0, 0, 1}, {1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}}};
  int side = 0;
  for (const Eigen::Vector3d& up : ups) {
    CHECK(guide.done_sides() == side++);
    CHECK_FALSE(guide.done());
    for (int k = 0; k < 2000; ++k) {  // one turn in 20 s, 100 Hz
      guide.turn(plain(9.81 * up), plain(up * (2 * 3.14159265 / 20)), 0.01);
      guide.take({1e-5, 2e-5, 3e-5});
    }
  }
  CHECK(guide.done());
  CHECK(guide.text() == "6 of 6 sides done.");
  CHECK(guide.samples().size() <= 6 * 12 * 12);
  MagGuide still;
  for (int k = 0; k < 2000; ++k) {
    still.turn({0, 0, -9.81}, {0, 0, 0}, 0.01);
    still.take({1e-5, 2e-5, 3e-5});
  }
  CHECK(still.done_sides() == 0);
  CHECK(still.text().find("fcu.side_in_progress(0 of 6 sides done. , upright (level), 1)") !=
        std::string::npos);
}

}  // namespace

}  // namespace outputs_test
