// SPDX-License-Identifier: BSD-3-Clause
// Output of a figure: an SVG file, or its conversion by another program.
#include <charconv>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <sstream>

#include "core/error.hpp"
#include "core/loader/home.hpp"
#include "core/loader/process.hpp"
#include "tools/fulmar_log/messages.hpp"
#include "tools/fulmar_log/plot_log.hpp"

namespace fulmar::plot {
namespace {

using core::Error;
namespace fs = std::filesystem;

constexpr double largest_mm = 2000;
constexpr const char* print_dpi = "300";
constexpr std::chrono::seconds patience{60};

fs::path program_in_path(const char* name) {
  const char* list = std::getenv("PATH");
  std::istringstream folders(list ? list : "");
  for (std::string folder; std::getline(folders, folder, ':');) {
    const fs::path file = fs::path(folder) / name;
    if (file.is_absolute() && core::can_run(file)) return file;
  }
  return {};
}

void write_text(const fs::path& file, const std::string& text) {
  std::ofstream out(file, std::ios::binary | std::ios::trunc);
  out << text;
  out.close();
  if (!out) throw Error(log_tool_messages::figure_not_writable(file.string()));
}

/// `form`: "png" or "pdf".
void convert(const fs::path& svg, const fs::path& out, const std::string& form) {
  std::vector<std::string> words{"-d", print_dpi, "-p",         print_dpi,   "-f",
                                 form, "-o",      out.string(), svg.string()};
  fs::path program = program_in_path("rsvg-convert");
  if (program.empty()) {
    program = program_in_path("inkscape");
    words = {svg.string(), "--export-type=" + form, std::string("--export-dpi=") + print_dpi,
             "--export-filename=" + out.string()};
  }
  if (program.empty()) throw Error(log_tool_messages::svg_converter_missing(out.string()));
  core::Process process(program.string(), words, {});
  const bool ended = process.wait(patience);
  std::error_code none;
  if (!ended || process.signal() != 0 || process.exit_code() != 0 || fs::file_size(out, none) == 0 || none)
    throw Error(log_tool_messages::figure_conversion_failed(program.string(), out.string()));
}

/// A file that this object deletes at its end.
struct Scratch {
  fs::path file;
  ~Scratch() {
    std::error_code none;
    fs::remove(file, none);
  }
};

}  // namespace

std::pair<double, double> read_size(const std::string& text) {
  double wide = 0, high = 0;
  const char* const end = text.data() + text.size();
  const auto first = std::from_chars(text.data(), end, wide);
  if (first.ec == std::errc{} && first.ptr != end && *first.ptr == 'x') {
    const auto second = std::from_chars(first.ptr + 1, end, high);
    const std::string unit(second.ptr, end);
    const bool good = wide > 0 && high > 0 && wide <= largest_mm && high <= largest_mm;
    if (second.ec == std::errc{} && (unit == "mm" || unit.empty()) && good) return {wide, high};
  }
  throw UsageError(log_tool_messages::size_invalid(text));
}

void write_figure(const fs::path& out, const std::string& svg) {
  const std::string ending = out.extension().string();
  if (ending == ".svg") return write_text(out, svg);
  if (ending != ".png" && ending != ".pdf")
    throw Error(log_tool_messages::figure_format_unknown(out.string()));
  const Scratch scratch{out.string() + ".svg.part"};
  write_text(scratch.file, svg);
  convert(fs::absolute(scratch.file), fs::absolute(out), ending.substr(1));
}

}  // namespace fulmar::plot
