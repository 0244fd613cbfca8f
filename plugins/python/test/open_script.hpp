// SPDX-License-Identifier: BSD-3-Clause
// Drives a Python component through the binary contract alone, as the host does.
#pragma once
#include <dlfcn.h>
#include <doctest/doctest.h>

#include <cstring>
#include <map>
#include <string>
#include <vector>

#include "fulmar/abi.h"

namespace script_test {

inline const fulmar_plugin& host() {
  static const fulmar_plugin* const entry = [] {
    void* library = ::dlopen(FULMAR_PLUGIN_DIR "/python.so", RTLD_NOW | RTLD_LOCAL);
    if (library == nullptr) FAIL(::dlerror());
    return static_cast<const fulmar_plugin*>(::dlsym(library, FULMAR_ENTRY_SYMBOL));
  }();
  return *entry;
}

/// Why a script is not opened.
inline std::string refusal(const std::string& text, const std::string& file = "/nowhere/law.py") {
  fulmar_error error{};
  const fulmar_plugin* plugin = host().open_script(file.c_str(), text.data(), text.size(), &error);
  if (plugin == nullptr) return error.text;
  host().close_script(plugin);
  return "opened";
}

/// One component of a script, with one sample of room at each port.
class Law {
 public:
  explicit Law(const std::string& text, const std::string& name = "",
               const std::string& file = "/nowhere/law.py", std::uint64_t seed = 1) {
    plugin_ = host().open_script(file.c_str(), text.data(), text.size(), &error);
    if (plugin_ == nullptr) FAIL(error.text);
    for (std::uint32_t i = 0; i < plugin_->component_count; ++i)
      if (name.empty() || name == plugin_->components[i].name) {
        c = &plugin_->components[i];
        break;
      }
    REQUIRE(c != nullptr);
    inputs.resize(c->input_count);
    outputs.resize(c->output_count);
    last.resize(c->output_count);
    values.resize(c->param_count);
    for (std::uint32_t i = 0; i < c->param_count; ++i) {
      const fulmar_param& p = c->params[i];
      std::memcpy(values[i].number, p.initial, sizeof p.initial);
      values[i].integer = static_cast<std::int64_t>(p.initial[0]);
      values[i].text = p.initial_text;
    }
    for (std::uint32_t i = 0; i < c->output_count; ++i) {
      const fulmar_port& port = c->outputs[i];
      room_.emplace_back(port.type == nullptr ? 8 : std::size_t{port.type->size} * port.capacity);
      stamps_.emplace_back(port.capacity);
    }
    instance_ = c->create(seed, &error);
  }
  ~Law() {
    if (instance_ != nullptr) c->destroy(instance_);
    host().close_script(plugin_);
  }
  Law(const Law&) = delete;
  Law& operator=(const Law&) = delete;

  bool created() const { return instance_ != nullptr; }
  std::uint32_t configure() { return c->configure(instance_, values.data(), clear()); }
  std::uint32_t retune() { return c->retune(instance_, values.data(), clear()); }
  std::uint32_t activate() { return c->activate(instance_, &tick, inputs.data(), last.data(), clear()); }
  std::uint32_t step() {
    prepare();
    return c->step(instance_, &tick, inputs.data(), outputs.data(), clear());
  }
  std::uint32_t read() {
    prepare();
    return c->read(instance_, &tick, outputs.data(), clear());
  }
  std::uint32_t write() { return c->write(instance_, &tick, inputs.data(), clear()); }

  std::size_t input(const std::string& name) const { return index(c->inputs, c->input_count, name); }
  std::size_t output(const std::string& name) const { return index(c->outputs, c->output_count, name); }
  std::size_t param(const std::string& name) const {
    for (std::uint32_t i = 0; i < c->param_count; ++i)
      if (name == c->params[i].name) return i;
    FAIL("no parameter " << name);
    return 0;
  }

  /// Provides a sample at a value input; its memory must stay valid.
  template <class T>
  void show(const std::string& name, const T& sample, std::uint64_t sequence = 1) {
    fulmar_input& in = inputs[input(name)];
    REQUIRE(sizeof(T) == c->inputs[input(name)].type->size);
    in.data = &sample;
    in.count = 1;
    in.sequence = sequence;
    in.flags = FULMAR_FRESH;
  }
  template <class T>
  T result(const std::string& name, std::size_t i = 0) const {
    T value;
    std::memcpy(&value, room_[output(name)].data() + i * sizeof(T), sizeof(T));
    return value;
  }
  const fulmar_output& out(const std::string& name) const { return outputs[output(name)]; }

  const fulmar_component* c = nullptr;
  fulmar_error error{};
  fulmar_tick tick{1'500'000'000, 10'000'000, 42};
  std::vector<fulmar_input> inputs, last;
  std::vector<fulmar_output> outputs;
  std::vector<fulmar_value> values;

 private:
  static std::size_t index(const fulmar_port* ports, std::uint32_t count, const std::string& name) {
    for (std::uint32_t i = 0; i < count; ++i)
      if (name == ports[i].name) return i;
    FAIL("no port " << name);
    return 0;
  }
  fulmar_error* clear() {
    error = {};
    return &error;
  }
  void prepare() {
    for (std::size_t i = 0; i < outputs.size(); ++i)
      outputs[i] = {room_[i].data(), stamps_[i].data(), tick.now_ns, 0, 0};
  }

  const fulmar_plugin* plugin_ = nullptr;
  void* instance_ = nullptr;
  std::vector<std::vector<std::byte>> room_;
  std::vector<std::vector<std::int64_t>> stamps_;
};

}  // namespace script_test
