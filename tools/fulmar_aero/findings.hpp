// SPDX-License-Identifier: BSD-3-Clause
// Findings of a check of an airframe.
#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tools/fulmar_aero/airframe_file.hpp"

namespace fulmar::aero {

enum class Verdict : std::uint8_t { fault, warning };

struct Finding {
  Verdict verdict = Verdict::fault;
  std::string field;  ///< "aero.pitch.alpha_ratio"
  core::Where where;
  double value = 0;
  std::string sentence;
};

/// A figure of the aircraft for the report: "static margin", "0.49 of the chord".
struct Figure {
  std::string key;  ///< of JSON, with its unit
  double value = 0;
  std::string name, text;
};

/// The derivatives with values and slopes of the tables at the trim of cruise at sea level.
Aerodynamics with_table_slopes(const Airframe& airframe);

class Findings {
 public:
  explicit Findings(const AirframeFile& file) : file_(file), aero_(with_table_slopes(file.airframe)) {}

  const AirframeFile& file() const { return file_; }
  const Aerodynamics& aero() const { return aero_; }  ///< with the tables
  void fault(const std::string& field, double value, const Diagnostic& sentence) {
    list_.push_back({Verdict::fault, field, file_.where(field), value, sentence});
  }
  void warn(const std::string& field, double value, const std::string& sentence) {
    list_.push_back({Verdict::warning, field, file_.where(field), value, sentence});
  }
  void figure(const std::string& key, double value, const std::string& name, const std::string& text) {
    figures_.push_back({key, value, name, text});
  }
  /// Counts the checked values.
  void looked_at(int values = 1) { looked_at_ += values; }

  const std::vector<Finding>& list() const { return list_; }
  const std::vector<Figure>& figures() const { return figures_; }
  int values() const { return looked_at_; }
  int count(Verdict verdict) const {
    int n = 0;
    for (const Finding& finding : list_) n += finding.verdict == verdict;
    return n;
  }
  bool has(const std::string& field) const {
    for (const Finding& finding : list_)
      if (finding.field == field) return true;
    return false;
  }

 private:
  const AirframeFile& file_;
  Aerodynamics aero_;
  std::vector<Finding> list_;
  std::vector<Figure> figures_;
  int looked_at_ = 0;
};

/// Oswald's factor is infinite where the drag over the angle of attack includes the induced drag: sets of
/// JSBSim.
inline bool has_induced_drag(const Wing& wing) { return wing.oswald_ratio < 1e5; }

// Each checks one part of the airframe.
void check_body(Findings& findings);         ///< mass, inertia, wing
void check_derivatives(Findings& findings);  ///< signs and sizes
void check_symmetry(Findings& findings);     ///< absent derivatives of a symmetric aircraft; drag
void check_angles(Findings& findings);       ///< throws, limits: degrees for radians
void check_parts(Findings& findings);        ///< servos, propellers, battery, gear
void check_stability(Findings& findings);    ///< static margin, control power
void check_flight(Findings& findings, double altitude_m);  ///< trim from the stall to the top speed, modes
void check_class(Findings& findings);                      ///< comparison with other small aircraft

void check_all(Findings& findings, double altitude_m);
std::string findings_text(const Findings& findings, double altitude_m);
nlohmann::json findings_json(const Findings& findings, double altitude_m);

}  // namespace fulmar::aero
