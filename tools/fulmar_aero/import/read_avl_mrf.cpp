// SPDX-License-Identifier: BSD-3-Clause
// AVL's machine-readable form (MRF, since 3.40): "numbers | words : names". It is converted to the other
// printed form, line by line, so that one reader reads both and line numbers are those of the file. Source:
// aoutmrf.f, aoutput.f.
#include "tools/fulmar_aero/import/messages.hpp"
#include "tools/fulmar_aero/import/readers.hpp"

namespace fulmar::aero::imports {
namespace {

std::vector<std::string> names_in(const std::string& text) {
  std::vector<std::string> names(1);
  for (const char c : text) {
    if (c == ',')
      names.emplace_back();
    else
      names.back() += c;
  }
  for (std::string& name : names) name = trimmed(name);
  return names;
}

std::string two_digits(std::size_t k) { return (k < 10 ? "0" : "") + std::to_string(k); }

class MrfText {
 public:
  explicit MrfText(const Lines& lines) : in_(lines), out_(lines) {}

  Lines plain() {
    for (std::size_t i = 0; i < in_.all.size(); ++i) {
      const std::string word = trimmed(in_.all[i]);
      if (word.find("Vortex Lattice Output") != std::string::npos && i + 1 < in_.all.size()) {
        ++i;
        out_.all[i] = " Configuration: " + trimmed(in_.all[i]);
      } else if (word == "CONTROL")
        i = deflections(i);
      else if (word == "DESIGN")
        out_.all[i] = " -----";  // ends the list of deflections, as the rule does
      else if (word.find("# control vars") != std::string::npos)
        i = headings(i);
      else if (word.find('|') != std::string::npos)
        values(i);
    }
    out_.text.clear();
    for (const std::string& line : out_.all) out_.text += line + "\n";
    return out_;
  }

 private:
  std::size_t count_at(std::size_t i, const char* what) const {
    if (i >= in_.all.size()) refuse({in_.file, int(in_.all.size())}, aero_messages::count_missing(what));
    const double count = number_at(in_, i, 0, what);
    if (!(count >= 0 && count <= 100 && count == std::floor(count)))
      refuse(in_.where(i), fulmar::located(std::string(what), aero_messages::count_out_of_range(count)));
    if (i + std::size_t(count) >= in_.all.size() && count > 0)
      refuse({in_.file, int(in_.all.size())}, aero_messages::entries_missing(int(count), what));
    return std::size_t(count);
  }
  /// "CONTROL", their number, "value name" each.
  std::size_t deflections(std::size_t i) {
    const std::size_t count = count_at(i + 1, "controls");
    for (std::size_t k = i + 2; k < i + 2 + count; ++k) {
      std::size_t end = 0;
      number_at(in_, k, 0, "deflection", &end);
      out_.all[k] = "  " + trimmed(in_.all[k].substr(end)) + " = " + trimmed(in_.all[k].substr(0, end));
    }
    return i + 1 + count;
  }
  /// Their number, and a name on each line below it.
  std::size_t headings(std::size_t i) {
    const std::size_t count = count_at(i, "control vars");
    out_.all[i].clear();
    for (std::size_t k = 1; k <= count; ++k) {
      out_.all[i] += "  " + trimmed(in_.all[i + k]) + " d" + two_digits(k);
      out_.all[i + k].clear();
    }
    return i + count;
  }
  void values(std::size_t i) {
    const std::string& text = in_.all[i];
    const std::vector<double> numbers = numbers_at(in_, i, 0);
    std::string rest = text.substr(text.find('|') + 1);
    const std::string words = rest;
    if (const std::size_t colon = rest.rfind(':'); colon != std::string::npos) rest = rest.substr(colon + 1);
    std::vector<std::string> names = names_in(rest);
    if (names.size() == 1 && !names[0].empty() && names[0].back() == '*') {
      const std::string stem = names[0].substr(0, names[0].size() - 1);
      names.clear();
      for (std::size_t k = 1; k <= numbers.size(); ++k) names.push_back(stem + two_digits(k));
    }
    if (names.size() != numbers.size())
      refuse(in_.where(i), aero_messages::value_count_mismatch(names.size(), trimmed(rest), numbers.size()));
    std::string line = words.find("force CD") != std::string::npos ? " force CD |" : " |";
    std::size_t at = 0;
    for (std::size_t k = 0; k < names.size(); ++k) {
      std::size_t end = 0;
      number_at(in_, i, at, names[k], &end);
      line += "  " + names[k] + " = " + trimmed(text.substr(at, end - at));
      at = end;
    }
    out_.all[i] = line;
  }

  const Lines& in_;
  Lines out_;
};

}  // namespace

bool is_avl_mrf(const Lines& lines) {
  for (const std::string& line : lines.all)
    if (const std::string word = trimmed(line); !word.empty()) return begins(word, "DERMAT");
  return false;
}

Lines avl_plain_of_mrf(const Lines& lines) { return MrfText(lines).plain(); }

}  // namespace fulmar::aero::imports
