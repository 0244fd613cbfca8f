// SPDX-License-Identifier: BSD-3-Clause
// Readable and executable memory of this process. Format of /proc/self/maps: proc(5), "begin-end perms ...",
// ascending.
#include "core/loader/memory.hpp"

#include <algorithm>
#include <cinttypes>
#include <cstring>
#include <fstream>

#include "core/error.hpp"
#include "core/loader/messages.hpp"

namespace fulmar::core {

Memory::Memory() {
  const auto append = [](std::vector<Range>& ranges, Range range) {
    if (!ranges.empty() && ranges.back().end == range.begin) {
      ranges.back().end = range.end;
    } else {
      ranges.push_back(range);
    }
  };
  std::ifstream maps("/proc/self/maps");
  for (std::string line; std::getline(maps, line);) {
    Range range{};
    char perms[5] = "";
    if (std::sscanf(line.c_str(), "%" SCNxPTR "-%" SCNxPTR " %4s", &range.begin, &range.end, perms) != 3)
      continue;
    if (perms[0] == 'r') append(readable_, range);
    if (perms[2] == 'x') append(executable_, range);
    known_ = true;
  }
}

bool Memory::covered(const std::vector<Range>& ranges, const void* at, std::size_t size) const {
  const auto begin = reinterpret_cast<std::uintptr_t>(at);
  if (begin == 0) return false;
  if (!known_) return true;
  const auto after = std::upper_bound(ranges.begin(), ranges.end(), begin,
                                      [](std::uintptr_t x, const Range& r) { return x < r.begin; });
  if (after == ranges.begin()) return false;
  const Range& range = *(after - 1);
  return begin < range.end && size <= range.end - begin;
}

std::size_t Memory::readable_bytes(const void* at) const {
  constexpr std::size_t longest = 4096;
  if (readable(at, longest)) return longest;
  std::size_t few = 0;
  while (few < longest && readable(at, few + 1)) ++few;
  return few;
}

std::string Memory::text(const char* at, const std::string& what) const {
  if (at == nullptr) throw Error(loader_messages::text_missing(what));
  const std::size_t room = readable_bytes(at);
  if (room == 0) throw Error(loader_messages::text_outside_memory(what));
  const void* end = std::memchr(at, '\0', room);
  if (end == nullptr) throw Error(loader_messages::text_not_terminated(what));
  return std::string(at, static_cast<std::size_t>(static_cast<const char*>(end) - at));
}

}  // namespace fulmar::core
