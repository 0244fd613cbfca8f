// SPDX-License-Identifier: BSD-3-Clause
// Mutated sentences: for any input, a published sample satisfies the rules of its message.
#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <vector>

#include "fulmar/random.hpp"
#include "plugins/nmea_gnss/epochs.hpp"
#include "sentences.hpp"

namespace fuzz_test {

using namespace fulmar;
using namespace fulmar::nmea;

namespace {

const std::vector<std::string> bodies{"GPGGA,123519,4807.038,N,01131.000,E,1,08,0.9,545.4,M,46.9,M,,",
                                      "GPRMC,123519,A,4807.038,N,01131.000,E,022.4,084.4,230394,003.1,W",
                                      "GPVTG,054.7,T,034.4,M,005.5,N,010.2,K",
                                      "GPGSA,A,3,04,05,,09,12,,,24,,,,,2.5,1.3,2.1",
                                      "GPGST,123519,0.006,0.023,0.020,273.6,0.023,0.020,0.031"};

std::string mutated(std::string text, Random& random) {
  const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random.bits() % n); };
  const std::string spice = "0123456789.,-NSEWAVnaif*$+e";
  for (std::size_t i = 0, n = below(4); i < n && !text.empty(); ++i) {
    const std::size_t at = below(text.size());
    switch (below(5)) {
      case 0: text[at] = static_cast<char>(random.bits()); break;
      case 1: text[at] = spice[below(spice.size())]; break;
      case 2: text.erase(at, 1 + below(8)); break;
      case 3: text.insert(at, std::string(1 + below(300), spice[below(spice.size())])); break;
      default: text.insert(at, text.substr(below(text.size())));
    }
  }
  return text;
}

bool keeps_its_promises(const Gnss& g) {
  const bool finite = std::isfinite(g.latitude_deg) && std::isfinite(g.longitude_deg) &&
                      std::isfinite(g.altitude_m) && std::isfinite(g.velocity_mps.north) &&
                      std::isfinite(g.velocity_mps.east) && std::isfinite(g.velocity_mps.down);
  const bool placed = std::abs(g.latitude_deg) <= 90 && std::abs(g.longitude_deg) <= 180 &&
                      g.altitude_m >= -1e4 && g.altitude_m <= 1e6;
  const bool known = g.horizontal_std_m >= 0 && g.horizontal_std_m <= unknown_std && g.vertical_std_m >= 0 &&
                     g.vertical_std_m <= unknown_std && g.utc_ns >= 0 && g.fix <= FixType::rtk_fixed;
  return finite && placed && known;
}

}  // namespace

TEST_CASE(
    "no mutation of the sentences crashes the reader or makes it break a promise, with and without a right "
    "checksum") {
  Random random(7);
  Lines lines;
  Epochs epochs;
  int emitted = 0, broken = 0;
  const auto emit = [&](const Gnss& g) {
    ++emitted;
    if (!keeps_its_promises(g)) ++broken;
  };
  for (int i = 0; i < 200000; ++i) {
    std::string body = bodies[random.bits() % bodies.size()];
    if (const std::size_t at = body.find("123519"); at != std::string::npos)
      body.replace(at + 4, 2, std::to_string(10 + i / 8 % 50));
    const std::string text =
        random.bits() % 2 ? framed(mutated(body, random)) : mutated(framed(body), random);
    for (const char c : text) {
      if (const Sentence* s = lines.push(c)) epochs.take(*s, emit);
    }
    if (random.bits() % 16 == 0) epochs.flush(emit);
  }
  CHECK(broken == 0);
  CHECK(emitted > 10000);
  CHECK(lines.good() > 50000);
  CHECK(lines.bad() > 10000);
}

}  // namespace fuzz_test
