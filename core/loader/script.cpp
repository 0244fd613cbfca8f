// SPDX-License-Identifier: BSD-3-Clause
#include "core/loader/script.hpp"

#include <fstream>
#include <iterator>

#include "core/error.hpp"
#include "core/loader/float_mode.hpp"
#include "core/loader/messages.hpp"

namespace fulmar::core {
namespace fs = std::filesystem;

std::string script_host(const fs::path& file) { return file.extension() == ".py" ? "python" : ""; }

Script::Script(const fulmar_plugin& host, const std::string& file, const std::string& text) : host_(host) {
  const std::string name = fs::path(file).filename().string();
  if (host.abi_minor < 1 || host.open_script == nullptr || host.close_script == nullptr)
    throw Error(loader_messages::script_host_invalid(name, script_host(file)));
  fulmar_error fault{};
  const FloatModeGuard guard;
  entry_ = host.open_script(file.c_str(), text.data(), text.size(), &fault);
  if (entry_ != nullptr) return;
  fault.text[sizeof fault.text - 1] = '\0';
  throw Error(fault.text[0] != '\0' ? Diagnostic(fault.text) : loader_messages::script_not_opened(name));
}

Script::~Script() {
  const FloatModeGuard guard;
  host_.close_script(entry_);
}

std::string read_script(const fs::path& copy) {
  std::ifstream in(copy, std::ios::binary);
  if (!in) throw Error(loader_messages::copy_not_readable(copy.string()));
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace fulmar::core
