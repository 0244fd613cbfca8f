// SPDX-License-Identifier: BSD-3-Clause
// A mission under control of a Python program: tick by tick, or to its end, repeatedly.
#pragma once
#include <pybind11/pybind11.h>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/run/flight.hpp"

namespace fulmar::module {

namespace py = pybind11;

/// Response to a request. It comes with the step that reads the request.
struct Answer {
  bool answered = false, accepted = false;
  std::string reason;
};

class Sim {
 public:
  Sim(const std::string& mission, const core::Overrides& overrides, const core::FlightOptions& options);

  /// `n` ticks, or fewer when the flight ends. Returns false after its end.
  bool step(std::int64_t n);
  /// Runs to the end or to that flight time. Returns the result at the end of the flight, else None.
  py::object run(std::optional<double> until_s);
  /// A new flight of the same mission with the present parameters.
  void reset(std::optional<std::uint64_t> seed);

  double now_s() const;
  std::string phase() const;
  bool done() const { return result_.has_value(); }
  py::object result() const;
  std::uint64_t seed() const { return graph_.seed; }
  std::string mission() const { return graph_.mission; }
  double tick_s() const { return 1e-9 * static_cast<double>(graph_.tick_ns); }
  const std::vector<std::string>& events() const { return events_; }

  /// "nav.state" -> a copy of the sample, "nav.state.height_m" -> a number; None without a sample.
  py::object sample(const std::string& name);
  /// Names of all ports: of roles, then of components.
  std::vector<std::string> ports() const;

  py::object parameter(const std::string& name) const;
  void set_parameter(const std::string& name, const py::handle& value);
  std::vector<std::string> parameters() const;

  std::shared_ptr<Answer> request(const std::string& port, const py::handle& message);

 private:
  core::Flight& flight();
  void finish();
  core::Source find_port(const std::string& owner, const std::string& port) const;
  core::TypePtr type_of(const core::Source& source) const;
  std::pair<std::size_t, std::size_t> find_parameter(const std::string& name) const;

  core::Graph graph_;
  core::FlightOptions options_;
  std::unique_ptr<core::Flight> flight_;
  std::optional<std::string> result_;  // JSON
  std::vector<std::string> events_;
  std::string log_file_;
  bool begun_ = false;  // a tick has been flown
};

}  // namespace fulmar::module
