// SPDX-License-Identifier: BSD-3-Clause
// The child's side of an isolated component: its own instance, and arrays of inputs and outputs over the
// shared memory.
#include "core/isolate/child/session.hpp"

#include <sys/mman.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/isolate/child/fork.hpp"
#include "core/isolate/child/heap.hpp"
#include "core/isolate/messages.hpp"
#include "core/loader/float_mode.hpp"
#include "core/loader/library.hpp"
#include "core/loader/messages.hpp"
#include "core/loader/script.hpp"
#include "core/loader/shared_object.hpp"
#include "core/loader/table.hpp"
#include "core/original.hpp"

namespace fulmar::core {
namespace {

class Session {
 public:
  Session(std::byte* memory, std::size_t size) : memory_(memory), size_(size) {}

  /// Loads the plugin and creates the component. Throws Error.
  void open(const Order& order) {
    if (control().set_up.version != shared_version) throw Error(isolate_messages::child_version_differs());
    load(order);
    check(read_entry(*plugin_, order.file).components, order);
    const TableReader tables;
    functions_ = tables.element(plugin_->components, plugin_->component_stride,
                                static_cast<std::uint32_t>(order.index), "the components");
    build();
    control().stage = Stage::created;
    fulmar_error error{};
    original_mark.set();
    instance_ = functions_.create(order.seed, &error);
    if (!original_mark.is_set()) end_copy();
    error.text[sizeof error.text - 1] = '\0';
    if (!instance_)
      throw Error(error.text[0] ? Diagnostic(error.text) : isolate_messages::constructor_failed());
    control().stage = Stage::running;
  }

  // ---- the hand-shake

  void answer(std::uint32_t number, std::uint32_t status, const fulmar_error& error) noexcept {
    ControlBlock& c = control();
    c.status = status;
    c.has_error = error.text[0] != '\0' ? 1 : 0;
    if (c.has_error) std::memcpy(c.error.text, error.text, sizeof error.text);
    c.answer.store(number);  // sequentially consistent, before the read of host_sleeps, as in the host
    if (c.host_sleeps.load() != 0) futex_wake(c.answer);
  }

  /// Serves the host's calls until the call to end.
  void serve() {
    fulmar_error error{};
    for (std::uint32_t number = 1;;) {
      number = wait(number);
      const Call call = control().call;
      error.text[0] = '\0';
      std::uint32_t status = judged(call, error);
      if (!plain_arithmetic()) {
        make_arithmetic_plain();
        loader_messages::float_mode_changed.write(error.text, sizeof error.text);
        status = FULMAR_FAILED;
      }
      answer(number, status, error);
      if (call == Call::quit) return;
    }
  }

  ControlBlock& control() const noexcept { return *reinterpret_cast<ControlBlock*>(memory_); }

 private:
  template <class T>
  T* at(std::size_t offset) const noexcept {
    return reinterpret_cast<T*>(memory_ + offset);
  }

