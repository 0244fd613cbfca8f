// SPDX-License-Identifier: BSD-3-Clause
// See ros_service.hpp. Names as rosidl gives them to the halves of a service.
#include "core/types/ros_service.hpp"

#include <cstddef>
#include <limits>

#include "core/types/wire.hpp"

namespace fulmar::core {
namespace {

Field member(const char* name, fulmar_kind kind, std::size_t offset, std::size_t stride) {
  Field field;
  field.name = name;
  field.kind = kind;
  field.offset = static_cast<std::uint32_t>(offset);
  field.stride = static_cast<std::uint32_t>(stride);
  field.min = -std::numeric_limits<double>::infinity();
  field.max = std::numeric_limits<double>::infinity();
  return field;
}

}  // namespace

std::string srv_name(const Type& request) {
  std::string name = ros_name(request);
  const std::string half = "_Request";
  if (name.size() > half.size() && name.compare(name.size() - half.size(), half.size(), half) == 0)
    name.resize(name.size() - half.size());
  const std::size_t middle = name.find("/msg/");
  return middle == std::string::npos ? name : name.replace(middle, 5, "/srv/");
}

TypePtr srv_request(const Type& request) {
  Type type = request;
  type.ros = srv_name(request) + "_Request";
  return std::make_shared<const Type>(std::move(type));
}

TypePtr srv_response(const Type& request) {
  Type type;
  type.name = request.name + "Response";
  type.ros = srv_name(request) + "_Response";
  type.size = sizeof(ServiceResponse);
  type.align = alignof(ServiceResponse);
  type.fields = {
      member("accepted", FULMAR_BOOL, offsetof(ServiceResponse, accepted), 1),
      member("reason", FULMAR_TEXT, offsetof(ServiceResponse, reason), sizeof(ServiceResponse::reason))};
  return std::make_shared<const Type>(std::move(type));
}

std::string srv_text(const Type& request) {
  return ros_message_text(request) + "---\n" + ros_message_text(*srv_response(request));
}

}  // namespace fulmar::core
