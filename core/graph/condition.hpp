// SPDX-License-Identifier: BSD-3-Clause
// Conditions of phases: comparisons of fields, or of the flight time, with numbers, units, enum labels or
// other fields; and, or, not, parentheses. Compiled when the mission is read; evaluated in the tick without
// allocation. False while a port that it reads has no sample or is stale.
#pragma once
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/graph/graph.hpp"

namespace fulmar::core {

/// Finds the port "nav.state" and its type; throws Error with the valid choices.
using FindPort = std::function<std::pair<Source, TypePtr>(const std::string& owner, const std::string& port)>;

/// Access of a condition to samples. Must not allocate.
struct SampleReader {
  /// The present sample of a port, or nullptr when there is none or it is stale.
  virtual const std::byte* sample(const Source& source) const noexcept = 0;
  virtual std::int64_t now_ns() const noexcept = 0;

 protected:
  ~SampleReader() = default;
};

/// A field of a port, found by its full name "nav.state.height_m"; a probe is named by its port alone. Throws
/// Error with the valid choices.
Shown find_shown(const std::string& text, const FindPort& find);

class Condition {
 public:
  /// Throws Error on bad syntax, unknown fields, units that do not fit, or unknown labels.
  static std::shared_ptr<const Condition> compile(const std::string& text, const FindPort& find);
  bool holds(const SampleReader& reader) const noexcept;
  const std::string& text() const { return text_; }
  /// All ports that it reads.
  const std::vector<Source>& ports() const { return ports_; }

  struct Node;

 private:
  std::string text_;
  std::vector<Source> ports_;
  std::vector<Node> nodes_;
  int root_ = -1;
};

}  // namespace fulmar::core
