// SPDX-License-Identifier: BSD-3-Clause
#include "interpreter.hpp"

#include <dlfcn.h>

#include <cstdlib>
#include <cstring>
#include <stdexcept>

#include "messages.hpp"

// The text of fulmar_plugin.py, runtime.py and texts.py.
extern "C" const char fulmar_plugin_source[], fulmar_runtime_source[], fulmar_texts_source[];

namespace fulmar::python {
namespace {

PyObject* runtime_module = nullptr;  // lives as long as the process

// Extension modules in C are not linked to libpython: they look for its functions in the global scope of the
// process. After a host has loaded this plugin with RTLD_LOCAL, libpython is not in that scope.
void show_library() {
  Dl_info info{};
  if (::dladdr(reinterpret_cast<const void*>(&Py_InitializeFromConfig), &info) == 0 ||
      info.dli_fname == nullptr)
    return;
  ::dlopen(info.dli_fname, RTLD_NOW | RTLD_GLOBAL | RTLD_NOLOAD);
}

void check(const PyStatus& status, PyConfig& config) {
  if (!PyStatus_Exception(status)) return;
  const std::string why = status.err_msg != nullptr ? status.err_msg : "it does not say why";
  PyConfig_Clear(&config);
  throw std::runtime_error("Python cannot be started: " + why);
}

// An active virtual environment provides its packages, as for the program python3.
std::string executable() {
  const char* environment = std::getenv("VIRTUAL_ENV");
  return environment != nullptr && *environment != '\0' ? std::string(environment) + "/bin/python3"
                                                        : FULMAR_PYTHON_EXECUTABLE;
}

void initialize() {
  show_library();
  PyConfig config;
  PyConfig_InitPythonConfig(&config);
  config.install_signal_handlers = 0;  // the host handles signals
  config.parse_argv = 0;
  config.use_hash_seed = 1;  // the order of a set of strings is the same in every flight
  config.hash_seed = 0;
  config.write_bytecode = 0;  // no __pycache__ in the author's folder, and none older than its source
  config.buffered_stdio = 0;
  check(PyConfig_SetBytesString(&config, &config.executable, executable().c_str()), config);
  check(PyConfig_SetBytesString(&config, &config.program_name, executable().c_str()), config);
  check(Py_InitializeFromConfig(&config), config);
  PyConfig_Clear(&config);
  // Output of a script goes to stderr: a program may read the host's standard output.
  PyRun_SimpleString("import sys\nsys.stdout = sys.stderr\n");
  PyEval_SaveThread();  // from here on each caller takes the lock
}

py::module_ make_module(const char* name, const char* file, const char* source) {
  const auto module = py::reinterpret_borrow<py::module_>(PyImport_AddModule(name));
  const py::object code = py::reinterpret_steal<py::object>(Py_CompileString(source, file, Py_file_input));
  if (!code) throw py::error_already_set();
  py::dict scope = module.attr("__dict__");
  scope["__builtins__"] = py::module_::import("builtins");
  if (!py::reinterpret_steal<py::object>(PyEval_EvalCode(code.ptr(), scope.ptr(), scope.ptr())))
    throw py::error_already_set();
  return module;
}

void make_modules() {
  make_module("fulmar_plugin_texts", "fulmar_plugin_texts.py", fulmar_texts_source);
  const py::module_ plugin = make_module("fulmar_plugin", "fulmar_plugin.py", fulmar_plugin_source);
  plugin.attr("_units") = unit_rules();
  plugin.attr("_share")(message_tables());
  runtime_module =
      make_module("fulmar_plugin_runtime", "fulmar_plugin_runtime.py", fulmar_runtime_source).release().ptr();
}

}  // namespace

void start() {
  if (runtime_module != nullptr) return;
  if (Py_IsInitialized() == 0) initialize();
  std::string fault;
  {
    const Gil gil;
    try {
      make_modules();
    } catch (const std::exception& e) {
      fault = e.what();
    }
  }
  if (!fault.empty()) throw std::runtime_error("the module fulmar_plugin cannot be made: " + fault);
}

const py::module_& runtime() {
  static const auto module = py::reinterpret_borrow<py::module_>(runtime_module);
  return module;
}

void report(fulmar_error* error, const std::string& text) noexcept {
  if (error == nullptr) return;
  constexpr std::size_t room = sizeof error->text - 1;
  std::size_t n = text.size();
  if (n > room)
    for (n = room - 3; n > 0 && (static_cast<unsigned char>(text[n]) & 0xc0u) == 0x80u;)
      --n;  // not inside a UTF-8 sequence
  std::memcpy(error->text, text.data(), n);
  std::memcpy(error->text + n, "...", text.size() > room ? 4 : 1);
  if (text.size() <= room) error->text[n] = '\0';
}

void explain(const std::string& file, bool print, fulmar_error* error) noexcept {
  report(error, "raised an exception that cannot be explained");
  try {
    PyObject *type = nullptr, *value = nullptr, *trace = nullptr;
    PyErr_Fetch(&type, &value, &trace);
    PyErr_NormalizeException(&type, &value, &trace);
    if (value != nullptr && trace != nullptr) PyException_SetTraceback(value, trace);
    const auto kept_type = py::reinterpret_steal<py::object>(type),
               fault = py::reinterpret_steal<py::object>(value);
    const auto kept_trace = py::reinterpret_steal<py::object>(trace);
    if (!fault) return;
    report(error, py::str(runtime().attr("_explain")(fault, file)));
    if (print) runtime().attr("_tell")(fault, file);
  } catch (const std::exception&) {
    PyErr_Clear();
  }
}

}  // namespace fulmar::python
