// SPDX-License-Identifier: BSD-3-Clause
// ROS 2 interface without a ROS 2 installation: ports as topics, topics as inputs, requests and parameters as
// services, over Fast DDS, in separate threads. The code is in a library that the host opens for a mission
// with `dds:`. The host and the library share only this header.
#pragma once
#include <memory>
#include <string>

#include "core/say.hpp"
#include "links/dds/stats.hpp"

namespace fulmar::core {

class Control;
struct DdsOptions;
class Tap;

class DdsBridge {
 public:
  virtual ~DdsBridge() = default;
  virtual DdsStats stats() const = 0;
};

/// Interface of the host for a bridge. The library must not use state of the host's code, such as its logger.
struct DdsHost {
  using Say = void (*)(const std::string& text, Tone tone);
  Tap& tap;
  Control& control;
  Say say;
};

/// The library's only symbol, `fulmar_dds_library`.
struct DdsLibrary {
  static constexpr const char* section = "dds";
  static constexpr const char* needs =
      "Fast DDS: install libfastrtps-dev and libfastcdr-dev, or what they are called here";
  const char* build;  // first member: checked before any other, also for a library of another build
  /// Throws Error.
  std::unique_ptr<DdsBridge> (*open)(const DdsHost& host, const DdsOptions& options);
};

}  // namespace fulmar::core

/// Defined in the library alone.
extern "C" __attribute__((visibility("default"))) const fulmar::core::DdsLibrary fulmar_dds_library;
