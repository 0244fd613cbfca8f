// SPDX-License-Identifier: BSD-3-Clause
// A message as JSON, for users: command line, pages, results.
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "core/types/element.hpp"
#include "core/types/wire.hpp"

namespace fulmar::core {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

/// Quantities in radians that become degrees.
enum class Turned : std::uint8_t { none, angles, all };

std::string key_of(const std::string& field, Turned turned) {
  if (turned == Turned::none || (turned == Turned::angles && !field.ends_with("_rad"))) return field;
  return shown_name(field);
}

ordered_json number(double value, double scale) {
  return std::isfinite(value) ? ordered_json(value * scale) : ordered_json(nullptr);
}

ordered_json text(std::string_view bytes) {
  // A plugin may write any bytes; JSON holds UTF-8 alone.
  return ordered_json::parse(
      ordered_json(std::string(bytes)).dump(-1, ' ', false, ordered_json::error_handler_t::replace));
}

ordered_json label(const Field& field, std::uint8_t value) {
  return value < field.labels.size() ? ordered_json(field.labels[value]) : ordered_json(value);
}

ordered_json object(const Type& type, const std::byte* data, Turned degrees, double scale);

ordered_json element(const Field& f, const std::byte* at, Turned degrees, double scale) {
  if (f.kind == FULMAR_STRUCT) return object(*f.type, at, degrees, scale);
  if (f.kind == FULMAR_TEXT) return text(text_at(at, f.stride));
  if (f.kind == FULMAR_ENUM) return label(f, load<std::uint8_t>(at));
  if (f.kind == FULMAR_BOOL) return load<std::uint8_t>(at) != 0;
  if (is_real(f.kind)) return number(number_at(f, at), scale);
  return with_number(f.kind, at, [](auto x) { return ordered_json(x); });
}

/// `scale`: of all numbers, when an outer field has turned radians into degrees.
ordered_json object(const Type& type, const std::byte* data, Turned degrees, double scale) {
  ordered_json result = ordered_json::object();
  for (const Field& f : type.fields) {
    const std::string key = key_of(f.name, degrees);
    const double factor = key != f.name ? 180.0 / std::numbers::pi : scale;
    const auto [first, count] = elements(f, data);
    if (f.shape == FULMAR_SCALAR) {
      result[key] = element(f, first, degrees, factor);
      continue;
    }
    ordered_json& list = result[key] = ordered_json::array();
    for (std::uint32_t i = 0; i < count; ++i)
      list.push_back(element(f, first + std::size_t{i} * f.stride, degrees, factor));
  }
  return result;
}

}  // namespace

std::string shown_name(const std::string& field) {
  for (const std::string_view ending : {"_rad", "_radps", "_radps2"})
    if (field.ends_with(ending))
      return field.substr(0, field.size() - ending.size()) + "_deg" + std::string(ending.substr(4));
  return field;
}

json to_json(const Type& type, const std::byte* data, bool degrees) {
  return object(type, data, degrees ? Turned::angles : Turned::none, 1.0);
}

json figures_json(const Type& type, const std::byte* data) {
  constexpr double unknown = 1e9, unknown_deg = unknown * (180.0 / std::numbers::pi);
  json figures = to_json(type, data, true);
  for (json& value : figures)
    if (value == unknown || value == unknown_deg) value = nullptr;
  return figures;
}

ordered_json shown_json(const Type& type, const std::byte* data) {
  return object(type, data, Turned::all, 1.0);
}

bool json_too_deep(std::string_view text) {
  constexpr int most = 32;
  int depth = 0;
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quoted && c == '\\') ++i;
    if (c == '"') quoted = !quoted;
    if (quoted) continue;
    if ((c == '[' || c == '{') && ++depth > most) return true;
    if (c == ']' || c == '}') --depth;
  }
  return false;
}

}  // namespace fulmar::core
