// SPDX-License-Identifier: BSD-3-Clause
// Status of a controller, as text and as JSON.
#pragma once
#include <array>
#include <string>

#include "tools/fulmar_fcu/client.hpp"

namespace fulmar::fcu {

/// Counts frames between two calls.
class Meter {
 public:
  explicit Meter(const Client& client) { restart(client); }
  void restart(const Client& client);
  /// Per second since the start.
  double rate(const Client& client, std::uint8_t id) const;
  double bytes_per_s(const Client& client) const;
  double span_s(const Client& client) const;
  /// Share of the sent frames that were lost, by their sequence numbers.
  double loss_ratio(const Client& client) const;

 private:
  std::array<std::uint64_t, 256> count_{};
  std::uint64_t bytes_ = 0;
  Parser::Counts parser_;
  std::int64_t since_ns_ = 0;
};

/// The firmware's estimate can become NaN, and then stays so until a reboot.
bool finite(const AttitudeQuaternion& q);

/// Cause that keeps the computer's commands from the outputs; "nothing" when it is in control.
std::string control_words(const RosflightStatus& status, double rc_age_s);

/// Several lines, each "what   value".
std::string status_text(const Client& client, const Meter& meter);
/// One JSON object, indented.
std::string status_json(const Client& client, const Meter& meter);
std::string version_json(const Client& client);

}  // namespace fulmar::fcu
