// SPDX-License-Identifier: BSD-3-Clause
// The live view, which the host opens for a mission with `live:`, or for `--live`. The code is in a library.
// The host and the library share only this header.
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
  /// The listening port.
  virtual std::uint16_t port() const = 0;
  virtual LiveStats stats() const = 0;
};

/// The library's only symbol, `fulmar_live_library`.
struct LiveLibrary {
  static constexpr const char* section = "live";
  static constexpr const char* needs = "";
  const char* build;  // first member: checked before any other, also for a library of another build
  /// `page`: folder of the page for browsers; without one they get the table of topics. Throws Error with a
  /// remedy when it cannot listen there.
  std::unique_ptr<LiveView> (*open)(Tap& tap, Control& control, const LiveOptions& options,
                                    const std::filesystem::path& page);
};

}  // namespace fulmar::core

/// Defined in the library alone.
extern "C" __attribute__((visibility("default"))) const fulmar::core::LiveLibrary fulmar_live_library;
