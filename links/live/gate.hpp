// SPDX-License-Identifier: BSD-3-Clause
// Access control of a flight: address, token, Host and Origin of a request. Without sockets. It protects
// against pages of other sites in a browser of this computer: cross-site requests, and DNS names that are
// redirected to 127.0.0.1.
#pragma once
#include <chrono>
#include <map>
#include <string>
#include <string_view>

#include "core/graph/graph.hpp"

namespace fulmar::core::live {

/// Properties of a request.
struct Caller {
  std::string target;         // "/?token=abc"
  std::string host;           // "localhost:8765"; "" without one
  std::string origin;         // "http://localhost:8765"; "" without one
  std::string authorization;  // "Bearer abc"
};

struct Verdict {
  unsigned status = 200;  // HTTP status
  std::string why;
  bool wrong_token = false;  // the request had a wrong token
};

Verdict admit(const LiveOptions& options, const Caller& caller);

/// "/view?token=a" -> "/view".
std::string_view path_of(std::string_view target);
/// "localhost:8765" -> "localhost"; "[::1]:8765" -> "::1"; "" for an invalid text, or when anything but a
/// port follows.
std::string host_of_authority(std::string_view authority);
/// Constant time: it does not depend on the place of the first difference.
bool same_secret(std::string_view a, std::string_view b);

/// Token bucket: input has a limit per second, and a higher one in a burst; beyond it, the reader waits.
class Bucket {
 public:
  using Clock = std::chrono::steady_clock;
  Bucket(double per_second, double burst, Clock::time_point now)
      : rate_(per_second), burst_(burst), level_(burst), at_(now) {}
  /// Takes `cost`; returns the wait before the next input.
  Clock::duration take(double cost, Clock::time_point now);
  bool full(Clock::time_point now) { return take(0, now) == Clock::duration{} && level_ >= burst_; }

 private:
  double rate_, burst_, level_;
  Clock::time_point at_;
};

/// Limits wrong tokens by address: ten at once, one per second after them. Beyond the limit every token is
/// rejected, even the right one; otherwise an attacker could ignore the answers and continue.
class Guesses {
 public:
  using Clock = Bucket::Clock;
  bool may(const std::string& from, Clock::time_point now);
  void wrong(const std::string& from, Clock::time_point now);

 private:
  std::map<std::string, Bucket> buckets_;  // addresses with recent wrong tokens
};

/// Key of one guesser: an IPv4 address, or the /64 network of an IPv6 address.
std::string guesser(const std::string& address);

}  // namespace fulmar::core::live
