// SPDX-License-Identifier: BSD-3-Clause
// A log and its tap, for tests that write like the loop.
#pragma once
#include <utility>
#include <vector>

#include "core/tap/log.hpp"
#include "core/tap/tap.hpp"

struct TapedLog {
  fulmar::core::Tap tap;
  fulmar::core::Log log;

  TapedLog(const fulmar::core::Log::Options& options, std::vector<fulmar::core::TapChannel> channels,
           std::size_t ring_bytes = 4u << 20)
      : tap(std::move(channels), ring_bytes), log(options, tap) {}
  void write(std::size_t channel, std::int64_t now_ns, std::int64_t valid_ns, const std::byte* data) {
    tap.write(channel, now_ns, valid_ns, data, true);
  }
  void attach(const std::string& name, const std::string& media_type, const std::string& content) {
    log.attach(name, media_type, content);
  }
  void metadata(const std::string& name, const std::vector<std::pair<std::string, std::string>>& pairs) {
    log.metadata(name, pairs);
  }
  fulmar::core::LogResult close() { return log.close(); }
};
