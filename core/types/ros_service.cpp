// SPDX-License-Identifier: BSD-3-Clause
// Names of request and response as in rosidl.
#include "core/types/ros_service.hpp"

#include <cstddef>

#include "core/types/wire.hpp"

namespace fulmar::core {
std::string srv_name(const Type& request) {
  std::string name = ros_name(request);
  if (const std::string half = "_Request"; name.size() > half.size() && name.ends_with(half))
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
  using R = ServiceResponse;
  Type type = *host_struct(request.name + "Response", sizeof(R), alignof(R),
                           {host_field("accepted", FULMAR_BOOL, offsetof(R, accepted)),
                            host_field("reason", FULMAR_TEXT, offsetof(R, reason), sizeof(R::reason))});
  type.ros = srv_name(request) + "_Response";
  return std::make_shared<const Type>(std::move(type));
}

std::string srv_text(const Type& request) {
  return ros_message_text(request) + "---\n" + ros_message_text(*srv_response(request));
}

}  // namespace fulmar::core
