// SPDX-License-Identifier: BSD-3-Clause
// From the description of a component in Python (_Described in runtime.py) to the tables of abi.h.
#pragma once
#include <pybind11/pybind11.h>

#include <deque>
#include <map>
#include <string>
#include <vector>

#include "fulmar/abi.h"

namespace fulmar::python {

/// Owns all data that the tables point to. Addresses are valid during the life of the object.
class Tables {
 public:
  const char* text(const pybind11::handle& text);
  const fulmar_type* type(const pybind11::handle& message);
  /// Fills all fields but the functions.
  fulmar_component component(const pybind11::handle& described);

 private:
  const std::vector<fulmar_port>& ports(const pybind11::handle& list);
  const std::vector<fulmar_param>& params(const pybind11::handle& list);
  const char* const* words(const pybind11::handle& list);

  std::deque<std::string> texts_;
  std::deque<std::vector<const char*>> words_;
  std::deque<std::vector<fulmar_field>> fields_;
  std::deque<std::vector<fulmar_port>> ports_;
  std::deque<std::vector<fulmar_param>> params_;
  std::deque<fulmar_type> types_;
  std::map<PyObject*, const fulmar_type*> known_;
};

}  // namespace fulmar::python
