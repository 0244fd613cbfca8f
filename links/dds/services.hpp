// SPDX-License-Identifier: BSD-3-Clause
// Requests as ROS 2 services, and the parameters of all components as parameters of one ROS 2 node, for `ros2
// service`, `ros2 param` and rqt.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "core/tap/control.hpp"
#include "links/dds/participant.hpp"
#include "links/dds/rcl.hpp"
#include "links/dds/server.hpp"

namespace fulmar::core::dds {

/// Node of the parameters: "/fulmar", or "/uav1/fulmar".
inline constexpr const char* node_name = "fulmar";

using Servers = std::vector<std::unique_ptr<Server>>;

/// A service per request port: "/plan/edit", type fulmar_msgs/srv/PlanEdit.
void add_request_services(Servers& servers, Participant& participant, const DdsOptions& options,
                          Control& control, const FlightView& view, const std::shared_ptr<Waker>& waker);

/// Parameter services of a node: "slc.roll_kp" is the parameter roll_kp of the component slc.
void add_parameter_services(Servers& servers, Participant& participant, const DdsOptions& options,
                            Control& control, const std::shared_ptr<Waker>& waker);

/// Topic /parameter_events: reports each change, from any source.
class ParameterEvents {
 public:
  ParameterEvents(Participant& participant, const DdsOptions& options, Control& control,
                  const std::shared_ptr<Waker>& waker);
  void pump();
  const Writer& writer() const { return *writer_; }

 private:
  Control& control_;
  std::string node_;
  std::unique_ptr<Writer> writer_;
  std::shared_ptr<Inbox<std::string>> changed_;
};

/// Topic ros_discovery_info: lists the endpoints of the node. ROS 2 tools need it to show the node. The list
/// stays valid while the writer lives.
std::unique_ptr<Writer> node_info(Participant& participant, const DdsOptions& options,
                                  const std::vector<Guid>& readers, const std::vector<Guid>& writers);

/// A parameter in the form of ROS 2.
RclValue rcl_value(const ParameterView& parameter);

}  // namespace fulmar::core::dds
