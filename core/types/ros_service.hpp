// SPDX-License-Identifier: BSD-3-Clause
// A request port as a ROS 2 service: the request's fields are the input, {accepted, reason} is the response.
#pragma once
#include <string>

#include "core/types/type.hpp"

namespace fulmar::core {

/// "fulmar_msgs/srv/AddWaypoints". A foreign request names its own service: "rosplane_msgs/srv/AddWaypoint".
std::string srv_name(const Type& request);

/// Request and response of the service as messages: "fulmar_msgs/srv/AddWaypoints_Request", "..._Response".
TypePtr srv_request(const Type& request);
TypePtr srv_response(const Type& request);

/// Memory layout of the response.
struct ServiceResponse {
  bool accepted = false;
  char reason[255] = {};
};

/// The content of AddWaypoints.srv in an interface package.
std::string srv_text(const Type& request);

}  // namespace fulmar::core
