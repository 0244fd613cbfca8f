// SPDX-License-Identifier: BSD-3-Clause
#include "core/isolate/shared_memory.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>

#include "core/error.hpp"
#include "core/isolate/messages.hpp"

namespace fulmar::core {
namespace {

[[noreturn]] void no_memory(std::size_t size) {
  throw Error(isolate_messages::memory_not_shared(size, std::strerror(errno)));
}

// Populates all pages at once, so that no page fault occurs in flight.
Mapping map(int descriptor, std::size_t at, std::size_t size) {
  void* data = ::mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_POPULATE, descriptor,
                      static_cast<off_t>(at));
  if (data == MAP_FAILED) no_memory(size);
  return Mapping(static_cast<std::byte*>(data), {size});
}

}  // namespace

void Unmap::operator()(std::byte* data) const noexcept { ::munmap(data, size); }

// Delegates, so that the destructor closes the descriptor after a fault here.
SharedMemory::SharedMemory(std::size_t size) : SharedMemory() {
  descriptor_ = ::memfd_create("fulmar-child", MFD_CLOEXEC | MFD_ALLOW_SEALING);
  if (descriptor_ < 0 || ::ftruncate(descriptor_, static_cast<off_t>(size)) != 0) no_memory(size);
  ::fcntl(descriptor_, F_ADD_SEALS, F_SEAL_SHRINK | F_SEAL_SEAL);
  data_ = map(descriptor_, 0, size);
  whole_ = size;
}

SharedMemory::~SharedMemory() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

Mapping SharedMemory::window(std::size_t at, std::size_t size) {
  if (size == 0) return {};
  if (at + size > whole_) {
    if (::ftruncate(descriptor_, static_cast<off_t>(at + size)) != 0) no_memory(size);
    whole_ = at + size;
  }
  return map(descriptor_, at, size);
}

}  // namespace fulmar::core
