// SPDX-License-Identifier: BSD-3-Clause
#include <cstdio>

#include "tools/fulmar_fcu/app.hpp"
#include "tools/fulmar_fcu/messages.hpp"
#include "tools/fulmar_fcu/status.hpp"

namespace fulmar::fcu {

namespace {

void print(const Client& client, const Meter& meter, const Options& options) {
  if (options.json)
    std::printf("%s\n", status_json(client, meter).c_str());
  else
    std::printf("%s", status_text(client, meter).c_str());
  std::fflush(stdout);
}

}  // namespace

int status_command(Client& client, const Options& options, bool once) {
  Meter meter(client);
  client.pump(1200 * ms);
  if (once) {
    print(client, meter, options);
    return 0;
  }
  for (;;) {  // until interrupted
    if (on_terminal()) std::printf("\033[H\033[2J");
    print(client, meter, options);
    if (on_terminal()) std::printf("\nCtrl-C ends.\n");
    meter.restart(client);
    client.pump(500 * ms);
    if (client.age_s<RosflightStatus>() > 1.5)
      std::printf("%s has been silent for %.0f s.\n", client.name().c_str(), client.age_s<RosflightStatus>());
  }
}

int version_command(Client& client, const Options& options) {
  if (client.version().empty())
    throw Error(client.armed() ? fcu_messages::version_while_armed() : fcu_messages::version_refused());
  if (options.json)
    std::printf("%s\n", version_json(client).c_str());
  else
    std::printf("%s\n", client.version().c_str());
  return 0;
}

}  // namespace fulmar::fcu
