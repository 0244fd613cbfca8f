// SPDX-License-Identifier: BSD-3-Clause
// What the files of the hub share.
#pragma once
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/types/element.hpp"
#include "links/live/hub.hpp"

namespace fulmar::core::live {

/// A message that does not keep to the protocol: its sender is told, and goes.
struct Malformed : Error {
  using Error::Error;
};

/// An input that a client publishes into.
struct Hub::Import {
  std::string component, port, topic;
  TypePtr type;
  bool as_json = false;
  Guard guard;
};

struct Hub::Client {
  ClientId id = 0;
  Peer* peer = nullptr;
  std::map<std::uint32_t, std::size_t> subscriptions;  // id -> channel index
  std::map<std::uint32_t, Import> imports;             // by the client's channel id
  std::set<std::string> watched;                       // parameters
  bool graph = false;
  std::size_t unanswered = 0;               // calls and sets
  std::size_t refusals = 0;                 // of the message that is looked at
  std::uint64_t dropped = 0, reported = 0;  // data messages that it did not get
};

/// A setParameters on its way.
struct Hub::Pending {
  ClientId client = 0;
  std::optional<std::string> id;
  std::vector<std::string> names;
  std::size_t open = 0;
};

inline std::uint32_t read_u32(std::string_view bytes, std::size_t at) {
  if (bytes.size() < at + 4)
    throw Malformed("a binary message of " + std::to_string(bytes.size()) + " bytes ends too early");
  return load<std::uint32_t>(reinterpret_cast<const std::byte*>(bytes.data()) + at);
}

}  // namespace fulmar::core::live
