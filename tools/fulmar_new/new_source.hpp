// SPDX-License-Identifier: BSD-3-Clause
// The source of a new component without a template: it passes on the output of the shipped one until the
// author changes it.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "tools/fulmar_new/new_contract.hpp"

namespace fulmar::core {

struct NewSource {
  std::string header, test;
};

/// `type` is the component's struct. `include` is the folder of the SDK's headers: the header declares
/// messages that are missing there.
NewSource write_source(const Contract& contract, const std::string& name, const std::string& type,
                       const std::filesystem::path& include);

/// "my_law" -> "MyLaw", "VehicleState" -> "vehicle_state"
std::string pascal_case(const std::string& name);
std::string snake_case(const std::string& name);

/// The C++ struct of a message, after the structs of its fields.
std::string message_source(const Type& type);

}  // namespace fulmar::core
