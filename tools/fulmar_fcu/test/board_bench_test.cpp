// SPDX-License-Identifier: BSD-3-Clause
#include "tools/fulmar_fcu/board_bench.hpp"

#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "captured.hpp"
#include "lossy_port.hpp"
#include "tools/fulmar_fcu/app.hpp"

namespace board_bench_test {

namespace {

using namespace fulmar::fcu;
using fulmar::fcu::test::Bench;
using fulmar::fcu::test::Captured;

struct Board : Bench {
  Board() {
    firmware.provision();
    idle(15'000'000);
  }
  BoardReport report(double seconds = 10) {
    Client c = client();
    c.connect();
    return measure_board(c, seconds, 20);
  }
};

const Stream& stream(const BoardReport& r, const std::string& name) {
  return *std::find_if(r.streams.begin(), r.streams.end(), [&](const Stream& s) { return s.name == name; });
}
const Channel& channel(const BoardReport& r, const std::string& name) {
  return *std::find_if(r.channels.begin(), r.channels.end(),
                       [&](const Channel& c) { return c.name == name; });
}

}  // namespace

TEST_CASE("mean and standard deviation are those of the definition") {
  Spread s;
  for (const double v : {2.0, 4.0, 4.0, 4.0, 5.0, 5.0, 7.0, 9.0}) s.add(v);
  CHECK(s.mean() == doctest::Approx(5));
  CHECK(s.deviation() == doctest::Approx(std::sqrt(32.0 / 7)));
  CHECK(s.least() == 2);
  CHECK(s.most() == 9);
  CHECK(quantile({1, 2, 3, 4}, 0.5) == 3);
  CHECK(quantile({1, 2, 3, 4}, 1) == 4);
  CHECK(quantile({}, 0.5) == 0);
}

TEST_CASE("rates, bytes and noise of a board are those that it has") {
  Board board;
  double phase = 0;
  board.firmware.before_imu = [&] {
    phase = -phase + (phase == 0 ? 0.02 : 0);  // +-0.02: its standard deviation
    board.firmware.inputs.accel = {phase, 0, -9.80665};
  };
  const BoardReport r = board.report();
  CHECK(r.seconds == doctest::Approx(10).epsilon(0.01));
  CHECK(1 / stream(r, "inertial").interval_s.mean() == doctest::Approx(400).epsilon(0.02));
  CHECK(1 / stream(r, "magnetometer").interval_s.mean() == doctest::Approx(100).epsilon(0.02));
  CHECK(1 / stream(r, "gnss").interval_s.mean() == doctest::Approx(10).epsilon(0.05));
  CHECK(1 / stream(r, "radio").interval_s.mean() == doctest::Approx(111).epsilon(0.02));
  CHECK(r.bytes_per_s == doctest::Approx(48'900).epsilon(0.02));
  CHECK(r.missing == 0);
  CHECK(r.bad == 0);
  CHECK(r.imu_lost == 0);
  CHECK(r.unanswered == 0);
  CHECK(channel(r, "accel_x_mps2").value.deviation() == doctest::Approx(0.02).epsilon(0.05));
  CHECK(channel(r, "accel_z_mps2").value.mean() == doctest::Approx(-9.80665).epsilon(0.01));
  CHECK(channel(r, "accel_y_mps2").value.deviation() < 1e-6);
}

TEST_CASE("losses, latency and gaps of a bad line are found") {
  Board clean, bad;
  bad.faults.drop = 0.05;
  bad.faults.delay_us = 5000;
  const BoardReport r = bad.report();
  const double lost = static_cast<double>(r.missing) / static_cast<double>(r.frames + r.missing);
  CHECK(lost == doctest::Approx(0.05).epsilon(0.15));
  CHECK(static_cast<double>(r.imu_lost) == doctest::Approx(0.05 * 4000).epsilon(0.3));
  CHECK(r.imu_gap_s >= 0.005);
  REQUIRE_FALSE(r.round_trips_s.empty());
  // 5 ms more each way
  CHECK(r.round_trips_s.front() - clean.report(1).round_trips_s.front() ==
        doctest::Approx(0.01).epsilon(0.2));
}

TEST_CASE("a sensor that is not there is null, and not zero") {
  Board board;
  board.firmware.inputs.mag_works = false;
  const nlohmann::json j = board_json(board.report(2));
  CHECK(j["streams"]["magnetometer"].is_null());
  CHECK_FALSE(j["noise"].contains("mag_x_tesla"));
  CHECK(j["streams"]["barometer"]["rate_hz"].get<double>() == doctest::Approx(50).epsilon(0.05));
}

TEST_CASE("the report is kept in a file, and one that is there is kept too") {
  const std::string file = (std::filesystem::temp_directory_path() / "fulmar_board.json").string();
  std::filesystem::remove(file);
  Board board;
  Client client = board.client();
  client.connect();
  BenchOptions what;
  what.file = file;
  what.seconds = 1;
  const Captured out([&] { return bench_command(client, {}, what); });
  CHECK(out.code == 0);
  CHECK(out.says("| inertial | 400"));
  std::ifstream in(file);
  const nlohmann::json j = nlohmann::json::parse(in);
  CHECK(j["version"].get<std::string>().find("v2.0.1") == 0);
  CHECK(j["link"]["frames"].get<int>() > 1000);
  CHECK_THROWS_AS(bench_command(client, {}, what), Error);
  std::filesystem::remove(file);
}

}  // namespace board_bench_test
