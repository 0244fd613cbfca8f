// SPDX-License-Identifier: BSD-3-Clause
// Opens a plugin: file -> ELF header -> private copy -> probing child -> this process. Each fault is rejected
// in the earliest possible stage.
#include "core/loader/library.hpp"

#include <cxxabi.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <map>
#include <mutex>
#include <set>

#include "core/error.hpp"
#include "core/loader/build_id.hpp"
#include "core/loader/elf.hpp"
#include "core/loader/float_mode.hpp"
#include "core/loader/home.hpp"
#include "core/loader/in_hand.hpp"
#include "core/loader/messages.hpp"
#include "core/loader/probe.hpp"
#include "core/loader/script.hpp"
#include "core/loader/shared_object.hpp"
#include "core/loader/store.hpp"
#include "core/loader/table.hpp"
#include "core/loader/unique.hpp"

namespace fulmar::core {
namespace {

namespace fs = std::filesystem;

// Libraries loaded in this process, and files that a child of this process has accepted. Keys are SHA-256.
struct Registry {
  std::mutex mutex;
  std::map<std::string, std::weak_ptr<Library>> loaded;
  std::set<std::string> probed;
  struct Owner {
    std::string key, name;
  };
  std::map<std::string, Owner> unique;  // owner of each unique symbol; its library is never unloaded
};

Registry& registry() {
  static Registry one;
  return one;
}

// The bytes are read once, then hashed, checked and copied: a later change of the file has no effect.
std::vector<std::byte> read_file(const fs::path& file, const std::string& name) {
  constexpr std::uintmax_t largest = std::uintmax_t{1} << 30;
  std::error_code fault;
  const fs::file_status status = fs::status(file, fault);
  if (!fs::exists(status)) throw Error(loader_messages::plugin_missing(name, file.string()));
  if (!fs::is_regular_file(status)) throw Error(loader_messages::plugin_not_regular(name, file.string()));
  const std::uintmax_t size = fs::file_size(file, fault);
  if (fault || size > largest) throw Error(loader_messages::plugin_too_large(name));
  std::vector<std::byte> bytes(static_cast<std::size_t>(size));
  errno = 0;
  std::ifstream in(file, std::ios::binary);
  in.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(size));
  if (!in) throw Error(loader_messages::plugin_not_readable(name, std::strerror(errno != 0 ? errno : EIO)));
  return bytes;
}

// Throws unless a child has loaded it. `host`: copy of the plugin that opens a script, else empty; `file`:
// original path of the script.
void try_in_child(const fs::path& copy, const std::string& key, const std::string& name, const fs::path& host,
                  const fs::path& file) {
  if (registry().probed.count(key) > 0) return;
  const std::string fault = host.empty() ? probe(copy, name) : probe(host, name, {copy, file});
  if (!fault.empty()) {
    std::error_code ignored;
    fs::remove(copy, ignored);
    throw Error(fault);
  }
  registry().probed.insert(key);
}

std::string plain_name(const std::string& symbol) {
  int failed = 0;
  const std::unique_ptr<char, void (*)(void*)> plain(
      abi::__cxa_demangle(symbol.c_str(), nullptr, nullptr, &failed), &std::free);
  return plain ? plain.get() : symbol;
}

/// Throws when another loaded file has one of the unique symbols: this one would share its data.
void refuse_shared(const std::vector<std::string>& symbols, const std::string& key, const std::string& name) {
  for (const std::string& symbol : symbols)
    if (const auto owner = registry().unique.find(symbol);
        owner != registry().unique.end() && owner->second.key != key)
      throw Error(loader_messages::unique_symbol_shared(name, plain_name(symbol), owner->second.name));
}

}  // namespace

struct Library::Handle {
  SharedObject file;
  const fulmar_plugin* plugin = nullptr;  // of the file
  std::shared_ptr<Library> host;          // plugin that hosts a script; closed after the script
  std::unique_ptr<Script> script;
  std::vector<fulmar_component> functions;

  void load(const fs::path& copy, const std::string& name) {
    const FloatModeGuard guard;
    file.load(copy, name);
    plugin = &file.entry(name);
  }

