// SPDX-License-Identifier: BSD-3-Clause
// The live view: the Foxglove WebSocket protocol and plain HTTP on one port, in a thread of its own.
#pragma once
#include <cstdint>
#include <filesystem>
#include <memory>

#include "core/graph/graph.hpp"

namespace fulmar::core {

class Control;
class Tap;

struct LiveStats {
  std::uint64_t clients = 0;  // now
  std::uint64_t sent = 0;     // messages
  std::uint64_t dropped = 0;  // messages that a slow client did not get
  std::uint64_t lost = 0;     // samples that this sink was too slow for
  std::uint64_t refused = 0;  // connections and messages that were against the rules
  std::uint64_t wrong_tokens = 0;
};

class LiveServer {
 public:
  /// `page`: the folder of the page that a browser gets; where there is none it gets the table of topics.
  /// Throws Error when it cannot listen there: says who to ask and what to do.
  LiveServer(Tap& tap, Control& control, const LiveOptions& options, const std::filesystem::path& page = {});
  ~LiveServer();
  std::uint16_t port() const;
  LiveStats stats() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace fulmar::core
