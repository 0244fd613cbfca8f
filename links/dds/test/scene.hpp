// SPDX-License-Identifier: BSD-3-Clause
// A bridge in a separate domain, its flight, and programs that use it like ROS 2.
#pragma once
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "core/tap/tap.hpp"
#include "core/types/test/hex.hpp"
#include "core/types/test/types.hpp"
#include "core/types/wire.hpp"
#include "links/dds/library.hpp"
#include "links/dds/test/domain.hpp"
#include "links/dds/test/mock_control.hpp"

namespace fulmar::core::test {

inline const std::string bin = FULMAR_BIN_DIR;
inline const std::string limit = "timeout 300 ";  // a peer that hangs fails the test and not the whole check
inline const std::string mixed_dds = "fulmar_msgs::msg::dds_::Mixed_";

/// Output of a program that runs in parallel with the test.
class Program {
 public:
  explicit Program(const std::string& command)
      : pipe_(popen((command + " 2>/tmp/fulmar_dds_peer_" + std::to_string(getpid())).c_str(), "r")) {}
  ~Program() {
    if (pipe_ != nullptr) finish();
  }
  std::string rest() {
    std::string text;
    char line[4096];
    while (std::fgets(line, sizeof line, pipe_) != nullptr) text += line;
    return text;
  }
  int finish() {
    rest();
    const int status = pclose(pipe_);
    pipe_ = nullptr;
    std::filesystem::remove("/tmp/fulmar_dds_peer_" + std::to_string(getpid()));
    return WEXITSTATUS(status);
  }

 private:
  FILE* pipe_;
};

inline std::string peer(const std::string& what, const std::string& arguments) {
  return limit + bin + "/dds_peer " + what + " " + std::to_string(own_domain()) + " " + arguments;
}
inline std::vector<std::byte> cdr(const Mixed& m) {
  std::vector<std::byte> bytes;
  CdrEncoder(*mixed_type()).encode(bytes_of(m), bytes);
  return bytes;
}

template <class F>
bool soon(F&& f) {
  for (int i = 0; i < 2000; ++i) {
    if (f()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return false;
}

inline ParameterView number_param(const std::string& name, double value, bool live) {
  ParameterView p;
  p.info.name = name;
  p.info.unit = "rad/rad";
  p.info.doc = "aileron per roll error";
  p.info.kind = FULMAR_NUMBER;
  p.info.live = live;
  p.info.min = 0;
  p.info.max = 2;
  p.base.number[0] = value;
  return p;
}

/// A flight with one output, one import, one request and some parameters.
struct Scene {
  Tap tap;
  MockControl control;
  DdsOptions options;
  std::unique_ptr<DdsBridge> bridge;
  std::atomic<bool> stop{false};
  std::thread loop;

  explicit Scene(bool may_stay_silent = false)
      : tap(std::vector<TapChannel>{TapChannel{"/nav/state", mixed_type(), may_stay_silent}}) {
    ComponentView follow, slc;
    follow.name = "follow";
    follow.inputs = {{"leader", mixed_type(), "", -1, false, true},
                     {"edit", leg_type(), "", -1, true, false}};
    slc.name = "slc";
    slc.params = {number_param("roll_kp", 0.55, true), number_param("span_m", 2, false)};
    ParameterView law;
    law.info.name = "law";
    law.info.kind = FULMAR_CHOICE;
    law.info.choices = {"takeoff", "level"};
    law.info.live = true;
    law.base.integer = 1;
    slc.params.push_back(law);
    control.flight.components = {follow, slc};
    options.on = true;
    options.domain = own_domain();
    DdsOptions::Export state;
    state.port = "nav.state";
    state.topic = "/nav/state";
    options.exports = {state};
    DdsOptions::Import leader;
    leader.component = 0;
    leader.input = 0;
    leader.topic = "/leader/state";
    options.imports = {leader};
  }
  ~Scene() {
    stop = true;
    if (loop.joinable()) loop.join();
    bridge.reset();
  }
  void open() { bridge = fulmar_dds_library.open({tap, control, say_aloud}, options); }

  /// The loop: message i at 2.5 ms * i of flight, speed_mps 1000 + i.
  void fly(std::chrono::microseconds pace = std::chrono::microseconds(2500)) {
    loop = std::thread([this, pace] {
      Mixed m = mixed_value();
      for (std::int64_t i = 0; !stop; ++i) {
        const std::int64_t now_ns = i * 2'500'000;
        m.speed_mps = 1000 + static_cast<double>(i);
        if (tap.wanted(0, now_ns)) tap.write(0, now_ns, now_ns, bytes_of(m), false);
        std::this_thread::sleep_for(pace);
      }
    });
  }
  std::size_t published() const {
    const std::lock_guard lock(control.mutex);
    return control.published.size();
  }
  Mixed last() const {
    const std::lock_guard lock(control.mutex);
    Mixed m;
    std::memcpy(&m, control.published.back().data(), sizeof m);
    return m;
  }
};

}  // namespace fulmar::core::test
