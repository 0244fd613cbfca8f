// SPDX-License-Identifier: BSD-3-Clause
// Fast DDS behind plain classes: a participant that communicates with the given addresses alone, and writers
// and readers of CDR bytes. The settings are compatible with ROS 2 (rmw_fastrtps) and Cyclone DDS, without
// multicast and without shared memory.
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

/// Writer and sequence number of a sample. A reply names its request by this.
struct Identity {
  Guid guid{};
  std::uint64_t sequence = 0;
};

/// Ends a thread's sleep. Any thread may call `wake`.
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
  std::size_t max_bytes = 256;  // expected size of a sample, for preallocation; larger samples are possible
  int depth = 10;
  bool best_effort = false;
  bool transient_local = false;  // readers that join late get the last samples
  std::string type_hash;         // "RIHS01_...", "" when unknown
};

class Writer {
 public:
  virtual ~Writer() = default;
  virtual Guid guid() const = 0;
  /// Does not block. Returns false when the sample could not be stored.
  virtual bool write(std::span<const std::byte> bytes) = 0;
  /// Writes the reply to the request of that identity.
  virtual bool reply(std::span<const std::byte> bytes, const Identity& request) = 0;
  /// Whether this reader is matched and gets the written samples.
  virtual bool reaches(const Guid& reader) const = 0;
  virtual std::size_t readers() const = 0;
  /// Drops the samples written so far for readers that join late.
  virtual void forget() = 0;
};

class Reader {
 public:
  struct Sample {
    std::span<const std::byte> bytes;  // valid during the call
    Identity from;
    Guid answer_to{};             // of a request: the client's reader, all zero when the request does not
                                  // name it
    std::int64_t written_ns = 0;  // by the writer's clock, UTC
  };
  virtual ~Reader() = default;
  virtual Guid guid() const = 0;
  /// Passes at most `most` samples, oldest first; returns their number.
  virtual std::size_t take(std::size_t most, const std::function<void(const Sample&)>& use) = 0;
  /// Whether this reader is matched with that writer.
  virtual bool hears(const Guid& writer) const = 0;
  /// Samples that were overwritten before they were taken, or never arrived.
  virtual std::uint64_t lost() const = 0;
};

class Participant {
 public:
  /// Called for each remote writer and reader of a topic, from a thread of Fast DDS.
  using Found =
      std::function<void(const std::string& topic, const std::string& type, bool writer, bool best_effort)>;

  /// Throws Error.
  Participant(const DdsOptions& options, Found found);
  ~Participant();

  /// Writers and readers must end before the participant. Throw Error.
  std::unique_ptr<Writer> writer(const Endpoint& endpoint);
  std::unique_ptr<Reader> reader(const Endpoint& endpoint, Waker& waker);
  Guid guid() const;

  struct Impl;

 private:
  std::unique_ptr<Impl> impl_;
};

/// "fulmar_msgs/msg/VehicleState" -> "fulmar_msgs::msg::dds_::VehicleState_".
std::string dds_type(const std::string& ros_name);
/// Prefix "rt", "rq", "rr"; name "/nav/state" or "nav/state"; namespace "" or "uav1".
std::string dds_topic(const std::string& prefix, const std::string& name_space, const std::string& name);

}  // namespace fulmar::core::dds
