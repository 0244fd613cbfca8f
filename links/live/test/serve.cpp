// SPDX-License-Identifier: BSD-3-Clause
// tap_live_server [TOKEN]: serves a mock flight at 400 Hz on a free port, prints the port, ends with its
// input. At the end it prints one JSON object: the counters of the server.
#include <algorithm>
#include <chrono>
#include <iostream>
#include <nlohmann/json.hpp>

#include "links/live/server.hpp"
#include "links/live/test/mock.hpp"

using namespace fulmar::core;
using namespace fulmar::core::test;

int main(int argc, char** argv) try {
  Tap tap(mock_channels());
  MockControl control;
  LiveOptions options;
  options.port = 0;
  if (argc > 1) options.token = argv[1];
  LiveStats stats;
  {
    LiveServer server(tap, control, options);
    std::cout << server.port() << std::endl;
    std::atomic<bool> stop{false};
    std::thread loop([&] {
      auto due = std::chrono::steady_clock::now();
      for (int i = 0; !stop; ++i) {
        mock_tick(tap, i);
        std::this_thread::sleep_until(due += std::chrono::microseconds(2500));
      }
    });
    while (std::cin.get() != std::char_traits<char>::eof()) {
    }
    stop = true;
    loop.join();
    stats = server.stats();
  }
  const std::vector<std::string> received = control.received();
  const auto published = std::count(received.begin(), received.end(), "publish plan.edits");
  std::cout << nlohmann::json{{"sent", stats.sent},
                              {"dropped", stats.dropped},
                              {"lost", stats.lost},
                              {"refused", stats.refused},
                              {"published", published}}
            << std::endl;
  return 0;
} catch (const std::exception& e) {
  std::cerr << e.what() << "\n";
  return 1;
}
