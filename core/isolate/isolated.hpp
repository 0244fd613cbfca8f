// SPDX-License-Identifier: BSD-3-Clause
// A component in a child process, behind the same function table as one in this process: what it does wrong
// costs one step, not the host. Arguments go through shared memory to fulmar-child, which loads the same file
// and calls the same functions: same ABI, same bytes.
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
  // PluginInfo::path, for a script that loads what lies beside it; a shared object needs none
  std::string path;
  std::size_t index = 0;  // of the component in the plugin
  std::uint64_t seed = 0;
  std::int64_t hang_ns = 2'000'000'000;    // longest wait for a step, activate, deactivate or retune
  std::int64_t setup_ns = 10'000'000'000;  // longest wait for loading and creating, and for configure
  // both sides look so long before they sleep; 0, or a single CPU: they sleep at once
  std::int64_t spin_ns = 20'000;
};

class Isolated {
 public:
  /// [setup] Spawns the child; it loads the plugin and creates the component. Throws Error with a sentence.
  /// The child ends with the thread that called this, at the latest.
  Isolated(const ComponentInfo& info, const IsolatedOptions& options);
  ~Isolated();

  /// Calls of a component whose instance is an Isolated*. `create` is NULL; `destroy` does nothing: the
  /// owner's destructor ends the child.
  static const fulmar_component& functions();

  /// As of the last call.
  bool alive() const noexcept { return alive_; }
  /// [setup] Whether it lives now: between flights no call would tell.
  bool check() noexcept;
  /// It ends here and now, and `death` says what is given: of a child that died when this was flown before.
  void die(const char* death, bool hung) noexcept;
  /// How the child died: "crashed (segmentation fault)", "ended itself (exit code 3)", "hung: no answer
  /// within 20 ms". "" while it lives.
  const char* death() const noexcept { return death_; }
  /// Whether it died because it did not answer in time.
  bool hung() const noexcept { return hung_; }
  /// Heap calls of all steps so far. 0 where the child cannot count.
  std::uint64_t allocations() const noexcept { return control().allocations; }
  /// Bytes that its heap has grown by since configure.
  std::int64_t heap_growth() const noexcept { return control().heap_growth; }
  pid_t pid() const noexcept { return process_.pid(); }

  /// [setup] Destroys the component and ends the child; what the destructor does when nobody has. What went
  /// wrong in it, or "".
  std::string end();

 private:
  struct Sample {  // what a value input held when it was copied last
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
  Process process_;  // last: it needs the memory prepared, and ends first
};

}  // namespace fulmar::core
