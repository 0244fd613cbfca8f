// SPDX-License-Identifier: BSD-3-Clause
// Units: a table of symbols and a small parser for products and quotients of them. Factors are the SI
// brochure's and ISO 80000's.
#include "core/graph/quantity.hpp"

#include <charconv>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

namespace fulmar::core {
namespace {

using Dimension = std::array<std::int8_t, 6>;
constexpr Dimension none{};
constexpr Dimension length{1, 0, 0, 0, 0, 0}, mass{0, 1, 0, 0, 0, 0}, time{0, 0, 1, 0, 0, 0},
    current{0, 0, 0, 1, 0, 0};
constexpr Dimension kelvin{0, 0, 0, 0, 1, 0}, angle{0, 0, 0, 0, 0, 1}, per_time{0, 0, -1, 0, 0, 0};
constexpr Dimension speed{1, 0, -1, 0, 0, 0}, acceleration{1, 0, -2, 0, 0, 0}, turn_rate{0, 0, -1, 0, 0, 1},
    turn_acceleration{0, 0, -2, 0, 0, 1};
constexpr Dimension force{1, 1, -2, 0, 0, 0}, pressure{-1, 1, -2, 0, 0, 0}, energy{2, 1, -2, 0, 0, 0},
    power{2, 1, -3, 0, 0, 0};
constexpr Dimension voltage{2, 1, -3, -1, 0, 0}, resistance{2, 1, -3, -2, 0, 0},
    magnetic_field{0, 1, -2, -1, 0, 0}, area{2, 0, 0, 0, 0, 0};
constexpr Dimension inertia{2, 1, 0, 0, 0, 0}, density{-3, 1, 0, 0, 0, 0}, charge{0, 0, 1, 1, 0, 0};
constexpr double pi = std::numbers::pi;

struct Symbol {
  std::string_view name;
  Dimension dimension;
  double factor;
  double offset = 0;
};
constexpr Symbol symbols[] = {
    {"1", none, 1},
    {"ratio", none, 1},
    {"frac", none, 1},
    {"%", none, 0.01},
    {"m", length, 1},
    {"cm", length, 0.01},
    {"mm", length, 1e-3},
    {"km", length, 1000},
    {"ft", length, 0.3048},
    {"in", length, 0.0254},
    {"nmi", length, 1852},
    {"mi", length, 1609.344},
    {"s", time, 1},
    {"ms", time, 1e-3},
    {"us", time, 1e-6},
    {"\u00b5s", time, 1e-6},
    {"ns", time, 1e-9},
    {"min", time, 60},
    {"h", time, 3600},
    {"Hz", per_time, 1},
    {"kHz", per_time, 1000},
    {"mps", speed, 1},
    {"kt", speed, 1852.0 / 3600},
    {"kn", speed, 1852.0 / 3600},
    {"mph", speed, 0.44704},
    {"kmh", speed, 1 / 3.6},
    {"fpm", speed, 0.3048 / 60},
    {"mps2", acceleration, 1},
    {"g", acceleration, 9.80665},
    {"rad", angle, 1},
    {"deg", angle, pi / 180},
    {"\u00b0", angle, pi / 180},
    {"mrad", angle, 1e-3},
    {"rev", angle, 2 * pi},
    {"radps", turn_rate, 1},
    {"degps", turn_rate, pi / 180},
    {"rpm", turn_rate, 2 * pi / 60},
    {"radps2", turn_acceleration, 1},
    {"kg", mass, 1},
    {"gram", mass, 1e-3},
    {"lb", mass, 0.45359237},
    {"kgm2", inertia, 1},
    {"N", force, 1},
    {"newton", force, 1},
    {"J", energy, 1},
    {"W", power, 1},
    {"Pa", pressure, 1},
    {"pa", pressure, 1},
    {"hPa", pressure, 100},
    {"kPa", pressure, 1000},
    {"mbar", pressure, 100},
    {"bar", pressure, 1e5},
    {"K", kelvin, 1},
    {"kelvin", kelvin, 1},
    {"degC", kelvin, 1, 273.15},
    {"\u00b0C", kelvin, 1, 273.15},
    {"V", voltage, 1},
    {"volt", voltage, 1},
    {"mV", voltage, 1e-3},
    {"A", current, 1},
    {"amp", current, 1},
    {"mA", current, 1e-3},
    {"Ah", charge, 3600},
    {"mAh", charge, 3.6},
    {"ohm", resistance, 1},
    {"mohm", resistance, 1e-3},
    {"T", magnetic_field, 1},
    {"tesla", magnetic_field, 1},
    {"uT", magnetic_field, 1e-6},
    {"nT", magnetic_field, 1e-9},
    {"gauss", magnetic_field, 1e-4},
};

struct Named {
  Dimension dimension;
  const char* name;
  const char* examples;
};
constexpr Named unit_names[] = {
    {none, "a plain number", "no unit, or %"},
    {length, "a length", "m, cm, mm, km, ft, in, nmi"},
    {area, "an area", "m^2"},
    {time, "a time", "s, ms, us, ns, min, h"},
    {per_time, "a frequency", "Hz, kHz, 1/s"},
    {speed, "a speed", "m/s, km/h, kt, ft/s"},
    {acceleration, "an acceleration", "m/s^2, g"},
    {angle, "an angle", "deg, rad"},
    {turn_rate, "an angular rate", "deg/s, rad/s, rpm"},
    {turn_acceleration, "an angular acceleration", "deg/s^2, rad/s^2"},
    {mass, "a mass", "kg, gram, lb"},
    {inertia, "a moment of inertia", "kg m^2"},
    {force, "a force", "N"},
    {energy, "a torque or an energy", "N m"},
    {power, "a power", "W"},
    {pressure, "a pressure", "Pa, hPa, kPa, mbar"},
    {density, "a density", "kg/m^3"},
    {kelvin, "a temperature", "K, degC"},
    {voltage, "a voltage", "V, mV"},
    {current, "a current", "A, mA"},
    {charge, "an electric charge", "Ah, mAh"},
    {resistance, "a resistance", "ohm, mohm"},
    {magnetic_field, "a magnetic field", "T, uT, nT, gauss"},
};

const Symbol* find_symbol(std::string_view name) {
  for (const Symbol& symbol : symbols)
    if (symbol.name == name) return &symbol;
  return nullptr;
}

/// expression = term {("/" | "*" | "." | " ") term}; term = symbol [["^"] digit] | "(" expression ")"
class UnitParser {
 public:
  explicit UnitParser(std::string_view text) : text_(text) {}

