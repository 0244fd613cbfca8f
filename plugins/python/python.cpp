// SPDX-License-Identifier: BSD-3-Clause
// The plugin that hosts components in Python. It has no components itself: open_script makes those of a file.
#include <pybind11/pybind11.h>

#include <array>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "instance.hpp"
#include "interpreter.hpp"
#include "tables.hpp"

namespace fulmar::python {
namespace {

/// Data for `create`. The contract gives `create` no argument but the seed, so each open class has a function
/// of its own.
struct Prototype {
  py::object described;
  std::string file;
};

constexpr std::size_t max_classes = 256;  // open at once in one process
std::array<Prototype*, max_classes> prototypes{};

Instance& self(void* instance) { return *static_cast<Instance*>(instance); }

void* create(const Prototype& prototype, std::uint64_t seed, fulmar_error* error) noexcept {
  const Gil gil;
  try {
    return new Instance(prototype.described, prototype.file, seed);
  } catch (py::error_already_set& e) {
    e.restore();
    explain(prototype.file, false, error);
  } catch (const std::exception& e) {
    report(error, e.what());
  }
  return nullptr;
}

template <std::size_t I>
void* create_of(std::uint64_t seed, fulmar_error* error) {
  return create(*prototypes[I], seed, error);
}

template <std::size_t... I>
constexpr auto make_creators(std::index_sequence<I...>) {
  return std::array<decltype(fulmar_component::create), sizeof...(I)>{&create_of<I>...};
}
constexpr auto creators = make_creators(std::make_index_sequence<max_classes>{});

void destroy(void* instance) {
  const Gil gil;
  delete static_cast<Instance*>(instance);
}
std::uint32_t configure(void* instance, const fulmar_value* values, fulmar_error* error) {
  const Gil gil;
  return self(instance).configure(values, error);
}
std::uint32_t retune(void* instance, const fulmar_value* values, fulmar_error* error) {
  const Gil gil;
  return self(instance).retune(values, error);
}
std::uint32_t activate(void* instance, const fulmar_tick* tick, const fulmar_input* inputs,
                       const fulmar_input* last, fulmar_error* error) {
  const Gil gil;
  return self(instance).activate(*tick, inputs, last, error);
}
void deactivate(void* instance) {
  const Gil gil;
  self(instance).deactivate();
}
std::uint32_t step(void* instance, const fulmar_tick* tick, const fulmar_input* inputs,
                   fulmar_output* outputs, fulmar_error* error) {
  const Gil gil;
  return self(instance).step(*tick, inputs, outputs, error);
}
std::uint32_t read(void* instance, fulmar_tick* tick, fulmar_output* outputs, fulmar_error* error) {
  const Gil gil;
  return self(instance).read(*tick, outputs, error);
}
std::uint32_t write(void* instance, const fulmar_tick* tick, const fulmar_input* inputs,
                    fulmar_error* error) {
  const Gil gil;
  return self(instance).write(*tick, inputs, error);
}

/// An open script: its module, the tables of its components, and their places in `prototypes`.
class OpenScript {
 public:
  OpenScript(const std::string& file, const py::bytes& text) {
    const auto opened = py::reinterpret_borrow<py::tuple>(
        runtime().attr("_open")(file, text));  // module, components, version
    module_ = opened[0];
    try {
      for (const py::handle& described : opened[1]) add(described, file);
    } catch (...) {
      give_back();
      throw;
    }
    plugin_.abi_major = FULMAR_ABI_MAJOR;
    plugin_.abi_minor = FULMAR_ABI_MINOR;
    plugin_.component_count = static_cast<std::uint32_t>(components_.size());
    plugin_.component_stride = sizeof(fulmar_component);
    plugin_.version = tables_.text(opened[2]);
    plugin_.toolchain = tables_.text(py::str("Python " PY_VERSION));
    plugin_.flags = "";
    plugin_.components = components_.data();
  }
  ~OpenScript() {
    give_back();
    try {
      runtime().attr("_close")(module_);
    } catch (const std::exception&) {
      PyErr_Clear();
    }
  }
  OpenScript(const OpenScript&) = delete;
  OpenScript& operator=(const OpenScript&) = delete;

  const fulmar_plugin& plugin() const { return plugin_; }

 private:
  void add(const py::handle& described, const std::string& file) {
    std::size_t slot = 0;
    while (slot < max_classes && prototypes[slot] != nullptr) ++slot;
    if (slot == max_classes)
      throw std::runtime_error("more than " + std::to_string(max_classes) + " Python classes are open");
    fulmar_component c = tables_.component(described);
    prototypes[slot] = new Prototype{py::reinterpret_borrow<py::object>(described), file};
    slots_.push_back(slot);
    c.create = creators[slot];
    c.destroy = &destroy;
    c.configure = &configure;
    c.retune = &retune;
    const py::object cls = described.attr("cls");
    if (py::hasattr(cls, "activate")) c.activate = &activate;
    if (py::hasattr(cls, "deactivate")) c.deactivate = &deactivate;
    if ((c.flags & FULMAR_VEHICLE) != 0) {
      c.read = &read;
      c.write = &write;
    } else
      c.step = &step;
    components_.push_back(c);
  }
  void give_back() {
    for (const std::size_t slot : slots_) delete std::exchange(prototypes[slot], nullptr);
    slots_.clear();
  }

  fulmar_plugin plugin_{};
  py::object module_;
  Tables tables_;
  std::vector<fulmar_component> components_;
  std::vector<std::size_t> slots_;
};

/// Never destroyed: at exit the interpreter may end first. Guarded by the interpreter's lock.
std::map<const fulmar_plugin*, std::unique_ptr<OpenScript>>& open_scripts() {
  static auto* const scripts = new std::map<const fulmar_plugin*, std::unique_ptr<OpenScript>>;
  return *scripts;
}

const fulmar_plugin* open_script(const char* file, const char* text, std::uint64_t size,
                                 fulmar_error* error) {
  try {
    start();
  } catch (const std::exception& e) {
    report(error, e.what());
    return nullptr;
  }
  const Gil gil;
  try {
    auto script = std::make_unique<OpenScript>(file, py::bytes(text, size));
    const fulmar_plugin* plugin = &script->plugin();
    open_scripts().emplace(plugin, std::move(script));
    return plugin;
  } catch (py::error_already_set& e) {
    e.restore();
    explain(file, false, error);
  } catch (const std::exception& e) {
    report(error, e.what());
  }
  return nullptr;
}

void close_script(const fulmar_plugin* plugin) {
  const Gil gil;
  open_scripts().erase(plugin);
}

}  // namespace
}  // namespace fulmar::python

#if defined(__clang__)
#define FULMAR_TOOLCHAIN "clang " __clang_version__
#else
#define FULMAR_TOOLCHAIN "gcc " __VERSION__
#endif

extern "C" {
__attribute__((visibility("default"))) extern const fulmar_plugin fulmar_plugin_entry;
constinit const fulmar_plugin fulmar_plugin_entry = {FULMAR_ABI_MAJOR,
                                                     FULMAR_ABI_MINOR,
                                                     0,
                                                     sizeof(fulmar_component),
                                                     FULMAR_VERSION,
                                                     FULMAR_TOOLCHAIN,
                                                     "",
                                                     nullptr,
                                                     &fulmar::python::open_script,
                                                     &fulmar::python::close_script};
}
