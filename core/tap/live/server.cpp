// SPDX-License-Identifier: BSD-3-Clause
// See server.hpp. One thread listens, speaks to all clients and empties the tap; nobody waits for it.
#include "core/tap/live/server.hpp"

#include <pthread.h>
#include <signal.h>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <chrono>
#include <thread>

#include "core/tap/live/gate.hpp"
#include "core/tap/live/page.hpp"
#include "core/tap/live/session.hpp"

namespace fulmar::core {
namespace {

namespace net = boost::asio;
using boost::system::error_code;
using net::ip::tcp;
using std::chrono::milliseconds;

constexpr milliseconds turn{5}, idle_turn{50}, accept_pause{100}, farewell_limit{1500};
constexpr std::size_t most_connections = 64;

net::ip::address address_of(const std::string& host) {
  error_code ec;
  const std::string bare = host.starts_with('[') && host.ends_with(']') ? host.substr(1, host.size() - 2) : host;
  const net::ip::address address = net::ip::make_address(bare == "localhost" ? "127.0.0.1" : bare, ec);
  if (ec)
    throw Error("live.listen: '" + host +
                "' is no address. Valid: 127.0.0.1 (this computer alone), 0.0.0.0 (all), or one of this computer's.");
  return address;
}

}  // namespace

struct LiveServer::Impl {
  // Connections die with `io`, and speak to `hub` and `context` when they do.
  LiveOptions options;
  live::Counters counters;
  live::Hub hub;
  live::Context context;
  net::io_context io{1};
  tcp::acceptor acceptor{io};
  net::steady_timer timer{io}, accept_timer{io}, farewell{io};
  bool stopping = false;
  std::uint16_t port = 0;
  std::thread thread;

  Impl(Tap& tap, Control& control, const LiveOptions& o)
      : options(checked(o)),
        hub(tap, control, counters),
        context{options, hub, counters, live::page(hub.mission(), tap), [this] { pump(); }, {}} {
    hub.begin([this] { net::post(io, [this] { hub.answers(); }); });
    listen();
    accept();
    pump();
    start();
  }

  ~Impl() {
    net::post(io, [this] { stop(); });
    thread.join();
    hub.close();
  }

  static const LiveOptions& checked(const LiveOptions& options) {
    live::check_options(options);
    return options;
  }

  void listen() {
    const tcp::endpoint at(address_of(options.host), options.port);
    const auto refuse = [&](const error_code& ec) {
      const std::string where = options.host + ":" + std::to_string(options.port);
      const bool taken = ec == net::error::address_in_use;
      throw Error(
          "live: cannot listen on " + where + ": " + ec.message() +
          (taken ? ". Another flight may have the port: stop it, or give this one another with live.listen (port 0: any that is free)."
                 : ". Give an address of this computer with live.listen."));
    };
    error_code ec;
    acceptor.open(at.protocol(), ec);
    if (!ec) acceptor.set_option(tcp::acceptor::reuse_address(true), ec);
    if (!ec) acceptor.bind(at, ec);
    if (!ec) acceptor.listen(net::socket_base::max_listen_connections, ec);
    if (ec) refuse(ec);
    port = acceptor.local_endpoint().port();
  }

  void accept() {
    acceptor.async_accept([this](error_code ec, tcp::socket socket) {
      if (stopping) return;
      if (!ec && context.sessions.size() < most_connections) {
        live::begin_session(std::move(socket), context);
      } else {
        ++counters.refused;
      }
      if (!ec) return accept();
      accept_timer.expires_after(accept_pause);  // out of file descriptors, most likely
      accept_timer.async_wait([this](error_code stopped) {
        if (!stopped) accept();
      });
    });
  }

  /// The thread takes no signal: they are for the main thread.
  void start() {
    sigset_t all, before;
    sigfillset(&all);
    pthread_sigmask(SIG_SETMASK, &all, &before);
    thread = std::thread([this] { run(); });
    pthread_setname_np(thread.native_handle(), "fulmar-live");
    pthread_sigmask(SIG_SETMASK, &before, nullptr);
  }

  /// What goes wrong with one connection (no memory, an option that the system refuses) ends that connection alone.
  void run() {
    for (;;) {
      try {
        io.run();
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
    timer.expires_after(after);
    timer.async_wait([this](error_code ec) {
      if (ec || stopping) return;
      const bool more = hub.tick();
      next_turn(more ? milliseconds(0) : hub.clients() > 0 ? turn : idle_turn);
    });
  }

  void stop() {
    stopping = true;
    error_code ignored;
    acceptor.close(ignored);
    timer.cancel();
    accept_timer.cancel();
    while (hub.tick()) {
    }
    const std::set<live::Session*> all = context.sessions;
    for (live::Session* session : all) session->finish();
    farewell.expires_after(farewell_limit);
    farewell.async_wait([this](error_code ec) {
      if (!ec) io.stop();
    });
    wait_for_sessions();
  }

  void wait_for_sessions() {
    if (context.sessions.empty()) return void(farewell.cancel());
    timer.expires_after(turn);
    timer.async_wait([this](error_code) { wait_for_sessions(); });
  }
};

LiveServer::LiveServer(Tap& tap, Control& control, const LiveOptions& options) : impl_(std::make_unique<Impl>(tap, control, options)) {}
LiveServer::~LiveServer() = default;
std::uint16_t LiveServer::port() const { return impl_->port; }
LiveStats LiveServer::stats() const {
  const live::Counters& c = impl_->counters;
  return {c.clients, c.sent, c.dropped, c.lost, c.refused};
}

}  // namespace fulmar::core
