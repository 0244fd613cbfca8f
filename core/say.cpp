// SPDX-License-Identifier: BSD-3-Clause
#include "core/say.hpp"

#include <spdlog/sinks/stdout_color_sinks.h>
#include <spdlog/spdlog.h>

#include "core/terminal.hpp"

namespace fulmar::core {

void say_aloud(const std::string& text, Tone tone) {
  const auto level = tone == Tone::error     ? spdlog::level::err
                     : tone == Tone::warning ? spdlog::level::warn
                                             : spdlog::level::info;
  spdlog::log(level, "{}", for_terminal(text));
}

void speak_on_standard_error() {
  spdlog::set_default_logger(spdlog::stderr_color_mt("fulmar"));
  spdlog::set_pattern("%^%v%$");
}

}  // namespace fulmar::core
