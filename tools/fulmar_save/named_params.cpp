// SPDX-License-Identifier: BSD-3-Clause
#include "tools/fulmar_save/named_params.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>

#include "core/error.hpp"
#include "tools/fulmar_save/messages.hpp"

namespace fulmar::core {
namespace {

using nlohmann::json;

const std::map<std::string, fulmar_param_kind> kinds{
    {"number", FULMAR_NUMBER}, {"flag", FULMAR_FLAG},     {"count", FULMAR_COUNT},
    {"choice", FULMAR_CHOICE}, {"text", FULMAR_STRING},   {"string", FULMAR_STRING},
    {"vector", FULMAR_VECTOR}, {"record", FULMAR_RECORD}, {"blob", FULMAR_BLOB}};

double number_or(const json& object, const char* key, double otherwise) {
  const auto it = object.find(key);
  return it != object.end() && it->is_number() ? it->get<double>() : otherwise;
}

/// The names of a vector's elements, if the view has them.
TypePtr vector_type(const json& names) {
  if (!names.is_array() || names.size() != 3) return nullptr;
  Type type;
  type.fields.resize(3);
  for (std::size_t i = 0; i < 3; ++i) type.fields[i].name = names[i].get<std::string>();
  return std::make_shared<const Type>(std::move(type));
}

}  // namespace

ParamInfo param_info(const json& param) {
  constexpr double inf = std::numeric_limits<double>::infinity();
  ParamInfo info;
  info.name = param.value("name", "");
  const std::string kind = param.value("kind", "");
  const auto known = kinds.find(kind);
  if (known == kinds.end()) throw Error(save_messages::parameter_kind_unknown(info.name, kind));
  info.kind = known->second;
  info.unit = param.value("unit", "");
  info.doc = param.value("doc", "");
  info.live = param.value("live", false);
  info.choices = param.value("choices", std::vector<std::string>());
  info.min = number_or(param, "min", -inf);
  info.max = number_or(param, "max", inf);
  info.capacity = std::numeric_limits<std::uint32_t>::max();  // the flight checks the capacity
  info.type = vector_type(param.value("fields", json()));
  const ParamValue initial = param_value(info, param.value("initial", json()));
  std::copy(std::begin(initial.number), std::end(initial.number), std::begin(info.initial));
  info.initial_text = initial.text;
  return info;
}

ParamValue param_value(const ParamInfo& info, const json& value) {
  ParamValue result;
  if (value.is_boolean()) result.integer = value.get<bool>() ? 1 : 0;
  if (value.is_number()) result.number[0] = value.get<double>();
  if (value.is_number_integer()) result.integer = value.get<std::int64_t>();
  if (value.is_array())
    for (std::size_t i = 0; i < std::min<std::size_t>(value.size(), 3); ++i)
      result.number[i] =
          value[i].is_number() ? value[i].get<double>() : std::numeric_limits<double>::quiet_NaN();
  if (value.is_string()) result.text = value.get<std::string>();
  if (info.kind == FULMAR_CHOICE) {
    const auto it = std::find(info.choices.begin(), info.choices.end(), result.text);
    if (it != info.choices.end()) result.integer = it - info.choices.begin();
  }
  if (info.kind == FULMAR_RECORD || info.kind == FULMAR_BLOB) result.integer = result.text.empty() ? 0 : 1;
  if (info.kind != FULMAR_NUMBER && info.kind != FULMAR_VECTOR)
    result.number[0] = static_cast<double>(result.integer);
  return result;
}

std::vector<NamedParam> params_of(const json& view) {
  std::vector<NamedParam> list;
  for (const json& c : view.value("components", json::array())) {
    for (const json& p : c.value("params", json::array())) {
      NamedParam param;
      param.component = c.value("name", "");
      param.use = c.value("use", "");
      param.vehicle = c.value("role", "") == "vehicle";
      param.info = param_info(p);
      param.value = param_value(param.info, p.value("value", json()));
      param.name = param.component + "." + param.info.name;
      param.overlaid = p.value("overlaid", false);
      param.text = p.value("text", "");
      list.push_back(std::move(param));
    }
  }
  return list;
}

}  // namespace fulmar::core
