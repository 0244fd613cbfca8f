// SPDX-License-Identifier: BSD-3-Clause
// Access to a running flight for the command line: the Foxglove WebSocket protocol over a Client. Source:
// foxglove/ws-protocol, docs/spec.md.
#pragma once
#include <chrono>
#include <cstdint>
#include <map>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "core/types/type.hpp"
#include "tools/fulmar_live/client.hpp"

namespace fulmar::core {

class Session {
 public:
  using json = nlohmann::json;
  using Milliseconds = std::chrono::milliseconds;
  /// No answer within the time-out.
  struct NoAnswer : Error {
    using Error::Error;
  };

  explicit Session(const LiveAddress& target, Milliseconds patience = std::chrono::seconds(5));
  ~Session();
  /// Sets the time-out of answers.
  void be_patient(Milliseconds patience) { patience_ = patience; }

  struct Channel {
    std::uint32_t id = 0;
    std::string topic, schema_name, schema, encoding;
  };
  /// By topic. Those advertised so far: the first call waits for them.
  const std::map<std::string, Channel>& channels();
  /// The type of a channel's messages, read from its schema. Throws Error.
  TypePtr type(const std::string& topic);

  /// Properties of the flight: the response of /fulmar/view.
  json view();
  /// Identity of the flight: another one on the same port has another id.
  const std::string& id();
  /// From the view: time of the stamps at the begin of the flight.
  std::int64_t epoch_ns();
  /// Calls a service and returns its response. Throws Error when there is no such service or the flight
  /// rejects the call.
  json call(const std::string& service, const json& request);
  /// Accepted, or the reason of the rejection.
  struct Verdict {
    bool accepted = false;
    std::string reason;
  };
  Verdict order(const std::string& service, const json& request);

  void subscribe(const std::string& topic);
  struct Sample {
    std::string topic;
    std::int64_t time_ns = 0;      // time stamp of the flight: its epoch plus flight time
    std::vector<std::byte> bytes;  // CDR
  };
  /// The next sample of a subscription; no value when none arrives in that time.
  std::optional<Sample> next(Milliseconds limit);
  /// Time of the last data from the flight.
  std::chrono::steady_clock::time_point heard() const { return heard_; }

 private:
  void handle_text(const std::string& text);
  void handle_binary(const std::string& bytes);
  bool pump(Milliseconds limit);
  template <class Ready>
  void pump_until(const Ready& ready, const char* what);
  std::uint32_t service_id(const std::string& name);

  Client client_;
  std::string at_;
  Milliseconds patience_;
  bool advertised_ = false, services_known_ = false;
  std::map<std::string, Channel> channels_;
  std::map<std::string, TypePtr> types_;
  std::map<std::string, std::uint32_t> services_;
  std::map<std::uint32_t, std::string> subscriptions_;  // id -> topic
  std::vector<Sample> samples_;
  std::size_t taken_ = 0;
  std::uint32_t calls_ = 0;
  std::unique_ptr<json> answer_;  // of call number calls_
  std::string failure_, id_;
  std::chrono::steady_clock::time_point heard_ = std::chrono::steady_clock::now();
};

}  // namespace fulmar::core
