// SPDX-License-Identifier: BSD-3-Clause
// Ports as ROS 2 topics, and ROS 2 topics as samples of inputs.
#pragma once
#include <atomic>
#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "core/due.hpp"
#include "core/tap/control.hpp"
#include "core/tap/tap.hpp"
#include "core/types/wire.hpp"
#include "links/dds/library.hpp"
#include "links/dds/participant.hpp"

namespace fulmar::core::dds {

/// Remote endpoints by DDS topic; called from threads of Fast DDS. An endpoint that does not match by the
/// rules of DDS is reported once, since nothing else would explain the missing samples.
class Others {
 public:
  explicit Others(DdsHost::Say say) : say_(say) {}
  /// Adds a topic of this bridge. Call it before the participant is made.
  void expect(const std::string& topic, const std::string& type, bool we_write, bool best_effort);
  void found(const std::string& topic, const std::string& type, bool writer, bool best_effort);
  /// Whether a remote writer uses best effort, which a reliable reader does not match.
  bool has_best_effort_writer(const std::string& topic) const;

 private:
  struct Topic {
    std::string type;
    bool we_write = false, best_effort = false, reported_type = false, reported_effort = false;
    bool best_effort_writer = false;
  };
  DdsHost::Say say_;
  mutable std::mutex mutex_;
  std::map<std::string, Topic> topics_;
};

/// Used by the export thread alone.
class Exports {
 public:
  /// Throws Error.
  Exports(Tap& tap, const DdsOptions& options, Others& others);
  void open(Participant& participant);
  /// Sends all new samples.
  void pump();
  std::uint64_t sent() const { return sent_.load(std::memory_order_relaxed); }
  std::uint64_t lost() const { return lost_.load(std::memory_order_relaxed); }
  std::vector<Guid> writers() const;

 private:
  struct Topic {
    Endpoint endpoint;
    std::int64_t period_ns = 0;
    Due due;
    std::int64_t last_ns = 0;
    std::unique_ptr<CdrEncoder> encoder;
    std::unique_ptr<Writer> writer;
  };
  void send(Topic& topic, const Tap::Sample& sample);

  Tap::Cursor cursor_;
  std::vector<Topic> topics_;
  std::vector<std::vector<std::size_t>> of_channel_;  // into topics_
  Bytes bytes_;
  std::atomic<std::uint64_t> sent_{0}, lost_{0};
};

/// Used by the import thread alone.
class Imports {
 public:
  /// Throws Error. `view`: of the flight; its components and inputs have the numbers of the options.
  Imports(const DdsHost& host, const FlightView& view, const DdsOptions& options, Others& others);
  void open(Participant& participant, Waker& waker);
  /// Passes a bounded number of samples per topic to the loop. Returns false when more are left.
  bool pump(Participant& participant, Waker& waker);
  std::vector<DdsStats::Import> stats() const;
  std::vector<Guid> readers() const;

 private:
  struct Topic {
    std::string component, port;
    TypePtr type;
    Endpoint endpoint;
    std::unique_ptr<Guard> guard;
    std::unique_ptr<Reader> reader;
    std::unique_ptr<Reader> loose;  // for best-effort writers, once there is one
    DdsStats::Import stats;         // guarded by mutex_
    std::uint64_t crowded = 0;      // guarded: dropped because the loop's queue was full
    double latency_sum_s = 0;       // guarded
    bool reported = false;
  };
  void use(Topic& topic, const Reader::Sample& sample);

  DdsHost host_;
  Others& others_;
  mutable std::mutex mutex_;
  std::deque<Topic> topics_;
};

}  // namespace fulmar::core::dds
