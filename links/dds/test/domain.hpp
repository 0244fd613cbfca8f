// SPDX-License-Identifier: BSD-3-Clause
// Reserves a DDS domain that no other test on this computer uses, for the life of the process.
#pragma once
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <stdexcept>

namespace fulmar::core::test {

/// Two tests in one domain would answer each other's services and fill each other's queues. The lock is a TCP
/// port among those of the domain (RTPS 2.5, 9.6.2.3: 7400 + 250 domain) that no participant takes. Domains
/// above 100 have theirs in the ephemeral range of the kernel.
inline int own_domain() {
  static const int domain = [] {
    constexpr int domains = 100;
    for (int i = 0; i < domains; ++i) {
      const int candidate = 1 + (getpid() + i) % domains;
      const int lock = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
      sockaddr_in at{};
      at.sin_family = AF_INET;
      at.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
      at.sin_port = htons(static_cast<std::uint16_t>(7400 + 250 * candidate + 249));
      if (lock >= 0 && bind(lock, reinterpret_cast<sockaddr*>(&at), sizeof at) == 0)
        return candidate;  // kept open
      if (lock >= 0) close(lock);
    }
    throw std::runtime_error("every DDS domain is in use");
  }();
  return domain;
}

}  // namespace fulmar::core::test
