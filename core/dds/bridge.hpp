// SPDX-License-Identifier: BSD-3-Clause
// ROS 2 without ROS 2: ports as topics, topics as inputs, requests and parameters as services, over Fast DDS,
// in threads of its own.
#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/dds/stats.hpp"
#include "core/graph/graph.hpp"

namespace fulmar::core {

class Control;
class Tap;

class DdsBridge {
 public:
  /// Throws Error.
  DdsBridge(Tap& tap, Control& control, const DdsOptions& options);
  ~DdsBridge();
  DdsStats stats() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace fulmar::core
