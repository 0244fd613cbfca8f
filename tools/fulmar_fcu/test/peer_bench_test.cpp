// SPDX-License-Identifier: BSD-3-Clause
// `fulmar fcu bench` with the peer, as two programs with a pseudo-terminal in between: its file holds the
// properties of the peer.
#include <doctest/doctest.h>

#include <nlohmann/json.hpp>

#include "core/app/test/hil.hpp"

namespace peer_bench_test {

namespace {

using fulmar::fcu::testing::nap;
using fulmar::fcu::testing::Process;
namespace fs = std::filesystem;

/// The report's file of a peer with these options.
nlohmann::json measured(const std::vector<std::string>& options, const std::string& seconds) {
  const fs::path folder = fs::temp_directory_path() / ("fulmar-peer-bench-" + std::to_string(getpid()));
  fs::create_directories(folder);
  const std::string link = (folder / "fcu").string(), file = (folder / "board.json").string();
  std::vector<std::string> words{FULMAR_BIN_DIR "/fcu_peer",
                                 "--link",
                                 link,
                                 "--seed",
                                 "5",
                                 "--wind",
                                 "0",  // no gust on the pitot of a standing aircraft
                                 "0",
                                 "0",
                                 "--turbulence",
                                 "none"};
  words.insert(words.end(), options.begin(), options.end());
  Process peer(words, folder / "peer.out", folder / "peer.err");
  for (int i = 0; i < 250 && !fs::exists(link); ++i) nap(0.02);
  Process bench({FULMAR_BIN_DIR "/fulmar-fcu", "--port", link, "bench", file, "--seconds", seconds},
                folder / "bench.out", folder / "bench.err");
  CHECK(bench.wait(60) == 0);
  CAPTURE(bench.err());
  std::ifstream in(file);
  const nlohmann::json report = nlohmann::json::parse(in, nullptr, false);
  fs::remove_all(folder);
  REQUIRE(report.is_object());
  return report;
}

double rate_hz(const nlohmann::json& report, const char* stream) {
  return report.at("streams").at(stream).at("rate_hz").get<double>();
}
/// Seconds of the controller's clock per second of the report: below 1 when the machine delayed the peer.
double pace(const nlohmann::json& report, double imu_hz, double seconds) {
  const double came = report.at("noise").at("accel_x_mps2").at("samples");
  return (came + report.at("link").at("imu_lost").get<double>()) / (imu_hz * seconds);
}
double std_of(const nlohmann::json& report, const char* channel) {
  return report.at("noise").at(channel).at("std").get<double>();
}

}  // namespace

TEST_CASE("rates, noise and delay in the report's file are those of the peer") {
  const nlohmann::json r =
      measured({"--imu-rate", "125", "--gnss-rate", "5", "--delay", "6", "--no-mag"}, "3");
  const nlohmann::json& link = r.at("link");
  // A machine that does not let the reader run for a while loses frames; the clock of the samples counts
  // them.
  const double came = r.at("noise").at("accel_x_mps2").at("samples"), lost = link.at("imu_lost");
  const double arrives = came / (came + lost);
  CHECK(arrives > 0.5);
  const double ran = arrives * pace(r, 125, 3);
  CHECK(ran < 1.05);
  CHECK(rate_hz(r, "inertial") == doctest::Approx(125 * ran).epsilon(0.03));
  CHECK(rate_hz(r, "gnss") == doctest::Approx(5 * ran).epsilon(0.1));
  CHECK(rate_hz(r, "barometer") == doctest::Approx(50 * ran).epsilon(0.05));
  CHECK(rate_hz(r, "pitot") == doctest::Approx(100 * ran).epsilon(0.05));
  CHECK(r.at("streams").at("magnetometer").is_null());
  // White noise of rosflight_sim's sensors: 0.2 m/s2, 4 Pa, 1.15 Pa.
  CHECK(std_of(r, "accel_x_mps2") == doctest::Approx(0.2).epsilon(0.15));
  CHECK(std_of(r, "accel_z_mps2") == doctest::Approx(0.2).epsilon(0.15));
  CHECK(std_of(r, "barometer_pa") == doctest::Approx(4).epsilon(0.3));
  CHECK(std_of(r, "pitot_pa") == doctest::Approx(1.15).epsilon(0.2));
  CHECK(std_of(r, "battery_volt") < 0.1);
  // There and back; a busy machine delays some of them, and not the quickest.
  CHECK(link.at("round_trip_s").at("least").get<double>() >= 0.012);
  CHECK(link.at("round_trip_s").at("least").get<double>() < 0.018);
}

TEST_CASE("losses and damage in the report's file are those of the peer") {
  const nlohmann::json r = measured({"--imu-rate", "125", "--loss", "0.1", "--corrupt", "0.05"}, "3");
  const nlohmann::json& link = r.at("link");
  const double frames = link.at("frames"), missing = link.at("missing"), bad = link.at("bad");
  const double sent = frames + missing, arrives = 0.9 * 0.95, imu_hz = 125 * pace(r, 125, 3);
  CHECK(imu_hz < 1.05 * 125);
  CHECK(missing / sent == doctest::Approx(1 - arrives).epsilon(0.25));
  CHECK(bad / sent == doctest::Approx(0.9 * 0.05).epsilon(0.4));
  CHECK(rate_hz(r, "inertial") == doctest::Approx(imu_hz * arrives).epsilon(0.1));
  CHECK(link.at("imu_lost").get<double>() == doctest::Approx(imu_hz * 3 * (1 - arrives)).epsilon(0.5));
  CHECK(link.at("imu_gap_s").get<double>() >= 0.016);
  // Question and answer both have to arrive, 100 times; four deviations either way.
  const double unanswered = link.at("unanswered"), expected = 100 * (1 - arrives * arrives);
  CHECK(std::abs(unanswered - expected) < 4 * std::sqrt(expected * arrives * arrives));
}

}  // namespace peer_bench_test
