// SPDX-License-Identifier: BSD-3-Clause
#include "core/graph/live_options.hpp"

#include <arpa/inet.h>

#include "core/error.hpp"
#include "core/graph/messages.hpp"
#include "core/types/text.hpp"

namespace fulmar::core {

void check_live_options(const LiveOptions& options) {
  if (!options.token.empty() || is_loopback(lower(options.host))) return;
  throw Error(graph_messages::live_token_missing(options.host));
}

std::string why_no_save(const LiveOptions& options) {
  if (options.save.value_or(is_loopback(lower(options.host)))) return "";
  return options.save ? graph_messages::save_off().line()
                      : graph_messages::save_not_enabled(options.host).line();
}

bool is_loopback(const std::string& host) {
  in_addr v4{};
  if (inet_pton(AF_INET, host.c_str(), &v4) == 1) return (ntohl(v4.s_addr) >> 24) == 127;
  return host == "localhost" || host == "::1";
}

std::string origin_of(const std::string& tiles) {
  const std::size_t host = tiles.find("://");
  return host == std::string::npos ? "" : tiles.substr(0, tiles.find('/', host + 3));
}

}  // namespace fulmar::core
