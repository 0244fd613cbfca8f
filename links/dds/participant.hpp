// SPDX-License-Identifier: BSD-3-Clause
// Fast DDS behind plain classes: a participant that speaks to the given addresses alone, writers and readers
// of ready-made CDR bytes. Settings: those with which ROS 2 (rmw_fastrtps) and Cyclone DDS understand it,
// without multicast and without shared memory.
#pragma once
#include <array>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <vector>

#include "core/graph/graph.hpp"

namespace fulmar::core::dds {

using Bytes = std::vector<std::byte>;
using Guid = std::array<std::uint8_t, 16>;

/// Who wrote a sample, and which of its samples it is. A reply names the request that it answers by this.
struct Identity {
  Guid guid{};
  std::uint64_t sequence = 0;
};

/// Ends a thread's sleep. Any thread may wake.
class Waker {
 public:
  void wake() {
    {
      const std::lock_guard lock(mutex_);
      due_ = true;
    }
    changed_.notify_one();
  }
  void wait(std::chrono::milliseconds longest) {
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, longest, [this] { return due_; });
    due_ = false;
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  bool due_ = false;
};

struct Endpoint {
  std::string topic, type;      // DDS names: "rt/nav/state", "fulmar_msgs::msg::dds_::VehicleState_"
  std::size_t max_bytes = 256;  // of a sample, for the memory that is set aside; more is possible
  int depth = 10;
  bool best_effort = false;
  bool transient_local = false;  // who joins late gets the last samples
  std::string type_hash;         // "RIHS01_...", "" when it is not known
};

class Writer {
 public:
  virtual ~Writer() = default;
  virtual Guid guid() const = 0;
  /// Does not wait for anybody. False when the sample could not be taken.
  virtual bool write(std::span<const std::byte> bytes) = 0;
  /// A reply to the request of that identity.
  virtual bool reply(std::span<const std::byte> bytes, const Identity& request) = 0;
  /// Whether this reader is found and gets what is written.
  virtual bool reaches(const Guid& reader) const = 0;
  virtual std::size_t readers() const = 0;
  /// What is written so far is not for those who join late.
  virtual void forget() = 0;
};

class Reader {
 public:
  struct Sample {
    std::span<const std::byte> bytes;  // valid during the call
    Identity from;
    Guid answer_to{};             // of a request: the client's reader, all zero when it does not say
    std::int64_t written_ns = 0;  // by the writer's clock, UTC
  };
  virtual ~Reader() = default;
  virtual Guid guid() const = 0;
  /// At most so many samples, oldest first; returns how many there were.
  virtual std::size_t take(std::size_t most, const std::function<void(const Sample&)>& use) = 0;
  /// Whether that writer's samples come to this reader.
  virtual bool hears(const Guid& writer) const = 0;
  /// Samples that were overwritten before they were taken, or never arrived.
  virtual std::uint64_t lost() const = 0;
};

class Participant {
 public:
  /// Told of every writer and reader elsewhere that speaks of a topic; from a thread of Fast DDS.
  using Found =
      std::function<void(const std::string& topic, const std::string& type, bool writer, bool best_effort)>;

  /// Throws Error.
  Participant(const DdsOptions& options, Found found);
  ~Participant();

  /// Writers and readers end before the participant does. Throw Error.
  std::unique_ptr<Writer> writer(const Endpoint& endpoint);
  std::unique_ptr<Reader> reader(const Endpoint& endpoint, Waker& waker);
  Guid guid() const;

  struct Impl;

 private:
  std::unique_ptr<Impl> impl_;
};

/// "fulmar_msgs/msg/VehicleState" -> "fulmar_msgs::msg::dds_::VehicleState_".
std::string dds_type(const std::string& ros_name);
/// Prefix "rt", "rq", "rr"; name "/nav/state" or "nav/state"; "" or "uav1" before it.
std::string dds_topic(const std::string& prefix, const std::string& name_space, const std::string& name);

}  // namespace fulmar::core::dds
