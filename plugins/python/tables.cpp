// SPDX-License-Identifier: BSD-3-Clause
#include "tables.hpp"

namespace fulmar::python {
namespace py = pybind11;
namespace {

template <class T>
T item(const py::handle& sequence, std::size_t i) {
  return py::cast<T>(py::reinterpret_borrow<py::tuple>(sequence)[i]);
}

bool none(const py::handle& sequence, std::size_t i) {
  return py::reinterpret_borrow<py::tuple>(sequence)[i].is_none();
}

}  // namespace

const char* Tables::text(const py::handle& text) {
  return texts_.emplace_back(py::cast<std::string>(text)).c_str();
}

const char* const* Tables::words(const py::handle& list) {
  std::vector<const char*> all;
  for (const py::handle& word : list) all.push_back(text(word));
  return words_.emplace_back(std::move(all)).data();
}

const fulmar_type* Tables::type(const py::handle& message) {
  const py::object cls = message.attr("_message");
  if (const auto table = py::cast<std::uintptr_t>(cls.attr("_table")); table != 0)
    return reinterpret_cast<const fulmar_type*>(table);
  if (const auto known = known_.find(cls.ptr()); known != known_.end()) return known->second;
  std::vector<fulmar_field> fields;
  std::uint32_t align = 1;
  for (const py::handle& described : cls.attr("_described")) {
    fulmar_field f{};
    f.name = text(described.attr("name"));
    f.unit = text(described.attr("unit"));
    f.kind = py::cast<std::uint32_t>(described.attr("kind"));
    f.shape = py::cast<std::uint32_t>(described.attr("shape"));
    f.offset = py::cast<std::uint32_t>(described.attr("offset"));
    f.count = py::cast<std::uint32_t>(described.attr("count"));
    f.stride = py::cast<std::uint32_t>(described.attr("stride"));
    f.items = py::cast<std::uint32_t>(described.attr("items"));
    f.min = py::cast<double>(described.attr("min"));
    f.max = py::cast<double>(described.attr("max"));
    if (f.kind == FULMAR_STRUCT) f.type = type(described.attr("type"));
    if (f.kind == FULMAR_ENUM) {
      const py::list labels = described.attr("labels");
      f.labels = words(labels);
      f.label_count = static_cast<std::uint32_t>(labels.size());
    }
    fields.push_back(f);
  }
  const py::module_ ctypes = py::module_::import("ctypes");
  align = py::cast<std::uint32_t>(ctypes.attr("alignment")(cls));
  const auto size = py::cast<std::uint32_t>(ctypes.attr("sizeof")(cls));
  const char* ros = py::hasattr(cls, "ros_type") ? text(cls.attr("ros_type")) : "";
  const auto& kept = fields_.emplace_back(std::move(fields));
  return known_[cls.ptr()] = &types_.emplace_back(
             fulmar_type{text(cls.attr("__name__")), "", ros, kept.data(),
                         static_cast<std::uint32_t>(kept.size()), sizeof(fulmar_field), size, align});
}

// (name, kind, flags, capacity, message or None)
const std::vector<fulmar_port>& Tables::ports(const py::handle& list) {
  std::vector<fulmar_port> all;
  for (const py::handle& p : list)
    all.push_back({text(item<py::object>(p, 0)), none(p, 4) ? nullptr : type(item<py::object>(p, 4)),
                   item<std::uint32_t>(p, 1), item<std::uint32_t>(p, 2), item<std::uint32_t>(p, 3)});
  return ports_.emplace_back(std::move(all));
}

// (name, kind, flags, unit, doc, initial, low, high, text, choices, message or None, capacity, data or None)
const std::vector<fulmar_param>& Tables::params(const py::handle& list) {
  std::vector<fulmar_param> all;
  for (const py::handle& p : list) {
    fulmar_param e{};
    e.name = text(item<py::object>(p, 0));
    e.kind = item<std::uint32_t>(p, 1);
    e.flags = item<std::uint32_t>(p, 2);
    e.unit = text(item<py::object>(p, 3));
    e.doc = text(item<py::object>(p, 4));
    for (std::size_t i = 0; i < 3; ++i) e.initial[i] = item<double>(item<py::object>(p, 5), i);
    e.min = item<double>(p, 6);
    e.max = item<double>(p, 7);
    e.initial_text = text(item<py::object>(p, 8));
    const auto choices = item<py::list>(p, 9);
    if (!choices.empty()) e.choices = words(choices);
    e.choice_count = static_cast<std::uint32_t>(choices.size());
    if (!none(p, 10)) e.type = type(item<py::object>(p, 10));
    e.capacity = item<std::uint32_t>(p, 11);
    if (!none(p, 12)) e.initial_data = text(item<py::object>(p, 12));  // bytes
    all.push_back(e);
  }
  return params_.emplace_back(std::move(all));
}

fulmar_component Tables::component(const py::handle& described) {
  fulmar_component c{};
  c.name = text(described.attr("name"));
  c.doc = text(described.attr("doc"));
  const auto &inputs = ports(described.attr("inputs")), &outputs = ports(described.attr("outputs"));
  const auto& parameters = params(described.attr("params"));
  c.inputs = inputs.data();
  c.outputs = outputs.data();
  c.params = parameters.data();
  c.input_count = static_cast<std::uint32_t>(inputs.size());
  c.output_count = static_cast<std::uint32_t>(outputs.size());
  c.param_count = static_cast<std::uint32_t>(parameters.size());
  c.port_stride = sizeof(fulmar_port);
  c.param_stride = sizeof(fulmar_param);
  c.flags = FULMAR_RESIDENT;
  if (py::cast<bool>(described.attr("vehicle"))) c.flags |= FULMAR_VEHICLE;
  return c;
}

}  // namespace fulmar::python
