// SPDX-License-Identifier: BSD-3-Clause
// See report_program.hpp.
#include "core/app/report_program.hpp"

#include <sys/mman.h>
#include <unistd.h>

#include <chrono>
#include <vector>

#include "core/error.hpp"
#include "core/loader/home.hpp"
#include "core/loader/process.hpp"

namespace fulmar::core {
namespace {

namespace fs = std::filesystem;

constexpr std::chrono::minutes patience{30};  // a log may have gigabytes
constexpr const char* program = "fulmar-report";

/// A text as a file that a child reads; it is gone with this object.
class TextFile {
 public:
  explicit TextFile(const std::string& text) {
    if (text.empty()) return;
    file_ = ::memfd_create("result", MFD_CLOEXEC);
    std::size_t written = 0;
    while (file_ >= 0 && written < text.size()) {
      const ssize_t n = ::write(file_, text.data() + written, text.size() - written);
      if (n <= 0) break;
      written += static_cast<std::size_t>(n);
    }
    if (written < text.size() || ::lseek(file_, 0, SEEK_SET) != 0)
      throw Error("there is no memory for the flight's result");
  }
  ~TextFile() {
    if (file_ >= 0) ::close(file_);
  }
  TextFile(const TextFile&) = delete;
  TextFile& operator=(const TextFile&) = delete;
  int descriptor() const { return file_; }

 private:
  int file_ = -1;
};

}  // namespace

void check_report_program() {
  if (own_program(program).empty())
    throw Error(std::string("the program ") + program +
                " is missing beside this one: it makes reports; cmake --build build --target flight");
  if (std::error_code none; !fs::exists(page_folder() / "report.html", none))
    throw Error(
        "this Fulmar was built without the page of a flight, which a report needs: install nodejs and npm, "
        "configure and build again");
}

void make_report(const fs::path& log, const fs::path& out, const std::string& result) {
  check_report_program();
  const TextFile file(result);
  std::vector<std::string> words{"--out=" + out.string()};
  if (!result.empty()) words.insert(words.end(), {"--result", "-"});
  words.insert(words.end(), {"--", log.string()});
  ChildFiles files;
  files.in = file.descriptor();
  files.error = STDERR_FILENO;
  Process process(own_program(program).string(), words, files);
  if (!process.wait(patience)) throw Error("the report of " + log.string() + " is not made after 30 minutes");
  if (process.signal() != 0 || process.exit_code() != 0)
    throw Error("the report of " + log.string() + " was not made");
}

fs::path report_beside(const fs::path& log) {
  fs::path file = log;
  if (file.extension() == ".part") file.replace_extension();
  return file.replace_extension(".html");
}

}  // namespace fulmar::core
