// SPDX-License-Identifier: BSD-3-Clause
// The Aerosonde of Beard & McLain's second edition at 25 m/s, trimmed and linearised by another program, if
// its file is available.
#pragma once
#include <fstream>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "sdk/test/flight/airframe_file.hpp"

namespace fulmar::test {

/// Numbers after a label of the file, in order; brackets and signs of imaginary parts are skipped.
class AerosondeReference {
 public:
  static std::optional<AerosondeReference> open() {
    std::ifstream in(FULMAR_REFERENCE_DATA "/aero/reference/aerosonde_trim_eig_own.txt");
    if (!in) return std::nullopt;
    AerosondeReference reference;
    std::ostringstream text;
    text << in.rdbuf();
    reference.text_ = text.str();
    return reference;
  }
  std::vector<double> after(const std::string& label, std::size_t count) const {
    std::size_t at = text_.find(label);
    if (at == std::string::npos) throw std::runtime_error("no " + label);
    at += label.size();
    std::vector<double> numbers;
    while (numbers.size() < count) {
      at = text_.find_first_of("-+.0123456789", at);
      std::size_t used = 0;
      numbers.push_back(std::stod(text_.substr(at), &used));
      at += used;
    }
    return numbers;
  }

 private:
  std::string text_;
};

/// Parameters of mavsim that the airframe file, which follows ROSflight's, does not have.
inline Airframe book_aerosonde() {
  Airframe a = airframe_file("aerosonde");
  a.inertia.xx_kgm2 = 0.8244;
  a.wing.stall_alpha_rad = 0.47;
  return a;
}

}  // namespace fulmar::test
