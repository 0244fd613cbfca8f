// SPDX-License-Identifier: BSD-3-Clause
// tap_sample_log FILE: writes a log with known values and prints its expected content as one JSON object.
// Topic by topic: the messages in order, each {log_ns, publish_ns, sequence, value}; times as text, for
// readers without 64-bit integers.
#include <exception>
#include <iostream>
#include <nlohmann/json.hpp>
#include <random>

#include "core/log/test/read_mcap.hpp"
#include "core/tap/test/taped_log.hpp"
#include "core/types/test/types.hpp"
#include "core/types/wire.hpp"

using namespace fulmar::core;
using namespace fulmar::core::test;

namespace {

struct Empty {
  char nothing;
};
struct Tail {
  Items<double, 5> list;
  bool last;
};

std::vector<TapChannel> channels() {
  return {{"/mixed", mixed_type()},
          {"/empty", make_type("Empty", 1, 1, {})},
          {"/tail",
           make_type("Tail", sizeof(Tail), 8,
                     {list(number("list", 0), 5, 8), scalar("last", FULMAR_BOOL, offsetof(Tail, last), 1)})},
          {"/mixed_too", mixed_type()}};
}

void fly(TapedLog& log) {
  std::mt19937_64 random(7);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 5000; ++i) {
    const std::int64_t now = i * 2'500'000LL - 2'000'000'000LL;
    Mixed m = mixed_value();
    m.speed_mps = normal(random);
    m.stamp_ns = now;
    m.samples_volt.count = static_cast<std::uint32_t>(i % 5);
    for (double& x : m.samples_volt.items) x = normal(random);
    m.legs.count = static_cast<std::uint32_t>(i % 4);
    m.legs.items[2] = m.legs.items[1];
    log.write(i % 7 == 0 ? 3 : 0, now, now - i, bytes_of(m));
    if (i % 10 == 0) {
      const Tail tail{{static_cast<std::uint32_t>(i / 10 % 6), {1, 2, 3, 4, 5}}, i % 20 == 0};
      log.write(2, now, now, bytes_of(tail));
    }
    const Empty empty{};
    if (i % 100 == 0) log.write(1, now, now, bytes_of(empty));
  }
}

/// Content as read by Fulmar's own reader and decoder.
nlohmann::json found(const WholeLog& file, const std::vector<TapChannel>& list) {
  nlohmann::json topics;
  for (const McapFile::Message& m : file.messages) {
    const std::string& topic = file.channels.at(m.channel).topic;
    for (const TapChannel& c : list) {
      if (c.topic != topic) continue;
      std::vector<std::byte> value(c.type->size);
      cdr_decode(*c.type, m.data.data(), m.data.size(), value.data());
      topics[topic].push_back({{"log_ns", std::to_string(m.log_ns)},
                               {"publish_ns", std::to_string(m.publish_ns)},
                               {"sequence", m.sequence},
                               {"value", to_json(*c.type, value.data(), false)}});
    }
  }
  return topics;
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc != 2) throw std::runtime_error("usage: tap_sample_log FILE");
  TapedLog log({.file = argv[1], .epoch_ns = 1'767'225'600'000'000'000}, channels());
  log.attach("mission.yaml", "application/yaml", "mission: sample\n");
  log.metadata("run", {{"seed", "7"}});
  fly(log);
  const LogResult result = log.close();
  if (!result.error.empty()) throw std::runtime_error(result.error);
  std::cout << found(read_mcap(result.file), channels()) << "\n";
  return 0;
} catch (const std::exception& e) {
  std::cerr << e.what() << "\n";
  return 1;
}
