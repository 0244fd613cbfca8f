// SPDX-License-Identifier: BSD-3-Clause
// The page for a browser: its files, its policy, and the access to it.
#include "links/live/pages.hpp"

#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "core/graph/live_options.hpp"
#include "links/live/test/server_fixture.hpp"

namespace pages_test {

using namespace fulmar::core::live_server;
namespace fs = std::filesystem;

namespace {

/// A folder of a page, removed at the end.
struct Folder {
  fs::path path = fs::temp_directory_path() / ("fulmar-pages-" + std::to_string(::getpid()));
  Folder() {
    fs::remove_all(path);
    fs::create_directories(path / "deeper");
    put("index.html", "<p>page");
    put("page.js", "let x;");
    put("page.js.gz", "squeezed");
    put("page.css", "p{}");
    put("notes.txt", "nobody's");
    put("deeper/more.js", "let y;");
  }
  ~Folder() { fs::remove_all(path); }
  void put(const std::string& name, const std::string& content) const {
    std::ofstream(path / name, std::ios::binary) << content;
  }
};

/// A live view that has a page.
struct Paged : Fixture {
  Folder folder;
  void serve(const std::string& with_token = "") {
    options.port = 0;
    options.token = with_token;
    if (!with_token.empty()) options.host = "0.0.0.0";
    server.emplace(tap, control, options, folder.path);
  }
  std::string head_of(const std::string& target, const std::string& extra = "") const {
    const std::string answer = raw("GET " + target + " HTTP/1.1\r\nHost: localhost\r\n" + extra + "\r\n");
    return answer.substr(0, answer.find("\r\n\r\n"));
  }
};

bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

}  // namespace

TEST_CASE_FIXTURE(Paged, "a browser gets the page, its files by their names, and the topics beside it") {
  serve();
  CHECK(get("/").body == "<p>page");
  CHECK(get("/").content_type == "text/html; charset=utf-8");
  CHECK(get("/page.js").body == "let x;");
  CHECK(get("/page.js?again").content_type == "text/javascript; charset=utf-8");
  CHECK(get("/page.css").content_type == "text/css; charset=utf-8");
  CHECK(get("/topics").body.find(mock_heading) != std::string::npos);
  CHECK(get("/page.js", {}, http::verb::head).status == 200);
  CHECK(get("/page.js", {}, http::verb::post).status == 405);
}

TEST_CASE_FIXTURE(Paged, "only the files of the folder itself are served") {
  serve();
  for (const char* path : {"/notes.txt", "/page.js.gz", "/deeper/more.js", "/more.js", "/index.html",
                           "/../pages/page.js", "/%2e%2e/page.js", "//page.js", "/page.j"})
    CHECK_MESSAGE(get(path).status == 404, path);
  folder.put("page.js", "another");  // read once: a flight does not wait for a disk
  CHECK(get("/page.js").body == "let x;");
}

TEST_CASE_FIXTURE(Paged, "only the page's own files are scripts, and no text becomes HTML") {
  serve();
  const std::string head = head_of("/");
  for (const char* rule :
       {"default-src 'none'", "script-src 'self';", "connect-src 'self'", "frame-ancestors 'none'",
        "require-trusted-types-for 'script'; trusted-types 'none'", "X-Content-Type-Options: nosniff",
        "Cross-Origin-Resource-Policy: same-origin", "Referrer-Policy: no-referrer"})
    CHECK_MESSAGE(has(head, rule), rule);
  CHECK_FALSE(has(head, "unsafe"));
  CHECK(has(head, "; img-src 'self' data:; "));
  CHECK(has(head_of("/page.js"), "script-src 'self'"));
}

TEST_CASE_FIXTURE(Paged, "images may come from the origin of the mission's tiles, and from no other") {
  options.tiles = "https://tile.example.org:8443/a/{z}/{x}/{y}.png?k=1";
  serve();
  const std::string rule = "; img-src 'self' data: https://tile.example.org:8443; base-uri 'none'; ";
  for (const char* path : {"/", "/page.js"}) CHECK(has(head_of(path), rule));
  CHECK(origin_of("") == "");
}

TEST_CASE_FIXTURE(Paged, "compressed files go to clients that accept them") {
  serve();
  const std::string small = head_of("/page.js", "Accept-Encoding: gzip, deflate, br\r\n");
  CHECK(has(small, "Content-Encoding: gzip\r\n"));
  CHECK(has(small, "Content-Length: 8"));
  CHECK(
      has(head_of("/page.css", "Accept-Encoding: gzip\r\n"), "Content-Length: 3"));  // has no compressed form
  CHECK_FALSE(has(head_of("/page.js"), "Content-Encoding"));
  using fulmar::core::live::takes_gzip;
  CHECK(takes_gzip("deflate , gzip"));
  CHECK(takes_gzip("gzip;q=0.5"));
  CHECK_FALSE(takes_gzip("gzip;q=0"));
  CHECK_FALSE(takes_gzip("gzip;q=0.0, br"));
  CHECK_FALSE(takes_gzip("xgzip"));
  CHECK_FALSE(takes_gzip(""));
}

TEST_CASE_FIXTURE(
    Paged, "with a token the page is for who shows it; its files, the same for every flight, for all") {
  serve("abc");
  CHECK(get("/").status == 401);
  CHECK(get("/?token=abc").body == "<p>page");
  CHECK(get("/topics").status == 401);
  CHECK(get("/page.js").body == "let x;");
  CHECK(get("/page.js?token=abd").status == 401);
  CHECK_THROWS(Client(*this, "foxglove.sdk.v1", "/page.js"));  // it does not join the flight
  CHECK(Client(*this, "foxglove.sdk.v1", "/?token=abc").next("serverInfo")["op"] == "serverInfo");
}

TEST_CASE_FIXTURE(Paged, "foreign host names, and pages of other sites, do not get its files either") {
  serve();
  CHECK(get("/page.js", {{"Host", "evil.example"}}).status == 403);
  CHECK(get("/page.js", {{"Origin", "http://evil.example"}}).status == 403);
}

TEST_CASE("a folder without index.html, or one that does not exist, is no page") {
  using fulmar::core::live::Pages;
  const Folder folder;
  CHECK(Pages(folder.path).find("/page.js") != nullptr);
  fs::remove(folder.path / "index.html");
  CHECK(Pages(folder.path).empty());
  CHECK(Pages(folder.path / "none").empty());
  CHECK(Pages(fs::path()).empty());
}

}  // namespace pages_test
