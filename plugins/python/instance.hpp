// SPDX-License-Identifier: BSD-3-Clause
// One component in flight: copies samples into the memory of its Python views, calls, and copies results out.
#pragma once
#include <pybind11/pybind11.h>

#include <cstdint>
#include <string>
#include <vector>

#include "fulmar/abi.h"

namespace fulmar::python {

// Layouts of the data behind a message in the views of runtime.py: _META, _ITEM_META, _EVENT_META, _Head,
// Tick.
struct ValueMeta {
  std::int64_t valid_at_ns;
  double age_s;
  std::uint64_t sequence;
  bool fresh, stale, present;
};
struct ItemMeta {
  std::int64_t valid_at_ns;
  std::uint32_t verdict;
  char reason[sizeof(fulmar_answer::reason)];
};
struct EventMeta {
  std::int64_t valid_at_ns;
  bool written, dated;
};
struct QueueHead {
  std::uint32_t count, lost;
};
struct TickView {
  std::int64_t now_ns, dt_ns;
  std::uint64_t index;
  double now_s, dt_s;
};

class Instance {
 public:
  /// `described` is a _Described of runtime.py; messages name `file`. Throws pybind11::error_already_set.
  Instance(const pybind11::handle& described, const std::string& file, std::uint64_t seed);

  // As in abi.h. The caller holds the interpreter's lock. No exception.
  std::uint32_t configure(const fulmar_value* values, fulmar_error* error) noexcept;
  std::uint32_t retune(const fulmar_value* values, fulmar_error* error) noexcept;
  std::uint32_t activate(const fulmar_tick& tick, const fulmar_input* inputs, const fulmar_input* last,
                         fulmar_error* error) noexcept;
  void deactivate() noexcept;
  std::uint32_t step(const fulmar_tick& tick, const fulmar_input* inputs, fulmar_output* outputs,
                     fulmar_error* error) noexcept;
  std::uint32_t read(fulmar_tick& tick, fulmar_output* outputs, fulmar_error* error) noexcept;
  std::uint32_t write(const fulmar_tick& tick, const fulmar_input* inputs, fulmar_error* error) noexcept;

 private:
  struct Input {
    std::uint32_t kind = 0;
    std::byte* at = nullptr;  // of the message, or of the first item
    std::size_t size = 0, meta = 0, stride = 0;
    std::uint32_t capacity = 1;
    QueueHead* head = nullptr;
  };
  struct Output {
    std::uint32_t kind = 0;
    pybind11::object name, own, previous;  // attribute; value that the author sets; value applied last
    std::byte* at = nullptr;
    std::size_t size = 0, meta = 0;  // in a queue, meta is the offset of the stamps
    std::uint32_t capacity = 1;
    QueueHead* head = nullptr;
    std::byte* previous_at = nullptr;
  };
  struct Parameter {
    std::uint32_t kind = 0;
    pybind11::object name, choices, value;
    std::byte* at = nullptr;
    std::size_t size = 0, meta = 0;
  };

  void read_places(const pybind11::handle& instance);
  void show(const fulmar_tick& tick) noexcept;
  void show(const fulmar_input* inputs) noexcept;
  void answer(const fulmar_input* inputs) noexcept;
  void forget() noexcept;
  bool give(fulmar_output* outputs) noexcept;
  bool check_names() noexcept;
  bool take(const fulmar_value* values) noexcept;
  bool take(Parameter& param, const fulmar_value& value);
  bool show_last(const fulmar_input* last) noexcept;
  std::uint32_t call(const pybind11::object& method, PyObject* const* arguments, std::size_t count,
                     fulmar_error* error) noexcept;
  std::uint32_t fail(fulmar_error* error, bool print = true) noexcept;

  std::string file_;
  pybind11::object instance_;  // owns all memory
  pybind11::object step_, read_, write_, configure_, retune_, activate_, deactivate_;
  pybind11::object tick_, inp_, out_, last_, p_;
  TickView* tick_view_ = nullptr;
  std::vector<Input> inputs_;
  std::vector<Output> outputs_;
  std::vector<Parameter> params_;
};

}  // namespace fulmar::python
