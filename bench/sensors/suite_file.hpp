// SPDX-License-Identifier: BSD-3-Clause
// Reads a file of sensors as the host does.
#pragma once
#include <string>

#include "core/graph/record.hpp"
#include "core/graph/yaml.hpp"
#include "core/loader/table.hpp"
#include "fulmar/schema.hpp"
#include "plugins/sim_aero/sensor_suite.hpp"

namespace fulmar::sim {

inline SensorSuite suite_file(const std::string& path) {
  core::Report report;
  const core::Node root = core::parse_yaml(core::read_source(path, path), report);
  SensorSuite suite;
  core::fill_record(*core::copy_type(fulmar::describe<SensorSuite>()), root,
                    reinterpret_cast<std::byte*>(&suite), "", report);
  report.throw_if_any();
  return suite;
}

}  // namespace fulmar::sim
