// SPDX-License-Identifier: BSD-3-Clause
// The components of a flight and the wires between them: published samples and their readers.
#pragma once
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "core/graph/condition.hpp"
#include "core/run/component/unit.hpp"
#include "core/run/record/recorder.hpp"
#include "core/run/state/state.hpp"
#include "core/types/named.hpp"

namespace fulmar::core {

class Wiring final : public SampleReader {
 public:
  /// An input from outside reads a slot that no component writes.
  struct Import {
    Slot slot;
    Reader* reader = nullptr;
  };

  /// [setup] Creates the components, unconnected. Throws Error.
  explicit Wiring(FlightState& state);
  /// [setup] A new unit of a component, unconnected. Throws Error.
  std::unique_ptr<Unit> make_unit(const Component& component) const;
  /// [setup] Connects all units by the graph; previous connections are removed.
  void connect();

  Unit& unit(int index) const noexcept { return *nth(units, index); }
  Unit& vehicle() const noexcept { return unit(state_.graph.vehicle); }
  int index_of(const Unit& unit) const noexcept;

  /// [tick] Publishes the outputs of a unit's last good step to its readers and to the recorder.
  void publish(Unit& unit, Recorder& recorder);
  /// [tick] Publishes a sample from outside.
  void publish_import(std::size_t import, const std::byte* message);
  /// [tick] At its end: updates delayed wires.
  void latch() noexcept;

  /// [tick] A sample is stale for a condition, and nullptr, when its writer has been stopped.
  const std::byte* sample(const Source& source) const noexcept override;
  std::int64_t now_ns() const noexcept override { return state_.now_ns; }
  /// [tick] Whether a condition has held for that long; `since_ns` stores its start between ticks.
  bool held_for(const Condition& condition, std::int64_t for_ns, std::int64_t& since_ns) const noexcept;
  /// [tick] The unit fills its roles now: their samples are to come from it.
  void expect_from(Unit& unit) noexcept;
  /// Whether a role has had any output.
  bool has_published(std::size_t role) const noexcept;
  const Slot* slot_of(const Source& source) const noexcept;
  const std::byte* message_of(const Source& source) const noexcept;

  Units units;
  std::vector<Import> imports;  // as in graph.dds.imports

 private:
  void connect_role(std::size_t role);
  void connect_reader(Reader& reader);
  void connect_to_role(Reader& reader);
  void connect_import(Reader& reader);
  std::unique_ptr<SampleSource> recorded_samples(const Component& component) const;

  FlightState& state_;
  std::vector<std::vector<RoleSlot>> roles_;  // per role and output
  std::vector<Reader*> delayed_;              // readers that see the previous tick's sample
};

}  // namespace fulmar::core
