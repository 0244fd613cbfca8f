// SPDX-License-Identifier: BSD-3-Clause
// `fulmar watch`: a running flight on one screen.
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <memory>
#include <thread>

#include "core/types/text.hpp"
#include "core/types/wire.hpp"
#include "tools/fulmar_live/commands.hpp"
#include "tools/fulmar_live/dashboard.hpp"
#include "tools/fulmar_live/messages.hpp"
#include "tools/fulmar_live/screen.hpp"
#include "tools/fulmar_live/session.hpp"

namespace fulmar::core {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

// A flight without data for `quiet` gets a request, and is lost without a response for `patience`: reported
// within a second.
constexpr milliseconds quiet{300}, patience{450}, view_period{1000}, draw_period{200}, again{1000};

/// A connected flight, and its displayed data.
class Watched {
 public:
  explicit Watched(const LiveAddress& target, milliseconds limit = patience) : session_(target, limit) {
    look();
    std::map<std::string, std::string> types;
    for (const auto& [topic, channel] : session_.channels())
      types[topic] = channel.schema_name.substr(channel.schema_name.rfind('/') + 1);
    for (const std::string& topic : board_.choose(types)) session_.subscribe(topic);
  }

  /// Receives data for that time. Throws when the flight is lost.
  void hear(milliseconds limit) {
    const auto end = Clock::now() + limit;
    for (auto now = Clock::now(); now < end; now = Clock::now()) {
      if (now - viewed_ > view_period || (now - session_.heard() > quiet && now - viewed_ > quiet)) look();
      const auto left = std::chrono::ceil<milliseconds>(end - now);
      if (const auto sample = session_.next(std::min(left, quiet))) take(*sample);
    }
  }
  const Dashboard& board() const { return board_; }
  Clock::time_point heard() const { return session_.heard(); }

 private:
  void look() {
    const nlohmann::json view = session_.view();
    epoch_ns_ = view.value("epoch_ns", std::int64_t{0});
    board_.take_view(view);
    viewed_ = Clock::now();
  }
  void take(const Session::Sample& sample) {
    const Type& type = *session_.type(sample.topic);
    message_.resize(type.size);
    cdr_decode(type, sample.bytes.data(), sample.bytes.size(), message_.data());
    board_.take(sample.topic, static_cast<double>(sample.time_ns - epoch_ns_) * 1e-9,
                shown_json(type, message_.data()));
  }

  Session session_;
  Dashboard board_;
  std::int64_t epoch_ns_ = 0;
  Clock::time_point viewed_;
  std::vector<std::byte> message_;
};

/// Prints the present state once.
int print_once(const LiveAddress& target) {
  Watched flight(target, std::chrono::seconds(5));
  const auto end = Clock::now() + std::chrono::seconds(1);
  do {
    flight.hear(milliseconds(100));
  } while (!flight.board().whole() && Clock::now() < end);
  PlotSize size;
  size.rows = 40;
  std::fputs(flight.board().text(size).c_str(), stdout);
  return 0;
}

}  // namespace

int watch_command(const LiveAddress& target) {
  if (isatty(STDOUT_FILENO) == 0) return print_once(target);
  auto flight = std::make_unique<Watched>(target);  // the first connection must succeed
  catch_interrupts();
  Screen screen;
  Dashboard shown;
  std::string why;
  Clock::time_point heard, tried;
  while (!interrupted) {
    try {
      if (flight)
        flight->hear(draw_period);
      else
        std::this_thread::sleep_for(draw_period);
      if (!flight && Clock::now() - tried > again) {
        tried = Clock::now();
        flight = std::make_unique<Watched>(target);
      }
    } catch (const Error& fault) {
      const auto* ended = dynamic_cast<const FlightEnded*>(&fault);
      if (flight) {
        why = ended != nullptr ? ended->what() : remote_messages::connection_lost.c_str();
        shown = flight->board();
        heard = flight->heard();
        tried = Clock::now();
        flight.reset();
      }
    }
    const auto silent_s = std::chrono::duration_cast<std::chrono::seconds>(Clock::now() - heard).count();
    screen.show(flight ? flight->board().text(terminal_size())
                       : shown.text(terminal_size(), remote_messages::trying_again(why, silent_s)));
  }
  return 130;
}

}  // namespace fulmar::core
