// SPDX-License-Identifier: BSD-3-Clause
// Units: a table of symbols and a parser for products and quotients of them. Factors are those of the SI
// brochure and ISO 80000.
#include "core/graph/quantity.hpp"

#include <charconv>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

#include "core/graph/messages.hpp"

namespace fulmar::core {
namespace {

using Dimension = decltype(PhysicalUnit::dimension);  // powers of m, kg, s, A, K, rad
constexpr Dimension none{}, mass{0, 1, 0, 0, 0, 0};
constexpr double pi = std::numbers::pi;

struct Symbol {
  std::string_view name;
  double factor;
  double offset = 0;
};
struct Measure {
  Dimension dimension;
  const char *name, *examples;
  std::vector<Symbol> symbols{};
};

const std::vector<Measure> measures = {
    {none, "a plain number", "no unit, or %", {{"1", 1}, {"ratio", 1}, {"frac", 1}, {"%", 0.01}}},
    {{1, 0, 0, 0, 0, 0},
     "a length",
     "m, cm, mm, km, ft, in, nmi",
     {{"m", 1},
      {"cm", 0.01},
      {"mm", 1e-3},
      {"km", 1000},
      {"ft", 0.3048},
      {"in", 0.0254},
      {"nmi", 1852},
      {"mi", 1609.344}}},
    {{2, 0, 0, 0, 0, 0}, "an area", "m^2"},
    {{0, 0, 1, 0, 0, 0},
     "a time",
     "s, ms, us, ns, min, h",
     {{"s", 1}, {"ms", 1e-3}, {"us", 1e-6}, {"\u00b5s", 1e-6}, {"ns", 1e-9}, {"min", 60}, {"h", 3600}}},
    {{0, 0, -1, 0, 0, 0}, "a frequency", "Hz, kHz, 1/s", {{"Hz", 1}, {"kHz", 1000}}},
    {{1, 0, -1, 0, 0, 0},
     "a speed",
     "m/s, km/h, kt, ft/s",
     {{"mps", 1},
      {"kt", 1852.0 / 3600},
      {"kn", 1852.0 / 3600},
      {"mph", 0.44704},
      {"kmh", 1 / 3.6},
      {"fpm", 0.3048 / 60}}},
    {{1, 0, -2, 0, 0, 0},
     "an acceleration",
     "m/s^2, g, mg, ug",
     {{"mps2", 1}, {"g", 9.80665}, {"mg", 9.80665e-3}, {"ug", 9.80665e-6}}},
    {{0, 0, 0, 0, 0, 1},
     "an angle",
     "deg, rad",
     {{"rad", 1},
      {"deg", pi / 180},
      {"\u00b0", pi / 180},
      {"mrad", 1e-3},
      {"mdeg", pi / 180e3},
      {"rev", 2 * pi}}},
    {{0, 0, -1, 0, 0, 1},
     "an angular rate",
     "deg/s, rad/s, rpm",
     {{"radps", 1}, {"degps", pi / 180}, {"rpm", 2 * pi / 60}}},
    {{0, 0, -2, 0, 0, 1}, "an angular acceleration", "deg/s^2, rad/s^2", {{"radps2", 1}}},
    {mass, "a mass", "kg, gram, lb", {{"kg", 1}, {"gram", 1e-3}, {"lb", 0.45359237}}},
    {{2, 1, 0, 0, 0, 0}, "a moment of inertia", "kg m^2", {{"kgm2", 1}}},
    {{1, 1, -2, 0, 0, 0}, "a force", "N", {{"N", 1}, {"newton", 1}}},
    {{2, 1, -2, 0, 0, 0}, "a torque or an energy", "N m", {{"J", 1}}},
    {{2, 1, -3, 0, 0, 0}, "a power", "W", {{"W", 1}}},
    {{-1, 1, -2, 0, 0, 0},
     "a pressure",
     "Pa, hPa, kPa, mbar",
     {{"Pa", 1}, {"pa", 1}, {"hPa", 100}, {"kPa", 1000}, {"mbar", 100}, {"bar", 1e5}}},
    {{-3, 1, 0, 0, 0, 0}, "a density", "kg/m^3"},
    {{0, 0, 0, 0, 1, 0},
     "a temperature",
     "K, degC",
     {{"K", 1}, {"kelvin", 1}, {"degC", 1, 273.15}, {"\u00b0C", 1, 273.15}}},
    {{2, 1, -3, -1, 0, 0}, "a voltage", "V, mV", {{"V", 1}, {"volt", 1}, {"mV", 1e-3}}},
    {{0, 0, 0, 1, 0, 0}, "a current", "A, mA", {{"A", 1}, {"amp", 1}, {"mA", 1e-3}}},
    {{0, 0, 1, 1, 0, 0}, "an electric charge", "Ah, mAh", {{"Ah", 3600}, {"mAh", 3.6}}},
    {{2, 1, -3, -2, 0, 0}, "a resistance", "ohm, mohm", {{"ohm", 1}, {"mohm", 1e-3}}},
    {{0, 1, -2, -1, 0, 0},
     "a magnetic field",
     "T, uT, nT, gauss",
     {{"T", 1}, {"tesla", 1}, {"uT", 1e-6}, {"nT", 1e-9}, {"gauss", 1e-4}}}};

std::optional<PhysicalUnit> find_symbol(std::string_view name) {
  for (const Measure& measure : measures)
    for (const Symbol& symbol : measure.symbols)
      if (symbol.name == name) return PhysicalUnit{measure.dimension, symbol.factor, symbol.offset};
  return std::nullopt;
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
    auto symbol = find_symbol(word);
    if (!symbol) {  // s2, s²
      if (word.ends_with("\u00b2")) {
        word = word.substr(0, word.size() - 2);
        exponent = 2;
      } else if (word.ends_with("\u00b3")) {
        word = word.substr(0, word.size() - 2);
        exponent = 3;
      } else if (word.size() > 1 && word.back() >= '1' && word.back() <= '9') {
        exponent = word.back() - '0';
        word = word.substr(0, word.size() - 1);
      }
      symbol = find_symbol(word);
    }
    if (!symbol) return std::nullopt;
    if (take("^")) {
      if (at_ >= text_.size() || text_[at_] < '1' || text_[at_] > '9') return std::nullopt;
      exponent = text_[at_++] - '0';
    }
    PhysicalUnit unit = *symbol;
    for (int i = 1; i < exponent; ++i) unit = combine(unit, *symbol, 1);
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

const Measure* named(const PhysicalUnit& unit) {
  for (const Measure& measure : measures)
    if (measure.dimension == unit.dimension) return &measure;
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

std::string dimension_name(const PhysicalUnit& unit) {
  const Measure* measure = named(unit);
  return measure ? measure->name : "";
}

/// Whether a bare number is clear where a unit is required: plain numbers, latitude and longitude.
bool needs_no_unit(const PhysicalUnit& unit, const std::string& text) {
  return unit.dimension == none || text == "deg";
}

std::string how_to_write(const PhysicalUnit& unit) {
  const Measure* entry = named(unit);
  return entry ? graph_messages::unit_examples(entry->name, entry->examples).line() : "";
}

/// The written unit, as SI; "g" is the gram where a mass is expected.
PhysicalUnit written_unit(const Quantity& quantity, const std::string& unit,
                          const std::optional<PhysicalUnit>& wanted) {
  const auto written = quantity.unit == "g" && wanted && wanted->dimension == mass
                           ? parse_unit("gram")
                           : parse_unit(quantity.unit);
  if (written) return *written;
  const std::string hint = wanted ? how_to_write(*wanted) : "write " + unit;
  throw Error(
      located(quantity.text, graph_messages::unit_unknown(quantity.unit, hint.empty() ? "" : "; " + hint)));
}

}  // namespace

std::optional<PhysicalUnit> parse_unit(std::string_view text) {
  text = trimmed(text);
  if (text.empty() || text == "-") return PhysicalUnit{};
  return UnitParser(text).parse();
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
  if (names_no_number(digits)) throw Error(graph_messages::number_not_finite(quantity.text));
  const auto [end, code] = std::from_chars(digits.data(), digits.data() + digits.size(), quantity.number);
  if (code == std::errc::result_out_of_range)
    throw Error(graph_messages::number_not_representable(quantity.text));
  if (code != std::errc{} || end == digits.data()) throw Error(graph_messages::number_invalid(quantity.text));
  if (!std::isfinite(quantity.number)) throw Error(graph_messages::number_not_finite(quantity.text));
  quantity.unit = std::string(trimmed(digits.substr(static_cast<std::size_t>(end - digits.data()))));
  return quantity;
}

double convert(const Quantity& quantity, const std::string& unit, UnitRule rule) {
  const auto wanted = parse_unit(unit);
  if (quantity.unit.empty()) {
    if (rule == UnitRule::required && wanted && !needs_no_unit(*wanted, unit))
      throw Error(graph_messages::unit_missing(quantity.text, how_to_write(*wanted)));
    return quantity.number;
  }
  if (quantity.unit == unit) return quantity.number;
  const PhysicalUnit written = written_unit(quantity, unit, wanted);
  if (!wanted) throw Error(located(quantity.text, graph_messages::unit_not_accepted(unit)));
  if (written.dimension != wanted->dimension) {
    const std::string is = dimension_name(written), is_not = dimension_name(*wanted);
    throw Error(graph_messages::dimension_differs(quantity.text, is.empty() ? "" : is + ", ",
                                                  is_not.empty() ? "in " + unit : is_not));
  }
  const double value = (quantity.number * written.factor + written.offset - wanted->offset) / wanted->factor;
  if (!std::isfinite(value)) throw Error(graph_messages::number_too_large(quantity.text));
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
  const std::string in_degrees = unit == "rad" ? "deg" : unit == "rad/s" ? "deg/s" : "";
  const double radians = value * std::numbers::pi / 180;
  const bool degrees =
      quantity.unit.empty() && !in_degrees.empty() && radians >= min && radians <= max && value != 0;
  const std::string hint = degrees ? ". Did you mean " + quantity.text + " " + in_degrees + "?" : "";
  if (!std::isfinite(max))
    throw Error(graph_messages::value_too_small(quantity.text, in_shown(min), tail, hint));
  if (!std::isfinite(min))
    throw Error(graph_messages::value_too_large(quantity.text, in_shown(max), tail, hint));
  throw Error(graph_messages::value_out_of_range(quantity.text, in_shown(min), in_shown(max), tail, hint));
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
