// SPDX-License-Identifier: BSD-3-Clause
// Files of the page for browsers, from a folder. They are read once, because a flight must not wait for a
// disk. They are equal for every flight and contain no secret.
#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <string_view>

namespace fulmar::core::live {

struct PageFile {
  std::string type;     // content type: "text/html; charset=utf-8"
  std::string body;     // not compressed
  std::string gzipped;  // "": only uncompressed
};

class Pages {
 public:
  Pages() = default;
  /// Reads the files of the folder that end in .html, .js or .css, and their compressed form FILE.gz. A
  /// folder that does not exist, or has no index.html, gives no page. Files of more than 8 MiB are skipped.
  explicit Pages(const std::filesystem::path& folder);

  bool empty() const { return files_.empty(); }
  /// "/" is index.html, and only "/" is; nullptr when there is no such file.
  const PageFile* find(std::string_view path) const;

 private:
  std::map<std::string, PageFile, std::less<>> files_;  // by path: "/page.js"
};

/// Content security policy of the page: it may load the page's files, connect to their server, and show
/// images of one other origin if the mission names one ("https://tile.example.org"). Everything else is
/// forbidden: other scripts, and text as HTML.
std::string page_policy(const std::string& images);

/// Whether "gzip, deflate, br" accepts gzip; "gzip;q=0" does not.
bool takes_gzip(std::string_view accept_encoding);

}  // namespace fulmar::core::live
