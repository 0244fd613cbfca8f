// SPDX-License-Identifier: BSD-3-Clause
// Drives a component of isolate_lab through its function table, in this process or in a child, and stores the
// outputs.
#pragma once
#include <doctest/doctest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include "core/isolate/isolated.hpp"
#include "core/isolate/test/faults.hpp"
#include "core/loader/library.hpp"

namespace workshop {

using namespace fulmar::core;
using namespace isolate_lab;

struct Signal {  // as in plugin.cpp
  double x_m = 0, y_m = 0;
  std::uint32_t turn = 0;
};
struct Table {
  double gain_ratio[40] = {};
  std::uint32_t used = 0;
};
struct Ask {
  double to_m = 0;
};

inline std::shared_ptr<Library> lab() {
  static const std::shared_ptr<Library> library = Library::open(FULMAR_TEST_PLUGIN_DIR "/isolate_lab.so");
  return library;
}

inline std::size_t place_of(const std::string& component) {
  const auto& all = lab()->info().components;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (all[i].name == component) return i;
  FAIL("no component " << component);
  return 0;
}

inline IsolatedOptions options_for(const std::string& component) {
  IsolatedOptions o;
  o.name = "mine";
  o.copy = lab()->info().copy;
  o.file = lab()->info().file;
  o.index = place_of(component);
  o.seed = 7;
  return o;
}

/// Memory of the ports of a component, as in the loop.
class Rig {
 public:
  explicit Rig(const std::string& component) : info(lab()->info().components[place_of(component)]) {
    for (const Port& port : info.inputs) {
      const std::size_t size = port.type->size;
      in_data.emplace_back(size * port.capacity);
      in_stamps.emplace_back(port.capacity);
      answers.emplace_back(port.capacity);
      inputs.emplace_back();
    }
    for (const Port& port : info.outputs) {
      const std::size_t size = port.type ? port.type->size : sizeof(double);
      out_data.emplace_back(size * port.capacity);
      out_stamps.emplace_back(port.capacity);
      last_data.emplace_back(size);
      outputs.emplace_back();
      last.emplace_back();
    }
    for (const ParamInfo& p : info.params) {
      fulmar_value v{};
      std::copy(std::begin(p.initial), std::end(p.initial), v.number);
      v.integer = static_cast<std::int64_t>(p.initial[0]);
      v.text = p.initial_text.c_str();
      v.data = p.initial_data.empty() ? nullptr : p.initial_data.data();
      v.size = p.initial_data.size();
      values.push_back(v);
    }
  }

  /// In this process.
  void here(std::uint64_t seed = 7) {
    table = &lab()->functions(place_of(info.name));
    instance = table->create(seed, &error);
    REQUIRE(instance != nullptr);
  }
  /// In a child.
  void there(const IsolatedOptions& options) {
    child = std::make_unique<Isolated>(info, options);
    table = &Isolated::functions();
    instance = child.get();
  }
  void there() { there(options_for(info.name)); }
  ~Rig() {
    if (instance) table->destroy(instance);
  }
  Rig(const Rig&) = delete;
  Rig& operator=(const Rig&) = delete;

  fulmar_value& value(const std::string& param) {
    return values.at(static_cast<std::size_t>(info.param(param)));
  }
  void choose(const std::string& param, int choice) { value(param).integer = choice; }
  std::uint32_t configure() {
    error.text[0] = '\0';
    return table->configure(instance, values.data(), &error);
  }
  std::uint32_t retune() {
    error.text[0] = '\0';
    std::vector<fulmar_value> live = values;
    for (fulmar_value& v : live) v.data = nullptr;
    return table->retune(instance, live.data(), &error);
  }
  std::uint32_t activate() {
    error.text[0] = '\0';
    return table->activate(instance, &tick, inputs.data(), last.data(), &error);
  }
  std::uint32_t step() {
    error.text[0] = '\0';
    for (std::size_t i = 0; i < outputs.size(); ++i)
      outputs[i] = {out_data[i].data(), out_stamps[i].data(), tick.now_ns, 0, 0};
    return table->step(instance, &tick, inputs.data(), outputs.data(), &error);
  }
  /// A first input of one Signal.
  void give(const Signal& signal) {
    std::memcpy(in_data[0].data(), &signal, sizeof signal);
    inputs[0].data = in_data[0].data();
    inputs[0].count = 1;
    inputs[0].flags = FULMAR_FRESH;
    ++inputs[0].sequence;
  }
  Signal first_output() const {
    Signal s;
    std::memcpy(&s, out_data[0].data(), sizeof s);
    return s;
  }
  std::string text() const { return error.text; }

  const ComponentInfo info;
  std::unique_ptr<Isolated> child;
  const fulmar_component* table = nullptr;
  void* instance = nullptr;
  std::vector<std::vector<std::byte>> in_data, out_data, last_data;
  std::vector<std::vector<std::int64_t>> in_stamps, out_stamps;
  std::vector<std::vector<fulmar_answer>> answers;
  std::vector<fulmar_input> inputs, last;
  std::vector<fulmar_output> outputs;
  std::vector<fulmar_value> values;
  fulmar_tick tick{0, 2'500'000, 0};
  fulmar_error error{};
};

inline bool zombie_or_gone(pid_t pid) {
  std::ifstream in("/proc/" + std::to_string(pid) + "/stat");
  std::string word, state;
  if (!(in >> word)) return true;
  while (in >> state && state.size() != 1) continue;  // the name in parentheses may contain blanks
  return state == "Z" || state == "X";
}

inline bool soon(int limit_ms, bool (*done)(pid_t), pid_t pid) {
  for (int i = 0; i < limit_ms; ++i, ::usleep(1000))
    if (done(pid)) return true;
  return false;
}

inline bool no_children() { return ::waitpid(-1, nullptr, WNOHANG) == -1 && errno == ECHILD; }

}  // namespace workshop