  std::optional<PhysicalUnit> parse() {
    auto unit = expression(0);
    return unit && at_ == text_.size() ? unit : std::nullopt;
  }

 private:
  std::optional<PhysicalUnit> expression(int depth) {
    auto unit = term(depth);
    while (unit && at_ < text_.size() && text_[at_] != ')') {
      const bool divide = separator();
      const auto next = term(depth);
      if (!next) return std::nullopt;
      unit = combine(*unit, *next, divide ? -1 : 1);
    }
    return unit;
  }

  /// True for "/". Several blanks around it count once.
  bool separator() {
    bool divide = false;
    while (at_ < text_.size()) {
      if (take("/")) {
        divide = true;
        skip_blanks();
        break;
      }
      if (!take(" ") && !take("*") && !take("\u00b7")) break;
    }
    return divide;
  }

  std::optional<PhysicalUnit> term(int depth) {
    if (depth > 4) return std::nullopt;
    if (take("(")) {
      auto unit = expression(depth + 1);
      if (!unit || !take(")")) return std::nullopt;
      return unit;
    }
    return factor();
  }

  std::optional<PhysicalUnit> factor() {
    std::size_t end = at_;
    while (end < text_.size() && std::string_view(" /*()^").find(text_[end]) == std::string_view::npos &&
           !text_.substr(end).starts_with("\u00b7"))
      ++end;
    std::string_view word = text_.substr(at_, end - at_);
    at_ = end;
    int exponent = 1;
    const Symbol* symbol = find_symbol(word);
    if (!symbol) {  // s2, s²
      if (word.ends_with("\u00b2"))
        word = word.substr(0, word.size() - 2), exponent = 2;
      else if (word.ends_with("\u00b3"))
        word = word.substr(0, word.size() - 2), exponent = 3;
      else if (word.size() > 1 && word.back() >= '1' && word.back() <= '9')
        exponent = word.back() - '0', word = word.substr(0, word.size() - 1);
      symbol = find_symbol(word);
    }
    if (!symbol) return std::nullopt;
    if (take("^")) {
      if (at_ >= text_.size() || text_[at_] < '1' || text_[at_] > '9') return std::nullopt;
      exponent = text_[at_++] - '0';
    }
    PhysicalUnit unit{symbol->dimension, symbol->factor, symbol->offset};
    for (int i = 1; i < exponent; ++i) unit = combine(unit, {symbol->dimension, symbol->factor, 0}, 1);
    return unit;
  }

