// SPDX-License-Identifier: BSD-3-Clause
#include "links/live/pages.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>

namespace fulmar::core::live {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t max_file_bytes = 8u << 20;

std::string content_type(const fs::path& file) {
  const std::string ending = file.extension().string();
  if (ending == ".html") return "text/html; charset=utf-8";
  if (ending == ".js") return "text/javascript; charset=utf-8";
  return ending == ".css" ? "text/css; charset=utf-8" : "";
}

std::string content(const fs::path& file) {
  std::error_code fault;
  if (const auto size = fs::file_size(file, fault); fault || size > max_file_bytes) return "";
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  return text;
}

}  // namespace

Pages::Pages(const fs::path& folder) {
  std::error_code fault;
  for (fs::directory_iterator at(folder, fault), end; !fault && at != end; at.increment(fault)) {
    const std::string type = content_type(at->path());
    if (type.empty()) continue;
    PageFile file{type, content(at->path()), content(at->path().string() + ".gz")};
    const std::string name = at->path().filename().string();
    if (!file.body.empty()) files_.emplace(name == "index.html" ? "/" : "/" + name, std::move(file));
  }
  if (!files_.contains("/")) files_.clear();
}

const PageFile* Pages::find(std::string_view path) const {
  const auto at = files_.find(path);
  return at == files_.end() ? nullptr : &at->second;
}

std::string page_policy(const std::string& images) {
  return "default-src 'none'; script-src 'self'; style-src 'self'; connect-src 'self'; img-src 'self' data:" +
         (images.empty() ? images : " " + images) +
         "; base-uri 'none'; form-action 'none'; frame-ancestors 'none'; require-trusted-types-for 'script'; "
         "trusted-types 'none'";
}

bool takes_gzip(std::string_view accept_encoding) {
  while (!accept_encoding.empty()) {
    const std::string_view one = accept_encoding.substr(0, accept_encoding.find(','));
    const std::string_view name = trimmed(one.substr(0, one.find(';')));
    const std::size_t weight = one.find("q=");
    const bool refused =
        weight != std::string_view::npos && one.find_first_of("123456789", weight) == std::string_view::npos;
    if (name == "gzip" && !refused) return true;
    accept_encoding.remove_prefix(std::min(accept_encoding.size(), one.size() + 1));
  }
  return false;
}

}  // namespace fulmar::core::live
