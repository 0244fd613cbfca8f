// SPDX-License-Identifier: BSD-3-Clause
// The first seconds with a device: its recognition.
#include <doctest/doctest.h>

#include <cmath>

#include "lossy_port.hpp"
#include "tools/fulmar_fcu/status.hpp"

namespace connect_test {

namespace {

using namespace fulmar::fcu;
using fulmar::fcu::test::Bench;

/// A device that sends the same bytes a hundred times a second.
class Talker final : public Port {
 public:
  Talker(std::int64_t& now_us, std::string says) : now_us_(now_us), says_(std::move(says)) {}
  std::size_t read(std::span<std::uint8_t> room, int timeout_ms) override {
    now_us_ += 1000 * timeout_ms;
    const std::size_t n = std::min(room.size(), says_.size());
    std::copy_n(says_.begin(), n, room.begin());
    return n;
  }
  bool write(std::span<const std::uint8_t>) noexcept override { return true; }
  int descriptor() const noexcept override { return -1; }

 private:
  std::int64_t& now_us_;
  std::string says_;
};

std::string complaint_about(const std::string& says) {
  std::int64_t now_us = 0;
  Client client({"/dev/ttyUSB3", [&] { return std::make_unique<Talker>(now_us, says); },
                 [&] { return now_us * 1000; }});
  std::string complaint;
  try {
    client.connect();
  } catch (const Error& e) {
    complaint = e.what();
  }
  CHECK(now_us < 5'000'000);
  return complaint;
}

bool holds(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST_CASE("a device that is no flight controller is told in one sentence within 5 s") {
  CHECK(holds(complaint_about(""), "fcu.port_silent(/dev/ttyUSB3)"));
  CHECK(holds(complaint_about("$GNGGA,123519,4807.038,N,01131.000,E,1,08,0.9,545.4,M,46.9,M,,*47\r\n"),
              "fcu.text_received(/dev/ttyUSB3)"));
  fulmar::Random random(2);
  std::string noise;
  for (int i = 0; i < 3000; ++i) noise += static_cast<char>(static_cast<int>(random.uniform() * 256));
  CHECK(holds(complaint_about(noise), "fcu.protocol_unknown(/dev/ttyUSB3, "));
  std::string modern;
  for (int i = 0; i < 40; ++i)
    modern += '\xfd' + std::string("\x09\x00\x00\x01\x01\x01\x00\x00\x00", 9) + std::string(14, 'x');
  CHECK(holds(complaint_about(modern), "fcu.mavlink_version_unsupported(/dev/ttyUSB3)"));
  const Frame beat = encode(Heartbeat{}, 1);
  CHECK(holds(
      complaint_about({beat.bytes.begin(), beat.bytes.begin() + static_cast<std::ptrdiff_t>(beat.size)}),
      "fcu.rosflight_status_missing(/dev/ttyUSB3, 200)"));
}

TEST_CASE("an old firmware is told by its version") {
  peer::Options options;
  options.version = "v1.4.2-3-gabc";
  Bench bench(options);
  Client client = bench.client();
  CHECK_THROWS_WITH(client.connect(), doctest::Contains("fcu.firmware_too_old(/dev/ttyACM0, v1.4.2-3-gabc)"));
  CHECK(bench.now_us < 5'000'000);
}

TEST_CASE("a controller that streams but does not answer is told") {
  peer::Options options;
  options.answers = false;
  Bench bench(options);
  Client client = bench.client();
  CHECK_THROWS_WITH(client.connect(), doctest::Contains("fcu.version_not_reported(/dev/ttyACM0)"));
  CHECK(bench.now_us < 5'000'000);
}

TEST_CASE("the version ends at its first NUL, whatever stands behind") {
  Bench bench;
  Client client = bench.client();
  client.connect();
  CHECK(client.version() == "v2.0.1-0-ge8cf6a0f");
}

TEST_CASE("a build without a tag is taken as it is") {
  peer::Options options;
  options.version = "e8cf6a0";
  Bench bench(options);
  Client client = bench.client();
  client.connect();
  CHECK(client.version() == "e8cf6a0");
}

TEST_CASE("an answer without a version is an answer") {
  peer::Options options;
  options.version = "";
  Bench bench(options);
  Client client = bench.client();
  client.connect();
  CHECK(client.version() == "without a version");
}

TEST_CASE("an attitude that is not a number is told in words") {
  std::string says;
  AttitudeQuaternion q;
  q.q1 = std::nanf("");
  for (const Frame& f : {encode(RosflightStatus{}, 1), encode(q, 2)})
    says.append(f.bytes.begin(), f.bytes.begin() + static_cast<std::ptrdiff_t>(f.size));
  std::int64_t now_us = 0;
  Client client({"/dev/ttyUSB3", [&] { return std::make_unique<Talker>(now_us, says); },
                 [&] { return now_us * 1000; }});
  const Meter meter(client);
  client.pump(200 * ms);
  const std::string text = status_text(client, meter);
  CHECK(holds(text, "attitude     fcu.attitude_not_finite"));
  CHECK_FALSE(holds(text, "nan"));
  CHECK_FALSE(holds(status_json(client, meter), "\"attitude\""));
}

TEST_CASE("frames that come twice are not taken for lost ones") {
  Bench bench;
  bench.faults.duplicate = 1;
  Client client = bench.client();
  client.connect();
  CHECK(client.counts().frames > 300);
  CHECK(client.counts().missing == 0);
}

TEST_CASE("an armed controller, and one that refuses to tell its version, are met all the same") {
  Bench bench;
  bench.firmware.provision();
  bench.firmware.inputs.rc_us = {1500, 1500, 1000, 1500, 2000, 2000, 1000, 1000};
  bench.idle(13'000'000);
  REQUIRE(bench.firmware.armed());
  Client armed = bench.client();
  armed.connect();
  CHECK(armed.version() == "");
  CHECK(armed.armed());
  peer::Options options;
  options.refuses = true;
  Bench other(options);
  Client refused = other.client();
  refused.connect();
  CHECK_FALSE(refused.armed());
  CHECK_THROWS_WITH(refused.demand(Command::write_params, "writing"),
                    "fcu.action_refused(writing,  and gave no reason.)");
}

TEST_CASE("the controller's own system id is used for what it compares with it") {
  Bench bench;
  bench.firmware.params().set(peer::param("SYS_ID"), 42);
  Client client = bench.client();
  client.connect();
  CHECK(client.system() == 42);
}

TEST_CASE("the round trip is measured on the line") {
  Bench bench;
  bench.faults.delay_us = 3000;
  Client client = bench.client();
  client.connect();
  const auto ns = client.round_trip_ns();
  REQUIRE(ns);
  CHECK(static_cast<double>(*ns) * 1e-6 ==
        doctest::Approx(6).epsilon(0.25));  // ms, there and back; steps of half one
}

}  // namespace

}  // namespace connect_test
