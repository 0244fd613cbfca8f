// SPDX-License-Identifier: BSD-3-Clause
#include "core/isolate/shared_memory.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>

#include "core/error.hpp"

namespace fulmar::core {
namespace {

// All pages at once, so that none is missing in flight.
std::byte* map(int descriptor, std::size_t at, std::size_t size) {
  void* data = ::mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_POPULATE, descriptor,
                      static_cast<off_t>(at));
  return data == MAP_FAILED ? nullptr : static_cast<std::byte*>(data);
}

[[noreturn]] void no_memory(std::size_t size) {
  throw Error("cannot share " + std::to_string(size) + " bytes with a child: " + std::strerror(errno) + ".");
}

}  // namespace

SharedMemory::SharedMemory(std::size_t size) : size_(size), whole_(size) {
  descriptor_ = ::memfd_create("fulmar-child", MFD_CLOEXEC | MFD_ALLOW_SEALING);
  if (descriptor_ < 0) no_memory(size);
  const bool sized = ::ftruncate(descriptor_, static_cast<off_t>(size)) == 0;
  if (sized) ::fcntl(descriptor_, F_ADD_SEALS, F_SEAL_SHRINK | F_SEAL_SEAL);
  data_ = sized ? map(descriptor_, 0, size) : nullptr;
  if (data_) return;
  const int fault = errno;
  ::close(descriptor_);
  errno = fault;
  no_memory(size);
}

SharedMemory::~SharedMemory() {
  ::munmap(data_, size_);
  ::close(descriptor_);
}

SharedMemory::Window::Window(SharedMemory& memory, std::size_t at, std::size_t size) : size_(size) {
  if (size == 0) return;
  if (at + size > memory.whole_) {
    if (::ftruncate(memory.descriptor_, static_cast<off_t>(at + size)) != 0) no_memory(size);
    memory.whole_ = at + size;
  }
  data_ = map(memory.descriptor_, at, size);
  if (!data_) no_memory(size);
}

SharedMemory::Window::~Window() {
  if (data_) ::munmap(data_, size_);
}

}  // namespace fulmar::core
