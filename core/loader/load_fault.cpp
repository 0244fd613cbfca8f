// SPDX-License-Identifier: BSD-3-Clause
#include "core/loader/load_fault.hpp"

#include <string_view>

#include "fulmar/abi.h"

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
    return name + " needs " + library + ", which is not there";
  const std::string reason = reason_of(text);
  constexpr std::string_view undefined = "undefined symbol: ";
  if (const std::size_t at = reason.find(undefined); at != std::string::npos) {
    std::string symbol = reason.substr(at + undefined.size());
    cut_behind(symbol, ",");  // ", version GLIBC_2.38"
    return name + " needs the symbol " + symbol + ", which nothing provides";
  }
  if (const std::size_t at = reason.find("version `");
      at != std::string::npos && reason.find("not found") != std::string::npos) {
    const std::size_t begin = at + 9;
    return name + " needs " + reason.substr(begin, reason.find('\'', begin) - begin) +
           ", which this system does not have";
  }
  if (reason.find("failed to map segment") != std::string::npos)
    return name +
           " cannot be mapped: the plugin store may lie on a file system that forbids execution; set "
           "FULMAR_STORE (" +
           reason + ")";
  return name + " cannot be loaded: " + reason;
}

std::string no_entry_fault(const std::string& name) {
  return name + " has no symbol " FULMAR_ENTRY_SYMBOL ": not a Fulmar plugin";
}

}  // namespace fulmar::core
