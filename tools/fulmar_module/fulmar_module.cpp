// SPDX-License-Identifier: BSD-3-Clause
// `import fulmar`: the host as a Python module, for notebooks, tuning and learning.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "core/error.hpp"
#include "sim.hpp"
#include "tools/fulmar_module/messages.hpp"

namespace fulmar::module {
namespace {

/// sim.param: a mapping.
struct Params {
  Sim* sim;
};

std::string text_of(const py::handle& value) {
  if (PyBool_Check(value.ptr())) return value.ptr() == Py_True ? "true" : "false";
  return py::cast<std::string>(py::str(value));
}

std::unique_ptr<Sim> make(const std::string& mission, std::optional<std::uint64_t> seed, const py::dict& set,
                          const py::dict& roles, const std::string& io, const std::string& log, double speed,
                          std::optional<double> duration_s) {
  core::Overrides overrides;
  overrides.seed = seed;
  if (!io.empty()) overrides.io = io;
  for (const auto& [role, component] : roles) overrides.roles.emplace_back(text_of(role), text_of(component));
  for (const auto& [param, value] : set) overrides.set.emplace_back(text_of(param), text_of(value));
  core::FlightOptions options;
  options.speed = speed;
  options.duration_s = duration_s;
  options.log_file = log;
  return std::make_unique<Sim>(mission, overrides, options);
}

void define_sim(py::module_& m) {
  py::class_<Sim>(m, "Sim", "A mission that is flown tick by tick.")
      .def(py::init(&make), py::arg("mission"), py::kw_only(), py::arg("seed") = py::none(),
           py::arg("set") = py::dict(), py::arg("roles") = py::dict(), py::arg("io") = "",
           py::arg("log") = "", py::arg("speed") = 0.0, py::arg("duration_s") = py::none(),
           "Loads a mission: seed, set={'slc.roll_limit': '30 deg'}, roles={'outer': 'tecs'} as on the "
           "command line. log: a file to write.")
      .def("step", &Sim::step, py::arg("n") = 1, "Flies n ticks. True while the flight is not over.")
      .def("run", &Sim::run, py::arg("until_s") = py::none(),
           "Flies to the end and returns the result, or until a flight time.")
      .def("reset", &Sim::reset, py::arg("seed") = py::none(),
           "Begins a new flight, with the parameters as they are now.")
      .def("request", &Sim::request, py::arg("port"), py::arg("message") = py::dict(),
           "Asks a component: request('plan.edit', {'kind': 'clear'}). The answer comes with the next step "
           "that sees it.")
      .def("__getitem__", &Sim::sample, py::arg("port"),
           "A copy of a port's sample, or one field of it: sim['nav.state.height_m'].")
      .def_property_readonly("now_s", &Sim::now_s, "Flight time.")
      .def_property_readonly("tick_s", &Sim::tick_s, "Length of a tick.")
      .def_property_readonly("phase", &Sim::phase)
      .def_property_readonly("done", &Sim::done, "The flight is over.")
      .def_property_readonly("result", &Sim::result, "What fulmar run --json prints; None before the end.")
      .def_property_readonly("events", &Sim::events,
                             "What the host had to say, a line each: phases, guards, requests.")
      .def_property_readonly("ports", &Sim::ports)
      .def_property_readonly("seed", &Sim::seed)
      .def_property_readonly("mission", &Sim::mission)
      .def_property_readonly(
          "param", [](Sim& sim) { return Params{&sim}; }, py::keep_alive<0, 1>(),
          "Parameters by name: sim.param['slc.course_kp'] = 0.8");
}

}  // namespace

PYBIND11_MODULE(fulmar, m) {
  m.doc() = "Fulmar, a fixed-wing autopilot: flies a mission from Python.";
  m.attr("__version__") = FULMAR_VERSION;
  py::register_exception<core::Error>(m, "Error", PyExc_RuntimeError);
  py::class_<Answer, std::shared_ptr<Answer>>(m, "Answer", "How a request was answered.")
      .def_readonly("answered", &Answer::answered)
      .def_readonly("accepted", &Answer::accepted)
      .def_readonly("reason", &Answer::reason)
      .def("__repr__", [](const Answer& a) {
        return !a.answered  ? module_messages::answer_pending().line()
               : a.accepted ? "<accepted>"
                            : "<refused: " + a.reason + ">";
      });
  define_sim(m);
  py::class_<Params>(m, "Params", "The parameters of a flight, by name.")
      .def("__getitem__", [](const Params& p, const std::string& name) { return p.sim->parameter(name); })
      .def("__setitem__", [](const Params& p, const std::string& name,
                             const py::object& value) { p.sim->set_parameter(name, value); })
      .def("__len__", [](const Params& p) { return p.sim->parameters().size(); })
      .def("__iter__", [](const Params& p) { return py::iter(py::cast(p.sim->parameters())); })
      .def("keys", [](const Params& p) { return p.sim->parameters(); });
}

}  // namespace fulmar::module
