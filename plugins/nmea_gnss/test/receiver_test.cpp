// SPDX-License-Identifier: BSD-3-Clause
// The receiver on a pseudo-terminal: a thread at the other end writes sentences in odd pieces, goes away and
// comes back.
#include "plugins/nmea_gnss/receiver.hpp"

#include <doctest/doctest.h>

#include <string>
#include <thread>
#include <vector>

#include "device.hpp"
#include "fulmar/random.hpp"
#include "fulmar/testing.hpp"
#include "sentences.hpp"

namespace receiver_test {

using namespace fulmar;
using namespace fulmar::nmea;

namespace {

void use(Bench<Receiver>& bench, const Device& device) {
  bench.params.port.value = Text<128>(device.path());
  bench.params.baud.value = 38400;
}

/// Samples of at most `steps` steps, until there are `enough`.
std::vector<Gnss> receive(Bench<Receiver>& bench, std::size_t enough, int steps = 400) {
  std::vector<Gnss> all;
  for (int i = 0; i < steps && all.size() < enough; ++i) {
    bench.step(0.05);
    for (std::size_t k = 0; k < bench.out.gnss.count; ++k) {
      CHECK(bench.out.gnss.stamps_ns[k] == FULMAR_ON_ARRIVAL);
      all.push_back(bench.out.gnss.items[k]);
    }
  }
  return all;
}

}  // namespace

TEST_CASE("epochs that come in odd pieces with noise in between arrive complete and in order") {
  Device device;
  device.plug();
  Bench<Receiver> bench;
  use(bench, device);
  CHECK(bench.step(0.05) == Status::ok);  // opens the port: earlier data have an unknown time
  std::thread sender([&] {
    Random random(3);
    for (int s = 0; s < 20; ++s) {
      std::string text = epoch_text(s, 10 + s) + "\xff$GPGGA,garbled*00\r\n";
      while (!text.empty()) {
        const std::size_t n = std::min<std::size_t>(text.size(), 1 + random.bits() % 17);
        device.write(text.substr(0, n));
        text.erase(0, n);
        if (random.bits() % 4 == 0) std::this_thread::sleep_for(std::chrono::microseconds(500));
      }
    }
  });
  const std::vector<Gnss> all = receive(bench, 20);
  sender.join();
  REQUIRE(all.size() == 20);
  for (std::size_t s = 0; s < all.size(); ++s) {
    CHECK(all[s].latitude_deg ==
          doctest::Approx(47 + (17.114 + 1e-4 * static_cast<double>(s)) / 60).epsilon(1e-12));
    CHECK(all[s].velocity_mps.east == doctest::Approx((10.0 + static_cast<double>(s)) * 1852 / 3600));
  }
  CHECK(bench.out.bad_lines_ratio.value >= 19);
}

TEST_CASE(
    "a device that is not there yet, and one that is pulled out, are waited for; an epoch cut by it does not "
    "live on") {
  Device device;
  Bench<Receiver> bench;
  use(bench, device);
  CHECK(bench.step(0.1) == Status::degraded);
  CHECK(bench.out.gnss.count == 0);
  device.plug();
  bench.step(0.1);
  CHECK(bench.step(0.1) == Status::ok);
  device.write(epoch_text(0));
  CHECK(receive(bench, 1).size() == 1);
  const std::string next = epoch_text(1);
  device.write(next.substr(0, next.size() - 20));
  CHECK(receive(bench, 1, 2).empty());
  device.pull();
  CHECK(receive(bench, 1, 3).empty());
  CHECK(bench.step(0.1) == Status::degraded);
  device.plug();
  bench.step(0.1);
  CHECK(bench.step(0.1) == Status::ok);
  device.write(next.substr(next.size() - 20) + epoch_text(7));
  const std::vector<Gnss> all = receive(bench, 1);
  REQUIRE(all.size() == 1);
  CHECK(all[0].utc_ns == 1039435207000000000);  // 2002-12-09 12:00:07
}

TEST_CASE("a port that is not named, is no port, or a rate that no port has is refused in one sentence") {
  Bench<Receiver> bench;
  CHECK(bench.configure() == Status::failed);
  CHECK(bench.error() == "port: nmea_gnss.port_missing");
  bench.params.port.value = "/etc/passwd";
  CHECK(bench.configure() == Status::failed);
  CHECK(bench.error() == "port: nmea_gnss.port_not_serial(/etc/passwd)");
  bench.params.port.value = "/dev/ttyUSB0";
  bench.params.baud.value = 12345;
  CHECK(bench.configure() == Status::failed);
  CHECK(bench.error() == "baud: nmea_gnss.baud_not_valid(12345)");
}

}  // namespace receiver_test
