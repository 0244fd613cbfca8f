// SPDX-License-Identifier: BSD-3-Clause
#include "core/run/verdict.hpp"

#include <algorithm>
#include <cstring>

#include "core/log/events.hpp"
#include "core/run/messages.hpp"
#include "core/types/names.hpp"

namespace fulmar::core {
namespace {

/// A text field of a message: one printable line.
std::string text_at(const std::byte* field, std::size_t room) {
  const char* const text = reinterpret_cast<const char*>(field);
  std::string line(text, strnlen(text, room));
  make_printable(line.data());
  return line;
}

/// Components that report nothing, because this flight does not have them.
std::string without(const Graph& graph) {
  std::vector<std::string> owners;
  for (const auto& [key, port] : graph.judge.left_out) {
    const std::string owner = port.substr(0, port.find('.'));
    if (std::find(owners.begin(), owners.end(), owner) == owners.end()) owners.push_back(owner);
  }
  return run_messages::verdict_sources_missing(join(owners)).line();
}

}  // namespace

bool has_begun(const FlightResult& result) {
  const bool ended_well = result.outcome == Outcome::flown || result.outcome == Outcome::aborted;
  return !ended_well || result.idle.empty();
}

const char* result_word(const FlightResult& result) {
  if (result.outcome == Outcome::interrupted) return "interrupted";
  if (result.outcome == Outcome::failed) return "failed";
  if (!has_begun(result)) return "not begun";
  if (result.outcome == Outcome::aborted) return "aborted";
  return result.guards.empty() ? "flown" : "flown with guards";
}

std::string reason_of(const FlightResult& result) {
  return has_begun(result) ? result.reason
                           : run_messages::role_output_absent(result.idle, result.reason).line();
}

std::string verdict_line(const Graph& graph, const Flight& flight, const std::string& result_word) {
  if (!graph.judge.verdict && !graph.judge.left_out.empty()) return result_word + ": " + without(graph);
  const std::byte* const message = graph.judge.verdict ? flight.sample(graph.judge.verdict->from) : nullptr;
  if (!message) return result_word;
  const VerdictPort& port = *graph.judge.verdict;
  const std::string word = text_at(message + port.word, port.word_size),
                    text = text_at(message + port.text, port.text_size);
  const bool own = result_word == "failed" && !word.empty();
  return (own ? word : result_word) + (text.empty() ? "" : ": " + text);
}

std::string verdict_of(const Graph& graph, const Flight& flight, const FlightResult& result) {
  return verdict_line(graph, flight, result_word(result));
}

}  // namespace fulmar::core
