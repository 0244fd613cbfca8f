// SPDX-License-Identifier: BSD-3-Clause
// The live view: the Foxglove WebSocket protocol and plain HTTP on one port, in a separate thread.
#pragma once
#include <cstdint>
#include <filesystem>
#include <memory>

#include "core/graph/graph.hpp"
#include "links/live/library.hpp"

namespace fulmar::core {

class LiveServer final : public LiveView {
 public:
  /// `page`: folder of the page for browsers; without one they get the table of topics. Throws Error with a
  /// remedy when it cannot listen there.
  LiveServer(Tap& tap, Control& control, const LiveOptions& options, const std::filesystem::path& page = {});
  ~LiveServer() override;
  std::uint16_t port() const override;
  LiveStats stats() const override;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace fulmar::core
