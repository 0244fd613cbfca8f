// SPDX-License-Identifier: BSD-3-Clause
// The files of the page that a browser gets, as a folder has them: read once, since a flight in the air shall
// not wait for a disk. The same for every flight, so they hold no secret.
#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <string_view>

namespace fulmar::core::live {

struct PageFile {
  std::string type;     // of its content: "text/html; charset=utf-8"
  std::string body;     // as it is
  std::string gzipped;  // the same; "": only as it is
};

class Pages {
 public:
  Pages() = default;
  /// The files of the folder itself that end in .html, .js or .css; of those beside which there is a FILE.gz
  /// that as well. A folder that is not there, or has no index.html, is no page. What has more than 8 MiB is
  /// left out.
  explicit Pages(const std::filesystem::path& folder);

  bool empty() const { return files_.empty(); }
  /// "/" is index.html, and that alone; nullptr when there is no such file.
  const PageFile* find(std::string_view path) const;

 private:
  std::map<std::string, PageFile, std::less<>> files_;  // by path: "/page.js"
};

/// What a browser may do with a file of the page: load the others, speak to where it came from, show images
/// of one other place where the mission names one ("https://tile.example.org"), and nothing else; no script
/// but these files, and no text becomes HTML.
std::string page_policy(const std::string& images);

/// Whether "gzip, deflate, br" takes gzip; "gzip;q=0" does not.
bool takes_gzip(std::string_view accept_encoding);

}  // namespace fulmar::core::live
