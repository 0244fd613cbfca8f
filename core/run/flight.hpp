// SPDX-License-Identifier: BSD-3-Clause
// One flight: creates the components of a graph, runs the loop, and returns the result.
#pragma once
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "core/graph/graph.hpp"
#include "core/run/state/flight_types.hpp"

namespace fulmar::core {

class Flight {
 public:
  /// Creates and configures every component. Throws Error.
  Flight(const Graph& graph, const FlightOptions& options);
  ~Flight();
  Flight(const Flight&) = delete;
  Flight& operator=(const Flight&) = delete;

  /// Flies until done, failed, interrupted or out of time. Call once.
  FlightResult run();
  /// Alternative, tick by tick: one tick, paced by the options; false when the flight is over. Then `finish`,
  /// once.
  bool step();
  FlightResult finish();

  /// Whether it ended for another flight of its mission.
  const std::optional<Restart>& restart() const;

  // For observers of a flight: between ticks, from the loop's thread.
  std::int64_t now_ns() const;
  const std::string& phase() const;
  bool paused() const;
  /// The present sample of a port, or nullptr.
  const std::byte* sample(const Source& source) const;

  /// Applies a command from outside, between ticks. Throws Error with the valid choices. For a request the
  /// component's answer comes through `answered`: "" when accepted, else the reason.
  void apply(struct Command command, std::function<void(const std::string&)> answered = {});
  /// The recorded last inputs of a component, nullptr when they are not kept.
  const class Tape* tape(const std::string& component) const;
  /// Interface of a flight for other threads, when it has `live:` or `dds:` and is paced; else nullptr.
  class Control* control() const;
  /// The port of the live view; 0: none.
  std::uint16_t live_port() const;

  struct Impl;

 private:
  std::unique_ptr<Impl> impl_;
};

}  // namespace fulmar::core
