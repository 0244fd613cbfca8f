// SPDX-License-Identifier: BSD-3-Clause
#include "core/loader/shared_object.hpp"

#include <dlfcn.h>

#include <boost/dll/shared_library.hpp>
#include <string_view>

#include "core/error.hpp"
#include "core/loader/messages.hpp"

namespace fulmar::core {
namespace {

bool cut_behind(std::string& text, std::string_view end) {
  const std::size_t at = text.find(end);
  if (at == std::string::npos) return false;
  text.resize(at);
  return true;
}

// "/store/ab12.so: the reason" -> "the reason"
std::string reason_of(const std::string& text) {
  const std::size_t colon = text.find(": ");
  return !text.empty() && text[0] == '/' && colon != std::string::npos ? text.substr(colon + 2) : text;
}

}  // namespace

std::string load_fault(const std::string& name, const char* dlerror_text) {
  const std::string text = dlerror_text == nullptr ? "no reason given" : dlerror_text;
  std::string library = text;
  const bool of_another = text.empty() || text[0] != '/';
  if (of_another && cut_behind(library, ": cannot open shared object file"))
    return loader_messages::required_library_missing(name, library).line();
  const std::string reason = reason_of(text);
  constexpr std::string_view undefined = "undefined symbol: ";
  if (const std::size_t at = reason.find(undefined); at != std::string::npos) {
    std::string symbol = reason.substr(at + undefined.size());
    cut_behind(symbol, ",");  // ", version GLIBC_2.38"
    return loader_messages::required_symbol_missing(name, symbol).line();
  }
  if (const std::size_t at = reason.find("version `");
      at != std::string::npos && reason.find("not found") != std::string::npos) {
    const std::size_t begin = at + 9;
    return loader_messages::required_version_missing(name,
                                                     reason.substr(begin, reason.find('\'', begin) - begin))
        .line();
  }
  if (reason.find("failed to map segment") != std::string::npos)
    return loader_messages::plugin_not_mappable(name, reason).line();
  return loader_messages::plugin_not_loadable(name, reason).line();
}

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

const void* SharedObject::find(const char* symbol) const {
  return impl_->file.has(symbol) ? &impl_->file.get<const char>(symbol) : nullptr;
}

const fulmar_plugin& SharedObject::entry(const std::string& name) const {
  const void* const table = find(FULMAR_ENTRY_SYMBOL);
  if (table == nullptr) throw Error(loader_messages::entry_symbol_missing(name, FULMAR_ENTRY_SYMBOL));
  return *static_cast<const fulmar_plugin*>(table);
}

void SharedObject::unload() { impl_->file.unload(); }

bool is_mapped(const std::filesystem::path& file) {
  boost::dll::shared_library open;
  boost::dll::fs::error_code fault;
  open.load(file, static_cast<boost::dll::load_mode::type>(RTLD_LAZY | RTLD_NOLOAD),
            fault);  // Boost.DLL passes on a mode that it has no name for
  return !fault;
}

}  // namespace fulmar::core
