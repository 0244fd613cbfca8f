// SPDX-License-Identifier: BSD-3-Clause
// Shared by the sources of the hub.
#pragma once
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "core/types/element.hpp"
#include "links/live/hub.hpp"

namespace fulmar::core::live {

/// A message that violates the protocol: its sender gets the reason and is closed.
struct Malformed : Error {
  using Error::Error;
};

/// An input to which a client publishes.
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
  std::size_t unanswered = 0;               // calls and setParameters
  std::size_t refusals = 0;                 // faults of the current message
  std::uint64_t dropped = 0, reported = 0;  // data messages that were dropped for it
};

/// A pending setParameters.
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
