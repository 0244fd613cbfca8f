// SPDX-License-Identifier: BSD-3-Clause
// Publishes and receives the standard messages of ROS 2, and those of ROSplane and ROSflight.
#include "commands.hpp"
#include "rosplane_in.hpp"
#include "rosplane_out.hpp"
#include "scene.hpp"
#include "standard.hpp"

using namespace fulmar::ros_bridge;

FULMAR_PLUGIN("1.0.0", Standard, Goal, Velocity, Scene, Rosplane, RosplaneFollower, RosplaneController,
              RosplanePath, RosplaneWaypoints, RosplaneEstimator)