  // Wakes once a second to check that the host exists: the kernel's signal of its death depends on one of its
  // threads.
  std::uint32_t wait(std::uint32_t done) noexcept {
    ControlBlock& c = control();
    const auto asked = [&] { return c.request.load(std::memory_order_acquire) != done; };
    if (spin_until(c.set_up.spin_ns, asked)) return c.request.load(std::memory_order_acquire);
    while (!asked()) {
      c.child_sleeps.store(1);
      if (c.request.load() == done) futex_wait(c.request, done, 1'000'000'000);
      c.child_sleeps.store(0, std::memory_order_relaxed);
      if (!asked() && ::getppid() != c.set_up.host_pid) ::_exit(1);
    }
    return c.request.load(std::memory_order_acquire);
  }

  // ---- set-up

  void load(const Order& order) {
    const FloatModeGuard guard;
    static SharedObject library;  // open as long as the child lives
    library.load(order.copy, order.file);
    plugin_ = &library.entry(order.file);
    if (!*order.script) return;
    if (plugin_->abi_major != FULMAR_ABI_MAJOR)
      throw Error(located(std::string(order.file), isolate_messages::host_abi_differs()));
    script_ = std::make_unique<Script>(*plugin_, order.path, read_script(order.script));
    plugin_ = &script_->entry();
  }

  // Checks the tables again: the copy may have changed since the host read it.
  void check(const std::vector<ComponentInfo>& components, const Order& order) {
    const std::string wanted = control().set_up.component;
    if (order.index >= components.size() || components[order.index].name != wanted)
      throw Error(isolate_messages::component_moved(order.file, wanted, order.index));
    info_ = components[order.index];
    layout_.emplace_back(info_);
    if (layout_[0].signature != control().set_up.signature ||
        layout_[0].size != control().set_up.layout_size || layout_[0].size > size_)
      throw Error(located(std::string(order.file), isolate_messages::tables_differ(wanted)));
  }

  void build() {
    const Layout& layout = layout_[0];
    inputs_.resize(layout.inputs.size());
    last_.resize(layout.last.size());
    values_.resize(info_.params.size());
    texts_.resize(values_.size());
    for (std::size_t i = 0; i < values_.size(); ++i) values_[i].text = "";
    for (const Place& place : layout.outputs) {
      fulmar_output output{};
      output.data = at<void>(place.data);
      output.stamps_ns = at<std::int64_t>(place.stamps ? place.stamps : place.data);
      outputs_.push_back(output);
    }
  }

  // ---- calls

  void bind_input(const Place& place, const SharedInput& from, fulmar_input& to) noexcept {
    to = {};
    if (from.has & has_data) to.data = at<void>(place.data);
    if (from.has & has_stamps) to.stamps_ns = at<std::int64_t>(place.stamps);
    if (from.has & has_answers) to.answers = at<fulmar_answer>(place.answers);
    to.valid_at_ns = from.valid_at_ns;
    to.age_ns = from.age_ns;
    to.sequence = from.sequence;
    to.count = from.count;
    to.lost = from.lost;
    to.flags = from.flags;
  }

  void take_inputs() noexcept {
    const Layout& layout = layout_[0];
    const SharedInput* heads = at<SharedInput>(layout.inputs_at);
    for (std::size_t i = 0; i < inputs_.size(); ++i) bind_input(layout.inputs[i], heads[i], inputs_[i]);
  }

  std::uint32_t step(fulmar_error& error) noexcept {
    take_inputs();
    SharedOutput* heads = at<SharedOutput>(layout_[0].outputs_at);
    for (std::size_t i = 0; i < outputs_.size(); ++i) {
      outputs_[i].valid_at_ns = heads[i].valid_at_ns;
      outputs_[i].count = heads[i].count;
      outputs_[i].lost = heads[i].lost;
    }
    const fulmar_tick tick = control().tick;
    const std::uint64_t calls = heap_calls();
    const std::uint32_t status = functions_.step(instance_, &tick, inputs_.data(), outputs_.data(), &error);
    control().allocations += heap_calls() - calls;
    control().heap_growth = heap_bytes() - heap_at_configure_;
    for (std::size_t i = 0; i < outputs_.size(); ++i)
      heads[i] = {outputs_[i].valid_at_ns, outputs_[i].count, outputs_[i].lost};
    return status;
  }

  std::uint32_t activate(fulmar_error& error) noexcept {
    if (!functions_.activate) return FULMAR_OK;
    take_inputs();
    const SharedInput* heads = at<SharedInput>(layout_[0].last_at);
    for (std::size_t i = 0; i < last_.size(); ++i) bind_input(layout_[0].last[i], heads[i], last_[i]);
    const fulmar_tick tick = control().tick;
    return functions_.activate(instance_, &tick, inputs_.data(), last_.data(), &error);
  }

  std::uint32_t retune(fulmar_error& error) noexcept {
    if (!functions_.retune) return FULMAR_OK;
    const SharedValue* heads = at<SharedValue>(layout_[0].values_at);
    for (std::size_t i = 0; i < values_.size(); ++i) {
      std::memcpy(values_[i].number, heads[i].number, sizeof values_[i].number);
      values_[i].integer = heads[i].integer;
      values_[i].data = nullptr;
      values_[i].size = heads[i].size;
      if (layout_[0].texts[i].capacity > 0) values_[i].text = at<char>(layout_[0].texts[i].at);
    }
    return functions_.retune(instance_, values_.data(), &error);
  }

  // The previous values stay until the component has taken the new ones.
  std::uint32_t configure(fulmar_error& error) {
    const SharedValue* heads = at<SharedValue>(layout_[0].values_at);
    const std::size_t size = control().set_up.values_size;
    void* window = nullptr;
    if (size > 0)
      window = ::mmap(nullptr, size, PROT_READ, MAP_SHARED, shared_descriptor,
                      static_cast<off_t>(layout_[0].size));
    if (window == MAP_FAILED) throw Error(isolate_messages::parameters_not_readable(std::strerror(errno)));
    const std::byte* from = static_cast<const std::byte*>(window);
    std::vector<std::string> texts(values_.size());
    std::vector<std::vector<std::byte>> data(values_.size());
    for (std::size_t i = 0; i < values_.size(); ++i) {
      const SharedValue& v = heads[i];
      texts[i] = reinterpret_cast<const char*>(from + v.text_at);
      if (v.has & has_data) data[i].assign(from + v.data_at, from + v.data_at + v.size);
      if ((v.has & has_data) && v.size == 0) data[i].reserve(1);  // an empty value must still have a pointer
      values_[i] = {{v.number[0], v.number[1], v.number[2]},
                    v.integer,
                    texts[i].c_str(),
                    v.has & has_data ? data[i].data() : nullptr,
                    v.size};
    }
    if (window) ::munmap(window, size);
    const std::uint32_t status = functions_.configure(instance_, values_.data(), &error);
    texts_.swap(texts);
    data_.swap(data);
    for (std::size_t i = 0; i < values_.size(); ++i) values_[i].text = texts_[i].c_str();
    return status;
  }

  void close() noexcept {
    functions_.destroy(instance_);
    script_.reset();
  }

  /// A forked copy of this process must not return from the call.
  std::uint32_t judged(Call call, fulmar_error& error) {
    original_mark.set();
    refuses_forks = call != Call::configure && call != Call::quit;
    const std::uint32_t status = run(call, error);
    refuses_forks = false;
    if (!original_mark.is_set()) end_copy();
    const char* const fork = std::exchange(refused_fork, nullptr);
    if (fork == nullptr) return status;
    isolate_messages::fork_refused.write(error.text, sizeof error.text, fork, copy_would_fly);
    return FULMAR_FAILED;
  }

  std::uint32_t run(Call call, fulmar_error& error) {
    switch (call) {
      case Call::step: return step(error);
      case Call::activate: return activate(error);
      case Call::retune: return retune(error);
      case Call::deactivate:
        if (functions_.deactivate) functions_.deactivate(instance_);
        return FULMAR_OK;
      case Call::configure: {
        const std::uint32_t status = configure(error);
        heap_at_configure_ = heap_bytes();
        control().heap_growth = 0;
        return status;
      }
      case Call::quit: close(); return FULMAR_OK;
      case Call::create: break;
    }
    return FULMAR_FAILED;
  }

  std::byte* memory_;
  std::size_t size_;
  const fulmar_plugin* plugin_ = nullptr;  // of the file, or of the script
  std::unique_ptr<Script> script_;
  fulmar_component functions_{};
  void* instance_ = nullptr;
  ComponentInfo info_;
  std::vector<Layout> layout_;  // one element, once the tables are read
  std::vector<fulmar_input> inputs_, last_;
  std::vector<fulmar_output> outputs_;
  std::vector<fulmar_value> values_;
  std::vector<std::string> texts_;
  std::vector<std::vector<std::byte>> data_;  // of records and blobs, until the next configure
  std::int64_t heap_at_configure_ = 0;
};

}  // namespace

int serve(std::byte* memory, std::size_t size, const Order& order) {
  Session session(memory, size);
  try {
    session.open(order);
  } catch (const std::exception& fault) {
    fulmar_error error{};
    std::snprintf(error.text, sizeof error.text, "%s", fault.what());
    session.answer(1, FULMAR_FAILED, error);
    return 1;
  }
  session.answer(1, FULMAR_OK, {});
  session.serve();
  return 0;
}

}  // namespace fulmar::core
