// SPDX-License-Identifier: BSD-3-Clause
// A hub with a client that stores its messages.
#pragma once
#include <doctest/doctest.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "links/live/hub.hpp"
#include "links/live/test/mock.hpp"

namespace fulmar::core::live::test {

using namespace fulmar::core::test;
using nlohmann::json;

struct TestPeer : Peer {
  std::vector<json> texts;
  std::vector<std::string> binaries;
  std::size_t room = ~std::size_t{0};  // data messages
  int closed = 0;
  bool offer(const Message& message) override {
    if (room == 0) return false;
    --room;
    keep(message);
    return true;
  }
  void send(Message message) override { keep(message); }
  void close(std::uint16_t code, const std::string&) override { closed = code; }
  void keep(const Message& m) {
    if (m.binary) {
      binaries.push_back(std::string(m.head.data(), m.head_size) + *m.body);
    } else {
      texts.push_back(json::parse(*m.body));
    }
  }
  const json* last(const std::string& op) const {
    for (auto at = texts.rbegin(); at != texts.rend(); ++at)
      if (at->at("op") == op) return &*at;
    return nullptr;
  }
  std::string last_status() const {
    const json* status = last("status");
    return status == nullptr ? "" : status->at("message").get<std::string>();
  }
  std::size_t count(const std::string& op) const {
    return static_cast<std::size_t>(
        std::count_if(texts.begin(), texts.end(), [&](const json& t) { return t.at("op") == op; }));
  }
};

inline std::uint32_t u32(const std::string& bytes, std::size_t at) {
  std::uint32_t value = 0;
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}
inline std::uint64_t u64(const std::string& bytes, std::size_t at) {
  std::uint64_t value = 0;
  std::memcpy(&value, bytes.data() + at, sizeof value);
  return value;
}
inline std::string le(std::uint32_t value) { return std::string(reinterpret_cast<const char*>(&value), 4); }

template <class T>
std::string cdr_of(const Type& type, const T& value) {
  std::vector<std::byte> bytes;
  CdrEncoder(type).encode(bytes_of(value), bytes);
  return std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size());
}

struct Fixture {
  Tap tap{mock_channels()};
  MockControl control;
  Counters counters;
  Hub hub{tap, control, counters};
  TestPeer peer;
  Hub::ClientId id = 0;
  Fixture() {
    hub.begin([] {});
    id = hub.add(peer);
  }
  ~Fixture() { hub.close(); }

  void say(const json& message) { hub.text(id, message.dump()); }
  /// Runs turns until a condition holds; the mock answers from a thread.
  template <class So>
  bool until(const So& so) {
    for (int i = 0; i < 5000 && !so(); ++i) {
      hub.tick();
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return so();
  }
  std::uint32_t service(const std::string& name) const {
    for (const json& s : peer.last("advertiseServices")->at("services"))
      if (s.at("name") == name) return s.at("id").get<std::uint32_t>();
    FAIL("no such service: " << name);
    return 0;
  }
  void call(const std::string& name, const std::string& encoding, const std::string& payload,
            std::uint32_t call_id = 9) {
    hub.binary(id, "\2" + le(service(name)) + le(call_id) + le(static_cast<std::uint32_t>(encoding.size())) +
                       encoding + payload);
  }
  /// The answer to this call; answers to earlier calls may still come first.
  json call_json(const std::string& name, const std::string& payload) {
    const std::uint32_t asked = service(name);
    std::size_t next = peer.binaries.size();
    const auto answered = [&] {
      for (; next < peer.binaries.size(); ++next)
        if (const std::string& answer = peer.binaries[next];
            answer[0] == 3 && u32(answer, 1) == asked && u32(answer, 5) == 9)
          return true;
      return false;
    };
    call(name, "json", payload);
    REQUIRE(until(answered));
    const std::string& answer = peer.binaries[next];
    CHECK(u32(answer, 9) == 4);
    CHECK(answer.substr(13, 4) == "json");
    return json::parse(answer.substr(17));
  }
};

}  // namespace fulmar::core::live::test
