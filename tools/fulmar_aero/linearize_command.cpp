// SPDX-License-Identifier: BSD-3-Clause
#include "core/app/program.hpp"
#include "core/types/text.hpp"
#include "tools/fulmar_aero/commands.hpp"
#include "tools/fulmar_aero/flight_model.hpp"
#include "tools/fulmar_aero/flight_words.hpp"
#include "tools/fulmar_aero/words.hpp"

namespace fulmar::aero {
namespace {

constexpr std::array<const char*, model::states> state_names{"north_m", "east_m",  "down_m",   "u_mps",
                                                             "v_mps",   "w_mps",   "roll_rad", "pitch_rad",
                                                             "yaw_rad", "p_radps", "q_radps",  "r_radps"};
constexpr std::array<const char*, model::inputs> input_names{"aileron_rad", "elevator_rad", "rudder_rad",
                                                             "throttle_frac"};

template <class Matrix>
nlohmann::json matrix_json(const Matrix& m) {
  nlohmann::json rows = nlohmann::json::array();
  for (int i = 0; i < m.rows(); ++i) {
    nlohmann::json row = nlohmann::json::array();
    for (int k = 0; k < m.cols(); ++k) row.push_back(m(i, k));
    rows.push_back(row);
  }
  return rows;
}

template <std::size_t N, std::size_t M>
nlohmann::json block_json(const LinearModel& all, const std::array<int, N>& states,
                          const std::array<int, M>& inputs) {
  const LinearBlock<N, M> block = block_of(all, states, inputs);
  nlohmann::json state_list, input_list;
  for (const int i : states) state_list.push_back(state_names[std::size_t(i)]);
  for (const int i : inputs) input_list.push_back(input_names[std::size_t(i)]);
  return {{"A", matrix_json(block.A)},
          {"B", matrix_json(block.B)},
          {"states", state_list},
          {"inputs", input_list}};
}

template <std::size_t N, std::size_t M>
std::string block_text(const char* title, const LinearModel& all, const std::array<int, N>& states,
                       const std::array<int, M>& inputs) {
  std::string text = std::string("\n") + title + "\n" + padded("", 11);
  for (const int i : states) text += right(state_names[std::size_t(i)], 14);
  text += "  |";
  for (const int i : inputs) text += right(input_names[std::size_t(i)], 14);
  text += "\n";
  for (const int i : states) {
    text += "  " + padded(state_names[std::size_t(i)], 9);
    for (const int k : states) text += right(fixed(all.A(i, k), 5), 14);
    text += "  |";
    for (const int k : inputs) text += right(fixed(all.B(i, k), 5), 14);
    text += "\n";
  }
  return text;
}

/// One line per state: its name, its row of A, its row of B. Numbers read back to the same bits.
std::string csv_text(const LinearModel& all) {
  std::string text = "d/dt";
  for (const char* name : state_names) text += std::string(",") + name;
  for (const char* name : input_names) text += std::string(",") + name;
  text += "\n";
  for (int i = 0; i < model::states; ++i) {
    text += state_names[std::size_t(i)];
    for (int k = 0; k < model::states; ++k) text += "," + core::number_text(all.A(i, k));
    for (int k = 0; k < model::inputs; ++k) text += "," + core::number_text(all.B(i, k));
    text += "\n";
  }
  return text;
}

nlohmann::json linear_json(const AirframeFile& file, const AircraftModel& m, const SteadyFlight& f,
                           const LinearModel& all) {
  return {{"airframe", file.title()},
          {"trim", flight_json(m, f)},
          {"states", state_names},
          {"inputs", input_names},
          {"A", matrix_json(all.A)},
          {"B", matrix_json(all.B)},
          {"longitudinal", block_json(all, model::longitudinal_states, model::longitudinal_inputs)},
          {"lateral", block_json(all, model::lateral_states, model::lateral_inputs)}};
}

}  // namespace

int linearize_command(const FlightOptions& options, bool csv) {
  const AirframeFile file = read_airframe_file(options.airframe);
  const AircraftModel m(file.airframe, options.altitude_m());
  const SteadyFlight flight = fly(m, options.condition(file.airframe));
  if (!flight.found()) {
    std::fprintf(stderr, "%s\n", no_flight(file, m, flight).c_str());
    return core::ExitCode::failed;
  }
  const LinearModel all = linearised(m, flight);
  if (options.json) {
    print_object(linear_json(file, m, flight, all));
  } else if (csv) {
    print_text(csv_text(all));
  } else {
    print_text(file.title() + ": about " + condition_words(flight.condition, m.altitude_m()) +
               "; SI units, radians\n" +
               block_text("longitudinal", all, model::longitudinal_states, model::longitudinal_inputs) +
               block_text("lateral", all, model::lateral_states, model::lateral_inputs));
  }
  return core::ExitCode::done;
}

}  // namespace fulmar::aero
