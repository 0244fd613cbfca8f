// SPDX-License-Identifier: BSD-3-Clause
// Two threads beside those of Fast DDS: one sends the samples of the loop, one takes the input.
#include <atomic>
#include <chrono>
#include <thread>

#include "core/build.hpp"
#include "core/error.hpp"
#include "fulmar/quiet_thread.hpp"
#include "links/dds/library.hpp"
#include "links/dds/services.hpp"
#include "links/dds/topics.hpp"

namespace fulmar::core {
namespace {

// of the sending thread when the ring is empty; the loop never has the cost of a wake-up
constexpr std::chrono::milliseconds nap{2};
// between two polls of the input: a flood must not use a whole processor
constexpr std::chrono::milliseconds breath{2};
constexpr std::chrono::milliseconds longest{50};  // sleep of the receiving thread

struct Bridge final : DdsBridge {
  DdsOptions options;
  DdsHost::Say say;
  std::shared_ptr<dds::Waker> waker = std::make_shared<dds::Waker>();
  dds::Others others;
  std::unique_ptr<dds::Participant> owner;  // made after the topics, destroyed after them
  dds::Exports exports;
  dds::Imports imports;
  dds::Servers servers;
  std::unique_ptr<dds::ParameterEvents> events;
  std::unique_ptr<dds::Writer> node;
  std::atomic<bool> stop{false};
  std::thread sender, taker;

  Bridge(const DdsHost& host, const FlightView& view, const DdsOptions& o)
      : options(o),
        say(host.say),
        others(host.say),
        exports(host.tap, options, others),
        imports(host, view, options, others) {
    Control& control = host.control;
    owner = std::make_unique<dds::Participant>(
        options, [this](const std::string& topic, const std::string& type, bool writer, bool best_effort) {
          others.found(topic, type, writer, best_effort);
        });
    dds::Participant& participant = *owner;
    exports.open(participant);
    imports.open(participant, *waker);
    if (options.services) add_request_services(servers, participant, options, control, view, waker);
    if (options.parameters) {
      add_parameter_services(servers, participant, options, control, waker);
      events = std::make_unique<dds::ParameterEvents>(participant, options, control, waker);
    }
    std::vector<dds::Guid> readers = imports.readers(), writers = exports.writers();
    for (const auto& server : servers) {
      readers.push_back(server->reader().guid());
      writers.push_back(server->writer().guid());
    }
    if (events) writers.push_back(events->writer().guid());
    node = node_info(participant, options, readers, writers);
    sender = start("fulmar-dds-out", &Bridge::send);
    taker = start("fulmar-dds-in", &Bridge::take);
  }

  DdsStats stats() const override;

  ~Bridge() override {
    stop.store(true);
    waker->wake();
    if (sender.joinable()) sender.join();
    if (taker.joinable()) taker.join();
  }

  /// A fault in the thread must not end the flight.
  std::thread start(const char* name, void (Bridge::*work)()) {
    return quiet_thread(name, [this, work] {
      try {
        (this->*work)();
      } catch (const std::exception& e) {
        say(std::string("dds ends early: ") + e.what(), Tone::error);
      }
    });
  }

  void send() {
    while (!stop.load(std::memory_order_relaxed)) {
      exports.pump();
      std::this_thread::sleep_for(nap);
    }
    exports.pump();
  }

  void take() {
    bool all = true;
    while (!stop.load(std::memory_order_relaxed)) {
      if (all) waker->wait(longest);
      all = imports.pump(*owner, *waker);
      for (const auto& server : servers) all = server->serve() && !server->waiting() && all;
      if (events) events->pump();
      std::this_thread::sleep_for(breath);
    }
  }
};

DdsStats Bridge::stats() const {
  DdsStats stats;
  stats.sent = exports.sent();
  stats.lost = exports.lost();
  for (const auto& server : servers) {
    stats.requests += server->taken();
    stats.refused += server->refused();
  }
  stats.imports = imports.stats();
  for (const DdsStats::Import& i : stats.imports) {
    stats.received += i.received;
    stats.refused += i.refused;
    stats.lost += i.lost;
  }
  return stats;
}

std::unique_ptr<DdsBridge> open_bridge(const DdsHost& host, const DdsOptions& options) {
  const NoSignals quiet;
  return std::make_unique<Bridge>(host, host.control.view(), options);
}

}  // namespace
}  // namespace fulmar::core

const fulmar::core::DdsLibrary fulmar_dds_library{fulmar::core::build_identity, fulmar::core::open_bridge};
