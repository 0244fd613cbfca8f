// SPDX-License-Identifier: BSD-3-Clause
#pragma once
#include <cstddef>
#include <filesystem>
#include <string>

namespace fulmar::core {

std::string sha256_hex(const void* data, std::size_t size);
std::string sha256_file(const std::filesystem::path& file);

}  // namespace fulmar::core
