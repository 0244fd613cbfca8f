// SPDX-License-Identifier: BSD-3-Clause
#include "core/run/record/recorder.hpp"

#include <algorithm>
#include <cstdio>
#include <cstring>

#include "core/run/messages.hpp"

namespace fulmar::core {
namespace {

/// Severity of a component's message, by its label.
Severity severity_of(const Slot& slot, const Field* severity) noexcept {
  if (!severity) return Severity::info;
  const auto label = static_cast<std::size_t>(slot.published[severity->offset]);
  if (label >= severity->labels.size()) return Severity::info;
  const std::string& word = severity->labels[label];
  return word == "warning"    ? Severity::warning
         : word == "error"    ? Severity::error
         : word == "critical" ? Severity::critical
                              : Severity::info;
}

/// The cause's label becomes the name of the event, so that clients need no text.
void name_cause(Event& e, const Slot& slot, const Field& cause) noexcept {
  const auto label = static_cast<std::size_t>(slot.published[cause.offset]);
  if (label > 0 && label < cause.labels.size()) fulmar::core::put(e.name, cause.labels[label]);
}

}  // namespace

void Recorder::note(const Event& e, bool aloud) {
  const std::int64_t now_ns = state_.now_ns;
  if (tap_) {
    tap_->write(channels_.event, now_ns, now_ns, reinterpret_cast<const std::byte*>(&e), true);
    const LogLine line = log_line_of(e, state_.graph.epoch_ns + now_ns);
    tap_->write(channels_.lines, now_ns, now_ns, reinterpret_cast<const std::byte*>(&line), true);
  }
  if (!state_.options.say || !aloud) return;
  char time[32];
  std::snprintf(time, sizeof time, "%8.2f s  ", 1e-9 * static_cast<double>(now_ns));
  const std::string prefix = e.component[0] != '\0' ? e.component.data() + std::string(": ") : "";
  state_.options.say(time + prefix + e.words.data(), e.severity >= Severity::warning);
}

void Recorder::note_refusals(Unit& unit) noexcept {
  for (const Intake::Refusal& r : unit.in.refusals) {
    const std::string& port = unit.info->inputs[r.input].name;
    Event e = event_of(Code::request_refused, unit.component->name, port);
    fulmar::core::put(e.cause, r.reason.data());
    say(e, run_messages::request_refused, port, r.reason.data());
    note(e, false);
  }
  unit.in.refusals.clear();
}

/// Prints a component's message for users. Its text may hold any bytes.
void Recorder::report(Reported& reported) {
  const auto* const text =
      reinterpret_cast<const char*>(reported.slot->published.data() + reported.text->offset);
  const std::size_t size = strnlen(text, reported.text->stride);
  if (!reported.last.empty()) {
    if (std::memcmp(reported.last.data(), text, reported.text->stride) == 0) return;
    std::memcpy(reported.last.data(), text, reported.text->stride);
  }
  if (size == 0) return;
  Event e = event_of(Code::notice, reported.slot->owner->component->name);
  e.severity = severity_of(*reported.slot, reported.severity);
  if (reported.cause) name_cause(e, *reported.slot, *reported.cause);
  say(e, std::string_view(text, size));
  note(e);
}

void Recorder::put(Slot& slot) {
  if (tap_) {
    const std::byte* const message = slot.published.data();
    LogPlace& place = slot.log;
    const std::int64_t now_ns = state_.now_ns;
    if (slot.hash)
      tick_hash_ = slot.hash->of(
          mix(mix(tick_hash_, place.channel), static_cast<std::uint64_t>(slot.valid_at_ns)), message);
    const bool for_log = log_ && place.due.take(now_ns, place.period_ns);
    if (tap_->wanted(place.channel, now_ns) || for_log)
      tap_->write(place.channel, now_ns, slot.valid_at_ns, message, for_log);
  }
  for (Reported& reported : reported_)
    if (reported.slot == &slot) report(reported);
}

void Recorder::put_probes(Unit& unit) {
  Probes& probes = unit.out.probes;
  if (!tap_ || probes.outputs.empty()) return;
  const std::int64_t now_ns = state_.now_ns;
  for (std::size_t k = 0; k < probes.outputs.size(); ++k)
    std::memcpy(&probes.values[k], unit.out.slots[probes.outputs[k]].published.data(), sizeof(double));
  const auto* const values = reinterpret_cast<const std::byte*>(probes.values.data());
  if (!unit.info->vehicle)
    tick_hash_ = hash_bytes(mix(tick_hash_, probes.log.channel), values, 8 * probes.values.size());
  const bool for_log = log_ && probes.log.due.take(now_ns, probes.log.period_ns);
  if (tap_->wanted(probes.log.channel, now_ns) || for_log)
    tap_->write(probes.log.channel, now_ns, now_ns, values, for_log);
}

void Recorder::put_command(const CommandNote& note) {
  const std::size_t channel = note.kind == CommandKind::parameter ? channels_.parameter : channels_.command;
  put_input(static_cast<int>(channel), reinterpret_cast<const std::byte*>(&note));
}

void Recorder::put_input(int channel, const std::byte* message) {
  if (tap_) tap_->write(static_cast<std::size_t>(channel), state_.now_ns, state_.now_ns, message, true);
}

void Recorder::note_tick() {
  if (!tap_) return;
  const std::int64_t since_last_ns = state_.index == 0 ? 0 : state_.now_ns - state_.result.last_ns;
  if (since_last_ns > std::int64_t{UINT32_MAX})
    put_ticks();  // the period does not fit its field: the next message holds the time
  if (ticks_.hashes == 0) {
    ticks_.first = state_.index;
    ticks_.time_ns = state_.now_ns;
  }
  ticks_.period_ns[ticks_.periods++] =
      static_cast<std::uint32_t>(std::clamp<std::int64_t>(since_last_ns, 0, UINT32_MAX));
  ticks_.hash[ticks_.hashes++] = static_cast<std::uint32_t>(tick_hash_ ^ (tick_hash_ >> 32));
  tick_hash_ = 0;
  if (ticks_.hashes == Ticks::most) put_ticks();
}

void Recorder::put_ticks() {
  if (ticks_.hashes == 0) return;
  put_input(static_cast<int>(channels_.ticks), reinterpret_cast<const std::byte*>(&ticks_));
  ticks_.periods = ticks_.hashes = 0;
}

void Recorder::check_log() {
  if (!log_ || reported_log_failed_ || !log_->failed()) return;
  reported_log_failed_ = true;
  Event e = event_of(Code::log_failed);
  fulmar::core::put(e.cause, log_->error());
  say(e, run_messages::log_failed, log_->error());
  note(e);
}

LogResult Recorder::close() {
  if (tap_) put_ticks();
  return log_ ? log_->close() : LogResult{};
}

}  // namespace fulmar::core
