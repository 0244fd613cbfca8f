// SPDX-License-Identifier: BSD-3-Clause
// A component in a child process, behind the same function table as one in this process: a fault costs one
// step, not the host. Arguments go through shared memory to fulmar-child, which loads the same file and calls
// the same functions: same ABI, same bytes.
#pragma once
#include <sys/types.h>

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "core/isolate/shared.hpp"
#include "core/isolate/shared_memory.hpp"
#include "core/loader/process.hpp"

namespace fulmar::core {

struct IsolatedOptions {
  std::string name;          // of the component in the mission, for messages
  std::string copy, script;  // PluginInfo::copy, PluginInfo::script
  std::string file;          // PluginInfo::file, for messages
  // PluginInfo::path, for a script that loads files beside it; unused for a shared object
  std::string path;
  std::size_t index = 0;  // of the component in the plugin
  std::uint64_t seed = 0;
  std::int64_t hang_ns = 2'000'000'000;    // longest wait for a step, activate, deactivate or retune
  std::int64_t setup_ns = 10'000'000'000;  // longest wait for loading and creating, and for configure
  // time of busy waiting before a side sleeps; 0, or a single CPU: sleep at once
  std::int64_t spin_ns = 20'000;
};

class Isolated {
 public:
  /// [setup] Spawns the child; it loads the plugin and creates the component. Throws Error. The child ends
  /// with the thread that called this, at the latest.
  Isolated(const ComponentInfo& info, const IsolatedOptions& options);
  ~Isolated();

  /// Function table of a component whose instance is an Isolated*. `create` is NULL; `destroy` does nothing:
  /// the owner's destructor ends the child.
  static const fulmar_component& functions();

  /// State at the last call.
  bool alive() const noexcept { return alive_; }
  /// [setup] Whether the child lives now: between flights no call detects its end.
  bool check() noexcept;
  /// Marks the child as dead with the given reason: for the replay of a flight in which it died.
  void die(const char* death, bool hung) noexcept;
  /// How the child died: "crashed (segmentation fault)", "ended itself (exit code 3)", "hung: no answer
  /// within 20 ms". "" while it lives.
  const char* death() const noexcept { return death_; }
  /// Whether it died because it did not answer in time.
  bool hung() const noexcept { return hung_; }
  /// Heap calls of all steps so far. 0 where the child cannot count.
  std::uint64_t allocations() const noexcept { return control().allocations; }
  /// Growth of its heap since configure, bytes.
  std::int64_t heap_growth() const noexcept { return control().heap_growth; }
  pid_t pid() const noexcept { return process_.pid(); }

  /// [setup] Destroys the component and ends the child, if `end` has not run before. Returns the fault, or
  /// "".
  std::string end();

 private:
  struct Sample {  // content of a value input at its last copy
    const void* data = nullptr;
    std::uint64_t sequence = 0;
    std::int64_t valid_at_ns = 0;
  };
  ControlBlock& control() const noexcept { return *reinterpret_cast<ControlBlock*>(memory_.data()); }
  template <class T>
  T* at(std::size_t offset) const noexcept {
    return reinterpret_cast<T*>(memory_.data() + offset);
  }
  void prepare();
  [[noreturn]] void refuse_setup();

  std::uint32_t configure(const fulmar_value* values, fulmar_error* error);
  std::uint32_t retune(const fulmar_value* values, fulmar_error* error) noexcept;
  std::uint32_t activate(const fulmar_tick* tick, const fulmar_input* inputs, const fulmar_input* last,
                         fulmar_error* error) noexcept;
  std::uint32_t step(const fulmar_tick* tick, const fulmar_input* inputs, fulmar_output* outputs,
                     fulmar_error* error) noexcept;
  static Isolated& self(void* instance) { return *static_cast<Isolated*>(instance); }
  void put_tick_inputs(const fulmar_tick* tick, const fulmar_input* inputs) noexcept;
  void put_input(const Place& place, SharedInput& to, const fulmar_input& from, Sample& copied) noexcept;
  void take_answers(const fulmar_input* inputs) noexcept;
  void put_outputs(const fulmar_output* outputs) noexcept;
  void take_outputs(fulmar_output* outputs) noexcept;
  void put_last(const fulmar_input* last) noexcept;

  std::uint32_t call(Call what, std::int64_t limit_ns, fulmar_error* error) noexcept;
  bool wait(std::int64_t limit_ns) noexcept;
  bool answered() const noexcept { return control().answer.load(std::memory_order_acquire) == number_; }
  bool has_ended() noexcept;
  void note_death() noexcept;
  std::uint32_t dead(fulmar_error* error) noexcept;

  ComponentInfo info_;
  IsolatedOptions options_;
  Layout layout_;
  SharedMemory memory_;
  std::vector<Sample> copied_;
  std::uint32_t number_ = 1;  // of the call under way
  bool alive_ = true, finished_ = false, hung_ = false;
  char death_[96] = "";
  Process process_;  // last member: needs the prepared memory, and ends first
};

}  // namespace fulmar::core
