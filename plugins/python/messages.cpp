// SPDX-License-Identifier: BSD-3-Clause
// Field tables of fulmar/msg/*.hpp for Python. The build makes the list of headers and structs.
#include "messages.hpp"

#include <map>

#include "fulmar/schema.hpp"
#include "shared_messages.hpp"

namespace fulmar::python {
namespace {

namespace py = pybind11;

struct Shared {
  const fulmar_type* type;
  const void* initial;
};

template <class T>
Shared share() {
  static constexpr T initial{};
  return {&describe<T>(), &initial};
}

const Shared all[] = {share<Quat>(), FULMAR_SHARED_MESSAGES(share)};

class Lister {
 public:
  py::list tables;

  std::size_t add(const fulmar_type& type) {
    if (const auto known = places_.find(&type); known != places_.end()) return known->second;
    py::list fields;
    for (std::uint32_t i = 0; i < type.field_count; ++i) {
      const fulmar_field& f = type.fields[i];
      py::object labels = py::none(), nested = py::none();
      if (f.kind == FULMAR_ENUM) {
        py::list words;
        for (std::uint32_t k = 0; k < f.label_count; ++k) words.append(f.labels[k]);
        labels = words;
      }
      if (f.kind == FULMAR_STRUCT) nested = py::int_(add(*f.type));
      fields.append(py::make_tuple(f.name, f.unit, f.kind, f.shape, f.offset, f.count, f.stride, f.items,
                                   f.min, f.max, labels, nested));
    }
    py::object initial = py::none();
    for (const Shared& one : all)
      if (one.type == &type) initial = py::bytes(static_cast<const char*>(one.initial), type.size);
    py::dict table;
    table["name"] = type.name;
    table["size"] = type.size;
    table["table"] = reinterpret_cast<std::uintptr_t>(&type);
    table["initial"] = initial;
    table["fields"] = fields;
    tables.append(table);
    return places_[&type] = tables.size() - 1;
  }

 private:
  std::map<const fulmar_type*, std::size_t> places_;
};

}  // namespace

py::list message_tables() {
  Lister lister;
  for (const Shared& one : all) lister.add(*one.type);
  return lister.tables;
}

py::list unit_rules() {
  py::list rules;
  for (const detail::Unit& unit : detail::units)
    rules.append(py::make_tuple(std::string(unit.suffix), unit.printed, unit.min, unit.max));
  return rules;
}

}  // namespace fulmar::python
