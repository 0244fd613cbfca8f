// SPDX-License-Identifier: BSD-3-Clause
// The live view, as the host opens it for a mission with `live:`, or for `--live`. The code is in a library;
// this header is all that the two share.
#pragma once
#include <cstdint>
#include <filesystem>
#include <memory>

#include "core/graph/graph.hpp"
#include "links/live/stats.hpp"

namespace fulmar::core {

class Control;
class Tap;

class LiveView {
 public:
  virtual ~LiveView() = default;
  /// That it listens on.
  virtual std::uint16_t port() const = 0;
  virtual LiveStats stats() const = 0;
};

/// The library's only symbol, `fulmar_live_library`.
struct LiveLibrary {
  static constexpr const char* section = "live";
  static constexpr const char* needs = "";
  const char* build;  // first: read before anything else, also of a library of another build
  /// `page`: the folder of the page that a browser gets; where there is none it gets the table of topics.
  /// Throws Error when it cannot listen there: says who to ask and what to do.
  std::unique_ptr<LiveView> (*open)(Tap& tap, Control& control, const LiveOptions& options,
                                    const std::filesystem::path& page);
};

}  // namespace fulmar::core

/// Defined in the library alone.
extern "C" __attribute__((visibility("default"))) const fulmar::core::LiveLibrary fulmar_live_library;
