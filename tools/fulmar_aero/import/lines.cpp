// SPDX-License-Identifier: BSD-3-Clause
#include "tools/fulmar_aero/import/lines.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include "core/graph/yaml.hpp"
#include "tools/fulmar_aero/import/messages.hpp"

namespace fulmar::aero::imports {
namespace {

bool blank(char c) { return c == ' ' || c == '\t'; }
bool digit(char c) { return c >= '0' && c <= '9'; }

std::size_t skip_blanks(const std::string& text, std::size_t at) {
  while (at < text.size() && blank(text[at])) ++at;
  return at;
}

bool number_begins(const std::string& text, std::size_t at) {
  if (at >= text.size()) return false;
  if (text[at] == '-' || text[at] == '+') ++at;
  if (at < text.size() && text[at] == '.') ++at;
  return at < text.size() && digit(text[at]);
}

/// A decimal number in any locale; its end. Never hexadecimal, "inf" or "nan".
std::size_t read_number(const std::string& text, std::size_t at, double& value) {
  std::size_t end = at;
  if (text[end] == '-' || text[end] == '+') ++end;
  while (end < text.size() && (digit(text[end]) || text[end] == '.')) ++end;
  std::string word = text.substr(at, end - at);
  if (end + 1 < text.size() && std::string("eEdD").find(text[end]) != std::string::npos) {
    std::size_t exponent = end + 1;
    if (text[exponent] == '-' || text[exponent] == '+') ++exponent;
    if (exponent < text.size() && digit(text[exponent])) {
      while (exponent < text.size() && digit(text[exponent])) ++exponent;
      word += "e" + text.substr(end + 1, exponent - end - 1);
      end = exponent;
    }
  }
  value = std::strtod(word.c_str(), nullptr);
  return end;
}

std::string shown(const std::string& text, std::size_t at) {
  const std::string rest = text.substr(std::min(skip_blanks(text, at), text.size()), 24);
  const std::size_t end = rest.find_first_of(" \t");
  return rest.empty() ? aero_messages::line_end().line() : "'" + rest.substr(0, end) + "'";
}

std::string unit_behind(const std::string& text, std::size_t at) {
  at = skip_blanks(text, at);
  std::size_t end = at;
  while (end < text.size() && !blank(text[end]) && text[end] != '|') ++end;
  return text.substr(at, end - at);
}

}  // namespace

std::string Lines::place(std::size_t line, const std::string& what) const {
  const std::string base = std::filesystem::path(file).filename().string();
  return base + ":" + std::to_string(line + 1) + (what.empty() ? "" : " " + what);
}

std::optional<std::size_t> Lines::find(const std::string& what, std::size_t from) const {
  for (std::size_t i = from; i < all.size(); ++i)
    if (all[i].find(what) != std::string::npos) return i;
  return {};
}

Lines lines_of(const std::string& file, const std::string& text) {
  Lines lines{file, text, {}};
  if (begins(text, "\xef\xbb\xbf")) lines.text = text.substr(3);
  std::string line;
  for (const char c : lines.text) {
    if (c == '\n') {
      if (!line.empty() && line.back() == '\r') line.pop_back();
      lines.all.push_back(line);
      line.clear();
    } else {
      line += c;
    }
  }
  if (!line.empty()) lines.all.push_back(line);
  return lines;
}

Lines read_lines(const std::string& file) {
  std::error_code fault;
  if (std::filesystem::is_directory(file, fault))
    throw core::Error(located(file, aero_messages::input_is_folder()));
  const std::string text = core::read_source(file, file)->text;
  if (text.empty()) throw core::Error(located(file, aero_messages::file_empty()));
  if (begins(text, "\xff\xfe") || begins(text, "\xfe\xff"))
    throw core::Error(located(file, aero_messages::encoding_unsupported()));
  if (text.find('\0') != std::string::npos) throw core::Error(located(file, aero_messages::text_expected()));
  return lines_of(file, text);
}

void refuse(const core::Where& where, const Diagnostic& sentence) {
  throw core::Error(located(where, sentence));
}

double number_at(const Lines& lines, std::size_t line, std::size_t at, const std::string& what,
                 std::size_t* end) {
  const std::string& text = lines.all[line];
  const std::size_t begin = skip_blanks(text, at);
  if (!number_begins(text, begin))
    refuse(lines.where(line), fulmar::located(what, aero_messages::number_expected(shown(text, at))));
  double value = 0;
  const std::size_t stop = read_number(text, begin, value);
  if (stop + 1 < text.size() && text[stop] == ',' && digit(text[stop + 1]))
    refuse(lines.where(line),
           fulmar::located(what, aero_messages::decimal_comma(text.substr(begin, stop + 4 - begin))));
  if (!std::isfinite(value))
    refuse(lines.where(line), fulmar::located(what, aero_messages::number_not_finite()));
  if (end) *end = stop;
  return value;
}

std::vector<double> numbers_at(const Lines& lines, std::size_t line, std::size_t at) {
  const std::string& text = lines.all[line];
  std::vector<double> values;
  for (at = skip_blanks(text, at); number_begins(text, at); at = skip_blanks(text, at))
    values.push_back(number_at(lines, line, at, "a table", &at));
  return values;
}

Pairs::Pairs(const Lines& lines, std::size_t first, std::size_t last, const char* writer)
    : lines_(lines), last_(last), writer_(writer) {
  for (std::size_t i = first; i < last; ++i) {
    const std::string& text = lines.all[i];
    for (std::size_t equals = text.find('='); equals != std::string::npos;
         equals = text.find('=', equals + 1)) {
      std::size_t end = equals;
      while (end > 0 && blank(text[end - 1])) --end;
      std::size_t begin = end;
      while (begin > 0 && !blank(text[begin - 1]) && text[begin - 1] != '|') --begin;
      const std::string key = text.substr(begin, end - begin);
      if (key.empty() || all_.count(key)) continue;
      const std::size_t number = skip_blanks(text, equals + 1);
      // a name such as "control = flap" is not a number; a malformed one is reported when it is requested
      if (!number_begins(text, number)) continue;
      Pair pair;
      pair.line = i;
      std::size_t stop = 0;
      pair.value = number_at(lines, i, number, key, &stop);
      pair.unit = unit_behind(text, stop);
      all_[key] = pair;
    }
  }
}

const Pair& Pairs::pair(const std::string& key) const {
  const auto found = all_.find(key);
  if (found != all_.end()) return found->second;
  for (std::size_t i = 0; i < lines_.all.size() && i < last_; ++i) {
    const std::string& text = lines_.all[i];
    const std::size_t at = text.find(key), equals = text.find('=', at);
    if (at == std::string::npos || equals == std::string::npos) continue;
    if (at > 0 && !blank(text[at - 1]) && text[at - 1] != '|') continue;
    if (skip_blanks(text, at + key.size()) == equals)
      refuse(lines_.where(i), fulmar::located(key, aero_messages::number_expected(shown(text, equals + 1))));
  }
  refuse(lines_.where(last_ == 0 ? 0 : last_ - 1), aero_messages::pair_missing(key, writer_));
}

Value Pairs::value(const std::string& key, double factor) const {
  const Pair& found = pair(key);
  return {found.value * factor, lines_.place(found.line, key)};
}

std::optional<double> length_unit(const std::string& unit) {
  static const std::map<std::string, double> known{{"m", 1},       {"mm", 1e-3},   {"cm", 1e-2},
                                                   {"dm", 0.1},    {"in", 0.0254}, {"inch", 0.0254},
                                                   {"ft", 0.3048}, {"km", 1e3}};
  const auto found = known.find(lower(unit));
  if (found == known.end()) return {};
  return found->second;
}

std::optional<double> area_unit(const std::string& unit) {
  std::size_t letters = 0;
  while (letters < unit.size() && std::isalpha(static_cast<unsigned char>(unit[letters])) &&
         static_cast<unsigned char>(unit[letters]) < 128)
    ++letters;
  const std::optional<double> length = length_unit(unit.substr(0, letters));
  if (!length) return {};
  return *length * *length;
}

std::optional<double> mass_unit(const std::string& unit) {
  static const std::map<std::string, double> known{{"kg", 1},
                                                   {"g", 1e-3},
                                                   {"lb", 0.45359237},
                                                   {"lbs", 0.45359237},
                                                   {"lbm", 0.45359237},
                                                   {"oz", 0.028349523125},
                                                   {"slug", 14.593902937}};
  const auto found = known.find(lower(unit));
  if (found == known.end()) return {};
  return found->second;
}

std::optional<double> inertia_unit(const std::string& unit) {
  const std::size_t split = unit.find_first_of(".-* ");
  if (split == std::string::npos) return {};
  const std::optional<double> mass = mass_unit(unit.substr(0, split)),
                              area = area_unit(unit.substr(split + 1));
  if (!mass || !area) return {};
  return *mass * *area;
}

std::vector<std::string> words_of(const std::string& line) {
  std::vector<std::string> words;
  std::string word;
  for (const char c : line + " ") {
    if (blank(c) || c == '\r') {
      if (!word.empty()) words.push_back(word);
      word.clear();
    } else {
      word += c;
    }
  }
  return words;
}

std::vector<std::string> cells_of(const std::string& text) {
  std::vector<std::string> cells(1);
  for (const char c : text) {
    if (c == ',')
      cells.emplace_back();
    else
      cells.back() += c;
  }
  for (std::string& cell : cells) cell = trimmed(cell);
  return cells;
}

std::string trimmed(const std::string& text) {
  const std::size_t begin = text.find_first_not_of(" \t\r\n");
  if (begin == std::string::npos) return "";
  return text.substr(begin, text.find_last_not_of(" \t\r\n") - begin + 1);
}

std::string lower(std::string text) {
  for (char& c : text)
    if (c >= 'A' && c <= 'Z') c = char(c - 'A' + 'a');
  return text;
}

bool begins(const std::string& text, const std::string& with) {
  return text.compare(0, with.size(), with) == 0;
}

}  // namespace fulmar::aero::imports