  static PhysicalUnit combine(const PhysicalUnit& a, const PhysicalUnit& b, int sign) {
    PhysicalUnit unit = a;
    for (std::size_t i = 0; i < unit.dimension.size(); ++i)
      unit.dimension[i] = static_cast<std::int8_t>(a.dimension[i] + sign * b.dimension[i]);
    unit.factor = sign > 0 ? a.factor * b.factor : a.factor / b.factor;
    unit.offset = 0;
    return unit;
  }

  bool take(std::string_view what) {
    if (!text_.substr(at_).starts_with(what)) return false;
    at_ += what.size();
    return true;
  }
  void skip_blanks() {
    while (at_ < text_.size() && text_[at_] == ' ') ++at_;
  }

  std::string_view text_;
  std::size_t at_ = 0;
};

const Named* named(const PhysicalUnit& unit) {
  for (const Named& entry : unit_names)
    if (entry.dimension == unit.dimension) return &entry;
  return nullptr;
}

std::string_view word_after_dot(std::string_view text) {
  while (!text.empty() && (text.front() == '+' || text.front() == '-')) text.remove_prefix(1);
  if (!text.empty() && text.front() == '.') text.remove_prefix(1);
  return text;
}

bool names_no_number(std::string_view text) {
  const std::string word = lower(word_after_dot(text));
  return word == "nan" || word == "inf" || word == "infinity";
}

std::string short_number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

/// Is a bare number clear enough where a unit is required? Plain numbers, and latitude and longitude.
bool needs_no_unit(const PhysicalUnit& unit, const std::string& text) {
  return unit.dimension == none || text == "deg";
}

std::string how_to_write(const PhysicalUnit& unit) {
  const Named* entry = named(unit);
  return entry ? std::string(entry->name) + " is written with " + entry->examples : "";
}

/// The unit that was written, as SI; "g" is the gram where a mass is wanted.
PhysicalUnit written_unit(const Quantity& quantity, const std::string& unit,
                          const std::optional<PhysicalUnit>& wanted) {
  const auto written = quantity.unit == "g" && wanted && wanted->dimension == mass
                           ? parse_unit("gram")
                           : parse_unit(quantity.unit);
  if (written) return *written;
  const std::string hint = wanted ? how_to_write(*wanted) : "write " + unit;
  throw Error(quantity.text + ": unknown unit '" + quantity.unit + "'" + (hint.empty() ? "" : "; " + hint));
}

}  // namespace

std::optional<PhysicalUnit> parse_unit(std::string_view text) {
  text = trimmed(text);
  if (text.empty() || text == "-") return PhysicalUnit{};
  return UnitParser(text).parse();
}

std::string dimension_name(const PhysicalUnit& unit) {
  const Named* entry = named(unit);
  return entry ? entry->name : "";
}

bool same_dimension(const std::string& unit_a, const std::string& unit_b) {
  const auto a = parse_unit(unit_a), b = parse_unit(unit_b);
  return a && b ? a->dimension == b->dimension : unit_a == unit_b;
}

double unit_factor(const std::string& from, const std::string& to) {
  const auto a = parse_unit(from), b = parse_unit(to);
  return a && b && from != to ? a->factor / b->factor : 1;
}

Quantity parse_quantity(std::string_view text) {
  Quantity quantity;
  text = trimmed(text);
  quantity.text = std::string(text);
  std::string_view digits = text.starts_with('+') ? text.substr(1) : text;
  if (names_no_number(digits)) throw Error(quantity.text + " is not a finite number");
  const auto [end, code] = std::from_chars(digits.data(), digits.data() + digits.size(), quantity.number);
  if (code == std::errc::result_out_of_range)
    throw Error(quantity.text + " is too large or too small for a number");
  if (code != std::errc{} || end == digits.data()) throw Error("'" + quantity.text + "' is not a number");
  if (!std::isfinite(quantity.number)) throw Error(quantity.text + " is not a finite number");
  quantity.unit = std::string(trimmed(digits.substr(static_cast<std::size_t>(end - digits.data()))));
  return quantity;
}

double convert(const Quantity& quantity, const std::string& unit, UnitRule rule) {
  const auto wanted = parse_unit(unit);
  if (quantity.unit.empty()) {
    if (rule == UnitRule::required && wanted && !needs_no_unit(*wanted, unit))
      throw Error(quantity.text + " has no unit; " + how_to_write(*wanted));
    return quantity.number;
  }
  if (quantity.unit == unit) return quantity.number;
  const PhysicalUnit written = written_unit(quantity, unit, wanted);
  if (!wanted) throw Error(quantity.text + ": the unit here is " + unit);
  if (written.dimension != wanted->dimension) {
    const std::string is = dimension_name(written), is_not = dimension_name(*wanted);
    throw Error(quantity.text + " is " + (is.empty() ? "" : is + ", ") + "not " +
                (is_not.empty() ? "in " + unit : is_not));
  }
  const double value = (quantity.number * written.factor + written.offset - wanted->offset) / wanted->factor;
  if (!std::isfinite(value)) throw Error(quantity.text + " is too large for a number");
  return value;
}

double quantity_in(std::string_view text, const std::string& unit, UnitRule rule) {
  return convert(parse_quantity(text), unit, rule);
}

void check_range(const Quantity& quantity, double value, const std::string& unit, double min, double max) {
  if (value >= min && value <= max) return;
  const std::string shown = quantity.unit.empty() ? unit : quantity.unit;
  const auto wanted = parse_unit(unit), written = parse_unit(shown);
  const auto in_shown = [&](double bound) {
    if (!wanted || !written || shown == unit || wanted->dimension != written->dimension)
      return short_number(bound);
    return short_number((bound * wanted->factor + wanted->offset - written->offset) / written->factor);
  };
  const std::string tail = shown.empty() ? "" : " " + shown;
  if (!std::isfinite(max)) throw Error(quantity.text + " is below " + in_shown(min) + tail);
  if (!std::isfinite(min)) throw Error(quantity.text + " is above " + in_shown(max) + tail);
  throw Error(quantity.text + " is outside " + in_shown(min) + " .. " + in_shown(max) + tail);
}

std::optional<Suffixed> split_suffix(const std::string& name) {
  static constexpr std::pair<std::string_view, const char*> suffixes[] = {
      {"mps2", "m/s2"}, {"radps2", "rad/s2"}, {"radps", "rad/s"}, {"mps", "m/s"}, {"kgm2", "kg m2"},
      {"m2", "m2"},     {"m", "m"},           {"rad", "rad"},     {"deg", "deg"}, {"pa", "Pa"},
      {"kelvin", "K"},  {"tesla", "T"},       {"volt", "V"},      {"amp", "A"},   {"ohm", "ohm"},
      {"newton", "N"},  {"kg", "kg"},         {"hz", "Hz"},       {"ns", "ns"},   {"s", "s"},
      {"frac", ""},     {"ratio", ""}};
  const auto underscore = name.rfind('_');
  if (underscore == std::string::npos || underscore == 0) return std::nullopt;
  for (const auto& [suffix, unit] : suffixes)
    if (std::string_view(name).substr(underscore + 1) == suffix)
      return Suffixed{name.substr(0, underscore), unit};
  return std::nullopt;
}

}  // namespace fulmar::core
