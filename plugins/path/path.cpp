// SPDX-License-Identifier: BSD-3-Clause
// From a list of waypoints to a course: the planner keeps the list, the manager selects the active piece of
// path, the vector field follows it.
#include "landing.hpp"
#include "loiter.hpp"
#include "manager.hpp"
#include "planner.hpp"
#include "vector_field.hpp"

using namespace fulmar::path;

FULMAR_PLUGIN("1.0.0", Planner, Manager, VectorField, Landing, Loiter)
