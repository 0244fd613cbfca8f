// SPDX-License-Identifier: BSD-3-Clause
#include "values.hpp"

#include <cstring>
#include <nlohmann/json.hpp>
#include <optional>

#include "core/types/wire.hpp"

namespace fulmar::module {
namespace py = pybind11;
using namespace core;
namespace {

const std::optional<py::module_>& numpy() {
  static const auto* const found = [] {
    try {
      return new std::optional<py::module_>(py::module_::import("numpy"));
    } catch (py::error_already_set&) {
      return new std::optional<py::module_>();
    }
  }();
  return *found;
}

py::object dtype_of(const Type& type);

py::object element_dtype(const Field& field) {
  if (field.kind == FULMAR_BOOL) return py::str("?");
  if (field.kind == FULMAR_ENUM) return py::str("u1");
  if (field.kind == FULMAR_TEXT) return py::str("S" + std::to_string(field.stride));
  if (field.kind != FULMAR_STRUCT)  // NumPy counts in bytes: "f8"
    return py::str(kind_word(field.kind)[0] + std::to_string(primitive_size(field.kind)));
  if (!field.type->frame.empty())
    return py::make_tuple("f8", py::make_tuple(field.type->fields.size()));  // Vec3, Quat
  return dtype_of(*field.type);
}

py::object make_dtype(const py::list& names, const py::list& formats, const py::list& offsets,
                      std::uint32_t size) {
  py::dict description;
  description["names"] = names;
  description["formats"] = formats;
  description["offsets"] = offsets;
  description["itemsize"] = size;
  return numpy()->attr("dtype")(py::make_tuple(numpy()->attr("record"), description));
}

py::object field_dtype(const Field& field) {
  const py::object element = element_dtype(field);
  if (field.shape == FULMAR_SCALAR) return element;
  const py::object array = py::make_tuple(numpy()->attr("dtype")(element), py::make_tuple(field.count));
  if (field.shape == FULMAR_ARRAY) return array;
  py::list names, formats, offsets;
  names.append("count");
  formats.append("u4");
  offsets.append(0);
  names.append("items");
  formats.append(array);
  offsets.append(field.items);
  return make_dtype(names, formats, offsets, field.items + field.count * field.stride);
}

py::object dtype_of(const Type& type) {
  static auto* const known =
      new std::map<std::uint64_t, py::object>;  // never destroyed: at exit the interpreter may end first
  if (const auto it = known->find(type.hash); it != known->end()) return it->second;
  py::list names, formats, offsets;
  for (const Field& field : type.fields) {
    names.append(field.name);
    formats.append(field_dtype(field));
    offsets.append(field.offset);
  }
  return (*known)[type.hash] = make_dtype(names, formats, offsets, type.size);
}

}  // namespace

py::object record_of(const Type& type, const std::byte* message) {
  if (!numpy()) return py::module_::import("json").attr("loads")(to_json(type, message, false).dump());
  const py::bytes copy(reinterpret_cast<const char*>(message), type.size);
  return numpy()->attr("frombuffer")(copy, dtype_of(type))[py::int_(0)];
}

py::object value_of(const Field& field, const std::byte* at) {
  if (field.kind == FULMAR_STRUCT) return record_of(*field.type, at);
  if (field.kind == FULMAR_TEXT) {
    const char* text = reinterpret_cast<const char*>(at);
    return py::reinterpret_steal<py::object>(
        PyUnicode_DecodeUTF8(text, static_cast<Py_ssize_t>(::strnlen(text, field.stride)), "replace"));
  }
  const double number = number_at(field, at);
  if (field.kind == FULMAR_BOOL) return py::bool_(number != 0);
  if (field.kind == FULMAR_ENUM && static_cast<std::size_t>(number) < field.labels.size())
    return py::str(field.labels[static_cast<std::size_t>(number)]);
  return with_number(field.kind, at, [](auto x) -> py::object { return py::cast(x); });
}

}  // namespace fulmar::module
