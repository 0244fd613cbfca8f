// SPDX-License-Identifier: BSD-3-Clause
#include "core/app/program.hpp"

#include <cxxabi.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <functional>
#include <memory>
#include <new>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <stdexcept>
#include <system_error>
#include <typeinfo>
#include <variant>

#include "core/app/last_act.hpp"
#include "core/app/messages.hpp"
#include "core/error.hpp"
#include "core/say.hpp"
#include "core/types/text.hpp"

namespace fulmar::core {
namespace {

void add_rows(const CLI::App& app, const std::string& path, std::string& rows) {
  std::string options, valued, subcommands;
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_lnames()) {
      options += (options.empty() ? "--" : " --") + name;
      if (option->get_items_expected_max() > 0 && option->get_expected_min() > 0) valued += " --" + name;
    }
  }
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    if (command->get_group().empty()) continue;
    subcommands += (subcommands.empty() ? "" : " ") + command->get_name();
    // another program lists its own subcommands
    if (!command->get_prefix_command())
      add_rows(*command, path + (path.empty() ? "" : " ") + command->get_name(), rows);
  }
  rows += path + "\t" + options + "\t" + valued + "\t" + subcommands + "\n";
}

int ended_by(CLI::App& app, const std::function<int()>& words) {
  try {
    return words();
  } catch (const CLI::ParseError& e) {
    return report_usage(app, e);
  }
}

template <class Fault>
bool is(const std::exception& fault) {
  return dynamic_cast<const Fault*>(&fault) != nullptr;
}

/// Meaning of a C++ exception for users; "": an exception of another library, which has its own text.
std::string meaning_of(const std::exception& fault) {
  if (is<std::length_error>(fault)) return app_messages::length_excessive().line();
  if (is<std::out_of_range>(fault)) return app_messages::element_missing().line();
  if (is<std::invalid_argument>(fault)) return app_messages::argument_invalid().line();
  if (is<std::bad_variant_access>(fault) || is<std::bad_optional_access>(fault) || is<std::bad_cast>(fault))
    return app_messages::value_type_differs().line();
  if (is<std::bad_function_call>(fault)) return app_messages::callable_empty().line();
  if (is<std::logic_error>(fault)) return app_messages::condition_violated().line();
  return "";
}

/// "std::length_error"
std::string type_name(const std::exception& fault) {
  int failed = 0;
  const std::unique_ptr<char, void (*)(void*)> name(
      abi::__cxa_demangle(typeid(fault).name(), nullptr, nullptr, &failed), &std::free);
  return failed == 0 ? name.get() : typeid(fault).name();
}

}  // namespace

std::string sentence_of(const std::exception& fault) {
  if (is<Error>(fault)) return fault.what();
  if (is<std::bad_alloc>(fault)) return app_messages::memory_exhausted().line();
  if (is<nlohmann::json::exception>(fault)) return app_messages::message_form_invalid().line();
  if (const auto* file = dynamic_cast<const std::filesystem::filesystem_error*>(&fault))
    return "'" + file->path1().string() + "': " + file->code().message();
  if (const auto* system = dynamic_cast<const std::system_error*>(&fault)) return system->code().message();
  const std::string meaning = meaning_of(fault);
  return app_messages::internal_error(type_name(fault), meaning.empty() ? fault.what() : meaning).line();
}

namespace {

bool has_json_option(const CLI::App& app) {
  const CLI::Option* const option = app.get_option_no_throw("--json");
  if (option != nullptr && option->count() > 0) return true;
  for (const CLI::App* command : app.get_subcommands())
    if (has_json_option(*command)) return true;
  return false;
}

nlohmann::json json_of(const Diagnostic& fault) {
  nlohmann::json arguments = nlohmann::json::object();
  for (const Argument& argument : fault.arguments)
    std::visit([&](const auto& value) { arguments[argument.name] = value; }, argument.value);
  return {{"code", fault.code},
          {"place", fault.place},
          {"path", fault.path},
          {"arguments", arguments},
          {"message", fault.line()}};
}

/// On standard output; the sentences go to standard error.
void print_json(const Error& error) {
  nlohmann::json errors = nlohmann::json::array();
  for (const Diagnostic& fault : error.several) errors.push_back(json_of(fault));
  if (errors.empty()) errors.push_back(json_of(error.diagnostic));
  const nlohmann::json all{{"errors", errors}};
  std::printf("%s\n", all.dump(2, ' ', false, nlohmann::json::error_handler_t::replace).c_str());
  std::fflush(stdout);
}

}  // namespace

int report_usage(const CLI::App& app, const CLI::ParseError& fault) {
  std::ostringstream out, err;
  const int code = app.exit(fault, out, err);
  std::fputs(out.str().c_str(), stdout);
  std::fputs(for_terminal(err.str()).c_str(), stderr);
  return code == 0 ? ExitCode::done : ExitCode::usage;
}

std::string command_rows(const CLI::App& app) {
  std::string rows;
  add_rows(app, "", rows);
  return rows;
}

bool asked_for_rows(int argc, char** argv) { return argc == 2 && std::strcmp(argv[1], "--rows") == 0; }

int run_program(CLI::App& app, const std::function<int()>& words, int fault) {
  const AtWork at_work;
  speak_on_standard_error();
  try {
    const int code = ended_by(app, words);
    if (code != 0 || (std::fflush(stdout) == 0 && std::ferror(stdout) == 0)) return code;
    std::fprintf(stderr, "fulmar: %s\n", app_messages::output_not_writable.c_str());
  } catch (const Error& e) {
    std::fprintf(stderr, "%s\n", for_terminal(e.what()).c_str());
    if (has_json_option(app)) print_json(e);
    return fault;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "fulmar: %s\n", for_terminal(sentence_of(e)).c_str());
  }
  return ExitCode::failed;
}

}  // namespace fulmar::core
