// SPDX-License-Identifier: BSD-3-Clause
// Failure detection, and the ways home that remain.
#include "aircraft_watch.hpp"
#include "glide.hpp"
#include "ground.hpp"
#include "home.hpp"
#include "monitor.hpp"
#include "sensor_watch.hpp"

using namespace fulmar;
FULMAR_PLUGIN("1.0.0", safety::AircraftWatch, safety::Monitor, safety::Home, safety::Glide, safety::Ground,
              safety::SensorWatch)
