// SPDX-License-Identifier: BSD-3-Clause
// One ROS 2 service in the form of rmw_fastrtps: a topic for requests, one for replies, and the request's
// identity with each reply.
#pragma once
#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/inbox.hpp"
#include "links/dds/participant.hpp"

namespace fulmar::core::dds {

class Server {
 public:
  /// May be called once, from any thread, also after the server's end.
  using Reply = std::function<void(Bytes)>;
  /// Called in the thread of `serve`. Throws Error when the bytes are no such request: it is counted, but not
  /// answered.
  using Handle = std::function<void(std::span<const std::byte> request, Reply reply)>;

  struct Names {
    std::string service;            // "plan/edit"
    std::string request, response;  // ROS names: "fulmar_msgs/srv/PlanEdit_Request"
  };
  Server(Participant& participant, const std::string& name_space, const Names& names,
         const std::shared_ptr<Waker>& waker, Handle handle);

  /// Takes some requests and sends the replies that are due. Returns false when requests are left.
  bool serve();
  /// Whether replies wait for the discovery of their client's reader.
  bool waiting() const { return !due_.empty(); }
  std::uint64_t refused() const { return refused_; }
  std::uint64_t taken() const { return taken_; }
  const Reader& reader() const { return *reader_; }
  const Writer& writer() const { return *writer_; }

 private:
  using Clock = std::chrono::steady_clock;
  struct Answer {
    Identity request;
    Bytes bytes;
    Clock::time_point latest{};  // time at which it is sent or dropped
  };
  void take(const Reader::Sample& sample);

  Handle handle_;
  std::shared_ptr<Inbox<Answer>> inbox_;  // lives until the last possible answer
  std::unique_ptr<Writer> writer_;
  std::unique_ptr<Reader> reader_;
  std::vector<Answer> due_;
  std::atomic<std::uint64_t> refused_{0}, taken_{0};
};

}  // namespace fulmar::core::dds
