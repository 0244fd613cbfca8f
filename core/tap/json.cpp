// SPDX-License-Identifier: BSD-3-Clause
// A message as JSON, for people: command line, pages, results.
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "core/tap/element.hpp"
#include "core/tap/wire.hpp"

namespace fulmar::core {
namespace {

using nlohmann::json;

json number(double value, double scale) { return std::isfinite(value) ? json(value * scale) : json(nullptr); }

json text(std::string_view bytes) {
  // A plugin may write any bytes; JSON holds UTF-8 alone.
  return json::parse(json(std::string(bytes)).dump(-1, ' ', false, json::error_handler_t::replace));
}

json label(const Field& field, std::uint8_t value) { return value < field.labels.size() ? json(field.labels[value]) : json(value); }

json object(const Type& type, const std::byte* data, bool degrees, double scale);

json element(const Field& f, const std::byte* at, bool degrees, double scale) {
  switch (f.kind) {
    case FULMAR_BOOL:
      return load<std::uint8_t>(at) != 0;
    case FULMAR_U8:
      return load<std::uint8_t>(at);
    case FULMAR_I32:
      return load<std::int32_t>(at);
    case FULMAR_U32:
      return load<std::uint32_t>(at);
    case FULMAR_I64:
      return load<std::int64_t>(at);
    case FULMAR_U64:
      return load<std::uint64_t>(at);
    case FULMAR_F32:
      return number(static_cast<double>(load<float>(at)), scale);
    case FULMAR_F64:
      return number(load<double>(at), scale);
    case FULMAR_ENUM:
      return label(f, load<std::uint8_t>(at));
    case FULMAR_TEXT:
      return text(text_at(at, f.stride));
    case FULMAR_STRUCT:
      return object(*f.type, at, degrees, scale);
  }
  return nullptr;
}

/// `scale`: of all numbers, when an outer field has turned radians into degrees.
json object(const Type& type, const std::byte* data, bool degrees, double scale) {
  json result = json::object();
  for (const Field& f : type.fields) {
    const bool turned = degrees && f.name.ends_with("_rad");
    const std::string key = turned ? f.name.substr(0, f.name.size() - 3) + "deg" : f.name;
    const double factor = turned ? 180.0 / std::numbers::pi : scale;
    const auto [first, count] = elements(f, data);
    if (f.shape == FULMAR_SCALAR) {
      result[key] = element(f, first, degrees, factor);
      continue;
    }
    json& list = result[key] = json::array();
    for (std::uint32_t i = 0; i < count; ++i) list.push_back(element(f, first + std::size_t{i} * f.stride, degrees, factor));
  }
  return result;
}

}  // namespace

json to_json(const Type& type, const std::byte* data, bool degrees) { return object(type, data, degrees, 1.0); }

}  // namespace fulmar::core
