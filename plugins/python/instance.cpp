// SPDX-License-Identifier: BSD-3-Clause
#include "instance.hpp"

#include <algorithm>
#include <cstring>

#include "interpreter.hpp"

namespace fulmar::python {
namespace {

// Marks a probe that was not written in this step: a NaN with a payload that no arithmetic produces.
constexpr std::uint64_t unwritten = 0x7ff8f01a52deadull << 8;

std::byte* place(const py::handle& number) {
  return reinterpret_cast<std::byte*>(py::cast<std::uintptr_t>(number));
}

template <class T>
T* meta_of(std::byte* at, std::size_t meta) {
  return reinterpret_cast<T*>(at + meta);
}

}  // namespace

Instance::Instance(const py::handle& described, const std::string& file, std::uint64_t seed)
    : file_(file), instance_(runtime().attr("_make")(described, seed)) {
  const auto method = [&](const char* name) { return py::object(instance_.attr(name)); };
  step_ = method("step");
  read_ = method("read");
  write_ = method("write");
  configure_ = method("configure");
  retune_ = method("retune");
  activate_ = method("activate");
  deactivate_ = method("deactivate");
  tick_ = method("tick");
  inp_ = method("inp");
  out_ = method("out");
  last_ = method("last");
  p_ = method("p");
  read_places(instance_);
}

void Instance::read_places(const py::handle& instance) {
  tick_view_ = reinterpret_cast<TickView*>(place(runtime().attr("_address")(tick_)));
  for (const py::handle& one : instance.attr("inputs")) {
    const auto t =
        py::reinterpret_borrow<py::tuple>(one);  // kind, address, size, meta, stride, capacity, head
    inputs_.push_back({py::cast<std::uint32_t>(t[0]), place(t[1]), py::cast<std::size_t>(t[2]),
                       py::cast<std::size_t>(t[3]), py::cast<std::size_t>(t[4]),
                       py::cast<std::uint32_t>(t[5]), reinterpret_cast<QueueHead*>(place(t[6]))});
  }
  for (const py::handle& one : instance.attr("outputs")) {
    const auto t = py::reinterpret_borrow<py::tuple>(
        one);  // kind, name, address, size, meta, capacity, head, own, previous
    Output o;
    o.kind = py::cast<std::uint32_t>(t[0]);
    o.name = t[1];
    o.own = t[7];
    o.previous = t[8];
    o.at = place(t[2]);
    o.size = py::cast<std::size_t>(t[3]);
    o.meta = py::cast<std::size_t>(t[4]);
    o.capacity = py::cast<std::uint32_t>(t[5]);
    o.head = reinterpret_cast<QueueHead*>(place(t[6]));
    if (!o.previous.is_none()) o.previous_at = place(runtime().attr("_address")(o.previous));
    outputs_.push_back(std::move(o));
  }
  for (const py::handle& one : instance.attr("params")) {
    const auto t = py::reinterpret_borrow<py::tuple>(one);  // kind, name, choices, address, size, meta, value
    Parameter p;
    p.kind = py::cast<std::uint32_t>(t[0]);
    p.name = t[1];
    p.choices = t[2];
    p.value = t[6];
    p.at = place(t[3]);
    p.size = py::cast<std::size_t>(t[4]);
    p.meta = py::cast<std::size_t>(t[5]);
    params_.push_back(std::move(p));
  }
}

// ---- arguments

void Instance::show(const fulmar_tick& tick) noexcept {
  *tick_view_ = {tick.now_ns, tick.dt_ns, tick.index, 1e-9 * static_cast<double>(tick.now_ns),
                 1e-9 * static_cast<double>(tick.dt_ns)};
}

void Instance::show(const fulmar_input* inputs) noexcept {
  for (std::size_t i = 0; i < inputs_.size(); ++i) {
    const Input& to = inputs_[i];
    const fulmar_input& from = inputs[i];
    if (to.kind == FULMAR_IN_VALUE) {
      const bool present = from.data != nullptr;
      if (present) std::memcpy(to.at, from.data, to.size);
      *meta_of<ValueMeta>(to.at, to.meta) = {from.valid_at_ns,
                                             1e-9 * static_cast<double>(from.age_ns),
                                             from.sequence,
                                             (from.flags & FULMAR_FRESH) != 0,
                                             (from.flags & FULMAR_STALE) != 0,
                                             present};
      continue;
    }
    *to.head = {std::min(from.count, to.capacity), from.lost};
    for (std::uint32_t k = 0; k < to.head->count; ++k) {
      std::byte* item = to.at + k * to.stride;
      std::memcpy(item, static_cast<const std::byte*>(from.data) + k * to.size, to.size);
      ItemMeta& meta = *meta_of<ItemMeta>(item, to.meta);
      meta.valid_at_ns = from.stamps_ns[k];
      meta.verdict = FULMAR_UNANSWERED;
      meta.reason[0] = '\0';
    }
  }
}

void Instance::answer(const fulmar_input* inputs) noexcept {
  for (std::size_t i = 0; i < inputs_.size(); ++i) {
    const Input& from = inputs_[i];
    if (from.kind != FULMAR_IN_REQUEST || inputs[i].answers == nullptr) continue;
    for (std::uint32_t k = 0; k < from.head->count; ++k) {
      const ItemMeta& meta = *meta_of<ItemMeta>(from.at + k * from.stride, from.meta);
      fulmar_answer& to = inputs[i].answers[k];
      to.verdict = meta.verdict;
      std::memcpy(to.reason, meta.reason, sizeof to.reason);
      to.reason[sizeof to.reason - 1] = '\0';
    }
  }
}

// ---- results

/// Clears the outputs of a failed step, so that the next step does not publish them.
void Instance::forget() noexcept {
  for (Output& o : outputs_) {
    if (o.kind == FULMAR_OUT_PROBE) std::memcpy(o.at, &unwritten, sizeof unwritten);
    if (o.kind == FULMAR_OUT_EVENT) *meta_of<EventMeta>(o.at, o.meta) = {};
    if (o.kind == FULMAR_OUT_QUEUE) *o.head = {};
  }
}

/// An assignment `out.attitude = message` fills the output. For any other assignment it returns false with a
/// Python exception.
bool Instance::check_names() noexcept {
  for (Output& o : outputs_) {
    if (o.kind == FULMAR_OUT_PROBE) continue;
    PyObject* now = PyObject_GetAttr(out_.ptr(), o.name.ptr());
    if (now == nullptr) return false;
    const bool same = now == o.own.ptr();
    Py_DECREF(now);
    if (same) continue;
    PyObject* done =
        PyObject_CallMethod(runtime().ptr(), "_rebound", "OOO", out_.ptr(), o.name.ptr(), o.own.ptr());
    if (done == nullptr) return false;
    Py_DECREF(done);
  }
  return true;
}

bool Instance::give(fulmar_output* outputs) noexcept {
  if (!check_names()) return false;
  for (std::size_t i = 0; i < outputs_.size(); ++i) {
    const Output& from = outputs_[i];
    fulmar_output& to = outputs[i];
    if (from.kind == FULMAR_OUT_VALUE) {
      std::memcpy(to.data, from.at, from.size);
    } else if (from.kind == FULMAR_OUT_PROBE) {
      to.count = std::memcmp(from.at, &unwritten, sizeof unwritten) != 0 ? 1 : 0;
      if (to.count > 0) std::memcpy(to.data, from.at, sizeof(double));
    } else if (from.kind == FULMAR_OUT_EVENT) {
      const EventMeta& meta = *meta_of<EventMeta>(from.at, from.meta);
      if (!meta.written) continue;
      std::memcpy(to.data, from.at, from.size);
      if (meta.dated) to.valid_at_ns = meta.valid_at_ns;
      to.count = 1;
    } else {
      to.count = std::min(from.head->count, from.capacity);
      to.lost = from.head->lost;
      std::memcpy(to.data, from.at, to.count * from.size);
      std::memcpy(to.stamps_ns, reinterpret_cast<const void*>(from.meta), to.count * sizeof(std::int64_t));
    }
  }
  return true;
}

// ---- parameters

/// Reads one parameter. Returns false with a Python exception.
bool Instance::take(Parameter& p, const fulmar_value& v) {
  py::object value;
  if (p.kind == FULMAR_NUMBER) {
    value = py::float_(v.number[0]);
  } else if (p.kind == FULMAR_FLAG) {
    value = py::bool_(v.integer != 0);
  } else if (p.kind == FULMAR_COUNT) {
    value = py::int_(v.integer);
  } else if (p.kind == FULMAR_CHOICE) {
    value = p.choices[py::int_(v.integer)];
  } else if (p.kind == FULMAR_STRING) {
    const char* text = v.text != nullptr ? v.text : "";
    value = py::reinterpret_steal<py::object>(
        PyUnicode_DecodeUTF8(text, static_cast<Py_ssize_t>(std::strlen(text)), "replace"));
  } else if (p.kind == FULMAR_VECTOR) {
    std::memcpy(p.at, v.number, sizeof v.number);
  } else if (v.data != nullptr &&
             p.kind == FULMAR_RECORD) {  // without data for a retune, which leaves records unchanged
    if (v.size == p.size) std::memcpy(p.at, v.data, p.size);
    *reinterpret_cast<bool*>(p.at + p.meta) = v.integer != 0;
  } else if (v.data != nullptr) {
    p.value.attr("data") = py::bytes(static_cast<const char*>(v.data), v.size);
    p.value.attr("name") = py::str(v.text != nullptr ? v.text : "");
    p.value.attr("given") = py::bool_(true);
  }
  return PyObject_SetAttr(p_.ptr(), p.name.ptr(), value ? value.ptr() : p.value.ptr()) == 0;
}

bool Instance::take(const fulmar_value* values) noexcept {
  try {
    for (std::size_t i = 0; i < params_.size(); ++i)
      if (!take(params_[i], values[i])) return false;
    return true;
  } catch (py::error_already_set& e) {
    e.restore();
  } catch (const std::exception& e) {
    PyErr_SetString(PyExc_RuntimeError, e.what());
  }
  return false;
}

/// Returns false with a Python exception.
bool Instance::show_last(const fulmar_input* last) noexcept {
  for (std::size_t i = 0; i < outputs_.size(); ++i) {
    Output& o = outputs_[i];
    PyObject* value = Py_None;
    Py_INCREF(value);
    if (o.kind == FULMAR_OUT_PROBE) {
      double number = 0;
      if (last[i].data != nullptr) std::memcpy(&number, last[i].data, sizeof number);
      Py_DECREF(value);
      value = PyFloat_FromDouble(number);
    } else if (last[i].data != nullptr && o.previous_at != nullptr) {
      std::memcpy(o.previous_at, last[i].data, o.size);
      Py_DECREF(value);
      value = o.previous.ptr();
      Py_INCREF(value);
    }
    const bool set = value != nullptr && PyObject_SetAttr(last_.ptr(), o.name.ptr(), value) == 0;
    Py_XDECREF(value);
    if (!set) return false;
  }
  return true;
}

// ---- calls

std::uint32_t Instance::fail(fulmar_error* error, bool print) noexcept {
  explain(file_, print, error);
  return FULMAR_FAILED;
}

/// Status that a method returns; None and a missing method are ok.
std::uint32_t Instance::call(const py::object& method, PyObject* const* arguments, std::size_t count,
                             fulmar_error* error) noexcept {
  if (method.is_none()) return FULMAR_OK;
  PyObject* result =
      PyObject_Vectorcall(method.ptr(), arguments, count | PY_VECTORCALL_ARGUMENTS_OFFSET, nullptr);
  if (result == nullptr) return fail(error);
  long status = FULMAR_OK;
  if (result != Py_None) {
    status = PyLong_Check(result) && !PyBool_Check(result) ? PyLong_AsLong(result) : -1;
    if (status < FULMAR_OK || status > FULMAR_FAILED) {
      PyErr_Clear();
      PyErr_Format(PyExc_TypeError, "it returned %R; return nothing, f.ok, f.degraded or f.failed", result);
      Py_DECREF(result);
      return fail(error);
    }
  }
  Py_DECREF(result);
  return static_cast<std::uint32_t>(status);
}

std::uint32_t Instance::configure(const fulmar_value* values, fulmar_error* error) noexcept {
  if (!take(values)) return fail(error, false);
  PyObject* arguments[] = {nullptr, p_.ptr()};
  const std::uint32_t status = call(configure_, arguments + 1, 1, error);
  PyObject* done = PyObject_CallMethod(runtime().ptr(), "_settle", nullptr);
  if (done == nullptr) return fail(error);
  Py_DECREF(done);
  return status;
}

std::uint32_t Instance::retune(const fulmar_value* values, fulmar_error* error) noexcept {
  if (!take(values)) return fail(error);
  PyObject* arguments[] = {nullptr, p_.ptr()};
  return call(retune_, arguments + 1, 1, error);
}

std::uint32_t Instance::activate(const fulmar_tick& tick, const fulmar_input* inputs,
                                 const fulmar_input* last, fulmar_error* error) noexcept {
  show(tick);
  show(inputs);
  if (!show_last(last)) return fail(error);
  PyObject* arguments[] = {nullptr, tick_.ptr(), inp_.ptr(), p_.ptr(), last_.ptr()};
  return call(activate_, arguments + 1, 4, error);
}

void Instance::deactivate() noexcept {
  fulmar_error ignored{};
  PyObject* arguments[] = {nullptr, nullptr};
  call(deactivate_, arguments + 1, 0, &ignored);
}

std::uint32_t Instance::step(const fulmar_tick& tick, const fulmar_input* inputs, fulmar_output* outputs,
                             fulmar_error* error) noexcept {
  show(tick);
  show(inputs);
  forget();
  PyObject* arguments[] = {nullptr, tick_.ptr(), inp_.ptr(), p_.ptr(), out_.ptr()};
  const std::uint32_t status = call(step_, arguments + 1, 4, error);
  answer(inputs);
  if (status < FULMAR_FAILED && !give(outputs)) return fail(error);
  return status;
}

std::uint32_t Instance::read(fulmar_tick& tick, fulmar_output* outputs, fulmar_error* error) noexcept {
  show(tick);
  forget();
  PyObject* arguments[] = {nullptr, tick_.ptr(), p_.ptr(), out_.ptr()};
  const std::uint32_t status = call(read_, arguments + 1, 3, error);
  tick.now_ns = tick_view_->now_ns;
  if (status < FULMAR_FAILED && !give(outputs)) return fail(error);
  return status;
}

std::uint32_t Instance::write(const fulmar_tick& tick, const fulmar_input* inputs,
                              fulmar_error* error) noexcept {
  show(tick);
  show(inputs);
  PyObject* arguments[] = {nullptr, tick_.ptr(), inp_.ptr(), p_.ptr()};
  const std::uint32_t status = call(write_, arguments + 1, 3, error);
  answer(inputs);
  return status;
}

}  // namespace fulmar::python
