// SPDX-License-Identifier: BSD-3-Clause
// The Python interpreter of this process: started when the first script is opened, never stopped.
#pragma once
#include <pybind11/pybind11.h>

#include <string>

#include "fulmar/abi.h"

namespace fulmar::python {

namespace py = pybind11;

/// Holds the interpreter's lock, on any thread that the host calls from.
class Gil {
 public:
  Gil() {
    if (!known_) keep_thread();
    state_ = PyGILState_Ensure();
  }
  ~Gil() { PyGILState_Release(state_); }
  Gil(const Gil&) = delete;
  Gil& operator=(const Gil&) = delete;

 private:
  /// Python's state of a thread is kept when the thread releases the lock: a new state costs each step a
  /// memory mapping.
  static void keep_thread() {
    if (PyGILState_GetThisThreadState() == nullptr) {
      PyGILState_Ensure();
      PyEval_SaveThread();
    }
    known_ = true;
  }
  static inline thread_local bool known_ = false;
  PyGILState_STATE state_;
};

/// Starts the interpreter, unless the process has one, and makes the module fulmar_plugin. Throws
/// std::runtime_error.
void start();

/// The module of runtime.py.
const py::module_& runtime();

/// Moves the pending Python exception into `error` as one sentence. With `print` the whole traceback goes to
/// stderr.
void explain(const std::string& file, bool print, fulmar_error* error) noexcept;

/// Text that does not fit ends in "...".
void report(fulmar_error* error, const std::string& text) noexcept;

}  // namespace fulmar::python
