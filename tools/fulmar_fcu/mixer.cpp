// SPDX-License-Identifier: BSD-3-Clause
#include "tools/fulmar_fcu/mixer.hpp"

#include <algorithm>
#include <cmath>

#include "tools/fulmar_fcu/messages.hpp"
#include "tools/fulmar_fcu/words.hpp"

namespace fulmar::fcu {

namespace {

struct Row {
  int command;
  const char* name;
};
constexpr std::array<Row, 4> rows{{{row_throttle, "throttle"},
                                   {row_aileron, "aileron"},
                                   {row_elevator, "elevator"},
                                   {row_rudder, "rudder"}}};

double param_value(const std::vector<Param>& params, const std::string& name) {
  const auto it = std::find_if(params.begin(), params.end(), [&](const Param& p) { return p.name == name; });
  return it == params.end() ? 0 : it->number();
}

std::size_t at(int i) { return static_cast<std::size_t>(i); }
bool used(double gain) { return std::fabs(gain) > 1e-6; }

std::string right_aligned(const std::string& text, std::size_t width) {
  return std::string(text.size() < width ? width - text.size() : 0, ' ') + text;
}

void put_matrix(std::string& out, const Matrix& matrix, const char* title) {
  out += std::string(title) + "\n" + right_aligned("output", 12);
  for (int j = 0; j < 10; ++j) out += right_aligned(std::to_string(j), 7);
  out += "\n";
  for (int i = 0; i < 10; ++i) {
    const bool any = std::any_of(matrix[at(i)].begin(), matrix[at(i)].end(), used);
    const auto row = std::find_if(rows.begin(), rows.end(), [&](const Row& r) { return r.command == i; });
    if (!any && row == rows.end()) continue;
    out += right_aligned(row == rows.end() ? "u[" + std::to_string(i) + "]" : row->name, 12);
    for (const double gain : matrix[at(i)]) out += right_aligned(used(gain) ? fixed(gain, 2) : ".", 7);
    out += "\n";
  }
}

}  // namespace

std::vector<int> Mixer::outputs_of(int command) const {
  std::vector<int> out;
  for (int j = 0; j < 10; ++j)
    if (kind[at(j)] != OutputKind::none && used(secondary[at(command)][at(j)])) out.push_back(j);
  return out;
}

Mixer mixer_of(const std::vector<Param>& params) {
  Mixer m;
  m.choice = static_cast<int>(param_value(params, "PRIMARY_MIXER"));
  m.secondary_choice = static_cast<int>(param_value(params, "SECONDARY_MIXER"));
  for (int j = 0; j < 10; ++j) {
    const int kind = static_cast<int>(param_value(params, "PRI_MIXER_OUT_" + std::to_string(j)));
    m.kind[at(j)] = kind >= 0 && kind <= 3 ? static_cast<OutputKind>(kind) : OutputKind::none;
    m.rate_hz[at(j)] = param_value(params, "PRI_MIXER_PWM_" + std::to_string(j));
    for (int i = 0; i < 10; ++i) {
      const std::string place = std::to_string(i) + "_" + std::to_string(j);
      m.primary[at(i)][at(j)] = param_value(params, "PRI_MIXER_" + place);
      m.secondary[at(i)][at(j)] = param_value(params, "SEC_MIXER_" + place);
    }
  }
  // 255: no secondary mixer; the primary one is used for both
  if (m.secondary_choice < 0 || m.secondary_choice > 11) m.secondary = m.primary;
  return m;
}

std::vector<std::string> mixer_faults(const Mixer& m) {
  if (m.choice < 0 || m.choice > 11) return {fcu_messages::mixer_missing(m.choice).line()};
  if (m.choice < 9) return {fcu_messages::mixer_of_multirotor(m.choice).line()};
  std::vector<std::string> out;
  for (const Row& row : rows) {
    const OutputKind wanted = row.command == row_throttle ? OutputKind::motor : OutputKind::servo;
    const std::vector<int> outputs = m.outputs_of(row.command);
    if (outputs.empty() && row.command != row_rudder && row.command != row_aileron)
      out.push_back(fcu_messages::command_without_output(row.name, row.command));
    for (const int j : outputs)
      if (m.kind[at(j)] != wanted)
        out.push_back(fcu_messages::output_kind_wrong(j, row.name,
                                                      wanted == OutputKind::motor ? "servo" : "motor",
                                                      wanted == OutputKind::motor ? 2 : 1));
  }
  return out;
}

std::vector<std::string> mixer_remarks(const Mixer& m) {
  std::vector<std::string> out;
  if (m.choice < 0 || m.choice > 11) return out;  // a fault: there is no mixer
  for (const Row& row : rows) {
    if (m.outputs_of(row.command).empty() && (row.command == row_rudder || row.command == row_aileron))
      out.push_back(fcu_messages::surface_without_output(row.name));
    for (int j = 0; j < 10; ++j) {
      const double pilot = m.primary[at(row.command)][at(j)], computer = m.secondary[at(row.command)][at(j)];
      if (std::fabs(pilot - computer) > 1e-4 * (1 + std::fabs(pilot)))
        out.push_back(
            fcu_messages::mixers_differ(j, row.name, fixed(pilot, 2), fixed(computer, 2),
                                        m.secondary_choice == 10 && std::fabs(computer) > std::fabs(pilot)
                                            ? fcu_messages::v_tail_gain_doubled.c_str()
                                            : ""));
    }
  }
  return out;
}

std::string output_words(const Mixer& m, int output) {
  if (m.kind[at(output)] == OutputKind::none) return "not used";
  std::string out;
  for (const Row& row : rows)
    if (used(m.secondary[at(row.command)][at(output)]))
      out += (out.empty() ? "" : " and ") + std::string(row.command == row_throttle ? "motor" : row.name);
  return out.empty() ? fcu_messages::output_without_command().line() : out;
}

std::string mixer_name(int choice) {
  switch (choice) {
    case 9: return "9, fixed wing";
    case 10: return "10, inverted V-tail";
    case 11: return "11, custom";
    case 255: return "255, none";
    default: return std::to_string(choice) + (choice >= 0 && choice < 9 ? ", a multirotor's" : ", unknown");
  }
}

std::string mixer_text(const Mixer& m) {
  static constexpr std::array<const char*, 4> kinds{"-", "servo", "motor", "gpio"};
  std::string out = "primary (the pilot's commands): " + mixer_name(m.choice) +
                    "\nsecondary (the computer's): " + mixer_name(m.secondary_choice) +
                    (m.secondary_choice == 255 ? ", the primary serves for both" : "") +
                    "\n\noutput  type     rate  follows\n";
  for (int j = 0; j < 10; ++j) {
    std::string kind = kinds[static_cast<std::size_t>(m.kind[at(j)])];
    kind.resize(7, ' ');
    out += right_aligned(std::to_string(j), 6) + "  " + kind +
           right_aligned(m.kind[at(j)] == OutputKind::none ? "" : fixed(m.rate_hz[at(j)], 0) + " Hz", 7) +
           "  " + output_words(m, j) + "\n";
  }
  out += "\n";
  put_matrix(out, m.primary, "primary matrix");
  if (m.secondary != m.primary) put_matrix(out, m.secondary, "secondary matrix");
  for (const std::string& fault : mixer_faults(m)) out += "FAULT: " + fault + "\n";
  for (const std::string& remark : mixer_remarks(m)) out += "NOTE: " + remark + "\n";
  return out;
}

}  // namespace fulmar::fcu
