// SPDX-License-Identifier: BSD-3-Clause
// One thread listens, serves all clients and empties the tap; no other thread waits for it.
#include "links/live/server.hpp"

#include <thread>

#include "core/build.hpp"
#include "core/graph/live_options.hpp"
#include "fulmar/quiet_thread.hpp"
#include "links/live/connection.hpp"
#include "links/live/messages.hpp"

namespace fulmar::core {
namespace {

using live::error_code;
using std::chrono::milliseconds;
namespace net = boost::asio;

constexpr milliseconds turn{5}, idle_turn{50}, accept_pause{100}, farewell_limit{1500};
constexpr std::size_t max_connections = 64;

net::ip::address address_of(const std::string& host) {
  const std::string bare =
      host.starts_with('[') && host.ends_with(']') ? host.substr(1, host.size() - 2) : host;
  error_code fault;
  const auto address = net::ip::make_address(bare == "localhost" ? "127.0.0.1" : bare, fault);
  if (fault) throw Error(live_messages::listen_address_invalid(host));
  return address;
}

}  // namespace

struct LiveServer::Impl {
  // Connections end with `io` and use `hub` and `context` at their end.
  LiveOptions options;
  live::Counters counters;
  live::Hub hub;
  live::Context context;
  net::io_context io{1};
  live::tcp::acceptor acceptor{io};
  live::Timer timer{io}, accept_timer{io}, farewell{io};
  bool stopping = false;
  std::uint16_t port = 0;
  std::thread thread;

  Impl(Tap& tap, Control& control, const LiveOptions& o, const std::filesystem::path& folder)
      : options((check_live_options(o), o)),
        hub(tap, control, counters),
        context{options,
                hub,
                counters,
                live::Pages(folder),
                live::page_policy(origin_of(options.tiles)),
                live::topics_page(hub.mission(), tap),
                [this] { pump(); },
                {}} {
    hub.begin([this] { net::post(io, [this] { hub.answers(); }); });
    listen();
    accept();
    pump();
    thread = quiet_thread("fulmar-live", [this] { run(); });
  }

  ~Impl() {
    net::post(io, [this] { stop(); });
    thread.join();
    hub.close();
  }

  void listen() {
    const live::tcp::endpoint at(address_of(options.host), options.port);
    error_code fault;
    acceptor.open(at.protocol(), fault);
    if (!fault) acceptor.set_option(net::socket_base::reuse_address(true), fault);
    if (!fault) acceptor.bind(at, fault);
    if (!fault) acceptor.listen(net::socket_base::max_listen_connections, fault);
    if (fault == net::error::address_in_use)
      throw Error(live_messages::port_in_use(options.host, options.port));
    if (fault) throw Error(live_messages::listen_failed(options.host, options.port, fault.message()));
    port = acceptor.local_endpoint().port();
  }

  void accept() {
    acceptor.async_accept([this](error_code fault, live::tcp::socket socket) {
      if (stopping) return;
      if (!fault && context.connections.size() >= max_connections) live::Connection::make_room(context);
      if (!fault &&
          context.connections.size() < 2 * max_connections) {  // a closed one is removed a little later
        std::make_shared<live::Connection>(std::move(socket), io, context)->begin();
      } else {
        ++counters.refused;
      }
      if (!fault) return accept();
      accept_timer.start(accept_pause, [this](bool due) {  // probably out of file descriptors
        if (due) accept();
      });
    });
  }

  /// A fault of one connection (no memory, an option that the system rejects) ends that connection alone.
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

  /// At a low rate while there are no clients.
  void pump() {
    if (!stopping) next_turn(milliseconds(0));
  }

  /// Replaces the scheduled turn.
  void next_turn(milliseconds after) {
    timer.start(after, [this](bool due) {
      if (!due || stopping) return;
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
    const std::set<live::Connection*> all = context.connections;
    for (live::Connection* connection : all) connection->finish();
    farewell.start(farewell_limit, [this](bool due) {
      if (due) io.stop();
    });
    wait_for_connections();
  }

  void wait_for_connections() {
    if (context.connections.empty()) return farewell.cancel();
    timer.start(turn, [this](bool) { wait_for_connections(); });
  }
};

LiveServer::LiveServer(Tap& tap, Control& control, const LiveOptions& options,
                       const std::filesystem::path& page)
    : impl_(std::make_unique<Impl>(tap, control, options, page)) {}
LiveServer::~LiveServer() = default;
std::uint16_t LiveServer::port() const { return impl_->port; }
LiveStats LiveServer::stats() const {
  const live::Counters& c = impl_->counters;
  return {c.clients, c.sent, c.dropped, c.lost, c.refused, c.wrong_tokens};
}

namespace {

std::unique_ptr<LiveView> open_view(Tap& tap, Control& control, const LiveOptions& options,
                                    const std::filesystem::path& page) {
  return std::make_unique<LiveServer>(tap, control, options, page);
}

}  // namespace
}  // namespace fulmar::core

const fulmar::core::LiveLibrary fulmar_live_library{fulmar::core::build_identity, fulmar::core::open_view};
