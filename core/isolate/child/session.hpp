// SPDX-License-Identifier: BSD-3-Clause
// The child's side of an isolated component: its own instance, its own arrays of inputs and outputs over the
// shared memory.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "core/isolate/shared.hpp"
#include "core/loader/script.hpp"

namespace fulmar::core {

/// What the host asks for on the command line.
struct Order {
  const char *copy, *script, *path, *file;
  std::size_t index;
  std::uint64_t seed;
};

class Session {
 public:
  Session(std::byte* memory, std::size_t size) : memory_(memory), size_(size) {}

  /// Loads the plugin and creates the component. Throws Error.
  void open(const Order& order);
  /// Does what the host asks until it asks for the end.
  void serve();
  void close() noexcept;
  /// Answers call 1, the set-up.
  void answer(std::uint32_t number, std::uint32_t status, const fulmar_error& error) noexcept;
  ControlBlock& control() const noexcept { return *reinterpret_cast<ControlBlock*>(memory_); }

 private:
  template <class T>
  T* at(std::size_t offset) const noexcept {
    return reinterpret_cast<T*>(memory_ + offset);
  }
  void load(const Order& order);
  void check(const std::vector<ComponentInfo>& components, const Order& order);
  void build();
  std::uint32_t wait(std::uint32_t done) noexcept;
  std::uint32_t run(Call call, fulmar_error& error);
  std::uint32_t step(fulmar_error& error) noexcept;
  std::uint32_t activate(fulmar_error& error) noexcept;
  std::uint32_t configure(fulmar_error& error);
  std::uint32_t retune(fulmar_error& error) noexcept;
  void take_inputs() noexcept;
  void bind_input(const Place& place, const SharedInput& from, fulmar_input& to) noexcept;

  std::byte* memory_;
  std::size_t size_;
  const fulmar_plugin* plugin_ = nullptr;  // of the file, or of the script
  std::unique_ptr<Script> script_;
  fulmar_component functions_{};
  void* instance_ = nullptr;
  ComponentInfo info_;
  std::vector<Layout> layout_;  // one, once the tables are known
  std::vector<fulmar_input> inputs_, last_;
  std::vector<fulmar_output> outputs_;
  std::vector<fulmar_value> values_;
  std::vector<std::string> texts_;
  std::vector<std::vector<std::byte>> data_;  // of records and blobs, until the next configure
  std::int64_t heap_at_configure_ = 0;
};

}  // namespace fulmar::core
