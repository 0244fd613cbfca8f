// SPDX-License-Identifier: BSD-3-Clause
// Who may speak to a flight: address, token, Host and Origin of a request. Without sockets. Against pages of
// other sites that a browser of this computer shows (cross-site requests, DNS names that turn into
// 127.0.0.1).
#pragma once
#include <chrono>
#include <map>
#include <string>
#include <string_view>

#include "core/graph/graph.hpp"

namespace fulmar::core::live {

/// What a request says of itself.
struct Caller {
  std::string target;         // "/?token=abc"
  std::string host;           // "localhost:8765"; "" when there is none
  std::string origin;         // "http://localhost:8765"; "" when there is none
  std::string authorization;  // "Bearer abc"
};

struct Verdict {
  unsigned status = 200;  // HTTP
  std::string why;
  bool wrong_token = false;  // one was shown
};

Verdict admit(const LiveOptions& options, const Caller& caller);

/// "/view?token=a" -> "/view".
std::string_view path_of(std::string_view target);
/// "localhost:8765" -> "localhost"; "[::1]:8765" -> "::1"; "" when it is none, or anything but a
/// port follows.
std::string host_of_authority(std::string_view authority);
/// Takes as long whatever the first difference is.
bool same_secret(std::string_view a, std::string_view b);

/// So much may come in per second, more in a burst; whoever sends more is read later.
class Bucket {
 public:
  using Clock = std::chrono::steady_clock;
  Bucket(double per_second, double burst, Clock::time_point now)
      : rate_(per_second), burst_(burst), level_(burst), at_(now) {}
  /// Takes `cost`; returns how long to wait before anything else is taken.
  Clock::duration take(double cost, Clock::time_point now);
  bool full(Clock::time_point now) { return take(0, now) == Clock::duration{} && level_ >= burst_; }

 private:
  double rate_, burst_, level_;
  Clock::time_point at_;
};

/// Who guesses tokens, by address: ten wrong ones at once, one per second after them. Of who has used them up
/// no token is looked at, the right one neither: else the answers could be left unread.
class Guesses {
 public:
  using Clock = Bucket::Clock;
  bool may(const std::string& from, Clock::time_point now);
  void wrong(const std::string& from, Clock::time_point now);

 private:
  std::map<std::string, Bucket> buckets_;  // of those who guessed lately
};

/// What counts as one guesser: an IPv4 address, or the /64 network of an IPv6 address.
std::string guesser(const std::string& address);

}  // namespace fulmar::core::live
