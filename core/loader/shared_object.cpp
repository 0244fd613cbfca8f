// SPDX-License-Identifier: BSD-3-Clause
#include "core/loader/shared_object.hpp"

#include <dlfcn.h>

#include <boost/dll/shared_library.hpp>

#include "core/error.hpp"
#include "core/loader/load_fault.hpp"

namespace fulmar::core {

using boost::dll::load_mode::type;

struct SharedObject::Impl {
  boost::dll::shared_library file;
};

SharedObject::SharedObject() : impl_(std::make_unique<Impl>()) {}
SharedObject::~SharedObject() = default;

void SharedObject::load(const std::filesystem::path& file, const std::string& name) {
  boost::dll::fs::error_code fault;
  impl_->file.load(file, boost::dll::load_mode::rtld_now | boost::dll::load_mode::rtld_local, fault);
  if (fault) throw Error(load_fault(name, ::dlerror()));
}

const fulmar_plugin& SharedObject::entry(const std::string& name) const {
  if (!impl_->file.has(FULMAR_ENTRY_SYMBOL)) throw Error(no_entry_fault(name));
  return impl_->file.get<const fulmar_plugin>(FULMAR_ENTRY_SYMBOL);
}

void SharedObject::unload() { impl_->file.unload(); }

bool is_mapped(const std::filesystem::path& file) {
  boost::dll::shared_library open;
  boost::dll::fs::error_code fault;
  open.load(file, static_cast<type>(RTLD_LAZY | RTLD_NOLOAD),
            fault);  // Boost.DLL passes on a mode that it does not name
  return !fault;
}

}  // namespace fulmar::core
