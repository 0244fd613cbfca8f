// SPDX-License-Identifier: BSD-3-Clause
#include "links/live/gate.hpp"

#include <arpa/inet.h>

#include <algorithm>
#include <charconv>
#include <iterator>

#include "core/graph/live_options.hpp"
#include "core/types/text.hpp"

namespace fulmar::core::live {
namespace {

bool is_address(const std::string& host) {
  in6_addr room{};
  return inet_pton(AF_INET, host.c_str(), &room) == 1 || inet_pton(AF_INET6, host.c_str(), &room) == 1;
}

bool is_any(const std::string& host) { return host == "0.0.0.0" || host == "::"; }

/// ":8765" or an empty text, which may follow a host.
bool is_port(std::string_view text) {
  return text.empty() ||
         (text[0] == ':' && text.size() <= 6 && std::all_of(text.begin() + 1, text.end(), is_digit));
}

std::string percent_decoded(std::string_view text) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char* digits = text.data() + i + 1;
    unsigned char byte = 0;
    if (text[i] == '%' && i + 2 < text.size() &&
        std::from_chars(digits, digits + 2, byte, 16).ptr == digits + 2) {
      out += static_cast<char>(byte);
      i += 2;
    } else {
      out += text[i];
    }
  }
  return out;
}

/// The token of a request, "" without one.
std::string shown_token(const Caller& caller) {
  constexpr std::string_view bearer = "bearer ";
  if (lower(caller.authorization).starts_with(bearer)) return caller.authorization.substr(bearer.size());
  std::string_view rest = caller.target;
  const std::size_t query = rest.find('?');
  if (query == std::string_view::npos) return "";
  rest.remove_prefix(query + 1);
  while (!rest.empty()) {
    const std::string_view pair = rest.substr(0, rest.find('&'));
    if (pair.starts_with("token=")) return percent_decoded(pair.substr(6));
    rest.remove_prefix(std::min(rest.size(), pair.size() + 1));
  }
  return "";
}

std::string authority_of_origin(const std::string& origin) {
  for (const std::string_view scheme : {"http://", "https://"})
    if (origin.starts_with(scheme)) return origin.substr(scheme.size());
  return "";
}

/// A DNS name can be redirected by an attacker; an address cannot.
bool host_is_ours(const LiveOptions& options, const std::string& host) {
  return is_loopback(host) || host == lower(options.host) || (is_any(options.host) && is_address(host));
}

bool origin_is_ours(const Caller& caller) {
  const std::string origin = lower(authority_of_origin(caller.origin));
  return !origin.empty() && (origin == lower(caller.host) || is_loopback(host_of_authority(origin)));
}

}  // namespace

Verdict admit(const LiveOptions& options, const Caller& caller) {
  const std::string host = host_of_authority(lower(caller.host));
  if (host.empty()) return {400, "The request names no host."};
  if (!options.token.empty()) {
    if (same_secret(shown_token(caller), options.token)) return {};
    return {401,
            "This flight wants its token: ?token=... behind the address, or the header 'Authorization: "
            "Bearer ...'.",
            !shown_token(caller).empty()};
  }
  if (!host_is_ours(options, host))
    return {403,
            "This flight does not answer to the name '" + host + "'; use the address that it listens on."};
  if (!caller.origin.empty() && !origin_is_ours(caller))
    return {403, "Pages of '" + caller.origin +
                     "' may not speak to this flight. Set live.token in the mission and give it: ?token=..."};
  return {};
}

std::string_view path_of(std::string_view target) { return target.substr(0, target.find('?')); }

std::string host_of_authority(std::string_view authority) {
  if (authority.find_first_of("@/ ") != std::string_view::npos) return "";
  const bool bracketed = authority.starts_with('[');
  const std::size_t end = bracketed ? authority.find(']') : std::min(authority.find(':'), authority.size());
  if (end == std::string_view::npos) return "";
  if (!is_port(authority.substr(bracketed ? end + 1 : end))) return "";
  return std::string(authority.substr(bracketed ? 1 : 0, bracketed ? end - 1 : end));
}

bool same_secret(std::string_view a, std::string_view b) {
  volatile unsigned char difference = a.size() == b.size() ? 0 : 1;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const char other = b.empty() ? '\0' : b[i % b.size()];
    difference = static_cast<unsigned char>(difference | static_cast<unsigned char>(a[i] ^ other));
  }
  return difference == 0;
}

Bucket::Clock::duration Bucket::take(double cost, Clock::time_point now) {
  level_ = std::min(burst_, level_ + rate_ * std::chrono::duration<double>(now - at_).count()) - cost;
  at_ = now;
  if (level_ >= 0) return {};
  return std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(-level_ / rate_));
}

bool Guesses::may(const std::string& from, Clock::time_point now) {
  const auto it = buckets_.find(from);
  return it == buckets_.end() || it->second.take(0, now) == Clock::duration{};
}

void Guesses::wrong(const std::string& from, Clock::time_point now) {
  constexpr double per_second = 1, burst = 10;
  constexpr std::size_t most = 4096;
  for (auto it = buckets_.begin(); buckets_.size() >= most && it != buckets_.end();)
    it = it->second.full(now) ? buckets_.erase(it) : std::next(it);
  if (buckets_.size() >= most) buckets_.clear();
  buckets_.try_emplace(from, per_second, burst, now).first->second.take(1, now);
}

std::string guesser(const std::string& address) {
  in6_addr v6{};
  if (inet_pton(AF_INET6, address.c_str(), &v6) != 1 || IN6_IS_ADDR_V4MAPPED(&v6)) return address;
  return {reinterpret_cast<const char*>(&v6), 8};
}

}  // namespace fulmar::core::live
