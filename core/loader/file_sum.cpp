// SPDX-License-Identifier: BSD-3-Clause
#include "core/loader/file_sum.hpp"

#include <cerrno>
#include <cstring>
#include <fstream>
#include <vector>

#include "core/error.hpp"
#include "core/loader/messages.hpp"
#include "core/types/sha256.hpp"

namespace fulmar::core {

namespace fs = std::filesystem;

std::string sha256_hex(const void* data, std::size_t size) {
  std::string hex = Sha256::of({static_cast<const char*>(data), size});
  if (hex.empty()) throw Error(loader_messages::checksum_not_available());
  return hex;
}

std::string sha256_file(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  Sha256 sum;
  std::vector<char> bytes(1u << 20);  // a log can be longer than memory
  while (in.read(bytes.data(), static_cast<std::streamsize>(bytes.size())) || in.gcount() > 0)
    sum.add(bytes.data(), static_cast<std::size_t>(in.gcount()));
  if (!in.eof())
    throw Error(loader_messages::file_not_readable(file.string(), std::strerror(errno != 0 ? errno : EIO)));
  std::string hex = sum.hex();
  if (hex.empty()) throw Error(loader_messages::checksum_not_available());
  return hex;
}

}  // namespace fulmar::core
