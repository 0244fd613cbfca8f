// SPDX-License-Identifier: BSD-3-Clause
#include "core/graph/live_options.hpp"

#include <arpa/inet.h>

#include "core/error.hpp"
#include "core/types/text.hpp"

namespace fulmar::core {

void check_live_options(const LiveOptions& options) {
  if (!options.token.empty() || is_loopback(lower(options.host))) return;
  throw Error("live.listen: " + options.host +
              " can be reached from other computers. Give a token in FULMAR_TOKEN or live.token, which every "
              "client then has to show, or listen on 127.0.0.1");
}

std::string why_no_save(const LiveOptions& options) {
  if (options.save.value_or(is_loopback(lower(options.host)))) return "";
  return options.save ? "the mission says live: {save: off}"
                      : options.host +
                            " can be reached from other computers, and the mission does not say live: "
                            "{save: on}";
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