  void load_script(const std::shared_ptr<Library>& by, const fs::path& place,
                   const std::vector<std::byte>& bytes) {
    host = by;
    const std::string text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    script = std::make_unique<Script>(host->handle_->entry(), place.string(), text);
  }

  const fulmar_plugin& entry() const { return script ? script->entry() : *plugin; }

  bool hosts_scripts() const { return entry().abi_minor >= 1 && entry().open_script != nullptr; }

  void copy_functions() {
    const TableReader tables;
    for (std::uint32_t i = 0; i < entry().component_count; ++i)
      functions.push_back(tables.element(entry().components, entry().component_stride, i, "the components"));
  }

  void close(const std::string& name) {
    const FloatModeGuard guard;
    const InHand in_hand(name, "unloaded");
    functions.clear();
    script.reset();
    host.reset();
    file.unload();
  }
};

std::shared_ptr<Library> Library::open(const fs::path& file) {
  const std::string name = file.filename().string();
  const std::vector<std::byte> bytes = read_file(file, name);
  const std::string sha256 = sha256_hex(bytes.data(), bytes.size());
  const bool script = !script_host(file).empty();
  const std::shared_ptr<Library> host = script ? open(host_of(file)) : nullptr;
  if (const std::string fault = script ? "" : elf_fault(bytes); !fault.empty())
    throw Error(loader_messages::file_fault(name, fault));
  std::error_code ignored;
  const fs::path place = fs::absolute(file, ignored);
  // a script's folder is part of the key: the script may load files beside it
  const std::string key = script ? sha256 + " " + place.string() : sha256;
  const std::lock_guard lock(registry().mutex);
  if (auto known = registry().loaded[key].lock()) return known;
  const std::shared_ptr<Library> library(new Library);
  library->key_ = key;
  library->copy_ = keep_copy(bytes, sha256, script ? file.extension().string() : ".so");
  try_in_child(library->copy_, key, name, script ? host->copy_ : "", place);
  const std::vector<std::string> unique = script ? std::vector<std::string>{} : unique_symbols(bytes);
  refuse_shared(unique, key, name);
  library->handle_ = std::make_unique<Handle>();
  PluginInfo& info = library->info_;
  info.file = name;
  const InHand in_hand(name, "loaded");
  if (script)
    library->handle_->load_script(host, place, bytes);
  else
    library->handle_->load(library->copy_, name);
  info = read_entry(library->handle_->entry(), name);
  info.sha256 = sha256;
  info.build_id = build_id(bytes);
  info.path = file.string();
  info.copy = (script ? host : library)->copy_.string();
  if (script) info.script = library->copy_.string();
  library->handle_->copy_functions();
  registry().loaded[key] = library;
  for (const std::string& symbol : unique) registry().unique[symbol] = {key, name};
  return library;
}

fs::path Library::host_of(const fs::path& script) {
  const std::string language = script_host(script), file = language + ".so";
  std::vector<std::string> searched;
  for (const fs::path& folder : plugin_folders()) {
    std::error_code fault;
    if (fs::is_regular_file(folder / file, fault)) return folder / file;
    searched.push_back(folder.string());
  }
  throw Error(loader_messages::script_host_missing(script.filename().string(), language, join(searched)));
}

Library::~Library() {
  if (handle_) handle_->close(info_.file);
}

const fulmar_component& Library::functions(std::size_t i) const { return handle_->functions.at(i); }

void Library::unload(std::shared_ptr<Library>&& library) {
  const std::shared_ptr<Library> last = std::move(library);
  const std::string name = last->info_.file;
  if (last.use_count() > 1) throw Error(loader_messages::plugin_in_use(name));
  const std::lock_guard lock(registry().mutex);
  registry().loaded.erase(last->key_);
  const bool script = last->handle_->script != nullptr, hosts = !script && last->handle_->hosts_scripts();
  last->handle_->close(name);
  if (script || hosts)
    return;  // an interpreter cannot be unloaded; a closed script is freed by its host plugin
  for (const ComponentInfo& component : last->info_.components)
    if (component.resident)
      return;  // the component declares that it is resident; its swap does not unload
               // the file
  if (is_mapped(last->copy_)) throw Error(loader_messages::plugin_still_resident(name));
}

}  // namespace fulmar::core
