// SPDX-License-Identifier: BSD-3-Clause
// See server.hpp. One thread listens, speaks to all clients and empties the tap; nobody waits for it.
#include "core/live/server.hpp"

#include <pthread.h>
#include <signal.h>

#include <chrono>
#include <thread>

#include "core/live/gate.hpp"
#include "core/live/page.hpp"
#include "core/live/session.hpp"
#include "core/live/websocket.hpp"
#include "core/quiet_thread.hpp"

namespace fulmar::core {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds turn{5}, idle_turn{50}, accept_pause{100}, farewell_limit{1500};
constexpr std::size_t most_connections = 64;

std::string address_of(const std::string& host) {
  const std::string bare =
      host.starts_with('[') && host.ends_with(']') ? host.substr(1, host.size() - 2) : host;
  const std::string address = bare == "localhost" ? "127.0.0.1" : bare;
  if (!live::Listener::is_address(address))
    throw Error(
        "live.listen: '" + host +
        "' is no address. Valid: 127.0.0.1 (this computer alone), 0.0.0.0 (all), or one of this computer's.");
  return address;
}

}  // namespace

struct LiveServer::Impl {
  // Connections die with `loop`, and speak to `hub` and `context` when they do.
  LiveOptions options;
  live::Counters counters;
  live::Hub hub;
  live::Context context;
  live::Loop loop;
  live::Listener listener{loop};
  live::Timer timer{loop}, accept_timer{loop}, farewell{loop};
  bool stopping = false;
  std::uint16_t port = 0;
  std::thread thread;

  Impl(Tap& tap, Control& control, const LiveOptions& o)
      : options(checked(o)),
        hub(tap, control, counters),
        context{options, hub, counters, live::page(hub.mission(), tap), [this] { pump(); }, {}} {
    hub.begin([this] { loop.post([this] { hub.answers(); }); });
    listen();
    accept();
    pump();
    start();
  }

  ~Impl() {
    loop.post([this] { stop(); });
    thread.join();
    hub.close();
  }

  static const LiveOptions& checked(const LiveOptions& options) {
    live::check_options(options);
    return options;
  }

  void listen() {
    if (const auto refusal = listener.listen(address_of(options.host), options.port)) {
      const std::string where = options.host + ":" + std::to_string(options.port);
      throw Error("live: cannot listen on " + where + ": " + refusal->why +
                  (refusal->taken ? ". Another flight may have the port: stop it, or give this one another "
                                    "with live.listen (port 0: any that is "
                                    "free)."
                                  : ". Give an address of this computer with live.listen."));
    }
    port = listener.port();
  }

  void accept() {
    listener.accept([this](std::optional<live::ServerEnd> end) {
      if (stopping) return;
      const bool given = end.has_value();
      if (given && context.sessions.size() < most_connections) {
        live::begin_session(*std::move(end), loop, context);
      } else {
        ++counters.refused;
      }
      if (given) return accept();
      accept_timer.start(accept_pause, [this](bool due) {  // out of file descriptors, most likely
        if (due) accept();
      });
    });
  }

  void start() {
    thread = quiet_thread("fulmar-live", [this] { run(); });
  }

  /// What goes wrong with one connection (no memory, an option that the system refuses) ends that connection
  /// alone.
  void run() {
    for (;;) {
      try {
        loop.run();
        return;
      } catch (const std::exception&) {
        ++counters.refused;
      }
    }
  }

  /// Slowly as long as there are no clients.
  void pump() {
    if (!stopping) next_turn(milliseconds(0));
  }

  /// In place of the one that was to be next.
  void next_turn(milliseconds after) {
    timer.start(after, [this](bool due) {
      if (!due || stopping) return;
      const bool more = hub.tick();
      next_turn(more ? milliseconds(0) : hub.clients() > 0 ? turn : idle_turn);
    });
  }

  void stop() {
    stopping = true;
    listener.close();
    timer.cancel();
    accept_timer.cancel();
    while (hub.tick()) {
    }
    const std::set<live::Session*> all = context.sessions;
    for (live::Session* session : all) session->finish();
    farewell.start(farewell_limit, [this](bool due) {
      if (due) loop.stop();
    });
    wait_for_sessions();
  }

  void wait_for_sessions() {
    if (context.sessions.empty()) return void(farewell.cancel());
    timer.start(turn, [this](bool) { wait_for_sessions(); });
  }
};

LiveServer::LiveServer(Tap& tap, Control& control, const LiveOptions& options)
    : impl_(std::make_unique<Impl>(tap, control, options)) {}
LiveServer::~LiveServer() = default;
std::uint16_t LiveServer::port() const { return impl_->port; }
LiveStats LiveServer::stats() const {
  const live::Counters& c = impl_->counters;
  return {c.clients, c.sent, c.dropped, c.lost, c.refused};
}

}  // namespace fulmar::core
