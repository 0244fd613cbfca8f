// SPDX-License-Identifier: BSD-3-Clause
// One connection: a plain HTTP request, or a client of the live protocol.
#pragma once
#include <cstddef>
#include <functional>
#include <memory>
#include <set>

#include "core/live/hub.hpp"
#include "core/live/websocket.hpp"

namespace fulmar::core::live {

class Session {
 public:
  virtual ~Session() = default;
  /// Sends what waits, then says good-bye.
  virtual void finish() = 0;
  /// Ends at once.
  virtual void cut() = 0;
};

/// What all connections share. Outlives them.
struct Context {
  const LiveOptions& options;
  Hub& hub;
  Counters& counters;
  std::string page;              // GET /
  std::function<void()> joined;  // a client has come
  std::set<Session*> sessions;
};

/// Lives as long as it has something to wait for.
void begin_session(ServerEnd end, Loop& loop, Context& context);

}  // namespace fulmar::core::live
