// SPDX-License-Identifier: BSD-3-Clause
// Source of the scheme: rmw_fastrtps_shared_cpp, rmw_request.cpp and rmw_response.cpp.
#include "links/dds/server.hpp"

#include "core/error.hpp"

namespace fulmar::core::dds {
namespace {

constexpr std::size_t requests_per_wake = 16;
constexpr int request_depth = 64;
// for the discovery of the client's reader: two endpoints are not discovered at the same time
constexpr std::chrono::milliseconds patience{500};

/// Kinds of entity by RTPS 2.3, table 9.1.
bool is_reader(const Guid& guid) { return guid[15] == 0x04 || guid[15] == 0x07; }

}  // namespace

Server::Server(Participant& participant, const std::string& name_space, const Names& names,
               const std::shared_ptr<Waker>& waker, Handle handle)
    : handle_(std::move(handle)), inbox_(std::make_shared<Inbox<Answer>>([waker] { waker->wake(); })) {
  Endpoint reply, request;
  reply.topic = dds_topic("rr", name_space, names.service + "Reply");
  reply.type = dds_type(names.response);
  writer_ = participant.writer(reply);
  request.topic = dds_topic("rq", name_space, names.service + "Request");
  request.type = dds_type(names.request);
  request.depth = request_depth;
  reader_ = participant.reader(request, *waker);
}

bool Server::serve() {
  const bool all = reader_->take(requests_per_wake, [this](const Reader::Sample& sample) { take(sample); }) <
                   requests_per_wake;
  for (Answer& answer : inbox_->take()) due_.push_back(std::move(answer));
  const Clock::time_point now = Clock::now();
  std::erase_if(due_, [&](Answer& answer) {
    if (answer.latest == Clock::time_point{}) answer.latest = now + patience;
    const bool ready =
        !is_reader(answer.request.guid) || writer_->reaches(answer.request.guid) || now >= answer.latest;
    if (ready) writer_->reply(answer.bytes, answer.request);
    return ready;
  });
  return all;
}

void Server::take(const Reader::Sample& sample) {
  ++taken_;
  // A request may name the reader for its reply; otherwise the client is identified by its writer.
  const Identity request{sample.answer_to == Guid{} ? sample.from.guid : sample.answer_to,
                         sample.from.sequence};
  try {
    handle_(sample.bytes, [inbox = inbox_, request](Bytes bytes) {
      inbox->put({request, std::move(bytes)});
    });
  } catch (const Error&) {
    ++refused_;
  }
}

}  // namespace fulmar::core::dds
